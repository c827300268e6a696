//! Paired ratios of demands at equal dimensionless intensity.

/// Demands of two blocks, record by record, at one level.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Paired {
    /// The well-defined ratios, compared over reference, with the position
    /// of their record.
    pub ratios: Vec<(usize, f64)>,
    /// Number of records.
    pub records: usize,
    /// Records in which the compared block alone overturned.
    pub only_compared: usize,
    /// Records in which the reference alone overturned.
    pub only_reference: usize,
    /// Records in which both overturned.
    pub both: usize,
    /// Records in which the reference did not move.
    pub unmoved: usize,
}

impl Paired {
    /// Pairs demands by record; overturned is infinite.
    #[must_use]
    pub fn new(compared: &[f64], reference: &[f64]) -> Self {
        let mut paired = Self { records: reference.len(), ..Self::default() };
        for (i, (a, b)) in compared.iter().zip(reference).enumerate() {
            match (a.is_finite(), b.is_finite()) {
                (false, false) => paired.both += 1,
                (false, true) => paired.only_compared += 1,
                (true, false) => paired.only_reference += 1,
                (true, true) if *b > 0.0 => paired.ratios.push((i, a / b)),
                (true, true) => paired.unmoved += 1,
            }
        }
        paired
    }

    /// The ratios alone.
    #[must_use]
    pub fn values(&self) -> Vec<f64> {
        self.ratios.iter().map(|(_, r)| *r).collect()
    }

    /// Share of the records with a well-defined ratio, 0 to 1.
    #[must_use]
    pub fn usable_share(&self) -> f64 {
        self.ratios.len() as f64 / self.records as f64
    }
}

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
    fn every_record_is_counted_once() {
        let inf = f64::INFINITY;
        let paired = Paired::new(
            &[0.2, inf, 0.3, inf, 0.0, 0.5],
            &[0.1, 0.2, inf, inf, 0.0, 0.5],
        );
        assert_eq!(paired.ratios, [(0, 2.0), (5, 1.0)]);
        assert_eq!(paired.only_compared, 1);
        assert_eq!(paired.only_reference, 1);
        assert_eq!((paired.both, paired.unmoved), (1, 1));
        assert_eq!(paired.usable_share(), 2.0 / 6.0);
    }

    #[test]
    fn what_overturned_below_does_not_stand_again() {
        assert_eq!(on_stripe(1.5, Some(1.6), 0.4), 0.4);
        assert_eq!(on_stripe(1.6, Some(1.6), 0.4), f64::INFINITY);
        assert_eq!(on_stripe(2.0, Some(1.6), 0.4), f64::INFINITY);
        assert_eq!(on_stripe(2.0, None, 0.4), 0.4);
    }
}
