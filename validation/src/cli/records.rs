//! `rocking records`: what is in record files, and why one is refused.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rocking::record::{
    self, Aside, Format, ReadOptions, RecordError, Remark, Remarked, SetAside,
    Suite, SuiteMember,
};
use rocking::units::{AccelerationUnit, STANDARD_GRAVITY_M_S2};
use serde_json::{Value, json};

use super::processing::{ProcessingArgs, words};
use super::reading::ReadArgs;
use super::{Failure, print, print_json};
use measures::{Found, MeasureArgs};
use rocking_common::files::Outputs;
use rocking_common::suites::inputs;
use rocking_common::suites::remarks::Remarks;

mod measures;
mod plot;

/// List record files: format, interval, length, PGA, PGV; say why one is
/// refused.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking records records/ suite.csv peer.zip\n  \
    rocking records wave.txt --dt 0.01 --units m/s2 --plot wave.svg")]
pub struct Args {
    /// Record files, folders or zips of them, or index files (CSV with a
    /// column `file`, or PEER's search results).
    #[arg(required = true)]
    paths: Vec<PathBuf>,
    #[command(flatten)]
    reading: ReadArgs,
    /// Gravity in m/s2, for records in SI units and for PGV.
    #[arg(long, value_name = "G", default_value_t = STANDARD_GRAVITY_M_S2)]
    gravity: f64,
    #[command(flatten)]
    processing: ProcessingArgs,
    #[command(flatten)]
    measures: MeasureArgs,
    /// Draw one record as SVG: acceleration, velocity, displacement and
    /// response spectrum.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// JSON for machines.
    #[arg(long)]
    json: bool,
}

/// One record in the list.
struct Listed {
    file: String,
    format: Format,
    unit: AccelerationUnit,
    motion: record::Accelerogram,
    /// Pair and whether the study uses this component, in a suite.
    place: Option<(Option<String>, bool)>,
    /// What reading found; with what the samples show, once all are read.
    remarks: Vec<Remark>,
}

impl Listed {
    fn pair(&self) -> Option<&str> {
        self.place.as_ref().and_then(|(pair, _)| pair.as_deref())
    }

    fn remarked(&self) -> Remarked<'_> {
        let (record, pair) = (&self.motion, self.pair());
        Remarked { record, pair, read: &self.remarks }
    }

    fn member(member: &SuiteMember, in_suite: bool) -> Self {
        Self {
            file: member.file.clone(),
            format: member.format,
            unit: member.unit,
            motion: member.accelerogram.clone(),
            place: in_suite
                .then(|| (member.pair.clone(), member.study_component)),
            remarks: member.remarks.clone(),
        }
    }
}

/// Why files were refused: one line a cause, with the number of its files.
fn causes(refused: &[Refused]) -> String {
    let cause = |r: &Refused| {
        let place = format!("{}: ", r.file);
        r.reason.strip_prefix(&place).map(str::to_owned)
    };
    let mut causes: Vec<(Option<String>, &Refused, usize)> = Vec::new();
    for refused in refused {
        let cause = cause(refused);
        let known =
            causes.iter_mut().find(|(c, ..)| c.is_some() && *c == cause);
        match known {
            Some((.., count)) => *count += 1,
            None => causes.push((cause, refused, 1)),
        }
    }
    let line = |(_, refused, count): (Option<String>, &Refused, usize)| {
        let others = match count {
            1 => String::new(),
            2 => " (and 1 more file)".to_owned(),
            n => format!(" (and {} more files)", n - 1),
        };
        format!("{}{others}", refused.reason)
    };
    causes.into_iter().map(line).collect::<Vec<_>>().join("\nrocking: ")
}

/// One file that was refused.
struct Refused {
    file: String,
    code: &'static str,
    line: Option<usize>,
    reason: String,
}

#[derive(Default)]
struct Listing {
    records: Vec<Listed>,
    refused: Vec<Refused>,
    set_aside: SetAside,
    suites: Vec<String>,
    /// The files that were read.
    inputs: Vec<PathBuf>,
    /// What was done to the records.
    processing: Option<String>,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] with status 2 when any file was refused, after all are
/// listed.
pub fn run(args: &Args) -> Result<(), Failure> {
    let options = args.reading.options(args.gravity);
    let mut listing = Listing::default();
    for path in &args.paths {
        listing.add(path, options);
    }
    let processing = args.processing.processing()?;
    for listed in &mut listing.records {
        listed.motion = processing.apply(&listed.motion)?;
    }
    listing.processing = words(&processing);
    listing.remark();
    let mut outputs = Outputs::of(listing.inputs.clone());
    let plot = outputs.open_some(args.plot.as_ref())?;
    if let Some(out) = plot
        && listing.refused.is_empty()
    {
        let done = listing.processing.as_deref();
        out.write(plot::svg(&listing.records, done, args.gravity)?)?;
    }
    let baseline = (!args.processing.passes_high()).then(|| {
        let done = listing.processing.as_deref();
        done.unwrap_or("no baseline correction").to_owned()
    });
    let found = args.measures.run(&listing.records, args.gravity, baseline)?;
    if args.json {
        print_json(listing.json(args.gravity, &found))?;
    } else {
        print(&listing.table(args.gravity))?;
        print(&found.table(&listing.records))?;
    }
    if !listing.refused.is_empty() {
        return Err(Failure::input(causes(&listing.refused)));
    }
    let all = listing.records.iter().map(Listed::remarked);
    let remarks = Remarks::of(&all.collect::<Vec<_>>());
    args.reading.judge(&listing.set_aside, &remarks)
}

impl From<&RecordError> for Refused {
    fn from(error: &RecordError) -> Self {
        Self {
            file: error.file().to_owned(),
            code: error.fault().code(),
            line: error.line(),
            reason: error.to_string(),
        }
    }
}

impl Listing {
    fn add(&mut self, path: &Path, options: ReadOptions) {
        self.inputs.push(path.to_owned());
        if path.is_dir() || inputs::is_zip(path) {
            return self.add_survey(path, options);
        }
        let file = path.display().to_string();
        let bytes = match record::file_bytes(path) {
            Ok(bytes) => bytes,
            Err(error) => return self.refused.push(Refused::from(&error)),
        };
        if record::is_index(&bytes) {
            return self.add_survey(path, options);
        }
        match record::read_all(&file, &bytes, &options) {
            Err(error) => self.refused.push(Refused::from(&error)),
            Ok(records) => {
                let several = records.len() > 1;
                self.records.extend(records.into_iter().map(|record| Listed {
                    file: match record.channel.filter(|_| several) {
                        Some(channel) => format!("{file}:{channel}"),
                        None => file.clone(),
                    },
                    format: record.format,
                    unit: record.unit,
                    motion: record.accelerogram,
                    place: None,
                    remarks: record.remarks,
                }))
            }
        }
    }

    fn add_survey(&mut self, path: &Path, options: ReadOptions) {
        let refused = |error: &record::SuiteError| Refused {
            file: error.file().to_owned(),
            code: error.code(),
            line: error.line(),
            reason: error.to_string(),
        };
        let survey = match inputs::survey(path, options) {
            Ok(survey) => survey,
            Err(error) => return self.refused.push(refused(&error)),
        };
        self.set_aside.extend(survey.set_aside().all().iter().cloned());
        if survey.members().iter().all(Result::is_ok) {
            match survey.into_suite() {
                Ok(suite) => self.add_suite(path, &suite),
                Err(error) => self.refused.push(refused(&error)),
            }
            return;
        }
        for member in survey.members() {
            match member {
                Ok(member) => {
                    self.records.push(Listed::member(member, false));
                }
                Err(error) => self.refused.push(refused(error)),
            }
        }
    }

    fn add_suite(&mut self, path: &Path, suite: &Suite) {
        self.inputs.extend(inputs::files(path, suite));
        self.suites.push(format!(
            "suite {}: {} records, {} pairs, {} study components by {}{}",
            suite.name(),
            suite.members().len(),
            suite.both().len(),
            suite.study_components().count(),
            suite.study_rule(),
            match suite.set_aside() {
                none if none.is_empty() => String::new(),
                some => format!("; set aside: {some}"),
            },
        ));
        let members = suite.members().iter();
        self.records.extend(members.map(|m| Listed::member(m, true)));
    }

    fn remark(&mut self) {
        let records: Vec<_> =
            self.records.iter().map(Listed::remarked).collect();
        let found = record::remarks_together(&records);
        for (listed, remarks) in self.records.iter_mut().zip(found) {
            listed.remarks = remarks;
        }
    }

    fn json(&self, gravity_m_s2: f64, found: &Found) -> Value {
        let record = |(position, listed): (usize, &Listed)| {
            let motion = &listed.motion;
            let (pair, study) = match &listed.place {
                Some((pair, study)) => (pair.as_deref(), Some(*study)),
                None => (None, None),
            };
            let remark = |remark: &Remark| {
                json!({
                    "code": remark.code(),
                    "message": remark.to_string(),
                })
            };
            let remarks = listed.remarks.iter().map(remark);
            let mut value = json!({
                "file": listed.file,
                "format": listed.format.to_string(),
                "units": listed.unit.to_string(),
                "dt_s": motion.dt_s(),
                "npts": motion.samples_g().len(),
                "duration_s": motion.duration_s(),
                "pga_g": motion.pga_g(),
                "pgv_m_s": motion.pgv_m_s(gravity_m_s2),
                "pair": pair,
                "study_component": study,
                "remarks": remarks.collect::<Vec<_>>(),
            });
            found.add_to(position, &mut value);
            value
        };
        let refused = |list: &[Refused]| -> Vec<Value> {
            let one = |refused: &Refused| {
                json!({
                    "file": refused.file,
                    "code": refused.code,
                    "line": refused.line,
                    "reason": refused.reason,
                })
            };
            list.iter().map(one).collect()
        };
        let records = self.records.iter().enumerate().map(record);
        let mut all = json!({
            "gravity_m_s2": gravity_m_s2,
            "processing": self.processing,
            "records": records.collect::<Vec<_>>(),
            "refused": refused(&self.refused),
            "set_aside": self.set_aside.all().iter().map(|aside| json!({
                "file": aside.error.file(),
                "code": aside.reason.code(),
                "line": aside.error.line(),
                "reason": aside.error.to_string(),
            })).collect::<Vec<_>>(),
        });
        if let (Some(pairs), Some(map)) =
            (found.pairs_json(), all.as_object_mut())
        {
            map.insert("pairs".into(), pairs);
        }
        all
    }

    fn table(&self, gravity_m_s2: f64) -> String {
        let mut text = String::new();
        let names = self.records.iter().map(|r| r.file.chars().count());
        let width = names.max().unwrap_or(0).max(4);
        if !self.records.is_empty() {
            line(
                &mut text,
                format_args!(
                    "{:width$}  format    units     dt (s)       n \
                     duration(s)   PGA (g)  PGV (m/s)",
                    "file",
                ),
            );
        }
        for listed in &self.records {
            let motion = &listed.motion;
            line(
                &mut text,
                format_args!(
                    "{:width$}  {:8} {:>6} {:>10} {:>7} {:>11.3} {:>9.5} {:>10.5}",
                    listed.file,
                    listed.format.to_string(),
                    listed.unit.to_string(),
                    motion.dt_s(),
                    motion.samples_g().len(),
                    motion.duration_s(),
                    motion.pga_g(),
                    motion.pgv_m_s(gravity_m_s2),
                ),
            );
        }
        if let Some(words) = &self.processing {
            line(&mut text, format_args!("processed: {words}"));
        }
        for listed in &self.records {
            for remark in &listed.remarks {
                let (file, code) = (&listed.file, remark.code());
                line(&mut text, format_args!("{file}: {code}: {remark}"));
            }
        }
        for Aside { error, .. } in self.set_aside.all() {
            line(&mut text, format_args!("set aside: {error}"));
        }
        for suite in &self.suites {
            line(&mut text, format_args!("{suite}"));
        }
        text
    }
}

fn line(text: &mut String, arguments: std::fmt::Arguments<'_>) {
    // Writing to a string cannot fail.
    let _ = text.write_fmt(arguments);
    text.push('\n');
}
