//! Capacities by the median point along the vertical.

use rayon::prelude::*;
use rocking::capacity::{InversionRule, ResponseCurve};

use super::StudyError;

/// Capacities of one curve at rising demand levels; infinite where the
/// level was never reached.
///
/// # Errors
/// [`StudyError`] for a level that is not positive.
pub fn at(
    curve: &ResponseCurve,
    levels: &[f64],
) -> Result<Vec<f64>, StudyError> {
    by_rule(curve, levels, InversionRule::Median)
}

/// Capacities of one curve by a rule.
///
/// # Errors
/// [`StudyError`] for a level that is not positive.
pub fn by_rule(
    curve: &ResponseCurve,
    levels: &[f64],
    rule: InversionRule,
) -> Result<Vec<f64>, StudyError> {
    levels.iter().map(|e| Ok(curve.capacity(*e, rule)?.im())).collect()
}

/// Samples by level: capacities of all records of a block.
///
/// # Errors
/// [`StudyError`] for a level that is not positive.
pub fn samples(
    curves: &[ResponseCurve],
    levels: &[f64],
) -> Result<Vec<Vec<f64>>, StudyError> {
    let by_record: Vec<Vec<f64>> = curves
        .par_iter()
        .map(|curve| at(curve, levels))
        .collect::<Result<_, _>>()?;
    let of = |k: usize| by_record.iter().map(|r| r[k]).collect();
    Ok((0..levels.len()).map(of).collect())
}

/// The same sample in another measure: each capacity times its record's
/// factor.
#[must_use]
pub fn scaled(sample: &[f64], factors: &[f64]) -> Vec<f64> {
    sample.iter().zip(factors).map(|(x, f)| x * f).collect()
}
