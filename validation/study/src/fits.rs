//! The lognormals that the paper compares.

use rocking_procedures::fragility::transform;
use rocking_statistics::lognormal::{FitMethod, fit};
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

/// A sample with its shift, and the lognormals that the paper compares.
#[derive(Clone, Debug)]
pub(crate) struct Fits {
    /// The sample.
    pub sample: ExtendedSample,
    /// The shift IM_R.
    pub shift: f64,
    /// Fit of the original sample, by maximum likelihood.
    pub usfl: Option<Lognormal>,
    /// Fit of the shifted sample, by maximum likelihood.
    pub ssfl: Option<Lognormal>,
    /// Fit of the trimmed sample, by moments.
    pub trimmed: Option<Lognormal>,
}

impl Fits {
    pub(crate) fn new(sample: ExtendedSample, shift: f64) -> Self {
        let by = |shift, method| {
            fit(&sample, shift, method).ok().map(|f| f.distribution)
        };
        let (usfl, ssfl) = (by(0.0, MLE), by(shift, MLE));
        let trimmed = by(0.0, trimmed());
        Self { sample, shift, usfl, ssfl, trimmed }
    }

    /// Eqs. 5 and 7 applied to a fit of this sample; `None` if they are not
    /// defined.
    pub(crate) fn usfl7(
        &self,
        usfl: Option<Lognormal>,
        c: f64,
    ) -> Option<Lognormal> {
        transform(&usfl?, self.shift, c).ok()
    }

    /// Largest difference of USFL7 to the SSFL in probability.
    pub(crate) fn to_ssfl(&self, usfl: Option<Lognormal>, c: f64) -> f64 {
        apart(self.usfl7(usfl, c), self.ssfl)
    }

    /// Largest distance of a fitted fragility to the empirical one; NaN without
    /// a fit.
    pub(crate) fn to_sample(&self, fitted: Option<Lognormal>) -> f64 {
        fitted.map_or(f64::NAN, |f| f.kolmogorov_distance(&self.sample))
    }
}

/// Largest difference of two fragilities in probability; NaN if one of them
/// does not exist. For different shifts it is the largest at 200 quantiles of
/// each, which miss the maximum by less than 1e-4 of it.
pub(crate) fn apart(a: Option<Lognormal>, b: Option<Lognormal>) -> f64 {
    let (Some(a), Some(b)) = (a, b) else { return f64::NAN };
    a.distance(&b).unwrap_or_else(|| {
        let of = |k: u32| (f64::from(k) + 0.5) / 200.0;
        let places =
            (0..200).flat_map(|k| [&a, &b].map(|f| f.quantile(of(k))));
        let at = |x: f64| (a.cdf(x) - b.cdf(x)).abs();
        places.map(at).fold(0.0, f64::max)
    })
}
