//! The kept shaking-table tests of two rocks, and the model's prediction of
//! their outcomes.

mod drawing;
mod sentences;
mod tables;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use anyhow::Context as _;
use rocking_procedures::shaking::{
    DistributionComparison, Predictor, TestComparison,
};
use serde::Deserialize;

/// The kept results.
pub const KEPT: &str = rocking_fixtures::text("tests/granite.json");

/// The kept results of tests on two rocks.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RockTests {
    /// The authors of the tests, and the year.
    source: String,
    /// The repository of the data.
    repository: String,
    /// SHA-256 of the tables, and of the list of motions.
    sha256: BTreeMap<String, String>,
    /// Number of motions of all tests.
    motions: usize,
    /// Most tests of one motion.
    levels: usize,
    /// Tests whose motion is not available.
    missing_motions: usize,
    /// Tests whose stated peak is a target that the measured one misses.
    targets: usize,
    /// The outcomes of all tests, without their motions.
    measured: [MeasuredFates; 2],
    /// With a fitted slenderness; the sentences are about these.
    fitted: [TestComparison; 2],
    /// Without the tests whose stated peak is a target.
    without_targets: [TestComparison; 2],
    /// With a given, rounded slenderness.
    given: [TestComparison; 2],
    /// With a fitted slenderness and Housner's restitution.
    housner: [TestComparison; 2],
    /// Changes of the fitted block.
    varied: Vec<ChangedRocks>,
}

/// The outcomes of all tests of a rock, without their motions.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct MeasuredFates {
    tests: usize,
    overturned: usize,
    /// Onset of rocking in g, at the rounded slenderness.
    onset_g: f64,
    /// Tests at or below the onset, and how many of them overturned.
    below: usize,
    overturned_below: usize,
    /// How many would by a lognormal in PGA without a shift.
    expected_below: f64,
    /// Log-likelihoods of the tests above the onset without and with a shift
    /// to it.
    pga_unshifted: f64,
    pga_shifted: f64,
    /// The same in PGV above the paper's shift.
    pgv_unshifted: f64,
    pgv_shifted: f64,
}

/// Both rocks with a change of the block or of the motions.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ChangedRocks {
    change: String,
    rocks: [TestComparison; 2],
}

/// An intensity measure of the comparison: its name, and the beginning of its
/// name in the results.
#[derive(Clone, Copy)]
struct TestMeasure {
    name: &'static str,
    prefix: &'static str,
}

impl TestMeasure {
    const PGA: Self = Self { name: "PGA", prefix: "pga" };
    const PGV: Self = Self { name: "PGV", prefix: "column:" };
    const AVERAGE_SA: Self = Self { name: "average SA", prefix: "avgsa:" };
    const ALL: [Self; 3] = [Self::PGA, Self::PGV, Self::AVERAGE_SA];

    /// The measure as a predictor.
    fn predictor(self, of: &TestComparison) -> Option<&Predictor> {
        of.rivals.iter().find(|p| p.predictor.starts_with(self.prefix))
    }

    /// The fragilities in the measure.
    fn fragilities(
        self,
        of: &TestComparison,
    ) -> Option<&DistributionComparison> {
        of.distributions.iter().find(|d| d.im.starts_with(self.prefix))
    }
}

impl RockTests {
    /// The kept results.
    ///
    /// # Errors
    /// If the file has been damaged.
    pub fn kept() -> anyhow::Result<Self> {
        serde_json::from_str(KEPT).context("fixtures/tests/granite.json")
    }

    /// Tests that are compared with the model.
    fn compared(&self) -> usize {
        self.fitted[0].tests
    }
}
