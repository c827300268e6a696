//! The paper's claims in the findings: what was declared, and what came out
//! by suite and arm.

use std::fmt;

use serde::{Deserialize, Serialize};

use super::estimate;
use super::unit::Unit;
use crate::json::nine;
use crate::paper::{Arm, ClaimVerdict, PaperSection, SuiteKind};
use rocking::names::named;
use rocking_statistics::Estimate;

/// One statement of the paper, and what was found about it.
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
    /// The statement in plain words: what the verdicts speak of; empty
    /// unless it is a finding.
    pub plain: String,
    /// The measure in words; empty for a description.
    pub measure: String,
    /// Blocks measured.
    pub blocks: String,
    /// How many of the cells the statement speaks of.
    pub quantifier: Option<Quantifier>,
    /// Where a value has to lie for the statement to hold in practice, and
    /// why there.
    pub region: Option<Region>,
    /// The engineering reason of the region's ends.
    pub reason: String,
    /// The paper's own criterion, where it states one.
    pub criterion: String,
    /// Declared case that checks an identity; empty otherwise.
    pub case: String,
    /// A further remark for the reader; may be empty.
    pub note: String,
    /// Results by suite and arm; none for a description.
    pub results: Vec<ClaimResult>,
}

/// Sort of a statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Kind {
    /// True by definition or by arithmetic: checked as a declared case, and
    /// counted nowhere.
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
    #[must_use]
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
                "Beyond the paper: has the rest of the slenderness a closed \
                 form?"
            }
        }
    }
}

/// Error of a decision: the probability that a verdict is given although the
/// truth lies on the other side of the limit; of "every cell", that any cell
/// is refuted although it lies in the region.
pub const ERROR: f64 = 0.05;

/// Level of the interval of every verdict. Each end is a one-sided limit with
/// [`ERROR`], so that a region holds the whole interval where both one-sided
/// tests say so (Schuirmann, J. Pharmacokin. Biopharm. 15 (1987) 657).
pub const LEVEL: f64 = 1.0 - 2.0 * ERROR;

/// How many of its cells a statement speaks of.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Quantifier {
    /// There is one value.
    One,
    /// Every cell.
    All,
    /// At least 90 % of the cells; "the exception, not the rule" says the
    /// same of the others.
    AlmostAll,
    /// More than half of the cells.
    Most,
}

impl Quantifier {
    /// The rule in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::One => "the value",
            Self::All => "every cell",
            Self::AlmostAll => "at least 90 % of the cells",
            Self::Most => "more than half of the cells",
        }
    }
}

/// Where a value has to lie.
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
    /// Whether an interval lies in the region, outside it, or on both sides;
    /// a missing number is inconclusive.
    ///
    /// ```
    /// use rocking_common::findings::Region;
    /// use rocking_common::paper::ClaimVerdict;
    /// let same = Region::Within(0.95, 1.05);
    /// assert_eq!(same.verdict(0.97, 1.03), ClaimVerdict::Confirmed);
    /// assert_eq!(same.verdict(0.93, 1.03), ClaimVerdict::Inconclusive);
    /// assert_eq!(same.verdict(1.06, 1.09), ClaimVerdict::NotConfirmed);
    /// ```
    #[must_use]
    pub fn verdict(self, low: f64, high: f64) -> ClaimVerdict {
        let (inside, outside) = match self {
            Self::Within(a, b) => (low >= a && high <= b, high < a || low > b),
            Self::Below(limit) => (high < limit, low >= limit),
            Self::Above(limit) => (low > limit, high <= limit),
        };
        match (inside, outside) {
            (true, _) => ClaimVerdict::Confirmed,
            (_, true) => ClaimVerdict::NotConfirmed,
            _ => ClaimVerdict::Inconclusive,
        }
    }

    /// Whether a value lies in the region; NaN does not.
    #[must_use]
    pub fn holds(self, value: f64) -> bool {
        self.verdict(value, value) == ClaimVerdict::Confirmed
    }

    /// How far a value lies from the region's middle or, with one end, how
    /// far it lies towards the wrong side.
    #[must_use]
    pub fn badness(self, value: f64) -> f64 {
        match self {
            Self::Within(a, b) => (value - 0.5 * (a + b)).abs(),
            Self::Below(limit) => value - limit,
            Self::Above(limit) => limit - value,
        }
    }

    /// The region's end that is nearest to a value.
    #[must_use]
    pub fn nearest_end(self, value: f64) -> f64 {
        match self {
            Self::Within(a, b) if (value - a).abs() < (value - b).abs() => a,
            Self::Within(_, b) => b,
            Self::Below(limit) | Self::Above(limit) => limit,
        }
    }
}

/// The region in words: `0.95 to 1.05`, `below 0.1`, `above 0.9`.
impl fmt::Display for Region {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Within(a, b) => write!(f, "{a} to {b}"),
            Self::Below(limit) => write!(f, "below {limit}"),
            Self::Above(limit) => write!(f, "above {limit}"),
        }
    }
}

named! {
    /// On what a statement was tested.
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

/// Result on one suite and arm.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ClaimResult {
    /// The suite.
    pub suite: SuiteSet,
    /// Arm of the grid, where there is one.
    pub arm: Option<Arm>,
    /// The value that decides: of one value itself, of "all" the deciding
    /// cell, of "most" and "almost all" the share of cells in the region. With
    /// its interval, of [`LEVEL`]: that which decides; none for an identity.
    #[serde(flatten, with = "estimate::complete")]
    pub estimate: Estimate,
    /// Standard error, over sets of draws, of the end that is nearest to a
    /// limit.
    #[serde(with = "nine")]
    pub monte_carlo_error: f64,
    /// Unit of value and interval.
    pub unit: Unit,
    /// Verdict by the paper's own criterion, where it states one.
    pub by_criterion: Option<ClaimVerdict>,
    /// Verdict by practical equivalence; none for an identity.
    pub by_equivalence: Option<ClaimVerdict>,
    /// The one-sided p-value of that verdict: the least error at which the
    /// interval lies on one side of the limit. At most [`ERROR`] where
    /// something is decided. Where nothing is, the smaller of both sides,
    /// with the ends moved by four errors of the draws: above [`ERROR`].
    #[serde(with = "nine")]
    pub p: f64,
    /// Which cell decides, or where the one value is.
    pub at: String,
    /// How the interval was made.
    pub interval: Option<IntervalMethod>,
    /// Counts of the cells, where there are several.
    pub cells: Option<CellCounts>,
    /// Of "most" and "almost all", the cell that bears the verdict.
    pub deciding_cell: Option<Detail>,
    /// Further numbers, by name.
    pub details: Vec<Detail>,
    /// Of an inconclusive result, what such a suite is able to decide.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub power: Option<DecisionPower>,
}

/// Power of a suite of this kind, were the truth as estimated.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct DecisionPower {
    /// Probability that its interval decides as the estimate says.
    #[serde(with = "nine")]
    pub probability: f64,
    /// How many times as many earthquakes, or records, decide with 80 %:
    /// infinite where a hundred times as many do not.
    #[serde(with = "nine")]
    pub times: f64,
}

impl ClaimResult {
    /// Suite and arm in words: `ordinary, arm C`.
    #[must_use]
    pub fn place(&self) -> String {
        let arm = self.arm.map(|arm| format!(", arm {}", arm.name()));
        self.suite.name().to_owned() + &arm.unwrap_or_default()
    }
}

/// How an interval was made.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum IntervalMethod {
    /// Bootstrap, bias-corrected and accelerated.
    Accelerated,
    /// Bootstrap, percentiles.
    Percentile,
    /// Bootstrap, the share of the cells in the region.
    ShareOfCells,
    /// Bootstrap, simultaneous over the cells that may lie outside.
    Simultaneous,
    /// Subsamples without replacement.
    Subsampling,
    /// Exact, of a count or of the order statistics of a median.
    Exact,
    /// Exact, simultaneous over the cells that may lie outside.
    ExactSimultaneous,
}

impl IntervalMethod {
    /// The way in words.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Accelerated => "bootstrap, BCa",
            Self::Percentile => "bootstrap, percentile",
            Self::ShareOfCells => "bootstrap of the share of cells",
            Self::Simultaneous => {
                "bootstrap, at once for all cells (Romano and Wolf)"
            }
            Self::Subsampling => {
                "subsamples of 90 %, with the range of leaving one out"
            }
            Self::Exact => "exact, records as the unit",
            Self::ExactSimultaneous => {
                "exact, records as the unit, at once for all cells (Holm)"
            }
        }
    }
}

/// Counts of the cells of a comparison.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct CellCounts {
    /// Cells with enough records to decide.
    pub deciding: usize,
    /// Of these, cells whose whole interval lies in the region.
    pub inside: usize,
    /// Cells whose whole interval lies outside.
    pub outside: usize,
    /// Cells with too few records: shown, not counted.
    pub too_few: usize,
}

/// A further number of a result.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Detail {
    /// Its name.
    pub name: String,
    /// The value, with its interval where it has one.
    #[serde(flatten, with = "estimate")]
    pub estimate: Estimate,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_need_the_whole_interval() {
        use ClaimVerdict::{Confirmed, Inconclusive, NotConfirmed};
        let same = Region::Within(0.95, 1.05);
        assert_eq!(same.verdict(0.95, 1.05), Confirmed);
        assert_eq!(same.verdict(0.90, 1.03), Inconclusive);
        assert_eq!(same.verdict(1.10, 1.30), NotConfirmed);
        assert_eq!(Region::Above(0.0).verdict(0.1, 0.3), Confirmed);
        assert_eq!(Region::Above(0.0).verdict(-0.1, 0.3), Inconclusive);
        assert_eq!(Region::Above(0.0).verdict(-0.1, 0.0), NotConfirmed);
        assert_eq!(Region::Below(0.1).verdict(0.1, 0.3), NotConfirmed);
    }

    #[test]
    fn missing_data_never_confirm() {
        let (nan, inf) = (f64::NAN, f64::INFINITY);
        for region in
            [Region::Within(0.0, 1.0), Region::Above(0.0), Region::Below(0.0)]
        {
            assert_eq!(region.verdict(nan, nan), ClaimVerdict::Inconclusive);
            assert_eq!(region.verdict(-inf, inf), ClaimVerdict::Inconclusive);
            assert!(!region.holds(nan));
        }
    }
}
