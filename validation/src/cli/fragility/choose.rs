//! `rocking fragility choose`: families of distributions beside each other.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::procedures::{Draws, choose};

use crate::cli::samples::SampleFile;
use crate::cli::show::show;
use crate::cli::{Failure, with_threads};

/// Compares lognormal, shifted lognormal (its shift fitted too), Weibull,
/// gamma and generalized extreme value distributions.
///
/// All are fitted by maximum likelihood: AIC, BIC, and the p-values of D and
/// A2 with the parameters fitted. A difference of AIC below 2 decides nothing.
#[derive(ClapArgs)]
pub(super) struct Args {
    /// Sample file; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    sample: PathBuf,
    /// Shift above which lognormal, Weibull and gamma lie.
    #[arg(long, value_name = "X", default_value_t = 0.0)]
    shift: f64,
    /// Samples drawn from each fit.
    #[arg(long, value_name = "N", default_value_t = 1000)]
    bootstrap: usize,
    /// Repetition of the draws.
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Threads; the result doesn't depend on them.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a sample that is refused.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let sample = SampleFile::read(&args.sample)?.censored()?;
    let draws = Draws { replicates: args.bootstrap, seed: args.seed };
    let found =
        with_threads(args.threads, || choose(&sample, args.shift, draws))?;
    let found = found.map_err(|e| {
        Failure::input(format!("{}: {e}", args.sample.display()))
    })?;
    show(args.json, &found)
}
