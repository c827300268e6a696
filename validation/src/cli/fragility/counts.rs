//! `rocking fragility counts`: fits of how many records exceeded a level at
//! each intensity.

use std::path::{Path, PathBuf};

use clap::Args as ClapArgs;
use rocking::procedures::fit_stripes;
use rocking::statistics::lognormal::Stripe;

use crate::cli::Failure;
use crate::cli::samples::Opened;
use crate::cli::show::show;
use rocking_common::table::columns::{COUNTS, SCHEMA};

/// Fits a lognormal fragility to counts: how many of n records exceeded a
/// level, or overturned, at each intensity.
///
/// Maximum likelihood of binomial counts, with likelihood intervals (95 %)
/// that take the stripes as independent.
#[derive(ClapArgs)]
pub(super) struct Args {
    /// Table of counts, columns intensity,exceeded,n; `-` is standard input.
    #[arg(long, value_name = "FILE.csv")]
    counts: PathBuf,
    /// Shift IM_R, not negative.
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    shift: f64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a table that is refused.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let path = &args.counts;
    let found = fit_stripes(&read(path)?, args.shift).map_err(|error| {
        Failure::input(format!("{}: {error}", path.display()))
    })?;
    show(args.json, &found)
}

/// Reads a table of counts.
pub(super) fn read(path: &Path) -> Result<Vec<Stripe>, Failure> {
    let place = path.display();
    let refuse = |e: csv::Error| Failure::input(format!("{place}: {e}"));
    let opened = Opened::open(path);
    let opened = opened.map_err(|e| refuse(e.into()))?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(opened);
    let header = reader.headers().map_err(refuse)?;
    if !COUNTS.has(header) {
        return Err(Failure::input(format!(
            "{place}:1: found columns `{}`: expected `{}`",
            header.iter().collect::<Vec<_>>().join(","),
            COUNTS.names().collect::<Vec<_>>().join(","),
        )));
    }
    let mut stripes = Vec::new();
    for row in reader.records() {
        let row = row.map_err(refuse)?;
        let line = row.position().map_or(0, csv::Position::line);
        let wrong = |column: usize, expected: &str| {
            Failure::input(format!(
                "{place}:{line}: found `{}` in column {}: expected {expected}",
                &row[column], COUNTS.columns[column].name,
            ))
        };
        if !COUNTS.is_current(row.get(3)) {
            return Err(Failure::input(format!(
                "{place}:{line}: found schema {}: expected {SCHEMA}",
                &row[3],
            )));
        }
        let count = |column: usize| {
            let count = row[column].parse::<u32>().ok();
            let count = count.filter(|count| *count <= MOST_RECORDS);
            count.ok_or_else(|| wrong(column, "a count up to 1000000"))
        };
        let im = row[0].parse::<f64>().ok().filter(|im| im.is_finite());
        stripes.push(Stripe {
            im: im.ok_or_else(|| wrong(0, "an intensity"))?,
            exceeded: count(1)?,
            n: count(2)?,
        });
    }
    Ok(stripes)
}

/// Records of a stripe, at most.
const MOST_RECORDS: u32 = 1_000_000;
