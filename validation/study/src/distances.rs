//! Lilliefors' distance from a lognormal, and the share of demand levels at
//! which his test accepts one, over all subsets of the records.
//!
//! Levels of a block share records, and so do blocks. Both numbers are
//! therefore inferred from subsets without two earthquakes; a draw with
//! replacement would tie values, and ties break the test.

use libm::log;
use rocking_statistics::acceptance::distances;
use rocking_statistics::lilliefors::{LillieforsTable, LillieforsTest};

use crate::distributions::{BlockSamples, average_factors, factors, scaled};
use crate::estimates::mean;
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

/// Earliest overturnings that the paper's explanation of Figure 13 blames.
const EARLIEST: usize = 3;

/// A series of tests along the demand, made for each block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub(crate) enum TestSeries {
    OriginalPga,
    ShiftedPga,
    OriginalPgv,
    ShiftedPgv,
    OriginalGeometricMean,
    ShiftedGeometricMean,
    OriginalAverageSa,
    ShiftedAverageSa,
}

impl TestSeries {
    const ALL: [Self; 8] = [
        Self::OriginalPga,
        Self::ShiftedPga,
        Self::OriginalPgv,
        Self::ShiftedPgv,
        Self::OriginalGeometricMean,
        Self::ShiftedGeometricMean,
        Self::OriginalAverageSa,
        Self::ShiftedAverageSa,
    ];

    fn is_shifted(self) -> bool {
        matches!(
            self,
            Self::ShiftedPga
                | Self::ShiftedPgv
                | Self::ShiftedGeometricMean
                | Self::ShiftedAverageSa
        )
    }
}

/// Place of the excess less the excess without the earliest records, both
/// over the levels of a simulation.
pub(crate) const OF_EARLIEST: usize = TestSeries::ALL.len() * COUNT;

/// First place of the accepted shares: `TestSeries` by block.
const SHARES: usize = OF_EARLIEST + 1;

/// Results of Lilliefors' test for all blocks of a suite in an arm, over all
/// draws.
pub struct SuiteDistances {
    pub(crate) suite: SuiteKind,
    pub(crate) arm: Arm,
    /// The excess of D, `TestSeries` by block, then the part of the earliest
    /// records; then the accepted shares, `TestSeries` by block.
    pub(crate) replicated: Replicates,
    /// Levels at which every record is finite, of all, by block.
    pub(crate) levels: Vec<(usize, usize)>,
}

/// D over levels: the mean of D less its mean for a lognormal of as many
/// records, and the share of the levels at which D is not critical. NaN where
/// there is no level.
#[derive(Clone, Copy)]
struct OverLevels {
    excess: f64,
    accepted: f64,
}

impl OverLevels {
    /// Summary of the distances of levels with n records each. NaN is no
    /// distance.
    fn new(found: &[f64], null: f64, critical: f64) -> Self {
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

/// One block in one measure: the levels that enter a simulation, and the
/// factors that the shift is the least of.
struct BlockLevels {
    levels: Vec<Vec<f64>>,
    factors: Vec<f64>,
    shifted: bool,
}

impl BlockLevels {
    /// D of a draw over the levels, with the null of as many records.
    fn over_levels(
        &self,
        counts: &[u32],
        left_out: &[usize],
        (null, critical): (f64, f64),
    ) -> OverLevels {
        let drawn: Vec<usize> = (0..counts.len())
            .filter(|r| counts[*r] > 0 && !left_out.contains(r))
            .collect();
        let shift = if self.shifted {
            drawn.iter().fold(f64::INFINITY, |least, r| {
                if self.factors[*r] < least { self.factors[*r] } else { least }
            })
        } else {
            0.0
        };
        let logs: Vec<Vec<f64>> = self
            .levels
            .iter()
            .map(|level| {
                drawn.iter().map(|r| log(level[*r] - shift)).collect()
            })
            .collect();
        OverLevels::new(&distances(&logs), null, critical)
    }

    /// Positions of the records that overturn first.
    fn earliest(&self, counts: &[u32]) -> Vec<usize> {
        let Some(overturning) = self.levels.last() else { return Vec::new() };
        let mut drawn: Vec<usize> =
            (0..counts.len()).filter(|r| counts[*r] > 0).collect();
        drawn.sort_by(|a, b| overturning[*a].total_cmp(&overturning[*b]));
        drawn.truncate(EARLIEST);
        drawn
    }
}

impl SuiteDistances {
    /// The distances of a suite in an arm.
    ///
    /// # Errors
    /// If the arm was not run.
    pub fn new(
        results: &StudyResults,
        draws: &Resamples,
        suite: SuiteKind,
        arm: Arm,
    ) -> anyhow::Result<Self> {
        let own = results.suite(suite);
        let of = |intensity| own.distributions(arm, intensity);
        let (pga, pgv) = (of(Intensity::Pga)?, of(Intensity::Pgv)?);
        let records = &own.records;
        let n = records.len();
        let means: Option<Vec<f64>> =
            records.iter().map(|r| r.mean_over_study).collect();
        let mut all: Vec<Option<BlockLevels>> = Vec::new();
        // Values of the claims: they use all levels.
        let mut whole: Vec<OverLevels> = Vec::new();
        for tests in TestSeries::ALL {
            for at in 0..COUNT {
                let frequency = at / SLENDERNESSES_RAD.len();
                let p = FREQUENCIES_RAD_S[frequency];
                let (block, factors) = match tests {
                    TestSeries::OriginalPga | TestSeries::ShiftedPga => {
                        (&pga.blocks[at], Some(vec![1.0; n]))
                    }
                    TestSeries::OriginalPgv | TestSeries::ShiftedPgv => (
                        &pgv.blocks[at],
                        Some(factors(records, Intensity::Pgv, p)),
                    ),
                    TestSeries::OriginalGeometricMean
                    | TestSeries::ShiftedGeometricMean => {
                        (&pga.blocks[at], means.clone())
                    }
                    TestSeries::OriginalAverageSa
                    | TestSeries::ShiftedAverageSa => (
                        &pga.blocks[at],
                        Some(average_factors(records, frequency)),
                    ),
                };
                whole.push(value(tests, block, factors.as_deref()));
                let shifted = tests.is_shifted();
                let own = every(&pga.blocks[at].samples, BAND_STRIDE);
                all.push(factors.map(|factors| BlockLevels {
                    levels: own.map(|level| scaled(level, &factors)).collect(),
                    factors,
                    shifted,
                }));
            }
        }
        let slender = place(TestSeries::ShiftedPga, SLENDER);
        let of = |draw: Resample<'_>| -> Vec<f64> {
            let counts = draw.of(suite);
            let drawn = counts.iter().filter(|count| **count > 0).count();
            let nulls = null(drawn);
            let each: Vec<OverLevels> = all
                .iter()
                .map(|one| match one {
                    Some(one) => one.over_levels(counts, &[], nulls),
                    None => OverLevels::new(&[], f64::NAN, f64::NAN),
                })
                .collect();
            let earliest = all[slender].as_ref().map_or(f64::NAN, |one| {
                let earliest = one.earliest(counts);
                let others = null(drawn.saturating_sub(earliest.len()));
                one.over_levels(counts, &[], nulls).excess
                    - one.over_levels(counts, &earliest, others).excess
            });
            row(&each, earliest)
        };
        let found = draws.untied(suite, &of);
        let whole = row(&whole, found.points[OF_EARLIEST]);
        let levels = pga
            .blocks
            .iter()
            .map(|b| {
                let finite =
                    |level: &&Vec<f64>| level.iter().all(|x| x.is_finite());
                (b.samples.iter().filter(finite).count(), b.samples.len())
            })
            .collect();
        Ok(Self { suite, arm, replicated: found.moved_to(&whole), levels })
    }
}

/// The numbers of a draw in the order of [`SuiteDistances::replicated`].
fn row(each: &[OverLevels], of_earliest: f64) -> Vec<f64> {
    let excess = each.iter().map(|one| one.excess).chain([of_earliest]);
    excess.chain(each.iter().map(|one| one.accepted)).collect()
}

/// D of all levels and all records.
fn value(
    tests: TestSeries,
    block: &BlockSamples,
    factors: Option<&[f64]>,
) -> OverLevels {
    let of = |assessments: &[LillieforsTest]| {
        let d =
            |test: &LillieforsTest| test.statistic.map_or(f64::NAN, |s| s.d);
        let found: Vec<f64> = assessments.iter().map(d).collect();
        let n = block.samples.first().map_or(0, Vec::len);
        let accepted = accepted_share(assessments);
        OverLevels { accepted, ..OverLevels::new(&found, null(n).0, f64::NAN) }
    };
    match tests {
        TestSeries::OriginalPga | TestSeries::OriginalPgv => {
            of(&block.original)
        }
        TestSeries::ShiftedPga | TestSeries::ShiftedPgv => of(&block.shifted),
        TestSeries::OriginalGeometricMean
        | TestSeries::ShiftedGeometricMean
        | TestSeries::OriginalAverageSa
        | TestSeries::ShiftedAverageSa => {
            let factors = factors.unwrap_or_default();
            let least = match tests.is_shifted() {
                true => crate::distributions::least(factors),
                false => 0.0,
            };
            let samples: Vec<Vec<f64>> =
                block.samples.iter().map(|s| scaled(s, factors)).collect();
            of(&along(&samples, least).unwrap_or_default())
        }
    }
}

pub(crate) fn place(
    tests: TestSeries,
    (frequency, slenderness): (usize, usize),
) -> usize {
    tests as usize * COUNT + position(frequency, slenderness)
}

/// The excess of D by block.
pub(crate) fn excesses(row: &[f64], tests: TestSeries) -> &[f64] {
    let first = tests as usize * COUNT;
    &row[first..first + COUNT]
}

/// The accepted share by block.
pub(crate) fn accepted(row: &[f64], tests: TestSeries) -> &[f64] {
    let first = SHARES + tests as usize * COUNT;
    &row[first..first + COUNT]
}

/// The distances of both suites in every arm drawn.
///
/// # Errors
/// If an arm was not run.
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
