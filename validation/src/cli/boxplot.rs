//! `rocking boxplot`: the numbers of a notched boxplot.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::statistics::{Boxplot, QuantileType};
use serde_json::{Value, json};

use super::samples::SampleFile;
use super::{Failure, print, print_json};

/// Quartiles, whiskers, outliers and McGill's notch of a sample, with the
/// exact order-statistic interval of its median.
#[derive(ClapArgs)]
pub struct Args {
    /// Sample file: one value a line, `inf` for a censored one, `#` comments.
    #[arg(long, value_name = "FILE")]
    sample: PathBuf,
    /// Type of the quartiles, 1 to 9: 5 is MATLAB's, 7 that of R and NumPy.
    #[arg(long, value_name = "TYPE", default_value_t = 5)]
    quantile_type: u8,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a sample or a type that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    let quantile_type = QuantileType::try_new(args.quantile_type)?;
    let sample = SampleFile::read(&args.sample)?.extended()?;
    let boxplot = Boxplot::try_new(&sample, quantile_type)?;
    if args.json {
        return print_json(to_json(&boxplot, quantile_type));
    }
    print(&to_text(&boxplot))
}

/// The boxplot as JSON.
#[must_use]
pub fn to_json(boxplot: &Boxplot, quantile_type: QuantileType) -> Value {
    let interval = boxplot.median_interval;
    json!({
        "n": boxplot.n,
        "quantile_type": quantile_type.number(),
        "q1": boxplot.q1,
        "median": boxplot.median,
        "q3": boxplot.q3,
        "notch_low": boxplot.notch_low,
        "notch_high": boxplot.notch_high,
        "whisker_low": boxplot.whisker_low,
        "whisker_high": boxplot.whisker_high,
        "outliers": &boxplot.outliers,
        "median_low": interval.map(|i| i.low),
        "median_high": interval.map(|i| i.high),
        "median_coverage": interval.map(|i| i.coverage),
    })
}

/// The boxplot as lines of text.
#[must_use]
pub fn to_text(boxplot: &Boxplot) -> String {
    let interval = boxplot.median_interval.map_or_else(
        || "none: fewer than 6 values".to_owned(),
        |i| {
            let percent = 100.0 * i.coverage;
            format!("{:.6} .. {:.6} ({percent:.2} %)", i.low, i.high)
        },
    );
    format!(
        "values                  {}\n\
         quartiles               {:.6}  {:.6}  {:.6}\n\
         McGill notch            {:.6} .. {:.6}\n\
         median, exact interval  {interval}\n\
         whiskers                {:.6} .. {:.6}\n\
         outliers                {}\n",
        boxplot.n,
        boxplot.q1,
        boxplot.median,
        boxplot.q3,
        boxplot.notch_low,
        boxplot.notch_high,
        boxplot.whisker_low,
        boxplot.whisker_high,
        boxplot.outliers.len(),
    )
}
