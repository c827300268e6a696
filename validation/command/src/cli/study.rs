//! `rocking study`: the whole paper, from records to findings.

use std::path::{Path, PathBuf};

use indicatif::{ProgressBar, ProgressStyle};
use rocking::block::Restitution;
use rocking::integrator::Overturning;
use rocking::units::STANDARD_GRAVITY_M_S2;

use super::names;
use super::processing::RecordArgs;
use super::shared::{ThreadsArg, positive};
use super::way::WayArgs;
use crate::failure::{AtPlace as _, Failure, bail, ensure};
use crate::terminal::{COMMIT, logged, note, print, say};
use rocking_assessment::RECORDED_MOTIONS;
use rocking_common::files::{FolderError, OutputFolder, is_interrupted};
use rocking_common::paper::{Arm, RESTITUTION, SuiteKind};
use rocking_common::suites::StudySuite;
use rocking_report::evidence::{NOT_RUN, Proof};
use rocking_report::head::Signatures;
use rocking_report::lab::LAB;
use rocking_report::output::{self, Files};
use rocking_report::stale;
use rocking_study::Study;
use rocking_study::analyses::Plan;
use rocking_study::inference::REPLICATES;
use rocking_study::runs::Setup;

/// Default folder of a study.
pub const REPORT: &str = "rocking-report";

/// Repeats the whole study and writes a report: 15 blocks, two suites, Figures
/// 1 to 18 with their data, and the findings.
///
/// Without --ordinary and --pulse it uses the embedded synthetic suites.
/// `python -m rocking.recorded motions` writes recorded motions (FEMA P-695).
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking study\n  \
    rocking study --ordinary far.csv --pulse near.csv --out report")]
pub struct StudyCommand {
    /// Ordinary suite: a folder of records, or an index (CSV).
    #[arg(long, value_name = "PATH", requires = "pulse")]
    ordinary: Option<PathBuf>,
    /// Pulse-type suite: a folder of records, or an index (CSV).
    #[arg(long, value_name = "PATH", requires = "ordinary")]
    pulse: Option<PathBuf>,
    #[command(flatten)]
    input: RecordArgs,
    /// Coefficient of restitution, ratio of angular velocities.
    #[arg(long, default_value_t = RESTITUTION)]
    eta: f64,
    /// When a block counts as overturned.
    #[arg(long, value_parser = names::overturning(), default_value = "alpha")]
    overturn: Overturning,
    /// Width in dimensionless intensity to which grids B and C bisect the
    /// first overturning.
    #[arg(
        long,
        value_name = "TOL",
        value_parser = positive,
        default_value_t = 1e-4
    )]
    refine: f64,
    /// Grids of intensity: A the paper's steps of 0.01 g, B refined, C the
    /// same dimensionless steps for every block.
    #[arg(
        long,
        value_parser = names::named(Arm::ALL, Arm::name, [""; 3]),
        value_delimiter = ',',
        default_value = "A,B,C"
    )]
    arms: Vec<Arm>,
    /// Other choices (restitution, criterion, component) on all 15 blocks.
    #[arg(long)]
    full: bool,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    way: WayArgs,
    /// Folder into which `rocking verify --out` wrote verification.json and
    /// precision.csv, the results of the reference cases, which the page then
    /// shows [default: the folder data of the report if it contains them].
    #[arg(long, value_name = "DIR")]
    proof: Option<PathBuf>,
    #[command(flatten)]
    signatures: Signatures,
    /// Folder of the report: a new or an empty one, or the folder of an
    /// earlier report, which is replaced.
    #[arg(long, value_name = "DIR", default_value = REPORT)]
    out: PathBuf,
    /// Compare with the report in that folder, write nothing, and fail if a
    /// byte differs, naming what changed.
    #[arg(long)]
    check: bool,
    /// Print the findings as JSON.
    #[arg(long, conflicts_with = "check")]
    json: bool,
}

/// Runs `rocking study`.
///
/// # Errors
/// [`Failure`] for a suite that is refused, an option out of range, or a
/// folder that cannot be written.
pub fn run_study(args: &StudyCommand) -> Result<(), Failure> {
    // All of it: whatever runs in parallel finds these threads.
    args.threads.run(|| in_threads(args))?
}

/// The suites that the options name.
fn suites(args: &StudyCommand) -> Result<[StudySuite; 2], Failure> {
    let processing = args.input.processing()?;
    let options = args.input.reading.options(STANDARD_GRAVITY_M_S2);
    let read = |kind, path: &Path| -> Result<StudySuite, Failure> {
        let suite = StudySuite::read(kind, path, options, &processing)?;
        args.input.reading.judge(&suite.set_aside, &suite.remarks)?;
        Ok(suite)
    };
    match (&args.ordinary, &args.pulse) {
        (Some(ordinary), Some(pulse)) => Ok([
            read(SuiteKind::Ordinary, ordinary)?,
            read(SuiteKind::PulseType, pulse)?,
        ]),
        _ => {
            let unused = "--ordinary and --pulse, but for the records of a \
                          suite";
            args.input.refuse_unused(unused)?;
            Ok(StudySuite::embedded()?)
        }
    }
}

fn in_threads(args: &StudyCommand) -> Result<(), Failure> {
    let plan = plan(args)?;
    // Refused before the suites are made and minutes are spent.
    let folder = if args.check {
        let place = args.out.display();
        std::fs::read_dir(&args.out)
            .at(format_args!("no folder of a report at {place}"))?;
        if is_interrupted(&args.out) {
            return Err(FolderError::Interrupted).at(place);
        }
        None
    } else {
        // A killed run leaves an incomplete folder, which its remains
        // identify.
        if !is_interrupted(&args.out)
            && let Some(name) = output::foreign(&args.out)
        {
            bail!(
                "cannot write {}: it contains {name}, which no study wrote: \
                 expected a new or an empty folder, or one that `rocking \
                 study` wrote",
                args.out.display()
            );
        }
        Some(OutputFolder::open(&args.out)?)
    };
    let proof = match &args.proof {
        Some(folder) => Some(Proof::read(folder)?),
        None => Proof::find(&args.out.join("data"))?,
    };
    let suites = suites(args)?;
    // Drawn on a terminal only.
    let bar = ProgressBar::new(0);
    let template = "{msg}: {bar:40} {pos}/{len} curves";
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style);
    }
    let answer = |words: &str| bar.suspend(|| note(words));
    let study = logged(&bar, || Study::run(plan, &suites, &bar, &answer))?;
    bar.finish_and_clear();
    let signatures = Signatures { commit: COMMIT, ..args.signatures.clone() };
    let lab = args.out.join(LAB).is_file();
    let files = output::files(&study, proof.as_ref(), &signatures, lab)?;
    let Some(folder) = folder else { return check(&args.out, &files) };
    folder.write(&files, &output::LAST)?;
    if args.json {
        print(&study.findings.text())
    } else {
        if suites[0].source.is_embedded() {
            note(RECORDED_MOTIONS);
        }
        for suite in &suites {
            let StudySuite { kind, remarks, set_aside, clusters, .. } = suite;
            note(&format!("{kind} suite: {clusters}"));
            if let Some(words) = remarks.words() {
                note(&format!("{kind} suite: remarks on {words}"));
            }
            if !set_aside.is_empty() {
                note(&format!("{kind} suite: set aside: {set_aside}"));
            }
        }
        say(&format!(
            "{}\n{}\n{}\nReport: {}\n",
            output::claims_table(&study.findings.claims),
            output::answers_text(&study, proof.as_ref())?,
            proof.as_ref().map_or(NOT_RUN.into(), Proof::to_string),
            args.out.join("index.html").display()
        ))
    }
}

/// Fails if the report in `out` is not these files.
fn check(out: &Path, files: &Files) -> Result<(), Failure> {
    let name = out.display();
    match stale::stale(out, files)? {
        None => say(&format!(
            "{name}: all {} files of the report are up to date\n",
            files.len()
        )),
        Some(words) => {
            say(&words)?;
            Err(Failure::gate(format!(
                "{name} is stale: `rocking study --out {name}` accepts what \
                 is there now"
            )))
        }
    }
}

fn plan(args: &StudyCommand) -> Result<Plan, Failure> {
    let mut arms = args.arms.clone();
    arms.sort();
    arms.dedup();
    ensure!(
        arms.iter().any(|arm| *arm != Arm::B),
        "--arms B: expected A or C among them; figures are drawn from \
         those"
    );
    let setup = Setup {
        restitution: Restitution::constant(args.eta)?,
        overturning: args.overturn,
        tolerance: args.refine,
        way: args.way.way()?,
    };
    Ok(Plan { setup, arms, full: args.full, replicates: REPLICATES })
}
