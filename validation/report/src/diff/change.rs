//! Whether two values differ, and by how many of their uncertainties.

use serde::Serialize;

use super::item::{Content, Item, Limit};
use super::words::{pair, percent, plain};

/// Half width of a 95 % interval in standard errors of a normal variate.
const STANDARD_ERRORS: f64 = 1.959_963_985;

/// Unit of the ninth significant digit, relative: findings have no more.
const LAST_DIGIT: f64 = 1e-8;

/// What a change is measured by.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Standard errors: the part of the 95 % interval on the side of the
    /// change over 1.96.
    StandardErrors(f64),
    /// Shares of the declared tolerance.
    Tolerances(f64),
    /// The finding states no interval.
    NoInterval,
    /// The verdict of its case tells.
    Verdict,
    /// Not a number.
    #[default]
    None,
}

/// One thing that differs.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Change {
    /// What it belongs to.
    pub owner: String,
    /// Its name within the owner.
    pub name: String,
    /// What it is listed under.
    pub group: String,
    /// What it is, in words.
    #[serde(rename = "what")]
    pub words: String,
    /// Old value, with the digits that tell it from the new one.
    pub old: String,
    /// New value.
    pub new: String,
    /// Old and new value where they are numbers.
    pub values: Option<(f64, f64)>,
    /// Relative change, where the old value is not zero.
    pub relative: Option<f64>,
    /// What the change is measured by.
    pub measure: Measure,
    /// Change over what is allowed: above 1 is significant.
    #[serde(rename = "change_over_limit")]
    pub rank: f64,
    /// Whether it matters.
    pub significant: bool,
}

impl Change {
    /// The change from `old` to `new`, if there is one.
    pub(super) fn between(
        old: &Item,
        new: &Item,
        relative: f64,
    ) -> Option<Self> {
        match (&old.content, &new.content) {
            (
                Content::Number { value: a, limit },
                Content::Number { value: b, limit: after },
            ) => number(old, (*a, *b), (*limit, *after), relative),
            (a, b) => {
                let (a, b) = (text(a), text(b));
                let matters = !matches!(old.content, Content::Text(_));
                (a != b).then(|| Self {
                    old: a,
                    new: b,
                    rank: if matters { f64::INFINITY } else { 0.0 },
                    significant: matters,
                    ..blank(old)
                })
            }
        }
    }

    /// What the change is measured by, in words; empty where nothing is.
    pub fn measured(&self) -> String {
        match self.measure {
            Measure::StandardErrors(n) if n.is_infinite() => {
                "out of an interval that ends at the old value".into()
            }
            Measure::StandardErrors(n) => {
                format!("{} standard errors", plain(n, 2))
            }
            Measure::Tolerances(n) if n.is_infinite() => {
                "declared exact".into()
            }
            Measure::Tolerances(n) => {
                format!("{} of its tolerance", plain(n, 2))
            }
            Measure::NoInterval => "no interval stated".into(),
            Measure::Verdict => "its verdict tells".into(),
            Measure::None => String::new(),
        }
    }

    /// Old to new, relative change, measure.
    pub fn sentence(&self) -> String {
        let mut text = format!("{}: {} to {}", self.words, self.old, self.new);
        if let Some(relative) = self.relative {
            text += &format!(", {}", percent(relative));
        }
        let measured = self.measured();
        if !measured.is_empty() {
            text += &format!(", {measured}");
        }
        text
    }
}

fn blank(item: &Item) -> Change {
    Change {
        owner: item.owner.clone(),
        name: item.name.clone(),
        group: item.group.clone(),
        words: item.words.clone(),
        ..Change::default()
    }
}

fn text(content: &Content) -> String {
    match content {
        Content::Verdict(text)
        | Content::Setting(text)
        | Content::Text(text) => text.clone(),
        Content::Number { value, .. } => plain(*value, 9),
    }
}

fn number(
    item: &Item,
    (old, new): (f64, f64),
    (before, after): (Limit, Limit),
    relative: f64,
) -> Option<Change> {
    let same = old == new || (old.is_nan() && new.is_nan());
    if same {
        return None;
    }
    let change = new - old;
    let (a, b) = pair(old, new);
    let mut out =
        Change { old: a, new: b, values: Some((old, new)), ..blank(item) };
    out.relative =
        (change.is_finite() && old != 0.0).then(|| change / old.abs());
    let over = |limit: f64| {
        // Nothing to compare, or a limit of zero: as significant as can be.
        let rank = change.abs() / limit;
        if rank.is_nan() { f64::INFINITY } else { rank }
    };
    let digit = LAST_DIGIT * old.abs();
    (out.rank, out.measure) = match (before, after) {
        _ if !change.is_finite() => (f64::INFINITY, Measure::None),
        (Limit::Verdict, _) => (0.0, Measure::Verdict),
        (Limit::Interval(low, high), _) => {
            let end = if change > 0.0 { high - old } else { old - low };
            by_interval(&over, end, digit)
        }
        // The way back leads out of the new interval.
        (_, Limit::Interval(low, high)) => {
            let end = if change > 0.0 { new - low } else { high - new };
            by_interval(&over, end, digit)
        }
        (Limit::Tolerance(bound, unit), _) => {
            let rank = over(bound + unit);
            let times =
                if bound > 0.0 { change.abs() / bound } else { f64::INFINITY };
            (rank, Measure::Tolerances(times))
        }
        (Limit::None, _) => (over(relative * old.abs()), Measure::NoInterval),
    };
    out.significant = out.rank > 1.0;
    Some(out)
}

fn by_interval(
    over: &dyn Fn(f64) -> f64,
    end: f64,
    digit: f64,
) -> (f64, Measure) {
    let errors =
        if end > 0.0 { STANDARD_ERRORS * over(end) } else { f64::INFINITY };
    let end = if end > 0.0 { end } else { 0.0 };
    (over(end + digit), Measure::StandardErrors(errors))
}
