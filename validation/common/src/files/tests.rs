//! Places of every kind, killed runs, and what must stay as it was.

use std::collections::BTreeMap;

use tempfile::TempDir;

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
    for name in [&input, &again, &root.path().join("./in.csv")] {
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

fn files(text: &str) -> BTreeMap<String, Vec<u8>> {
    let names = ["index.html", "data/a.csv", "data/b.csv"];
    let file = |name: &str| (name.to_owned(), text.as_bytes().to_vec());
    names.into_iter().map(file).collect()
}

#[test]
fn a_folder_gets_all_files_and_keeps_others() {
    let root = folder();
    let out = root.path().join("report");
    Folder::open(&out).unwrap().write(&files("x"), "index.html").unwrap();
    fs::write(out.join("data/mine.csv"), "z").unwrap();
    Folder::open(&out).unwrap().write(&files("y"), "index.html").unwrap();
    let there = |name: &str| fs::read(out.join(name)).unwrap();
    assert_eq!(there("data/a.csv"), b"y");
    assert_eq!(there("index.html"), b"y");
    assert_eq!(there("data/mine.csv"), b"z");
    assert_eq!(names(root.path()), ["report"]);
    assert_eq!(names(&out), ["data", "index.html"]);
    assert!(Folder::open_new(&out).is_err());
    assert!(Folder::open_new(&root.path().join("new")).is_ok());
    let nothing = root.path().join("nothing");
    drop(Folder::open(&nothing).unwrap());
    assert!(!nothing.exists());
    // A file in the way is refused, and stays.
    let blocked = root.path().join("blocked");
    fs::write(&blocked, "mine").unwrap();
    assert!(Folder::open(&blocked).is_err());
    assert_eq!(fs::read(&blocked).unwrap(), b"mine");
}

/// A run that is killed while it puts files into place: no page, and the
/// folder tells; the next run cleans it.
#[test]
fn an_interrupted_folder_tells() {
    let root = folder();
    let out = root.path();
    Folder::open(out).unwrap().write(&files("old"), "index.html").unwrap();
    let mut run = Folder::open(out).unwrap();
    run.fill(&files("new")).unwrap();
    fs::create_dir(out.join("data/b.csv.d")).unwrap();
    // The second rename fails, as a full disk or a signal would end it.
    fs::remove_file(out.join("data/b.csv")).unwrap();
    fs::create_dir_all(out.join("data/b.csv/full")).unwrap();
    assert!(run.put(&files("new"), "index.html").is_err());
    assert!(!out.join("index.html").exists());
    assert!(is_interrupted(out));
    let (part, lock) = run.part.take().unwrap();
    let part = part.keep();
    remove_left_behind(out);
    assert!(part.exists(), "somebody may just have made it");
    let long_ago = std::time::SystemTime::UNIX_EPOCH;
    File::open(&part).unwrap().set_modified(long_ago).unwrap();
    remove_left_behind(out);
    assert!(part.exists(), "its owner holds the lock");
    drop(lock);
    // A process that another test starts holds the lock until it runs.
    let is_gone = || {
        remove_left_behind(out);
        std::thread::sleep(std::time::Duration::from_millis(10));
        !part.exists()
    };
    assert!((0..500).any(|_| is_gone()));
}
