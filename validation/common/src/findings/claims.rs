//! The paper's claims in the findings: declarations, and results by suite and
//! grid.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::estimate;
use super::unit::Unit;
use crate::json::nine;
use crate::paper::{Arm, PaperSection, SuiteKind};
use rocking::names::named;
use rocking_statistics::Estimate;

/// One statement of the paper with its results.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// Unique name: `ratios-p1`.
    pub id: String,
    /// Kind of the statement.
    pub kind: Kind,
    /// Its theme.
    pub theme: Theme,
    /// Section of the paper, with the table or the figures.
    pub section: PaperSection,
    /// The paper's words, a whole sentence with its qualifiers.
    pub quote: String,
    /// The statement in plain words; empty unless it is a finding.
    pub plain: String,
    /// The quantity whose value is the effect, in words; empty for a
    /// description.
    pub measure: String,
    /// Blocks measured.
    pub blocks: String,
    /// Rules by which the paper decides on its own sample; empty unless the claim
    /// is a finding.
    pub yardsticks: Vec<Yardstick>,
    /// The value of no effect, and the side on which the statement sees the effect;
    /// `None` for a quantity without such a value.
    pub no_effect: Option<NoEffect>,
    /// Reference case that checks an identity; else empty.
    pub case: String,
    /// A further remark for the reader; may be empty.
    pub note: String,
    /// Results by suite and grid; empty for a description.
    pub results: Vec<ClaimResult>,
}

/// Sort of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// True by definition or by arithmetic: a reference case checks it, and no
    /// count includes it.
    Identity,
    /// It can come out either way.
    Finding,
    /// Without measurable content: quoted, not judged.
    Description,
}

/// Theme of a statement, in the order of the page.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Theme {
    /// Blocks, uplift, restitution, criterion, components, resurrections.
    Choices,
    /// Does the slenderness drop out under a single motion?
    SingleRecords,
    /// Does it drop out of the statistics of a suite?
    Statistics,
    /// Are capacities lognormal above a shift?
    Lognormality,
    /// Do Eqs. 5 to 7 give the fragility?
    Fragilities,
    /// Additions of the study to the paper.
    Beyond,
}

impl Theme {
    /// The question that the theme answers.
    pub fn question(self) -> &'static str {
        match self {
            Self::Choices => {
                "Do the model and its choices do what the paper says?"
            }
            Self::SingleRecords => {
                "Does the slenderness drop out under a single motion \
                 (Figures 2 to 5)?"
            }
            Self::Statistics => {
                "Does the slenderness drop out of the statistics of a \
                 suite, and do scaled records and adjusted slenderness \
                 agree (Figures 6 to 10)?"
            }
            Self::Lognormality => {
                "Are capacities lognormal above a shift (Figures 11 to 14)?"
            }
            Self::Fragilities => {
                "Do Eqs. 5 to 7 give the fragility of the block with p = 3, \
                 alpha = 0.20 (Figures 15 to 18)?"
            }
            Self::Beyond => {
                "Beyond the paper: the rest of the slenderness, and the \
                 paper's sentences on AvgSA"
            }
        }
    }
}

/// Level of the interval of an effect: each end is a one-sided limit that is wrong
/// in 5 % of samples.
pub const LEVEL: f64 = 0.9;

/// A rule of the paper for its own sample: a count or a number, and the region in
/// which it lies if the statement is seen. No interval enters it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Yardstick {
    /// The number in words: `notches that contain 1`.
    pub words: String,
    /// Its unit.
    pub unit: Unit,
    /// The region in which it lies if the statement is seen.
    pub holds: Region,
}

/// The value of no effect, and the effect that a statement claims.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct NoEffect {
    /// The value of no effect: 1 of a ratio, 0 of a difference.
    pub value: f64,
    /// The effect that the statement claims.
    pub says: StatedEffect,
}

/// The effect that a statement claims.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum StatedEffect {
    /// The quantity lies above the value of no effect.
    Above,
    /// It lies below.
    Below,
    /// It differs from it.
    Differs,
    /// There is no effect.
    Nothing,
}

/// Region in which a value has to lie.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Region {
    /// Between these, ends included.
    Within(f64, f64),
    /// Below this.
    Below(f64),
    /// Above this.
    Above(f64),
}

impl Region {
    /// Whether a value lies in the region; NaN does not.
    ///
    /// ```
    /// use rocking_common::findings::Region;
    /// assert!(Region::Within(0.95, 1.05).holds(0.95));
    /// assert!(!Region::Above(0.5).holds(0.5));
    /// assert!(!Region::Above(0.5).holds(f64::NAN));
    /// ```
    pub fn holds(self, value: f64) -> bool {
        match self {
            Self::Within(a, b) => a <= value && value <= b,
            Self::Below(limit) => value < limit,
            Self::Above(limit) => value > limit,
        }
    }
}

/// The region in words: `0.95 to 1.05`, `below 0.1`, `above 0.9`.
impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Within(a, b) if a == b => write!(f, "{a}"),
            Self::Within(a, b) => write!(f, "{a} to {b}"),
            Self::Below(limit) => write!(f, "below {limit}"),
            Self::Above(limit) => write!(f, "above {limit}"),
        }
    }
}

named! {
    /// Whether a statement is seen in a sample, by the paper's own yardsticks.
    pub enum Seen: "seen" {
        /// Every yardstick holds.
        Yes = "yes",
        /// Some yardsticks hold, or some samples show the statement.
        InPart = "in part",
        /// No yardstick holds.
        No = "no",
        /// The sample lacks the premise of the statement.
        NotTestable = "not testable",
    }
}

impl Seen {
    /// The verdict from the numbers of a sample, one for each yardstick. A missing
    /// number makes the statement not testable.
    ///
    /// ```
    /// use rocking_common::findings::{Region, SampleCount, Seen};
    /// use rocking_common::findings::{Unit, Yardstick};
    /// let holds = Region::Above(0.5);
    /// let words = "notches that contain 1".into();
    /// let most = [Yardstick { words, unit: Unit::Share, holds }];
    /// let seen = |k, n| Seen::of(&most, &[SampleCount::of(k, n)]);
    /// assert_eq!(seen(30, 43), Seen::Yes);
    /// assert_eq!(seen(1, 43), Seen::No);
    /// assert_eq!(seen(0, 0), Seen::NotTestable);
    /// ```
    pub fn of(yardsticks: &[Yardstick], counts: &[SampleCount]) -> Self {
        if yardsticks.len() != counts.len()
            || counts.iter().any(|count| count.value.is_nan())
        {
            return Self::NotTestable;
        }
        let both = yardsticks.iter().zip(counts);
        let each = both.map(|(y, count)| match y.holds.holds(count.value) {
            true => Self::Yes,
            false => Self::No,
        });
        each.reduce(Self::and).unwrap_or(Self::NotTestable)
    }

    /// The verdict for two samples or two parts of a statement. A part that is not
    /// testable does not count beside a testable one.
    pub fn and(self, other: Self) -> Self {
        match (self, other) {
            (Self::NotTestable, one) | (one, Self::NotTestable) => one,
            (a, b) if a == b => a,
            _ => Self::InPart,
        }
    }
}

named! {
    /// Whether an effect exists beyond the records of a sample.
    pub enum Exists: "exists" {
        /// The interval leaves no effect out; if the statement names a side,
        /// on that side.
        Yes = "yes",
        /// The interval contains the value of no effect, or there is no interval.
        NoSign = "no sign",
        /// The interval leaves no effect out, on the side that the statement
        /// does not name.
        Opposite = "the opposite",
    }
}

impl Exists {
    /// The verdict from an effect with its interval.
    ///
    /// ```
    /// use rocking_common::findings::{Exists, NoEffect, StatedEffect};
    /// use rocking_statistics::{Estimate, Interval, Range};
    /// let ends = Interval::try_new(1.1, 1.4).unwrap();
    /// let ratio = Estimate::try_new(1.2, ends, Range::NotNegative).unwrap();
    /// let of = |says| Exists::of(&NoEffect { value: 1.0, says }, &ratio);
    /// assert_eq!(of(StatedEffect::Above), Exists::Yes);
    /// assert_eq!(of(StatedEffect::Below), Exists::Opposite);
    /// // The statement says that there is no difference: there is one.
    /// assert_eq!(of(StatedEffect::Nothing), Exists::Yes);
    /// ```
    pub fn of(no_effect: &NoEffect, effect: &Estimate) -> Self {
        let NoEffect { value, says } = *no_effect;
        let (low, high) = effect.ends();
        match (says, low > value, high < value) {
            (_, false, false) => Self::NoSign,
            (StatedEffect::Above, above, _) if !above => Self::Opposite,
            (StatedEffect::Below, _, below) if !below => Self::Opposite,
            _ => Self::Yes,
        }
    }
}

named! {
    /// Suites on which a statement was tested.
    pub enum SuiteSet: "tested on" {
        /// No records are needed.
        None = "none",
        /// The ordinary suite.
        Ordinary = "ordinary",
        /// The pulse-type suite.
        PulseType = "pulse-type",
        /// A comparison of the two.
        Both = "both",
    }
}

impl From<SuiteKind> for SuiteSet {
    fn from(kind: SuiteKind) -> Self {
        match kind {
            SuiteKind::Ordinary => Self::Ordinary,
            SuiteKind::PulseType => Self::PulseType,
        }
    }
}

/// A number of a sample: a share of counted things, or another number.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SampleCount {
    /// The number; for a share the counted part of the whole.
    #[serde(with = "nine")]
    pub value: f64,
    /// Number of things counted; `None` if the number is not a share.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub of: Option<usize>,
}

impl SampleCount {
    /// k of n things; NaN for n = 0.
    pub fn of(k: usize, n: usize) -> Self {
        Self { value: k as f64 / n as f64, of: Some(n) }
    }

    /// The share of the things that satisfy a condition.
    pub fn among<T>(
        all: impl IntoIterator<Item = T>,
        is: impl Fn(T) -> bool,
    ) -> Self {
        let all: Vec<bool> = all.into_iter().map(is).collect();
        Self::of(all.iter().filter(|is| **is).count(), all.len())
    }

    /// A number that is not a share of things.
    pub fn number(value: f64) -> Self {
        Self { value, of: None }
    }
}

/// Result on one suite and grid.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimResult {
    /// The suite.
    pub suite: SuiteSet,
    /// The grid, if there is one.
    pub arm: Option<Arm>,
    /// Whether the statement is seen in this sample.
    pub seen: Seen,
    /// The numbers that decide this, one for each yardstick.
    pub counts: Vec<SampleCount>,
    /// Whether its effect exists beyond this sample; `None` for a quantity without
    /// a value of no effect, and for a statement that is not testable.
    pub exists: Option<Exists>,
    /// The effect with its interval of [`LEVEL`].
    #[serde(flatten, with = "estimate::complete")]
    pub estimate: Estimate,
    /// Its unit.
    pub unit: Unit,
    /// Place of the measurement, in words.
    pub at: String,
    /// Further numbers, by name.
    pub details: Vec<Detail>,
}

impl ClaimResult {
    /// Suite and grid in words: `ordinary, arm C`.
    pub fn place(&self) -> String {
        let arm = self.arm.map(|arm| format!(", grid {}", arm.name()));
        self.suite.name().to_owned() + &arm.unwrap_or_default()
    }
}

/// A further number of a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detail {
    /// Its name.
    pub name: String,
    /// The value, with its interval if it has one.
    #[serde(flatten, with = "estimate")]
    pub estimate: Estimate,
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_statistics::{Interval, Range};

    #[test]
    fn a_statement_of_two_parts_is_seen_in_part_where_one_holds() {
        let limit = |words: &str, holds| Yardstick {
            words: words.into(),
            unit: Unit::One,
            holds,
        };
        let both = [
            limit("above", Region::Above(0.0)),
            limit("below", Region::Below(1.0)),
        ];
        let seen = |a, b| Seen::of(&both, &[a, b].map(SampleCount::number));
        assert_eq!(seen(0.5, 0.5), Seen::Yes);
        assert_eq!(seen(0.5, 1.0), Seen::InPart);
        assert_eq!(seen(0.0, 1.0), Seen::No);
        assert_eq!(seen(0.5, f64::NAN), Seen::NotTestable);
        assert_eq!(Seen::of(&both, &[]), Seen::NotTestable);
        assert_eq!(Seen::NotTestable.and(Seen::No), Seen::No);
        assert_eq!(Seen::Yes.and(Seen::No), Seen::InPart);
    }

    #[test]
    fn an_interval_that_holds_no_effect_is_no_sign() {
        use StatedEffect::{Above, Below, Differs, Nothing};
        let word = |says, (low, high): (f64, f64)| {
            let interval = Interval::try_new(low, high).unwrap();
            let effect = Estimate::try_new(low, interval, Range::Real);
            Exists::of(&NoEffect { value: 0.0, says }, &effect.unwrap())
        };
        for says in [Above, Below, Differs, Nothing] {
            assert_eq!(word(says, (-0.1, 0.2)), Exists::NoSign);
            assert_eq!(word(says, (0.0, 0.2)), Exists::NoSign);
            let none = Estimate::exact(f64::NAN);
            let no_effect = NoEffect { value: 0.0, says };
            assert_eq!(Exists::of(&no_effect, &none), Exists::NoSign);
        }
        assert_eq!(word(Above, (-0.2, -0.1)), Exists::Opposite);
        assert_eq!(word(Below, (-0.2, -0.1)), Exists::Yes);
        assert_eq!(word(Differs, (-0.2, -0.1)), Exists::Yes);
        assert_eq!(word(Nothing, (0.1, 0.2)), Exists::Yes);
    }
}
