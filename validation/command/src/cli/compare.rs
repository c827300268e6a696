//! `rocking compare`: paired ratios of two samples over the same records.

use std::path::PathBuf;

use rocking_procedures::compare;
use rocking_procedures::comparison::{NamedSample, SampleSide};

use super::shared::JsonArg;
use crate::failure::Failure;
use crate::input;

/// Paired ratios a/b of two samples: counts, boxplot, tests of a centre at 1
/// and of equivalence to it. Values are paired by the names of their records;
/// `rocking contrast` takes samples of different records.
///
/// A pair has a ratio if both values are finite and positive. Pairs in which
/// one or both are infinite (overturned, censored) or zero are counted by
/// kind.
#[derive(clap::Args)]
pub struct CompareCommand {
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

/// Runs `rocking compare`.
///
/// # Errors
/// [`Failure`] for files, pairs or a margin that are refused.
pub fn run_compare(args: &CompareCommand) -> Result<(), Failure> {
    let (a, b) = (input::sample(&args.a)?, input::sample(&args.b)?);
    a.same_kind(&b)?;
    a.extended()?;
    b.extended()?;
    input::records_as_unit(&a);
    let (of_a, of_b) = (a.records(), b.records());
    let found = compare(
        NamedSample { records: &of_a, values: a.values() },
        NamedSample { records: &of_b, values: b.values() },
        args.margin,
    );
    let found = found.map_err(|error| match error.place() {
        Some((SampleSide::A, place)) => a.error(place, error).into(),
        Some((SampleSide::B, place)) => b.error(place, error).into(),
        None => Failure::from(error),
    })?;
    let sentences = [
        "The ratio a/b is centred at {hodges_lehmann.ratio} \
         ({hodges_lehmann.low} to {hodges_lehmann.high}); {usable} of {n} \
         pairs have a ratio.",
        "The ratio a/b has no centre: {hodges_lehmann.reason}.",
    ];
    args.json.show(&sentences, &found)
}
