//! `rocking sample`: quantiles and boxplot of a sample.

use std::path::PathBuf;

use rocking_procedures::summarise;
use rocking_statistics::QuantileType;

use super::shared::JsonArg;
use crate::failure::Failure;
use crate::input;

/// Quantiles of a sample by named type (Hyndman and Fan 1996), its quartiles,
/// whiskers, outliers and McGill's notch, and the exact order-statistic
/// interval of its median.
#[derive(clap::Args)]
pub struct SampleCommand {
    /// Sample file: one value per line, `inf` for a censored one, `#` comments;
    /// `-` is standard input.
    #[arg(long, value_name = "FILE")]
    sample: PathBuf,
    /// Probabilities in [0, 1], separated by commas.
    #[arg(
        long,
        value_name = "P,..",
        value_delimiter = ',',
        default_value = "0.16,0.5,0.84"
    )]
    at: Vec<f64>,
    /// Type of the quantiles, 1 to 9: 5 is MATLAB's, 7 is R's and NumPy's.
    #[arg(long, value_name = "TYPE", default_value_t = 5)]
    quantile_type: u8,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking sample`.
///
/// # Errors
/// [`Failure`] for a sample, a type or a probability that is refused.
pub fn run_sample(args: &SampleCommand) -> Result<(), Failure> {
    let quantile_type = QuantileType::try_new(args.quantile_type)?;
    let sample = input::sample(&args.sample)?.extended()?;
    let found = summarise(&sample, &args.at, quantile_type)?;
    let sentences = [
        "The median of {n} values is {boxplot.median}.",
        "{n} values: {boxplot.reason}.",
    ];
    args.json.show(&sentences, &found)
}
