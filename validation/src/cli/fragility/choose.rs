//! `rocking fragility choose`: families of distributions beside each other.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::procedures::choose;

use crate::cli::shared::{BootstrapArgs, JsonArg, ThreadsArg};
use crate::failure::{At as _, Failure};
use crate::input;

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
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a sample that is refused.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let file = input::sample(&args.sample)?;
    input::records_as_unit(&file);
    let sample = file.censored()?;
    let draws = args.bootstrap.draws();
    let found = args.threads.run(|| choose(&sample, args.shift, draws))?;
    args.json.show(&found.at(args.sample.display())?)
}
