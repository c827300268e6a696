//! `rocking rank`: which intensity measure predicts the capacities best.

use std::path::PathBuf;

use rocking::capacity::InversionRule;
use rocking_procedures::capacities::intervals;
use rocking_procedures::ranking::{Covariate, MeasureRank};
use rocking_procedures::{Ranking, rank};
use rocking_records::SetAside;
use rocking_records::intensity::{Intensity, IntensityMeasure as M};
use serde::Serialize;

use super::measure::{GroundArgs, SuiteMeasures};
use super::names;
use super::shared::{BootstrapArgs, JsonArg, PlotArg, ThreadsArg};
use super::show::number;
use crate::failure::Failure;
use crate::input;
use rocking_common::files::Outputs;
use rocking_draw::figures::of_result::ranking_svg;

/// Efficiency and sufficiency of intensity measures for a block.
///
/// The capacity of a record is its measure, scaled to where the response
/// reaches --at. Efficiency is the dispersion beta of these capacities
/// (lognormal, maximum likelihood, censored records at their limits): the
/// smaller it is, the fewer records are needed. Arias intensity grows with the
/// square of the acceleration, so its square root is ranked. Sufficiency is
/// the slope of the logarithm of the capacity on magnitude, and on the
/// logarithm of distance (least squares; with a random intercept for each
/// earthquake if the IDA states them): a small p-value means that magnitude or
/// distance adds information to the measure. Intervals are from a bootstrap,
/// which draws earthquakes if they are known, with the same draws for all
/// measures.
#[derive(clap::Args)]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw the dispersions with their intervals"
)))]
#[command(after_help = "Examples:\n  \
    rocking rank --ida ida.csv --suite SUITE --at 1\n  \
    rocking rank --ida ida.csv --suite SUITE --at 1 --im pga --im sa:1 \
    --im avgsa:rocking --magnitude mw --distance rrup_km --plot rank.svg")]
pub struct RankCommand {
    /// Table of `rocking ida`; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    ida: PathBuf,
    /// Response (EDP) whose capacities are ranked; at 1 the centre of mass is
    /// above the corner.
    #[arg(long, value_name = "E")]
    at: f64,
    /// An intensity measure: pga, pgv, pgd, arias, cav, pgv-d575 (PGV
    /// D5-75^(1/4)), sa:T, avgsa:T1,T2,.. (geometric mean, periods in s),
    /// avgsa:rocking (0.15 to 1.0 times 2 pi/p) or column:NAME (of
    /// --attributes or the index, proportional to the acceleration); may be
    /// repeated [default: pga, pgv, pgd, arias, cav, pgv-d575, sa at 0.5, 1,
    /// 2, 3 and 4 s, and avgsa:rocking]. Ratios are to the first one.
    #[arg(long, value_name = "MEASURE")]
    im: Vec<M>,
    #[command(flatten)]
    ground: GroundArgs,
    /// Capacity of a record with several crossings.
    #[arg(
        long,
        value_parser = names::crossing(),
        default_value_t = InversionRule::Median
    )]
    point: InversionRule,
    /// Column of the magnitude.
    #[arg(long, value_name = "COLUMN")]
    magnitude: Option<String>,
    /// Column of the distance; its logarithm is used.
    #[arg(long, value_name = "COLUMN")]
    distance: Option<String>,
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Serialize)]
struct RankSummary {
    edp: f64,
    point: String,
    /// Files set aside of the suite.
    set_aside: SetAside,
    #[serde(flatten)]
    ranking: Ranking,
}

/// Runs `rocking rank`.
///
/// # Errors
/// [`Failure`] for files that are refused, or capacities that make no fit.
pub fn run_rank(args: &RankCommand) -> Result<(), Failure> {
    let measures = match args.im.as_slice() {
        [] => M::usual(),
        some => some.to_vec(),
    };
    let mut inputs = args.ground.inputs();
    inputs.push(args.ida.clone());
    let mut outputs = Outputs::of(inputs);
    let plot = args.plot.open(&mut outputs)?;
    let (table, curves) = input::ida(&args.ida, Intensity::Pga)?;
    let p_rad_s = table.setting.p_rad_s;
    let own = measures.iter().map(|measure| measure.of_block(p_rad_s));
    let measures: Vec<M> = own.collect();
    let clusters = curves.clusters.clone();
    let capacities = intervals(&curves.into_curves(), args.at, args.point)?;
    let draws = args.bootstrap.draws();
    let (ranking, set_aside) = args.threads.run(|| {
        let ground = args.ground.ground(&table, &measures)?;
        let candidates = ground.candidates(&measures)?;
        let covariates = args.covariates(&ground)?;
        let ranking =
            rank(&capacities, &candidates, &covariates, &clusters, draws)?;
        Ok::<_, Failure>((ranking, ground.set_aside))
    })??;
    if let Some(out) = plot {
        out.write(ranking_svg(&ranking, &measures, args.at))?;
    }
    let (edp, point) = (args.at, args.point.to_string());
    let found = RankSummary { edp, point, set_aside, ranking };
    let beta = |one: &&MeasureRank| one.dispersion.estimate.value();
    let all = found.ranking.measures.iter();
    let best = all.min_by(|a, b| beta(a).total_cmp(&beta(b)));
    let sentence = best.map_or(String::new(), |best| {
        let beta = number(beta(&best), None);
        format!("{} has the smallest dispersion, {beta}.", best.im)
    });
    args.json.show_beside(&outputs, &[&sentence], &found)
}

impl RankCommand {
    /// The columns of the slopes.
    fn covariates(
        &self,
        ground: &SuiteMeasures,
    ) -> Result<Vec<Covariate>, Failure> {
        let magnitude = self
            .magnitude
            .iter()
            .map(|column| Ok(Covariate::magnitude(ground.column(column)?)));
        let distance = self
            .distance
            .iter()
            .map(|column| Ok(Covariate::ln_distance(ground.column(column)?)));
        magnitude.chain(distance).collect()
    }
}
