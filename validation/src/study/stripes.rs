//! Demands at equal dimensionless intensity.

/// Demand of a record on a stripe: infinite once the scan along rising
/// intensity overturned at or below the level, whatever a run there gives.
#[must_use]
pub fn on_stripe(level: f64, overturning: Option<f64>, run: f64) -> f64 {
    match overturning {
        Some(first) if !(level < first) => f64::INFINITY,
        _ => run,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_overturned_below_does_not_stand_again() {
        assert_eq!(on_stripe(1.5, Some(1.6), 0.4), 0.4);
        assert_eq!(on_stripe(1.6, Some(1.6), 0.4), f64::INFINITY);
        assert_eq!(on_stripe(2.0, Some(1.6), 0.4), f64::INFINITY);
        assert_eq!(on_stripe(2.0, None, 0.4), 0.4);
    }
}
