//! Bias and dispersion of the model against real objects; both enter every
//! decision.

use std::fmt;

use thiserror::Error;

use crate::fit::BootstrapFits;
use crate::fragility::total::{MODEL_DISPERSION, TotalFragility};
use rocking_statistics::lognormal::LognormalError;
use rocking_statistics::streams::Streams;
use rocking_statistics::{Estimate, Interval, Lognormal, Range};

/// Source of the default values.
const SOURCE: &str = "490 shaking-table tests of two granite rocks (Saifullah and Wittich \
     2021)";

/// Least and largest bias.
const BIAS: (f64, f64) = (0.1, 10.0);

/// A bias or a dispersion, with its range; without a range it counts as known.
pub type ModelErrorPart = Estimate;

/// A text that gives no valid bias or dispersion of the model.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("found `{found}`: expected {expected}")]
pub struct ModelErrorFault {
    found: String,
    expected: &'static str,
}

/// The error of the model: a real capacity is b exp(s Z) times the computed
/// one, with the bias b, the dispersion s, and Z standard normal
/// ([`TotalFragility`]).
///
/// Each is a value with the range in which it may lie; without a range it
/// counts as known. The defaults are measured: a computed capacity was set
/// beside 490 outcomes of two rocks, whose angle was fitted to them. That
/// gives the dispersion, and 6 % of bias of a fitted object. The range of an
/// object that was not fitted also holds a coefficient of restitution from
/// 0.85 to 0.97, which moves the capacity by 0.82 to 1.22.
///
/// ```
/// use rocking_procedures::ModelError;
/// assert!(ModelError::default().to_string().starts_with(
///     "model bias 1 (0.77 to 1.3), model dispersion 0.2 (0 to 0.25)"
/// ));
/// let own = ModelError::none()
///     .or(Some(ModelError::parse_bias("1.1,1,1.2")?), None);
/// assert_eq!(
///     own.to_string(),
///     "model bias 1.1 (1 to 1.2), model dispersion 0"
/// );
/// # Ok::<(), rocking_procedures::model_error::ModelErrorFault>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
pub struct ModelError {
    bias: ModelErrorPart,
    dispersion: ModelErrorPart,
}

impl Default for ModelError {
    /// Of an object that was not tested.
    fn default() -> Self {
        Self::measured(0.77, 1.3)
    }
}

impl ModelError {
    /// No model error, only the scatter of the records.
    pub fn none() -> Self {
        let (bias, dispersion) = (Estimate::exact(1.0), Estimate::exact(0.0));
        Self { bias, dispersion }
    }

    /// Of an object whose slenderness was fitted to its own tests.
    pub fn fitted() -> Self {
        Self::measured(0.94, 1.06)
    }

    /// The bias, with its range if it has one.
    pub fn bias(&self) -> &Estimate {
        &self.bias
    }

    /// The dispersion, with its range if it has one.
    pub fn dispersion(&self) -> &Estimate {
        &self.dispersion
    }

    fn measured(low: f64, high: f64) -> Self {
        let of = |value, low, high| {
            ranged(value, low, high).unwrap_or(Estimate::exact(value))
        };
        Self { bias: of(1.0, low, high), dispersion: of(0.2, 0.0, 0.25) }
    }

    /// This error with another bias or dispersion, if one is given.
    pub fn or(
        self,
        bias: Option<ModelErrorPart>,
        dispersion: Option<ModelErrorPart>,
    ) -> Self {
        let bias = bias.unwrap_or(self.bias);
        Self { bias, dispersion: dispersion.unwrap_or(self.dispersion) }
    }

    /// A bias from `B`, `B,LOW,HIGH` or `fitted`.
    ///
    /// # Errors
    /// [`ModelErrorFault`] for another text, and numbers beyond 0.1 to 10.
    pub fn parse_bias(text: &str) -> Result<ModelErrorPart, ModelErrorFault> {
        let expected = "B or B,LOW,HIGH with numbers from 0.1 to 10 and \
                        LOW <= B <= HIGH, or `fitted`";
        if text == "fitted" {
            return Ok(Self::fitted().bias);
        }
        part(text, expected, |x| (BIAS.0..=BIAS.1).contains(&x))
    }

    /// A dispersion from `S` or `S,LOW,HIGH`.
    ///
    /// # Errors
    /// [`ModelErrorFault`] for another text, and numbers that are neither 0
    /// nor from 0.01 to 1.
    pub fn parse_dispersion(
        text: &str,
    ) -> Result<ModelErrorPart, ModelErrorFault> {
        let expected = "S or S,LOW,HIGH with numbers that are 0 or from 0.01 \
                        to 1, and LOW <= S <= HIGH";
        let (least, most) = MODEL_DISPERSION;
        part(text, expected, |x| x == 0.0 || (least..=most).contains(&x))
    }

    /// Whether this is no error.
    pub fn is_none(&self) -> bool {
        *self == Self::none()
    }

    /// The records' law with the values of bias and dispersion.
    ///
    /// # Errors
    /// [`LognormalError`] for a value that [`TotalFragility`] rejects.
    pub fn total(
        &self,
        records: Lognormal,
    ) -> Result<TotalFragility, LognormalError> {
        let (bias, dispersion) = (self.bias.value(), self.dispersion.value());
        TotalFragility::try_new(records, bias, dispersion)
    }
}

fn ranged(value: f64, low: f64, high: f64) -> Option<Estimate> {
    let interval = Interval::try_new(low, high).ok()?;
    Estimate::try_new(value, interval, Range::NotNegative).ok()
}

/// A value, with or without its range.
fn part(
    text: &str,
    expected: &'static str,
    is_one: impl Fn(f64) -> bool,
) -> Result<Estimate, ModelErrorFault> {
    let number = |word: &str| word.trim().parse().ok().filter(|x| is_one(*x));
    let numbers: Option<Vec<f64>> = text.split(',').map(number).collect();
    let found = match numbers.as_deref() {
        Some([value]) => Some(Estimate::exact(*value)),
        Some([value, low, high]) => ranged(*value, *low, *high),
        _ => None,
    };
    found.ok_or_else(|| ModelErrorFault { found: text.to_owned(), expected })
}

impl fmt::Display for ModelError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let text = |of: &Estimate| of.text("", |x| x.to_string());
        let (bias, dispersion) = (text(&self.bias), text(&self.dispersion));
        write!(f, "model bias {bias}, model dispersion {dispersion}")?;
        if *self == Self::default() {
            write!(f, ", from {SOURCE} and a restitution from 0.85 to 0.97")
        } else if *self == Self::fitted() {
            write!(f, ", from {SOURCE}")
        } else {
            Ok(())
        }
    }
}

/// The number of a draw, evenly over the range, half of the draws on either
/// side of the value; a bias evenly in its logarithm.
fn drawn(of: &Estimate, u: f64, range: Range) -> f64 {
    let value = range.scale(of.value());
    let (low, high) = of.interval().map_or((value, value), |own| {
        (range.scale(own.low()), range.scale(own.high()))
    });
    let end = if u < 0.5 { low } else { high };
    range.unscale(f64::mul_add((2.0 * u - 1.0).abs(), end - value, value))
}

impl BootstrapFits {
    /// These fits, each with its own bias and dispersion, drawn over their
    /// ranges from the stream of `name`: their intervals then include the
    /// uncertainty of records and model. A dispersion drawn below 0.01 counts
    /// as 0.
    pub fn with(self, error: &ModelError, name: &str) -> Self {
        self.with_factors(error, &[], name)
    }

    /// As [`Self::with`], each bias times further `factors` of the capacity,
    /// drawn as a bias is.
    pub(crate) fn with_factors(
        mut self,
        error: &ModelError,
        factors: &[Estimate],
        name: &str,
    ) -> Self {
        if error.is_none() && factors.is_empty() {
            return self;
        }
        let name = format!("model error/{name}");
        let streams = Streams::new(&name, self.basis.draws.seed);
        for (fitted, index) in self.fitted.iter_mut().zip(0..) {
            let mut stream = streams.stream(index);
            let [u, v] = [stream.uniform(), stream.uniform()];
            let mut bias = drawn(&error.bias, u, Range::NotNegative);
            for factor in factors {
                bias *= drawn(factor, stream.uniform(), Range::NotNegative);
            }
            let s = drawn(&error.dispersion, v, Range::Real);
            let s = if s < MODEL_DISPERSION.0 { 0.0 } else { s };
            *fitted = fitted.and_then(|own| {
                let total = TotalFragility::try_new(*own.records(), bias, s);
                total.ok().map(TotalFragility::of_draw)
            });
        }
        self.basis.model_error = Some(*error);
        self
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_that_say_no_error_are_refused() {
        for text in ["", "0", "0.05", "11", "nan", "1,1.1,1.2", "1,0.9", "x"] {
            assert!(ModelError::parse_bias(text).is_err(), "{text}");
        }
        for text in ["", "-0.1", "0.009", "1.1", "nan", "0.2,0.25,0", "0,1"] {
            assert!(ModelError::parse_dispersion(text).is_err(), "{text}");
        }
        let none = (
            ModelError::parse_bias("1").ok(),
            ModelError::parse_dispersion("0").ok(),
        );
        assert!(ModelError::default().or(none.0, none.1).is_none());
    }

    /// Half of 4000 draws lie on either side of the value, evenly: the mean
    /// of |x - value| is half of the distance to the end.
    #[test]
    fn draws_are_even_on_either_side_of_the_value() {
        let streams = Streams::new("test", 0);
        let error = ModelError::default();
        let all = (0..4000).map(|k| streams.stream(k).uniform());
        let all: Vec<f64> = all.collect();
        for (of, range, ends) in [
            (
                &error.bias,
                Range::NotNegative,
                (libm::log(0.77), libm::log(1.3)),
            ),
            (&error.dispersion, Range::Real, (-0.2, 0.05)),
        ] {
            let off = |u: &f64| {
                range.scale(drawn(of, *u, range)) - range.scale(of.value())
            };
            let (below, above): (Vec<f64>, Vec<f64>) =
                all.iter().map(off).partition(|x| *x < 0.0);
            assert!((below.len() as f64 / 2000.0 - 1.0).abs() < 0.05);
            for (part, end) in [(below, ends.0), (above, ends.1)] {
                let mean = part.iter().sum::<f64>() / part.len() as f64;
                assert!((mean / end - 0.5).abs() < 0.03, "{mean} {end}");
            }
        }
    }

    /// Of one law whose bias alone is drawn, evenly from 0.8 to 1.25 in its
    /// logarithm, the band lies between the laws of nearly these ends.
    #[test]
    fn a_band_lies_between_the_draws() {
        let records = Lognormal::try_new(0.0, 0.0, 0.3).unwrap();
        let none = Some(ModelError::parse_dispersion("0").unwrap());
        let bias = Some(ModelError::parse_bias("1,0.8,1.25").unwrap());
        let error = ModelError::none().or(bias, none);
        let draws = crate::Draws { replicates: 4000, seed: 0 };
        let clusters = rocking_statistics::Clusters::singletons(4000);
        let sampled = BootstrapFits {
            basis: crate::fit::IntervalBasis::new(draws, &clusters),
            fitted: vec![Some(records.into()); 4000],
        };
        let total = error.total(records).unwrap();
        let band = sampled.with(&error, "test").band(&total, &[0.1, 1.0]);
        let ends = band.points[1].probability.ends();
        // 95 % of ln(b) lie within 0.95 ln(1.25).
        let end = 0.95 * libm::log(1.25) / 0.3;
        let expected = [-end, end].map(rocking_statistics::normal::cdf);
        assert!((ends.0 - expected[0]).abs() < 0.01, "{ends:?} {expected:?}");
        assert!((ends.1 - expected[1]).abs() < 0.01, "{ends:?} {expected:?}");
        assert!(band.points[0].probability.ends().1 < 1e-6);
    }
}
