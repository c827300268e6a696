//! A fragility that includes the model error beside the scatter of the
//! records.

use libm::{exp, hypot, log};

use rocking_statistics::Lognormal;
use rocking_statistics::lognormal::LognormalError;
use rocking_statistics::normal::{self, pdf};
use rocking_statistics::search::golden;

/// Largest score of the records' law that enters: the normal probability
/// beyond is 1e-17.
const LAST_SCORE: f64 = 8.5;

/// Score beyond which a normal probability counts as 0 or 1.
const CERTAIN: f64 = 9.0;

/// Step of the trapezoidal rule over the model's share of the total
/// dispersion. The integrand is analytic: the error is about exp(-35).
const STEP: f64 = 0.75;

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
}

impl From<Lognormal> for TotalFragility {
    /// A fragility without an error of the model.
    fn from(records: Lognormal) -> Self {
        let (bias, dispersion, closed) = (1.0, 0.0, Some(records));
        Self { records, bias, dispersion, biased: records, closed }
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
        Ok(Self { records, bias, dispersion, biased, closed })
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

    /// Step of the rule, and number of its steps on either side of 0.
    fn steps(&self) -> (f64, i32) {
        let both = hypot(self.biased.dispersion(), self.dispersion);
        let step = STEP * self.dispersion / both;
        (step, (LAST_SCORE / step).ceil() as i32)
    }

    /// Weights and lognormals whose mean the total is, in a fixed order. A
    /// part whose median is infinite adds to no probability.
    pub fn mixture(&self) -> impl Iterator<Item = (f64, Lognormal)> {
        let (step, last) = match self.closed {
            Some(_) => (0.0, 0),
            None => self.steps(),
        };
        let (own, s) = (self.biased, self.dispersion);
        let closed = self.closed;
        (-last..=last).filter_map(move |k| {
            let z = step * f64::from(k);
            let part =
                || Lognormal::try_new(0.0, log(own.at_score(z)), s).ok();
            let weight = if closed.is_some() { 1.0 } else { step * pdf(z) };
            Some((weight, closed.or_else(part)?))
        })
    }

    /// A function of x/median of the parts, the mean over them: from the part
    /// on below which the score of x is above [`CERTAIN`], and `far` for
    /// those.
    fn mean(&self, x: f64, far: f64, of: impl Fn(f64) -> f64) -> f64 {
        let (own, s) = (&self.biased, self.dispersion);
        let (step, last) = self.steps();
        let place = |off: f64| {
            let z = own.score(x * exp(off * s)) / step;
            z.clamp(f64::from(-last - 1), f64::from(last)) as i32
        };
        let z = |k: i32| step * f64::from(k);
        let (from, to) = (place(-CERTAIN), place(CERTAIN));
        let below = (-last..from).fold(0.0, |sum, k| sum + pdf(z(k)));
        let near = (from.max(-last)..=to.saturating_add(1).min(last)).fold(
            far * below,
            |sum, k| {
                let score = (log(x) - log(own.at_score(z(k)))) / s;
                f64::mul_add(pdf(z(k)), of(score), sum)
            },
        );
        step * near
    }

    /// The distribution function, a fragility's value at intensity x.
    pub fn cdf(&self, x: f64) -> f64 {
        match self.closed {
            Some(law) => law.cdf(x),
            None if x > 0.0 => self.mean(x, 1.0, normal::cdf).min(1.0),
            None => 0.0,
        }
    }

    /// The survival function 1 - F(x).
    pub fn survival(&self, x: f64) -> f64 {
        self.closed.map_or_else(|| 1.0 - self.cdf(x), |law| law.survival(x))
    }

    /// The normal score of F(x).
    pub fn score(&self, x: f64) -> f64 {
        let of = || normal::quantile(self.cdf(x));
        self.closed.map_or_else(of, |law| law.score(x))
    }

    /// The logarithm of the density in x.
    pub fn ln_pdf(&self, x: f64) -> f64 {
        let of = || log(self.mean(x, 0.0, pdf) / (x * self.dispersion));
        self.closed.map_or_else(of, |law| law.ln_pdf(x))
    }

    /// The intensity of a normal score.
    pub fn at_score(&self, z: f64) -> f64 {
        let of = || self.quantile(normal::cdf(z));
        self.closed.map_or_else(of, |law| law.at_score(z))
    }

    /// The quantile at probability p in [0, 1]; NaN outside.
    pub fn quantile(&self, p: f64) -> f64 {
        if let Some(law) = self.closed {
            return law.quantile(p);
        }
        if !(p > 0.0 && p < 1.0) {
            return if p == 0.0 { 0.0 } else { normal::quantile(p) };
        }
        let place = |z: f64| {
            let unbiased = self.records.at_score(z);
            f64::mul_add(self.dispersion, z, log(self.bias * unbiased))
        };
        // P(Z <= a or Z1 <= a) is at most 2 P(Z <= a), and that of both is
        // its square. The score of F is almost linear between these ends.
        let wanted = normal::quantile(p);
        let score = |y: f64| self.score(exp(y)).clamp(-CERTAIN, CERTAIN);
        let off = |y: f64| score(y) - wanted;
        let (mut low, mut high) = (
            place(normal::quantile(0.5 * p)),
            place(normal::quantile(p.sqrt())),
        );
        let (mut at_low, mut at_high) = (off(low), off(high));
        let mut side = 0;
        for _ in 0..100 {
            let y = (low * at_high - high * at_low) / (at_high - at_low);
            let at = off(y);
            if !(at.abs() > 1e-14 && y > low && y < high) {
                return exp(y);
            }
            // Regula falsi, Illinois: an end that stays counts half.
            if at < 0.0 {
                (low, at_low) = (y, at);
                at_high *= if side < 0 { 0.5 } else { 1.0 };
                side = -1;
            } else {
                (high, at_high) = (y, at);
                at_low *= if side > 0 { 0.5 } else { 1.0 };
                side = 1;
            }
        }
        exp(0.5 * (low + high))
    }

    /// The median.
    pub fn median(&self) -> f64 {
        let of = || self.quantile(0.5);
        self.closed.map_or_else(of, |law| law.median())
    }

    /// The score of the largest density.
    pub(super) fn mode_score(&self) -> f64 {
        let density = |z: f64| self.ln_pdf(self.at_score(z));
        let of = || golden(density, -8.0, 8.0);
        self.closed.map_or_else(of, |law| -law.dispersion())
    }

    /// The distribution of `factor` times the intensity.
    ///
    /// # Errors
    /// [`LognormalError`] unless the factor is positive and finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, LognormalError> {
        let records = self.records.scaled(factor)?;
        Self::try_new(records, self.bias, self.dispersion)
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
