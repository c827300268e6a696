//! Coverage of the study's inference on simulated suites whose truth is
//! known.
//!
//! A suite has records that share everything: cell k of record r is
//! exp(s (c z_r + sqrt(1 - c^2) e_rk)), with standard normal z and e.

use libm::{exp, log};
use rayon::prelude::*;
use rocking::statistics::acceptance::AcceptedShare;
use rocking::statistics::bootstrap::{Bootstrap, accelerated, estimate};
use rocking::statistics::lilliefors::Table;
use rocking::statistics::resampling::{
    Ranked, Subsampling, multiplicities, share_inside, simultaneous,
};
use rocking::streams::{Streams, standard_normal};
use serde::Deserialize;

use super::cells::refused;
use crate::methods::method::{Answer, Context, MethodError, WrongModel};

/// Level of the intervals.
const LEVEL: f64 = 0.95;

/// Replicates of an interval; the study has 2000. With 400 the level of an
/// interval is uncertain by 0.01, which the bounds leave room for.
const REPLICATES: usize = 400;

/// Subsamples of an accepted share.
const SUBSAMPLES: u64 = 200;

/// Correlation of two cells of one record, and spread of a cell.
const CORRELATION: f64 = 0.5;
const SPREAD: f64 = 0.15;

/// What an interval is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Measure {
    /// Median of paired ratios in one cell: a bootstrap of records.
    Median,
    /// Medians of 52 cells at once, the largest among them.
    Maximum,
    /// Share of 52 cells within 5 %, of which every second one is.
    CellShare,
    /// Accepted share of 25 levels of one block.
    AcceptedShare,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    measure: Measure,
    n: usize,
    trials: u64,
}

/// Share of the simulated suites whose interval holds the truth.
pub(crate) fn coverage(context: &Context) -> Result<Answer, MethodError> {
    let input: Input = context.input()?;
    let wrong = context.wrong;
    let streams = Streams::new(&context.case.id, 0);
    let held: Vec<bool> = match input.measure {
        Measure::AcceptedShare => shares(&input, &streams, wrong)?,
        _ => (0..input.trials)
            .into_par_iter()
            .map(|trial| {
                let cells = suite(&input, &streams, trial);
                holds(&input, &cells, trial, wrong)
            })
            .collect(),
    };
    let count = held.iter().filter(|held| **held).count();
    let rate = count as f64 / held.len() as f64;
    let mut answer = Answer::default();
    answer.put("rate", [rate], [LEVEL]);
    Ok(answer)
}

/// Cells of a measure, and the logarithm of each one's true median.
fn truths(measure: Measure) -> Vec<f64> {
    // Inside, but near the limit of 5 %.
    let apart = |k: usize| if k.is_multiple_of(2) { 0.035 } else { 0.3 };
    match measure {
        Measure::Median => vec![0.0],
        Measure::Maximum => vec![0.0; 52],
        Measure::CellShare => (0..52).map(apart).collect(),
        Measure::AcceptedShare => vec![0.0; 25],
    }
}

/// The cells of a simulated suite, each by record.
fn suite(input: &Input, streams: &Streams, trial: u64) -> Vec<Vec<f64>> {
    let truths = truths(input.measure);
    let mut stream = streams.stream(trial);
    let own = (1.0 - CORRELATION).sqrt();
    let mut cells = vec![Vec::with_capacity(input.n); truths.len()];
    for _ in 0..input.n {
        let common = CORRELATION.sqrt() * standard_normal(&mut stream);
        for (cell, truth) in cells.iter_mut().zip(&truths) {
            let e = own * standard_normal(&mut stream);
            cell.push(exp(f64::mul_add(SPREAD, common + e, *truth)));
        }
    }
    cells
}

fn holds(
    input: &Input,
    cells: &[Vec<f64>],
    trial: u64,
    wrong: Option<WrongModel>,
) -> bool {
    let ranked: Vec<Ranked> = cells.iter().map(|c| Ranked::new(c)).collect();
    let medians = |counts: &[u32]| -> Vec<f64> {
        ranked.iter().map(|r| r.median(counts)).collect()
    };
    let points = medians(&vec![1; input.n]);
    let name = format!("coverage/{trial}");
    let draws = Bootstrap::new(&name, 0, input.n, REPLICATES);
    let replicates: Vec<Vec<f64>> = (0..REPLICATES as u64)
        .map(|index| medians(&draws.multiplicities(index)))
        .collect();
    let truths: Vec<f64> =
        truths(input.measure).into_iter().map(exp).collect();
    let column = |k: usize| -> Vec<f64> {
        replicates.iter().map(|row| row[k]).collect()
    };
    let pointwise = |k: usize| {
        estimate(points[k], &column(k), LEVEL).map(|e| (e.low, e.high))
    };
    if input.measure == Measure::Median {
        let without: Vec<f64> = (0..input.n)
            .map(|left_out| {
                let places: Vec<usize> =
                    (0..input.n).filter(|r| *r != left_out).collect();
                medians(&multiplicities(&places, input.n))[0]
            })
            .collect();
        let level = match wrong {
            // Half of the tail's probability.
            Some(WrongModel::OtherInterval) => 1.0 - 3.0 * (1.0 - LEVEL),
            _ => LEVEL,
        };
        let found = accelerated(points[0], &column(0), &without, level)
            .or_else(|| estimate(points[0], &column(0), level));
        return found.is_some_and(|e| e.low <= 1.0 && 1.0 <= e.high);
    }
    let band = match wrong {
        Some(WrongModel::PointwiseIntervals) => {
            (0..points.len()).map(pointwise).collect()
        }
        _ => simultaneous(&points, &replicates, LEVEL),
    };
    match input.measure {
        Measure::CellShare => {
            let inside = |low, high| low >= 0.95 && high <= 1.05;
            let outside = |low, high| high < 0.95 || low > 1.05;
            let (low, high) = match wrong {
                Some(WrongModel::ShareOfPoints) => {
                    percentiles(&replicates, |x| inside(x, x))
                }
                _ => share_inside(&band, inside, outside),
            };
            low <= 0.5 && 0.5 <= high
        }
        _ => band.iter().zip(&truths).all(|(ends, truth)| {
            ends.is_some_and(|(low, high)| low <= *truth && *truth <= high)
        }),
    }
}

/// The percentile interval of the share of cells whose point is inside.
fn percentiles(
    replicates: &[Vec<f64>],
    inside: impl Fn(f64) -> bool,
) -> (f64, f64) {
    let share = |row: &Vec<f64>| {
        let count = row.iter().filter(|x| inside(**x)).count();
        count as f64 / row.len() as f64
    };
    let values: Vec<f64> = replicates.iter().map(share).collect();
    estimate(0.5, &values, LEVEL).map_or((0.0, 0.0), |e| (e.low, e.high))
}

/// Intervals of the accepted share of a lognormal above 1 that is tested as
/// it is; the truth is the mean share over the simulated suites.
fn shares(
    input: &Input,
    streams: &Streams,
    wrong: Option<WrongModel>,
) -> Result<Vec<bool>, MethodError> {
    let table = Table::embedded();
    let critical = |n: usize| table.critical_value(n, 0.05).map_err(refused);
    let rule_of = |trial: u64| {
        let name = format!("coverage/{trial}");
        let size = input.n - input.n.div_ceil(10);
        (Subsampling::new(&name, 0, input.n, size), size)
    };
    let (_, size) = rule_of(0);
    let (whole, part, less) =
        (critical(input.n)?.0, critical(size)?.0, critical(input.n - 1)?.0);
    let found: Vec<(f64, Option<(f64, f64)>)> = (0..input.trials)
        .into_par_iter()
        .map(|trial| {
            // x = 1 + exp(z), unshifted: not a lognormal.
            let logs: Vec<Vec<f64>> = suite(input, streams, trial)
                .into_iter()
                .map(|cell| {
                    let z = |x: f64| log(x) / SPREAD;
                    cell.into_iter().map(|x| log(1.0 + exp(z(x)))).collect()
                })
                .collect();
            let share = |places: &[usize], critical: f64| {
                let drawn: Vec<Vec<f64>> = logs
                    .iter()
                    .map(|level| places.iter().map(|r| level[*r]).collect())
                    .collect();
                let found = AcceptedShare::of_values(&drawn, critical);
                found.share().unwrap_or(f64::NAN)
            };
            let all: Vec<usize> = (0..input.n).collect();
            let point = share(&all, whole);
            let (rule, _) = rule_of(trial);
            let interval = if wrong == Some(WrongModel::TiedReplicates) {
                let draws = Bootstrap::new("coverage", trial, input.n, 1);
                let values: Vec<f64> = (0..SUBSAMPLES)
                    .map(|index| share(&draws.draw(index), whole))
                    .collect();
                estimate(point, &values, LEVEL)
            } else {
                let values: Vec<f64> = (0..SUBSAMPLES)
                    .map(|index| {
                        let counts = rule.multiplicities(index);
                        let drawn: Vec<usize> =
                            (0..input.n).filter(|r| counts[*r] > 0).collect();
                        share(&drawn, part)
                    })
                    .collect();
                let without: Vec<f64> = (0..input.n)
                    .map(|left_out| {
                        let others: Vec<usize> =
                            (0..input.n).filter(|r| *r != left_out).collect();
                        share(&others, less)
                    })
                    .collect();
                rule.interval(point, &values, &without, LEVEL)
            };
            (point, interval.map(|e| (e.low, e.high)))
        })
        .collect();
    let sum = found.iter().fold(0.0, |sum, (point, _)| sum + point);
    let truth = sum / found.len() as f64;
    let holds = |(_, ends): &(f64, Option<(f64, f64)>)| {
        ends.is_some_and(|(low, high)| low <= truth && truth <= high)
    };
    Ok(found.iter().map(holds).collect())
}
