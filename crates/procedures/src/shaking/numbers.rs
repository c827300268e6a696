//! The comparison of numbers: capacities and measures of tests, and fates.

use super::distribution::{Differences, differences, distribution};
use super::fates::{Fates, probit};
use super::onset::{onset, resurrected};
use super::predictor::{PredictorNumbers, Scores};
use super::repeats::repeatability;
use super::{
    ReliabilityClass, ShakingError, TEST_LEVEL, TestComparison, TestResult,
    UnfittedMeasure,
};
use crate::Draws;
use libm::{exp, log};
use rocking::block::{Block, Restitution};
use rocking::integrator::{Model, uplift_threshold};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::clusters::SamplingUnit;
use rocking_statistics::lognormal::FitError;
use rocking_statistics::resampling::multiplicities;
use rocking_statistics::{Clusters, Estimate, Lognormal, Proportion, Range};

/// Name of the block among the predictors.
const BLOCK: &str = "block";

/// Classes of a reliability table.
const CLASSES: usize = 10;

/// Fewest motions of a comparison.
const LEAST_MOTIONS: usize = 3;

/// A test with a known fate, and what was computed of it.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputedTest {
    /// Name of the test.
    pub test: String,
    /// Name of the motion.
    pub motion: String,
    /// PGA in g.
    pub pga_g: f64,
    /// Factor on the motion at which the block first overturns, or of the
    /// last level that was run.
    pub capacity_factor: f64,
    /// Whether the block overturns at any level that was run.
    pub overturns: bool,
    /// Whether the block overturns at the level of the test.
    pub overturns_at_level: bool,
    /// Whether the specimen overturned.
    pub overturned: bool,
    /// Value of each measure.
    pub measures: Vec<f64>,
}

/// Tests that a block was computed for: a comparison without its records.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputedTests {
    /// The tests whose fate is known.
    pub tests: Vec<ComputedTest>,
    /// Number of tests whose fate is unknown.
    pub unknown: usize,
    /// The measures of the tests, in the order of their values.
    pub measures: Vec<IntensityMeasure>,
    /// The block.
    pub block: Block,
    /// Coefficient of restitution.
    pub restitution: Restitution,
    /// Equation of motion.
    pub model: Model,
    /// Change of ln of the median of measured over computed capacity by that
    /// of ln alpha, if alpha was fitted to make the median 1.
    pub fitted_slope: Option<f64>,
}

/// What a draw makes of the block and of each measure.
type Row = (Scores, Vec<(Scores, Differences)>);

/// A measure as a predictor, and the fit to the computed fates.
struct Rival<'a> {
    im: &'a IntensityMeasure,
    own: PredictorNumbers,
    computed: Option<Lognormal>,
}

impl ComputedTests {
    /// Compares the fates with what was computed.
    ///
    /// # Errors
    /// [`ShakingError`] as of
    /// [`compare_with_tests`](super::compare_with_tests), and for numbers
    /// that are not positive.
    pub fn compare(
        &self,
        draws: Draws,
    ) -> Result<TestComparison, ShakingError> {
        draws.check()?;
        let fates = self.fates()?;
        let computed = self.block(&fates)?;
        let (rivals, unfitted) = self.rivals(&fates);
        let bootstrap = Bootstrap::of_clusters(
            "shaking",
            draws.seed,
            &fates.motions,
            draws.replicates,
        );
        let falls: Vec<bool> =
            self.tests.iter().map(|t| t.capacity_factor <= 1.0).collect();
        let rows: Vec<Row> = bootstrap.map(|places| {
            let counts = multiplicities(places, falls.len());
            let scores = |of: &PredictorNumbers| {
                let fit = probit(&of.x, &fates.overturned, &counts, 0.0).ok();
                (of.scores(fit.as_ref(), &fates, &counts), fit)
            };
            let rival = |rival: &Rival<'_>| {
                let (scores, measured) = scores(&rival.own);
                let both = rival.computed.and(measured).and_then(|measured| {
                    let x = &rival.own.x;
                    let computed = probit(x, &falls, &counts, 0.0).ok()?;
                    Some(differences(&measured, &computed))
                });
                (scores, both.unwrap_or([f64::NAN; 3]))
            };
            (scores(&computed).0, rivals.iter().map(rival).collect())
        });
        let own: Vec<Scores> = rows.iter().map(|row| row.0).collect();
        let mut predictor = computed.predictor(&fates, &own);
        let alpha = self.block.slenderness_rad();
        let mut alpha_rad = Estimate::exact(alpha);
        if let Some(slope) = self.fitted_slope {
            let of = |own: &Scores| alpha * exp(-log(own[1]) / slope);
            let drawn: Vec<f64> = own.iter().map(of).collect();
            alpha_rad = fates.estimate(alpha, &drawn, Range::NotNegative);
            let median = predictor.median.value();
            predictor.median = predictor.median.map(|m| m / median);
        }
        let of_rival = |k: usize| {
            let scores: Vec<Scores> =
                rows.iter().map(|row| row.1[k].0).collect();
            rivals[k].own.predictor(&fates, &scores)
        };
        let of_distribution = |k: usize| {
            let Rival { im, own, computed } = &rivals[k];
            let drawn: Vec<Differences> =
                rows.iter().map(|row| row.1[k].1).collect();
            let fit = (*computed)?;
            Some(distribution(im, &fates, &own.fit, &fit, &drawn))
        };
        let probabilities = computed.probabilities(&fates);
        let pga: Vec<f64> = self.tests.iter().map(|t| t.pga_g).collect();
        let threshold = uplift_threshold(&self.block, self.model);
        let remark = fates.motions.remark(draws.replicates);
        Ok(TestComparison {
            tests: self.tests.len(),
            motions: fates.motions.count(),
            overturned: fates.overturned.iter().filter(|f| **f).count(),
            unknown: self.unknown,
            never_overturned: self
                .tests
                .iter()
                .filter(|test| !test.overturns)
                .count(),
            alpha_rad,
            alpha_is_fitted: self.fitted_slope.is_some(),
            p_rad_s: self.block.frequency_rad_s(),
            eta: self.restitution.velocity_ratio(),
            model: self.model,
            level: TEST_LEVEL,
            replicates: draws.replicates,
            seed: draws.seed,
            remark: remark.map(|remark| remark.to_string()),
            computed: predictor,
            rivals: (0..rivals.len()).map(of_rival).collect(),
            unfitted,
            reliability: reliability(&probabilities, &fates),
            repeatability: repeatability(&pga, &fates),
            resurrected: resurrected(&self.tests, &computed.x, &fates),
            onset: onset(&self.tests, &fates, threshold),
            distributions: (0..rivals.len())
                .filter_map(of_distribution)
                .collect(),
            each: self.each(&probabilities, &rivals),
        })
    }

    /// Median of measured over computed capacity.
    ///
    /// # Errors
    /// As [`Self::compare`].
    pub(super) fn bias(&self) -> Result<f64, ShakingError> {
        let fates = self.fates()?;
        let fit =
            probit(&self.demands(), &fates.overturned, &fates.once(), 0.0);
        let refused = |source| ShakingError::Fit { without: None, source };
        Ok(fit.map_err(refused)?.median())
    }

    /// Demand over capacity of each test.
    fn demands(&self) -> Vec<f64> {
        self.tests.iter().map(|test| test.capacity_factor.recip()).collect()
    }

    /// The fates, if they can be compared.
    fn fates(&self) -> Result<Fates, ShakingError> {
        let tests = self.tests.len();
        if tests == 0 {
            return Err(ShakingError::NoTests { unknown: self.unknown });
        }
        let labels = self.tests.iter().map(|test| &test.motion);
        let motions = Clusters::of_unit(SamplingUnit::Motion, labels);
        let found = motions.count();
        if found < LEAST_MOTIONS {
            return Err(ShakingError::Motions { found, tests });
        }
        let overturned: Vec<bool> =
            self.tests.iter().map(|test| test.overturned).collect();
        match overturned.iter().filter(|fate| **fate).count() {
            0 => return Err(ShakingError::NoneOverturned(tests)),
            all if all == tests => {
                return Err(ShakingError::AllOverturned(tests));
            }
            _ => {}
        }
        for test in &self.tests {
            test.check(&self.measures)?;
        }
        Ok(Fates { overturned, motions })
    }

    /// The block as a predictor.
    fn block(&self, fates: &Fates) -> Result<PredictorNumbers, ShakingError> {
        let (name, x) = (BLOCK.to_owned(), self.demands());
        let found = PredictorNumbers::new(name, x, fates, Some(1.0));
        found.map_err(|(motion, source)| ShakingError::Fit {
            without: motion.map(|motion| {
                let first = fates.motions.members(motion)[0];
                self.tests[first].motion.clone()
            }),
            source,
        })
    }

    /// The measures as predictors, and those that give no fit.
    fn rivals(&self, fates: &Fates) -> (Vec<Rival<'_>>, Vec<UnfittedMeasure>) {
        let (mut rivals, mut unfitted) = (Vec::new(), Vec::new());
        let falls: Vec<bool> =
            self.tests.iter().map(|t| t.capacity_factor <= 1.0).collect();
        let mut refuse =
            |im: &IntensityMeasure, computed, source: FitError| {
                let (im, reason) = (im.to_string(), source.to_string());
                unfitted.push(UnfittedMeasure { im, computed, reason });
            };
        for (k, im) in self.measures.iter().enumerate() {
            let x = self.tests.iter().map(|test| test.measures[k]).collect();
            let name = im.to_string();
            match PredictorNumbers::new(name, x, fates, None) {
                Err((_, source)) => refuse(im, false, source),
                Ok(own) => {
                    let once = fates.once();
                    let computed = probit(&own.x, &falls, &once, 0.0);
                    let computed = computed
                        .map_err(|source| refuse(im, true, source))
                        .ok();
                    rivals.push(Rival { im, own, computed });
                }
            }
        }
        (rivals, unfitted)
    }

    fn each(
        &self,
        probabilities: &[f64],
        rivals: &[Rival<'_>],
    ) -> Vec<TestResult> {
        let shown = |im: &&IntensityMeasure| {
            let fitted = |r: &Rival<'_>| r.im == *im && r.computed.is_some();
            rivals.iter().any(fitted)
        };
        let tests = self.tests.iter().zip(probabilities);
        let result = |(test, probability): (&ComputedTest, &f64)| TestResult {
            test: test.test.clone(),
            motion: test.motion.clone(),
            pga_g: test.pga_g,
            intensities: self
                .measures
                .iter()
                .zip(&test.measures)
                .filter(|(im, _)| shown(im))
                .map(|(_, value)| *value)
                .collect(),
            capacity_factor: test.capacity_factor,
            overturns_at_level: test.overturns_at_level,
            probability: *probability,
            overturned: test.overturned,
        };
        tests.map(result).collect()
    }
}

impl ComputedTest {
    fn check(
        &self,
        measures: &[IntensityMeasure],
    ) -> Result<(), ShakingError> {
        let is_positive = |x: f64| x > 0.0 && x.is_finite();
        let test = || self.test.clone();
        let numbers = [
            ("PGA in g", self.pga_g),
            ("capacity over motion", self.capacity_factor),
        ];
        for (what, found) in numbers {
            if !is_positive(found) {
                return Err(ShakingError::Number {
                    test: test(),
                    what,
                    found,
                });
            }
        }
        let (found, expected) = (self.measures.len(), measures.len());
        if found != expected {
            return Err(ShakingError::Values {
                test: test(),
                found,
                expected,
            });
        }
        let mut values = self.measures.iter().zip(measures);
        match values.find(|(value, _)| !is_positive(**value)) {
            None => Ok(()),
            Some((found, im)) => Err(ShakingError::Measure {
                test: test(),
                measure: im.to_string(),
                found: *found,
            }),
        }
    }
}

/// Predicted and observed shares, by tenths of the tests.
fn reliability(probabilities: &[f64], fates: &Fates) -> Vec<ReliabilityClass> {
    let n = probabilities.len();
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| probabilities[*a].total_cmp(&probabilities[*b]));
    let class = |k: usize| {
        let own = &order[k * n / CLASSES..(k + 1) * n / CLASSES];
        let held: Vec<bool> =
            own.iter().map(|i| fates.overturned[*i]).collect();
        let motions = fates.motions.part(own);
        let share = Proportion::of_clusters(&held, &motions).ok()?;
        let interval = share.interval(TEST_LEVEL).ok()?;
        let observed =
            Estimate::try_new(share.share(), interval, Range::Share);
        let sum = own.iter().fold(0.0, |sum, i| sum + probabilities[*i]);
        Some(ReliabilityClass {
            tests: own.len(),
            predicted: sum / own.len() as f64,
            observed: observed.unwrap_or(Estimate::exact(share.share())),
        })
    };
    (0..CLASSES).filter_map(class).collect()
}
