//! A fragility that includes the model error beside the scatter of the
//! records.

use libm::{exp, hypot, log};

use rocking_statistics::Lognormal;
use rocking_statistics::lognormal::LognormalError;
use rocking_statistics::normal::{self, pdf};
use rocking_statistics::search::{golden, zero};

/// Score beyond which a normal probability counts as 0 or 1.
const CERTAIN: f64 = 9.0;

/// How finely a total is computed.
#[derive(Debug, PartialEq)]
struct Fineness {
    /// Largest score of the records' law that enters.
    last_score: f64,
    /// Step of the trapezoidal rule over the model's share of the total
    /// dispersion. The integrand is analytic: the error is about
    /// exp(-2 (pi/step)^2).
    step: f64,
    /// Largest error of a quantile's score.
    score: f64,
}

/// Of every total but a draw: the rule errs by exp(-35), and the normal
/// probability beyond the last score is 1e-17.
const EXACT: Fineness = Fineness { last_score: 8.5, step: 0.75, score: 1e-14 };

/// Of a draw: the rule errs by exp(-20), the probability is 1e-12.
const DRAW: Fineness = Fineness { last_score: 7.0, step: 1.0, score: 1e-7 };

/// Smallest dispersion of the model but 0, and the largest one.
pub const MODEL_DISPERSION: (f64, f64) = (0.01, 1.0);

/// The distribution of real capacities C = b exp(s Z) c: c has the lognormal
/// distribution of the computed capacities of the records, above a shift r
/// c = r + exp(mu + beta Z1), b is the bias of the model, and s its
/// dispersion. Z and Z1 are standard normal and independent.
///
/// The error of the model acts on the whole capacity, not on its part above
/// the shift. Without a shift, or with s = 0, the total is lognormal: b times
/// the records' law, with dispersion sqrt(beta^2 + s^2). Else it is the mean
/// of lognormals of median b (r + exp(mu + beta z1)) and dispersion s over
/// z1, by the trapezoidal rule, to 1e-12 in probability.
///
/// ```
/// use rocking_procedures::fragility::total::TotalFragility;
/// use rocking_statistics::Lognormal;
/// let records = Lognormal::try_new(0.0, 0.0, 0.3)?;
/// let total = TotalFragility::try_new(records, 2.0, 0.4)?;
/// assert!((total.median() - 2.0).abs() < 1e-15);
/// let closed = total.closed().expect("no shift");
/// assert!((closed.dispersion() - 0.5).abs() < 1e-15);
/// // Above a shift some objects are damaged by less than the shift.
/// let records = Lognormal::try_new(1.0, 0.0, 0.3)?;
/// let total = TotalFragility::try_new(records, 1.0, 0.4)?;
/// assert!(records.cdf(1.0) == 0.0 && total.cdf(1.0) > 0.01);
/// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TotalFragility {
    records: Lognormal,
    bias: f64,
    dispersion: f64,
    /// Of b c.
    biased: Lognormal,
    closed: Option<Lognormal>,
    fineness: &'static Fineness,
}

/// A lognormal without a shift, one of those whose mean a total is.
struct Part {
    /// Density of its score.
    density: f64,
    /// Sum of the densities up to this one.
    sum: f64,
    log_median: f64,
}

/// A total with its parts, computed once for many intensities.
pub(crate) struct Parts {
    pub(super) total: TotalFragility,
    step: f64,
    /// None if the total is lognormal; the medians rise.
    parts: Vec<Part>,
}

impl From<Lognormal> for TotalFragility {
    /// A fragility without an error of the model.
    fn from(records: Lognormal) -> Self {
        let (biased, bias, dispersion) = (records, 1.0, 0.0);
        let (closed, fineness) = (Some(records), &EXACT);
        Self { records, bias, dispersion, biased, closed, fineness }
    }
}

impl TotalFragility {
    /// The total of the records' law, a bias b > 0, and a dispersion s of
    /// the model, 0 or as [`MODEL_DISPERSION`] says.
    ///
    /// # Errors
    /// [`LognormalError`] for another bias or dispersion.
    pub fn try_new(
        records: Lognormal,
        bias: f64,
        dispersion: f64,
    ) -> Result<Self, LognormalError> {
        let (least, most) = MODEL_DISPERSION;
        if !(dispersion == 0.0 || dispersion >= least && dispersion <= most) {
            return Err(LognormalError::Dispersion(dispersion));
        }
        let biased = records.scaled(bias)?;
        let both = hypot(biased.dispersion(), dispersion);
        let closed = match dispersion {
            0.0 => Some(biased),
            _ if biased.shift() > 0.0 => None,
            _ => Some(Lognormal::try_new(0.0, biased.log_mean(), both)?),
        };
        let fineness = &EXACT;
        Ok(Self { records, bias, dispersion, biased, closed, fineness })
    }

    /// The total in a draw, of which five digits are enough.
    ///
    /// From four standard deviations below the median to three above,
    /// probabilities and quantiles differ from the exact ones by at most 2e-6
    /// of their value, and so do annual frequencies.
    pub(crate) fn of_draw(exact: Self) -> Self {
        Self { fineness: &DRAW, ..exact }
    }

    /// The law of the records.
    pub fn records(&self) -> &Lognormal {
        &self.records
    }

    /// The bias b of the model.
    pub fn bias(&self) -> f64 {
        self.bias
    }

    /// The dispersion s of the model.
    pub fn model_dispersion(&self) -> f64 {
        self.dispersion
    }

    /// The total itself, if it is lognormal.
    pub fn closed(&self) -> Option<Lognormal> {
        self.closed
    }

    /// The total with its parts.
    pub(crate) fn parts(&self) -> Parts {
        let (own, s) = (&self.biased, self.dispersion);
        let step = self.fineness.step * s / hypot(own.dispersion(), s);
        let mut parts = Vec::new();
        if self.closed.is_none() {
            let last = (self.fineness.last_score / step).ceil() as i32;
            let mut sum = 0.0;
            for k in -last..=last {
                let z = step * f64::from(k);
                let (density, log_median) = (pdf(z), log(own.at_score(z)));
                sum += density;
                parts.push(Part { density, sum, log_median });
            }
        }
        Parts { total: *self, step, parts }
    }

    /// The distribution function, a fragility's value at intensity x.
    pub fn cdf(&self, x: f64) -> f64 {
        self.parts().cdf(x)
    }

    /// The survival function 1 - F(x).
    pub fn survival(&self, x: f64) -> f64 {
        self.parts().survival(x)
    }

    /// The normal score of F(x).
    pub fn score(&self, x: f64) -> f64 {
        self.parts().score(x)
    }

    /// The intensity of a normal score.
    pub fn at_score(&self, z: f64) -> f64 {
        self.parts().at_score(z)
    }

    /// The quantile at probability p in [0, 1]; NaN outside.
    pub fn quantile(&self, p: f64) -> f64 {
        self.parts().quantile(p)
    }

    /// The median.
    pub fn median(&self) -> f64 {
        let of = || self.quantile(0.5);
        self.closed.map_or_else(of, |law| law.median())
    }

    /// The distribution of `factor` times the intensity.
    ///
    /// # Errors
    /// [`LognormalError`] unless the factor is positive and finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, LognormalError> {
        let records = self.records.scaled(factor)?;
        let exact = Self::try_new(records, self.bias, self.dispersion)?;
        Ok(Self { fineness: self.fineness, ..exact })
    }
}

impl Parts {
    /// The mean of a function that is linear in the law. A part whose median
    /// is infinite adds nothing.
    pub(super) fn mean_of(&self, of: impl Fn(&Lognormal) -> f64) -> f64 {
        if let Some(law) = self.total.closed {
            return of(&law);
        }
        self.parts.iter().fold(0.0, |sum, one| {
            let s = self.total.dispersion;
            Lognormal::try_new(0.0, one.log_median, s).map_or(sum, |law| {
                f64::mul_add(self.step * one.density, of(&law), sum)
            })
        })
    }

    /// A function of the scores of the parts at x, the mean over them: of
    /// those whose score is at most [`CERTAIN`], and `far` for those before.
    fn mean(&self, x: f64, far: f64, of: impl Fn(f64) -> f64) -> f64 {
        let y = log(x);
        let score = |one: &Part| (y - one.log_median) / self.total.dispersion;
        let up_to =
            |least: f64| self.parts.partition_point(|one| score(one) > least);
        let (from, to) = (up_to(CERTAIN), up_to(-CERTAIN));
        let below = from.checked_sub(1).map_or(0.0, |k| self.parts[k].sum);
        let near = self.parts[from..to].iter();
        self.step
            * near.fold(far * below, |sum, one| {
                f64::mul_add(one.density, of(score(one)), sum)
            })
    }

    /// The distribution function.
    pub(crate) fn cdf(&self, x: f64) -> f64 {
        match self.total.closed {
            Some(law) => law.cdf(x),
            None if x > 0.0 => self.mean(x, 1.0, normal::cdf).min(1.0),
            None => 0.0,
        }
    }

    /// The survival function.
    pub(super) fn survival(&self, x: f64) -> f64 {
        self.total
            .closed
            .map_or_else(|| 1.0 - self.cdf(x), |law| law.survival(x))
    }

    fn score(&self, x: f64) -> f64 {
        let of = || normal::quantile(self.cdf(x));
        self.total.closed.map_or_else(of, |law| law.score(x))
    }

    /// The logarithm of the density.
    pub(super) fn ln_pdf(&self, x: f64) -> f64 {
        let s = self.total.dispersion;
        let of = || log(self.mean(x, 0.0, pdf) / (x * s));
        self.total.closed.map_or_else(of, |law| law.ln_pdf(x))
    }

    /// The intensity of a normal score.
    pub(super) fn at_score(&self, z: f64) -> f64 {
        let of = || self.quantile(normal::cdf(z));
        self.total.closed.map_or_else(of, |law| law.at_score(z))
    }

    fn quantile(&self, p: f64) -> f64 {
        if let Some(law) = self.total.closed {
            return law.quantile(p);
        }
        if !(p > 0.0 && p < 1.0) {
            return if p == 0.0 { 0.0 } else { normal::quantile(p) };
        }
        let total = &self.total;
        let place = |z: f64| {
            let unbiased = total.records.at_score(z);
            f64::mul_add(total.dispersion, z, log(total.bias * unbiased))
        };
        // P(Z <= a or Z1 <= a) is at most 2 P(Z <= a), and that of both is
        // its square. The score of F is almost linear between these ends.
        let wanted = normal::quantile(p);
        let score = |y: f64| self.score(exp(y)).clamp(-CERTAIN, CERTAIN);
        let off = |y: f64| score(y) - wanted;
        let end = |p: f64| {
            let y = place(normal::quantile(p));
            (y, off(y))
        };
        exp(zero(off, end(0.5 * p), end(p.sqrt()), total.fineness.score))
    }

    /// The score of the largest density.
    pub(super) fn mode_score(&self) -> f64 {
        let density = |z: f64| self.ln_pdf(self.at_score(z));
        let of = || golden(density, -8.0, 8.0);
        self.total.closed.map_or_else(of, |law| -law.dispersion())
    }
}

/// Written with its parts and its quantiles.
impl serde::Serialize for TotalFragility {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct as _;
        let mut all = to.serialize_struct("TotalFragility", 6)?;
        all.serialize_field("im16", &self.quantile(0.16))?;
        all.serialize_field("median", &self.median())?;
        all.serialize_field("im84", &self.quantile(0.84))?;
        all.serialize_field("model_bias", &self.bias)?;
        all.serialize_field("model_dispersion", &self.dispersion)?;
        all.serialize_field("records", &self.records)?;
        all.end()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fragility::risk::HazardCurve;

    /// Beside the exact total, which reference cases hold: over the range of
    /// the model's dispersion, and under a steep and a flat hazard curve.
    #[test]
    fn a_draw_keeps_five_digits() {
        let steep = [(1e-3, 1e2), (0.1, 1.0), (1.0, 1e-3), (9.0, 1e-8)];
        let flat = [(0.02, 1e-2), (0.3, 5e-3), (3.0, 2e-3), (40.0, 1e-3)];
        let hazards =
            [steep, flat].map(|all| HazardCurve::try_new(&all).unwrap());
        let mut worst = [0.0_f64; 3];
        for (shift, log_mean) in [(0.05, -2.0), (0.2, 0.3), (1.0, -1.5)] {
            for beta in [0.05, 0.2, 0.45, 0.8, 1.5] {
                for s in [0.01, 0.03, 0.1, 0.2, 0.25, 0.5, 1.0] {
                    let own = Lognormal::try_new(shift, log_mean, beta);
                    let own = own.unwrap();
                    let exact = TotalFragility::try_new(own, 1.2, s).unwrap();
                    let draw = TotalFragility::of_draw(exact);
                    let draw = draw.scaled(3.0).unwrap();
                    let draw = draw.scaled(1.0 / 3.0).unwrap();
                    let mut hold = |kind: usize, found: f64, right: f64| {
                        let error = (found / right - 1.0).abs();
                        worst[kind] = worst[kind].max(error);
                    };
                    for k in -8..=6 {
                        let p = normal::cdf(0.5 * f64::from(k));
                        let x = exact.quantile(p);
                        hold(0, draw.cdf(x), exact.cdf(x));
                        hold(1, draw.quantile(p), x);
                    }
                    for hazard in &hazards {
                        let [found, right] = [draw, exact].map(|own| {
                            hazard.annual_frequency(own).truncation_lower
                        });
                        hold(2, found, right);
                    }
                }
            }
        }
        assert!(worst.iter().all(|error| *error < 2e-6), "{worst:?}");
    }
}
