//! Lilliefors' distance from a lognormal, and the share of demand levels at
//! which his test accepts one, over all subsets of the records.
//!
//! Levels of a block share records, and so do blocks. Both numbers are
//! therefore inferred from subsets without two earthquakes. A draw with
//! replacement would tie values, and ties break the test.

use libm::log;
use rocking_statistics::acceptance::distances;
use rocking_statistics::lilliefors::{LillieforsTable, LillieforsTest};

use crate::distributions::{average_factors, factors, least, scaled};
use crate::estimates::mean;
use crate::facts::Facts;
use crate::inference::{Replicates, Resample, Resamples};
use crate::normality::{BAND_STRIDE, LEVEL, accepted_share, along, every};
use crate::results::StudyResults;
use rocking_common::paper::{
    Arm, BLOCKS, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, SuiteKind,
    position,
};

/// Blocks of a suite.
const COUNT: usize = BLOCKS.len();

/// The block of Figure 13 that the paper calls badly performing: p = 3,
/// alpha = 0.05.
pub(crate) const SLENDER: (usize, usize) = (1, 0);

/// Number of the earliest overturnings that the paper blames in Figure 13.
const EARLIEST: usize = 3;

/// An intensity measure in which capacities are tested.
#[derive(Clone, Copy, Debug)]
pub(crate) enum TestedMeasure {
    Pga,
    Pgv,
    GeometricMean,
    AverageSa,
}

impl TestedMeasure {
    const ALL: [Self; 4] =
        [Self::Pga, Self::Pgv, Self::GeometricMean, Self::AverageSa];

    /// The tests of the original sample.
    pub(crate) const fn original(self) -> TestSeries {
        TestSeries(2 * self as usize)
    }

    /// The tests of the shifted sample.
    pub(crate) const fn shifted(self) -> TestSeries {
        TestSeries(2 * self as usize + 1)
    }

    /// Factors from PGA/(g tan alpha) to the measure, by record; `None` if a
    /// record lacks the measure.
    fn factors(self, records: &[Facts], frequency: usize) -> Option<Vec<f64>> {
        let p = FREQUENCIES_RAD_S[frequency];
        match self {
            Self::Pga => Some(factors(records, Intensity::Pga, p)),
            Self::Pgv => Some(factors(records, Intensity::Pgv, p)),
            Self::GeometricMean => {
                records.iter().map(|r| r.mean_over_study).collect()
            }
            Self::AverageSa => Some(average_factors(records, frequency)),
        }
    }
}

/// A series of tests along the demand for each block, by its number.
#[derive(Clone, Copy, Debug)]
pub(crate) struct TestSeries(usize);

impl TestSeries {
    /// Place of a block's excess in [`SuiteDistances::replicated`].
    pub(crate) fn place(self, (p, alpha): (usize, usize)) -> usize {
        self.0 * COUNT + position(p, alpha)
    }

    /// The excess of D by block.
    pub(crate) fn excesses(self, row: &[f64]) -> &[f64] {
        &row[self.0 * COUNT..][..COUNT]
    }

    /// The accepted share by block.
    pub(crate) fn accepted(self, row: &[f64]) -> &[f64] {
        self.excesses(&row[OF_EARLIEST + 1..])
    }
}

/// Place of the excess minus the excess without the earliest records, both
/// over the levels of a simulation.
pub(crate) const OF_EARLIEST: usize = 2 * TestedMeasure::ALL.len() * COUNT;

/// Results of Lilliefors' test for all blocks of a suite on a grid, over all
/// draws.
pub struct SuiteDistances {
    pub(crate) suite: SuiteKind,
    pub(crate) arm: Arm,
    /// The excess of D, `TestSeries` by block, then the part of the earliest
    /// records; then the accepted shares, `TestSeries` by block.
    pub(crate) replicated: Replicates,
    /// Number of levels at which every record is finite, by block.
    pub(crate) levels: Vec<usize>,
}

/// D over levels: the mean of D minus its mean for a lognormal of equal size,
/// and the share of the levels at which D is not critical. NaN without a level.
#[derive(Clone, Copy)]
struct OverLevels {
    excess: f64,
    accepted: f64,
}

impl OverLevels {
    /// Without any level.
    const NONE: Self = Self { excess: f64::NAN, accepted: f64::NAN };

    /// Summary of the distances of levels; NaN does not count.
    fn new(found: &[f64], (null, critical): (f64, f64)) -> Self {
        let usable = || found.iter().copied().filter(|d| !d.is_nan());
        let accepted = |d: f64| f64::from(u8::from(d <= critical));
        Self {
            excess: mean(usable()) - null,
            accepted: mean(usable().map(accepted)),
        }
    }
}

/// Mean of D for a lognormal of n records, and its critical value; NaN
/// outside the table.
fn null(n: usize) -> (f64, f64) {
    let table = LillieforsTable::embedded();
    let critical = table.critical_value(n, LEVEL).map_or(f64::NAN, |c| c.0);
    (table.mean(n).unwrap_or(f64::NAN), critical)
}

/// Capacities of one block in one measure.
struct BlockLevels {
    /// Capacities by level, then by record.
    levels: Vec<Vec<f64>>,
    /// Intensities at uplift by record: the least is the shift.
    factors: Vec<f64>,
    shifted: bool,
}

impl BlockLevels {
    fn shift(&self, factors: &[f64]) -> f64 {
        if self.shifted { least(factors) } else { 0.0 }
    }

    /// D of all levels and all records.
    fn whole(&self) -> OverLevels {
        let shift = self.shift(&self.factors);
        let tests = along(&self.levels, shift).unwrap_or_default();
        let d =
            |test: &LillieforsTest| test.statistic.map_or(f64::NAN, |s| s.d);
        let found: Vec<f64> = tests.iter().map(d).collect();
        let of = OverLevels::new(&found, null(self.factors.len()));
        OverLevels { accepted: accepted_share(&tests), ..of }
    }

    /// D of a draw over the levels of a simulation, without some records.
    fn over_levels(&self, drawn: &[usize], left_out: &[usize]) -> OverLevels {
        let is_held = |r: &usize| !left_out.contains(r);
        let held: Vec<usize> = drawn.iter().copied().filter(is_held).collect();
        let factors: Vec<f64> =
            held.iter().map(|r| self.factors[*r]).collect();
        let shift = self.shift(&factors);
        let logs = every(&self.levels, BAND_STRIDE).map(|level| {
            held.iter().map(|r| log(level[*r] - shift)).collect()
        });
        let found = distances(&logs.collect::<Vec<Vec<f64>>>());
        OverLevels::new(&found, null(held.len()))
    }

    /// Positions of the drawn records that overturn first.
    fn earliest(&self, drawn: &[usize]) -> Vec<usize> {
        let Some(overturning) = self.levels.last() else { return Vec::new() };
        let mut drawn = drawn.to_vec();
        drawn.sort_by(|a, b| overturning[*a].total_cmp(&overturning[*b]));
        drawn.truncate(EARLIEST);
        drawn
    }
}

impl SuiteDistances {
    /// The distances of a suite on a grid.
    ///
    /// # Errors
    /// If the grid was not run.
    pub fn new(
        results: &StudyResults,
        draws: &Resamples,
        suite: SuiteKind,
        arm: Arm,
    ) -> anyhow::Result<Self> {
        let own = results.suite(suite);
        let blocks = &own.distributions(arm, Intensity::Pga)?.blocks;
        let mut all: Vec<Option<BlockLevels>> = Vec::new();
        for (measure, shifted) in TestedMeasure::ALL
            .into_iter()
            .flat_map(|measure| [(measure, false), (measure, true)])
        {
            for (at, block) in blocks.iter().enumerate() {
                let frequency = at / SLENDERNESSES_RAD.len();
                let factors = measure.factors(&own.records, frequency);
                all.push(factors.map(|factors| {
                    let samples = block.samples.iter();
                    let levels =
                        samples.map(|s| scaled(s, &factors)).collect();
                    BlockLevels { levels, factors, shifted }
                }));
            }
        }
        let each = |of: &dyn Fn(&BlockLevels) -> OverLevels| -> Vec<_> {
            let one = |one: &Option<BlockLevels>| {
                one.as_ref().map_or(OverLevels::NONE, of)
            };
            all.iter().map(one).collect()
        };
        let slender = TestedMeasure::Pga.shifted().place(SLENDER);
        let of = |draw: Resample<'_>| -> Vec<f64> {
            let counts = draw.of(suite);
            let drawn: Vec<usize> =
                (0..counts.len()).filter(|r| counts[*r] > 0).collect();
            let of_earliest = all[slender].as_ref().map_or(f64::NAN, |one| {
                let earliest = one.earliest(&drawn);
                one.over_levels(&drawn, &[]).excess
                    - one.over_levels(&drawn, &earliest).excess
            });
            row(&each(&|one| one.over_levels(&drawn, &[])), of_earliest)
        };
        let found = draws.untied(suite, &of);
        // The values of the claims use all levels.
        let whole = each(&BlockLevels::whole);
        let whole = row(&whole, found.points[OF_EARLIEST]);
        let finite = |level: &&Vec<f64>| level.iter().all(|x| x.is_finite());
        let levels = blocks
            .iter()
            .map(|block| block.samples.iter().filter(finite).count())
            .collect();
        Ok(Self { suite, arm, replicated: found.moved_to(&whole), levels })
    }
}

/// The numbers of a draw in the order of [`SuiteDistances::replicated`].
fn row(each: &[OverLevels], of_earliest: f64) -> Vec<f64> {
    let excess = each.iter().map(|one| one.excess).chain([of_earliest]);
    excess.chain(each.iter().map(|one| one.accepted)).collect()
}

/// The distances of both suites on every drawn grid.
///
/// # Errors
/// If a grid was not run.
pub fn all_distances(
    results: &StudyResults,
    draws: &Resamples,
) -> anyhow::Result<Vec<SuiteDistances>> {
    let arms = results.plan.drawn();
    let places = SuiteKind::ALL
        .into_iter()
        .flat_map(|suite| arms.iter().map(move |arm| (suite, *arm)));
    places
        .map(|(suite, arm)| SuiteDistances::new(results, draws, suite, arm))
        .collect()
}
