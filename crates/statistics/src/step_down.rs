//! Which of many hypotheses fail, all of them at once: by the largest
//! deviation of their estimates over resampled samples.

use rayon::prelude::*;

use libm::sqrt;

/// Which of many hypotheses fail with a family-wise error.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct StepDown {
    /// Whether each hypothesis fails.
    pub rejected: Vec<bool>,
    /// The critical value that each was compared with: that of the step at
    /// which it failed, or of the last step.
    pub critical: Vec<f64>,
    /// Share of the replicates whose largest deviation reaches the largest
    /// statistic, less what the draws leave open: the smallest adjusted
    /// p-value.
    pub p: f64,
}

impl StepDown {
    /// Rejects the hypotheses whose `statistics` exceed the 1 - `error`
    /// quantile, over the replicates, of the largest of
    /// `deviation(replicate, hypothesis)`, and repeats that with those that
    /// are left until none fails (Romano and Wolf, Econometrica 73 (2005)
    /// 1237): at most `error` is the probability that any true hypothesis
    /// fails, whatever their dependence is. A statistic is an estimate's
    /// distance from its hypothesis over its standard error, a deviation
    /// that of a replicate from the estimate over the same.
    ///
    /// `caution` counts standard errors of the draws: `error` is taken that
    /// much smaller, and p that much larger (Wilson's limit). A deviation
    /// that is not a number counts as larger than any number.
    ///
    /// ```
    /// use rocking_statistics::step_down::StepDown;
    /// // Two hypotheses with the same deviations, spread evenly to 2.
    /// let of = |replicate: usize, _| 0.02 * replicate as f64;
    /// let found = StepDown::new(&[1.95, 1.0], 100, of, 0.05, 0.0);
    /// assert_eq!(found.rejected, [true, false]);
    /// assert!((found.critical[0] - 1.88).abs() < 1e-12);
    /// ```
    #[must_use]
    pub fn new(
        statistics: &[f64],
        replicates: usize,
        deviation: impl Fn(usize, usize) -> f64 + Sync,
        error: f64,
        caution: f64,
    ) -> Self {
        let count = replicates as f64;
        let mut rejected = vec![false; statistics.len()];
        let mut critical = vec![f64::NAN; statistics.len()];
        let mut p = None;
        loop {
            let active: Vec<usize> =
                (0..rejected.len()).filter(|k| !rejected[*k]).collect();
            if active.is_empty() || replicates == 0 {
                break;
            }
            let most = |values: &mut dyn Iterator<Item = f64>| {
                values.fold(0.0, |most, x| if x > most { x } else { most })
            };
            let mut largest: Vec<f64> = (0..replicates)
                .into_par_iter()
                .panic_fuse()
                .map(|row| {
                    most(&mut active.iter().map(|k| {
                        let found = deviation(row, *k);
                        if found.is_nan() { f64::INFINITY } else { found }
                    }))
                })
                .collect();
            largest.sort_by(f64::total_cmp);
            let draws = sqrt(error * (1.0 - error) / count);
            let at = 1.0 - error + caution * draws;
            let place = (at * count).ceil() as usize;
            let limit = largest[place.clamp(1, replicates) - 1];
            if p.is_none() {
                let top = most(&mut active.iter().map(|k| statistics[*k]));
                let beyond = largest.partition_point(|x| *x < top);
                p = Some(upper(replicates - beyond, replicates, caution));
            }
            let mut more = false;
            for k in active {
                critical[k] = limit;
                rejected[k] = statistics[k] > limit;
                more |= rejected[k];
            }
            if !more {
                break;
            }
        }
        Self { rejected, critical, p: p.unwrap_or(1.0) }
    }
}

/// Wilson's upper limit of a share, so many standard errors above it; at
/// least one draw more than were found.
fn upper(found: usize, of: usize, errors: f64) -> f64 {
    let (n, square) = (of as f64, errors * errors);
    let share = found as f64 / n;
    let root = sqrt(share * (1.0 - share) / n + square / (4.0 * n * n));
    let limit =
        (share + square / (2.0 * n) + errors * root) / (1.0 + square / n);
    let counted = (found as f64 + 1.0) / (n + 1.0);
    if limit > counted { limit } else { counted }
}

#[cfg(test)]
mod tests {
    use super::StepDown;

    #[test]
    fn what_is_not_a_number_rejects_nothing() {
        let rejected = |share: f64, statistic: f64| {
            let of = |row: usize, _| {
                if (row as f64) < share * 100.0 { f64::NAN } else { 0.5 }
            };
            StepDown::new(&[statistic], 100, of, 0.05, 0.0).rejected[0]
        };
        assert!(rejected(0.0, 1.0) && rejected(0.05, 1.0));
        assert!(!rejected(0.06, 1.0) && !rejected(0.0, f64::NAN));
    }
}
