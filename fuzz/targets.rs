//! What each fuzz target does with its bytes: read them, and hold what was
//! read to what every reader promises. Also replayed over the corpus, by
//! `cargo test --test gate readers`.

use std::io::Cursor;

use rocking::record::{
    self, Format, ReadOptions, Record, RecordError, Suite, SuiteError,
    SuiteMember,
};
use rocking::units::AccelerationUnit;
use rocking_common::suites::inputs;
use rocking_proof::cases;

/// Accepts the bytes, or says why not.
pub type Target = fn(&[u8]) -> Result<(), String>;

/// Targets by name.
pub const TARGETS: &[(&str, Target)] = &[
    ("afad", |bytes| format(Format::Afad, bytes)),
    ("any", any),
    ("at2", |bytes| format(Format::At2, bytes)),
    ("bri", |bytes| format(Format::Bri, bytes)),
    ("case", case),
    ("column", |bytes| format(Format::Column, bytes)),
    ("cosmos", |bytes| format(Format::Cosmos, bytes)),
    ("counted", |bytes| format(Format::Counted, bytes)),
    ("csv", |bytes| format(Format::Csv, bytes)),
    ("esm", |bytes| format(Format::Esm, bytes)),
    ("geonet", |bytes| format(Format::Geonet, bytes)),
    ("index", index),
    ("knet", |bytes| format(Format::Knet, bytes)),
    ("resorce", |bytes| format(Format::Resorce, bytes)),
    ("smc", |bytes| format(Format::Smc, bytes)),
    ("zip", zip),
];

/// Runs the target `name`.
///
/// # Errors
/// Why the bytes were refused.
pub fn run(name: &str, bytes: &[u8]) -> Result<(), String> {
    let (_, target) = TARGETS
        .iter()
        .find(|(known, _)| *known == name)
        .expect("a target of the table");
    target(bytes)
}

/// One column states neither interval nor unit, a head with a count no unit.
fn options(format: Option<Format>) -> ReadOptions {
    let column = format == Some(Format::Column);
    let unitless = column || format == Some(Format::Counted);
    let unit = unitless.then_some(AccelerationUnit::Gravity);
    let dt_s = column.then_some(0.01);
    ReadOptions { dt_s, unit, ..ReadOptions::default() }
}

fn format(format: Format, bytes: &[u8]) -> Result<(), String> {
    let options = options(Some(format));
    hold(bytes, record::read_as(format, "x", bytes, &options))
}

fn any(bytes: &[u8]) -> Result<(), String> {
    hold(bytes, record::read_all("x", bytes, &options(None)))
}

fn hold(
    bytes: &[u8],
    found: Result<Vec<Record>, RecordError>,
) -> Result<(), String> {
    let records = found.map_err(|error| {
        let lines = bytes.split(|b| *b == b'\n' || *b == b'\r').count();
        assert!(error.line().is_none_or(|line| line <= lines));
        error.to_string()
    })?;
    let mut samples = 0;
    for record in &records {
        let motion = &record.accelerogram;
        assert!(motion.dt_s() > 0.0 && motion.dt_s().is_finite());
        assert!(motion.samples_g().iter().all(|a| a.is_finite()));
        assert!(motion.samples_g().len() >= 2);
        samples += motion.samples_g().len();
    }
    // Every sample was written: with a character for it, at least.
    assert!(!records.is_empty() && samples <= bytes.len());
    let _ = record::remarks(&records[0].accelerogram);
    Ok(())
}

fn index(bytes: &[u8]) -> Result<(), String> {
    let motion = b"0\n0.2\n-0.1\n";
    let options = options(Some(Format::Column));
    let _ = record::is_index(bytes);
    let suite =
        Suite::from_index("x.csv", bytes, &options, |_| Ok(motion.to_vec()));
    hold_suite(suite.map_err(|error| error.to_string())?)
}

fn zip(bytes: &[u8]) -> Result<(), String> {
    let archive = Cursor::new(bytes);
    let survey = inputs::visit_zip(
        "x.zip",
        archive,
        &ReadOptions::default(),
        Ok::<_, SuiteError>,
    );
    let survey = survey.map_err(|error| error.to_string())?;
    let suite = survey.into_suite().map_err(|error| error.to_string())?;
    hold_suite(suite)
}

fn hold_suite(suite: Suite) -> Result<(), String> {
    assert!(!suite.members().is_empty());
    let fine = |m: &SuiteMember| m.accelerogram.samples_g().len() >= 2;
    assert!(suite.members().iter().all(fine));
    for (study, other) in suite.both() {
        assert!(study.study_component && !other.study_component);
    }
    Ok(())
}

fn case(bytes: &[u8]) -> Result<(), String> {
    let text = std::str::from_utf8(bytes).map_err(|e| e.to_string())?;
    let found = cases::load_family("x", text);
    let cases = found.map_err(|error| error.to_string())?;
    assert!(!cases.is_empty());
    Ok(())
}
