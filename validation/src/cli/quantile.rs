//! `rocking quantile`: quantiles of a sample by named type.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::statistics::QuantileType;
use serde_json::json;

use super::samples::SampleFile;
use super::{Failure, print, print_json};

/// Quantiles of a sample by named type (Hyndman and Fan 1996).
#[derive(ClapArgs)]
pub struct Args {
    /// Sample file: one value a line, `inf` for a censored one, `#` comments.
    #[arg(long, value_name = "FILE")]
    sample: PathBuf,
    /// Type of the quantile, 1 to 9: 5 is MATLAB's, 7 that of R and NumPy.
    #[arg(long = "type", value_name = "TYPE", default_value_t = 5)]
    quantile_type: u8,
    /// Probabilities in [0, 1], separated by commas.
    #[arg(
        long,
        value_name = "P,..",
        value_delimiter = ',',
        default_value = "0.16,0.5,0.84"
    )]
    at: Vec<f64>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a sample, a type or a probability that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    let quantile_type = QuantileType::try_new(args.quantile_type)?;
    let sample = SampleFile::read(&args.sample)?.extended()?;
    let mut values = Vec::new();
    for &p in &args.at {
        values.push(quantile_type.of_extended(&sample, p)?);
    }
    if args.json {
        let out = json!({
            "n": sample.len(),
            "type": quantile_type.number(),
            "at": &args.at,
            "values": &values,
        });
        return print_json(out);
    }
    let mut text = format!(
        "{} values, {} infinite; type {quantile_type}\n{:>10}  {:>12}\n",
        sample.len(),
        sample.censored(),
        "p",
        "quantile"
    );
    for (p, value) in args.at.iter().zip(&values) {
        writeln!(text, "{p:>10}  {value:>12.6}")?;
    }
    print(&text)
}
