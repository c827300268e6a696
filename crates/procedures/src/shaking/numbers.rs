//! Comparison of capacities and measures of tests with outcomes.

use super::fates::{Fates, probit};
use super::onset::{onset, resurrected};
use super::predictor::{PredictorNumbers, Scores, differences, distribution};
use super::repeats::repeatability;
use super::{
    ReliabilityClass, ShakingError, TEST_LEVEL, TestComparison, TestOptions,
    TestResult, UnfittedMeasure,
};
use libm::{exp, log};
use rocking::block::Block;
use rocking::integrator::uplift_threshold;
use rocking_statistics::clusters::SamplingUnit;
use rocking_statistics::lognormal::FitError;
use rocking_statistics::resampling::multiplicities;
use rocking_statistics::{Clusters, Estimate, Proportion, Range};

/// Name of the block among the predictors.
const BLOCK: &str = "block";

/// Classes of a reliability table.
const CLASSES: usize = 10;

/// Fewest motions of a comparison.
const LEAST_MOTIONS: usize = 3;

/// Tests with computed capacities: the input of a comparison, without records.
#[derive(Clone, Debug, PartialEq)]
pub struct ComputedTests<'a> {
    /// The tests whose outcome is known, with the values of all measures;
    /// their probabilities are not read.
    pub tests: Vec<TestResult>,
    /// Number of tests whose outcome is unknown.
    pub unknown: usize,
    /// The block.
    pub block: Block,
    /// Change of ln of the median of measured over computed capacity by that
    /// of ln alpha, if alpha was fitted to make the median 1.
    pub fitted_slope: Option<f64>,
    /// Options of the computation and the comparison.
    pub options: &'a TestOptions,
}

impl ComputedTests<'_> {
    /// Compares the outcomes with what was computed.
    ///
    /// # Errors
    /// [`ShakingError`] as of
    /// [`compare_with_tests`](super::compare_with_tests), and for numbers
    /// that are not positive.
    pub fn compare(&self) -> Result<TestComparison, ShakingError> {
        let draws = self.options.draws;
        draws.check()?;
        let fates = self.fates()?;
        let once = fates.once();
        let name = BLOCK.to_owned();
        let computed =
            PredictorNumbers::new(name, self.demands(), &fates, Some(1.0))
                .map_err(|(motion, source)| ShakingError::Fit {
                    without: motion.map(|motion| {
                        let first = fates.motions.members(motion)[0];
                        self.tests[first].motion.clone()
                    }),
                    source,
                })?;
        let bootstrap = draws.of("shaking", &fates.motions);
        let falls: Vec<bool> =
            self.tests.iter().map(|t| t.capacity_factor <= 1.0).collect();
        // Scores of a predictor in the draws, and differences to its fragility
        // of the computed outcomes.
        let drawn = |of: &PredictorNumbers, is_compared: bool| {
            let rows = bootstrap.map(|places| {
                let counts = multiplicities(places, falls.len());
                let measured = probit(&of.x, &fates.overturned, &counts, 0.0);
                let measured = measured.ok();
                let scores = of.scores(measured.as_ref(), &fates, &counts);
                let both = measured.filter(|_| is_compared);
                let both = both.and_then(|measured| {
                    let computed = probit(&of.x, &falls, &counts, 0.0).ok()?;
                    Some(differences(&measured, &computed))
                });
                (scores, both.unwrap_or([f64::NAN; 3]))
            });
            rows.into_iter().unzip::<_, _, Vec<Scores>, Vec<_>>()
        };
        let (own, _) = drawn(&computed, false);
        let mut predictor = computed.predictor(&fates, &own);
        let alpha = self.block.slenderness_rad();
        let mut alpha_rad = Estimate::exact(alpha);
        if let Some(slope) = self.fitted_slope {
            let of = |own: &Scores| [alpha * exp(-log(own[1]) / slope)];
            let drawn: Vec<[f64; 1]> = own.iter().map(of).collect();
            [alpha_rad] =
                fates.estimates([alpha], &drawn, [Range::NotNegative]);
            let median = predictor.median.value();
            predictor.median = predictor.median.map(|m| m / median);
        }
        let (mut rivals, mut unfitted) = (Vec::new(), Vec::new());
        let (mut distributions, mut compared) = (Vec::new(), Vec::new());
        for (k, im) in self.options.measures.iter().enumerate() {
            let mut refuse = |computed, source: FitError| {
                let (im, reason) = (im.to_string(), source.to_string());
                unfitted.push(UnfittedMeasure { im, computed, reason });
            };
            let x = self.tests.iter().map(|t| t.intensities[k]).collect();
            let own = PredictorNumbers::new(im.to_string(), x, &fates, None);
            let own = own.map_err(|(_, source)| refuse(false, source));
            let Ok(own) = own else { continue };
            let fit = probit(&own.x, &falls, &once, 0.0);
            let fit = fit.map_err(|source| refuse(true, source)).ok();
            let (scores, differences) = drawn(&own, fit.is_some());
            rivals.push(own.predictor(&fates, &scores));
            if let Some(fit) = fit {
                compared.push(k);
                let both = [&own.fit, &fit];
                let found = distribution(im, &fates, both, &differences);
                distributions.push(found);
            }
        }
        let probabilities = computed.probabilities(&fates);
        let each = self.tests.iter().zip(&probabilities);
        let each = each.map(|(test, &probability)| {
            let own = compared.iter().map(|k| test.intensities[*k]);
            let intensities = own.collect();
            TestResult { intensities, probability, ..test.clone() }
        });
        let threshold = uplift_threshold(&self.block, self.options.model);
        let pga: Vec<f64> = self.tests.iter().map(|t| t.pga_g).collect();
        let remark = fates.motions.remark(draws.replicates);
        let count = |is: fn(&&TestResult) -> bool| {
            self.tests.iter().filter(is).count()
        };
        Ok(TestComparison {
            tests: self.tests.len(),
            motions: fates.motions.count(),
            overturned: count(|test| test.overturned),
            unknown: self.unknown,
            never_overturned: count(|test| !test.overturns),
            alpha_rad,
            alpha_is_fitted: self.fitted_slope.is_some(),
            p_rad_s: self.block.frequency_rad_s(),
            eta: self.options.restitution.velocity_ratio(),
            model: self.options.model,
            level: TEST_LEVEL,
            replicates: draws.replicates,
            seed: draws.seed,
            remark: remark.map(|remark| remark.to_string()),
            computed: predictor,
            rivals,
            unfitted,
            reliability: reliability(&probabilities, &fates),
            repeatability: repeatability(&pga, &fates),
            resurrected: resurrected(&self.tests, &computed.x, &fates),
            onset: onset(&self.tests, threshold),
            distributions,
            each: each.collect(),
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

    /// The outcomes, if they can be compared.
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
        for (fate, which) in [(true, "none of"), (false, "all")] {
            if !overturned.contains(&fate) {
                return Err(ShakingError::OneFate { which, tests });
            }
        }
        let is_positive = |x: f64| x > 0.0 && x.is_finite();
        for test in &self.tests {
            let numbers = [
                ("PGA in g".to_owned(), test.pga_g),
                ("capacity over motion".to_owned(), test.capacity_factor),
            ];
            let names = self.options.measures.iter().map(ToString::to_string);
            let values = test.intensities.iter().copied();
            let values = names.zip(values.chain(std::iter::repeat(f64::NAN)));
            let mut all = numbers.into_iter().chain(values);
            if let Some((what, found)) = all.find(|one| !is_positive(one.1)) {
                let test = test.test.clone();
                return Err(ShakingError::Number { test, what, found });
            }
        }
        Ok(Fates { overturned, motions })
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
