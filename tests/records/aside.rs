//! What a suite sets aside is in every result, and no name of a record
//! breaks one.

use std::fs;
use std::io::Write as _;
use std::path::Path;

use super::{AT2, answer, failure, folder, json, run};

const IDA: &str = "ida --alpha 0.1 --p 3 --step-g 0.05 --out ida.csv";

/// A pair, a vertical, and what two networks deliver in formats of their own.
fn mixed(name: &str) -> crate::support::Place {
    let component = |c: &str| AT2.replace("Station, 0", c).into_bytes();
    let (a, b, up) =
        (component("Station, 0"), component("Station, 90"), component("UP"));
    let files: [(&str, &[u8]); 7] = [
        ("A_000.AT2", &a),
        ("A_090.AT2", &b),
        ("A_UP.AT2", &up),
        ("x.txt", b"Turkey\n"),
        ("y.txt", b"Turkey\n"),
        ("z.txt", b"Turkey\n"),
        ("z.V2A", b"New Zealand\n"),
    ];
    let folder = folder(name, &[]);
    fs::create_dir(folder.join("mix")).unwrap();
    for (file, bytes) in files {
        fs::write(folder.join("mix").join(file), bytes).unwrap();
    }
    folder
}

const WORDS: &str =
    "1 vertical (first: A_UP.AT2), 4 in no known format (first: x.txt)";

#[test]
fn what_is_set_aside_is_in_every_result() {
    let folder = mixed("aside");
    let file = fs::File::create(folder.join("mix.zip")).unwrap();
    let mut zip = zip::ZipWriter::new(file);
    for entry in fs::read_dir(folder.join("mix")).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        zip.start_file(name, zip::write::SimpleFileOptions::default())
            .unwrap();
        zip.write_all(&fs::read(&path).unwrap()).unwrap();
    }
    zip.finish().unwrap();
    fs::write(folder.join("blocks.csv"), "alpha,p\n0.1,3\n").unwrap();
    let row = "Files set aside";
    for suite in ["mix", "mix.zip"] {
        let ida = format!("{IDA} --suite {suite}");
        let out = answer(&folder, &ida);
        assert!(out.contains(row), "{out}");
        let found = json(&folder, &format!("{ida} --json"));
        assert_eq!(found["set_aside"]["files"], 5);
        let codes = &found["set_aside"]["codes"];
        let code = |k: usize| (&codes[k]["code"], &codes[k]["files"]);
        assert_eq!(code(0), (&"vertical".into(), &1.into()));
        assert_eq!(code(1), (&"format".into(), &4.into()));
        assert_eq!(codes[1]["first"], "x.txt");
        for (command, words) in [
            (
                format!(
                    "sweep plan --blocks blocks.csv --suite {suite} --out plan"
                ),
                format!("\nset aside: {WORDS}\n"),
            ),
            (format!("suite export --suite {suite} --out out"), row.into()),
        ] {
            let out = answer(&folder, &command);
            assert!(out.contains(&words), "{command}: {out}");
            let _ = fs::remove_dir_all(folder.join("out"));
            let _ = fs::remove_dir_all(folder.join("plan"));
        }
        let cav = format!("capacities --ida ida.csv --suite {suite} --im cav");
        let own = json(&folder, &cav);
        assert_eq!(own["set_aside"], found["set_aside"]);
        for command in [
            ida,
            cav,
            format!("records {suite}"),
            format!("suite export --suite {suite} --out out"),
            format!(
                "sweep plan --blocks blocks.csv --suite {suite} --out out"
            ),
            format!("study --ordinary {suite} --pulse {suite} --out out"),
        ] {
            let strict = format!("{command} --strict");
            let (status, _, error) = run(&folder, &strict);
            let words = format!("rocking: --strict: set aside: {WORDS}");
            assert_eq!(status, 2, "{strict}");
            assert!(error.starts_with(&words), "{strict}: {error}");
            assert!(!folder.join("out").exists(), "{strict}");
        }
    }
    // An index lists what is meant, and no more.
    let index = "file\nA_000.AT2\nA_090.AT2\n";
    fs::write(folder.join("mix/index.csv"), index).unwrap();
    let (status, out, _) =
        run(&folder, &format!("{IDA} --suite mix/index.csv"));
    assert_eq!(status, 0);
    assert!(!out.contains("Set aside by reason"), "{out}");
}

#[cfg(unix)]
#[test]
fn links_to_nothing_and_folders_are_reported() {
    let folder = folder("aside-links", &[]);
    let write = |name: &str| {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, AT2).unwrap();
    };
    for name in ["lp/x.AT2", "dup/a/x.AT2", "dup/b/x.AT2"] {
        write(name);
    }
    std::os::unix::fs::symlink("nowhere", folder.join("lp/d.AT2")).unwrap();
    let ida = format!("{IDA} --suite lp");
    let out = answer(&folder, &ida);
    assert!(out.contains("\nlink      1  d.AT2\n"), "{out}");
    let (_, out, _) = run(&folder, "records lp");
    assert!(out.contains("lp/d.AT2: a link to nothing: expected"), "{out}");
    let error = failure(&folder, "records dup");
    assert_eq!(
        error,
        "rocking: dup: no readable record in it: expected at least one; set \
         aside: 2 folders that are not entered (first: a)\n"
    );
}

#[test]
fn a_name_that_comes_twice_in_a_zip_is_reported() {
    let folder = folder("aside-doubled", &[]);
    let mut bytes = std::io::Cursor::new(Vec::new());
    let mut zip = zip::ZipWriter::new(&mut bytes);
    for (name, pga) in [("A_0", "0.1"), ("B_0", "0.2"), ("C_0", "0.4")] {
        let options = zip::write::SimpleFileOptions::default();
        zip.start_file(format!("{name}.csv"), options).unwrap();
        let text = format!("t_s,a_g\n0,0\n0.1,{pga}\n0.2,0\n");
        zip.write_all(text.as_bytes()).unwrap();
    }
    zip.finish().unwrap();
    // The library writes no name twice: B becomes another A.
    let mut bytes = bytes.into_inner();
    let places: Vec<usize> = (0..bytes.len())
        .filter(|&at| bytes[at..].starts_with(b"B_0."))
        .collect();
    assert_eq!(places.len(), 2, "local head and directory");
    for at in places {
        bytes[at] = b'A';
    }
    fs::write(folder.join("two.zip"), &bytes).unwrap();
    let words = "1 under a repeated name (first: A_0.csv)";
    let out = answer(&folder, "records two.zip");
    assert!(out.contains("doubled"), "{out}");
    // The last one is read, as by what unpacks it.
    let found = json(&folder, "records two.zip --json");
    let pga = |k: usize| found["records"][k]["pga_g"].as_f64().unwrap();
    assert_eq!([pga(0), pga(1)], [0.2, 0.4]);
    let ida = format!("{IDA} --suite two.zip --strict");
    let error = failure(&folder, &ida);
    assert!(error.contains(words), "{error}");
}

/// A folder of one record of this name, and what the program says of it.
fn named(name: &str, command: &str) -> (i32, String, String) {
    let folder = folder("aside-names", &[(name, AT2.as_bytes())]);
    run(&folder, command)
}

#[cfg(unix)]
#[test]
fn a_name_that_breaks_a_line_or_computes_is_refused() {
    let ida = format!("{IDA} --suite .");
    for name in [
        "n\nl.AT2",
        "\u{1b}[31mred.AT2",
        "=HYPERLINK(\"http:__x\").AT2",
        "@SUM(A1).AT2",
        "-1+1.AT2",
        "+a.AT2",
    ] {
        for command in ["records .", &ida] {
            let (status, out, error) = named(name, command);
            assert_eq!((status, out.as_str()), (2, ""), "{name:?}");
            assert_eq!(error.lines().count(), 1, "{error:?}");
            let rest = error.trim_end_matches('\n');
            assert!(!rest.contains(char::is_control), "{error:?}");
            assert!(error.contains("expected no control character"));
        }
    }
    // What is no record is set aside, and its name acts on no terminal.
    let folder = folder(
        "aside-escape",
        &[("a.AT2", AT2.as_bytes()), ("\u{1b}[31m\n.txt", b"no\n")],
    );
    let (status, out, _) = run(&folder, "records .");
    assert!(status == 0 && !out.contains('\u{1b}'), "{out:?}");
    assert!(out.contains("./\\u001b[31m\\u000a.txt"), "{out}");
    let found = json(&folder, "records . --json");
    assert_eq!(found["set_aside"][0]["file"], "./\u{1b}[31m\n.txt");
}

/// The table of an IDA may have been made by hand.
#[test]
fn a_record_of_a_table_has_a_name_that_a_sample_can_hold() {
    let folder = folder("aside-table", &[("a.AT2", AT2.as_bytes())]);
    let run = |command: &str| super::run(&folder, command);
    assert_eq!(run(&format!("{IDA} --suite .")).0, 0);
    let capacities = "capacities --ida ida.csv --levels 1 --at 1 --out c.txt";
    assert_eq!(run(capacities).0, 0);
    let path = folder.join("ida.csv");
    let table = fs::read_to_string(&path).unwrap();
    for name in ["\"a\nb\"", "=1+1"] {
        let changed = table.replace("\na,", &format!("\n{name},"));
        assert_ne!(changed, table);
        fs::write(Path::new(&path), changed).unwrap();
        let (status, _, error) = run(capacities);
        assert_eq!(status, 2, "{name}");
        assert!(error.contains("in column record: expected"), "{error}");
    }
}

/// A zip may hold names that lead out of it: their files are set aside.
#[test]
fn a_file_named_as_outside_its_zip_is_reported() {
    let folder = folder("aside-outside", &[]);
    let file = fs::File::create(folder.join("s.zip")).unwrap();
    let mut zip = zip::ZipWriter::new(file);
    for name in ["a.AT2", "../b.AT2", "in/../../c.AT2", ".hidden/d.AT2"] {
        let options = zip::write::SimpleFileOptions::default();
        zip.start_file(name, options).unwrap();
        zip.write_all(AT2.as_bytes()).unwrap();
    }
    zip.finish().unwrap();
    let found = json(&folder, "records s.zip");
    assert_eq!(found["records"].as_array().unwrap().len(), 1);
    assert_eq!(found["set_aside"][0]["file"], "s.zip/../b.AT2");
    assert_eq!(found["set_aside"].as_array().unwrap().len(), 2);
    assert_eq!(found["set_aside"][1]["code"], "outside");
    let error = failure(&folder, "records s.zip --strict");
    let expected = "rocking: --strict: set aside: 2 with a path outside the \
                    archive (first: ../b.AT2)";
    assert!(error.starts_with(expected), "{error}");
}

/// Downloads of several events are folders in a folder.
#[test]
fn folders_in_a_folder_are_entered_by_an_option() {
    let folder = folder("aside-recursive", &[]);
    for (name, text) in [
        ("s/2011/x.AT2", AT2.replace("Station, 0", "Station, UP")),
        ("s/2010/x.AT2", AT2.to_owned()),
        ("s/2011/b/x.AT2", AT2.to_owned()),
    ] {
        let path = folder.join(name);
        fs::create_dir_all(path.parent().unwrap()).unwrap();
        fs::write(path, text).unwrap();
    }
    let found = json(&folder, &format!("{IDA} --suite s --recursive --json"));
    assert_eq!(found["set_aside"]["codes"][0]["first"], "2011/x.AT2");
    let table = fs::read_to_string(folder.join("ida.csv")).unwrap();
    let names = table.lines().filter(|line| !line.starts_with('#')).skip(1);
    let mut names: Vec<_> =
        names.map(|line| line.split(',').next().unwrap()).collect();
    names.dedup();
    assert_eq!(names, ["2010/x", "2011/b/x"]);
}

/// `--dt` and `--units` serve the files that state none, and a note says
/// how many these are.
#[test]
fn what_is_given_serves_the_files_that_state_none() {
    let folder = folder("aside-given", &[]);
    fs::create_dir(folder.join("s")).unwrap();
    fs::write(folder.join("s/a.AT2"), AT2).unwrap();
    fs::write(folder.join("s/b.txt"), "0.1\n0.2\n-0.3\n0.1\n").unwrap();
    let command = "records s --dt 0.02 --units m/s2 --json";
    let (status, out, notes) = run(&folder, command);
    assert_eq!(status, 0, "{notes}");
    let found: serde_json::Value = serde_json::from_str(&out).unwrap();
    assert_eq!(found["records"][0]["units"], "g");
    assert_eq!(found["records"][1]["units"], "m/s2");
    assert_eq!(found["records"][1]["dt_s"], 0.02);
    assert_eq!(
        notes,
        "rocking: --dt: taken for 1 of 2 records, whose files state no \
         interval\nrocking: --units: taken for 1 of 2 records, whose files \
         state no unit\n"
    );
    // The same of several files.
    let files = command.replace("records s", "records s/a.AT2 s/b.txt");
    let (status, _, same) = run(&folder, &files);
    assert_eq!((status, same), (0, notes));
    fs::remove_file(folder.join("s/b.txt")).unwrap();
    let error = failure(&folder, command);
    let expected = "rocking: s/a.AT2: given unit m/s2: expected g";
    assert!(error.contains(expected), "{error}");
}
