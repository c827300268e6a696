//! Moves of numbers, against the smallest effect of interest and their
//! uncertainty.

use serde::Serialize;

use rocking_common::findings::{Effect, Unit};
use rocking_common::words::rounded;
use rocking_statistics::Estimate;

/// Relative unit of the ninth significant digit, the last one in the files.
pub const LAST_DIGIT: f64 = 1e-8;

/// With fewer records than this, a move is mainly due to chance.
const LEAST: usize = 30;

/// The move of a number.
#[derive(Clone, Debug, Serialize)]
pub struct NumberChange {
    /// Old and new value, with enough digits to differ.
    pub values: [String; 2],
    /// The change, relative to the old value or in the number's unit.
    pub change: f64,
    /// The change in words; empty if it is not a number.
    pub change_text: String,
    /// Its size over the limit: above 1 it matters.
    pub change_over_limit: f64,
    /// Its size over the half-widths of both intervals (root of the sum of
    /// squares). Runs of the same records vary together, so their change is
    /// more certain than this suggests.
    pub change_over_uncertainty: Option<f64>,
    /// Numbers of records or ratios behind the old and the new value.
    pub n: [Option<usize>; 2],
}

impl NumberChange {
    /// The move between an old and a new value; none if they are equal.
    /// `effect` is the smallest effect of interest, or none if no decision
    /// rests on the number; `n` are the numbers of records or ratios behind
    /// both values, if known.
    pub fn between(
        effect: Option<Effect>,
        unit: Unit,
        estimates: [Estimate; 2],
        n: [Option<usize>; 2],
    ) -> Option<Self> {
        let [a, b] = estimates.map(|estimate| estimate.value());
        if a == b || (a.is_nan() && b.is_nan()) {
            return None;
        }
        let (factor, unit, points) = match unit {
            Unit::Share => (100.0, " %", " points"),
            Unit::Points => (100.0, " points", " points"),
            _ => (1.0, "", ""),
        };
        let at = |digits| {
            [a, b].map(|x| match x.is_nan() {
                true => "none".into(),
                false => plain(factor * x, digits) + unit,
            })
        };
        let differ = |[a, b]: &[String; 2]| a != b;
        let (change, limit) = match effect {
            Some(Effect::Relative(limit)) => ((b - a) / a.abs(), limit),
            Some(Effect::Absolute(limit)) => (b - a, limit),
            None => (b - a, f64::INFINITY),
        };
        let change_text = match effect {
            _ if !change.is_finite() => String::new(),
            Some(Effect::Relative(_)) => percent(change),
            _ => signed(change, factor, points),
        };
        let over = change.abs() / (limit * (1.0 + LAST_DIGIT));
        let half =
            |e: Estimate| e.interval().map(|i| 0.5 * (i.high() - i.low()));
        let [old, new] = estimates.map(half);
        let u = old.zip(new).map(|(a, b)| (a * a + b * b).sqrt());
        let u = u.map(|u| (b - a).abs() / u);
        Some(Self {
            values: (3..17).map(at).find(differ).unwrap_or_else(|| at(17)),
            change,
            change_text,
            change_over_limit: if over.is_nan() {
                f64::INFINITY
            } else {
                over
            },
            change_over_uncertainty: u.filter(|u| u.is_finite()),
            n,
        })
    }

    /// Whether it matters.
    pub fn is_beyond(&self) -> bool {
        self.change_over_limit > 1.0
    }

    /// The key by which moves are sorted, the highest first: whether there are
    /// enough records, then the change over its uncertainty or, if that is
    /// unknown, over the limit.
    pub fn weight(&self) -> (bool, u64) {
        let few = self.n.iter().flatten().any(|n| *n < LEAST);
        let size = self.change_over_uncertainty;
        // Positive numbers are ordered as their bits are.
        (!few, size.unwrap_or(self.change_over_limit).to_bits())
    }

    /// The move in words: `2.31 -> 2.6, +13 %, u = 1.4, n = 86`.
    pub fn text(&self) -> String {
        let mut parts = vec![self.values.join(" -> ")];
        if !self.change_text.is_empty() {
            parts.push(self.change_text.clone());
        }
        let u = self.change_over_uncertainty;
        parts.extend(u.map(|u| format!("u = {}", plain(u, 2))));
        match self.n {
            [Some(a), Some(b)] if a != b => {
                parts.push(format!("n = {a} -> {b}"));
            }
            [_, b] => parts.extend(b.map(|n| format!("n = {n}"))),
        }
        parts.join(", ")
    }
}

/// A relative change as a percentage with its sign: `+12 %`.
pub fn percent(change: f64) -> String {
    match change == 0.0 {
        true => "unchanged".into(),
        false => signed(change, 100.0, " %"),
    }
}

fn signed(change: f64, factor: f64, unit: &str) -> String {
    let sign = if change > 0.0 { "+" } else { "" };
    format!("{sign}{}{unit}", plain(factor * change, 2))
}

/// A number with at most this many significant digits; a whole one with all.
pub fn plain(x: f64, digits: usize) -> String {
    let is_whole = x.fract() == 0.0;
    (if is_whole { x } else { rounded(x, digits) }).to_string()
}
