//! The outcomes of tests by motion, and fits of a number to them.

use super::TEST_LEVEL;
use rocking_statistics::lognormal::{FitError, Stripe, fit_counts_alone};
use rocking_statistics::resampling::Resampling;
use rocking_statistics::{Clusters, Estimate, Lognormal, Range, normal};

/// Outcomes of tests by motion.
pub(super) struct Fates {
    pub overturned: Vec<bool>,
    pub motions: Clusters,
}

impl Fates {
    /// Each test once.
    pub fn once(&self) -> Vec<u32> {
        vec![1; self.overturned.len()]
    }

    /// Numbers with their intervals from their values in draws of motions.
    pub fn estimates<const N: usize>(
        &self,
        points: [f64; N],
        drawn: &[[f64; N]],
        ranges: [Range; N],
    ) -> [Estimate; N] {
        let how = Resampling::Bootstrap;
        std::array::from_fn(|k| {
            let (point, range) = (points[k], ranges[k]);
            let own: Vec<f64> = drawn.iter().map(|all| all[k]).collect();
            let found =
                self.motions.estimate(point, &own, how, range, TEST_LEVEL);
            found.map_or(Estimate::exact(point), |found| found.estimate)
        })
    }
}

/// The lognormal fragility of the highest likelihood in the numbers `x`
/// above `shift`, each test as often as it is drawn.
pub(super) fn probit(
    x: &[f64],
    overturned: &[bool],
    counts: &[u32],
    shift: f64,
) -> Result<Lognormal, FitError> {
    let tests = x.iter().zip(overturned).zip(counts);
    let drawn = tests.filter(|(_, count)| **count > 0);
    let stripe = |((&im, &falls), &count): ((&f64, &bool), &u32)| {
        let n = u64::from(count);
        Stripe { im, exceeded: if falls { n } else { 0 }, n }
    };
    fit_counts_alone(&drawn.map(stripe).collect::<Vec<_>>(), shift)
}

/// ln of the probability that a fragility gives an outcome.
pub(super) fn ln_probability(of: &Lognormal, x: f64, overturned: bool) -> f64 {
    let z = of.score(x);
    normal::ln_cdf(if overturned { z } else { -z })
}

/// The log-likelihood of a fragility.
pub(super) fn log_likelihood(
    of: &Lognormal,
    x: &[f64],
    overturned: &[bool],
) -> f64 {
    let tests = x.iter().zip(overturned);
    tests.fold(0.0, |sum, (x, fate)| sum + ln_probability(of, *x, *fate))
}

/// ln of the probability of the outcome of each test, by a fit that leaves its
/// motion out.
///
/// # Errors
/// The first motion, in their order, without which there is no fit.
pub(super) fn left_out(
    x: &[f64],
    fates: &Fates,
) -> Result<Vec<f64>, (usize, FitError)> {
    let mut found = vec![f64::NAN; x.len()];
    for motion in 0..fates.motions.count() {
        let others = fates.motions.without(motion);
        let fit = probit(x, &fates.overturned, &others, 0.0)
            .map_err(|source| (motion, source))?;
        for &test in fates.motions.members(motion) {
            found[test] =
                ln_probability(&fit, x[test], fates.overturned[test]);
        }
    }
    Ok(found)
}
