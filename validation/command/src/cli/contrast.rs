//! `rocking contrast`: two samples over different records.

use std::path::PathBuf;

use rocking_procedures::contrast;
use rocking_procedures::contrast::ContrastSample;

use super::shared::{BootstrapArgs, JsonArg, ThreadsArg};
use crate::failure::Failure;
use crate::input;

/// Ratio of the medians of two samples over different records, and the
/// distance between their distributions. `rocking compare` pairs samples of
/// the same records.
///
/// The interval of the ratio a/b is from a bootstrap, which draws earthquakes
/// if a file states them. Kolmogorov and Smirnov's p-value is exact for
/// independent records; it is left out if an earthquake has several.
#[derive(clap::Args)]
pub struct ContrastCommand {
    /// Sample file of the numerator.
    #[arg(long, value_name = "FILE")]
    a: PathBuf,
    /// Sample file of the denominator, of other records.
    #[arg(long, value_name = "FILE")]
    b: PathBuf,
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking contrast`.
///
/// # Errors
/// [`Failure`] for files or draws that are refused.
pub fn run_contrast(args: &ContrastCommand) -> Result<(), Failure> {
    let (a, b) = (input::sample(&args.a)?, input::sample(&args.b)?);
    a.same_kind(&b)?;
    let (of_a, of_b) = (a.censored()?, b.censored()?);
    let (records, events) =
        ([a.records(), b.records()], [a.events(), b.events()]);
    let drawn = |sample, k: usize| ContrastSample {
        sample,
        records: &records[k],
        events: &events[k],
    };
    let draws = args.bootstrap.draws();
    let (a, b) = (drawn(&of_a, 0), drawn(&of_b, 1));
    let found = args.threads.run(|| contrast(a, b, draws))??;
    let sentences = [
        "The median of a is {median_ratio} times that of b.",
        "The medians have no ratio: {median_ratio.reason}.",
    ];
    args.json.show(&sentences, &found)
}
