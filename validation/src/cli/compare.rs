//! `rocking compare`: paired ratios of two samples over the same records.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::procedures::{Comparison, compare};
use serde::Serialize;

use super::shared::JsonArg;
use crate::failure::Failure;
use crate::input;

/// Paired ratios a/b of two samples: counts, boxplot, tests of a centre at 1
/// and of equivalence to it. Values are paired by the names of their records,
/// or line by line where a value has none.
///
/// A ratio exists where both values are finite and positive. Pairs in which
/// one or both are infinite (overturned, censored) or zero are counted by
/// kind.
#[derive(ClapArgs)]
pub struct Args {
    /// Sample file of the numerators.
    #[arg(long, value_name = "FILE")]
    a: PathBuf,
    /// Sample file of the denominators, of the same records.
    #[arg(long, value_name = "FILE")]
    b: PathBuf,
    /// Margin of equivalence: ratios between 1/(1 + M) and 1 + M are
    /// equivalent to 1.
    #[arg(long, value_name = "M", default_value_t = 0.05)]
    margin: f64,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Serialize)]
struct Shown {
    /// By the names of the records, or by their lines.
    paired_by_name: bool,
    #[serde(flatten)]
    found: Comparison,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for files, pairs or a margin that are refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    let (a, b) = (input::sample(&args.a)?, input::sample(&args.b)?);
    input::records_as_unit(&a);
    let (a, b, paired_by_name) = a.pairs(&b)?;
    let found = compare(&a, &b, args.margin)?;
    args.json.show(&Shown { paired_by_name, found })
}
