//! `rocking fragility`: lognormal fits of a sample and Eqs. 5 to 7.

mod band;
mod blocks;
mod compare;
mod counts;
mod export;
mod levels;
pub(super) mod limits;
mod sample;
mod surrogate;

pub(super) use counts::COLUMNS as COUNTS;

use std::path::PathBuf;

use clap::{ArgGroup, Args as ClapArgs};
use rocking::capacity::InversionRule;
use rocking::fragility::{FragilityError, c_max, eq5, eq6, eq7};
use rocking::statistics::lognormal::FitMethod;
use serde_json::{Map, Value, json};

use super::capacities::Levels;
use super::names;
use super::samples::Shift;
use super::{Failure, print, print_json};
use crate::paper::Intensity;

/// Lognormal fragilities of a sample, or Eqs. 5 to 7 alone.
///
/// With a shift IM_R, mu and beta are fitted to the sample above it (SSFL);
/// eq5, eq6 and eq7 are what the unshifted statistics give instead: eq5 and
/// eq7 from the same method's fit to the unshifted sample (USFL7), eq6 from
/// the sample's 16 and 84 % quantiles. Medians, quantiles and shift are in
/// the unit of the sample.
///
/// A block alone asks the surrogate: overturning under the embedded suites by
/// a fitted surface, with its error at blocks that it was not fitted to.
#[derive(ClapArgs)]
#[command(group = ArgGroup::new("mode").required(true)
    .args(["sample", "ida", "counts", "transform", "blocks", "alpha",
        "width_m"]).multiple(true))]
#[command(group = ArgGroup::new("draws").args(["bootstrap", "compare"]))]
#[command(after_help = "Examples:\n  \
    rocking fragility --ida ida.csv --at 0.3,0.5,1 --shift 1\n  \
    rocking fragility --sample capacities.txt --shift 1 --bootstrap 1000\n  \
    rocking fragility --sample capacities.txt --shift 1 --bootstrap 1000 \\\n      \
    --band 1.2:6:0.2 --band-csv band.csv\n  \
    rocking fragility --sample capacities.txt --shift free\n  \
    rocking fragility --sample capacities.txt --compare\n  \
    rocking fragility --counts counts.csv\n  \
    rocking fragility --transform --shift 1 --im50 2.5 --beta 0.4\n  \
    rocking fragility --alpha 0.15 --p 3\n  \
    rocking fragility --sample capacities.txt --shift 1 --im pga \\\n      \
    --alpha 0.15 --p 3 --export nrml --out block.xml\n  \
    rocking fragility --blocks blocks.csv --shift 1 --export pelicun \\\n      \
    --out fragility.csv")]
pub struct Args {
    /// Sample file: one value a line, `>3.2` for one censored at 3.2, `inf`
    /// for one censored at a limit that is not told, `#` comments; `-` is
    /// standard input.
    #[arg(
        long,
        value_name = "FILE",
        conflicts_with_all = ["ida", "transform", "counts"]
    )]
    sample: Option<PathBuf>,
    /// Table of `rocking ida`: fits of the capacities at the levels --at;
    /// `-` is standard input.
    #[arg(
        long,
        value_name = "FILE",
        requires = "at",
        conflicts_with = "transform"
    )]
    ida: Option<PathBuf>,
    /// Table of counts, columns im,exceeded,n: how many of n records exceeded
    /// a level, or overturned, at each intensity. Maximum likelihood of
    /// binomial counts, with likelihood intervals (95 %) that take the
    /// stripes as independent.
    #[arg(
        long,
        value_name = "FILE.csv",
        conflicts_with_all = ["method", "quantile_type", "c", "bootstrap"]
    )]
    counts: Option<PathBuf>,
    /// EDP levels of --ida, FIRST:LAST:STEP or separated by commas.
    #[arg(
        long,
        value_name = "LEVELS",
        requires = "ida",
        allow_hyphen_values = true
    )]
    at: Option<Levels>,
    /// Intensity measure, of --ida [default: pga] or of a sample that does
    /// not say it.
    #[arg(
        long,
        value_parser = names::intensity(),
        conflicts_with = "transform"
    )]
    im: Option<Intensity>,
    /// Which single capacity is made of several crossings [default: median].
    #[arg(long, value_parser = names::crossing(), requires = "ida")]
    point: Option<InversionRule>,
    /// Eqs. 5 to 7 from given numbers.
    #[arg(long)]
    transform: bool,
    /// Shift IM_R, not negative; `min` takes the smallest value of the
    /// sample and leaves it out of the fit. The smallest value lies above the
    /// shift of the truth, so that `min` overstates the dispersion: 0.88 for
    /// 0.60 with 86 values; it takes no --bootstrap. `free` takes the shift
    /// that maximises the likelihood, with its likelihood interval (95 %); it
    /// is refused where there is none below the smallest value.
    #[arg(long, value_name = "X|min|free", allow_hyphen_values = true)]
    shift: Option<Shift>,
    /// How the lognormal distribution is fitted [default: mle].
    #[arg(
        long,
        value_parser = names::fit_method(),
        conflicts_with = "transform"
    )]
    method: Option<FitMethod>,
    /// Type of the quantiles, 1 to 9 [default: 5].
    #[arg(long, value_name = "TYPE", conflicts_with = "transform")]
    quantile_type: Option<u8>,
    /// Constant c of Eq. 7 [default: 1].
    #[arg(long)]
    c: Option<f64>,
    /// Bootstrap this many samples for intervals.
    #[arg(long, value_name = "N", conflicts_with_all = ["transform", "ida"])]
    bootstrap: Option<usize>,
    #[command(flatten)]
    band: band::BandArgs,
    /// Compare lognormal, shifted lognormal (its shift fitted too), Weibull,
    /// gamma and generalized extreme value distributions, fitted by maximum
    /// likelihood: AIC, BIC, and the p-values of D and A2 with the parameters
    /// fitted, from N samples of each fit. Lognormal, Weibull and gamma lie
    /// above --shift.
    #[arg(
        long,
        value_name = "N",
        num_args = 0..=1,
        default_missing_value = "1000",
        requires = "sample",
        conflicts_with_all = ["method", "quantile_type", "c", "bootstrap"],
        value_parser = clap::value_parser!(u64).range(1..=1_000_000)
    )]
    compare: Option<u64>,
    /// Repetition of the bootstrap.
    #[arg(
        long,
        value_name = "S",
        requires = "draws",
        conflicts_with = "transform"
    )]
    seed: Option<u64>,
    /// Threads of the bootstrap; the result doesn't depend on them.
    #[arg(
        long,
        value_name = "N",
        requires = "draws",
        conflicts_with = "transform"
    )]
    threads: Option<usize>,
    /// Unshifted median IM50.
    #[arg(
        long,
        value_name = "X",
        conflicts_with_all = ["sample", "ida", "counts"]
    )]
    im50: Option<f64>,
    /// Unshifted dispersion beta_o.
    #[arg(
        long,
        value_name = "B",
        conflicts_with_all = ["sample", "ida", "counts"]
    )]
    beta: Option<f64>,
    /// Unshifted 16 % quantile IM16.
    #[arg(
        long,
        value_name = "X",
        requires = "im84",
        conflicts_with_all = ["sample", "ida", "counts"]
    )]
    im16: Option<f64>,
    /// Unshifted 84 % quantile IM84.
    #[arg(
        long,
        value_name = "X",
        requires = "im16",
        conflicts_with_all = ["sample", "ida", "counts"]
    )]
    im84: Option<f64>,
    #[command(flatten)]
    export: export::ExportArgs,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for input that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    let given = args.sample.is_some() || args.ida.is_some();
    if !given
        && args.counts.is_none()
        && !args.transform
        && let Some(block) = args.export.alone()?
    {
        return surrogate::run(args, &block);
    }
    if let Some(format) = args.export.format()? {
        return export::run(args, format);
    }
    if let Some(path) = &args.counts {
        return counts::run(args, path);
    }
    if let (Some(path), Some(replicates)) = (&args.sample, args.compare) {
        return compare::run(args, path, replicates);
    }
    match (&args.sample, &args.ida) {
        (Some(path), _) => sample::run(args, path),
        (None, Some(path)) => levels::run(args, path),
        (None, None) => transform(args),
    }
}

/// An equation's value under its key, or null, with the reason (and c_max
/// where there is one) beside it.
fn insert(
    out: &mut Map<String, Value>,
    key: &str,
    value: Result<f64, FragilityError>,
) {
    match value {
        Ok(value) => {
            out.insert(key.to_owned(), json!(value));
        }
        Err(error) => {
            out.insert(key.to_owned(), Value::Null);
            out.insert(format!("{key}_error"), error.to_string().into());
        }
    }
}

fn transform(args: &Args) -> Result<(), Failure> {
    let Some(Shift::Given(shift)) = args.shift else {
        return Err(Failure::input(
            "--transform needs --shift X, a number not negative",
        ));
    };
    let mut out = Map::new();
    out.insert("im_unit".to_owned(), "that of the numbers given".into());
    out.insert("shift".to_owned(), json!(shift));
    let given = [
        ("im16", args.im16),
        ("im50", args.im50),
        ("im84", args.im84),
        ("beta", args.beta),
    ];
    for (key, value) in given {
        if let Some(value) = value {
            out.insert(key.to_owned(), json!(value));
        }
    }
    if args.im50.is_none() && args.im16.is_none() {
        return Err(Failure::input(
            "--transform needs --im50 and --beta, or --im16 and --im84, or both",
        ));
    }
    if args.c.is_some() && args.beta.is_none() {
        return Err(Failure::input("--c is not used without --beta"));
    }
    if let Some(median) = args.im50 {
        insert(&mut out, "eq5", eq5(median, shift));
    }
    if let (Some(im16), Some(im84)) = (args.im16, args.im84) {
        insert(&mut out, "eq6", eq6(im16, im84, shift));
    }
    if let Some(beta) = args.beta {
        let Some(median) = args.im50 else {
            return Err(Failure::input("--beta needs --im50"));
        };
        let c = args.c.unwrap_or(1.0);
        out.insert("c".to_owned(), json!(c));
        insert(&mut out, "eq7", eq7(median, beta, shift, c));
        let limit = c_max(median, beta, shift).ok();
        out.insert("c_max".to_owned(), json!(limit));
    }
    show(args, out)
}

fn show(args: &Args, out: Map<String, Value>) -> Result<(), Failure> {
    if args.json {
        return print_json(Value::Object(out));
    }
    print(&rows(&out))
}

/// Rows of a name and a value; after them, for each object among the values,
/// its own rows and a table of the objects in it.
fn rows(out: &Map<String, Value>) -> String {
    let mut text = String::new();
    let mut tables = String::new();
    for (key, value) in out {
        if let Value::Object(inner) = value {
            tables += &format!("\n{key}\n{}", table(inner));
        } else {
            text += &format!("{key:<24}{}\n", cell(value));
        }
    }
    text + &tables
}

/// Rows of the values, then one row for each object, its keys in the head.
fn table(out: &Map<String, Value>) -> String {
    let mut text = String::new();
    let mut body = String::new();
    let mut names: Vec<&String> = Vec::new();
    for (key, value) in out {
        let Value::Object(inner) = value else {
            text += &format!("{key:<24}{}\n", cell(value));
            continue;
        };
        names = inner.keys().collect();
        let cells = inner.values().map(|v| format!(" {:>14}", cell(v)));
        body += &format!("{key:<9}{}\n", cells.collect::<String>());
    }
    let head: String =
        names.iter().map(|name| format!(" {name:>14}")).collect();
    format!("{text}{:<9}{head}\n{body}", "")
}

fn cell(value: &Value) -> String {
    match value {
        Value::Null => "none".into(),
        Value::String(text) => text.clone(),
        Value::Number(number) => number
            .as_f64()
            .filter(|_| number.is_f64())
            .map_or(number.to_string(), |value| format!("{value:.6}")),
        other => other.to_string(),
    }
}
