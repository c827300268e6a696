//! Places of every kind, killed runs, and what must stay as it was.

use std::collections::BTreeMap;

use tempfile::TempDir;

use super::system::faults::{self, CallFault};
use super::unfinished::{LOCK, MOVING};
use super::*;

/// A folder that is removed with the test.
fn folder() -> TempDir {
    TempDir::new().expect("folder")
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("folder");
    let name = |entry: io::Result<fs::DirEntry>| {
        entry.expect("entry").file_name().to_string_lossy().into_owned()
    };
    let mut names: Vec<_> = entries.map(name).collect();
    names.sort();
    names
}

#[test]
fn a_file_is_old_until_it_is_new() {
    let root = folder();
    let path = root.path().join("a.csv");
    let output = Outputs::default().open(&path).unwrap();
    assert!(!path.exists());
    drop(output);
    assert!(names(root.path()).is_empty(), "nothing is left of a failure");
    write_atomically(&path, "old").unwrap();
    let output = Outputs::default().open(&path).unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"old");
    output.write("new").unwrap();
    assert_eq!(fs::read(&path).unwrap(), b"new");
    assert_eq!(names(root.path()), ["a.csv"]);
    // The unfinished name is short whatever the name is.
    let long = root.path().join("x".repeat(251) + ".csv");
    write_atomically(&long, "y").unwrap();
    for bad in [root.path().to_owned(), root.path().join("no/such/a.csv")] {
        assert!(Outputs::default().open(&bad).is_err());
    }
}

/// Windows replaces no file that a program has open.
#[test]
fn a_file_that_cannot_replace_another_is_kept_beside_it() {
    let root = folder();
    let (path, kept) = (root.path().join("a"), root.path().join("a.new"));
    fs::write(&path, "old").unwrap();
    let write = |content: &str| {
        let (call, code) = (Some("rename"), 13);
        let fault = CallFault { call, after: 0, ongoing: false, code };
        let write = || write_atomically(&path, content);
        faults::with(Some(fault), write).0.unwrap_err().to_string()
    };
    let error = write("new");
    assert!(error.ends_with("a.new"), "{error}");
    assert_eq!(fs::read(&kept).unwrap(), b"new");
    // The one that was kept stays, too.
    assert!(!write("later").contains("a.new"));
    assert_eq!(fs::read(&kept).unwrap(), b"new");
    assert_eq!(fs::read(&path).unwrap(), b"old");
    assert_eq!(names(root.path()), ["a", "a.new"]);
}

#[cfg(unix)]
#[test]
fn modes_links_and_pipes_stay() {
    use std::os::unix::fs::{FileTypeExt as _, PermissionsExt as _, symlink};
    let root = folder();
    let (file, link) = (root.path().join("t"), root.path().join("l"));
    fs::write(&file, "old").unwrap();
    fs::set_permissions(&file, fs::Permissions::from_mode(0o640)).unwrap();
    symlink("t", &link).unwrap();
    write_atomically(&link, "new").unwrap();
    assert!(fs::symlink_metadata(&link).unwrap().is_symlink());
    assert_eq!(fs::read(&file).unwrap(), b"new");
    let mode = fs::metadata(&file).unwrap().permissions().mode();
    assert_eq!(mode & 0o777, 0o640);
    // A link to nothing makes the file it names.
    symlink("u", root.path().join("m")).unwrap();
    write_atomically(&root.path().join("m"), "made").unwrap();
    assert_eq!(fs::read(root.path().join("u")).unwrap(), b"made");
    let pipe = root.path().join("pipe");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status();
    assert!(made.unwrap().success());
    let reader = std::thread::spawn({
        let pipe = pipe.clone();
        move || fs::read(pipe).unwrap()
    });
    write_atomically(&pipe, "through").unwrap();
    assert_eq!(reader.join().unwrap(), b"through");
    assert!(fs::symlink_metadata(&pipe).unwrap().file_type().is_fifo());
}

#[test]
fn what_is_read_is_not_written() {
    let root = folder();
    let input = root.path().join("in.csv");
    fs::write(&input, "data").unwrap();
    let again = root.path().join("again.csv");
    fs::hard_link(&input, &again).unwrap();
    // Elsewhere the other name of a replaced file keeps it.
    let names = if cfg!(unix) { 3 } else { 2 };
    for name in &[&input, &root.path().join("./in.csv"), &again][..names] {
        let mut outputs = Outputs::of(vec![input.clone()]);
        let error = outputs.open(name).unwrap_err();
        assert!(error.to_string().contains("is read"), "{error}");
    }
    assert_eq!(fs::read(&input).unwrap(), b"data");
}

#[cfg(unix)]
#[test]
fn two_outputs_do_not_go_to_one_place() {
    use std::os::unix::fs::symlink;
    let root = folder();
    let at = |name: &str| root.path().join(name);
    fs::create_dir(at("sub")).unwrap();
    fs::write(at("old"), "old").unwrap();
    symlink("old", at("link")).unwrap();
    fs::hard_link(at("old"), at("hard")).unwrap();
    symlink("new", at("dangling")).unwrap();
    symlink(".", at("here")).unwrap();
    for (one, other) in [
        ("old", "old"),
        ("old", "link"),
        ("hard", "old"),
        ("old", "sub/../old"),
        ("here/old", "link"),
        ("new", "new"),
        ("new", "sub/../new"),
        ("new", "dangling"),
        ("dangling", "here/new"),
    ] {
        let mut outputs = Outputs::default();
        let first = outputs.open(&at(one)).unwrap();
        let error = outputs.open(&at(other)).unwrap_err().to_string();
        assert!(error.starts_with("cannot write "), "{error}");
        assert!(error.contains("another output"), "{one}, {other}: {error}");
        // Others are free, and so is the same file for another command.
        assert!(outputs.open(&at("sub/old")).is_ok(), "{one}, {other}");
        drop(first);
        assert!(Outputs::default().open(&at(other)).is_ok());
    }
    assert_eq!(fs::read(at("old")).unwrap(), b"old");
    assert_eq!(names(&at("sub")), [""; 0]);
    let mut outputs = Outputs::default();
    assert!(outputs.open(Path::new("-")).is_ok());
    assert!(outputs.open(Path::new("-")).is_err());
    for _ in 0..2 {
        assert!(outputs.open(Path::new("/dev/null")).is_ok());
    }
}

/// What tells that all files of [`files`] are there.
const LAST: [&str; 2] = ["index.html", SUMS];

/// The files of a run with their manifest; each run has one of its own.
fn files(text: &str) -> BTreeMap<String, Vec<u8>> {
    let own = format!("data/of-{text}.csv");
    let names = ["index.html", "data/a.csv", "data/b.csv", &own];
    let file = |name: &str| (name.to_owned(), text.as_bytes().to_vec());
    let mut files: BTreeMap<_, _> = names.into_iter().map(file).collect();
    let manifest = sums(&files);
    files.insert(SUMS.to_owned(), manifest);
    files
}

#[test]
fn a_folder_gets_all_files_and_keeps_others() {
    let root = folder();
    let out = root.path().join("report");
    OutputFolder::open(&out).unwrap().write(&files("x"), &LAST).unwrap();
    fs::write(out.join("data/mine.csv"), "z").unwrap();
    OutputFolder::open(&out).unwrap().write(&files("y"), &LAST).unwrap();
    let there = |name: &str| fs::read(out.join(name)).unwrap();
    assert_eq!(there("data/a.csv"), b"y");
    assert_eq!(there("index.html"), b"y");
    assert_eq!(there("data/mine.csv"), b"z");
    assert_eq!(names(root.path()), ["report"]);
    assert_eq!(names(&out), [SUMS, "data", "index.html"]);
    assert!(is_whole(&out).unwrap());
    assert!(OutputFolder::open_new(&out).is_err());
    assert_eq!(there("data/b.csv"), b"y");
    assert!(OutputFolder::open_new(&root.path().join("new")).is_ok());
    let nothing = root.path().join("nothing");
    drop(OutputFolder::open(&nothing).unwrap());
    assert!(!nothing.exists());
    // A file in the way is refused, and stays.
    let blocked = root.path().join("blocked");
    fs::write(&blocked, "mine").unwrap();
    assert!(OutputFolder::open(&blocked).is_err());
    assert_eq!(fs::read(&blocked).unwrap(), b"mine");
}

/// The folder holds the files of one run, but for a user's own.
fn holds(out: &Path, text: &str) -> bool {
    let mut found = BTreeMap::new();
    for inner in ["", "data"].into_iter().filter(|i| out.join(i).is_dir()) {
        for name in names(&out.join(inner)) {
            let name =
                if inner.is_empty() { name } else { format!("data/{name}") };
            if !name.starts_with('.') && out.join(&name).is_file() {
                found.insert(name.clone(), fs::read(out.join(name)).unwrap());
            }
        }
    }
    let mine = found.remove("data/mine.csv");
    assert!(mine.is_none_or(|mine| mine == b"z"));
    found == files(text)
}

/// No parts and no marks.
fn is_clean(folder: &Path) -> bool {
    names(folder).iter().all(|name| !name.starts_with('.'))
}

/// Makes what is unfinished look old.
fn aged(out: &Path) {
    let long_ago = std::time::SystemTime::UNIX_EPOCH;
    for name in names(out).iter().filter(|name| name.starts_with('.')) {
        let mut options = File::options();
        options.read(true);
        #[cfg(windows)]
        {
            use std::os::windows::fs::OpenOptionsExt as _;
            // FILE_WRITE_ATTRIBUTES of a folder, FILE_FLAG_BACKUP_SEMANTICS.
            options.access_mode(0x100).custom_flags(0x0200_0000);
        }
        let found = options.open(out.join(name)).unwrap();
        found.set_modified(long_ago).unwrap();
    }
}

const ENOSPC: i32 = 28;

/// Whichever call of the file system fails, with or without those after it,
/// the folder is that of the old run or of the new one, or is refused, and
/// the same command then works at once.
#[test]
fn an_error_at_any_call_leaves_a_whole_folder_or_a_refused_one() {
    let write = |out: &Path, text: &str, new: bool| {
        let open =
            if new { OutputFolder::open_new } else { OutputFolder::open };
        open(out)?.write(&files(text), &LAST)
    };
    let mut marked = 0;
    for new in [false, true] {
        let prepared = || {
            let root = folder();
            let out = root.path().join("report");
            if !new {
                write(&out, "old", false).unwrap();
                fs::write(out.join("data/mine.csv"), "z").unwrap();
            }
            (root, out)
        };
        let (_root, out) = prepared();
        let (done, calls) = faults::with(None, || write(&out, "new", new));
        done.unwrap();
        assert!(holds(&out, "new") && is_clean(&out));
        assert!(calls.len() > 30, "{calls:?}");
        for (after, call) in calls.iter().enumerate() {
            for ongoing in [false, true] {
                let (root, out) = prepared();
                let fault =
                    CallFault { call: None, after, ongoing, code: ENOSPC };
                let (done, _) =
                    faults::with(Some(fault), || write(&out, "new", new));
                let at = format!("{call}, call {after}, new: {new}");
                let empty = !out.exists() || {
                    let own = |name: &String| !name.starts_with('.');
                    !names(&out).iter().any(own)
                };
                match is_whole(&out) {
                    Err(FolderError::Interrupted) => marked += 1,
                    Ok(true) if done.is_ok() => {
                        assert!(holds(&out, "new"), "{at}");
                    }
                    Ok(true) => assert!(
                        holds(&out, "new") || holds(&out, "old"),
                        "{at}"
                    ),
                    Ok(false) => assert!(new && empty, "{at}"),
                    Err(mixed) => panic!("{at}: {mixed}"),
                }
                // Another run: not the same files.
                let again = write(&out, "next", new);
                if new && done.is_ok() {
                    again.unwrap_err();
                    assert!(holds(&out, "new"), "{at}");
                    continue;
                }
                again.unwrap_or_else(|error| panic!("{at}: {error}"));
                assert!(holds(&out, "next") && is_whole(&out).unwrap());
                // A part that was never locked stays for ten seconds.
                aged(&out);
                drop(OutputFolder::open(&out));
                assert!(is_clean(&out), "{at}: {:?}", names(&out));
                assert!(is_clean(root.path()));
            }
        }
    }
    assert!(marked > 20, "{marked}");
}

/// Whichever call fails, a file is the old one or the new one.
#[test]
fn an_error_at_any_call_leaves_the_old_file() {
    let (_, calls) = faults::with(None, || {
        let root = folder();
        write_atomically(&root.path().join("a.csv"), "new").unwrap();
    });
    assert!(calls.len() > 4, "{calls:?}");
    for (after, call) in calls.iter().enumerate() {
        let root = folder();
        let path = root.path().join("a.csv");
        fs::write(&path, "old").unwrap();
        let fault =
            CallFault { call: None, after, ongoing: false, code: ENOSPC };
        let (done, _) =
            faults::with(Some(fault), || write_atomically(&path, "new"));
        let error = done.unwrap_err().to_string();
        assert!(error.starts_with("cannot write "), "{error}");
        assert_eq!(fs::read(&path).unwrap(), b"old", "{call}");
        assert_eq!(names(root.path()), ["a.csv"]);
    }
}

/// Only one file calls the file system to change anything.
#[test]
fn no_call_escapes_the_faults() {
    let changing = [
        "create",
        "write",
        "rename",
        "remove",
        "copy",
        "lock()",
        "set_len",
        "sync_",
        "set_perm",
        "tempdir_in",
        "tempfile_in",
        "persist(",
    ];
    for (name, text) in [
        ("folder.rs", include_str!("folder.rs")),
        ("sums.rs", include_str!("sums.rs")),
        ("unfinished.rs", include_str!("unfinished.rs")),
        ("files.rs", include_str!("../files.rs")),
    ] {
        let is_code = |line: &&str| {
            !["//", "use ", "Sink::Stream", "device"]
                .iter()
                .any(|no| line.contains(no))
        };
        let code = text.lines().filter(is_code);
        for line in code.filter(|line| !line.contains("system::")) {
            let calls = ["fs::", "File::", "builder", "part."];
            let any = calls.iter().any(|call| line.contains(call))
                && changing.iter().any(|call| line.contains(call));
            assert!(!any, "{name}: {line}");
        }
    }
}

/// Cluster file systems often have no locks.
#[test]
fn without_locks_files_and_folders_are_written_all_the_same() {
    for code in if cfg!(windows) { [1, 50, 50] } else { [38, 95, 37] } {
        let none = Some(CallFault {
            call: Some("lock"),
            after: 0,
            ongoing: true,
            code,
        });
        let root = folder();
        let (path, out) = (root.path().join("a.csv"), root.path().join("o"));
        let (done, calls) = faults::with(none, || {
            write_atomically(&path, "new")?;
            OutputFolder::open(&out)?.write(&files("one"), &LAST)?;
            OutputFolder::open(&out)?.write(&files("new"), &LAST)
        });
        done.unwrap();
        assert!(calls.contains(&"lock".to_owned()));
        assert_eq!(fs::read(&path).unwrap(), b"new");
        assert!(holds(&out, "new") && is_whole(&out).unwrap());
        // What may be somebody's stays, and is named.
        let part = killed(&out, "killed");
        let (done, _) = faults::with(none, || OutputFolder::open(&out));
        let error = done.unwrap_err().to_string();
        assert!(error.contains(&*part.to_string_lossy()), "{error}");
        assert!(part.exists());
        assert!(error.ends_with(LOCK), "{error}");
        fs::remove_file(part.join(LOCK)).unwrap();
        // A run that fails tells so itself.
        let rename = CallFault {
            call: Some("rename"),
            after: 2,
            ongoing: false,
            code: 5,
        };
        let (done, _) = faults::with(Some(rename), || {
            OutputFolder::open(&out)?.write(&files("failed"), &LAST)
        });
        let error = done.unwrap_err().to_string();
        assert!(error.contains("is unfinished: the same"), "{error}");
        assert!(is_interrupted(&out));
        let (done, _) = faults::with(none, || {
            OutputFolder::open(&out)?.write(&files("next"), &LAST)
        });
        done.unwrap();
        assert!(holds(&out, "next") && is_whole(&out).unwrap());
    }
    // Another error of a lock is one.
    let broken = Some(CallFault {
        call: Some("lock"),
        after: 0,
        ongoing: true,
        code: 5,
    });
    let root = folder();
    let (done, _) = faults::with(broken, || OutputFolder::open(root.path()));
    assert!(done.is_err());
}

/// What a run leaves that is killed while it puts the files of `text` into
/// place, half of them done.
fn killed(out: &Path, text: &str) -> PathBuf {
    let part = out.join(format!(".rocking-{text}.part"));
    fs::create_dir_all(part.join("files/data")).unwrap();
    fs::write(part.join(LOCK), "locked\n").unwrap();
    let _ = fs::remove_file(out.join("index.html"));
    let mut mark = sums(&files(text));
    mark.extend(fs::read(out.join(SUMS)).unwrap_or_default());
    let _ = fs::remove_file(out.join(SUMS));
    fs::create_dir_all(out.join("data")).unwrap();
    for (name, content) in &files(text) {
        let done = name < &"data/b.csv".to_owned() && name != SUMS;
        let place = if done { out } else { &part.join("files") };
        fs::write(place.join(name), content).unwrap();
    }
    fs::write(part.join(MOVING), mark).unwrap();
    part
}

/// A run that is killed while it puts files into place: no page, and the
/// folder tells; the next run cleans it, at once, but not before it is done.
#[test]
fn a_killed_run_is_no_hindrance() {
    for new in [false, true] {
        let root = folder();
        let out = root.path();
        let open =
            if new { OutputFolder::open_new } else { OutputFolder::open };
        if !new {
            OutputFolder::open(out)
                .unwrap()
                .write(&files("old"), &LAST)
                .unwrap();
        }
        // One that was killed at its work, before any file, and one later.
        let early = out.join(".rocking-early.part");
        fs::create_dir_all(&early).unwrap();
        fs::write(early.join(LOCK), "locked\n").unwrap();
        killed(out, "killed");
        assert!(matches!(is_whole(out), Err(FolderError::Interrupted)));
        let run = open(out).unwrap();
        assert!(!early.exists());
        assert!(is_interrupted(out), "until the next run is done");
        drop(run);
        assert!(is_interrupted(out));
        open(out).unwrap().write(&files("next"), &LAST).unwrap();
        assert!(holds(out, "next") && is_whole(out).unwrap());
        assert!(is_clean(out), "{:?}", names(out));
    }
    // A run that just made its folder has not locked it yet.
    let root = folder();
    let fresh = root.path().join(".rocking-fresh.part");
    fs::create_dir(&fresh).unwrap();
    drop(OutputFolder::open_new(root.path()).unwrap());
    assert!(fresh.exists(), "somebody may just have made it");
    aged(root.path());
    drop(OutputFolder::open_new(root.path()).unwrap());
    assert!(!fresh.exists());
}

#[test]
fn two_runs_do_not_write_into_one_folder_at_once() {
    let root = folder();
    let out = root.path();
    let first = OutputFolder::open_new(out).unwrap();
    let error = OutputFolder::open_new(out).unwrap_err().to_string();
    assert!(error.contains("another run"), "{error}");
    // One that may replace files waits with its files until it puts them.
    let second = OutputFolder::open(out).unwrap();
    let part = names(out).remove(0);
    fs::write(out.join(&part).join(MOVING), "").unwrap();
    assert!(OutputFolder::open(out).is_err());
    fs::remove_file(out.join(&part).join(MOVING)).unwrap();
    second.write(&files("second"), &LAST).unwrap();
    let error = first.write(&files("first"), &LAST).unwrap_err().to_string();
    assert!(error.contains("not empty"), "{error}");
    assert!(holds(out, "second") && is_whole(out).unwrap() && is_clean(out));
}

#[test]
fn a_manifest_names_what_is_not_as_it_says() {
    let root = folder();
    let out = root.path();
    assert!(!is_whole(out).unwrap());
    OutputFolder::open(out).unwrap().write(&files("x"), &LAST).unwrap();
    // As coreutils read it.
    #[cfg(unix)]
    {
        let sha256sum = std::process::Command::new("sha256sum")
            .args(["--check", "--strict", "--quiet", SUMS])
            .current_dir(out)
            .status();
        assert!(sha256sum.is_ok_and(|status| status.success()));
    }
    let said = |words: &str| {
        let error = is_whole(out).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    fs::write(out.join("data/a.csv"), "y").unwrap();
    said(
        "data/a.csv: SHA-256 a1fce4363854ff888cff4b8e7875d600c2682390412a8cf",
    );
    fs::remove_file(out.join("data/a.csv")).unwrap();
    said("(os error 2)");
    let sum = "0".repeat(64);
    for line in [
        format!("{sum}  ../secret"),
        format!("{sum}  /etc/passwd"),
        format!("{sum} a"),
        format!("{sum}  "),
        "0  a".to_owned(),
    ] {
        fs::write(out.join(SUMS), &line).unwrap();
        said(&format!("{SUMS}:1: found {line:?}"));
    }
    // A file that a user changed is nobody's to remove.
    OutputFolder::open(out).unwrap().write(&files("x"), &LAST).unwrap();
    fs::write(out.join("data/of-x.csv"), "mine").unwrap();
    OutputFolder::open(out).unwrap().write(&files("y"), &LAST).unwrap();
    assert_eq!(fs::read(out.join("data/of-x.csv")).unwrap(), b"mine");
    fs::remove_file(out.join("data/of-x.csv")).unwrap();
    assert!(holds(out, "y"));
}
