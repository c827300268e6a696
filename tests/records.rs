//! Readers and suites on files: real ones where they are, small ones of our
//! own everywhere.

use std::io::Write as _;
use std::path::PathBuf;

use rocking::units::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
use rocking_common::suites::inputs;
use rocking_records::{ReadOptions, Suite};

use super::support::{self, answer, failure, json, outcome, refused, run};

#[path = "records/aside.rs"]
mod aside;
#[path = "records/export.rs"]
mod export;
#[path = "records/measures.rs"]
mod measures;
#[path = "records/outputs.rs"]
mod outputs;
#[path = "records/paths.rs"]
mod paths;
#[path = "records/processing.rs"]
mod processing;

fn real(index: &str) -> Option<PathBuf> {
    let root = PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../.."));
    let path = root.join("../shared/records").join(index);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: no real records at ../shared/records");
    None
}

fn options() -> ReadOptions {
    ReadOptions::default()
}

#[test]
fn real_suites_meet_their_index() {
    // Reading a suite checks count, PGA and PGV of every file against the
    // index, to 1e-4 relative.
    for (index, pairs) in [("ordinary.csv", 86), ("pulse.csv", 44)] {
        let Some(path) = real(index) else { return };
        let suite = Suite::read(&path, &options()).unwrap();
        assert_eq!(suite.members().len(), 2 * pairs);
        assert_eq!(suite.study_components().count(), pairs);
        assert_eq!(suite.other_components().count(), pairs);
        assert_eq!(suite.both().len(), pairs);
        for member in suite.members() {
            let motion = &member.accelerogram;
            assert!(motion.pga_g() > 0.14, "{}", member.file);
            assert!(motion.pgv_m_s(STANDARD_GRAVITY_M_S2) > 0.0);
            assert!(member.event.is_some());
        }
    }
}

/// A character or a line lost anywhere among the samples of a real
/// fixed-width file is refused; a lost line of any file fails its count.
#[test]
fn real_files_that_lost_something_are_refused() {
    let Some(index) = real("pulse.csv") else { return };
    let root = index.parent().unwrap();
    let text = std::fs::read_to_string(&index).unwrap();
    let mut place = 12_345_usize;
    for row in text.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let bytes = std::fs::read(root.join(cells[0])).unwrap();
        let column = cells[1] == "column";
        let unit = column.then_some(AccelerationUnit::Gravity);
        let dt_s = column.then(|| cells[3].parse().unwrap());
        let options = ReadOptions { dt_s, unit, ..ReadOptions::default() };
        let whole = rocking_records::read("x", &bytes, &options).unwrap();
        let count = whole.accelerogram.samples_g().len();
        let from = bytes.len() / 2;
        for _ in 0..4 {
            place = (place * 1_103 + 12_345) % (bytes.len() - from - 200);
            let at = from + place;
            let mut cut = bytes.clone();
            let lost = cut.remove(at);
            if cells[1] != "column" && !lost.is_ascii_whitespace() {
                let refused = rocking_records::read("x", &cut, &options);
                let error = refused.expect_err(cells[0]);
                assert!(error.line.is_some() && error.column.is_some());
            }
            let start =
                at + bytes[at..].iter().position(|b| *b == b'\n').unwrap();
            let length = bytes[start + 1..]
                .iter()
                .position(|b| *b == b'\n')
                .unwrap_or(0);
            let mut cut = bytes.clone();
            cut.drain(start..=start + length);
            match rocking_records::read("x", &cut, &options) {
                Err(_) => assert_ne!(cells[1], "column"),
                Ok(record) => {
                    assert_eq!(cells[1], "column");
                    let found = record.accelerogram.samples_g().len();
                    assert_eq!(found, count - 1, "{}", cells[0]);
                }
            }
        }
    }
}

const AT2: &str = "PEER NGA STRONG MOTION DATABASE RECORD\n\
    Nowhere, 1/1/1900, Station, 0\n\
    ACCELERATION TIME SERIES IN UNITS OF G\n\
    NPTS=      4, DT=   .0100 SEC\n\
    \x20  .1000000E+00   .2000000E+00  -.3000000E+00   .1000000E+00\n";

/// A fresh folder with the given files.
fn folder(name: &str, files: &[(&str, &[u8])]) -> crate::support::Place {
    let folder = support::folder(&format!("records-{name}"), &[]);
    for (file, bytes) in files {
        std::fs::write(folder.join(file), bytes).unwrap();
    }
    folder
}

#[test]
fn bad_input_gives_one_message_and_status_2() {
    let cut = &AT2[..AT2.len() - 5];
    let nan = AT2.replace("   .2000000E+00", "            NaN");
    let negative = AT2.replace(" .0100", "-.0100");
    let files: [(&str, &[u8]); 7] = [
        ("cut.AT2", cut.as_bytes()),
        ("empty.AT2", b""),
        ("nan.AT2", nan.as_bytes()),
        ("negative.AT2", negative.as_bytes()),
        ("binary", b"\x7fELF\x02\x01\x01\x00"),
        ("column.txt", b"0.1\n0.2\n"),
        ("good.AT2", AT2.as_bytes()),
    ];
    let folder = folder("bad", &files);
    let cases: [(&str, &str); 10] = [
        (
            "cut.AT2",
            "rocking: cut.AT2:5:49: \".1000000\": expected 7 decimals and an exponent of 4 characters, as the file's first number\n",
        ),
        ("empty.AT2", "rocking: empty.AT2: empty file: expected a record\n"),
        (
            "nan.AT2",
            "rocking: nan.AT2:5:28: \"NaN\": expected a finite number\n",
        ),
        (
            "negative.AT2",
            "rocking: negative.AT2:4: sampling interval \"-.0100 SEC\": expected a positive number of seconds\n",
        ),
        ("binary", "rocking: binary: byte 0x02 at offset 4: expected text\n"),
        (
            "column.txt",
            "rocking: column.txt: no sampling interval in the file: expected --dt in s or a column `dt_s` in an index\n",
        ),
        (
            "column.txt --dt -0.01",
            "rocking: column.txt: sampling interval \"-0.01\": expected a positive number of seconds\n",
        ),
        (
            "good.AT2 --gravity -9.81",
            "rocking: good.AT2: gravity -9.81 m/s2: expected a positive number\n",
        ),
        (
            "good.AT2 --dt 0.02",
            "rocking: good.AT2: given sampling interval 0.02 s: expected 0.01 s, as in the file\n",
        ),
        (
            "missing.AT2",
            "rocking: missing.AT2: cannot be read: No such file or directory (os error 2)\n",
        ),
    ];
    for (arguments, expected) in cases {
        let error = refused(&folder, &format!("records {arguments}"));
        assert_eq!(error, expected);
    }
    for arguments in ["--unknown", "good.AT2 --units ft/s2", ""] {
        let error = refused(&folder, &format!("records {arguments}"));
        assert!(error.starts_with("error:"), "{error}");
    }
    // All that can be read is listed before the refusals count.
    let (status, out, error) = run(&folder, "records good.AT2 cut.AT2");
    assert_eq!(status, 2);
    assert!(out.contains("good.AT2  at2 "), "{out}");
    assert_eq!(error.lines().count(), 1);
}

#[test]
fn a_folder_without_records_is_refused() {
    let files: [(&str, &[u8]); 2] =
        [("README", b"About these records.\n"), (".hidden", b"0.1\n")];
    let folder = folder("none", &files);
    let (status, out, error) = run(&folder, "records .");
    assert_eq!(status, 2);
    assert!(out.contains("./README:1: begins with"), "{out}");
    assert_eq!(
        error,
        "rocking: .: no readable record in it: expected at least one; \
         set aside: 1 in no known format (first: README)\n"
    );
}

#[test]
fn a_folder_of_pairs_is_a_suite() {
    let velocity = AT2.replace("ACCELERATION", "VELOCITY");
    let files: [(&str, &[u8]); 5] = [
        ("A_090.AT2", AT2.as_bytes()),
        ("A_000.AT2", AT2.as_bytes()),
        ("B_E.AT2", AT2.as_bytes()),
        ("A_000.VT2", velocity.as_bytes()),
        ("README", b"About these records.\n"),
    ];
    let folder = folder("suite", &files);
    let suite = Suite::read(&folder, &options()).unwrap();
    let study: Vec<_> =
        suite.study_components().map(|m| m.file.as_str()).collect();
    assert_eq!(study, ["A_000.AT2", "B_E.AT2"]);
    assert_eq!(suite.both().len(), 1);
    assert_eq!(suite.set_aside().all().len(), 2);
    assert_eq!(suite.name(), "records-suite");
    let out = answer(&folder, "records ../records-suite");
    assert!(out.contains("the component whose"), "{out}");
    assert!(out.contains("README:1: begins with"), "{out}");
    let json = json(&folder, "records --json .");
    let first = &json["records"][0];
    assert_eq!(first["file"], "A_000.AT2");
    assert_eq!(first["npts"], 4);
    assert_eq!(first["pga_g"], 0.3);
    assert_eq!(first["duration_s"], 0.03);
    assert_eq!(first["pair"], "A");
    assert_eq!(first["study_component"], true);
    // By hand: 0.0015, 0.001, 0 (in g s) times gravity.
    let pgv = first["pgv_m_s"].as_f64().unwrap();
    assert!((pgv - 0.0015 * STANDARD_GRAVITY_M_S2).abs() < 1e-15);
    assert_eq!(json["suites"][0]["pairs"], 1);
    assert_eq!(json["set_aside"].as_array().unwrap().len(), 2);
    assert_eq!(json["refused"].as_array().unwrap().len(), 0);
}

#[test]
fn a_zip_is_read_as_the_folder_in_it() {
    let results = "-- Summary of Metadata of Selected Records --\n\
        Record Sequence Number, Horizontal-1 Acc. Filename, Horizontal-2 Acc. Filename\n\
        9001, A_000.AT2, A_090.AT2\n";
    let up = AT2.replace("Station, 0", "Station, UP");
    let files = [
        ("in/A_000.AT2", AT2),
        ("in/A_090.AT2", AT2),
        ("in/A_UP.AT2", up.as_str()),
        ("in/_SearchResults.csv", results),
        ("__MACOSX/in/._A_000.AT2", "\u{0}"),
    ];
    let folder = folder("zip", &[]);
    let pack = |name: &str, files: &[(&str, &str)]| {
        let file = std::fs::File::create(folder.join(name)).unwrap();
        let mut zip = zip::ZipWriter::new(file);
        for (file, text) in files {
            zip.start_file(*file, zip::write::SimpleFileOptions::default())
                .unwrap();
            zip.write_all(text.as_bytes()).unwrap();
        }
        zip.finish().unwrap();
    };
    pack("peer.zip", &files);
    pack("flat.zip", &files[..3]);
    let read = |name| {
        let path = folder.join(name);
        inputs::read_suite(&path, ReadOptions::default()).unwrap()
    };
    let suite = read("peer.zip");
    assert_eq!(suite.members().len(), 2);
    assert_eq!(suite.members()[0].pair.as_deref(), Some("RSN9001"));
    assert_eq!(suite.name(), "peer");
    let suite = read("flat.zip");
    assert_eq!((suite.both().len(), suite.set_aside().all().len()), (1, 1));
    let whole = std::fs::read(folder.join("peer.zip")).unwrap();
    let half = &whole[..whole.len() / 2];
    std::fs::write(folder.join("half.zip"), half).unwrap();
    let error = refused(&folder, "records half.zip");
    assert_eq!(
        error,
        "rocking: half.zip: cannot be read: the archive is cut: expected a list of its files at its end\n"
    );
    answer(&folder, "records peer.zip --json");
    // A damaged file does not take the room of those after it.
    let mut damaged = std::fs::read(folder.join("flat.zip")).unwrap();
    let name = b"in/A_000.AT2";
    let at = damaged.windows(name.len()).position(|w| w == name).unwrap();
    damaged[at + name.len() + 40] ^= 0xff;
    std::fs::write(folder.join("damaged.zip"), damaged).unwrap();
    let (status, out, error) = run(&folder, "records damaged.zip");
    assert_eq!(status, 2, "{out}");
    assert!(error.contains("A_000.AT2"), "{error}");
    assert!(!error.contains("A_090.AT2") && !error.contains("unpacks"));
    let zeros = "0\n".repeat(1 << 20);
    pack("bomb.zip", &[("a.txt", AT2), ("b.txt", &zeros), ("c.txt", AT2)]);
    let error = failure(&folder, "records bomb.zip");
    assert!(error.contains("b.txt: cannot be read: unpacks to more"));
}
