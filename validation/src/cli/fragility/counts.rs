//! `rocking fragility counts`: fits of how many records exceeded a level at
//! each intensity.

use std::path::{Path, PathBuf};

use clap::Args as ClapArgs;
use rocking::procedures::fit_stripes;
use rocking::statistics::lognormal::Stripe;

use crate::cli::shared::JsonArg;
use crate::cli::{At as _, Failure, input};
use rocking_exchange::FileError;
use rocking_exchange::columns::COUNTS;
use rocking_exchange::read::{Cells, rows};

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
    #[command(flatten)]
    json: JsonArg,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a table that is refused.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let path = &args.counts;
    let found = fit_stripes(&read(path)?, args.shift);
    args.json.show(&found.at(path.display())?)
}

/// Reads a table of counts.
pub(super) fn read(path: &Path) -> Result<Vec<Stripe>, Failure> {
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(input::open(path)?);
    let stripe = |cells: Result<Cells<'_>, FileError>| {
        let cells = cells?;
        let fits = |count: &u32| *count <= MOST_RECORDS;
        let count = |k| cells.parsed(k, fits, "a count up to 1000000");
        Ok(Stripe {
            im: cells.parsed(0, |im: &f64| im.is_finite(), "an intensity")?,
            exceeded: count(1)?,
            n: count(2)?,
        })
    };
    rows(&COUNTS, &mut reader, path)?.map(stripe).collect()
}

/// Records of a stripe, at most.
const MOST_RECORDS: u32 = 1_000_000;
