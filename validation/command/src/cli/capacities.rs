//! `rocking capacities`: IM given EDP from a response curve or an IDA file.

use std::path::{Path, PathBuf};

use clap::ArgGroup;
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking_exchange::ida::{Curves, IdaTable};
use rocking_exchange::sample::SampleFile;
use rocking_procedures::capacities::{
    LevelCapacities, LevelCrossings, crossings, levels,
};
use rocking_records::SetAside;
use rocking_records::intensity::IntensityMeasure;
use serde::Serialize;

use super::measure::GroundArgs;
use super::names;
use super::shared::{JsonArg, positive};
use crate::failure::{Failure, bail, ensure};
use crate::input;
use crate::threads::with_threads;
use rocking_common::files::Outputs;
use rocking_common::paper::Intensity;

/// Intensities at which EDP levels are reached, from one curve or from all
/// records of an IDA file.
///
/// A curve crosses a level where it passes from below the level to the level
/// or above, or back. Overturning crosses every level. A record that never
/// reaches a level is censored (inf). The number of crossings is odd.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking capacities --ida ida.csv --levels 0.3,0.5,1\n  \
    rocking capacities --ida ida.csv --im avgsa:rocking --suite SUITE\n  \
    rocking capacities --ida ida.csv --at 1 --out capacities.txt")]
#[command(group = ArgGroup::new("source").required(true)
    .args(["curve", "ida"]))]
pub struct CapacitiesCommand {
    /// Vertices IM:EDP of one curve, the first at EDP 0.
    #[arg(
        long,
        value_name = "IM:EDP,..",
        value_parser = vertices,
        allow_hyphen_values = true
    )]
    curve: Option<Vertices>,
    /// Intensity at which the curve first reaches overturning.
    #[arg(long, value_name = "IM", conflicts_with = "ida")]
    overturning: Option<f64>,
    /// Table of `rocking ida`; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    ida: Option<PathBuf>,
    /// Intensity measure, of --ida: pga, which is PGA/(g tan alpha), pgv,
    /// which is p PGV/(g tan alpha); and with --suite pgd, arias, cav,
    /// pgv-d575 (PGV D5-75^(1/4)), sa:T, avgsa:T1,T2,.. (geometric mean,
    /// periods in s, 5 % damping), avgsa:rocking (0.15 to 1.0 times 2 pi/p) or
    /// column:NAME (of --attributes or the index, proportional to the
    /// acceleration) [default: pga].
    #[arg(long, value_name = "MEASURE", conflicts_with = "curve")]
    im: Option<IntensityMeasure>,
    #[command(flatten)]
    ground: GroundArgs,
    /// EDP levels, FIRST:LAST:STEP or a list; inf: overturning.
    #[arg(
        long,
        value_name = "LEVELS",
        value_parser = edp_levels,
        default_value = "0.005:1:0.005",
        allow_hyphen_values = true
    )]
    levels: EdpLevels,
    /// Capacity of a record with several crossings, for the quantiles over the
    /// records of --ida [default: median].
    #[arg(long, value_parser = names::crossing(), conflicts_with = "curve")]
    point: Option<InversionRule>,
    /// EDP level of the sample written to --out.
    #[arg(long, value_name = "E", requires = "out", conflicts_with = "curve")]
    at: Option<f64>,
    /// Write the records' capacities at --at, one per line, `>3.2` if censored
    /// at 3.2, the last intensity run; `-` is standard output, and then
    /// nothing else is printed.
    #[arg(
        long,
        value_name = "OUT.txt",
        requires = "at",
        conflicts_with = "curve"
    )]
    out: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArg,
}

/// Vertices of a curve given by hand.
type Vertices = Vec<(f64, f64)>;

fn vertices(text: &str) -> Result<Vertices, String> {
    let vertex = |pair: &str| {
        let (im, edp) = pair.split_once(':')?;
        Some((im.trim().parse().ok()?, edp.trim().parse().ok()?))
    };
    let vertices = text.split(',').map(|pair| {
        vertex(pair).ok_or_else(|| {
            format!("found `{pair}`: expected IM:EDP, such as 1.1:0.2")
        })
    });
    vertices.collect()
}

/// EDP levels, or intensities.
pub(super) type EdpLevels = Vec<f64>;

/// Intensities, FIRST:LAST:STEP or a list.
pub(super) fn intensities(text: &str) -> Result<EdpLevels, String> {
    let parts = text.split(',').map(range).collect::<Result<Vec<_>, _>>()?;
    Ok(parts.concat())
}

/// EDP levels; `inf` is overturning.
pub(super) fn edp_levels(text: &str) -> Result<EdpLevels, String> {
    let part = |field: &str| match field.trim() {
        "inf" => Ok(vec![f64::INFINITY]),
        own => range(own),
    };
    let parts = text.split(',').map(part).collect::<Result<Vec<_>, _>>()?;
    Ok(parts.concat())
}

/// The numbers FIRST:LAST:STEP, or one number.
fn range(text: &str) -> Result<Vec<f64>, String> {
    let number = |field: &str| {
        let place = |expected| format!("found `{field}`: {expected}");
        positive(field).map_err(place)
    };
    let parts: Vec<&str> = text.split(':').collect();
    let [first, last, step] = parts.as_slice() else {
        return Ok(vec![number(text)?]);
    };
    let (first, last, step) = (number(first)?, number(last)?, number(step)?);
    let count = ((last - first) / step + 1e-9).floor();
    if !(last >= first && count < 1e6) {
        return Err(format!(
            "found `{text}`: expected FIRST:LAST:STEP with LAST >= FIRST"
        ));
    }
    // A step of 1/d gives levels rounded once: 200 steps of 0.005 are 1.
    let parts_of_one = (1.0 / step).round();
    let exact = (parts_of_one * step - 1.0).abs() < 1e-12;
    let offset = (first * parts_of_one).round();
    let exact = exact && (offset / parts_of_one - first).abs() < 1e-12;
    let level = |k: u32| match exact {
        true => (offset + f64::from(k)) / parts_of_one,
        false => f64::mul_add(f64::from(k), step, first),
    };
    Ok((0..=count as u32).map(level).collect())
}

/// Runs `rocking capacities`.
///
/// # Errors
/// [`Failure`] for a curve, a file or a level that is refused.
pub fn run_capacities(args: &CapacitiesCommand) -> Result<(), Failure> {
    let Some(vertices) = &args.curve else { return by_file(args) };
    let curve = ResponseCurve::try_new(vertices, args.overturning)?;
    let levels = crossings(&curve, &args.levels, |im| im)?;
    let im_r = curve.onset_im();
    let sentence = "The block begins to rock at an intensity of {im_r}.";
    args.json.show(&[sentence], &CurveCrossings { im_r, levels })
}

/// Crossings of one curve.
#[derive(Serialize)]
struct CurveCrossings {
    im_r: f64,
    levels: Vec<LevelCrossings>,
}

/// Capacities of a suite.
#[derive(Serialize)]
struct CapacitiesSummary {
    im: String,
    im_r: f64,
    n: usize,
    point: String,
    quantile_type: u8,
    rows_after_overturning: usize,
    /// Files set aside of the suite; `None` if none was read.
    set_aside: Option<SetAside>,
    levels: Vec<LevelCapacities>,
    /// Each record by itself; only in JSON, since the crossings are many.
    #[serde(skip_serializing_if = "Option::is_none")]
    records: Option<Vec<RecordCrossings>>,
}

/// Crossings of one record.
#[derive(Serialize)]
struct RecordCrossings {
    record: String,
    onset_im: f64,
    overturning_im: Option<f64>,
    levels: Vec<LevelCrossings>,
}

fn by_file(args: &CapacitiesCommand) -> Result<(), Failure> {
    let Some(path) = &args.ida else { bail!("--curve or --ida is needed") };
    let measure = args.im.as_ref().unwrap_or(&IntensityMeasure::PGA);
    let rule = args.point.unwrap_or(InversionRule::Median);
    let inputs = [vec![path.clone()], args.ground.inputs()].concat();
    let mut outputs = Outputs::of(inputs);
    let out = outputs.open_some(args.out.as_ref())?;
    let (table, suite, set_aside) = suite(args, path, measure)?;
    let measure = &measure.of_block(table.setting.p_rad_s);
    if let (Some(level), Some(out)) = (args.at, out) {
        out.write(SampleFile::text(&table, &suite, measure, level, rule)?)?;
    }
    let measured = |im: f64| suite.measured(im);
    let record = |(record, curve): &(String, ResponseCurve)| {
        Ok::<_, Failure>(RecordCrossings {
            record: record.clone(),
            onset_im: measured(curve.onset_im()),
            overturning_im: curve.overturning_im().map(measured),
            levels: crossings(curve, &args.levels, measured)?,
        })
    };
    let records = args.json.json.then(|| suite.curves.iter().map(record));
    let records = records.map(Iterator::collect::<Result<_, _>>);
    let records = records.transpose()?;
    let curves = suite.clone().into_curves();
    let levels = levels(&curves, &args.levels, rule, measured)?;
    let found = CapacitiesSummary {
        im: measure.words(),
        im_r: measured(suite.im_r),
        n: curves.len(),
        point: rule.to_string(),
        quantile_type: 5,
        rows_after_overturning: suite.after_overturning,
        set_aside,
        levels,
        records,
    };
    let sentences = [
        "At |theta|/alpha = {levels.last.edp} the median of {im} is \
         {levels.last.im50}, over {n} records.",
        "At overturning the median of {im} is {levels.last.im50}, over {n} \
         records.",
        "The median of {im} is not reached at the last level.",
    ];
    args.json.show_beside(&outputs, &sentences, &found)
}

/// The curves of a table against a measure.
fn suite(
    args: &CapacitiesCommand,
    path: &Path,
    measure: &IntensityMeasure,
) -> Result<(IdaTable, Curves, Option<SetAside>), Failure> {
    if let Some(intensity) = measure.dimensionless() {
        ensure!(
            args.ground.suite.is_none(),
            "--suite is not used for {}, which the table contains",
            intensity.row().words
        );
        let (table, curves) = input::ida(path, intensity)?;
        return Ok((table, curves, None));
    }
    let (table, curves) = input::ida(path, Intensity::Pga)?;
    let measure = &measure.of_block(table.setting.p_rad_s);
    let measures = std::slice::from_ref(measure);
    let ground = with_threads(None, || args.ground.ground(&table, measures))??;
    let factors = ground.at_uplift(measure)?;
    let curves = curves.against(&factors, measure.is_squared())?;
    Ok((table, curves, Some(ground.set_aside)))
}
