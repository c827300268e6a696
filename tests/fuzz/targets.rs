//! What each fuzz target does with its bytes: read them, and hold what was
//! read to what every reader promises. Each has a folder of its name in
//! `corpus`, which `cargo test --test gate readers` replays.

use std::collections::BTreeSet;
use std::io::Cursor;
use std::path::Path;

use rocking::units::AccelerationUnit;
use rocking_cli::cli::fragility::counts;
use rocking_cli::cli::{blocks, floors};
use rocking_common::suites::inputs;
use rocking_exchange::ida::IdaTable;
use rocking_exchange::sample::SampleFile;
use rocking_procedures::fragility::hazard::{Hazard, HazardOptions, Site};
use rocking_proof::cases;
use rocking_records::intensity::Intensity;
use rocking_records::{
    Format, Header, ReadOptions, Reading, Record, RecordError, Suite,
    SuiteError, SuiteMember, read_all, read_as,
};
use rocking_score::Answers;
use rocking_statistics::Lognormal;

/// Accepts the bytes, or says why not.
pub type Target = fn(&[u8]) -> Result<(), String>;

/// Targets by name, beside the formats of records.
const OTHERS: &[(&str, Target)] = &[
    ("answers", answers),
    ("any", any),
    ("blocks", blocks),
    ("case", case),
    ("counts", counts),
    ("floors", floors),
    ("hazard", hazard),
    ("ida", ida),
    ("index", index),
    ("sample", sample),
    ("zip", zip),
];

/// Names of all targets: the formats of records, and the others.
pub fn names() -> impl Iterator<Item = &'static str> {
    let formats = Format::ALL.iter().map(|format| format.name);
    formats.chain(OTHERS.iter().map(|(name, _)| *name))
}

/// Runs the target `name`.
///
/// # Errors
/// Why the bytes were refused.
pub fn run(name: &str, bytes: &[u8]) -> Result<(), String> {
    if let Some(format) = Format::named(name) {
        let options = options(format);
        return hold(bytes, read_as(format, "x", bytes, &options));
    }
    let mut others = OTHERS.iter();
    let (_, target) = others.find(|other| other.0 == name).expect("a target");
    target(bytes)
}

/// What a file of this format does not state.
pub fn options(format: &Format) -> ReadOptions {
    let missing = format.header == Header::Missing;
    let no_unit = missing || format.header == Header::NoUnit;
    let unit = no_unit.then_some(AccelerationUnit::Gravity);
    let dt_s = missing.then_some(0.01);
    ReadOptions { dt_s, unit, ..ReadOptions::default() }
}

fn any(bytes: &[u8]) -> Result<(), String> {
    hold(bytes, read_all("x", bytes, &ReadOptions::default()))
}

fn hold(
    bytes: &[u8],
    found: Result<Vec<Record>, RecordError>,
) -> Result<(), String> {
    let records = found.map_err(|error| {
        let lines = bytes.split(|b| *b == b'\n' || *b == b'\r').count();
        assert!(error.line.is_none_or(|line| line <= lines));
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
    let _ = rocking_records::remarks(&records[0].accelerogram);
    Ok(())
}

fn index(bytes: &[u8]) -> Result<(), String> {
    let motion = b"0\n0.2\n-0.1\n";
    let column = Format::named("column").expect("a format");
    let options = options(column);
    let _ = rocking_records::is_index(bytes);
    let suite =
        Suite::from_index("x.csv", bytes, &options, |_| Ok(motion.to_vec()));
    hold_suite(suite.map_err(|error| error.to_string())?)
}

fn zip(bytes: &[u8]) -> Result<(), String> {
    let archive = Cursor::new(bytes);
    let survey = inputs::visit_zip(
        "x.zip",
        archive,
        &Reading::all(&ReadOptions::default()),
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

fn text(bytes: &[u8]) -> Result<&str, String> {
    std::str::from_utf8(bytes).map_err(|error| error.to_string())
}

/// Named in messages.
fn file() -> &'static Path {
    Path::new("x.csv")
}

fn hazard(bytes: &[u8]) -> Result<(), String> {
    let text = text(bytes)?;
    let site = text.contains("custom_site_id").then(|| Site::Id("S1".into()));
    let options = HazardOptions { years: Some(50.0), site };
    let found = Hazard::parse("x.csv", text, &options);
    let curve = found.map_err(|error| error.to_string())?.curve;
    let (im, most) = curve.points()[0];
    for shift in [0.0, 0.5, 1.0] {
        // Where the curve begins, or above.
        let law = Lognormal::try_new(shift, 0.0, 0.5);
        let law = law.and_then(|law| law.scaled(im));
        let law = law.map_err(|error| error.to_string())?;
        let found = curve.annual_frequency(law);
        let (low, high) = (found.truncation_lower, found.truncation_upper);
        assert!(low >= 0.0 && low <= high, "{low} {high}");
        assert!(high <= most * (1.0 + 1e-9), "{high} {most}");
        let parts = curve.contributions(law);
        assert_eq!(parts.len() + 1, curve.points().len());
    }
    Ok(())
}

fn blocks(bytes: &[u8]) -> Result<(), String> {
    let rows = blocks::parse(bytes, file(), 9.81);
    let rows = rows.map_err(|failure| failure.message)?;
    assert!(!rows.is_empty());
    let ids: BTreeSet<_> = rows.iter().map(|row| &row.id).collect();
    assert_eq!(ids.len(), rows.len());
    for row in &rows {
        assert!(!row.label.is_empty());
        let alpha = row.block.slenderness_rad();
        assert!(alpha > 0.0 && alpha < std::f64::consts::FRAC_PI_2);
        assert!(row.cells.friction.is_none_or(|x| x > 0.0 && x.is_finite()));
    }
    Ok(())
}

fn floors(bytes: &[u8]) -> Result<(), String> {
    let found = floors::parse(bytes, file());
    let found = found.map_err(|failure| failure.message)?;
    assert!(!found.is_empty());
    Ok(())
}

fn counts(bytes: &[u8]) -> Result<(), String> {
    let found = counts::parse(bytes, file());
    let found = found.map_err(|error| error.to_string())?;
    for stripe in found.stripes().unwrap_or_default().iter() {
        assert!(stripe.im.is_finite());
    }
    Ok(())
}

fn sample(bytes: &[u8]) -> Result<(), String> {
    let file = SampleFile::parse(text(bytes)?, file());
    let file = file.map_err(|error| error.to_string())?;
    assert!(file.values().iter().all(|x| !x.is_nan()));
    assert_eq!(file.clusters().records(), file.values().len());
    let sample = file.censored().map_err(|error| error.to_string())?;
    assert_eq!(sample.len(), file.values().len());
    Ok(())
}

fn answers(bytes: &[u8]) -> Result<(), String> {
    let read = |text: &str| Answers::parse(text, file());
    let found = read(text(bytes)?).map_err(|error| error.to_string())?;
    assert_eq!(read(&found.csv()), Ok(found));
    Ok(())
}

fn ida(bytes: &[u8]) -> Result<(), String> {
    let table = IdaTable::read(bytes, file());
    let table = table.map_err(|error| error.to_string())?;
    let again = IdaTable::read(table.csv().as_bytes(), file());
    // A margin that is not known is not equal to itself.
    if table.rows.iter().all(|row| !row.margin.is_nan()) {
        assert_eq!(again.as_ref(), Ok(&table));
    }
    for im in Intensity::ALL {
        let curves = table
            .curves(im)
            .map_err(|(record, error)| format!("record {record}: {error}"))?;
        assert_eq!(curves.curves.len(), table.records().count());
    }
    Ok(())
}

fn case(bytes: &[u8]) -> Result<(), String> {
    let text = text(bytes)?;
    let found = cases::load_family("x", text);
    let cases = found.map_err(|error| error.to_string())?;
    assert!(!cases.is_empty());
    Ok(())
}
