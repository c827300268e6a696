//! Header shapes, with invented numbers, and what must be refused.

use rocking::units::AccelerationUnit;

use super::*;

mod columns;
mod cosmos;
mod counted;
mod directions;
mod nations;
mod networks;

pub(super) use networks::{KNET, smc};

fn options(dt_s: Option<f64>) -> ReadOptions {
    ReadOptions { dt_s, ..ReadOptions::default() }
}

/// Options for a file that states no unit.
fn in_g(dt_s: Option<f64>) -> ReadOptions {
    let unit = Some(AccelerationUnit::Gravity);
    ReadOptions { unit, ..options(dt_s) }
}

fn read_text(text: &str) -> Result<Record, RecordError> {
    read("test", text.as_bytes(), &options(None))
}

fn refusal(text: &str) -> String {
    read_text(text).expect_err("a refusal").to_string()
}

/// Every text is refused with a message that begins so.
#[track_caller]
fn refused_with<T: AsRef<str>>(cases: &[(T, &str)]) {
    for (text, expected) in cases {
        let found = refusal(text.as_ref());
        assert!(found.starts_with(expected), "{found}");
    }
}

const SEVEN: &str = "   .1000000E-02  -.2000000E-02   .3000000E-02   \
    .4000000E-02  -.5000000E-02\n   .6000000E-02   .7000000E-02\n";

fn at2(counting: &str) -> String {
    format!(
        "PEER NGA STRONG MOTION DATABASE RECORD\n\
         Nowhere, 1/1/1900, Station, 90\n\
         ACCELERATION TIME SERIES IN UNITS OF G\n{counting}\n{SEVEN}"
    )
}

#[test]
fn every_generation_of_at2_gives_the_same_record() {
    let counting = [
        "NPTS=      7, DT=   .0100 SEC,   4 POLE @    30.00000 HZ,  -5 POLE @      .05000",
        "NPTS=      7, DT=   .0100 SEC,                                             ",
        "NPTS=      7, DT=   .0100 SEC                                              ",
        "NPTS=      7, DT=  0.01000 SEC",
        "NPTS=     7, DT= .01000 SEC",
        "NPTS=7,DT=.01",
        "NPTS=7,DT=.01SEC",
        "npts=  7, dt= .0100 sec",
        "Npts = 7\tDt = 1.0E-02 s\t",
        "NPTS: 7 DT: 0.01",
        "DT= .0100 SEC, NPTS= 7",
        "    7    0.0100    NPTS, DT",
        "7  .01  npts, dt",
        "  7, .0100, NPTS, DT (SEC)",
        "NPTS=   7, DT=   .0100 SEC, 0 POLE @ 40.0 HZ, -5 POLE @ .05 HZ, ACAUSAL",
    ];
    for line in counting {
        let unix = at2(line);
        for text in [unix.replace('\n', "\r\n"), unix.clone()] {
            let record = read_text(&text).expect(line);
            let motion = &record.accelerogram;
            assert_eq!(record.format.name, "at2");
            assert_eq!(motion.dt_s(), 0.01, "{line}");
            assert_eq!(motion.samples_g().len(), 7);
            assert_eq!(motion.samples_g()[1], -0.002);
            assert_eq!(motion.pga_g(), 0.007);
        }
    }
}

const HEAD: &str = "PEER STRONG MOTION DATABASE RECORD. PROCESSING BY X.\n\
    NOWHERE 01/01/00 0000, STATION, 0\n\
    ACCELERATION TIME HISTORY IN UNITS OF G. FILTER POINTS: HP=0.1 Hz\n";

fn body(count: usize, lines: &str) -> String {
    format!("{HEAD}NPTS= {count}, DT= .02000 SEC\n{lines}\n")
}

const GLUED: &str = "-0.12000000E+00-0.34000000E+00 0.56000000E-01\n\
    \x200.10000000E+00-0.20000000E-02-0.30000000E-02\n\
    \x200.70000000E-03";

#[test]
fn glued_numbers_read_by_field_width() {
    let record = read_text(&body(7, GLUED)).unwrap();
    assert_eq!(
        record.accelerogram.samples_g(),
        [-0.12, -0.34, 0.056, 0.1, -0.002, -0.003, 0.0007]
    );
    // Fortran drops the letter where the exponent needs three digits.
    let tiny = GLUED.replace("0.70000000E-03", "0.70000000-103");
    let record = read_text(&body(7, &tiny)).unwrap();
    assert_eq!(record.accelerogram.samples_g()[6], 0.7e-103);
    let free = "1.2E-01-3.4E-01\t5.6E-01,7.8E-01\n1.0E-01";
    let record = read_text(&body(5, free)).unwrap();
    assert_eq!(
        record.accelerogram.samples_g(),
        [0.12, -0.34, 0.56, 0.78, 0.1]
    );
}

#[test]
fn a_changed_number_is_refused_with_line_and_column() {
    let cases = [
        // A digit lost, the rest of the line out of step.
        (
            GLUED.replace("0.56000000E-01", "0.5600000E-01"),
            "test:5:32: \"0.5600000E-01\": expected a number of 15 characters",
        ),
        // A digit lost, a blank put before.
        (
            GLUED.replace("-0.34000000E+00", " -0.3400000E+00"),
            "test:5:17: \"-0.3400000E+00\": expected 8 decimals and an exponent of 4 characters, as the file's first number",
        ),
        // A digit blanked.
        (
            GLUED.replace("-0.30000000E-02", "-0.3000 000E-02"),
            "test:6:31: \"-0.3000 000E-02\": expected a number of 15 characters",
        ),
        // A letter.
        (
            GLUED.replace("-0.30000000E-02", "-0.30000O00E-02"),
            "test:6:31: \"-0.30000O00E-02\": expected a number of 15 characters",
        ),
        // A number too many.
        (
            GLUED.replace("-0.30000000E-02", "-0.30000000E-02 1"),
            "test:6:46: \"1\": expected 3 numbers of 15 characters a line",
        ),
        // A number missing before the last line.
        (
            GLUED.replace("-0.30000000E-02", ""),
            "test:6:31: \"\": expected a number of 15 characters",
        ),
        // The last number cut.
        (
            GLUED.replace("0.70000000E-03", "0.70000000E-0"),
            "test:7:2: \"0.70000000E-0\": expected a number of 15 characters",
        ),
        (
            GLUED.replace(" 0.70000000E-03", "            NaN"),
            "test:7:13: \"NaN\": expected a finite number",
        ),
        (
            GLUED.replace("0.70000000E-03", "0.70000000E999"),
            "test:7:2: \"0.70000000E999\": expected a finite number",
        ),
    ];
    for (lines, expected) in cases {
        let found = refusal(&body(7, &lines));
        assert_eq!(found, expected);
    }
}

#[test]
fn a_changed_count_is_refused() {
    assert_eq!(
        refusal(&body(8, GLUED)),
        "test:7: 7 samples: expected 8, as in the file"
    );
    assert_eq!(
        refusal(&body(6, GLUED)),
        "test:7: 7 samples: expected 6, as in the file"
    );
    let dropped: Vec<&str> = GLUED.lines().skip(1).collect();
    assert_eq!(
        refusal(&body(7, &dropped.join("\n"))),
        "test:6: 4 samples: expected 7, as in the file"
    );
}

#[test]
fn at2_headers_that_say_too_little_are_refused() {
    let cases = [
        ("NPTS= 7", "no sampling interval in the file"),
        ("NPTS= 7, DT= -.01 SEC", "\"-.01 SEC\": expected a positive"),
        ("NPTS= 7, DT= 0 SEC", "\"0 SEC\": expected a positive"),
        ("NPTS= 7, DT= NaN SEC", "\"NaN SEC\": expected a positive"),
        ("NPTS= 7, DT= 10 MSEC", "\"10 MSEC\": expected a positive"),
        ("NPTS= 7, DT=", "\"\": expected a positive"),
        ("NPTS= , DT= .01", "expected a line like `NPTS= 4096"),
        ("NPTS= -7, DT= .01", "\"-7, DT= .01\": expected a number of"),
        ("NPTS= 7.5, DT= .01", "\"7.5, DT= .01\": expected a number of"),
        ("NPTS= 7x, DT= .01", "expected a number of samples"),
        ("NPTS= 99999999999999999999999, DT= .01", "a number of samples"),
    ];
    for (line, expected) in cases {
        let found = refusal(&at2(line));
        assert!(found.contains(expected), "{line}: {found}");
        assert!(found.starts_with("test"), "{found}");
    }
    let line = "NPTS= 7, DT= .01 SEC";
    let unit = |unit| at2(line).replace("UNITS OF G", unit);
    assert!(
        refusal(&unit("UNITS OF FURLONG")).contains(
            "test:3:38: unit \"FURLONG\": expected g, m/s2 or cm/s2"
        )
    );
    let velocity = at2(line).replace("ACCELERATION", "VELOCITY");
    assert!(refusal(&velocity).contains("expected an acceleration history"));
    let gal = read_text(&unit("UNITS OF CM/SEC/SEC")).unwrap();
    assert_eq!(gal.unit, AccelerationUnit::CentimetrePerSecondSquared);
    assert_eq!(gal.accelerogram.pga_g(), 0.007 / 980.665);
    let head = "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere\n";
    assert!(
        refusal(head).contains("test:2: the file ends: expected a line like")
    );
}

/// Words for the unit that other programs than PEER's write, and a word
/// behind the samples.
#[test]
fn at2_of_other_programs_is_read() {
    let line = "NPTS= 7, DT= .01 SEC";
    let headed = |head: &str| {
        at2(line).replace("ACCELERATION TIME SERIES IN UNITS OF G", head)
    };
    use AccelerationUnit as U;
    for (head, unit) in [
        ("ACCELERATION IN G", U::Gravity),
        ("File Type: Accelerations (g)", U::Gravity),
        ("The units are (g)", U::Gravity),
        ("ACCELERATION IN CM/S/S.", U::CentimetrePerSecondSquared),
        ("Acc. [m/s2]", U::MetrePerSecondSquared),
    ] {
        let record = read_text(&headed(head)).expect(head);
        assert_eq!(record.unit, unit, "{head}");
    }
    for head in ["VELOCITY IN CM/SEC", "Displacements", "DISPLACEMENT (cm)"] {
        let text = headed(head);
        let given = read("test", text.as_bytes(), &in_g(None));
        let quantity = "test:3: \"";
        match head {
            "Displacements" => assert!(given.is_ok(), "{head}"),
            _ => assert!(given.unwrap_err().to_string().starts_with(quantity)),
        }
    }
    for head in ["ACCELERATION IN THE BASIN", "ACCELERATION"] {
        assert!(refusal(&headed(head)).starts_with("test: no unit in the"));
    }
    let ended = format!("{}*** End Data ***\n\n", at2(line));
    assert_eq!(read_text(&ended), read_text(&at2(line)));
    // The count holds the file to its samples, at their own place.
    let short = ended.replace("NPTS= 7", "NPTS= 8");
    assert_eq!(
        refusal(&short),
        "test:6: 7 samples: expected 8, as in the file"
    );
    let more = ended.replace("*** End", "   .1000000E-02\n*** End");
    assert!(read_text(&more).is_err());
}

#[test]
fn what_the_file_states_cannot_be_overruled() {
    let text = at2("NPTS= 7, DT= .01 SEC");
    let refused = |options: ReadOptions| {
        read("test", text.as_bytes(), &options).unwrap_err().to_string()
    };
    assert_eq!(
        refused(options(Some(0.02))),
        "test: given sampling interval 0.02 s: expected 0.01 s, as in the file"
    );
    assert!(read("test", text.as_bytes(), &options(Some(0.01))).is_ok());
    for dt_s in [-0.01, 0.0, f64::NAN, f64::INFINITY] {
        assert!(refused(options(Some(dt_s))).contains("a positive number of"));
    }
    let unit = Some(AccelerationUnit::MetrePerSecondSquared);
    assert_eq!(
        refused(ReadOptions { unit, ..options(None) }),
        "test: given unit m/s2: expected g, as in the file"
    );
    for gravity_m_s2 in [0.0, -9.81, f64::NAN, f64::INFINITY] {
        let options = ReadOptions { gravity_m_s2, ..options(None) };
        assert!(refused(options).contains("gravity"));
    }
}

const RESORCE: &str = "Event Date & Time             : 1900-01-01 00:00:00\n\
    Station Code / Name           : 1 / Nowhere\n\
    Time Increment (s)            : 0.005\n\
    Number of Data                : 6\n\
    PGA (m/s/s)                   : 1.9613300E+00\n\
    Accelaration time series in m/s/s\n\
    -1.2000000E-04-1.3000000E-04 1.4000000E-04-1.9613300E+00 1.6000000E-04\n\
    \x20 1.7000000E-04\n";

#[test]
fn resorce_reads_glued_numbers() {
    let text = RESORCE.replace("  1.7", " 1.7");
    let record = read_text(&text).unwrap();
    assert_eq!(record.format.name, "resorce");
    assert_eq!(record.accelerogram.dt_s(), 0.005);
    assert_eq!(record.accelerogram.samples_g().len(), 6);
    assert!((record.accelerogram.pga_g() - 0.2).abs() < 1e-15);
    let cases = [
        // One blank too many before the last number.
        (RESORCE.to_owned(), "test:8:3: \"1.7000000E-0\": expected"),
        (
            text.replace("-1.3000000E-04", "-1.3000000E-4"),
            "test:7:15: \"-1.3000000E-4\": expected a number of 14",
        ),
        (text.replace(": 6", ": 7"), "test:8: 6 samples: expected 7"),
        (
            text.replace("-1.9613300E+00", "-1.8613300E+00"),
            "test:8: largest absolute sample 1.86133 m/s2: expected 1.96133",
        ),
        (text.replace("in m/s/s", "in mm"), "test:6: unit \"mm\": expected"),
        (
            text.replace("Accelaration", "Velocity"),
            "test:6: \"Velocity time series in m/s/s\": expected an",
        ),
        (text.replace(": 0.005", ": -0.005"), "test:3: \"Time Increment (s)"),
    ];
    refused_with(&cases);
    let negative = text.replace("-1.9613300E+00", "-1.9613300E-00");
    assert!(read_text(&negative).is_ok());
}

#[test]
fn what_is_no_record_is_refused() {
    assert_eq!(refusal(""), "test: empty file: expected a record");
    assert_eq!(refusal(" \r\n\t\n"), "test: empty file: expected a record");
    assert_eq!(
        refusal("PK\u{3}\u{4}"),
        "test: byte 0x03 at offset 2: expected text"
    );
    assert!(refusal("Once upon a time\n").starts_with(
        "test:1: begins with \"Once upon a time\": expected a record in"
    ));
    assert!(refusal("1 2 3\n4 5 6\n").contains("expected a record in"));
    let latin1 = b"0.1\n\xe9\n";
    let error = read("test", latin1, &in_g(Some(0.1))).unwrap_err();
    assert_eq!(error.to_string(), "test:2: \"\u{e9}\": expected a number");
    assert_eq!(error.line, Some(2));
    assert_eq!(error.column, None);
}

/// Windows programs save text in UTF-16 too.
#[test]
fn utf_16_is_read_with_its_mark_and_named_without() {
    let text = at2("NPTS= 7, DT= .01 SEC");
    let units = |big: bool| -> Vec<u8> {
        let bytes = |unit: u16| match big {
            true => unit.to_be_bytes(),
            false => unit.to_le_bytes(),
        };
        text.encode_utf16().flat_map(bytes).collect()
    };
    let plain = read_text(&text).unwrap();
    for (mark, big) in [([0xff, 0xfe], false), ([0xfe, 0xff], true)] {
        let marked = [&mark[..], &units(big)].concat();
        let refused = |bytes: &[u8]| {
            read("test", bytes, &options(None)).unwrap_err().to_string()
        };
        assert_eq!(read("test", &marked, &options(None)), Ok(plain.clone()));
        assert_eq!(
            refused(&units(big)),
            "test: text in UTF-16 with no byte order mark: expected UTF-8"
        );
        assert_eq!(
            refused(&marked[..marked.len() - 1]),
            "test: text in UTF-16 with half a character at the end: expected UTF-8"
        );
        assert!(refused(&marked[..90]).contains("the file ends"));
        let lone = [&marked[..], &[0xd8; 2]].concat();
        assert!(refused(&lone).contains("half a pair of surrogates"));
        let binary = [&mark[..], &[0; 40]].concat();
        assert!(refused(&binary).contains("byte 0x00 at offset 2"));
    }
}

/// An interval far from every recorder's is refused where it is read: an
/// analysis of it would not end.
#[test]
fn an_interval_that_no_record_has_is_refused() {
    for dt in ["1e300", "1e-300", "11", "9e-7"] {
        let text = at2(&format!("NPTS= 7, DT= {dt} SEC"));
        let found = refusal(&text);
        let expected = format!("test: sampling interval {dt}");
        assert!(found.starts_with(&expected), "{found}");
        assert!(found.contains(" s: expected 1e-6 to 10 s"), "{found}");
        let column = "0.1\n-0.2\n0.3\n".as_bytes();
        let given = in_g(Some(dt.parse().unwrap()));
        let error = read("test", column, &given).unwrap_err();
        assert_eq!(error.fault.code(), "interval-range");
    }
    for dt in ["10", "1e-6"] {
        assert!(read_text(&at2(&format!("NPTS= 7, DT= {dt} SEC"))).is_ok());
    }
}
