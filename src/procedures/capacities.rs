//! Capacities of a suite: the intensities at which its records bring a block
//! to an EDP level.

use super::ProcedureError;
use crate::capacity::{Capacity, InversionRule, ResponseCurve};
use crate::statistics::CensoredSample;

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
    let (mut values, mut limits) = (Vec::new(), Vec::new());
    for curve in curves {
        let capacity = curve.capacity(edp, rule)?;
        values.push(capacity.im());
        limits.push(match capacity {
            Capacity::Reached(_) => None,
            Capacity::Censored { above } => Some(above),
        });
    }
    Ok(CensoredSample::try_new(&values, &limits)?)
}
