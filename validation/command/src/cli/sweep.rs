//! `rocking sweep`: many blocks over one suite, on one machine or many.

use std::env;
use std::path::PathBuf;

use clap::Subcommand;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::Processing;

use super::reading::ReadArgs;
use super::shared::{ThreadsArg, positive};
use super::{blocks, names};
use crate::failure::{Failure, bail, ensure};
use crate::sweep::{
    self, Content, LevelSteps, SCHEMA, SweepBlock, SweepFolder, SweepPlan,
    TILE_CURVES,
};
use crate::terminal::{SOFTWARE, note, say};
use crate::threads::{until, with_threads};
use rocking_common::suites::inputs::{BLOCK_SAMPLES, SuiteInput};
use rocking_common::suites::remarks::Remarks;

/// Runs many blocks over one suite in tiles: plan once, run on any number of
/// tasks, merge.
///
/// A tile is a group of blocks with all records of the suite. It is written
/// whole or not at all, and it states its plan and its checksum. After any
/// failure, run the same task again: finished tiles are skipped.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking sweep plan --blocks blocks.csv --suite records/ --out sweep\n  \
    rocking sweep run sweep\n  \
    rocking sweep run sweep --task 3 --of 8\n  \
    rocking sweep merge sweep --out fragilities.csv")]
pub struct SweepCommand {
    #[command(subcommand)]
    action: SweepAction,
}

#[derive(Subcommand)]
enum SweepAction {
    Plan(SweepPlanCommand),
    Run(SweepRunCommand),
    Merge(SweepMergeCommand),
}

/// Writes a plan and packs the suite into its folder.
#[derive(clap::Args)]
struct SweepPlanCommand {
    /// Table of blocks: alpha,p or width_m,height_m, and optionally id and
    /// eta.
    #[arg(long, value_name = "FILE.csv")]
    blocks: PathBuf,
    /// Folder of records, index CSV, zip, or one record file.
    #[arg(long, value_name = "PATH")]
    suite: PathBuf,
    #[command(flatten)]
    reading: ReadArgs,
    /// Coefficient of restitution of blocks whose row has none.
    #[arg(long, value_name = "ETA", default_value_t = 0.92)]
    eta: f64,
    /// Demands |theta|/alpha at which capacities are reported.
    #[arg(
        long,
        value_name = "E",
        value_delimiter = ',',
        value_parser = share,
        default_value = "0.15,0.35,1"
    )]
    demands: Vec<f64>,
    /// Step of the levels in PGA/(g tan alpha), from 1.
    #[arg(
        long,
        value_name = "X",
        default_value_t = 0.02,
        value_parser = positive
    )]
    step_im: f64,
    /// Step of the levels in PGA (multiples of g) instead; the paper uses
    /// 0.01.
    #[arg(
        long,
        value_name = "G",
        conflicts_with = "step_im",
        value_parser = positive
    )]
    step_pga_g: Option<f64>,
    /// Keep every level, not only capacities and fragilities.
    #[arg(long)]
    rows: bool,
    /// Blocks per tile [default: 1000 divided by the number of records].
    #[arg(long, value_name = "N")]
    tile_blocks: Option<usize>,
    /// Folder of the plan.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

/// Runs the unfinished tiles of one task.
#[derive(clap::Args)]
struct SweepRunCommand {
    /// Folder of the plan.
    dir: PathBuf,
    /// Index of this task, from 0 [default: from SLURM, PMI or Open MPI, else 0].
    #[arg(long, value_name = "I", requires = "of")]
    task: Option<usize>,
    /// Number of tasks [default: from SLURM, PMI or Open MPI, else 1].
    #[arg(long, value_name = "N", requires = "task")]
    of: Option<usize>,
    #[command(flatten)]
    threads: ThreadsArg,
}

/// Merges the tiles in the plan's order; refuses tiles that are missing,
/// damaged, or from another plan or build, and names them.
#[derive(clap::Args)]
struct SweepMergeCommand {
    /// Folder of the plan.
    dir: PathBuf,
    /// Table to merge.
    #[arg(
        long,
        value_parser = names::named(Content::ALL, Content::name, CONTENTS),
        default_value = Content::Fragilities.name()
    )]
    what: Content,
    /// CSV file of the table.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
}

/// Help text of each table.
const CONTENTS: [&str; 3] = [
    "A row a block, intensity measure and demand",
    "A row a block and record",
    "A row a level, and one for the refined end of a curve; for plans with \
     `--rows`",
];

/// Runs `rocking sweep`.
///
/// # Errors
/// [`Failure`] for bad input, and for tiles that are left.
pub fn run_sweep(args: &SweepCommand) -> Result<(), Failure> {
    match &args.action {
        SweepAction::Plan(args) => with_threads(None, || plan(args)).flatten(),
        SweepAction::Run(args) => run_task(args),
        SweepAction::Merge(args) => {
            with_threads(None, || merge(args)).flatten()
        }
    }
}

fn share(text: &str) -> Result<f64, &'static str> {
    let share = positive(text).ok().filter(|x| *x <= 1.0);
    share.ok_or("expected a number above 0, at most 1")
}

fn plan(args: &SweepPlanCommand) -> Result<(), Failure> {
    let rows = blocks::on_ground(&args.blocks, STANDARD_GRAVITY_M_S2)?;
    let given = |row: blocks::BlockRow| match row.samples.as_slice() {
        [] => Ok(SweepBlock {
            id: row.id,
            alpha_rad: row.block.slenderness_rad(),
            p_rad_s: row.block.frequency_rad_s(),
            eta: row.cells.eta.unwrap_or(args.eta),
        }),
        _ => bail!(
            "{}: a sample: expected none, since a sweep computes its own \
             capacities",
            row.place
        ),
    };
    let blocks: Vec<SweepBlock> =
        rows.into_iter().map(given).collect::<Result<_, _>>()?;
    let read = args.reading.options(STANDARD_GRAVITY_M_S2);
    let none = Processing::default();
    let (input, suite) =
        SuiteInput::read::<Failure>(&args.suite, read, &none, BLOCK_SAMPLES)?;
    args.reading.judge(suite.set_aside(), &Remarks::on(&suite))?;
    let by_default =
        TILE_CURVES.div_ceil(suite.study_components().count().max(1));
    let plan = SweepPlan {
        schema: SCHEMA,
        software: SOFTWARE.into(),
        levels: args
            .step_pga_g
            .map_or(LevelSteps::StepIm(args.step_im), LevelSteps::StepPgaG),
        demands: args.demands.clone(),
        rows: args.rows,
        blocks,
        records: Vec::new(),
        events: Vec::new(),
        tile_blocks: args.tile_blocks.unwrap_or(by_default),
    };
    let planned = plan.write(&suite, input, &args.out)?;
    let plan = &planned.plan;
    let set_aside = match suite.set_aside() {
        none if none.is_empty() => String::new(),
        some => format!("set aside: {some}\n"),
    };
    say(&format!(
        "{} blocks, {} records, {} tiles\n{set_aside}plan: {}\n",
        plan.blocks.len(),
        plan.records.len(),
        plan.tiles(),
        args.out.join("plan.json").display()
    ))
}

/// Task and number of tasks from the environment of a scheduler.
fn from_environment() -> Result<(usize, usize), Failure> {
    let read = |name: &str| -> Result<Option<usize>, Failure> {
        let Ok(text) = env::var(name) else { return Ok(None) };
        let number = text.parse().map_err(|_| {
            Failure::input(format!("{name}={text}: expected a number"))
        })?;
        Ok(Some(number))
    };
    let least = read("SLURM_ARRAY_TASK_MIN")?.unwrap_or(0);
    for (task, of, first) in [
        ("SLURM_ARRAY_TASK_ID", "SLURM_ARRAY_TASK_COUNT", least),
        ("SLURM_PROCID", "SLURM_NTASKS", 0),
        ("PMI_RANK", "PMI_SIZE", 0),
        ("OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE", 0),
    ] {
        if let (Some(task), Some(of)) = (read(task)?, read(of)?) {
            return Ok((task.saturating_sub(first), of));
        }
    }
    Ok((0, 1))
}

fn run_task(args: &SweepRunCommand) -> Result<(), Failure> {
    let (task, of) = match (args.task, args.of) {
        (Some(task), Some(of)) => (task, of),
        _ => from_environment()?,
    };
    ensure!(
        task < of,
        "task {task} of {of}: expected a task below the number of tasks"
    );
    let planned = SweepFolder::read(&args.dir)?;
    let total = planned.plan.tiles();
    let done = |tile| note(&format!("tile {tile} of {total} done"));
    let run = || sweep::run(&planned, SOFTWARE, (task, of), &done);
    until(args.threads.threads, run)?.transpose()?;
    let left = sweep::left(&planned, (task, of));
    if left.is_empty() {
        return say(&format!("task {task} of {of}: all its tiles are done\n"));
    }
    let left: Vec<String> = left.iter().map(ToString::to_string).collect();
    Err(Failure::gate(format!(
        "task {task} of {of} was stopped; tiles left: {}",
        left.join(", ")
    )))
}

fn merge(args: &SweepMergeCommand) -> Result<(), Failure> {
    let planned = SweepFolder::read(&args.dir)?;
    ensure!(
        Content::kept(&planned.plan).contains(&args.what),
        "this plan keeps no rows; expected a plan of `--rows`"
    );
    sweep::merge(&planned, args.what, &args.out)
}
