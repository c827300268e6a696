//! Annual frequency of damage: the integral of a fragility over a hazard
//! curve.

use libm::{exp, log};
use thiserror::Error;

use super::total::TotalFragility;
use rocking::stop;
use rocking_statistics::{Lognormal, normal};

/// Least and largest intensity and annual frequency that a curve may have:
/// the ratio of any two of them is a finite number.
pub const RANGE: (f64, f64) = (1e-150, 1e150);

/// Why a hazard curve was rejected. Points are numbered from 1.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HazardError {
    /// Fewer than two points.
    #[error("{0} points: expected at least two")]
    Points(usize),
    /// An intensity that is not above the one before, or not positive.
    #[error(
        "intensity {found} of point {number}: expected a finite number above {before}"
    )]
    Intensity {
        /// The point.
        number: usize,
        /// Its intensity.
        found: f64,
        /// The intensity before, or 0.
        before: f64,
    },
    /// A frequency that is above the one before, or not positive.
    #[error(
        "annual frequency {found} of point {number}: expected a positive number of at most {before}"
    )]
    Frequency {
        /// The point.
        number: usize,
        /// Its annual frequency.
        found: f64,
        /// The frequency before, or infinity.
        before: f64,
    },
    /// A number that no hazard analysis gives, and whose ratio to another may
    /// not be finite.
    #[error(
        "{what} {found:e} of point {number}: expected a number from {:e} to {:e}",
        RANGE.0,
        RANGE.1
    )]
    Range {
        /// Intensity, or annual frequency.
        what: &'static str,
        /// The point.
        number: usize,
        /// The number.
        found: f64,
    },
}

/// A hazard curve H(x): how often a year intensity x is exceeded, by points
/// between which it is a power of x.
///
/// Intensities x in one unit, positive and rising; annual frequencies H in
/// 1/year, positive and not rising; all within [`RANGE`]. H is unknown outside
/// the points.
#[derive(Clone, Debug, PartialEq)]
pub struct HazardCurve {
    points: Vec<(f64, f64)>,
}

/// Mean annual frequency of damage, of one fragility and one hazard curve.
///
/// The hazard curve ends at its last point (intensity x_n, frequency H_n).
/// The frequency lies between two bounds of that truncation. They are no
/// confidence interval: neither the records nor the hazard are uncertain in
/// them.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct AnnualFrequency {
    /// Lower bound of truncation in 1/year: beyond x_n damage has the
    /// probability F(x_n) or more.
    pub truncation_lower: f64,
    /// Upper bound of truncation in 1/year: every motion beyond x_n does the
    /// damage. It lies (1 - F(x_n)) H_n above the lower one.
    pub truncation_upper: f64,
    /// 1/year, of that, what the points cover: the integral from the first
    /// to the last.
    pub covered: f64,
    /// F at the first intensity: if it is not 0, weaker motions add to the
    /// frequency by an amount that the curve does not give.
    pub first_probability: f64,
}

/// Annual frequency of damage by motions between two intensities.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Contribution {
    /// Lower intensity.
    pub from_im: f64,
    /// Upper intensity.
    pub to_im: f64,
    /// Annual frequency of damage in 1/year.
    pub annual_frequency: f64,
}

impl HazardCurve {
    /// A curve through points (intensity, annual frequency).
    ///
    /// ```
    /// use rocking_procedures::fragility::risk::HazardCurve;
    /// let hazard = HazardCurve::try_new(&[(0.1, 1e-2), (1.0, 1e-4)])?;
    /// assert!((hazard.frequency(0.5).unwrap() - 4e-4).abs() < 1e-18);
    /// assert_eq!(hazard.frequency(2.0), None);
    /// # Ok::<(), rocking_procedures::fragility::risk::HazardError>(())
    /// ```
    ///
    /// # Errors
    /// [`HazardError`] for fewer than two points, intensities that do not
    /// rise from above 0, frequencies that rise or are not positive, and
    /// numbers outside [`RANGE`].
    pub fn try_new(points: &[(f64, f64)]) -> Result<Self, HazardError> {
        if points.len() < 2 {
            return Err(HazardError::Points(points.len()));
        }
        let mut last = (0.0, f64::INFINITY);
        for (i, &(im, frequency)) in points.iter().enumerate() {
            let number = i + 1;
            if !(im > last.0 && im.is_finite()) {
                let (found, before) = (im, last.0);
                return Err(HazardError::Intensity { number, found, before });
            }
            let falls = frequency > 0.0 && frequency <= last.1;
            if !(falls && frequency.is_finite()) {
                let (found, before) = (frequency, last.1);
                return Err(HazardError::Frequency { number, found, before });
            }
            for (what, found) in
                [("intensity", im), ("annual frequency", frequency)]
            {
                if !(found >= RANGE.0 && found <= RANGE.1) {
                    return Err(HazardError::Range { what, number, found });
                }
            }
            last = (im, frequency);
        }
        Ok(Self { points: points.to_vec() })
    }

    /// The points (intensity, annual frequency in 1/year).
    pub fn points(&self) -> &[(f64, f64)] {
        &self.points
    }

    /// The first and the last point.
    pub(crate) fn ends(&self) -> ((f64, f64), (f64, f64)) {
        (self.points[0], self.points[self.points.len() - 1])
    }

    /// H(x) in 1/year, between the points H = H_i (x/x_i)^-k; `None`
    /// outside them.
    pub fn frequency(&self, im: f64) -> Option<f64> {
        let to = self.points.partition_point(|(x, _)| *x < im).max(1);
        let pair = self.points.get(to - 1..=to)?;
        if !(pair[0].0 <= im) {
            return None;
        }
        Some(Segment::between(pair).frequency(im))
    }

    /// Mean annual frequency of damage, the integral of F(x) |dH(x)|.
    ///
    /// `fragility` F in the unit of the curve's intensities x. Integrated by
    /// parts, F(x_1) H(x_1) - F(x_n) H(x_n) plus the integral of H dF from
    /// the first intensity x_1 to the last x_n, to about 1e-13 of the value.
    /// Without a shift the integral has a closed form on each segment; with
    /// one it is taken over z = (ln(x - r) - mu)/beta by Gauss and Legendre.
    /// For H = k0 x^-k and no shift the frequency is
    /// k0 m^-k exp(k^2 beta^2/2) with the median m. Of a total it is the mean
    /// over its parts, which have no shift.
    ///
    /// ```
    /// use rocking_procedures::fragility::risk::HazardCurve;
    /// use rocking_statistics::Lognormal;
    /// // H = 1e-4 x^-2, median 1, dispersion 0.5.
    /// let hazard = HazardCurve::try_new(&[(1e-6, 1e8), (1e6, 1e-16)])?;
    /// let fragility = Lognormal::try_new(0.0, 0.0, 0.5)?;
    /// let found = hazard.annual_frequency(fragility);
    /// let cornell = 1e-4 * 0.5f64.exp();
    /// assert!((found.truncation_lower / cornell - 1.0).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// Cornell, Jalayer, Hamburger and Foutch, Journal of Structural
    /// Engineering 128, 2002, Eqs. 6 and 12.
    pub fn annual_frequency(
        &self,
        fragility: impl Into<TotalFragility>,
    ) -> AnnualFrequency {
        let fragility = fragility.into().parts();
        let (first, last) = self.ends();
        let segments = self.segments();
        let nothing = normal::quantile(1e-18 * last.1 / first.1);
        let of = |law: &Lognormal| {
            // The frequency is at least H_n times the probability of damage
            // below x_n and the median; weaker motions add H_1 F at most.
            let end = segments.last().map_or(0.0, |own| own.scores(law).1);
            let least = (end.min(0.0) + nothing).max(-LAST_SCORE);
            let of = |own: &Segment| own.integral(law, least);
            segments.iter().map(of).sum()
        };
        let first_probability = fragility.cdf(first.0);
        let low = first_probability * first.1 + fragility.mean_of(of);
        AnnualFrequency {
            truncation_lower: low,
            truncation_upper: low + fragility.survival(last.0) * last.1,
            covered: low - fragility.cdf(last.0) * last.1,
            first_probability,
        }
    }

    fn segments(&self) -> Vec<Segment> {
        self.points.windows(2).map(Segment::between).collect()
    }

    /// The annual frequency by intensity (deaggregated): the integral of F(x)
    /// |dH(x)| from each point of the curve to the next one. Their sum is
    /// [`AnnualFrequency::covered`].
    ///
    /// ```
    /// use rocking_procedures::fragility::risk::HazardCurve;
    /// use rocking_statistics::Lognormal;
    /// let points = [(0.1, 1e-2), (0.4, 1e-3), (1.0, 1e-4)];
    /// let hazard = HazardCurve::try_new(&points)?;
    /// let fragility = Lognormal::try_new(0.15, -1.0, 0.5)?;
    /// let found = hazard.contributions(fragility);
    /// assert_eq!((found[1].from_im, found[1].to_im), (0.4, 1.0));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn contributions(
        &self,
        fragility: impl Into<TotalFragility>,
    ) -> Vec<Contribution> {
        let fragility = fragility.into().parts();
        let one = |own: &Segment| {
            let within = |(im, frequency)| fragility.cdf(im) * frequency;
            let ends = within(own.from) - within(own.to);
            Contribution {
                from_im: own.from.0,
                to_im: own.to.0,
                annual_frequency: ends
                    + fragility.mean_of(|law| own.integral(law, -LAST_SCORE)),
            }
        };
        self.segments().iter().map(one).collect()
    }
}

/// Part of a hazard curve between two points: ln H falls by k with ln x.
struct Segment {
    from: (f64, f64),
    to: (f64, f64),
    k: f64,
    /// Logarithms of its intensities.
    logs: (f64, f64),
}

/// Scores beyond which the normal density is nothing beside any frequency.
const LAST_SCORE: f64 = 38.0;

/// Score beyond which a segment adds less than 1e-18 of the frequency.
const CERTAIN: f64 = 9.0;

/// Fall of ln H with the score up to which the closed form keeps 13 digits.
const STEEPEST: f64 = 8.0;

/// Longest piece of the quadrature, in scores.
const PIECE: f64 = 0.25;

/// Largest fall of ln H over a piece; a segment that falls faster with the
/// score is cut into parts of this fall.
const FALL: f64 = 2.5;

/// Nodes and weights of Gauss and Legendre with 8 points on (-1, 1), the
/// positive ones (Abramowitz and Stegun, Table 25.4).
const NODES: [(f64, f64); 4] = [
    (0.183_434_642_495_649_8, 0.362_683_783_378_362),
    (0.525_532_409_916_329, 0.313_706_645_877_887_27),
    (0.796_666_477_413_626_7, 0.222_381_034_453_374_48),
    (0.960_289_856_497_536_3, 0.101_228_536_290_376_26),
];

impl Segment {
    fn between(pair: &[(f64, f64)]) -> Self {
        let (from, to) = (pair[0], pair[1]);
        let k = log(from.1 / to.1) / log(to.0 / from.0);
        Self { from, to, k, logs: (log(from.0), log(to.0)) }
    }

    fn frequency(&self, im: f64) -> f64 {
        self.from.1 * exp(-self.k * log(im / self.from.0))
    }

    /// Scores of its intensities.
    fn scores(&self, law: &Lognormal) -> (f64, f64) {
        let score = |x, log_x: f64| match law.shift() {
            0.0 => (log_x - law.log_mean()) / law.dispersion(),
            _ => law.score(x),
        };
        (score(self.from.0, self.logs.0), score(self.to.0, self.logs.1))
    }

    /// Integral of H dF over the segment from the score `least` on.
    fn integral(&self, fragility: &Lognormal, least: f64) -> f64 {
        stop::point();
        let (shift, beta) = (fragility.shift(), fragility.dispersion());
        let (from, to) = self.scores(fragility);
        let (from, to) = (from.max(least), to.min(CERTAIN));
        // Above the median H is below that of the median.
        if !(to > from) {
            return 0.0;
        }
        let drop = self.k * beta;
        if shift == 0.0 && drop <= STEEPEST {
            // Of H = H(m) exp(-drop z): the density about -drop.
            let (from, to) = (from + drop, to + drop);
            let off = fragility.log_mean() - self.logs.0;
            let factor = exp(0.5 * drop * drop - self.k * off);
            let inside = match from > 0.0 {
                true => normal::survival(from) - normal::survival(to),
                false => normal::cdf(to) - normal::cdf(from),
            };
            return self.from.1 * factor * inside;
        }
        if drop * PIECE <= FALL {
            return self.quadrature(fragility, (from, to));
        }
        // Within RANGE, ln H falls by 691 at most: 277 parts.
        let parts = (log(self.from.1 / self.to.1) / FALL).ceil();
        let (ratio, mut low) = (self.to.0 / self.from.0, self.from.0);
        let mut sum = 0.0;
        for part in 1..=parts as u32 {
            let share = f64::from(part) / parts;
            let high = (self.from.0 * exp(share * log(ratio))).min(self.to.0);
            let high = if share < 1.0 { high } else { self.to.0 };
            let from = fragility.score(low).max(from);
            let to = fragility.score(high).min(to);
            if to > from {
                sum += self.quadrature(fragility, (from, to));
            }
            low = high;
        }
        sum
    }

    /// Integral of H dF between two scores, by Gauss and Legendre: 188 pieces
    /// at most, from -[`LAST_SCORE`] to [`CERTAIN`].
    fn quadrature(
        &self,
        fragility: &Lognormal,
        (from, to): (f64, f64),
    ) -> f64 {
        let at = |z: f64| {
            // Rounding may lead beyond the ends of a steep segment.
            let frequency = self.frequency(fragility.at_score(z));
            frequency.clamp(self.to.1, self.from.1) * normal::pdf(z)
        };
        let pieces = ((to - from) / PIECE).ceil();
        let half = 0.5 * (to - from) / pieces;
        let piece = |k: u32| {
            let middle = from + half * (2.0 * f64::from(k) + 1.0);
            NODES.iter().fold(0.0, |sum, (node, weight)| {
                let step = half * node;
                sum + weight * (at(middle - step) + at(middle + step))
            })
        };
        half * (0..pieces as u32).fold(0.0, |sum, k| sum + piece(k))
    }
}

#[cfg(test)]
mod tests;
