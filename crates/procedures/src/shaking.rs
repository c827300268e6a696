//! Comparison of a block with shaking-table tests, to measure the error of the
//! model.
//!
//! A test is one motion of the table at one level, and whether the specimen
//! overturned. Tests of one motion at several levels are not independent: the
//! unit of every interval is the motion.

mod capacities;
mod error;
mod fates;
mod numbers;
mod onset;
mod predictor;
mod repeats;

use std::collections::BTreeMap;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::integrator::Model;
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::Estimate;
use serde::{Deserialize, Serialize};

use crate::Draws;
use capacities::TestRecords;
pub use error::ShakingError;
pub use numbers::ComputedTests;

rocking::named! {
    /// Outcome of a specimen in a test.
    pub enum TestFate: "fate" {
        /// It overturned.
        Overturned = "overturned",
        /// It did not overturn.
        Stood = "stood",
        /// The outcome is unknown: the test is counted, and left out.
        Unknown = "unknown",
    }
}

/// One shaking-table test.
#[derive(Clone, Debug)]
pub struct ShakingTest {
    /// The motion of the table as it was run.
    pub record: Accelerogram,
    /// Name of the motion that the test repeats, at some level.
    pub motion: String,
    /// Outcome of the specimen.
    pub fate: TestFate,
    /// Values of the test by name, for measures that are columns.
    pub columns: BTreeMap<String, f64>,
}

/// The slenderness of the specimen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Slenderness {
    /// The block is known.
    Given(Block),
    /// The frequency parameter p in rad/s is known; alpha is fitted so that
    /// the median of measured over computed capacity is 1, to 0.001.
    Fitted {
        /// Frequency parameter in rad/s.
        p_rad_s: f64,
    },
}

/// Options of a comparison with tests.
#[derive(Clone, Debug, PartialEq)]
pub struct TestOptions {
    /// The block, or its frequency parameter.
    pub slenderness: Slenderness,
    /// Coefficient of restitution.
    pub restitution: Restitution,
    /// Equation of motion.
    pub model: Model,
    /// Gravity in m/s2.
    pub gravity_m_s2: f64,
    /// Intensity measures that predict the same outcomes without the block.
    pub measures: Vec<IntensityMeasure>,
    /// Draws of motions, each with all its tests.
    pub draws: Draws,
}

/// Compares a block with shaking-table tests.
///
/// Each record is scaled until the block first overturns, at 0.1 of the onset
/// of rocking and bisected; over the record that is the test's capacity factor
/// c. A record that does not overturn the block up to 100 times the onset has
/// the last level. 1/c, and each measure, predict the outcomes by a lognormal
/// fragility of the highest likelihood (probit). All intervals draw motions
/// with all their tests. Tests with an unknown outcome are left out.
///
/// # Errors
/// [`ShakingError`] for fewer than three motions, outcomes of one kind,
/// outcomes that one factor on the capacity separates, measures that a test
/// does not have, and invalid analyses.
pub fn compare_with_tests(
    tests: &[ShakingTest],
    options: &TestOptions,
) -> Result<TestComparison, ShakingError> {
    let p_rad_s = match options.slenderness {
        Slenderness::Given(block) => block.frequency_rad_s(),
        Slenderness::Fitted { p_rad_s } => p_rad_s,
    };
    let measures = options.measures.iter().map(|im| im.of_block(p_rad_s));
    let own = TestOptions { measures: measures.collect(), ..options.clone() };
    TestRecords::new(tests, &own)?.computed()?.compare()
}

/// Level of the intervals of a comparison with tests.
pub const TEST_LEVEL: f64 = 0.9;

/// A block compared with shaking-table tests.
///
/// Capacities are the factors on the motion of a test at which the block
/// first overturns.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct TestComparison {
    /// Number of tests with a known outcome.
    pub tests: usize,
    /// Number of motions of these tests, the unit of all intervals.
    pub motions: usize,
    /// Tests in which the specimen overturned.
    pub overturned: usize,
    /// Tests whose outcome is unknown, which are left out.
    pub unknown: usize,
    /// Tests whose motion does not overturn the block at any level that was
    /// run: their capacity counts as the last level.
    pub never_overturned: usize,
    /// Slenderness of the block in rad; with an interval if it was fitted.
    pub alpha_rad: Estimate,
    /// Whether the slenderness was fitted to these outcomes.
    pub alpha_is_fitted: bool,
    /// Frequency parameter of the block in rad/s.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// Equation of motion.
    pub model: Model,
    /// Level of the intervals.
    pub level: f64,
    /// Draws of motions behind the intervals.
    pub replicates: usize,
    /// Repetition of the draws.
    pub seed: u64,
    /// Why the intervals are rough, if they are.
    pub remark: Option<String>,
    /// The block as a predictor of outcomes.
    pub computed: Predictor,
    /// Intensity measures as predictors of the same outcomes.
    pub rivals: Vec<Predictor>,
    /// Measures that have no fit to the measured outcomes, or none to the
    /// computed ones.
    #[serde(default)]
    pub unfitted: Vec<UnfittedMeasure>,
    /// Predicted and observed shares of overturning, by tenths of the tests
    /// in ascending order of the predicted probability.
    pub reliability: Vec<ReliabilityClass>,
    /// Repeatability of the tests.
    pub repeatability: Repeatability,
    /// Tests in which the block stays up although it overturns at a lower
    /// level of the motion.
    pub resurrected: Resurrected,
    /// Whether the scatter of the model acts on the whole capacity, or on
    /// its part above the onset of rocking.
    pub onset: OnsetComparison,
    /// Measured and computed fragilities of the same tests.
    pub distributions: Vec<DistributionComparison>,
    /// The tests, in their order.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub each: Vec<TestResult>,
}

/// How well one number per test predicts the outcomes.
///
/// The probability of overturning is Phi(ln(x/m)/s) of the number x; m and s
/// are of the highest likelihood. Probabilities that predict are of a fit
/// that leaves the motion of the test out.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Predictor {
    /// The block, or an intensity measure.
    pub predictor: String,
    /// Share of outcomes that are right: of the block as computed, of a
    /// measure by a predicted probability above 0.5.
    pub right: Estimate,
    /// Median m: of the block the bias, the median of measured over computed
    /// capacity, 1 if alpha is fitted; of a measure in its unit.
    pub median: Estimate,
    /// Dispersion s.
    pub dispersion: Estimate,
    /// Probability that a test that overturned the specimen has a larger
    /// number than one that did not (area under the ROC curve).
    pub auc: Estimate,
    /// Mean of -ln of the predicted probability of the outcome; small is good.
    pub log_score: Estimate,
    /// Log-likelihood of the fit to all tests.
    pub log_likelihood: f64,
}

/// A measure without a fit.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct UnfittedMeasure {
    /// Intensity measure.
    pub im: String,
    /// Whether the computed outcomes have no fit; else the measured ones, of
    /// all tests or of those of all motions but one.
    pub computed: bool,
    /// Why.
    pub reason: String,
}

/// Predicted and observed overturning of some tests.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct ReliabilityClass {
    /// Number of tests.
    pub tests: usize,
    /// Mean of the predicted probabilities.
    pub predicted: f64,
    /// Share that overturned, with an interval by motion if it has one.
    pub observed: Estimate,
}

/// Repeatability of tests.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Repeatability {
    /// Pairs of tests of one motion whose PGA differ by 5 % or less.
    pub pairs: usize,
    /// Pairs of different outcomes among them.
    pub different: usize,
    /// Motions with both outcomes.
    pub mixed_motions: usize,
    /// Motions among them that overturned the specimen at a lower PGA than
    /// one at which it stood.
    pub not_monotone: usize,
    /// Dispersion of the capacity within a motion, each motion with its own
    /// median, of the highest likelihood: biased low. None if no motion
    /// overlaps.
    pub dispersion: Option<f64>,
}

/// Tests at levels at which the block stays up again.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct Resurrected {
    /// Number of tests.
    pub tests: usize,
    /// Number of them that overturned the specimen.
    pub overturned: usize,
    /// Expected number by their first overturning, from a fit to the other
    /// tests.
    pub expected: Option<f64>,
    /// Share of correct outcomes over all tests if the response at the level
    /// of the test decides instead of the first overturning.
    pub right_at_level: f64,
}

/// Log-likelihood of the outcomes above the onset of rocking, g tan(alpha) (g
/// alpha for Eq. 2), by the quantity that the scatter of the model multiplies.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct OnsetComparison {
    /// Onset of rocking in g.
    pub onset_g: f64,
    /// Number of tests at a PGA above the onset.
    pub tests: usize,
    /// Tests at or below the onset that overturned the specimen.
    pub overturned_below: usize,
    /// Tests at or below the onset.
    pub below: usize,
    /// The whole capacity: median m c, dispersion s.
    pub whole: Option<f64>,
    /// The part above the onset r: median r + m (c - r), dispersion s above
    /// r.
    pub above: Option<f64>,
    /// Log-likelihood of a fragility of all tests in PGA without a shift.
    pub pga_unshifted: Option<f64>,
    /// Log-likelihood of a fragility in PGA above the onset; none if a test
    /// below the onset overturned the specimen.
    pub pga_shifted: Option<f64>,
}

/// Two fragilities fitted in the same way to the same tests: to the outcomes
/// that were measured and to those that the block has.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[non_exhaustive]
pub struct DistributionComparison {
    /// Intensity measure.
    pub im: String,
    /// Unit of the medians.
    pub unit: String,
    /// Measured median.
    pub measured_median: f64,
    /// Measured dispersion.
    pub measured_dispersion: f64,
    /// Computed median.
    pub computed_median: f64,
    /// Computed dispersion.
    pub computed_dispersion: f64,
    /// Measured over computed median.
    pub median_ratio: Estimate,
    /// Measured less computed dispersion.
    pub dispersion_difference: Estimate,
    /// Root of the difference of the squares of both dispersions, 0 if the
    /// computed one is larger: what the model leaves out.
    pub missing_dispersion: Estimate,
}

/// One test of a comparison.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct TestResult {
    /// Name of the record.
    pub test: String,
    /// Name of the motion.
    pub motion: String,
    /// PGA in g.
    pub pga_g: f64,
    /// Intensities in the measures of the fragilities, in their order.
    pub intensities: Vec<f64>,
    /// Factor on the motion at which the block first overturns, or of the
    /// last level that was run.
    pub capacity_factor: f64,
    /// Whether the block overturns at any level that was run.
    #[serde(skip)]
    pub overturns: bool,
    /// Whether the block overturns at the level of the test.
    pub overturns_at_level: bool,
    /// Predicted probability of overturning.
    pub probability: f64,
    /// Whether the specimen overturned.
    pub overturned: bool,
}

#[cfg(test)]
mod tests;
