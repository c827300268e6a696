//! `rocking records`: what is in record files, and why one is refused.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use indexmap::IndexMap;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::{
    Fallback, Fault, ReadOptions, Reading, RecordError, RemarkInput, SetAside,
    Suite, SuiteError, SuiteMember,
};
use serde::Serialize;

use super::processing::{RecordArgs, words};
use super::shared::{JsonArg, PlotArg};
use crate::failure::Failure;
use measures::{MeasureArgs, RecordMeasures};
use rocking_common::files::Outputs;
use rocking_common::suites::remarks::Remarks;
use rocking_common::suites::{clusters, earthquakes, inputs};

mod measures;

/// List record files: format, interval, length, PGA, PGV, and the reason for a
/// refusal.
#[derive(clap::Args)]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw one record as SVG: acceleration, velocity, displacement and \
     response spectrum"
)))]
#[command(after_help = "Examples:\n  \
    rocking records records/ suite.csv peer.zip\n  \
    rocking records wave.txt --dt 0.01 --units m/s2 --plot wave.svg")]
pub struct RecordsCommand {
    /// Record files, folders or zips of them, or index files (CSV with a
    /// column `file`, or PEER's search results).
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    /// Gravity in m/s2, for records in SI units and for PGV.
    #[arg(long, value_name = "G", default_value_t = STANDARD_GRAVITY_M_S2)]
    gravity: f64,
    #[command(flatten)]
    input: RecordArgs,
    #[command(flatten)]
    measures: MeasureArgs,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    json: JsonArg,
}

/// One record in the list.
struct RecordListing {
    /// Its remarks are those of reading; once all are read, also those on the
    /// samples.
    member: SuiteMember,
    /// Whether it is in a suite, and so may be in a pair.
    in_suite: bool,
}

impl RecordListing {
    fn row(&self, gravity_m_s2: f64) -> RecordRow<'_> {
        let (member, motion) = (&self.member, &self.member.accelerogram);
        RecordRow {
            file: &member.file,
            format: member.format.name,
            units: member.unit.to_string(),
            dt_s: motion.dt_s(),
            npts: motion.samples_g().len(),
            duration_s: motion.duration_s(),
            pga_g: motion.pga_g(),
            pgv_m_s: motion.pgv_m_s(gravity_m_s2),
            pair: member.pair.as_deref(),
            study_component: self.in_suite.then_some(member.study_component),
        }
    }
}

#[derive(Serialize)]
struct RecordRow<'a> {
    file: &'a str,
    format: &'static str,
    units: String,
    dt_s: f64,
    npts: usize,
    duration_s: f64,
    pga_g: f64,
    pgv_m_s: f64,
    pair: Option<&'a str>,
    study_component: Option<bool>,
}

#[derive(Serialize)]
struct SuiteRow {
    suite: String,
    records: usize,
    /// `None` if the index names none.
    earthquakes: Option<usize>,
    pairs: usize,
    study_components: usize,
    study_rule: String,
}

/// A finding on a file: why it was refused or set aside, or a remark.
#[derive(Serialize)]
struct RecordFinding {
    file: String,
    code: &'static str,
    line: Option<usize>,
    message: String,
}

#[derive(Serialize)]
struct RecordsSummary<'a> {
    gravity_m_s2: f64,
    processing: Option<&'a str>,
    suites: &'a [SuiteRow],
    records: Vec<RecordRow<'a>>,
    #[serde(flatten)]
    measured: Option<RecordMeasures>,
    remarks: Vec<RecordFinding>,
    set_aside: Vec<RecordFinding>,
    refused: &'a [RecordFinding],
}

/// Why files were refused: one line a cause, with the number of its files.
fn causes(refused: &[RecordFinding]) -> String {
    let mut causes: IndexMap<_, (&str, usize)> = IndexMap::new();
    for (place, refused) in refused.iter().enumerate() {
        let message = refused.message.as_str();
        let cause = message.strip_prefix(&refused.file);
        let cause = cause.and_then(|cause| cause.strip_prefix(": "));
        // A message that does not begin with its file is its own cause.
        causes.entry(cause.ok_or(place)).or_insert((message, 0)).1 += 1;
    }
    let line = |(message, count): (&str, usize)| match count {
        1 => message.to_owned(),
        2 => format!("{message} (and 1 more file)"),
        n => format!("{message} (and {} more files)", n - 1),
    };
    causes.into_values().map(line).collect::<Vec<_>>().join("\nrocking: ")
}

#[derive(Default)]
struct RecordsListing {
    options: ReadOptions,
    records: Vec<RecordListing>,
    refused: Vec<RecordFinding>,
    /// Files that state another interval or unit than was given.
    contradicted: Vec<RecordError>,
    set_aside: SetAside,
    suites: Vec<SuiteRow>,
    /// The files that were read.
    inputs: Vec<PathBuf>,
}

/// Runs `rocking records`.
///
/// # Errors
/// [`Failure`] with status 2 when any file was refused, after all are
/// listed.
pub fn run_records(args: &RecordsCommand) -> Result<(), Failure> {
    let options = args.input.reading.options(args.gravity);
    let mut listing = RecordsListing { options, ..RecordsListing::default() };
    for path in &args.paths {
        let added = listing.add(path);
        listing.refused.extend(added.err());
    }
    listing.refuse_unused();
    let processing = args.input.processing()?;
    for listed in &mut listing.records {
        let motion = &mut listed.member.accelerogram;
        *motion = processing.apply(motion)?;
    }
    let processing = words(&processing);
    listing.remark();
    let mut outputs = Outputs::of(listing.inputs.clone());
    let plot = args.plot.open(&mut outputs)?;
    let (records, done) = (&listing.records, processing.as_deref());
    if let Some(out) = plot.filter(|_| listing.refused.is_empty()) {
        out.write(measures::svg(records, done, args.gravity)?)?;
        if outputs.take_standard_output() {
            return Ok(());
        }
    }
    let measured = args.measures.run(records, args.gravity)?;
    let mut remarks: Vec<RecordFinding> =
        records.iter().flat_map(RecordFinding::remarks).collect();
    if let Some(measured) = &measured
        && args.input.high_pass.is_none()
    {
        let baseline = done.unwrap_or("no baseline correction");
        remarks.extend(measured.drifts(baseline));
    }
    if args.json.json || !(records.is_empty() && listing.set_aside.is_empty())
    {
        let rows = records.iter().map(|listed| listed.row(args.gravity));
        let set_aside = listing.set_aside.all().iter();
        let aside = listing.set_aside.all().len();
        let sentence = format!(
            "Records: {}; files refused: {}, set aside: {aside}.",
            records.len(),
            listing.refused.len()
        );
        let found = RecordsSummary {
            gravity_m_s2: args.gravity,
            processing: done,
            suites: &listing.suites,
            records: rows.collect(),
            measured,
            remarks,
            set_aside: set_aside
                .map(|aside| RecordFinding {
                    code: aside.reason.code(),
                    ..SuiteError::from(aside.error.clone()).into()
                })
                .collect(),
            refused: &listing.refused,
        };
        args.json.show(&[&sentence], &found)?;
    }
    if !listing.refused.is_empty() {
        return Err(Failure::input(causes(&listing.refused)));
    }
    let all = records.iter().map(|one| RemarkInput::from(&one.member));
    let remarks = Remarks::of(&all.collect::<Vec<_>>());
    args.input.reading.judge(&listing.set_aside, &remarks)
}

impl From<SuiteError> for RecordFinding {
    fn from(error: SuiteError) -> Self {
        Self {
            file: error.file().to_owned(),
            code: error.code(),
            line: error.line(),
            message: error.to_string(),
        }
    }
}

impl RecordFinding {
    fn remarks(listed: &RecordListing) -> impl Iterator<Item = Self> {
        listed.member.remarks.iter().map(|remark| Self {
            file: listed.member.file.clone(),
            code: remark.code(),
            line: None,
            message: remark.to_string(),
        })
    }
}

impl RecordsListing {
    fn add(&mut self, path: &Path) -> Result<(), RecordFinding> {
        self.inputs.push(path.to_owned());
        if path.is_dir() || inputs::is_zip(path) {
            return self.add_survey(path);
        }
        let file = path.display().to_string();
        let bytes =
            rocking_records::file_bytes(path).map_err(SuiteError::from)?;
        if rocking_records::is_index(&bytes) {
            return self.add_survey(path);
        }
        let records = self.read(&file, &bytes, self.options)?;
        let several = records.len() > 1;
        self.records.extend(records.into_iter().map(|record| {
            let file = match record.channel.as_ref().filter(|_| several) {
                Some(channel) => format!("{file}:{channel}"),
                None => file.clone(),
            };
            let member = SuiteMember::of(record, file);
            RecordListing { member, in_suite: false }
        }));
        Ok(())
    }

    /// Reads a file, which keeps the interval and the unit that it states.
    fn read(
        &mut self,
        file: &str,
        bytes: &[u8],
        options: ReadOptions,
    ) -> Result<Vec<rocking_records::Record>, SuiteError> {
        let error = match rocking_records::read_all(file, bytes, &options) {
            Ok(records) => return Ok(records),
            Err(error) => error,
        };
        let options = match &error.fault {
            Fault::IntervalConflict { .. } => {
                ReadOptions { dt_s: None, ..options }
            }
            Fault::UnitConflict { .. } => {
                ReadOptions { unit: None, ..options }
            }
            _ => return Err(error.into()),
        };
        self.contradicted.push(error);
        self.read(file, bytes, options)
    }

    /// Refuses what was given if no file takes it and one contradicts it.
    fn refuse_unused(&mut self) {
        let given = |taken: fn(Fallback) -> bool| {
            self.records.iter().any(|listed| taken(listed.member.given))
        };
        let (dt, unit) = (given(|g| g.dt), given(|g| g.unit));
        self.contradicted.retain(|error| match &error.fault {
            Fault::IntervalConflict { .. } => !dt,
            _ => !unit,
        });
        let unused = std::mem::take(&mut self.contradicted);
        let files: BTreeSet<&str> = unused.iter().map(|e| &*e.file).collect();
        // A file of several components has them behind colons.
        self.records.retain(|listed| {
            let file = listed.member.file.as_str();
            let ends = file.match_indices(':').map(|(end, _)| end);
            let mut ends = ends.chain([file.len()]);
            !ends.any(|end| files.contains(&file[..end]))
        });
        let refused = unused.into_iter().map(SuiteError::from);
        self.refused.extend(refused.map(RecordFinding::from));
    }

    fn add_survey(&mut self, path: &Path) -> Result<(), RecordFinding> {
        let reading = Reading::all(&self.options);
        let survey = inputs::visit(path, &reading, Ok::<_, SuiteError>)?;
        self.set_aside.extend(survey.set_aside.all().iter().cloned());
        if survey.members.iter().all(Result::is_ok) {
            self.add_suite(path, &survey.into_suite()?);
            return Ok(());
        }
        for member in survey.members {
            match member {
                Ok(mut member) => {
                    member.pair = None;
                    let in_suite = false;
                    self.records.push(RecordListing { member, in_suite });
                }
                Err(error) => self.refused.push(error.into()),
            }
        }
        Ok(())
    }

    fn add_suite(&mut self, path: &Path, suite: &Suite) {
        self.inputs.extend(inputs::files(path, suite));
        let members: Vec<_> = suite.members().iter().collect();
        self.suites.push(SuiteRow {
            suite: suite.name().to_owned(),
            records: suite.members().len(),
            earthquakes: earthquakes(&clusters(&members)),
            pairs: suite.both().len(),
            study_components: suite.study_components().count(),
            study_rule: suite.study_rule().to_string(),
        });
        let members = suite.members().iter().cloned();
        let listed = |member| RecordListing { member, in_suite: true };
        self.records.extend(members.map(listed));
    }

    fn remark(&mut self) {
        let records: Vec<_> = self
            .records
            .iter()
            .map(|one| RemarkInput::from(&one.member))
            .collect();
        let found = rocking_records::remarks_together(&records);
        for (listed, remarks) in self.records.iter_mut().zip(found) {
            listed.member.remarks = remarks;
        }
    }
}
