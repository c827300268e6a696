//! What was found: claims with measure, interval, margin and verdict.

use serde_json::{Map, Value, json};

use crate::draw::figures::data::Arm;
use crate::json::extended;
pub use crate::report::page::Verdict;

/// A measured value, with an interval where there is one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Measured {
    /// The value; NaN where there are no data.
    pub value: f64,
    /// 95 % interval.
    pub interval: Option<(f64, f64)>,
}

impl Measured {
    /// A value that is not a sample's: counted or computed exactly.
    #[must_use]
    pub fn exact(value: f64) -> Self {
        Self { value, interval: None }
    }

    fn ends(&self) -> (f64, f64) {
        self.interval.unwrap_or((self.value, self.value))
    }

    /// Claim: between `low` and `high`, ends included.
    #[must_use]
    pub fn within(&self, low: f64, high: f64) -> Verdict {
        let (a, b) = self.ends();
        if a >= low && b <= high {
            Verdict::Confirmed
        } else if b < low || a > high {
            Verdict::NotConfirmed
        } else {
            Verdict::Inconclusive
        }
    }

    /// Claim: above `limit`.
    #[must_use]
    pub fn above(&self, limit: f64) -> Verdict {
        let (a, b) = self.ends();
        if a > limit {
            Verdict::Confirmed
        } else if b <= limit {
            Verdict::NotConfirmed
        } else {
            Verdict::Inconclusive
        }
    }

    /// Claim: below `limit`.
    #[must_use]
    pub fn below(&self, limit: f64) -> Verdict {
        let (a, b) = self.ends();
        if b < limit {
            Verdict::Confirmed
        } else if a >= limit {
            Verdict::NotConfirmed
        } else {
            Verdict::Inconclusive
        }
    }
}

/// One claim of the paper, measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Claim {
    /// Short name: `stage-3-median-p1`.
    pub id: String,
    /// Section or figure of the paper.
    pub section: String,
    /// The paper's words.
    pub quote: String,
    /// Suite measured.
    pub suite: String,
    /// Blocks measured.
    pub blocks: String,
    /// Arm of the grid, where there is one.
    pub arm: Option<Arm>,
    /// What is measured.
    pub measure: String,
    /// What came out.
    pub measured: Measured,
    /// What counts as confirmed, decided beforehand.
    pub margin: String,
    /// What follows.
    pub verdict: Verdict,
    /// What else a reader must know; may be empty.
    pub note: String,
}

impl Claim {
    /// Unique among all claims: id, suite and arm.
    #[must_use]
    pub fn key(&self) -> String {
        let arm = self.arm.map_or(String::new(), |arm| {
            format!("-{}", arm.letter().to_lowercase())
        });
        format!("{}-{}{arm}", self.id, self.suite)
    }

    /// As JSON, keys sorted.
    #[must_use]
    pub fn json(&self) -> Value {
        let Measured { value, interval } = self.measured;
        json!({
            "id": self.key(),
            "section": self.section,
            "quote": self.quote,
            "suite": self.suite,
            "blocks": self.blocks,
            "arm": self.arm.map(Arm::letter),
            "measure": self.measure,
            "value": rounded(value),
            "interval": ends(interval),
            "margin": self.margin,
            "verdict": self.verdict.name(),
            "note": self.note,
        })
    }
}

/// A number rounded to nine significant digits: what a bound supports, and
/// no more than a reader compares.
#[must_use]
pub fn rounded(x: f64) -> Value {
    extended(format!("{x:.8e}").parse().unwrap_or(x))
}

/// The two ends of an interval, or null.
#[must_use]
pub fn ends(interval: Option<(f64, f64)>) -> Value {
    interval.map_or(Value::Null, |(a, b)| json!([rounded(a), rounded(b)]))
}

/// Standard normal quantile of 97.5 %.
const NORMAL_975: f64 = 1.959_963_984_540_054;

/// Wilson's 95 % interval of a share: `count` of `of` records, which are
/// independent of each other.
#[must_use]
pub fn wilson(count: usize, of: usize) -> (f64, f64) {
    let (n, z2) = (of as f64, NORMAL_975 * NORMAL_975);
    let share = count as f64 / n;
    let middle = (share + z2 / (2.0 * n)) / (1.0 + z2 / n);
    let spread = share * (1.0 - share) / n + z2 / (4.0 * n * n);
    let half = NORMAL_975 * spread.sqrt() / (1.0 + z2 / n);
    (middle - half, middle + half)
}

/// Everything that goes to `findings.json`, by name; keys are sorted.
pub type Findings = Map<String, Value>;

/// Text of `findings.json`: one value a line, keys sorted, a line break at
/// the end.
#[must_use]
pub fn text(findings: &Findings) -> String {
    let value = Value::Object(findings.clone());
    // Printing a value that is already JSON cannot fail.
    serde_json::to_string_pretty(&value).unwrap_or_default() + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn verdicts_need_the_whole_interval() {
        let m = |value, a, b| Measured { value, interval: Some((a, b)) };
        use Verdict::{Confirmed, Inconclusive, NotConfirmed};
        assert_eq!(m(1.0, 0.97, 1.03).within(0.95, 1.05), Confirmed);
        assert_eq!(m(1.0, 0.90, 1.03).within(0.95, 1.05), Inconclusive);
        assert_eq!(m(1.2, 1.10, 1.30).within(0.95, 1.05), NotConfirmed);
        assert_eq!(m(0.2, 0.1, 0.3).above(0.0), Confirmed);
        assert_eq!(m(0.2, -0.1, 0.3).above(0.0), Inconclusive);
        assert_eq!(m(0.2, 0.1, 0.3).below(0.1), NotConfirmed);
        assert_eq!(Measured::exact(0.1536).within(0.15, 0.16), Confirmed);
    }

    #[test]
    fn missing_data_never_confirm() {
        let m = Measured::exact(f64::NAN);
        assert_eq!(m.within(0.0, 1.0), Verdict::Inconclusive);
        assert_eq!(m.above(0.0), Verdict::Inconclusive);
        assert_eq!(m.below(0.0), Verdict::Inconclusive);
        assert_eq!(rounded(f64::NAN), Value::Null);
        assert_eq!(rounded(f64::INFINITY), Value::from("inf"));
        assert_eq!(rounded(1.0 / 3.0).to_string(), "0.333333333");
    }

    #[test]
    fn wilson_agrees_with_its_closed_ends_and_r() {
        // At 0 of n the upper end is z^2/(n + z^2).
        let (low, high) = wilson(0, 20);
        assert!(low.abs() < 1e-15 && (high - 0.161_125_158).abs() < 1e-8);
        // R 4: prop.test(5, 10, correct = FALSE).
        let (low, high) = wilson(5, 10);
        assert!((low - 0.236_593_1).abs() < 1e-7, "{low}");
        assert!((high - 0.763_406_9).abs() < 1e-7, "{high}");
    }

    #[test]
    fn text_has_sorted_keys() {
        let mut findings = Findings::new();
        findings.insert("b".into(), json!({"z": 1, "a": 2}));
        findings.insert("a".into(), json!([1.5]));
        let expected = "{\n  \"a\": [\n    1.5\n  ],\n  \"b\": {\n    \
                        \"a\": 2,\n    \"z\": 1\n  }\n}\n";
        assert_eq!(text(&findings), expected);
    }
}
