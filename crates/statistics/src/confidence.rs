//! What the replicates of a measure say of it: its interval at any level, and
//! how far another set of draws would move the ends.

use libm::sqrt;

use super::{Clusters, Interval, Range, normal};

/// The replicates of one measure, in order: its intervals at all levels.
///
/// With the standard deviation of the replicates as unit, an end lies at the
/// percentile Phi(z0 + (z0 + w)/(1 - a (z0 + w))), where -w and w belong to
/// the two ends ([`Clusters::half_width`](super::Clusters::half_width)), z0 corrects the bias and a is the
/// acceleration (Efron, JASA 82 (1987) 171). A replicate without a value may
/// lie anywhere: it counts as the lowest at the low end and as the highest at
/// the high end.
///
/// ```
/// use rocking_statistics::clusters::Clusters;
/// use rocking_statistics::confidence::Confidence;
/// let replicates: Vec<f64> = (0..=1000).map(f64::from).collect();
/// let known = Confidence::new(500.0, &replicates, &[]).unwrap();
/// let half_width = Clusters::singletons(86).half_width(0.9);
/// let found = known.interval(half_width).unwrap();
/// assert!((found.interval.low() - 50.0).abs() < 1e-9);
/// assert!((found.interval.high() - 950.0).abs() < 1e-9);
/// // Of 1001 draws the 5 % point is known to sqrt(0.05 0.95/1001).
/// assert!((found.low_error - 6.9).abs() < 0.1);
/// ```
#[derive(Clone, Debug)]
pub struct Confidence {
    sorted: Vec<f64>,
    undefined: usize,
    bias: f64,
    acceleration: f64,
    accelerated: bool,
}

/// An interval, and the standard error of each end over sets of draws.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct MonteCarloInterval {
    /// The interval; an end beyond all replicates with a value is open.
    pub interval: Interval,
    /// Standard error of the low end over sets of draws.
    pub low_error: f64,
    /// Standard error of the high end over sets of draws.
    pub high_error: f64,
}

impl Confidence {
    /// From the measure itself, its replicates and its values without each
    /// record, or earthquake, in turn. Where `jackknife` is empty or holds a
    /// value that is not finite, and where all replicates lie on one side,
    /// the ends are plain percentiles: z0 = a = 0.
    ///
    /// None where the measure is not finite, or fewer than two replicates
    /// are.
    #[must_use]
    pub fn new(
        point: f64,
        replicates: &[f64],
        jackknife: &[f64],
    ) -> Option<Self> {
        let mut sorted: Vec<f64> =
            replicates.iter().copied().filter(|x| x.is_finite()).collect();
        if sorted.len() < 2 || !point.is_finite() {
            return None;
        }
        sorted.sort_by(f64::total_cmp);
        let undefined = replicates.len() - sorted.len();
        let below = sorted.partition_point(|x| *x < point);
        let up_to = sorted.partition_point(|x| *x <= point);
        let share = 0.5 * (below + up_to) as f64 / sorted.len() as f64;
        let bias = normal::quantile(share);
        let sum = jackknife.iter().fold(0.0, |sum, x| sum + x);
        let centre = sum / jackknife.len() as f64;
        let (square, cube) = jackknife.iter().fold((0.0, 0.0), |(s, c), x| {
            let d = centre - x;
            (f64::mul_add(d, d, s), f64::mul_add(d * d, d, c))
        });
        let acceleration = cube / (6.0 * square * sqrt(square));
        let accelerated = bias.is_finite() && acceleration.is_finite();
        let (bias, acceleration) =
            if accelerated { (bias, acceleration) } else { (0.0, 0.0) };
        Some(Self { sorted, undefined, bias, acceleration, accelerated })
    }

    /// Whether bias and acceleration are corrected.
    pub fn is_accelerated(&self) -> bool {
        self.accelerated
    }

    /// The interval whose half width is w standard deviations of the
    /// replicates; none for a width that is negative or NaN.
    #[must_use]
    pub fn interval(&self, half_width: f64) -> Option<MonteCarloInterval> {
        let (low, low_error) = self.end(-half_width);
        let (high, high_error) = self.end(half_width);
        let interval = Interval::try_new(low, high).ok()?;
        Some(MonteCarloInterval { interval, low_error, high_error })
    }

    /// The interval of a share of cells that lie in a region, whose value in
    /// the sample is `point`, at `level`: from the percentiles or the
    /// percentiles reflected at the point, whichever lie further out, within
    /// 0 and 1, for tails of half the error of `level`.
    ///
    /// Scatter carries cells across the ends of the region. That biases the
    /// share of a sample, and the share of a replicate twice as much, to the
    /// same side: there the percentile lies too far out, and on the other
    /// side the reflected one holds the level. The error is halved since the
    /// whole one is exceeded where the share lies on its limit: of 44 records
    /// of 16 earthquakes 11 % instead of 5 % (declared cases `share-refuted`).
    ///
    /// ```
    /// use rocking_statistics::clusters::Clusters;
    /// use rocking_statistics::confidence::Confidence;
    /// // 95 % of the cells inside, and in replicates 86 to 94 %.
    /// let replicates: Vec<f64> =
    ///     (0..=800).map(|i| 0.86 + 1e-4 * f64::from(i)).collect();
    /// let known = Confidence::new(0.95, &replicates, &[]).unwrap();
    /// let records = Clusters::singletons(86);
    /// let found = known.interval_of_share(0.95, &records, 0.9).unwrap();
    /// assert!((found.interval.low() - 0.862).abs() < 1e-3);
    /// assert_eq!(found.interval.high(), 1.0);
    /// ```
    #[must_use]
    pub fn interval_of_share(
        &self,
        point: f64,
        clusters: &Clusters,
        level: f64,
    ) -> Option<MonteCarloInterval> {
        let plain = self.interval(clusters.half_width(0.5 + 0.5 * level))?;
        let (mut low, mut high) = plain.interval.ends();
        let (mut low_error, mut high_error) =
            (plain.low_error, plain.high_error);
        let reflected = plain.interval.map(|x| 2.0 * point - x);
        if reflected.low() < low {
            (low, low_error) = (reflected.low(), plain.high_error);
        }
        if reflected.high() > high {
            (high, high_error) = (reflected.high(), plain.low_error);
        }
        let interval = Interval::try_new(low, high).ok()?;
        let interval = interval.within(Range::Share);
        Some(MonteCarloInterval { interval, low_error, high_error })
    }

    /// The end that belongs to `w`, and its standard error: that of the
    /// percentile's own place, and that of z0, which is read off the same
    /// draws.
    fn end(&self, w: f64) -> (f64, f64) {
        let z = self.bias + w;
        let scale = f64::mul_add(-self.acceleration, z, 1.0);
        let score = if scale > 0.0 {
            self.bias + z / scale
        } else {
            f64::INFINITY.copysign(z)
        };
        let p = normal::cdf(score);
        let mut variance = p * (1.0 - p);
        if self.accelerated && score.is_finite() {
            let share = normal::cdf(self.bias);
            let slope = normal::pdf(score) / normal::pdf(self.bias)
                * (1.0 + 1.0 / (scale * scale));
            variance += slope * slope * share * (1.0 - share);
        }
        let count = self.sorted.len() + self.undefined;
        let error = sqrt(variance / count as f64);
        let at = |p: f64| self.at(p.clamp(0.0, 1.0), w < 0.0);
        (at(p), 0.5 * (at(p + error) - at(p - error)))
    }

    /// Quantile of type 7 of all replicates, those without a value lowest or
    /// highest.
    fn at(&self, p: f64, undefined_low: bool) -> f64 {
        let count = self.sorted.len() + self.undefined;
        let before = if undefined_low { self.undefined } else { 0 };
        let of = |rank: usize| {
            if rank < before {
                return f64::NEG_INFINITY;
            }
            let value = self.sorted.get(rank - before).copied();
            value.unwrap_or(f64::INFINITY)
        };
        let place = p * (count - 1) as f64;
        if place.is_nan() {
            return f64::NAN;
        }
        let rank = place.floor();
        let (weight, rank) = (place - rank, rank as usize);
        let low = of(rank);
        if weight == 0.0 || !low.is_finite() {
            return low;
        }
        let high = of(rank + 1);
        if high.is_finite() { low + weight * (high - low) } else { high }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bootstrap::Bootstrap;

    #[test]
    fn replicates_without_a_value_widen_both_ends() {
        let mut replicates: Vec<f64> = (0..1000).map(f64::from).collect();
        let half_width = Clusters::singletons(86).half_width(0.95);
        let of = |replicates: &[f64]| {
            let known = Confidence::new(500.0, replicates, &[]).unwrap();
            known.interval(half_width).unwrap().interval
        };
        let plain = of(&replicates);
        for x in &mut replicates[500..510] {
            *x = f64::NAN;
        }
        let wide = of(&replicates);
        assert!(wide.low() < plain.low() - 9.0);
        assert!(wide.high() > plain.high() + 9.0);
        for x in &mut replicates[500..530] {
            *x = f64::INFINITY;
        }
        let none = of(&replicates);
        assert_eq!(none.ends(), (f64::NEG_INFINITY, f64::INFINITY));
        assert!(Confidence::new(f64::NAN, &replicates, &[]).is_none());
    }

    /// Ends of 300 sets of draws scatter as the error of one says.
    #[test]
    fn the_error_of_an_end_is_its_scatter_over_sets_of_draws() {
        let n = 40;
        let values: Vec<f64> = (0..n).map(|i| (i * i) as f64).collect();
        let mean = |places: &[usize]| {
            places.iter().fold(0.0, |sum, i| sum + values[*i])
                / places.len() as f64
        };
        let all: Vec<usize> = (0..n).collect();
        let without: Vec<f64> = all
            .iter()
            .map(|i| {
                let others: Vec<usize> =
                    all.iter().copied().filter(|j| j != i).collect();
                mean(&others)
            })
            .collect();
        let half_width = Clusters::singletons(n).half_width(0.95);
        let sets = 300;
        let found: Vec<MonteCarloInterval> = (0..sets)
            .map(|set| {
                let draws = Bootstrap::new("ends", set, n, 500);
                let replicates = draws.map(mean);
                Confidence::new(mean(&all), &replicates, &without)
                    .unwrap()
                    .interval(half_width)
                    .unwrap()
            })
            .collect();
        for of in [
            |e: &MonteCarloInterval| (e.interval.low(), e.low_error),
            |e: &MonteCarloInterval| (e.interval.high(), e.high_error),
        ] {
            let count = sets as f64;
            let ends = || found.iter().map(|e| of(e).0);
            let centre = ends().sum::<f64>() / count;
            let square: f64 =
                ends().map(|x| (x - centre) * (x - centre)).sum();
            let scatter = sqrt(square / (count - 1.0));
            let said = found.iter().map(|e| of(e).1).sum::<f64>() / count;
            // A deviation of 300 values is known to 4 %; the two parts of
            // the error are taken as independent, which is a little large.
            assert!(
                (0.9..1.3).contains(&(said / scatter)),
                "{said} {scatter}"
            );
        }
    }
}
