//! `rocking assess`: objects, records and a hazard curve to one page.

use std::path::PathBuf;

use clap::ArgGroup;
use rocking::accelerogram::Accelerogram;
use rocking::block::Restitution;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::Id;
use rocking_procedures::assess::NamedFloor;
use rocking_procedures::{AssessOptions, ModelError, Object, assess};
use rocking_records::floor::Floor;

use super::blocks::{self, BlockRow};
use super::floors;
use super::processing::{RecordArgs, words};
use super::risk::SiteArgs;
use super::scene::BlockArgs;
use super::shared::{BootstrapArgs, ModelErrorArgs, ThreadsArg};
use crate::failure::{Failure, ensure};
use crate::input;
use crate::terminal::{SOFTWARE, note, print, say};
use rocking_assessment::{About, PAGE, recorded_ratios};
use rocking_common::files::{OutputFolder, SUMS, sums};
use rocking_common::paper::{RESTITUTION, SuiteKind};
use rocking_common::suites::StudySuite;

/// The largest share of records under which an object that rocks slides first.
pub const SLIDING_SHARE: f64 = 0.05;

/// The kind of a suite by default.
const SUITE: SuiteKind = SuiteKind::Ordinary;

/// Which object overturns first, how often, and what helps: from a table of
/// objects to one page.
///
/// Each object is a rigid block that rocks on flat ground; it does not slide,
/// jump or twist. Records are scaled until they overturn it. Without --suite
/// the records are 86 embedded synthetic motions of ordinary earthquakes;
/// `python -m rocking.recorded motions` writes recorded ones (FEMA P-695).
/// Without --hazard objects are ranked by the PGA of 5 % damage. DIR receives
/// index.html, assess.json with all its numbers, and CSV files.
#[derive(clap::Args)]
#[command(group = ArgGroup::new("object").required(true).multiple(true)
    .args(["objects", "width_m", "alpha"]))]
#[command(after_help = "Examples:\n  \
    rocking assess --objects objects.csv --hazard hazard.csv\n  \
    rocking assess --width-m 0.5 --height-m 1.8 --suite records/")]
pub struct AssessCommand {
    /// Table of objects, CSV: width_cm,height_cm or alpha,p, and optionally
    /// label, friction, eta and others (docs/tables.md).
    #[arg(
        long,
        value_name = "OBJECTS.csv",
        conflicts_with_all = ["alpha", "p", "width_m", "height_m"]
    )]
    objects: Option<PathBuf>,
    /// Table of floors, CSV: name, period_s and damping of one mode of the
    /// building, and height_ratio (participation factor times mode shape at
    /// the floor); a column floor in the table of objects names one of them.
    #[arg(long, value_name = "FLOORS.csv", requires = "objects")]
    floors: Option<PathBuf>,
    #[command(flatten)]
    block: BlockArgs,
    /// Folder of records, index CSV, or zip.
    #[arg(long, value_name = "PATH")]
    suite: Option<PathBuf>,
    #[command(flatten)]
    input: RecordArgs,
    /// Hazard curve of the site, CSV (columns: `rocking risk --help`).
    #[arg(long, value_name = "HAZARD.csv")]
    hazard: Option<PathBuf>,
    #[command(flatten)]
    site: SiteArgs,
    /// Return period in years, or probability in --years, to reach.
    #[arg(long, value_name = "YEARS|P", requires = "hazard")]
    target: Option<f64>,
    /// Share of records that may slide a ranked object.
    #[arg(long, value_name = "SHARE", default_value_t = SLIDING_SHARE)]
    sliding_share: f64,
    /// Settle each outcome with sufficient precision, which takes about six
    /// times as long; without it, doubtful analyses are only counted.
    #[arg(long)]
    certify: bool,
    #[command(flatten)]
    model_error: ModelErrorArgs,
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    threads: ThreadsArg,
    /// Folder for the page; must be new or empty.
    #[arg(long, value_name = "DIR", default_value = "rocking-assessment")]
    out: PathBuf,
    /// Print assess.json.
    #[arg(long)]
    json: bool,
}

/// Runs `rocking assess`.
///
/// # Errors
/// [`Failure`] for input that is refused, or a folder that is not empty.
pub fn run_assess(args: &AssessCommand) -> Result<(), Failure> {
    // All of it: a signal that stops it finds the threads that heed it.
    args.threads.run(|| in_threads(args))?
}

fn in_threads(args: &AssessCommand) -> Result<(), Failure> {
    let objects = args.objects()?;
    let hazard = args.hazard.as_deref();
    let hazard = hazard.map(|path| args.site.read(path)).transpose()?;
    let ratios = match args.suite {
        Some(_) => Vec::new(),
        None => recorded_ratios(hazard.as_ref())?,
    };
    let suite = args.suite()?;
    let folder = OutputFolder::open_new(&args.out)?;
    let options = AssessOptions {
        gravity_m_s2: STANDARD_GRAVITY_M_S2,
        hazard: hazard.as_ref(),
        years: args.site.years(),
        draws: args.bootstrap.draws(),
        certify: args.certify,
        model_error: args.model_error.or(ModelError::fitted()),
        recorded_ratios: &ratios,
        target_years: args.target()?,
        sliding_share: args.sliding_share,
    };
    let records = suite.motions.iter().map(|motion| motion.study.clone());
    let records: Vec<Accelerogram> = records.collect();
    let found = assess(&objects, &records, &suite.clusters, &options)?;
    let about = args.about(&suite)?;
    let mut files = rocking_assessment::files(&found, &about)?;
    files.insert(SUMS.into(), sums(&files));
    folder.write(&files, &[PAGE, SUMS])?;
    if args.json {
        return print(&rocking_assessment::json(&found, &about)?);
    }
    if let Some(words) = suite.remarks.words() {
        note(&format!("remarks on {words}"));
    }
    if !suite.set_aside.is_empty() {
        note(&format!("set aside: {}", suite.set_aside));
    }
    let page = args.out.join(PAGE);
    let text = rocking_assessment::text(&found);
    say(&format!("{text}\nPage: {}\n", page.display()))
}

impl AssessCommand {
    /// The target in years.
    fn target(&self) -> Result<Option<f64>, Failure> {
        let Some(target) = self.target else { return Ok(None) };
        let found = AssessOptions::target(target, self.site.years());
        ensure!(
            found.is_some(),
            "--target {target}: expected a return period of 1 year or more, \
             or a probability between 0 and 1"
        );
        Ok(found)
    }

    fn objects(&self) -> Result<Vec<Object>, Failure> {
        let gravity_m_s2 = STANDARD_GRAVITY_M_S2;
        let rows = match &self.objects {
            Some(path) => blocks::read(path, gravity_m_s2)?,
            None => {
                let block = self.block.block(gravity_m_s2)?;
                let id: Id = "object".parse().map_err(Failure::input)?;
                vec![BlockRow::of(id, block)]
            }
        };
        let floors = floors::of_rows(self.floors.as_deref(), &rows)?;
        let object = |(row, floor): (BlockRow, Option<Floor>)| {
            ensure!(
                row.samples.is_empty(),
                "{}: a column sample: expected none, capacities are \
                 computed here",
                row.place
            );
            if row.decimal_commas {
                let place = &row.place;
                note(&format!("{place}: decimal commas read as points"));
            }
            let eta = row.cells.eta.unwrap_or(RESTITUTION);
            let eta = Restitution::constant(eta)?;
            Ok(Object {
                id: row.id.to_string(),
                notes: notes(&row),
                position_m: row.position_m,
                friction: row.cells.friction,
                limit_ratio: row.cells.limit_ratio,
                floor: row.cells.floor.zip(floor).map(|(name, floor)| {
                    NamedFloor { name: name.to_string(), floor }
                }),
                ..Object::new(&row.label, row.block, eta)
            })
        };
        rows.into_iter().zip(floors).map(object).collect()
    }

    fn about(&self, suite: &StudySuite) -> Result<About, Failure> {
        let ground = match suite.source.is_embedded() {
            true => {
                "No records are given: the motions are 86 synthetic ones, \
                     which the program makes by published relations for \
                     ordinary earthquakes. Records of the site (--suite) \
                     replace them."
                    .to_owned()
            }
            false => format!("The motions are those of {}.", suite.source),
        };
        let aside = &suite.set_aside;
        let aside = (!aside.is_empty()).then(|| aside.to_string());
        let named = |path: &Option<PathBuf>| {
            path.as_deref().map(input::named).transpose()
        };
        let records = format!("{}, {}", suite.source, suite.clusters);
        let draws = self.bootstrap.draws();
        let certified = if self.certify { "certified" } else { "double" };
        let some = [
            ("Program", Some(SOFTWARE.to_owned())),
            ("Records", Some(records)),
            ("SHA-256 of the records", Some(suite.sha256())),
            ("Processing", words(&self.input.processing()?)),
            ("Set aside", aside),
            ("Remarks", suite.remarks.words()),
            ("Objects", named(&self.objects)?),
            ("Floors", named(&self.floors)?),
            ("Hazard curve", named(&self.hazard)?),
            ("Draws of the intervals", Some(draws.replicates.to_string())),
            ("Repetition of the draws", Some(draws.seed.to_string())),
            ("Outcomes of the analyses", Some(certified.to_owned())),
        ];
        Ok(About::of(ground, some))
    }

    fn suite(&self) -> Result<StudySuite, Failure> {
        if let Some(path) = &self.suite {
            let processing = self.input.processing()?;
            let options = self.input.reading.options(STANDARD_GRAVITY_M_S2);
            let suite = StudySuite::read(SUITE, path, options, &processing)?;
            self.input.reading.judge(&suite.set_aside, &suite.remarks)?;
            return Ok(suite);
        }
        self.input.refuse_unused("--suite")?;
        let [ordinary, _] = StudySuite::embedded()?;
        Ok(ordinary)
    }
}

/// The further columns of a row, and whether its depth counts as the width.
fn notes(row: &BlockRow) -> Vec<(String, String)> {
    let mut notes = row.notes.clone();
    if row.depth_governs {
        let words = "the depth, its shorter side".to_owned();
        notes.push(("width:".to_owned(), words));
    }
    notes
}
