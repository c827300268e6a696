//! Capacities of a suite: the intensities at which its records bring a block
//! to an EDP level.

use super::ProcedureError;
use crate::inversion::inversion_discrepancy;
use rocking::capacity::{Capacity, InversionRule, ResponseCurve};
use rocking_statistics::{CensoredSample, ExtendedSample};

/// The capacities of all curves at one EDP level (peak |theta|/alpha,
/// infinite for overturning), in the order of the curves and the intensity
/// of the curves; a record that does not reach the level is censored at the
/// intensity up to which it was run.
///
/// # Errors
/// [`ProcedureError::Capacity`] for a level that is no positive number,
/// [`ProcedureError::Sample`] for no curve.
pub fn sample(
    curves: &[ResponseCurve],
    edp: f64,
    rule: InversionRule,
) -> Result<CensoredSample, ProcedureError> {
    Ok(CensoredSample::from_intervals(&intervals(curves, edp, rule)?)?)
}

/// The capacities of all curves at one EDP level as intervals, which
/// [`rank`](super::rank) takes: (capacity, capacity), or (limit, infinity) if
/// a record does not reach the level.
///
/// # Errors
/// [`ProcedureError::Capacity`] for a level that is no positive number.
pub fn intervals(
    curves: &[ResponseCurve],
    edp: f64,
    rule: InversionRule,
) -> Result<Vec<(f64, f64)>, ProcedureError> {
    let interval = |curve: &ResponseCurve| {
        Ok(match curve.capacity(edp, rule)? {
            Capacity::Reached(im) => (im, im),
            Capacity::Censored { above } => (above, f64::INFINITY),
        })
    };
    curves.iter().map(interval).collect()
}

/// Capacities of a suite at one EDP level.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct LevelCapacities {
    /// The EDP level (peak |theta|/alpha).
    pub edp: f64,
    /// 16 % quantile of the capacities; infinite if censored.
    pub im16: f64,
    /// Median.
    pub im50: f64,
    /// 84 % quantile.
    pub im84: f64,
    /// Records that do not reach the level.
    pub censored: usize,
    /// Largest difference in probability to the fragility of stripes.
    pub stripe_discrepancy: f64,
}

/// Quantiles (type 5) of the capacities at EDP levels, in the intensity
/// measure into which `measured` converts the intensity of the curves.
///
/// # Errors
/// As [`sample`].
pub fn levels(
    curves: &[ResponseCurve],
    levels: &[f64],
    rule: InversionRule,
    measured: impl Fn(f64) -> f64,
) -> Result<Vec<LevelCapacities>, ProcedureError> {
    let level = |&edp: &f64| {
        let ims = sample(curves, edp, rule)?;
        let ims = ims.values().iter().map(|im| measured(*im));
        let ims = ExtendedSample::try_new(&ims.collect::<Vec<f64>>())?;
        Ok(LevelCapacities {
            edp,
            im16: ims.quantile(0.16),
            im50: ims.quantile(0.5),
            im84: ims.quantile(0.84),
            censored: ims.censored(),
            stripe_discrepancy: inversion_discrepancy(curves, edp, rule)?,
        })
    };
    levels.iter().map(level).collect()
}

/// All crossings of one EDP level by one curve, and the capacities derived
/// from them.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct LevelCrossings {
    /// The EDP level (peak |theta|/alpha).
    pub edp: f64,
    /// The median crossing; infinite if censored.
    pub median: f64,
    /// The first crossing.
    pub first: f64,
    /// The last crossing.
    pub last: f64,
    /// The length of intensity below the level.
    pub monotone: f64,
    /// The crossings, ascending.
    pub crossings: Vec<f64>,
}

/// The crossings of EDP levels by one curve, in the intensity measure into
/// which `measured` converts the intensity of the curve.
///
/// # Errors
/// [`ProcedureError::Capacity`] for a level that is no positive number.
pub fn crossings(
    curve: &ResponseCurve,
    levels: &[f64],
    measured: impl Fn(f64) -> f64,
) -> Result<Vec<LevelCrossings>, ProcedureError> {
    let level = |&edp: &f64| {
        let found = curve.crossings(edp)?;
        let by = |rule| measured(found.capacity(rule).im());
        Ok(LevelCrossings {
            edp,
            median: by(InversionRule::Median),
            first: by(InversionRule::First),
            last: by(InversionRule::Last),
            monotone: by(InversionRule::Monotone),
            crossings: found.all().iter().map(|im| measured(*im)).collect(),
        })
    };
    levels.iter().map(level).collect()
}
