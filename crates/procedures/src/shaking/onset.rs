//! What the fates say about the onset of rocking and about resurrections.

use super::fates::{Fates, highest_log_likelihood, ln_probability, probit};
use super::{ComputedTest, OnsetComparison, Resurrected};
use libm::exp;

/// Likelihoods of the fates above the onset of rocking.
pub(super) fn onset(
    tests: &[ComputedTest],
    fates: &Fates,
    onset_g: f64,
) -> OnsetComparison {
    let all = tests.iter().zip(&fates.overturned);
    let (above, below): (Vec<_>, Vec<_>) =
        all.partition(|(test, _)| test.pga_g > onset_g);
    let overturned: Vec<bool> = above.iter().map(|one| *one.1).collect();
    let likelihood = |x: &dyn Fn(&ComputedTest) -> f64, shift: f64| {
        let x: Vec<f64> = above.iter().map(|(test, _)| x(test)).collect();
        highest_log_likelihood(&x, &overturned, shift)
    };
    let capacity = |test: &ComputedTest| test.pga_g * test.capacity_factor;
    let pga: Vec<f64> = tests.iter().map(|test| test.pga_g).collect();
    let overturned_below = below.iter().filter(|one| *one.1).count();
    OnsetComparison {
        onset_g,
        tests: above.len(),
        overturned_below,
        below: below.len(),
        whole: likelihood(&|test| test.capacity_factor.recip(), 0.0),
        above: likelihood(
            &|test| (test.pga_g - onset_g) / (capacity(test) - onset_g),
            0.0,
        ),
        pga_unshifted: highest_log_likelihood(&pga, &fates.overturned, 0.0),
        // A test that stood at or below the onset adds ln 1.
        pga_shifted: (overturned_below == 0)
            .then(|| likelihood(&|test| test.pga_g, onset_g))
            .flatten(),
    }
}

/// Tests at levels at which the block stands above its first overturning.
pub(super) fn resurrected(
    tests: &[ComputedTest],
    x: &[f64],
    fates: &Fates,
) -> Resurrected {
    let is_own = |test: &ComputedTest| {
        test.capacity_factor < 1.0 && !test.overturns_at_level
    };
    let others: Vec<u32> =
        tests.iter().map(|test| u32::from(!is_own(test))).collect();
    let own: Vec<usize> =
        (0..tests.len()).filter(|i| others[*i] == 0).collect();
    let fit = probit(x, &fates.overturned, &others, 0.0).ok();
    let expected = |fit| {
        let each = own.iter().map(|i| exp(ln_probability(&fit, x[*i], true)));
        each.fold(0.0, |sum, p| sum + p)
    };
    let right = tests.iter().zip(&fates.overturned);
    let right = right.filter(|(test, fate)| test.overturns_at_level == **fate);
    Resurrected {
        tests: own.len(),
        overturned: own.iter().filter(|i| fates.overturned[**i]).count(),
        expected: fit.map(expected),
        right_at_level: right.count() as f64 / tests.len() as f64,
    }
}
