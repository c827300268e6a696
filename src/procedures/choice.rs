//! Which family of distributions fits a sample.

use super::{Draws, ProcedureError};
use crate::statistics::choice::{
    Candidate, Distribution, Goodness, Model, candidate, goodness,
};
use crate::statistics::lognormal::FitError;
use crate::statistics::{CensoredSample, ExtendedSample};

/// Families of distributions fitted to one sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Choice {
    /// Size of the sample.
    pub n: usize,
    /// Shift of the families that do not fit their own.
    pub shift_given: f64,
    /// Samples drawn from each fit for its p-values.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub draws: Draws,
    /// The families.
    pub families: Vec<Family>,
}

/// One family.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Family {
    /// The family.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::name"))]
    pub family: Model,
    /// Number of fitted parameters.
    pub parameters: usize,
    /// What was found, or why there is no fit.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::or_reason"))]
    pub fit: Result<FamilyFit, FitError>,
}

/// A fitted family.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FamilyFit {
    /// Akaike's criterion; a difference below 2 decides nothing.
    pub aic: f64,
    /// Its distance to the least of all families.
    pub delta_aic: f64,
    /// Schwarz's criterion.
    pub bic: f64,
    /// Log-likelihood.
    pub log_likelihood: f64,
    /// Kolmogorov's D.
    pub ks_distance: f64,
    /// P-value of D with the parameters fitted.
    pub ks_p: f64,
    /// Anderson and Darling's A2.
    pub a2: f64,
    /// P-value of A2 with the parameters fitted.
    pub a2_p: f64,
    /// Samples that could be fitted.
    pub used: usize,
    /// Shape; the dispersion of a lognormal.
    pub shape: f64,
    /// Scale; the median above the shift of a lognormal.
    pub scale: f64,
    /// Shift, or location of an extreme value distribution.
    pub location: f64,
}

/// Fits lognormal, shifted lognormal, Weibull, gamma and generalized extreme
/// value distributions by maximum likelihood, and compares them.
///
/// Lognormal, Weibull and gamma lie above `shift`; the others fit their own
/// place. P-values come from `draws.replicates` samples of each fit.
///
/// ```
/// use rocking::procedures::{Draws, choose};
/// use rocking::statistics::CensoredSample;
/// let values = [1.2, 1.5, 1.9, 2.4, 3.8, 5.0];
/// let sample = CensoredSample::try_new(&values, &[])?;
/// let found = choose(&sample, 0.0, Draws { replicates: 50, seed: 0 })?;
/// assert_eq!(found.families.len(), 5);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ProcedureError`] for a sample with censored values, or a number of draws
/// that is none.
pub fn choose(
    sample: &CensoredSample,
    shift: f64,
    draws: Draws,
) -> Result<Choice, ProcedureError> {
    draws.check()?;
    let (n, censored) = (sample.len(), sample.censored());
    if censored > 0 {
        return Err(FitError::Infinite { censored, n }.into());
    }
    let whole: ExtendedSample = sample.extended();
    let Draws { replicates, seed } = draws;
    let found = Model::ALL.map(|model| {
        let found = candidate(&whole, shift, model)?;
        let tested = goodness(&found, n, shift, replicates as u64, seed);
        Ok((found, tested))
    });
    let aic = found.iter().flatten().map(|(found, _)| found.aic);
    let best = aic.fold(f64::INFINITY, f64::min);
    let families = Model::ALL.into_iter().zip(found).map(|(family, row)| {
        let fit =
            row.map(|(found, tested)| FamilyFit::of(&found, tested, best));
        Family { family, parameters: family.parameters(), fit }
    });
    let families = families.collect();
    Ok(Choice { n, shift_given: shift, draws, families })
}

impl FamilyFit {
    fn of(found: &Candidate, tested: Goodness, best: f64) -> Self {
        let (shape, scale, location) = match found.distribution {
            Distribution::Lognormal(own) => {
                let above = own.median() - own.shift();
                (own.dispersion(), above, own.shift())
            }
            Distribution::Rival { fit, shift } => {
                (fit.shape, fit.scale, shift)
            }
            Distribution::ExtremeValue(own) => {
                (own.shape, own.scale, own.location)
            }
        };
        Self {
            aic: found.aic,
            delta_aic: found.aic - best,
            bic: found.bic,
            log_likelihood: found.log_likelihood,
            ks_distance: found.kolmogorov,
            ks_p: tested.kolmogorov_p,
            a2: found.anderson_darling,
            a2_p: tested.anderson_darling_p,
            used: tested.used,
            shape,
            scale,
            location,
        }
    }
}
