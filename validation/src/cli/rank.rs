//! `rocking rank`: which intensity measure tells the capacities best.

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::Args as ClapArgs;
use libm::log;
use rocking::capacity::{Capacity, InversionRule};
use rocking::intensity::{Intensity, IntensityMeasure as M};
use rocking::statistics::bootstrap::{Bootstrap, Estimate, estimate};
use rocking::statistics::lognormal::fit_intervals;
use rocking::statistics::regression::{Line, line};
use serde_json::{Value, json};

use super::capacities::ida;
use super::measure::{Ground, GroundArgs};
use super::names;
use super::{Failure, print, print_json, with_threads};
use crate::draw::figures::{
    Chart, ChartAxis, ChartPanel, Heading, Mark, Scale, Series,
};
use crate::draw::markup;
use crate::files::Outputs;

/// Level of the intervals.
const LEVEL: f64 = 0.95;

/// Efficiency and sufficiency of intensity measures for a block.
///
/// The capacity of a record is its measure, scaled to where the response
/// reaches --at. Efficiency is the dispersion beta of these capacities
/// (lognormal, maximum likelihood, censored records by their limits): the
/// smaller, the fewer records are needed; Arias intensity, which grows with
/// the square of the acceleration, enters by its root. Sufficiency is the slope of the
/// logarithm of the capacity on magnitude, and on the logarithm of distance
/// (least squares): a small p-value says that the measure leaves out what
/// magnitude or distance tells. Intervals are of the bootstrap of records,
/// one draw for all measures.
#[derive(ClapArgs)]
#[command(after_help = "Examples:\n  \
    rocking rank --ida ida.csv --suite SUITE --at 1\n  \
    rocking rank --ida ida.csv --suite SUITE --at 1 --im pga --im sa:1 \
    --im avgsa:0.5,1,2 --magnitude mw --distance rrup_km --plot rank.svg")]
pub struct Args {
    /// Table of `rocking ida`; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    ida: PathBuf,
    /// Response (EDP) whose capacities are ranked; at 1 the block stands on
    /// its corner.
    #[arg(long, value_name = "E")]
    at: f64,
    /// An intensity measure: pga, pgv, pgd, arias, cav,
    /// pgv-d575 (PGV D5-75^(1/4)), sa:T, avgsa:T1,T2,.. (geometric mean,
    /// periods in s) or column:NAME (of --attributes or the index,
    /// proportional to the acceleration); again for each one [default: pga,
    /// pgv, pgd, arias, cav, pgv-d575, sa at 0.5, 1, 2, 3 and 4 s, and
    /// avgsa:0.5,1,1.5,2,3]. Ratios are to the first one.
    #[arg(long, value_name = "MEASURE")]
    im: Vec<M>,
    #[command(flatten)]
    ground: GroundArgs,
    /// Which single capacity is made of several crossings.
    #[arg(
        long,
        value_parser = names::crossing(),
        default_value_t = InversionRule::Median
    )]
    point: InversionRule,
    /// Column of the magnitude.
    #[arg(long, value_name = "COLUMN")]
    magnitude: Option<String>,
    /// Column of the distance, whose logarithm is taken.
    #[arg(long, value_name = "COLUMN")]
    distance: Option<String>,
    /// Draws of the bootstrap.
    #[arg(
        long,
        value_name = "N",
        default_value_t = 1000,
        value_parser = clap::value_parser!(u32).range(2..=1_000_000)
    )]
    bootstrap: u32,
    /// Repetition of the bootstrap.
    #[arg(long, value_name = "S", default_value_t = 0)]
    seed: u64,
    /// Draw the dispersions with their intervals.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Threads; the result doesn't depend on them.
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// A measure, and what was found of it.
struct Row {
    measure: M,
    median: f64,
    beta: Option<Estimate>,
    /// Dispersion over that of the first measure.
    ratio: Option<Estimate>,
    magnitude: Option<Line>,
    distance: Option<Line>,
}

impl Row {
    fn name(&self) -> String {
        let of = if self.measure.is_squared() { "root of " } else { "" };
        format!("{of}{}", self.measure.words())
    }
}

/// Capacities of the records in one measure, as intervals.
type Capacities = Vec<(f64, f64)>;

/// Runs the command.
///
/// # Errors
/// [`Failure`] for files that are refused, or capacities that make no fit.
pub fn run(args: &Args) -> Result<(), Failure> {
    let measures = if args.im.is_empty() {
        let mut all = vec![M::Pga, M::Pgv, M::Pgd, M::Arias, M::Cav];
        all.push(M::PgvDuration);
        all.extend([0.5, 1.0, 2.0, 3.0, 4.0].map(M::Sa));
        all.push(M::AverageSa(vec![0.5, 1.0, 1.5, 2.0, 3.0]));
        all
    } else {
        args.im.clone()
    };
    let mut inputs = args.ground.inputs();
    inputs.push(args.ida.clone());
    let mut outputs = Outputs::of(inputs);
    let plot = outputs.open_some(args.plot.as_ref())?;
    let table = ida::read(&args.ida, Intensity::Pga)?;
    let mut capacities = Vec::new();
    for (_, curve) in &table.curves {
        capacities.push(match curve.capacity(args.at, args.point)? {
            Capacity::Reached(im) => (im, im),
            Capacity::Censored { above } => (above, f64::INFINITY),
        });
    }
    let (rows, censored) = with_threads(args.threads, || {
        let ground = args.ground.ground(&table, &measures)?;
        rank(args, &ground, &capacities, measures)
    })??;
    if let Some(out) = plot {
        out.write(args.chart(&rows).figure(String::new()).svg())?;
    }
    if args.json {
        return print_json(args.to_json(&rows, capacities.len(), censored));
    }
    print(&args.to_text(&rows, capacities.len(), censored)?)
}

fn rank(
    args: &Args,
    ground: &Ground,
    capacities: &[(f64, f64)],
    measures: Vec<M>,
) -> Result<(Vec<Row>, usize), Failure> {
    let mut all: Vec<Capacities> = Vec::new();
    for measure in &measures {
        let factors = ground.at_uplift(measure)?;
        // By its root, a measure that grows with the square of the
        // acceleration has a dispersion that compares with the others'.
        let convert = |(&(low, high), factor): (&(f64, f64), &f64)| {
            let factor =
                if measure.is_squared() { factor.sqrt() } else { *factor };
            (factor * low, factor * high)
        };
        all.push(capacities.iter().zip(&factors).map(convert).collect());
    }
    let censored = capacities.iter().filter(|c| c.1.is_infinite()).count();
    // A line through the logarithms of capacities that are all reached.
    let lines = |column: Option<&String>, of: fn(f64) -> f64| {
        let Some(name) = column.filter(|_| censored == 0) else {
            return Ok::<_, Failure>(vec![None; all.len()]);
        };
        let column = ground.column(name)?;
        let x: Vec<f64> = column.into_iter().map(of).collect();
        let found = all.iter().map(|capacities| {
            let y: Vec<f64> = capacities.iter().map(|c| log(c.0)).collect();
            Ok(Some(line(&x, &y)?))
        });
        found.collect()
    };
    let magnitude = lines(args.magnitude.as_ref(), |x| x)?;
    let distance = lines(args.distance.as_ref(), log)?;
    let beta = |capacities: &[(f64, f64)]| {
        let fit = fit_intervals(capacities, 0.0);
        fit.map_or(f64::NAN, |fit| fit.distribution.dispersion())
    };
    let replicates = args.bootstrap as usize;
    let n = capacities.len();
    let draws = Bootstrap::new("rank", args.seed, n, replicates);
    let drawn: Vec<Vec<f64>> = draws.map(|draw| {
        let pick = |capacities: &Capacities| {
            let own: Vec<_> = draw.iter().map(|&i| capacities[i]).collect();
            beta(&own)
        };
        all.iter().map(pick).collect()
    });
    let mut rows = Vec::new();
    let first = beta(&all[0]);
    for (i, measure) in measures.into_iter().enumerate() {
        let fit = fit_intervals(&all[i], 0.0).map_err(|error| {
            Failure::input(format!("{}: {error}", measure.words()))
        })?;
        let own = fit.distribution.dispersion();
        let column: Vec<f64> = drawn.iter().map(|row| row[i]).collect();
        let ratios: Vec<f64> =
            drawn.iter().map(|row| row[i] / row[0]).collect();
        rows.push(Row {
            measure,
            median: fit.distribution.median(),
            beta: estimate(own, &column, LEVEL),
            ratio: estimate(own / first, &ratios, LEVEL),
            magnitude: magnitude[i],
            distance: distance[i],
        });
    }
    Ok((rows, censored))
}

/// A few letters, for the tick of an axis; Arias intensity by its root.
fn short(measure: &M) -> String {
    match measure {
        M::Arias => "√Arias".into(),
        M::PgvDuration => "PGV D".into(),
        M::Sa(period_s) => format!("SA({period_s})"),
        M::AverageSa(periods_s) => {
            let (first, last) = (periods_s.first(), periods_s.last());
            let of = |t: Option<&f64>| t.copied().unwrap_or(f64::NAN);
            format!("SA({}–{})", of(first), of(last))
        }
        M::Column(name) => name.clone(),
        word => word.to_string().to_uppercase(),
    }
}

impl Args {
    /// Why there is no line, if a column was named and there is none.
    fn no_lines(&self, censored: usize) -> Option<String> {
        let named = self.magnitude.is_some() || self.distance.is_some();
        (named && censored > 0).then(|| {
            format!("no slopes: {censored} censored capacities have no value")
        })
    }

    fn to_json(&self, rows: &[Row], n: usize, censored: usize) -> Value {
        let interval = |estimate: &Option<Estimate>| {
            estimate.as_ref().map(|e| {
                json!({
                    "value": json!(e.point),
                    "low": json!(e.low),
                    "high": json!(e.high),
                })
            })
        };
        let slope = |line: &Option<Line>| {
            line.as_ref().map(|line| {
                json!({
                    "slope": json!(line.slope),
                    "standard_error": json!(line.standard_error),
                    "p_value": json!(line.p_value),
                })
            })
        };
        let row = |row: &Row| {
            json!({
                "im": row.name(),
                "median": json!(row.median),
                "beta": interval(&row.beta),
                "ratio_to_first": interval(&row.ratio),
                "on_magnitude": slope(&row.magnitude),
                "on_ln_distance": slope(&row.distance),
            })
        };
        json!({
            "edp": json!(self.at),
            "point": self.point.to_string(),
            "n": n,
            "censored": censored,
            "interval_level": LEVEL,
            "replicates": self.bootstrap,
            "seed": self.seed,
            "remark": self.no_lines(censored),
            "measures": rows.iter().map(row).collect::<Vec<_>>(),
        })
    }

    /// The dispersions, side by side.
    fn chart(&self, rows: &[Row]) -> Chart {
        let none = (f64::NAN, f64::NAN);
        let beta = rows.iter().map(|row| row.beta.as_ref());
        let x = ChartAxis {
            label: String::new(),
            scale: Scale::Linear,
            range: None,
            categories: rows
                .iter()
                .map(|row| markup::escape(&short(&row.measure)))
                .collect(),
            second: None,
        };
        let label = format!("dispersion at EDP {}", self.at);
        let series = Series {
            label: "95 % interval by the bootstrap of records".into(),
            mark: Mark::Points,
            x: (1..=rows.len()).map(|k| k as f64).collect(),
            y: beta.clone().map(|b| b.map_or(f64::NAN, |e| e.point)).collect(),
            interval: beta
                .map(|b| b.map_or(none, |e| (e.low, e.high)))
                .collect(),
        };
        let ends = series.interval.iter().map(|ends| ends.1);
        let most = ends.fold(0.0, f64::max);
        let top = if most > 0.0 { 1.1 * most } else { 1.0 };
        let y = ChartAxis::new(label, Scale::Linear, Some((0.0, top)));
        Chart {
            heading: Heading::new(
                "rank",
                "Efficiency of intensity measures",
                format!(
                    "Dispersion of the intensity at EDP {} in {} intensity \
                     measures, with 95 % intervals.",
                    self.at,
                    rows.len()
                ),
                None,
            ),
            panels: vec![ChartPanel {
                title: String::new(),
                x,
                y,
                series: vec![series],
            }],
            columns: 1,
        }
    }

    fn to_text(
        &self,
        rows: &[Row],
        n: usize,
        censored: usize,
    ) -> Result<String, Failure> {
        let mut text = format!(
            "{n} records, {censored} censored, EDP {}, {} crossing\n\
             {:<30} {:>9} {:>24} {:>24}",
            self.at,
            self.point,
            "measure",
            "median",
            "beta (95 %)",
            "ratio to first (95 %)",
        );
        let magnitude = rows.iter().any(|row| row.magnitude.is_some());
        let distance = rows.iter().any(|row| row.distance.is_some());
        let mut head = |there: bool, title: &str| {
            if there {
                text += &format!(" {title:>16} {:>8}", "p");
            }
        };
        head(magnitude, "slope on M");
        head(distance, "slope on ln R");
        text += "\n";
        let interval = |estimate: &Option<Estimate>| {
            estimate.as_ref().map_or("none".to_owned(), |e| {
                format!("{:.3} ({:.3} to {:.3})", e.point, e.low, e.high)
            })
        };
        for row in rows {
            write!(
                text,
                "{:<30} {:>9.4} {:>24} {:>24}",
                row.name(),
                row.median,
                interval(&row.beta),
                interval(&row.ratio),
            )?;
            for line in [&row.magnitude, &row.distance].into_iter().flatten() {
                let (slope, p) = (line.slope, line.p_value);
                write!(text, " {slope:>16.3} {p:>8.4}")?;
            }
            text += "\n";
        }
        if let Some(remark) = self.no_lines(censored) {
            text += &format!("{remark}\n");
        }
        Ok(text)
    }
}
