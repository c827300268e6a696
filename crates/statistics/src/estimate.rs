//! A value with its interval.

use std::fmt;

use thiserror::Error;

/// Why a number, an interval or both were rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum EstimateError {
    /// The low end is above the high end, or an end is NaN.
    #[error(
        "interval from {0} to {1}: expected a low end not above the high end"
    )]
    Ends(f64, f64),
    /// A number that its quantity cannot take.
    #[error("{0}: expected a number from {1}")]
    Range(f64, Interval),
    /// The interval does not contain the value.
    #[error("{0}: expected a value in its interval, {1}")]
    Outside(f64, Interval),
}

/// The numbers that a quantity can take, ends included.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Range {
    /// Any number, such as a logarithm.
    Real,
    /// From 0 on: an intensity, a dispersion, a ratio, a frequency.
    NotNegative,
    /// From 0 to 1: a probability, a share, a distance of distributions.
    Share,
    /// From -1 to 1: a difference of two shares, a correlation.
    Difference,
}

impl Range {
    /// From the least to the largest number.
    pub fn interval(self) -> Interval {
        let (low, high) = match self {
            Self::Real => (f64::NEG_INFINITY, f64::INFINITY),
            Self::NotNegative => (0.0, f64::INFINITY),
            Self::Share => (0.0, 1.0),
            Self::Difference => (-1.0, 1.0),
        };
        Interval { low, high }
    }

    /// A number of the range on the scale on which its estimators scatter
    /// alike: the logarithm for positive quantities, else the number itself.
    pub fn scale(self, x: f64) -> f64 {
        match self {
            Self::NotNegative => libm::log(x),
            _ => x,
        }
    }

    /// The inverse of [`Self::scale`]; beyond the scale, the end of the range.
    pub fn unscale(self, y: f64) -> f64 {
        match self {
            Self::NotNegative => libm::exp(y),
            _ => self.nearest(y),
        }
    }

    /// The number in the range that is nearest to `x`; NaN for NaN.
    pub fn nearest(self, x: f64) -> f64 {
        let Interval { low, high } = self.interval();
        x.clamp(low, high)
    }
}

/// An interval, ends included. An infinite end is open: nothing bounds the
/// quantity there.
///
/// ```
/// use rocking_statistics::{Interval, Range};
/// let interval = Interval::try_new(-0.2, 0.6)?;
/// // The probability is not below 0: that end is exact.
/// assert_eq!(interval.within(Range::Share).low(), 0.0);
/// assert!(Interval::try_new(0.6, -0.2).is_err());
/// assert!(Interval::try_new(f64::NAN, 0.6).is_err());
/// # Ok::<(), rocking_statistics::estimate::EstimateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[must_use]
pub struct Interval {
    low: f64,
    high: f64,
}

impl Interval {
    /// The interval from `low` to `high`.
    ///
    /// # Errors
    /// [`EstimateError::Ends`] for ends that fall, and for NaN.
    pub fn try_new(low: f64, high: f64) -> Result<Self, EstimateError> {
        if low <= high {
            return Ok(Self { low, high });
        }
        Err(EstimateError::Ends(low, high))
    }

    /// For ends that rise by construction; each caller says why.
    pub(crate) fn rising(low: f64, high: f64) -> Self {
        debug_assert!(low <= high, "{low} {high}");
        Self { low, high }
    }

    /// The low end; minus infinity if it is open.
    pub fn low(self) -> f64 {
        self.low
    }

    /// The high end; infinity if it is open.
    pub fn high(self) -> f64 {
        self.high
    }

    /// Both ends.
    pub fn ends(self) -> (f64, f64) {
        (self.low, self.high)
    }

    /// Whether the interval contains a number.
    pub fn holds(self, x: f64) -> bool {
        self.low <= x && x <= self.high
    }

    /// The part of the interval within the range of its quantity: an end
    /// beyond the range is that end of the range, since the quantity lies in
    /// it.
    pub fn within(self, range: Range) -> Self {
        self.map(|x| range.nearest(x))
    }

    /// The interval of f(x), f monotone.
    pub fn map(self, f: impl Fn(f64) -> f64) -> Self {
        let (a, b) = (f(self.low), f(self.high));
        if a <= b { Self::rising(a, b) } else { Self::rising(b, a) }
    }
}

impl<'de> serde::Deserialize<'de> for Interval {
    fn deserialize<D: serde::Deserializer<'de>>(
        from: D,
    ) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        struct IntervalEnds {
            low: f64,
            high: f64,
        }
        let IntervalEnds { low, high } = IntervalEnds::deserialize(from)?;
        Self::try_new(low, high).map_err(serde::de::Error::custom)
    }
}

impl fmt::Display for Interval {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} to {}", self.low, self.high)
    }
}

/// A value, and its interval if it has one. The level is a separate field,
/// once for all estimates of a result.
///
/// ```
/// use rocking_statistics::{Estimate, Interval, Range};
/// let interval = Interval::try_new(0.0, 0.19)?;
/// let distance = Estimate::try_new(0.0516, interval, Range::Share)?;
/// let text = distance.text("", |x| x.to_string());
/// assert_eq!(text, "0.0516 (0 to 0.19)");
/// // Neither the value nor an end is negative.
/// let below = Interval::try_new(-0.0872, 0.19)?;
/// assert!(Estimate::try_new(0.0516, below, Range::Share).is_err());
/// assert!(Estimate::try_new(0.2, interval, Range::Share).is_err());
/// # Ok::<(), rocking_statistics::estimate::EstimateError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
#[must_use]
pub struct Estimate {
    value: f64,
    interval: Option<Interval>,
}

impl Estimate {
    /// A value without an interval: counted, computed exactly, or of data that
    /// give no interval. NaN if there are no data.
    pub fn exact(value: f64) -> Self {
        Self { value, interval: None }
    }

    /// A value with an interval that contains it.
    ///
    /// # Errors
    /// [`EstimateError`] for a value or a finite end that lies outside the
    /// range of the quantity, and for a value outside the interval.
    pub fn try_new(
        value: f64,
        interval: Interval,
        range: Range,
    ) -> Result<Self, EstimateError> {
        if !interval.holds(value) {
            return Err(EstimateError::Outside(value, interval));
        }
        let possible = range.interval();
        let open = |x: &f64| x.is_infinite() && *x != value;
        let numbers = [value, interval.low, interval.high].into_iter();
        match numbers.filter(|x| !open(x)).find(|x| !possible.holds(*x)) {
            Some(found) => Err(EstimateError::Range(found, possible)),
            None => Ok(Self { value, interval: Some(interval) }),
        }
    }

    /// For a value inside its interval by construction; each caller says why.
    pub(crate) fn inside(value: f64, interval: Interval) -> Self {
        debug_assert!(interval.holds(value), "{value} {interval:?}");
        Self { value, interval: Some(interval) }
    }

    /// The value.
    pub fn value(&self) -> f64 {
        self.value
    }

    /// Its interval.
    pub fn interval(&self) -> Option<Interval> {
        self.interval
    }

    /// Both ends, for a table or a drawing: infinite if open, NaN if there is
    /// no interval.
    pub fn ends(&self) -> (f64, f64) {
        self.interval.map_or((f64::NAN, f64::NAN), Interval::ends)
    }

    /// The low end; none if it is open, or there is no interval.
    pub fn low(&self) -> Option<f64> {
        self.interval.map(Interval::low).filter(|end| end.is_finite())
    }

    /// The high end; none if it is open, or there is no interval.
    pub fn high(&self) -> Option<f64> {
        self.interval.map(Interval::high).filter(|end| end.is_finite())
    }

    /// The estimate of f(x), f monotone.
    pub fn map(&self, f: impl Fn(f64) -> f64) -> Self {
        let interval = self.interval.map(|interval| interval.map(&f));
        Self { value: f(self.value), interval }
    }

    /// The value with its unit, and its interval in brackets, numbers as
    /// `number` writes them: `12 % (8 to 17)`.
    pub fn text(&self, unit: &str, number: impl Fn(f64) -> String) -> String {
        let value = number(self.value);
        let ends = self.interval.map_or(String::new(), |interval| {
            let [low, high] = [interval.low, interval.high].map(&number);
            format!(" ({low} to {high})")
        });
        value + unit + &ends
    }
}

/// Written as `point`, `low` and `high`; `null` is an open or missing end.
impl serde::Serialize for Estimate {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        keys::point(self, to)
    }
}

/// Reads what the serializer writes; an open end stays open.
impl<'de> serde::Deserialize<'de> for Estimate {
    fn deserialize<D: serde::Deserializer<'de>>(
        from: D,
    ) -> Result<Self, D::Error> {
        #[derive(serde::Deserialize)]
        struct EstimateFields {
            point: Option<f64>,
            low: Option<f64>,
            high: Option<f64>,
        }
        let EstimateFields { point, low, high } =
            EstimateFields::deserialize(from)?;
        let value = point.unwrap_or(f64::NAN);
        if low.or(high).is_none() {
            return Ok(Self::exact(value));
        }
        let low = low.unwrap_or(f64::NEG_INFINITY);
        let interval = Interval::try_new(low, high.unwrap_or(f64::INFINITY));
        let found = interval
            .and_then(|interval| Self::try_new(value, interval, Range::Real));
        found.map_err(serde::de::Error::custom)
    }
}

/// Names of the fields of an estimate that a struct flattens:
/// `#[serde(flatten, serialize_with = "estimate::keys::ratio")]`.
pub mod keys {
    use serde::{Serialize as _, Serializer};

    use super::Estimate;

    macro_rules! keys {
        ($($name:ident: $($value:literal)?, $low:literal, $high:literal;)+) => {$(
            #[doc = concat!("Keys ", $("`", $value, "`, ",)? "`", $low, "`, `", $high, "`.")]
            ///
            /// # Errors
            /// The serializer's.
            pub fn $name<S: Serializer>(
                estimate: &Estimate,
                to: S,
            ) -> Result<S::Ok, S::Error> {
                to.collect_map([
                    $(($value, Some(estimate.value)),)?
                    ($low, estimate.low()),
                    ($high, estimate.high()),
                ])
            }
        )+};
    }

    /// Keys `value`, `low`, `high` of a struct, or nothing.
    ///
    /// # Errors
    /// The serializer's.
    pub fn if_value<S: Serializer>(
        estimate: &Option<Estimate>,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        #[derive(serde::Serialize)]
        struct NamedValue(#[serde(serialize_with = "value")] Estimate);
        estimate.map(NamedValue).serialize(to)
    }

    keys! {
        point: "point", "low", "high";
        value: "value", "low", "high";
        p: "p", "low", "high";
        ratio: "ratio", "low", "high";
        geometric_mean: "geometric_mean", "low", "high";
        p_value: "p_value", "p_low", "p_high";
        probability: "probability", "low", "high";
        delta_ends: , "delta_low", "delta_high";
        annual_frequency_ends: , "annual_frequency_low", "annual_frequency_high";
        probability_ends: , "probability_low", "probability_high";
    }
}
