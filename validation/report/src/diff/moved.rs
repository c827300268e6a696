//! How far numbers moved, against what matters.

use std::collections::BTreeMap;

use serde::Serialize;

use rocking_common::findings::{Effect, Unit};
use rocking_common::words::rounded;
use rocking_study::estimates::median;

/// Unit of the ninth significant digit, relative: files have no more.
pub const LAST_DIGIT: f64 = 1e-8;

/// A number of a result.
#[derive(Clone, Debug)]
pub struct Number {
    /// The value; NaN where there is none.
    pub value: f64,
    /// What it may move by.
    pub limit: Limit,
    /// Frequency parameter of the block, in rad/s, where there is one.
    pub p_rad_s: Option<f64>,
    /// The cell that decides, where one of many does.
    pub decided_at: String,
}

impl Number {
    /// A number of no block, and of no cell among many.
    pub fn new(value: f64, limit: Limit) -> Self {
        Self { value, limit, p_rad_s: None, decided_at: String::new() }
    }
}

/// What a number may move by before that matters.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// The smallest effect of interest; and the unit of the number.
    Effect(Effect, Unit),
    /// A declared tolerance.
    Tolerance(f64),
    /// None: a verdict or a share beside it says whether it matters.
    None,
}

impl Limit {
    /// The smallest effect of interest, where there is one.
    pub fn of(effect: Option<Effect>, unit: Unit) -> Self {
        effect.map_or(Self::None, |effect| Self::Effect(effect, unit))
    }

    /// The change from `old` to `new`; NaN where only one is a number.
    fn change(self, old: f64, new: f64) -> f64 {
        let same = old == new || (old.is_nan() && new.is_nan());
        match self {
            _ if same => 0.0,
            Self::Effect(Effect::Relative(_), _) => (new - old) / old.abs(),
            _ => new - old,
        }
    }

    /// The size of a change over the limit; infinite for NaN.
    fn over(self, change: f64) -> f64 {
        let limit = match self {
            Self::Effect(Effect::Relative(x) | Effect::Absolute(x), _)
            | Self::Tolerance(x) => x,
            Self::None => return 0.0,
        };
        let over = change.abs() / (limit * (1.0 + LAST_DIGIT));
        if over.is_nan() && change != 0.0 { f64::INFINITY } else { over }
    }

    /// A change in words: `+12 %`, `-3 points`, `+0.06`; empty where it is
    /// no number or its size says nothing.
    fn change_text(self, change: f64) -> String {
        let (factor, unit) = match self {
            Self::Effect(Effect::Relative(_), _) => (100.0, " %"),
            Self::Effect(_, Unit::Share | Unit::Points) => (100.0, " points"),
            Self::Effect(..) => (1.0, ""),
            Self::Tolerance(_) | Self::None => return String::new(),
        };
        if !change.is_finite() {
            return String::new();
        }
        signed(change, factor, unit)
    }

    /// The limit in words.
    fn words(self) -> String {
        match self {
            Self::Effect(Effect::Relative(x) | Effect::Absolute(x), _) => {
                self.change_text(x).replace('+', "")
            }
            Self::Tolerance(_) => "the tolerance".into(),
            Self::None => String::new(),
        }
    }

    /// Two values with as few digits as tell them apart, three at least.
    fn pair(self, old: f64, new: f64) -> (String, String) {
        let (factor, unit) = match self {
            Self::Effect(_, Unit::Share) => (100.0, " %"),
            Self::Effect(_, Unit::Points) => (100.0, " points"),
            _ => (1.0, ""),
        };
        let text = |x: f64, digits| plain(factor * x, digits) + unit;
        let at = |digits| (text(old, digits), text(new, digits));
        (3..17).map(at).find(|(a, b)| a != b).unwrap_or_else(|| at(17))
    }
}

/// A share of a number as a percentage with its sign: `+12 %`.
pub fn percent(share: f64) -> String {
    signed(share, 100.0, " %")
}

fn signed(change: f64, factor: f64, unit: &str) -> String {
    let sign = if change > 0.0 { "+" } else { "" };
    format!("{sign}{}{unit}", plain(factor * change, 2))
}

/// A number with at most so many significant digits; "none" for NaN.
fn plain(x: f64, digits: usize) -> String {
    let whole = x.fract() == 0.0 && x.abs() < 1e9;
    let value = if whole { x } else { rounded(x, digits) };
    match value {
        _ if x.is_nan() => "none".into(),
        _ if value == 0.0 || (1e-4..1e9).contains(&value.abs()) => {
            value.to_string()
        }
        _ if x.is_infinite() => value.to_string(),
        _ => format!("{value:e}"),
    }
}

/// One number that moved.
#[derive(Clone, Debug, Serialize)]
pub struct Moved {
    /// The cell.
    pub at: String,
    /// Old value, with the digits that tell it from the new one.
    pub old: String,
    /// New value.
    pub new: String,
    /// The change: a part of the old value, or in the number's unit.
    pub change: f64,
    /// Its size over the limit: above 1 it matters.
    pub change_over_limit: f64,
}

/// Numbers of one kind: a quantity in all its cells.
#[derive(Clone, Debug, Serialize)]
pub struct Kind {
    /// What they are about.
    pub topic: &'static str,
    /// What they are.
    pub what: String,
    /// Cells that are compared.
    pub cells: usize,
    /// What one of them may move by, in words.
    pub limit: String,
    /// Median change over the cells.
    pub median_change: f64,
    /// The same by the frequency parameter, in words.
    pub by_p: Vec<(String, f64)>,
    /// Those that moved, the furthest over its limit first.
    pub moved: Vec<Moved>,
    /// Cells that decided before and no longer do: other cells do, and
    /// values of different cells are not compared.
    pub decided_elsewhere: Vec<String>,
    #[serde(skip)]
    measure: Limit,
    #[serde(skip)]
    changes: Vec<(Option<f64>, f64)>,
}

impl Kind {
    /// A kind without numbers yet.
    pub fn new(topic: &'static str, what: &str, measure: Limit) -> Self {
        Self {
            topic,
            what: what.into(),
            cells: 0,
            limit: measure.words(),
            median_change: 0.0,
            by_p: Vec::new(),
            moved: Vec::new(),
            decided_elsewhere: Vec::new(),
            measure,
            changes: Vec::new(),
        }
    }

    /// Adds the number of a cell.
    pub fn add(&mut self, at: &str, old: &Number, new: &Number) {
        if old.decided_at != new.decided_at {
            let (old, new) = (&old.decided_at, &new.decided_at);
            self.decided_elsewhere.push(format!("{at}: {old}; now {new}"));
            return;
        }
        self.cells += 1;
        let change = new.limit.change(old.value, new.value);
        self.changes.push((new.p_rad_s, change));
        if change == 0.0 {
            return;
        }
        let (a, b) = new.limit.pair(old.value, new.value);
        let named = [at, &old.decided_at].into_iter();
        let named: Vec<&str> = named.filter(|n| !n.is_empty()).collect();
        self.moved.push(Moved {
            at: named.join(", "),
            old: a,
            new: b,
            change,
            change_over_limit: new.limit.over(change),
        });
    }

    /// Takes the medians; whether anything moved.
    pub fn finish(&mut self) -> bool {
        let mut by_p: BTreeMap<u64, Vec<f64>> = BTreeMap::new();
        for (p, change) in &self.changes {
            // Positive numbers are ordered as their bits are.
            let Some(p) = p else { continue };
            by_p.entry(p.to_bits()).or_default().push(*change);
        }
        let named = |(p, changes): (u64, Vec<f64>)| {
            (format!("p = {}", f64::from_bits(p)), median(&changes).value)
        };
        self.by_p = by_p.into_iter().map(named).collect();
        let all: Vec<f64> = self.changes.iter().map(|(_, x)| *x).collect();
        self.median_change = median(&all).value;
        let over = |moved: &Moved| moved.change_over_limit;
        self.moved.sort_by(|a, b| over(b).total_cmp(&over(a)));
        !self.moved.is_empty() || !self.decided_elsewhere.is_empty()
    }

    /// Numbers that moved by more than they may.
    pub fn beyond(&self) -> usize {
        self.moved.iter().filter(|m| m.change_over_limit > 1.0).count()
    }

    /// The median change over its limit, then the largest: what is larger
    /// matters more.
    pub fn weight(&self) -> (f64, f64) {
        let most = self.moved.first().map_or(0.0, |m| m.change_over_limit);
        (self.measure.over(self.median_change), most)
    }

    /// One of the numbers that moved, in words.
    pub fn one(&self, moved: &Moved) -> String {
        let Moved { at, old, new, change, .. } = moved;
        let parts = [
            if at.is_empty() { String::new() } else { format!("{at}: ") },
            format!("{old} to {new}"),
            match self.measure.change_text(*change) {
                text if text.is_empty() => text,
                text => format!(", {text}"),
            },
        ];
        parts.concat()
    }

    /// What moved, in two lines: the median over the cells, that by p, how
    /// many are beyond the limit; the furthest.
    pub fn sentence(&self) -> String {
        let Self { what, limit, cells, .. } = self;
        let most = self.moved.first().map(|m| self.one(m)).unwrap_or_default();
        let beyond = self.beyond();
        if *cells == 1 {
            let beyond = if beyond == 0 { "within" } else { "beyond" };
            return format!("{what}\n{most}, {beyond} {limit}");
        }
        let text = |change: f64| self.measure.change_text(change);
        let by_p = self.by_p.iter().map(|(p, x)| format!("{p}: {}", text(*x)));
        let by_p = match self.by_p.len() {
            0 | 1 => String::new(),
            _ => format!(" ({})", by_p.collect::<Vec<_>>().join(", ")),
        };
        let middle = match text(self.median_change).as_str() {
            "" => String::new(),
            text => format!(" {text}{by_p};"),
        };
        let cells = match beyond {
            0 if limit.is_empty() => format!("{cells} cells"),
            0 => format!("within {limit} in all {cells} cells"),
            _ => format!("beyond {limit} in {beyond} of {cells} cells"),
        };
        format!("{what}:{middle} {cells}\nmost {most}")
    }
}
