//! Coverage of the study's inference on simulated suites whose truth is
//! known.
//!
//! A suite is like a recorded one: 86 records of 22 earthquakes, or 44 of 16.
//! The normal score of record r in block b at level l is the sum of a part
//! that its earthquake shares, with [`SHARED`] of the variance, and one of
//! its own. Each part is correlated by [`BLOCKS_ALIKE`] between two blocks,
//! and by [`LEVELS_ALIKE`] from level to level of a block.

use anyhow::Result;
use libm::{exp, log, sqrt};
use rayon::prelude::*;
use rocking_common::findings::{ERROR, LEVEL};
use rocking_statistics::acceptance::{AcceptedShare, distances};
use rocking_statistics::bootstrap::{Bootstrap, estimate};
use rocking_statistics::boxplot::median_interval;
use rocking_statistics::confidence::Confidence;
use rocking_statistics::lilliefors::LillieforsTable;
use rocking_statistics::resampling::{RecordRanks, Subsampling};
use rocking_statistics::step_down::StepDown;
use rocking_statistics::streams::{Stream, Streams, standard_normal};
use rocking_statistics::{
    Clusters, ExtendedSample, Interval, Proportion, Sample, normal,
};
use serde::Deserialize;

use super::truths::{SuiteShape, share};
use crate::methods::method::{Context, Reply, WrongModel};

/// Replicates of an interval; the study has 2000. With 400 the level of an
/// interval is uncertain by 0.01, which the bounds leave room for.
const REPLICATES: usize = 400;

/// Subsamples of an accepted share, and of a distance.
const SUBSAMPLES: u64 = 100;

/// Share of the variance that the records of an earthquake share.
pub(super) const SHARED: f64 = 0.2;

/// Correlation from level to level, and between blocks.
const LEVELS_ALIKE: f64 = 0.97;
const BLOCKS_ALIKE: f64 = 0.9;

/// Blocks and levels of a suite.
const BLOCKS: usize = 4;
const LEVELS: usize = 13;

/// Spread of a paired ratio.
const SPREAD: f64 = 0.15;

/// Survivors among few records.
const SURVIVORS: usize = 12;

/// Probability of a counted event.
const PROBABILITY: f64 = 0.05;

/// What an interval is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum IntervalMeasure {
    /// Median of paired ratios in one cell, BCa.
    Median,
    /// The same by percentiles.
    MedianByPercentiles,
    /// Share of the cells whose median is within 5 %.
    CellShare,
    /// How often a cell that lies on the end of its region is shown inside.
    CellOnTheEdge,
    /// How often it is shown outside.
    CellRefuted,
    /// How often any of many cells on the end, which share nothing but their
    /// earthquakes, is shown outside.
    FamilyRefuted,
    /// How often a share of cells on its limit of 90 % is shown below it.
    ShareRefuted,
    /// Share of the cells whose median is within 5 %, three of four cells of
    /// few survivors, which do not count.
    ShareBesideSurvivors,
    /// Median of few survivors, by order statistics.
    FewSurvivors,
    /// Probability of an event that records have or not.
    Count,
    /// Mean distance from a lognormal over levels and blocks.
    Distance,
    /// Share of levels at which a lognormal is accepted.
    AcceptedShare,
}

/// Share of the simulated suites whose interval holds the truth; of what lies
/// on a limit, share of those in which it is decided.
pub fn coverage(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        measure: IntervalMeasure,
        /// The recorded suite that the simulated ones are like.
        like: SuiteShape,
        trials: u64,
        /// Share of the suites in which the interval is to hold the truth, or
        /// what lies on the limit may be decided.
        nominal: f64,
    }
    let clusters = like.clusters();
    let drawn = context.drawn(&clusters);
    let suites = Trials {
        streams: Streams::new(&context.case.id, 0),
        clusters,
        drawn,
        wrong: context.wrong,
    };
    let all = (0..trials).into_par_iter();
    let held: Vec<bool> = match measure {
        IntervalMeasure::Distance | IntervalMeasure::AcceptedShare => {
            let found = all
                .map(|trial| suites.lognormal(trial, measure))
                .collect::<Result<Vec<_>, _>>()?;
            // The truth is the mean over the simulated suites.
            let sum = found.iter().fold(0.0, |sum, (x, _)| sum + x);
            let truth = sum / found.len() as f64;
            found.into_iter().map(|(_, ends)| hold(ends, truth)).collect()
        }
        measure => all.map(|trial| suites.holds(trial, measure)).collect(),
    };
    answer.put("rate", [share(&held)], [nominal]);
    Ok(())
}

fn hold(interval: Option<Interval>, truth: f64) -> bool {
    interval.is_some_and(|interval| interval.holds(truth))
}

/// The interval of a measure whose replicates give one.
fn interval(known: Option<Confidence>, half_width: f64) -> Option<Interval> {
    Some(known?.interval(half_width)?.interval)
}

/// A field over blocks and levels, added to `scores` with a weight.
fn add_field(stream: &mut Stream, weight: f64, scores: &mut [f64]) {
    let walk = |stream: &mut Stream| -> [f64; LEVELS] {
        let step = sqrt(1.0 - LEVELS_ALIKE * LEVELS_ALIKE);
        let mut z = standard_normal(stream);
        std::array::from_fn(|level| {
            if level > 0 {
                let e = standard_normal(stream);
                z = f64::mul_add(LEVELS_ALIKE, z, step * e);
            }
            z
        })
    };
    let common = walk(stream);
    for block in scores.chunks_mut(LEVELS) {
        let own = walk(stream);
        for ((score, a), b) in block.iter_mut().zip(common).zip(own) {
            *score += weight
                * (sqrt(BLOCKS_ALIKE) * a + sqrt(1.0 - BLOCKS_ALIKE) * b);
        }
    }
}

/// Simulated suites of one case.
struct Trials {
    streams: Streams,
    /// Whose records are dependent.
    clusters: Clusters,
    /// What is resampled.
    drawn: Clusters,
    wrong: Option<WrongModel>,
}

impl Trials {
    /// `mistaken` where this is the mistake that is made, else `right`.
    fn or<T>(&self, wrong: WrongModel, mistaken: T, right: T) -> T {
        if self.wrong == Some(wrong) { mistaken } else { right }
    }

    /// Normal scores by cell, then by record.
    fn scores(&self, trial: u64) -> Vec<Vec<f64>> {
        let mut stream = self.streams.stream(trial);
        let n = self.clusters.records();
        let mut cells = vec![vec![0.0; n]; BLOCKS * LEVELS];
        for event in 0..self.clusters.count() {
            let mut shared = [0.0; BLOCKS * LEVELS];
            add_field(&mut stream, sqrt(SHARED), &mut shared);
            for record in self.clusters.members(event) {
                let mut own = shared;
                add_field(&mut stream, sqrt(1.0 - SHARED), &mut own);
                for (cell, score) in cells.iter_mut().zip(own) {
                    cell[*record] = score;
                }
            }
        }
        cells
    }

    /// Replicates of some medians, and the medians without each cluster.
    fn medians(
        &self,
        trial: u64,
        cells: &[RecordRanks],
    ) -> (Vec<Vec<f64>>, Vec<Vec<f64>>) {
        let of = |counts: &[u32]| -> Vec<f64> {
            cells.iter().map(|r| r.median(counts)).collect()
        };
        let name = format!("coverage/{trial}");
        let draws = Bootstrap::of_clusters(&name, 0, &self.drawn, REPLICATES);
        let replicates = (0..REPLICATES as u64)
            .map(|index| of(&draws.multiplicities(index)))
            .collect();
        let without = (0..self.drawn.count())
            .map(|cluster| of(&self.drawn.without(cluster)))
            .collect();
        (replicates, without)
    }

    fn holds(&self, trial: u64, measure: IntervalMeasure) -> bool {
        let scores = self.scores(trial);
        let every = vec![1; self.clusters.records()];
        let ratio = |shift: f64| move |z: f64| exp(SPREAD * z + shift);
        match measure {
            IntervalMeasure::CellShare
            | IntervalMeasure::ShareRefuted
            | IntervalMeasure::ShareBesideSurvivors => {
                self.share(trial, &scores, measure)
            }
            IntervalMeasure::FamilyRefuted => self.refuted(trial),
            IntervalMeasure::FewSurvivors => {
                // Some of each large earthquake.
                let step = scores[0].len() / SURVIVORS;
                let values: Vec<f64> =
                    scores[0].iter().copied().step_by(step).collect();
                let values = &values[..SURVIVORS];
                let Ok(sample) = ExtendedSample::try_new(values) else {
                    return false;
                };
                let level = self.or(WrongModel::OtherInterval, 0.75, LEVEL);
                let found = median_interval(&sample, level);
                hold(found.map(|found| found.interval), 0.0)
            }
            IntervalMeasure::Count => {
                let limit = normal::quantile(PROBABILITY);
                let count = scores[0].iter().filter(|z| **z < limit).count();
                let n = self.clusters.records();
                let found = Proportion::try_new(count, n);
                let exact = found.and_then(|p| p.interval(LEVEL));
                let share = count as f64 / n as f64;
                let error = sqrt(share * (1.0 - share) / n as f64);
                let wide = normal::quantile(1.0 - ERROR) * error;
                let normal = Interval::try_new(share - wide, share + wide);
                let wrong = WrongModel::OtherInterval;
                let ends = self.or(wrong, normal.ok(), exact.ok());
                hold(ends, PROBABILITY)
            }
            _ => {
                let edge = match measure {
                    IntervalMeasure::CellOnTheEdge
                    | IntervalMeasure::CellRefuted => log(1.05),
                    _ => 0.0,
                };
                let values: Vec<f64> =
                    scores[0].iter().copied().map(ratio(edge)).collect();
                let cells = [RecordRanks::new(&values)];
                let point = cells[0].median(&every);
                let (replicates, without) = self.medians(trial, &cells);
                let column = |rows: &[Vec<f64>]| -> Vec<f64> {
                    rows.iter().map(|row| row[0]).collect()
                };
                let others = match measure {
                    IntervalMeasure::MedianByPercentiles => Vec::new(),
                    _ => column(&without),
                };
                let known =
                    Confidence::new(point, &column(&replicates), &others);
                // Three times the tail's probability.
                let (wrong, more) = (WrongModel::OtherInterval, 3.0 * LEVEL);
                let level = self.or(wrong, more - 2.0, LEVEL);
                let half_width = self.drawn.half_width(level);
                let Some(ends) = interval(known, half_width) else {
                    return false;
                };
                match measure {
                    IntervalMeasure::CellOnTheEdge => {
                        ends.low() >= 0.95 && ends.high() <= 1.05
                    }
                    IntervalMeasure::CellRefuted => ends.low() > 1.05,
                    _ => ends.holds(1.0),
                }
            }
        }
    }

    /// Whether any of [`BLOCKS`] times [`LEVELS`] cells on the end of their
    /// region is shown outside.
    fn refuted(&self, trial: u64) -> bool {
        let mut stream = self.streams.stream(trial);
        let n = self.clusters.records();
        let cell = |stream: &mut Stream| -> RecordRanks {
            let mut values = vec![0.0; n];
            for event in 0..self.clusters.count() {
                let shared = sqrt(SHARED) * standard_normal(stream);
                for record in self.clusters.members(event) {
                    let own = standard_normal(stream);
                    values[*record] =
                        SPREAD * f64::mul_add(sqrt(1.0 - SHARED), own, shared);
                }
            }
            RecordRanks::new(&values)
        };
        let cells: Vec<RecordRanks> =
            (0..BLOCKS * LEVELS).map(|_| cell(&mut stream)).collect();
        let every = vec![1; n];
        let points: Vec<f64> =
            cells.iter().map(|r| r.median(&every)).collect();
        let (rows, without) = self.medians(trial, &cells);
        let column = |rows: &[Vec<f64>], k: usize| -> Vec<f64> {
            rows.iter().map(|row| row[k]).collect()
        };
        if self.wrong == Some(WrongModel::HolmByPercentiles) {
            let level = 1.0 - 2.0 * ERROR / points.len() as f64;
            let half_width = self.drawn.half_width(level);
            return (0..points.len()).any(|k| {
                let (own, others) = (column(&rows, k), column(&without, k));
                let known = Confidence::new(points[k], &own, &others);
                interval(known, half_width).is_some_and(|i| i.low() > 0.0)
            });
        }
        let spread = |k: usize| {
            let own = Sample::try_new(&column(&rows, k));
            own.map_or(f64::NAN, |own| {
                sqrt(own.sum_of_squares() / (rows.len() as f64 - 1.0))
            })
        };
        let spreads: Vec<f64> = (0..points.len()).map(spread).collect();
        let found: Vec<f64> =
            points.iter().zip(&spreads).map(|(x, s)| x / s).collect();
        let wider = self.drawn.half_width(1.0 - ERROR)
            / normal::quantile(1.0 - 0.5 * ERROR);
        let deviation = |row: usize, k: usize| {
            wider * (rows[row][k] - points[k]).abs() / spreads[k]
        };
        let steps = StepDown::new(&found, rows.len(), deviation, ERROR, 0.0);
        steps.rejected.contains(&true)
    }

    /// Whether the interval of the share of cells within 5 % holds it, or
    /// lies below the limit that the share lies on.
    fn share(
        &self,
        trial: u64,
        scores: &[Vec<f64>],
        measure: IntervalMeasure,
    ) -> bool {
        let count = scores.len();
        let few = |k: usize| {
            measure == IntervalMeasure::ShareBesideSurvivors
                && !k.is_multiple_of(4)
        };
        let enters = |k: &usize| {
            self.wrong == Some(WrongModel::SurvivorsEnter) || !few(*k)
        };
        let entering: Vec<usize> = (0..count).filter(enters).collect();
        // True medians from a normal law, nine of ten cells within 5 %.
        let truth = |k: usize| {
            // Neighbours are not of one size.
            let place = (k * 17) % count;
            let p = (place as f64 + 0.5) / count as f64;
            exp(0.03 * normal::quantile(p))
        };
        let within = |x: f64| (0.95..=1.05).contains(&x);
        let share = |row: &[f64]| {
            let inside = entering.iter().filter(|k| within(row[**k]));
            inside.count() as f64 / entering.len() as f64
        };
        let truths: Vec<f64> = (0..count).map(truth).collect();
        let cells: Vec<RecordRanks> = scores
            .iter()
            .enumerate()
            .map(|(k, cell)| {
                let step = if few(k) { cell.len() / SURVIVORS } else { 1 };
                let of = |(record, z): (usize, &f64)| match record % step {
                    0 => truths[k] * exp(SPREAD * z),
                    _ => f64::NAN,
                };
                let values = cell.iter().enumerate().map(of);
                RecordRanks::new(&values.collect::<Vec<f64>>())
            })
            .collect();
        let every = vec![1; self.clusters.records()];
        let points: Vec<f64> =
            cells.iter().map(|r| r.median(&every)).collect();
        let (replicates, _) = self.medians(trial, &cells);
        let values: Vec<f64> =
            replicates.iter().map(|row| share(row)).collect();
        let point = share(&points);
        let Some(known) = Confidence::new(point, &values, &[]) else {
            return false;
        };
        let of_points = known.interval(self.drawn.half_width(LEVEL));
        let own = known.interval_of_share(point, &self.drawn, LEVEL);
        let ends = self.or(WrongModel::ShareOfPoints, of_points, own);
        let ends = ends.map(|found| found.interval);
        match measure {
            IntervalMeasure::ShareRefuted => {
                ends.is_some_and(|i| i.high() < 0.9)
            }
            _ => hold(ends, share(&truths)),
        }
    }

    /// The distance, or accepted share, of capacities that are lognormal
    /// above 1 and tested as they are; and its interval.
    fn lognormal(
        &self,
        trial: u64,
        measure: IntervalMeasure,
    ) -> Result<(f64, Option<Interval>)> {
        let table = LillieforsTable::embedded();
        let logs: Vec<Vec<f64>> = self
            .scores(trial)
            .into_iter()
            .map(|cell| cell.into_iter().map(|z| log(1.0 + exp(z))).collect())
            .collect();
        let of = |places: &[usize]| -> Result<f64> {
            let drawn: Vec<Vec<f64>> = logs
                .iter()
                .map(|level| places.iter().map(|r| level[*r]).collect())
                .collect();
            if measure == IntervalMeasure::AcceptedShare {
                let critical = table.critical_value(places.len(), 0.05);
                let (critical, _) = critical?;
                let found = AcceptedShare::of_values(&drawn, critical);
                return Ok(found.share().unwrap_or(f64::NAN));
            }
            let d = distances(&drawn);
            let mean = d.iter().fold(0.0, |sum, d| sum + d) / d.len() as f64;
            Ok(mean - table.mean(places.len())?)
        };
        let held = |counts: &[u32]| -> Vec<usize> {
            (0..counts.len()).filter(|r| counts[*r] > 0).collect()
        };
        let n = self.clusters.records();
        let point = of(&(0..n).collect::<Vec<usize>>())?;
        let name = format!("coverage/{trial}");
        if self.wrong == Some(WrongModel::TiedReplicates) {
            let draws = Bootstrap::of_clusters(&name, 0, &self.drawn, 1);
            let values = (0..SUBSAMPLES)
                .map(|index| of(&draws.draw(index)))
                .collect::<Result<Vec<_>, _>>()?;
            let found = estimate(point, &values, LEVEL);
            return Ok((point, found.and_then(|e| e.estimate.interval())));
        }
        let size = n - n.div_ceil(10);
        let rule = Subsampling::of_clusters(&name, 0, &self.drawn, size);
        let values = (0..SUBSAMPLES)
            .map(|index| of(&held(&rule.multiplicities(index))))
            .collect::<Result<Vec<_>, _>>()?;
        let without = (0..self.drawn.count())
            .map(|cluster| of(&held(&self.drawn.without(cluster))))
            .collect::<Result<Vec<_>, _>>()?;
        let found = match self.wrong {
            // Neither as likely nor with the range of leaving one out.
            Some(WrongModel::OtherInterval) => {
                rule.interval(point, &values, &[], 5.0 * LEVEL - 4.0)
            }
            _ => rule.interval(point, &values, &without, LEVEL),
        };
        Ok((point, found.and_then(|e| e.estimate.interval())))
    }
}
