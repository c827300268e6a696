//! Distance of the inversion of curves from their stripes.

use rocking::capacity::{CapacityError, InversionRule, ResponseCurve};

/// Distance of an inversion from the stripes at a level: the largest
/// difference, over intensities, between the share of curves whose capacity is
/// reached and the share that exceed the level there.
///
/// The latter, the stripe fragility, counts crossings upwards less crossings
/// downwards, and falls where curves turn back; the former cannot fall.
///
/// # Errors
/// [`CapacityError`] for a level that is not positive, or no curve.
pub fn inversion_discrepancy(
    curves: &[ResponseCurve],
    level: f64,
    rule: InversionRule,
) -> Result<f64, CapacityError> {
    if curves.is_empty() {
        return Err(CapacityError::Empty);
    }
    // Steps of (reached by capacity) - (exceeding on the stripe).
    let mut steps: Vec<(f64, i32)> = Vec::new();
    for curve in curves {
        let crossings = curve.crossings(level)?;
        steps.push((crossings.capacity(rule).im(), 1));
        for (k, im) in crossings.all().iter().enumerate() {
            steps.push((*im, if k % 2 == 0 { -1 } else { 1 }));
        }
    }
    steps.retain(|(im, _)| im.is_finite());
    steps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (mut difference, mut largest) = (0_i32, 0_u32);
    for equal in steps.chunk_by(|a, b| a.0 == b.0) {
        difference += equal.iter().map(|(_, step)| step).sum::<i32>();
        largest = largest.max(difference.unsigned_abs());
    }
    Ok(f64::from(largest) / curves.len() as f64)
}

#[cfg(test)]
mod tests;
