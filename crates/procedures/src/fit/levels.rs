//! Fits at the levels of an IDA, with individual dispersions or a common one.

use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::names::named;
use rocking_statistics::CensoredSample;
use rocking_statistics::lognormal::{FitError, FitMethod, LognormalFit};

use super::{FitOptions, FragilityFit, ProcedureError, fit_sample};
use crate::capacities;

named! {
    /// Dispersion of the fragilities of one block.
    pub enum DispersionRule: "dispersion" {
        /// Each level has its own dispersion.
        Own = "own",
        /// One dispersion for all levels, by maximum likelihood: above one
        /// shift their curves do not cross.
        Common = "common",
    }
}

impl DispersionRule {
    /// The [`FitOptions::family`] of each of these samples.
    pub fn family(self, samples: &[CensoredSample]) -> Vec<CensoredSample> {
        match self {
            Self::Own => Vec::new(),
            Self::Common => samples.to_vec(),
        }
    }
}

/// The fit of a sample above a shift, individually or together with its
/// family.
pub(super) fn law(
    sample: &CensoredSample,
    family: &[CensoredSample],
    shift: f64,
    method: FitMethod,
) -> Result<LognormalFit, FitError> {
    match family.iter().position(|own| own == sample) {
        None => sample.fit(shift, method),
        Some(k) => Ok(CensoredSample::fit_together(family, shift)?[k]),
    }
}

/// The values of each sample at these places.
pub(super) fn resampled(
    family: &[CensoredSample],
    places: &[usize],
) -> Vec<CensoredSample> {
    family.iter().map(|sample| sample.resample(places)).collect()
}

/// The fit of the capacities at one level.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct LevelFit {
    /// The EDP level (peak |theta|/alpha, infinite for overturning).
    pub edp: f64,
    /// Loss of log-likelihood against an individual dispersion; `None` for
    /// individual dispersions.
    pub dispersion_loss: Option<f64>,
    /// The fit.
    #[serde(flatten)]
    pub fit: FragilityFit,
}

/// Fits a fragility at each EDP level of an IDA, each with its own dispersion
/// or all with a common one.
///
/// A record that does not reach a level is censored at the intensity up to
/// which it was run. A bootstrap draws a record at all levels at once.
///
/// # Errors
/// [`ProcedureError`] as for [`fit_sample`], for a level that is not positive,
/// or a common dispersion with another method than maximum likelihood above a
/// known shift.
pub fn fit_levels(
    curves: &[ResponseCurve],
    levels: &[f64],
    rule: InversionRule,
    dispersion: DispersionRule,
    options: &FitOptions,
) -> Result<Vec<LevelFit>, ProcedureError> {
    let sample = |&edp: &f64| capacities::sample(curves, edp, rule);
    let samples = levels.iter().map(sample).collect::<Result<Vec<_>, _>>()?;
    let family = dispersion.family(&samples);
    let is_own = family.is_empty();
    let options = FitOptions { family, ..options.clone() };
    let fit = |(&edp, sample): (&f64, &CensoredSample)| {
        let fit = fit_sample(sample, &options)?;
        let own = || sample.fit(fit.fitted.shift(), fit.method);
        let own = (!is_own).then(own).transpose()?;
        let own = own.and_then(|own| own.log_likelihood);
        let both = own.zip(fit.log_likelihood);
        let dispersion_loss = both.map(|(own, here)| (own - here).max(0.0));
        Ok(LevelFit { edp, dispersion_loss, fit })
    };
    levels.iter().zip(&samples).map(fit).collect()
}
