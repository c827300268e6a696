//! `rocking stripes`: EDP given IM from an IDA table.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::capacity::ResponseCurve;
use rocking::statistics::{ExtendedSample, QuantileType};
use serde_json::json;

use super::capacities::{Levels, ida};
use super::fragility::COUNTS;
use super::names;
use super::{Failure, print, print_json};
use crate::files::Outputs;
use crate::json;
use crate::paper::Intensity;
use crate::table::Table;

/// Responses at given intensities, of all records of an IDA table.
///
/// At a stripe the response of a record is read from its curve, linear
/// between analyses; it is infinite from the first overturning on. Where a
/// record was not run so far, the stripe is open for it: such records are
/// counted and left out.
#[derive(ClapArgs)]
#[command(after_help = "Examples:\n  \
    rocking stripes --ida ida.csv --levels 1.5,2,3\n  \
    rocking stripes --ida ida.csv --levels 1.2:4:0.2 --at 0.5 \
    --counts counts.csv")]
pub struct Args {
    /// Table of `rocking ida`; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    ida: PathBuf,
    /// Intensity measure.
    #[arg(
        long,
        value_parser = names::intensity(),
        default_value_t = Intensity::Pga
    )]
    im: Intensity,
    /// Intensities, FIRST:LAST:STEP or separated by commas.
    #[arg(long, value_name = "LEVELS", allow_hyphen_values = true)]
    levels: Levels,
    /// EDP level whose exceedances --counts counts; `inf` is overturning.
    #[arg(long, value_name = "E", requires = "counts")]
    at: Option<f64>,
    /// Write how many records exceed --at at each intensity, for `rocking
    /// fragility --counts`; `-` is standard output, and nothing else is
    /// printed then.
    #[arg(long, value_name = "OUT.csv", requires = "at")]
    counts: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// The responses at one intensity.
struct Stripe {
    im: f64,
    /// 16, 50 and 84 % quantiles, infinite where overturned.
    quantiles: [f64; 3],
    n: usize,
    overturned: usize,
    open: usize,
    /// Number of records at or above --at.
    exceeded: usize,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a file or a level that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    if args.at.is_some_and(|edp| !(edp > 0.0)) {
        return Err(Failure::input(
            "--at: expected a positive number, or inf",
        ));
    }
    let mut outputs = Outputs::of(vec![args.ida.clone()]);
    let counts = outputs.open_some(args.counts.as_ref())?;
    let suite = ida::read(&args.ida, args.im)?;
    let curves = suite.curves.into_iter().map(|(_, curve)| curve);
    let curves: Vec<ResponseCurve> = curves.collect();
    let mut stripes = Vec::new();
    for &im in &args.levels.0 {
        stripes.push(stripe(&curves, im, args.at)?);
    }
    if let Some(out) = counts {
        let is_standard = out.is_standard();
        let mut table = Table::new(&COUNTS);
        for s in &stripes {
            let counts = [s.exceeded.to_string(), s.n.to_string()];
            table.row([s.im.to_string()].into_iter().chain(counts));
        }
        out.write(table.finish())?;
        if is_standard {
            return Ok(());
        }
    }
    if args.json {
        let rows = stripes.iter().map(|s| {
            json!({
                "im": json!(s.im),
                "n": s.n,
                "edp16": json::extended(s.quantiles[0]),
                "edp50": json::extended(s.quantiles[1]),
                "edp84": json::extended(s.quantiles[2]),
                "overturned": s.overturned,
                "open": s.open,
                "exceeded": args.at.map(|_| s.exceeded),
            })
        });
        let rows: Vec<_> = rows.collect();
        return print_json(json!({
            "n": curves.len(),
            "at": args.at.map(json::extended),
            "stripes": rows,
        }));
    }
    let mut text = format!(
        "{} records\n{:>8} {:>8} {:>9} {:>9} {:>9} {:>10} {:>5}\n",
        curves.len(),
        "IM",
        "records",
        "16 %",
        "50 %",
        "84 %",
        "overturned",
        "open"
    );
    for s in &stripes {
        let [low, median, high] = s.quantiles;
        writeln!(
            text,
            "{:>8} {:>8} {low:>9.5} {median:>9.5} {high:>9.5} {:>10} {:>5}",
            s.im, s.n, s.overturned, s.open
        )?;
    }
    print(&text)
}

fn stripe(
    curves: &[ResponseCurve],
    im: f64,
    at: Option<f64>,
) -> Result<Stripe, Failure> {
    let known = curves.iter().filter_map(|curve| curve.edp_at(im));
    let known: Vec<f64> = known.collect();
    let sample = ExtendedSample::try_new(&known).map_err(|_| {
        Failure::input(format!("--levels {im}: no record was run so far"))
    })?;
    let quantile = |p| QuantileType::default().of_extended(&sample, p);
    let exceeds = |edp: &&f64| at.is_some_and(|at| **edp >= at);
    Ok(Stripe {
        im,
        quantiles: [quantile(0.16)?, quantile(0.5)?, quantile(0.84)?],
        n: known.len(),
        overturned: sample.censored(),
        open: curves.len() - known.len(),
        exceeded: known.iter().filter(exceeds).count(),
    })
}
