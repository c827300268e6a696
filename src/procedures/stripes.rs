//! Responses of a suite at given intensities.

use super::ProcedureError;
use crate::capacity::ResponseCurve;
use crate::statistics::lognormal::Stripe;
use crate::statistics::{ExtendedSample, QuantileType};

/// The responses at one intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct StripeResponses {
    /// The intensity, in the unit of the curves.
    pub intensity: f64,
    /// Records that were run so far.
    pub n: usize,
    /// 16 % quantile of the EDP; infinite where overturned.
    pub edp16: f64,
    /// Median of the EDP.
    pub edp50: f64,
    /// 84 % quantile of the EDP.
    pub edp84: f64,
    /// Records that overturn.
    pub overturned: usize,
    /// Records that were not run so far; they are left out.
    pub open: usize,
    /// Records at or above the EDP level asked for.
    pub exceeded: Option<usize>,
}

impl StripeResponses {
    /// The counts of a fit; none where no EDP level was asked for.
    #[must_use]
    pub fn counts(&self) -> Option<Stripe> {
        let exceeded = u32::try_from(self.exceeded?).ok()?;
        let n = u32::try_from(self.n).ok()?;
        Some(Stripe { im: self.intensity, exceeded, n })
    }
}

/// Reads all curves at given intensities, each linear between its analyses
/// and infinite from the first overturning on.
///
/// `edp` is the level (peak |theta|/alpha, infinite for overturning) whose
/// exceedances are counted.
///
/// # Errors
/// [`ProcedureError::NotRun`] for an intensity up to which no record was run,
/// [`ProcedureError::EdpLevel`] for a level that is no positive number.
pub fn stripes(
    curves: &[ResponseCurve],
    intensities: &[f64],
    edp: Option<f64>,
) -> Result<Vec<StripeResponses>, ProcedureError> {
    if let Some(level) = edp.filter(|edp| !(*edp > 0.0)) {
        return Err(ProcedureError::EdpLevel(level));
    }
    let stripe = |&im: &f64| {
        let known: Vec<f64> =
            curves.iter().filter_map(|curve| curve.edp_at(im)).collect();
        let sample = ExtendedSample::try_new(&known)
            .map_err(|_| ProcedureError::NotRun(im))?;
        let quantile = |p| {
            let value = QuantileType::default().of_extended(&sample, p);
            value.unwrap_or(f64::NAN)
        };
        let exceeded =
            |level: f64| known.iter().filter(|edp| **edp >= level).count();
        Ok(StripeResponses {
            intensity: im,
            n: known.len(),
            edp16: quantile(0.16),
            edp50: quantile(0.5),
            edp84: quantile(0.84),
            overturned: sample.censored(),
            open: curves.len() - known.len(),
            exceeded: edp.map(exceeded),
        })
    };
    intensities.iter().map(stripe).collect()
}
