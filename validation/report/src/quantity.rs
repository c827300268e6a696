//! Numbers of findings as people read them, each in its unit: with the digits
//! that decide as all digits do.

use rocking_common::findings::{
    Claim, ClaimResult, NoEffect, Region, SampleCount, StatedEffect, Unit,
    Yardstick,
};
use rocking_statistics::Estimate;

/// Digits beyond which no number is printed.
const MOST_DECIMALS: usize = 12;

/// The half-width of an interval over the unit of its last digit, at most.
/// Ends of a bootstrap of 2,000 draws scatter by 1/63 of it, which is less
/// than half of that unit.
const UNITS: f64 = 30.0;

/// How a number is shown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub enum ValueScale {
    /// As it is.
    Plain,
    /// In per cent.
    Percent,
    /// A difference of two shares, in percentage points.
    Points,
    /// A ratio as its distance from 1, in per cent.
    Change,
}

impl ValueScale {
    /// The scale of a unit.
    fn of(unit: Unit) -> Self {
        match unit {
            Unit::Share => Self::Percent,
            Unit::Points => Self::Points,
            _ => Self::Plain,
        }
    }

    /// The scale of an effect: of a ratio that is said to be 1, or another
    /// number, its change.
    fn of_effect(unit: Unit, none: Option<NoEffect>) -> Self {
        use StatedEffect::{Differs, Nothing};
        match (unit, none) {
            (
                Unit::One,
                Some(NoEffect { value: 1.0, says: Nothing | Differs }),
            ) => Self::Change,
            _ => Self::of(unit),
        }
    }

    fn shown(self, x: f64) -> f64 {
        match self {
            Self::Plain => x,
            Self::Percent | Self::Points => 100.0 * x,
            Self::Change => 100.0 * (x - 1.0),
        }
    }

    fn back(self, shown: f64) -> f64 {
        match self {
            Self::Plain => shown,
            Self::Percent | Self::Points => shown / 100.0,
            Self::Change => 1.0 + shown / 100.0,
        }
    }

    fn unit(self) -> &'static str {
        match self {
            Self::Plain => "",
            Self::Percent | Self::Change => " %",
            Self::Points => " points",
        }
    }

    /// Decimals with which the largest of these numbers has three digits; two
    /// where it is a percentage below 10.
    fn decimals(self, numbers: &[f64]) -> usize {
        let sizes = numbers.iter().map(|x| self.shown(*x).abs());
        let largest = sizes.filter(|x| x.is_finite()).fold(0.0, f64::max);
        if largest == 0.0 {
            return 0;
        }
        let few = self != Self::Plain && largest < 10.0;
        let first = libm::floor(libm::log10(largest)) as i32;
        let decimals = if few { 1 - first } else { 2 - first };
        usize::try_from(decimals).unwrap_or(0).min(MOST_DECIMALS)
    }

    /// A number with so many decimals.
    fn text(self, x: f64, decimals: usize) -> String {
        if x.is_infinite() {
            return if x > 0.0 { "infinite" } else { "-infinite" }.into();
        }
        let text = format!("{:.decimals$}", self.shown(x));
        let digits = text.trim_start_matches('-');
        match digits.contains(|c: char| ('1'..='9').contains(&c)) {
            // No negative zero.
            false => digits.into(),
            true if self == Self::Change && x > 1.0 => format!("+{text}"),
            true => text,
        }
    }

    /// Decimals from these on with which printed numbers decide as they do
    /// themselves.
    fn deciding<T: PartialEq>(
        self,
        from: usize,
        numbers: &[f64],
        decide: impl Fn(f64) -> T,
    ) -> usize {
        let decides = |decimals: &usize| {
            numbers.iter().filter(|x| x.is_finite()).all(|&x| {
                let printed = format!("{:.decimals$}", self.shown(x));
                let printed = printed.parse().map_or(x, |y| self.back(y));
                decide(printed) == decide(x)
            })
        };
        (from..MOST_DECIMALS).find(decides).unwrap_or(MOST_DECIMALS)
    }
}

/// An estimate as value with unit, and interval in brackets.
pub struct EstimateText {
    /// `12 %`.
    pub value: String,
    /// ` (8 to 17)`; empty without an interval.
    pub interval: String,
}

impl EstimateText {
    /// The text of an estimate; with `limit`, as many digits as show on which
    /// side of it an end lies.
    pub fn of(
        estimate: &Estimate,
        scale: ValueScale,
        limit: Option<f64>,
    ) -> Self {
        let value = estimate.value();
        if value.is_nan() {
            return Self { value: "no data".into(), interval: String::new() };
        }
        let Some(interval) = estimate.interval() else {
            let decimals = scale.decimals(&[value]);
            let value = shortened(scale.text(value, decimals)) + scale.unit();
            return Self { value, interval: String::new() };
        };
        let (low, high) = interval.ends();
        let halves =
            [low, high].map(|x| (scale.shown(x) - scale.shown(value)).abs());
        let half =
            halves.into_iter().filter(|x| x.is_finite()).fold(0.0, f64::max);
        let by_half = libm::floor(libm::log10(UNITS / half));
        let by_value = scale.decimals(&[value, low, high]);
        let decimals = by_half.clamp(0.0, by_value as f64) as usize;
        let decimals = match limit {
            Some(limit) => scale
                .deciding(decimals, &[low, high], |x| x.partial_cmp(&limit)),
            None => decimals,
        };
        let [value, low, high] =
            [value, low, high].map(|x| scale.text(x, decimals));
        Self {
            value: value + scale.unit(),
            interval: format!(" ({low} to {high})"),
        }
    }

    /// Both.
    pub fn whole(self) -> String {
        self.value + &self.interval
    }
}

/// A number without zeros behind its last digit.
fn shortened(text: String) -> String {
    match text.contains('.') {
        true => text.trim_end_matches('0').trim_end_matches('.').into(),
        false => text,
    }
}

/// A result's effect with its interval and unit: `12 % (8 to 17)`.
pub fn effect_text(claim: &Claim, result: &ClaimResult) -> EstimateText {
    let scale = ValueScale::of_effect(result.unit, claim.no_effect);
    let limit = claim.no_effect.map(|none| none.value);
    EstimateText::of(&result.estimate, scale, limit)
}

/// What a claim says of its effect, in the unit of its results: `above 0`,
/// `below 1`, `not 0 %`, `0 %`.
pub fn said_text(claim: &Claim) -> Option<String> {
    let none = claim.no_effect?;
    let unit = claim.results.first()?.unit;
    let scale = ValueScale::of_effect(unit, Some(none));
    let at = EstimateText::of(&Estimate::exact(none.value), scale, None).value;
    Some(match none.says {
        StatedEffect::Above => format!("above {at}"),
        StatedEffect::Below => format!("below {at}"),
        StatedEffect::Differs => format!("not {at}"),
        StatedEffect::Nothing => format!("none ({at})"),
    })
}

/// A number of a sample: `9 % (4 of 47)`.
pub fn count_text(yardstick: &Yardstick, count: &SampleCount) -> String {
    let SampleCount { value, of } = *count;
    if value.is_nan() {
        return "no data".into();
    }
    let scale = ValueScale::of(yardstick.unit);
    let from = scale.decimals(&[value]);
    let decides = |x| yardstick.holds.holds(x);
    let decimals = scale.deciding(from, &[value], decides);
    let text = shortened(scale.text(value, decimals)) + scale.unit();
    match of {
        Some(n) => format!("{text} ({:.0} of {n})", value * n as f64),
        None => text,
    }
}

/// Where the number of a yardstick lies if a statement is seen: `above 50 %`,
/// `at least 90 %`.
pub fn rule_text(yardstick: &Yardstick) -> String {
    let scale = ValueScale::of(yardstick.unit);
    let number = |x| EstimateText::of(&Estimate::exact(x), scale, None).value;
    match yardstick.holds {
        Region::Within(a, b) if a == b => number(a),
        Region::Within(a, 1.0) if yardstick.unit == Unit::Share => {
            format!("at least {}", number(a))
        }
        Region::Within(a, b) => format!("{} to {}", number(a), number(b)),
        Region::Below(x) => format!("below {}", number(x)),
        Region::Above(x) => format!("above {}", number(x)),
    }
}

#[cfg(test)]
mod tests;
