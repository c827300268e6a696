//! The lognormals that the paper compares.

use rocking_procedures::fragility::transform;
use rocking_statistics::lognormal::{FitMethod, fit, fit_intervals};
use rocking_statistics::{ExtendedSample, Lognormal, QuantileType};

/// Demand thresholds of Figures 15 to 17.
pub(crate) const THRESHOLDS: [f64; 3] = [0.15, 0.35, 1.0];

/// Constants of Eq. 7 in Figure 18.
pub(crate) const CONSTANTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// The block of Figures 15 to 18: p = 3, alpha = 0.20.
pub(crate) const BLOCK: (usize, usize) = (1, 3);

/// The untrimmed fit.
pub(crate) const MLE: FitMethod = FitMethod::MaximumLikelihood;

/// The fit of the trimmed sample.
pub(crate) fn trimmed() -> FitMethod {
    FitMethod::Trimmed(QuantileType::default())
}

/// The lognormals that the paper compares, of one sample and shift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fits {
    /// Fitted to the sample as it is, by maximum likelihood.
    pub usfl: Option<Lognormal>,
    /// Fitted to the shifted sample, by maximum likelihood.
    pub ssfl: Option<Lognormal>,
    /// Fitted to the trimmed sample, by moments.
    pub trimmed: Option<Lognormal>,
}

impl Fits {
    pub(crate) fn new(sample: &ExtendedSample, shift: f64) -> Self {
        let by = |shift, method| {
            fit(sample, shift, method).ok().map(|f| f.distribution)
        };
        Self {
            usfl: by(0.0, MLE),
            ssfl: by(shift, MLE),
            trimmed: by(0.0, trimmed()),
        }
    }
}

/// Eqs. 5 and 7 applied to a fit; none where they are not defined.
pub(crate) fn usfl7(
    usfl: Option<Lognormal>,
    shift: f64,
    c: f64,
) -> Option<Lognormal> {
    transform(&usfl?, shift, c).ok()
}

/// Largest distance of a fitted fragility to the empirical one; NaN where
/// there is no fit.
pub(crate) fn distance(
    fitted: Option<Lognormal>,
    sample: &ExtendedSample,
) -> f64 {
    fitted.map_or(f64::NAN, |f| f.kolmogorov_distance(sample))
}

/// The lognormal of most likelihood for intensities that are known as
/// (low, high), each counted so often; none where there is none.
pub(crate) fn of_intervals(
    known: &[(f64, f64)],
    counts: &[u32],
    shift: f64,
) -> Option<Lognormal> {
    let times = known.iter().zip(counts);
    let all: Vec<(f64, f64)> = times
        .flat_map(|(x, n)| std::iter::repeat_n(*x, *n as usize))
        .collect();
    fit_intervals(&all, shift).ok().map(|fit| fit.distribution)
}
