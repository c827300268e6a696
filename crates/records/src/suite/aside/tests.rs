//! What is set aside is said, and names that results cannot carry are
//! refused.

use std::fs;
use std::path::PathBuf;

use super::*;
use crate::{ReadOptions, Reading, Suite, SuiteError, SuiteMember, Survey};

/// Keeps all of a record.
const KEEP: fn(SuiteMember) -> Result<SuiteMember, SuiteError> = Ok;

/// An AT2 file of this component.
fn at2(component: &str) -> String {
    format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\n\
         Nowhere, 1/1/1900, Station, {component}\n\
         ACCELERATION TIME SERIES IN UNITS OF G\nNPTS= 2, DT= .01 SEC\n\
         \x20  .1000000E-02   .2000000E-02\n"
    )
}

/// A folder of its own, removed with the test.
struct Folder(PathBuf);

impl Folder {
    fn new(name: &str) -> Self {
        let name = format!("rocking-aside-{name}-{}", std::process::id());
        let path = std::env::temp_dir().join(name);
        fs::create_dir_all(&path).unwrap();
        Self(path)
    }

    fn write(&self, name: &str, text: &str) {
        fs::write(self.0.join(name), text).unwrap();
    }

    fn suite(&self) -> Result<Suite, SuiteError> {
        Suite::read(&self.0, &ReadOptions::default())
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = fs::remove_dir_all(&self.0);
    }
}

#[cfg(unix)]
#[test]
fn a_folder_says_what_is_no_record_in_it() {
    let folder = Folder::new("mixed");
    for (name, component) in
        [("a.AT2", "0"), ("b.AT2", "UP"), ("c.AT2", "DWN")]
    {
        folder.write(name, &at2(component));
    }
    folder.write("x\u{1b}[31m.txt", "no record\n");
    folder.write(".hidden", "no record\n");
    fs::create_dir(folder.0.join("sub")).unwrap();
    let link = |to, name| std::os::unix::fs::symlink(to, folder.0.join(name));
    link("nowhere", "dead.AT2").unwrap();
    link("round.AT2", "round.AT2").unwrap();
    link("sub", "also").unwrap();
    let socket = folder.0.join("socket");
    let _open = std::os::unix::net::UnixListener::bind(socket).unwrap();
    let suite = folder.suite().unwrap();
    assert_eq!(suite.members().len(), 1);
    assert_eq!(
        suite.set_aside().to_string(),
        "2 vertical (first: b.AT2), \
         1 in no known format (first: x\\u001b[31m.txt), \
         2 folders that are not entered (first: also), \
         2 links to nothing (first: dead.AT2), \
         1 device or pipe (first: socket)"
    );
    let codes: Vec<_> =
        suite.set_aside().counts().iter().map(|c| c.reason.code()).collect();
    assert_eq!(codes, ["vertical", "format", "folder", "link", "device"]);
    // Nothing else is there: the refusal says what is.
    fs::remove_file(folder.0.join("a.AT2")).unwrap();
    let error = folder.suite().unwrap_err().to_string();
    let words = "expected at least one; set aside: 2 vertical (first: b.AT2),";
    assert!(error.contains(words), "{error}");
}

#[test]
fn of_a_doubled_name_one_file_is_read_and_the_other_reported() {
    let names = ["a.AT2", "b.AT2", "b.AT2"].map(str::to_owned);
    let options = ReadOptions::default();
    let bytes = |_: &str| Ok(at2("90").into_bytes());
    let survey =
        Survey::of_files("z", &names, &Reading::all(&options), bytes, KEEP);
    let suite = survey.unwrap().into_suite().unwrap();
    assert_eq!(suite.members().len(), 2);
    let [count] = suite.set_aside().counts()[..] else { panic!() };
    assert_eq!((count.reason, count.files), (AsideReason::Doubled, 1));
    assert_eq!(count.first, "b.AT2");
}

#[test]
fn files_beside_peers_index_are_reported() {
    let results = "Result ID, Record Sequence Number, \
        Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename\n\
        1, 9001, A000.AT2, A090.AT2\n";
    let folder = Folder::new("peer");
    folder.write("_SearchResults.csv", results);
    for name in ["A000.AT2", "A090.AT2", "A-UP.AT2", "own.AT2"] {
        folder.write(name, &at2("0"));
    }
    let suite = folder.suite().unwrap();
    assert_eq!(suite.both().len(), 1);
    assert_eq!(
        suite.set_aside().to_string(),
        "2 not in the index (first: A-UP.AT2)"
    );
}

#[cfg(unix)]
#[test]
fn names_that_break_a_line_or_compute_are_refused() {
    for name in ["a\nb.AT2", "\u{1b}[31m.AT2", "=1+1.AT2", "@a.AT2", "a.\tA"] {
        let folder = Folder::new("names");
        folder.write(name, &at2("0"));
        let error = folder.suite().unwrap_err();
        assert_eq!(error.code(), "name", "{name:?}");
        let shown = error.to_string();
        assert!(shown.contains("expected no control character"), "{shown}");
        assert!(!shown.contains(char::is_control), "{shown:?}");
    }
    for (head, row) in [
        ("file,dt_s,name", "a,0.01,=1+1"),
        ("file,dt_s,pair", "a,0.01,\u{7}"),
        ("file,dt_s,event", "a,0.01,\"@SUM(A1)\""),
        ("file,dt_s,+event", "a,0.01,x"),
        ("file,dt_s,event", "-a,0.01,x"),
        ("file,dt_s,event", "a,0.01,x\ry"),
        ("file,dt_s,event", "a,0.01,x\u{9b}31m"),
    ] {
        let index = format!("{head}\n{row}\n");
        let options = ReadOptions::default();
        let read = Suite::from_index("i", index.as_bytes(), &options, |_| {
            Ok(b"0\n0.2\n".to_vec())
        });
        let error = read.unwrap_err().to_string();
        assert!(!error.contains(char::is_control), "{error:?}");
        let place = if head.contains('+') { "i:1: " } else { "i:2: " };
        let is_text = error.contains("expected text");
        assert!(is_text || error.starts_with(place), "{error}");
    }
}

/// A download has a folder for each event, whose name precedes those of its
/// records, so that they stay distinct and in order.
#[test]
fn folders_are_read_if_it_is_recursive() {
    let folder = Folder::new("recursive");
    for within in ["2", "10", "10/old", ".hidden"] {
        fs::create_dir_all(folder.0.join(within)).unwrap();
    }
    for (name, text) in [
        ("top.AT2", at2("0")),
        ("2/a.AT2", at2("0")),
        ("2/a-UP.AT2", at2("UP")),
        ("2/b.AT2", at2("90")),
        ("10/a.AT2", at2("0")),
        ("10/old/a.AT2", at2("0")),
        ("10/notes.txt", "read me\n".to_owned()),
        (".hidden/c.AT2", at2("0")),
    ] {
        folder.write(name, &text);
    }
    #[cfg(unix)]
    std::os::unix::fs::symlink(&folder.0, folder.0.join("back")).unwrap();
    let flat = folder.suite().unwrap();
    assert_eq!(flat.members().len(), 1);
    assert_eq!(flat.members()[0].accelerogram.name(), "top");
    let options = ReadOptions { recursive: true, ..ReadOptions::default() };
    let suite = Suite::read(&folder.0, &options).unwrap();
    let members = suite.members().iter();
    let found: Vec<(&str, &str)> =
        members.map(|m| (m.accelerogram.name(), m.file.as_str())).collect();
    let expected = [
        ("10/a", "10/a.AT2"),
        ("10/old/a", "10/old/a.AT2"),
        ("2/a", "2/a.AT2"),
        ("2/b", "2/b.AT2"),
        ("top", "top.AT2"),
    ];
    assert_eq!(found, expected);
    let aside = suite.set_aside().to_string();
    let files = "1 vertical (first: 2/a-UP.AT2), 1 in no known format \
                 (first: 10/notes.txt)";
    assert!(aside.starts_with(files), "{aside}");
    #[cfg(unix)]
    assert!(aside.ends_with("1 folder that is not entered (first: back)"));
}
