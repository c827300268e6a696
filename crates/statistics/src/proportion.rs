//! A probability from a count, with its exact interval.

use thiserror::Error;

use crate::beta::{quantile, student_quantile};
use crate::clusters::Clusters;
use crate::{Interval, Range, normal};

/// Why a count or a level was rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProportionError {
    /// More successes than trials, or no trial.
    #[error(
        "{successes} of {trials}: expected at most all of at least one trial"
    )]
    Count {
        /// Number of successes.
        successes: usize,
        /// Number of trials.
        trials: usize,
    },
    /// A level that is not between 0 and 1.
    #[error("level {0}: expected a number between 0 and 1")]
    Level(f64),
}

/// Number of successes in trials with one probability.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Proportion {
    successes: usize,
    trials: usize,
    /// For trials that are not independent.
    design: Option<DesignEffect>,
}

/// Effect of clusters on trials.
#[derive(Clone, Copy, Debug, PartialEq)]
struct DesignEffect {
    /// Number of trials that count as much as one independent trial.
    effect: f64,
    /// Degrees of freedom; NaN of a single cluster.
    freedom: f64,
}

impl Proportion {
    /// k `successes` in n independent `trials`.
    ///
    /// # Errors
    /// [`ProportionError::Count`] for k > n, and for n = 0.
    pub fn try_new(
        successes: usize,
        trials: usize,
    ) -> Result<Self, ProportionError> {
        if trials == 0 || successes > trials {
            return Err(ProportionError::Count { successes, trials });
        }
        Ok(Self { successes, trials, design: None })
    }

    /// The trials that are `held`, of records of these clusters: those of one
    /// cluster are not independent.
    ///
    /// The design effect D is the variance of k/n over clusters, G/(G - 1)
    /// sum_g (k_g - n_g k/n)^2/n^2, over that of independent trials, k/n (1 -
    /// k/n)/n; at least 1, and 1 if none or all of the trials succeed.
    ///
    /// ```
    /// use rocking_statistics::{Clusters, Proportion};
    /// let earthquakes = Clusters::from_labels(["a", "a", "b", "b", "c", "d"]);
    /// let held = [true, true, false, false, true, false];
    /// let found = Proportion::of_clusters(&held, &earthquakes)?;
    /// let alone = Proportion::try_new(3, 6)?;
    /// let [wide, narrow] = [found.interval(0.9)?, alone.interval(0.9)?];
    /// assert!(wide.low() < narrow.low() && wide.high() > narrow.high());
    /// # Ok::<(), rocking_statistics::proportion::ProportionError>(())
    /// ```
    ///
    /// # Errors
    /// [`ProportionError::Count`] for no trials, and for another number of
    /// trials than of records.
    pub fn of_clusters(
        held: &[bool],
        clusters: &Clusters,
    ) -> Result<Self, ProportionError> {
        let successes = held.iter().filter(|held| **held).count();
        let trials = clusters.records();
        let found = Self::try_new(successes, trials)?;
        if held.len() != trials {
            return Err(ProportionError::Count { successes, trials });
        }
        if clusters.is_singletons() {
            return Ok(found);
        }
        let share = found.share();
        let (n, count) = (found.trials as f64, clusters.count() as f64);
        let square = (0..clusters.count()).fold(0.0, |sum, cluster| {
            let away = clusters.members(cluster).iter().fold(0.0, |sum, i| {
                sum + f64::from(u8::from(held[*i])) - share
            });
            f64::mul_add(away, away, sum)
        });
        let variance = count / (count - 1.0) * square;
        let effect = variance / (n * share * (1.0 - share));
        // Also if nothing varies, and for a single cluster.
        let effect = if effect > 1.0 { effect } else { 1.0 };
        let freedom = clusters.degrees_of_freedom();
        Ok(Self { design: Some(DesignEffect { effect, freedom }), ..found })
    }

    /// Number of trials n.
    pub fn trials(self) -> usize {
        self.trials
    }

    /// k/n, from 0 to 1.
    pub fn share(self) -> f64 {
        self.successes as f64 / self.trials as f64
    }

    /// The exact interval of the probability (Clopper and Pearson).
    ///
    /// With a = (1 - level)/2 the low end p has P(B >= k) = a, the high end
    /// P(B <= k) = a, B binomial (n, p); 0 of n has the low end 0 and the
    /// high end 1 - a^(1/n), n of n the low end a^(1/n) and the high end 1.
    /// Whatever the probability is, the interval holds it with probability
    /// `level` or more. `level` lies between 0 and 1.
    ///
    /// ```
    /// use rocking_statistics::Proportion;
    /// // None of 44: the probability may still be 8 %.
    /// let found = Proportion::try_new(0, 44)?.interval(0.95)?;
    /// assert_eq!(found.low(), 0.0);
    /// assert!((found.high() - 0.080_42).abs() < 1e-5);
    /// # Ok::<(), rocking_statistics::proportion::ProportionError>(())
    /// ```
    ///
    /// Of clusters n is n/D (z/t)^2, at most the number of trials, and k that
    /// times the share: D the design effect, z the normal quantile and t
    /// Student's at the level, with [`Clusters::degrees_of_freedom`]. From 0
    /// to 1 of a single cluster.
    ///
    /// Clopper and Pearson, Biometrika 26 (1934) 404; Korn and Graubard,
    /// Survey Methodology 24 (1998) 193.
    ///
    /// # Errors
    /// [`ProportionError::Level`] for another level.
    pub fn interval(self, level: f64) -> Result<Interval, ProportionError> {
        checked(level)?;
        let mut n = self.trials as f64;
        if let Some(DesignEffect { effect, freedom }) = self.design {
            let z = normal::quantile(0.5 + 0.5 * level);
            let Some(t) = student_quantile(freedom, level) else {
                return Ok(Range::Share.interval());
            };
            let ratio = z / t;
            n = (n / effect * ratio * ratio).min(n);
        }
        let k = self.share() * n;
        let tail = 0.5 * (1.0 - level);
        let low = match self.successes {
            0 => 0.0,
            _ => quantile(k, n - k + 1.0, tail),
        };
        let high = match self.trials - self.successes {
            0 => 1.0,
            _ => quantile(k + 1.0, n - k, 1.0 - tail),
        };
        // Quantiles of the two tails, the lower one of the smaller law.
        Ok(Interval::rising(low, high))
    }

    /// Exact intervals of several probabilities that contain all of them at
    /// once with probability `level` or more, however they depend on each
    /// other: each of the m intervals has the level 1 - (1 - level)/m
    /// (Bonferroni).
    ///
    /// ```
    /// use rocking_statistics::Proportion;
    /// let one = Proportion::try_new(19, 86)?;
    /// let band = Proportion::band(&[one; 240], 0.95)?;
    /// let (low, high) = band[0].ends();
    /// assert!((low - 0.0857).abs() < 1e-4 && (high - 0.4172).abs() < 1e-4);
    /// # Ok::<(), rocking_statistics::proportion::ProportionError>(())
    /// ```
    ///
    /// # Errors
    /// [`ProportionError::Level`] for a level that is not between 0 and 1.
    pub fn band(
        all: &[Self],
        level: f64,
    ) -> Result<Vec<Interval>, ProportionError> {
        checked(level)?;
        let each = 1.0 - (1.0 - level) / all.len() as f64;
        all.iter().map(|one| one.interval(each)).collect()
    }
}

fn checked(level: f64) -> Result<(), ProportionError> {
    let inside = level > 0.0 && level < 1.0;
    inside.then_some(()).ok_or(ProportionError::Level(level))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ends_are_those_of_the_closed_form_where_there_is_one() {
        // 0 of n: 1 - a^(1/n); n of n: a^(1/n).
        for (n, level) in [(1, 0.5), (20, 0.95), (86, 0.95), (44, 0.9998)] {
            let a = 0.5 * (1.0 - level);
            let end = libm::pow(a, 1.0 / n as f64);
            let none = Proportion::try_new(0, n).unwrap();
            let (low, high) = none.interval(level).unwrap().ends();
            assert!(low == 0.0 && (high - (1.0 - end)).abs() < 1e-10);
            let all = Proportion::try_new(n, n).unwrap();
            let (low, high) = all.interval(level).unwrap().ends();
            assert!((low - end).abs() < 1e-10 && high == 1.0);
        }
    }

    #[test]
    fn nothing_in_a_few_trials_is_no_certainty() {
        let of = |k, n| Proportion::try_new(k, n).unwrap();
        for n in [10, 44, 86, 1000] {
            let high = of(0, n).interval(0.95).unwrap().high();
            assert!(high > 0.0 && high > 3.0 / n as f64, "{n}: {high}");
        }
        // Of more cells at once each end lies further away.
        let alone = of(0, 86).interval(0.95).unwrap().high();
        let band = Proportion::band(&[of(0, 86); 240], 0.95).unwrap();
        assert!(band.iter().all(|one| one.high() > 2.0 * alone));
    }

    #[test]
    fn counts_and_levels_out_of_range_are_refused() {
        for (successes, trials) in [(0, 0), (2, 1)] {
            let refused = ProportionError::Count { successes, trials };
            assert_eq!(Proportion::try_new(successes, trials), Err(refused));
        }
        let one = Proportion::try_new(1, 2).unwrap();
        for level in [0.0, 1.0, -1.0, 2.0, f64::NAN] {
            let found = one.interval(level).unwrap_err();
            assert!(matches!(found, ProportionError::Level(_)), "{level}");
            let found = Proportion::band(&[one; 3], level).unwrap_err();
            assert!(matches!(found, ProportionError::Level(_)), "{level}");
        }
    }
}
