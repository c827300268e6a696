//! Outcomes near the onset of rocking, and resurrections.

use super::fates::{Fates, ln_probability, log_likelihood, probit};
use super::{OnsetComparison, Resurrected, TestResult};
use libm::exp;

/// Likelihoods of the outcomes above the onset of rocking.
pub(super) fn onset(tests: &[TestResult], onset_g: f64) -> OnsetComparison {
    let (above, below): (Vec<_>, Vec<_>) =
        tests.iter().partition(|test| test.pga_g > onset_g);
    let likelihood = |tests: &[&TestResult],
                      shift: f64,
                      x: fn(&TestResult, f64) -> f64| {
        let x: Vec<f64> = tests.iter().map(|t| x(t, onset_g)).collect();
        let fates: Vec<bool> = tests.iter().map(|t| t.overturned).collect();
        let fit = probit(&x, &fates, &vec![1; x.len()], shift).ok()?;
        Some(log_likelihood(&fit, &x, &fates))
    };
    let overturned_below = below.iter().filter(|test| test.overturned).count();
    let all: Vec<&TestResult> = tests.iter().collect();
    OnsetComparison {
        onset_g,
        tests: above.len(),
        overturned_below,
        below: below.len(),
        whole: likelihood(&above, 0.0, |t, _| t.capacity_factor.recip()),
        above: likelihood(&above, 0.0, |t, onset_g| {
            (t.pga_g - onset_g) / (t.pga_g * t.capacity_factor - onset_g)
        }),
        pga_unshifted: likelihood(&all, 0.0, |t, _| t.pga_g),
        // A test that stood at or below the onset adds ln 1.
        pga_shifted: (overturned_below == 0)
            .then(|| likelihood(&above, onset_g, |t, _| t.pga_g))
            .flatten(),
    }
}

/// Tests at levels above the first overturning at which the block stays up.
pub(super) fn resurrected(
    tests: &[TestResult],
    x: &[f64],
    fates: &Fates,
) -> Resurrected {
    let is_own = |test: &TestResult| {
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
    let right = tests.iter().filter(|t| t.overturns_at_level == t.overturned);
    Resurrected {
        tests: own.len(),
        overturned: own.iter().filter(|i| tests[**i].overturned).count(),
        expected: fit.map(expected),
        right_at_level: right.count() as f64 / tests.len() as f64,
    }
}
