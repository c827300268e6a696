//! Shares of demand levels at which Lilliefors' test accepts a lognormal, over
//! all draws of the records.
//!
//! Levels of a block share records, and so do blocks. Shares are therefore
//! inferred from subsamples of the records; a draw with replacement would tie
//! values, and ties break the test.

use libm::log;
use rocking::statistics::acceptance::AcceptedShare;
use rocking::statistics::lilliefors::Table;

use crate::distributions::{BlockSamples, factors, scaled};
use crate::inference::{Draw, Draws, Replicated};
use crate::normality::{BAND_STRIDE, LEVEL, accepted_share, along, every};
use crate::results::Results;
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

/// What is tested of each block.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(usize)]
pub(crate) enum Tests {
    OriginalPga,
    ShiftedPga,
    OriginalPgv,
    ShiftedPgv,
    ShiftedGeometricMean,
}

impl Tests {
    const ALL: [Self; 5] = [
        Self::OriginalPga,
        Self::ShiftedPga,
        Self::OriginalPgv,
        Self::ShiftedPgv,
        Self::ShiftedGeometricMean,
    ];

    fn is_shifted(self) -> bool {
        !matches!(self, Self::OriginalPga | Self::OriginalPgv)
    }
}

/// Place of the share without the earliest records.
pub(crate) const WITHOUT_EARLIEST: usize = Tests::ALL.len() * COUNT;

/// Accepted shares of all blocks of a suite in an arm, over all draws.
pub struct Shares {
    pub(crate) suite: SuiteKind,
    pub(crate) arm: Arm,
    /// `Tests` by block, then the share without the earliest records.
    pub(crate) shares: Replicated,
    /// Levels at which every record is finite, of all, by block.
    pub(crate) levels: Vec<(usize, usize)>,
}

/// One block in one measure: the levels that enter a simulation, and the
/// factors that the shift is the least of.
struct Tested15 {
    levels: Vec<Vec<f64>>,
    factors: Vec<f64>,
    shifted: bool,
}

impl Tested15 {
    /// Accepted share of a draw.
    fn share(&self, counts: &[u32], left_out: &[usize]) -> f64 {
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
        let table = Table::embedded();
        table.critical_value(drawn.len(), LEVEL).map_or(f64::NAN, |(c, _)| {
            let found = AcceptedShare::of_values(&logs, c);
            found.share().unwrap_or(f64::NAN)
        })
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

impl Shares {
    /// The shares of a suite in an arm; none if it was not run.
    #[must_use]
    pub fn new(
        results: &Results,
        draws: &Draws,
        suite: SuiteKind,
        arm: Arm,
    ) -> Option<Self> {
        let of = |intensity| results.distributions(suite, arm, intensity);
        let (pga, pgv) = (of(Intensity::Pga)?, of(Intensity::Pgv)?);
        let facts = results.suite(suite);
        let n = facts.records.len();
        let means: Option<Vec<f64>> =
            facts.records.iter().map(|r| r.mean_over_study).collect();
        let mut all: Vec<Option<Tested15>> = Vec::new();
        // Of all levels, which are the values of the claims.
        let mut whole: Vec<f64> = Vec::new();
        for tests in Tests::ALL {
            for at in 0..COUNT {
                let p = FREQUENCIES_RAD_S[at / SLENDERNESSES_RAD.len()];
                let (block, factors) = match tests {
                    Tests::OriginalPga | Tests::ShiftedPga => {
                        (&pga.blocks[at], Some(vec![1.0; n]))
                    }
                    Tests::OriginalPgv | Tests::ShiftedPgv => (
                        &pgv.blocks[at],
                        Some(factors(facts, Intensity::Pgv, p)),
                    ),
                    Tests::ShiftedGeometricMean => {
                        (&pga.blocks[at], means.clone())
                    }
                };
                whole.push(value(tests, block, factors.as_deref()));
                all.push(factors.map(|factors| {
                    Tested15 {
                        levels: every(&block.samples, BAND_STRIDE)
                            .map(|level| match tests {
                                Tests::ShiftedGeometricMean => {
                                    scaled(level, &factors)
                                }
                                _ => level.clone(),
                            })
                            .collect(),
                        factors,
                        shifted: tests.is_shifted(),
                    }
                }));
            }
        }
        let slender = place(Tests::ShiftedPga, SLENDER);
        let of = |draw: Draw<'_>| -> Vec<f64> {
            let counts = draw.of(suite);
            let mut out: Vec<f64> = all
                .iter()
                .map(|one| {
                    one.as_ref().map_or(f64::NAN, |one| one.share(counts, &[]))
                })
                .collect();
            out.push(all[slender].as_ref().map_or(f64::NAN, |one| {
                one.share(counts, &one.earliest(counts))
            }));
            out
        };
        let shares = draws.subsampled(suite.into(), &of);
        // Without the earliest records, the levels of a simulation do.
        whole.push(shares.point(WITHOUT_EARLIEST));
        let levels = pga
            .blocks
            .iter()
            .map(|b| {
                let finite =
                    |level: &&Vec<f64>| level.iter().all(|x| x.is_finite());
                (b.samples.iter().filter(finite).count(), b.samples.len())
            })
            .collect();
        Some(Self { suite, arm, shares: shares.moved_to(&whole), levels })
    }
}

/// The accepted share of all levels and all records.
fn value(tests: Tests, block: &BlockSamples, factors: Option<&[f64]>) -> f64 {
    match tests {
        Tests::OriginalPga | Tests::OriginalPgv => block.shares().0,
        Tests::ShiftedPga | Tests::ShiftedPgv => block.shares().1,
        Tests::ShiftedGeometricMean => factors.map_or(f64::NAN, |factors| {
            let least = crate::distributions::least(factors);
            let samples: Vec<Vec<f64>> =
                block.samples.iter().map(|s| scaled(s, factors)).collect();
            along(&samples, least).map_or(f64::NAN, |t| accepted_share(&t))
        }),
    }
}

pub(crate) fn place(
    tests: Tests,
    (frequency, slenderness): (usize, usize),
) -> usize {
    tests as usize * COUNT + position(frequency, slenderness)
}

pub(crate) fn blocks(row: &[f64], tests: Tests) -> &[f64] {
    let first = tests as usize * COUNT;
    &row[first..first + COUNT]
}

/// Suites whose shares are needed.
#[must_use]
pub fn all(results: &Results, draws: &Draws) -> Vec<Shares> {
    let mut out = Vec::new();
    for suite in SuiteKind::BOTH {
        for arm in results.plan.drawn() {
            out.extend(Shares::new(results, draws, suite, arm));
        }
    }
    out
}
