//! Coverage of the study's intervals on simulated suites with a known truth.
//!
//! A suite resembles a recorded one: 86 records of 22 earthquakes, or 44 of
//! 16. The normal score of record r in block b at level l is the sum of a part
//! that its earthquake shares, with [`SHARED`] of the variance, and a part of
//! the record. Each part is correlated by [`BLOCKS_ALIKE`] between two blocks,
//! and by [`LEVELS_ALIKE`] from level to level of a block.

use anyhow::Result;
use libm::{exp, log, sqrt};
use rocking_common::findings::LEVEL;
use rocking_statistics::acceptance::distances;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::boxplot::median_interval;
use rocking_statistics::lilliefors::LillieforsTable;
use rocking_statistics::resampling::{RecordRanks, Resampling};
use rocking_statistics::streams::{Stream, Streams, standard_normal};
use rocking_statistics::{
    Clusters, ExtendedSample, Interval, Proportion, Range, normal,
};
use serde::Deserialize;

use super::truths::{SuiteShape, percentiles, share, trials};
use crate::methods::method::{Context, Reply, WrongModel};

/// Replicates of an interval: they give a standard error to 5 %.
const REPLICATES: usize = 200;

/// Share of the variance that the records of an earthquake share.
const SHARED: f64 = 0.2;

/// Correlation from level to level, and between blocks.
const LEVELS_ALIKE: f64 = 0.97;
const BLOCKS_ALIKE: f64 = 0.9;

/// Blocks and levels of a suite.
const BLOCKS: usize = 4;
const LEVELS: usize = 13;

/// Step between the cells over which a distance is averaged.
const APART: usize = 6;

/// Spread of a paired ratio.
const SPREAD: f64 = 0.15;

/// Survivors among few records.
const SURVIVORS: usize = 12;

/// Probability of a counted event.
const PROBABILITY: f64 = 0.3;

/// The quantity of an interval.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum IntervalMeasure {
    /// Median of paired ratios in one cell.
    Median,
    /// Share of the cells whose median is within 5 %.
    CellShare,
    /// Median of few survivors, by order statistics.
    FewSurvivors,
    /// Probability of an event over records.
    Count,
    /// Mean distance from a lognormal over levels and blocks.
    Distance,
}

/// Share of the simulated suites whose interval covers the truth.
pub fn coverage(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        measure: IntervalMeasure,
        /// The recorded suite that the simulated ones are like.
        like: SuiteShape,
        trials: u64,
        /// Expected share.
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
    let held: Vec<bool> = match measure {
        IntervalMeasure::Distance => {
            let found = self::trials(trials, |trial| suites.distance(trial))?;
            // The truth is the mean over the simulated suites.
            let sum = found.iter().fold(0.0, |sum, (x, _)| sum + x);
            let truth = sum / found.len() as f64;
            found.into_iter().map(|(_, ends)| hold(ends, truth)).collect()
        }
        measure => self::trials(trials, |trial| suites.holds(trial, measure))?,
    };
    answer.put("rate", [share(&held)], [nominal]);
    Ok(())
}

fn hold(interval: Option<Interval>, truth: f64) -> bool {
    interval.is_some_and(|interval| interval.holds(truth))
}

/// Paired ratios with this median, from normal scores.
fn ratios(median: f64, scores: &[f64]) -> RecordRanks {
    let values = scores.iter().map(|z| median * exp(SPREAD * z));
    RecordRanks::new(&values.collect::<Vec<f64>>())
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
    /// Clusters of dependent records.
    clusters: Clusters,
    /// Units of resampling.
    drawn: Clusters,
    wrong: Option<WrongModel>,
}

impl Trials {
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

    fn bootstrap(&self, trial: u64) -> Bootstrap {
        let name = format!("coverage/{trial}");
        Bootstrap::of_clusters(&name, 0, &self.drawn, REPLICATES)
    }

    /// The interval of a statistic from its values over replicates.
    fn interval(
        &self,
        point: f64,
        values: &[f64],
        (how, range): (Resampling, Range),
    ) -> Option<Interval> {
        use WrongModel::{Percentiles, TiedReplicates};
        if matches!(self.wrong, Some(Percentiles | TiedReplicates)) {
            return percentiles(values, LEVEL);
        }
        let found = self.drawn.estimate(point, values, how, range, LEVEL);
        found.and_then(|found| found.estimate.interval())
    }

    /// The interval of a function of multiplicities by a bootstrap.
    fn by_bootstrap(
        &self,
        trial: u64,
        range: Range,
        of: impl Fn(&[u32]) -> f64,
    ) -> Option<Interval> {
        let point = of(&vec![1; self.clusters.records()]);
        let draws = self.bootstrap(trial);
        let replicates = 0..REPLICATES as u64;
        let value = |index| of(&draws.multiplicities(index));
        let values: Vec<f64> = replicates.map(value).collect();
        self.interval(point, &values, (Resampling::Bootstrap, range))
    }

    fn holds(&self, trial: u64, measure: IntervalMeasure) -> Result<bool> {
        let scores = self.scores(trial);
        Ok(match measure {
            IntervalMeasure::CellShare => self.share(trial, &scores),
            IntervalMeasure::FewSurvivors => {
                // Some of each large earthquake.
                let step = scores[0].len() / SURVIVORS;
                let values = scores[0].iter().step_by(step).take(SURVIVORS);
                let values: Vec<f64> = values.copied().collect();
                let sample = ExtendedSample::try_new(&values)?;
                let narrow = self.wrong == Some(WrongModel::OtherInterval);
                let level = if narrow { 0.75 } else { LEVEL };
                let found = median_interval(&sample, level);
                hold(found.map(|found| found.interval), 0.0)
            }
            IntervalMeasure::Count => {
                let limit = normal::quantile(PROBABILITY);
                let held = scores[0].iter().map(|z| *z < limit);
                let held: Vec<bool> = held.collect();
                let found = Proportion::of_clusters(&held, &self.drawn);
                let ends = found.and_then(|count| count.interval(LEVEL));
                hold(ends.ok(), PROBABILITY)
            }
            _ => {
                let cell = ratios(1.0, &scores[0]);
                let of = |counts: &[u32]| cell.median(counts);
                hold(self.by_bootstrap(trial, Range::NotNegative, of), 1.0)
            }
        })
    }

    /// True if the interval of the share of cells within 5 % covers it.
    fn share(&self, trial: u64, scores: &[Vec<f64>]) -> bool {
        let count = scores.len();
        // True medians from a normal law, nine of ten cells within 5 %.
        let truth = |k: usize| {
            // Neighbours are not of one size.
            let place = (k * 17) % count;
            let p = (place as f64 + 0.5) / count as f64;
            exp(0.03 * normal::quantile(p))
        };
        let within = |x: &f64| (0.95..=1.05).contains(x);
        let share = |medians: &[f64]| {
            let inside = medians.iter().filter(|x| within(x));
            inside.count() as f64 / count as f64
        };
        let truths: Vec<f64> = (0..count).map(truth).collect();
        let cells = truths.iter().zip(scores);
        let cells: Vec<RecordRanks> =
            cells.map(|(truth, cell)| ratios(*truth, cell)).collect();
        let of = |counts: &[u32]| {
            let medians = cells.iter().map(|cell| cell.median(counts));
            share(&medians.collect::<Vec<f64>>())
        };
        hold(self.by_bootstrap(trial, Range::Share, of), share(&truths))
    }

    /// The distance from a lognormal of capacities that are lognormal above
    /// 1 and tested as they are, beyond what a lognormal has; and its
    /// interval by the subsets without two earthquakes.
    fn distance(&self, trial: u64) -> Result<(f64, Option<Interval>)> {
        let table = LillieforsTable::embedded();
        let scores = self.scores(trial).into_iter().step_by(APART);
        let of = |cell: Vec<f64>| {
            cell.into_iter().map(|z| log(1.0 + exp(z))).collect()
        };
        let logs: Vec<Vec<f64>> = scores.map(of).collect();
        let of = |places: &[usize]| -> Result<f64> {
            let drawn =
                |level: &Vec<f64>| places.iter().map(|r| level[*r]).collect();
            let drawn: Vec<Vec<f64>> = logs.iter().map(drawn).collect();
            let d = distances(&drawn);
            let mean = d.iter().fold(0.0, |sum, d| sum + d) / d.len() as f64;
            Ok(mean - table.mean(places.len())?)
        };
        let n = self.clusters.records();
        let point = of(&(0..n).collect::<Vec<usize>>())?;
        let places: Vec<Vec<usize>> =
            if self.wrong == Some(WrongModel::TiedReplicates) {
                let draws = self.bootstrap(trial);
                (0..REPLICATES as u64).map(|k| draws.draw(k)).collect()
            } else {
                let held = |counts: &Vec<u32>| {
                    (0..n).filter(|r| counts[*r] > 0).collect()
                };
                self.drawn.without_two().iter().map(held).collect()
            };
        let values = places.iter().map(|places| of(places));
        let values = values.collect::<Result<Vec<f64>>>()?;
        let how = (Resampling::Without(2), Range::Real);
        Ok((point, self.interval(point, &values, how)))
    }
}
