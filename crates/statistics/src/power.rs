//! What a design is able to decide: the probability that the interval of a
//! sample like the one at hand lies on one side of a limit, and how large a
//! sample must be for it.

use libm::{exp, log, sqrt};
use statrs::distribution::{Binomial, Discrete as _};

use super::Proportion;

/// Probability that a design is asked for.
const WANTED: f64 = 0.8;

/// Largest multiple of the sample that is looked at.
const MOST: f64 = 100.0;

/// What a design is able to decide.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Power {
    /// Probability, from 0 to 1, that a sample like this one decides.
    pub probability: f64,
    /// How many times as large a sample decides in 80 %, from 1; infinite
    /// where 100 times does not.
    pub times: f64,
}

impl Power {
    /// Of a measure with the interval from `low` to `high` about `point`,
    /// where the truth is `point`. `deviations` are those of samples of this
    /// size from the truth, and `decides` says whether an interval decides.
    ///
    /// A sample m times as large has the measure point + d/sqrt(m), with d
    /// one of the deviations, and the ends point + (d + (low -
    /// point)/student)/sqrt(m), likewise the high one. `student` is Student's
    /// t over the normal quantile, by which few clusters widen an interval
    /// ([`Clusters::student_over_normal`](super::Clusters)): that widening
    /// answers the scatter of widths from sample to sample, which is left out
    /// here. `probability` is the share of the deviations whose ends decide
    /// for m = 1, `times` the least m at which that share is 80 %.
    ///
    /// Of a normal measure of standard error s at the distance e from its
    /// limit, at the one-sided error a, the share is Phi(e/s - z(1 - a)) and
    /// m is ((z(1 - a) + z(0.8)) s/e)^2. Where the interval holds the limit,
    /// the share is below one half whatever the design is (Hoenig and
    /// Heisey, American Statistician 55 (2001) 19): `times` says more.
    ///
    /// ```
    /// use rocking_statistics::normal::quantile;
    /// use rocking_statistics::power::Power;
    /// // Standard error 1, limit at 1, one-sided limits of 5 %.
    /// let normal: Vec<f64> =
    ///     (1..1000).map(|i| quantile(1e-3 * f64::from(i))).collect();
    /// let found = Power::of_measure((0.0, -1.645, 1.645), 1.0, &normal, |_, high| {
    ///     high < 1.0
    /// });
    /// assert!((found.probability - 0.26).abs() < 0.002);
    /// assert!((found.times - 2.486_f64.powi(2)).abs() < 0.05);
    /// ```
    #[must_use]
    pub fn of_measure(
        (point, low, high): (f64, f64, f64),
        student: f64,
        deviations: &[f64],
        decides: impl Fn(f64, f64) -> bool,
    ) -> Self {
        let share = |times: f64| {
            let root = sqrt(times);
            let at = |d: f64, end: f64| {
                point + (d + (end - point) / student) / root
            };
            let holds = |d: &&f64| decides(at(**d, low), at(**d, high));
            deviations.iter().filter(holds).count() as f64
                / deviations.len() as f64
        };
        Self { probability: share(1.0), times: least(share) }
    }

    /// Of a count with its exact interval at `level`, where the probability
    /// is the share that was counted: over all counts of a binomial law.
    /// Trials are the unit, and the number of them is rounded.
    ///
    /// ```
    /// use rocking_statistics::Proportion;
    /// use rocking_statistics::power::Power;
    /// // 0 of 44 does not show that a probability is below 5 %; 0 of 59
    /// // does, since 0.95^59 is 4.8 %.
    /// let none = Proportion::try_new(0, 44)?;
    /// let found = Power::of_count(none, 0.9, |_, high| high < 0.05);
    /// assert_eq!(found.probability, 0.0);
    /// assert!((found.times - 59.0 / 44.0).abs() < 0.02);
    /// # Ok::<(), rocking_statistics::proportion::ProportionError>(())
    /// ```
    #[must_use]
    pub fn of_count(
        count: Proportion,
        level: f64,
        decides: impl Fn(f64, f64) -> bool,
    ) -> Self {
        let p = count.share();
        let share = |times: f64| {
            let n = (count.trials() as f64 * times).round();
            let mean = n * p;
            // Six standard deviations: what lies beyond is 1e-9 at most.
            let wide = 6.0 * sqrt(mean * (1.0 - p)) + 6.0;
            let (first, last) = ((mean - wide).max(0.0), mean + wide);
            let Ok(law) = Binomial::new(p, n as u64) else { return f64::NAN };
            (first as u64..=(last.min(n) as u64))
                .filter(|k| {
                    let drawn = Proportion::try_new(*k as usize, n as usize);
                    let ends = drawn.and_then(|drawn| drawn.interval(level));
                    ends.is_ok_and(|ends| decides(ends.low(), ends.high()))
                })
                .fold(0.0, |sum, k| sum + law.pmf(k))
        };
        Self { probability: share(1.0), times: least(share) }
    }
}

/// The least multiple whose share is [`WANTED`], to 1 %.
fn least(share: impl Fn(f64) -> f64) -> f64 {
    let enough = |times: f64| share(times) >= WANTED;
    if !enough(MOST) {
        return f64::INFINITY;
    }
    let (mut low, mut high) = (0.0, log(MOST));
    while high - low > 0.005 {
        let middle = 0.5 * (low + high);
        if enough(exp(middle)) { high = middle } else { low = middle }
    }
    exp(high)
}
