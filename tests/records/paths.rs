//! Paths in messages, and files whose names or folders are uncommon.

use super::*;

/// An analysis of `suite` into `out`.
fn ida(suite: &str, out: &str) -> String {
    format!(
        "ida --alpha 0.1 --p 3 --step-im 1 --dt 0.01 --units g --suite \
         {suite} --out {out}"
    )
}

#[test]
fn messages_name_the_path_that_was_given() {
    let files: [(&str, &[u8]); 3] = [
        ("bad.txt", b"0.1\n0.2x\n"),
        ("hall_UP.txt", b"0.1\n0.2\n"),
        ("good.txt", b"0.1\n-0.2\n0.1\n"),
    ];
    let folder = folder("paths", &files);
    let error = failure(&folder, &ida("bad.txt", "x.csv"));
    assert_eq!(error, "rocking: bad.txt:2: \"0.2x\": expected a number\n");
    let error = failure(&folder, &ida("hall_UP.txt", "x.csv"));
    assert!(error.starts_with("rocking: hall_UP.txt: no readable"), "{error}");
    let error = failure(&folder, &ida("good.txt", "none/x.csv"));
    assert_eq!(
        error,
        "rocking: cannot write none/x.csv: there is no folder none\n"
    );
    let (status, _, error) = run(&folder, &ida("good.txt", "x.csv"));
    assert_eq!(status, 0, "{error}");
}

#[cfg(unix)]
#[test]
fn a_folder_may_hold_names_that_are_no_utf_8() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt as _;
    let folder = folder("latin-1", &[("B_000.AT2", AT2.as_bytes())]);
    let name = OsStr::from_bytes(b"Montr\xe9al_000.AT2");
    std::fs::write(folder.join(name), AT2).unwrap();
    let suite = Suite::read(&folder, &options()).unwrap();
    let names: Vec<_> =
        suite.members().iter().map(|m| m.accelerogram.name()).collect();
    assert_eq!(names, ["B_000", "Montr\u{fffd}al_000"]);
}

/// The last line of a file need not have an end; what that leaves open is
/// reported, and refused with `--strict`.
#[test]
fn an_open_last_line_is_reported_with_the_results() {
    let open: (&str, &[u8]) = ("hall_NS.txt", b"0.1\n-0.25\n0.125\n0\n0.5");
    let folder = folder("open", &[open]);
    let ida = ida("hall_NS.txt", "x.csv");
    answer(&folder, &ida);
    let error = failure(&folder, &format!("{ida} --strict"));
    assert!(error.contains("last-line 1"), "{error}");
}

/// A record that is named alone is applied, whatever its direction.
#[test]
fn a_vertical_that_is_named_is_reported() {
    let folder = folder("vertical", &[("hall_UD.txt", b"0.1\n-0.2\n0.1\n")]);
    let respond = "respond --alpha 0.1 --p 3 --dt 0.01 --units g --record \
                   hall_UD.txt --strict";
    let error = failure(&folder, respond);
    assert!(error.contains("vertical 1"), "{error}");
}
