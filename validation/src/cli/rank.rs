//! `rocking rank`: which intensity measure tells the capacities best.

use std::path::PathBuf;

use clap::Args as ClapArgs;
use rocking::capacity::InversionRule;
use rocking::intensity::{Intensity, IntensityMeasure as M};
use rocking::procedures::capacities::intervals;
use rocking::procedures::ranking::{Covariate, Ranked};
use rocking::procedures::{Draws, Ranking, rank};
use serde::Serialize;

use super::capacities::ida;
use super::measure::{Ground, GroundArgs};
use super::names;
use super::show::show;
use super::{Failure, with_threads};
use rocking_common::files::Outputs;
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Heading, Mark, Scale, Series,
};
use rocking_draw::markup;

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
    #[arg(long, value_name = "N", default_value_t = 1000)]
    bootstrap: usize,
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

#[derive(Serialize)]
struct Shown {
    edp: f64,
    point: String,
    #[serde(flatten)]
    ranking: Ranking,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for files that are refused, or capacities that make no fit.
pub fn run(args: &Args) -> Result<(), Failure> {
    let measures = match args.im.as_slice() {
        [] => M::usual(),
        some => some.to_vec(),
    };
    let mut inputs = args.ground.inputs();
    inputs.push(args.ida.clone());
    let mut outputs = Outputs::of(inputs);
    let plot = outputs.open_some(args.plot.as_ref())?;
    let (table, curves) = ida::read(&args.ida, Intensity::Pga)?;
    let capacities = intervals(&curves.into_curves(), args.at, args.point)?;
    let draws = Draws { replicates: args.bootstrap, seed: args.seed };
    let ranking = with_threads(args.threads, || {
        let ground = args.ground.ground(&table, &measures)?;
        let candidates = ground.candidates(&measures)?;
        let covariates = args.covariates(&ground)?;
        Ok::<_, Failure>(rank(&capacities, &candidates, &covariates, draws)?)
    })??;
    if let Some(out) = plot {
        let chart = args.chart(&measures, &ranking.measures);
        out.write(chart.figure(String::new()).svg())?;
    }
    let point = args.point.to_string();
    show(args.json, &Shown { edp: args.at, point, ranking })
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
    /// The columns on which slopes are asked for.
    fn covariates(&self, ground: &Ground) -> Result<Vec<Covariate>, Failure> {
        let mut all = Vec::new();
        if let Some(column) = &self.magnitude {
            let values = ground.column(column)?;
            all.push(Covariate::magnitude(values));
        }
        if let Some(column) = &self.distance {
            all.push(Covariate::ln_distance(ground.column(column)?));
        }
        Ok(all)
    }

    /// The dispersions, side by side.
    fn chart(&self, measures: &[M], rows: &[Ranked]) -> Chart {
        let none = (f64::NAN, f64::NAN);
        let beta = rows.iter().map(|row| row.dispersion.as_ref());
        let x = ChartAxis {
            label: String::new(),
            scale: Scale::Linear,
            range: None,
            categories: measures
                .iter()
                .map(|measure| markup::escape(&short(measure)))
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
}
