//! `rocking risk`: how often a year a block overturns, or exceeds a demand.

use std::fmt::Write as _;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args as ClapArgs};
use rocking::fragility::risk::{AnnualFrequency, HazardCurve, HazardError};
use rocking::integrator::Model;
use rocking::procedures::{FitOptions, Shift, fit_sample};
use rocking::statistics::Lognormal;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::unit_intensity;
use serde_json::{Value, json};

use super::names;
use super::samples::{Opened, SampleFile};
use super::scene::BlockArgs;
use super::{Failure, print, print_json};
use rocking_common::paper::Intensity;

/// Mean annual frequency of overturning, or of exceeding a demand, from a
/// hazard curve and a fragility.
///
/// The hazard curve is a CSV of intensity and annual frequency of
/// exceedance, between whose points the frequency is a power of the
/// intensity. Its first column is `pga_g`, `pgv_m_s`, `pgv_cm_s`, or `im` for
/// the unit of the fragility. Nothing is assumed beyond its last point: the
/// frequency lies between two bounds of that truncation, which are no
/// confidence interval.
#[derive(ClapArgs)]
#[command(group = ArgGroup::new("fragility").required(true)
    .args(["median", "sample"]))]
#[command(after_help = "Examples:\n  \
    rocking risk --hazard hazard.csv --median 0.43 --dispersion 0.71 \
    --shift 0.15\n  \
    rocking risk --hazard hazard.csv --sample capacities.txt --shift 1 \\\n      \
    --alpha 0.15 --p 3\n\n\
    A hazard curve:\n  \
    pga_g,annual_frequency\n  0.05,0.02\n  0.2,0.002\n  1,0.00003")]
pub struct Args {
    /// Hazard curve, CSV; `-` is standard input.
    #[arg(long, value_name = "HAZARD.csv")]
    hazard: PathBuf,
    /// Median of the fragility, in the unit of the hazard curve.
    #[arg(long, value_name = "X", requires = "dispersion")]
    median: Option<f64>,
    /// Dispersion of the fragility, of the logarithm above the shift.
    #[arg(long, value_name = "B", requires = "median")]
    dispersion: Option<f64>,
    /// Sample of dimensionless capacities, fitted by maximum likelihood
    /// (`>3.2` is a value censored at 3.2), of the block --alpha --p or
    /// --width-m --height-m; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    sample: Option<PathBuf>,
    /// Shift, below which nothing happens: in the unit of the hazard curve
    /// with --median, of the sample with --sample [default: 0].
    #[arg(long, value_name = "X|min", allow_hyphen_values = true)]
    shift: Option<Shift>,
    /// Intensity measure of a sample that does not say it.
    #[arg(long, value_parser = names::intensity(), requires = "sample")]
    im: Option<Intensity>,
    #[command(flatten)]
    block: BlockArgs,
    /// Gravity in m/s2 [default: 9.80665].
    #[arg(long, value_name = "G", requires = "sample")]
    gravity: Option<f64>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// What a hazard curve's intensities are.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Column {
    name: &'static str,
    unit: &'static str,
    /// The measure, and the number of them in a g or a m/s; none for a
    /// curve in the fragility's own unit.
    measure: Option<(Intensity, f64)>,
}

const COLUMNS: [Column; 4] = [
    Column {
        name: "pga_g",
        unit: "PGA, g",
        measure: Some((Intensity::Pga, 1.0)),
    },
    Column {
        name: "pgv_m_s",
        unit: "PGV, m/s",
        measure: Some((Intensity::Pgv, 1.0)),
    },
    Column {
        name: "pgv_cm_s",
        unit: "PGV, cm/s",
        measure: Some((Intensity::Pgv, 100.0)),
    },
    Column { name: "im", unit: "intensity", measure: None },
];

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a curve, a sample or a parameter that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    if args.sample.as_deref() == Some(Path::new("-"))
        && args.hazard == Path::new("-")
    {
        return Err(Failure::input(
            "--hazard - and --sample -: expected one of them as a file",
        ));
    }
    let (column, hazard) = read(&args.hazard)?;
    let fragilities = match (&args.sample, args.median, args.dispersion) {
        (Some(path), ..) => of_sample(args, path, column)?,
        (None, Some(median), Some(beta)) => given(args, median, beta)?,
        _ => return Err(Failure::input("expected --median or --sample")),
    };
    let rows: Vec<(&str, Lognormal, AnnualFrequency)> = fragilities
        .into_iter()
        .map(|(name, f)| (name, f, hazard.annual_frequency(&f)))
        .collect();
    if args.json {
        return print_json(to_json(column, &hazard, &rows));
    }
    print(&to_text(column, &hazard, &rows)?)
}

/// Reads a hazard curve of two columns.
fn read(path: &Path) -> Result<(Column, HazardCurve), Failure> {
    let place = path.display();
    let broken = |e: &dyn std::fmt::Display| {
        Failure::input(format!("cannot read {place}: {e}"))
    };
    let mut text = String::new();
    let mut file = Opened::open(path).map_err(|e| broken(&e))?;
    file.read_to_string(&mut text).map_err(|e| broken(&e))?;
    let mut reader = csv::ReaderBuilder::new()
        .trim(csv::Trim::All)
        .comment(Some(b'#'))
        .from_reader(text.as_bytes());
    let header = reader.headers().map_err(|e| broken(&e))?;
    let cells: Vec<&str> = header.iter().collect();
    let column = COLUMNS
        .into_iter()
        .find(|column| cells == [column.name, "annual_frequency"]);
    let column = column.ok_or_else(|| {
        let names = COLUMNS.map(|column| column.name);
        Failure::input(format!(
            "{place}:1: found `{}`: expected {} and annual_frequency",
            cells.join(","),
            names.join(", or "),
        ))
    })?;
    let (mut points, mut lines) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = record.map_err(|e| broken(&e))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |k: usize| {
            let text = record.get(k).unwrap_or_default();
            text.parse::<f64>().map_err(|_| {
                Failure::input(format!(
                    "{place}:{line}: found `{text}`: expected a number"
                ))
            })
        };
        points.push((number(0)?, number(1)?));
        lines.push(line);
    }
    let hazard = HazardCurve::try_new(&points).map_err(|error| {
        let line = match error {
            HazardError::Intensity { number, .. }
            | HazardError::Frequency { number, .. } => lines
                .get(number - 1)
                .map_or(String::new(), |line| format!(":{line}")),
            _ => String::new(),
        };
        Failure::input(format!("{place}{line}: {error}"))
    })?;
    Ok((column, hazard))
}

/// The fragility of given parameters.
fn given(
    args: &Args,
    median: f64,
    beta: f64,
) -> Result<Vec<(&'static str, Lognormal)>, Failure> {
    if let Some(flag) = args.block.given() {
        return Err(Failure::input(format!(
            "{flag} is not used without --sample"
        )));
    }
    let shift = match args.shift {
        None => 0.0,
        Some(Shift::Given(shift)) => shift,
        Some(Shift::Smallest | Shift::Free) => {
            return Err(Failure::input(
                "--shift min or free: expected a number with --median",
            ));
        }
    };
    let log_mean = rocking::fragility::eq5(median, shift)?;
    let fragility = Lognormal::try_new(shift, log_mean, beta)?;
    Ok(vec![(if shift > 0.0 { "shifted" } else { "lognormal" }, fragility)])
}

/// The fits of a sample, with the shift where there is one and without, in
/// the unit of the hazard curve.
fn of_sample(
    args: &Args,
    path: &Path,
    column: Column,
) -> Result<Vec<(&'static str, Lognormal)>, Failure> {
    let file = SampleFile::read(path)?;
    let name = path.display();
    let at = |what: String| Failure::input(format!("{name}: {what}"));
    let factor = match column.measure {
        None => match args.block.given() {
            None => 1.0,
            Some(flag) => {
                return Err(Failure::input(format!(
                    "{flag}: the hazard curve is in `im`, the sample's own \
                     unit: expected no block, or pga_g, pgv_m_s or pgv_cm_s"
                )));
            }
        },
        Some((measure, per_unit)) => {
            let own = file.measure(args.im)?;
            if own != Some(measure) {
                return Err(at(format!(
                    "a sample of {}, a hazard of {}: expected the same \
                     measure",
                    own.map(Intensity::words)
                        .or(file.of())
                        .unwrap_or("a measure not stated"),
                    measure.name().to_uppercase(),
                )));
            }
            let gravity = args.gravity.unwrap_or(STANDARD_GRAVITY_M_S2);
            let block = args.block.block(gravity)?;
            file.setting().holds_for(&block, Some(measure)).map_err(at)?;
            let model = file.setting().model.unwrap_or(Model::Nonlinear);
            per_unit * unit_intensity(measure, &block, model, gravity)
        }
    };
    let sample = file.censored()?;
    let fitted = |shift: Shift| {
        let options = FitOptions { shift, ..FitOptions::default() };
        let found = fit_sample(&sample, &options);
        let found = found.map_err(|e| at(e.to_string()))?;
        Ok::<_, Failure>(found.fitted.scaled(factor)?)
    };
    let unshifted = ("not shifted", fitted(Shift::Given(0.0))?);
    Ok(match args.shift {
        None | Some(Shift::Given(0.0)) => vec![unshifted],
        Some(shift) => vec![("shifted", fitted(shift)?), unshifted],
    })
}

fn to_json(
    column: Column,
    hazard: &HazardCurve,
    rows: &[(&str, Lognormal, AnnualFrequency)],
) -> Value {
    let row = |(name, f, found): &(&str, Lognormal, AnnualFrequency)| {
        json!({
            "fragility": name,
            "shift": json!(f.shift()),
            "median": json!(f.median()),
            "dispersion": json!(f.dispersion()),
            "annual_frequency_truncation_lower":
                json!(found.truncation_lower),
            "annual_frequency_truncation_upper":
                json!(found.truncation_upper),
            "annual_frequency_covered": json!(found.covered),
            "probability_at_first_point":
                json!(found.first_probability),
        })
    };
    let points = hazard.points();
    json!({
        "unit": column.unit,
        "points": points.len(),
        "first_point": json!(&[points[0].0, points[0].1]),
        "last_point": json!(
            &[points[points.len() - 1].0, points[points.len() - 1].1]),
        "fragilities": rows.iter().map(row).collect::<Vec<_>>(),
    })
}

fn to_text(
    column: Column,
    hazard: &HazardCurve,
    rows: &[(&str, Lognormal, AnnualFrequency)],
) -> Result<String, Failure> {
    let points = hazard.points();
    let (first, last) = (points[0], points[points.len() - 1]);
    let mut text = format!(
        "hazard curve of {} points, {}, from {} ({} a year) to {} ({} a \
         year)\n{:<12} {:>9} {:>9} {:>9} {:>12} {:>12} {:>12} {:>11}\n",
        points.len(),
        column.unit,
        first.0,
        first.1,
        last.0,
        last.1,
        "fragility",
        "shift",
        "median",
        "beta",
        "at least",
        "at most",
        "covered",
        "F at first",
    );
    for (name, f, found) in rows {
        writeln!(
            text,
            "{name:<12} {:>9.5} {:>9.5} {:>9.5} {:>12.5e} {:>12.5e} \
             {:>12.5e} {:>11.2e}",
            f.shift(),
            f.median(),
            f.dispersion(),
            found.truncation_lower,
            found.truncation_upper,
            found.covered,
            found.first_probability,
        )?;
    }
    text += "mean annual frequencies, 1/year: at least with the damage of \
             the last point beyond it,\nat most with damage for certain \
             there; covered: between the points\nbounds of where the curve \
             ends, no confidence interval: records and hazard count as \
             known\n";
    if rows.iter().any(|(.., found)| found.first_probability > 0.0) {
        text += "weaker motions than the first point add to it where F is \
                 not 0 there: how much, the curve does not tell\n";
    }
    Ok(text)
}
