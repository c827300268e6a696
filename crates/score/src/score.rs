//! Digits of answers, compared with the digits that can be reached.

use serde::Serialize;

use crate::answers::Answers;
use crate::diagnosis::{Diagnosis, diagnose};
use crate::reference::{Item, Value, reference};

/// The score of a code's answers, and the diagnosis of the code.
#[derive(Clone, Debug, Serialize)]
pub struct Score {
    /// Version of the data set.
    pub data_set: &'static str,
    /// Number of quantities in the data set.
    pub asked: usize,
    /// Number of quantities answered.
    pub answered: usize,
    /// The five levels.
    pub levels: Vec<LevelScore>,
    /// The diagnosis of the code.
    pub diagnosis: Diagnosis,
    /// Every quantity that was answered.
    pub quantities: Vec<QuantityScore>,
}

impl Score {
    /// Median of the digits of all numbers answered, if there are any.
    ///
    /// ```
    /// let score = rocking_score::score(&rocking_score::own_answers()?);
    /// assert!(score.median_digits() > Some(13.0));
    /// # Ok::<(), String>(())
    /// ```
    pub fn median_digits(&self) -> Option<f64> {
        middle(&sorted_digits(self.quantities.iter()))
    }
}

/// The score on a level of difficulty.
#[derive(Clone, Debug, Serialize)]
pub struct LevelScore {
    /// 1 to 5.
    pub level: u8,
    /// The level in words.
    pub kind: String,
    /// Count of numbers in the data set.
    pub asked: usize,
    /// Count of numbers answered.
    pub answered: usize,
    /// Median of the digits of the numbers answered.
    pub median_digits: Option<f64>,
    /// Fewest digits of the numbers answered.
    pub worst_digits: Option<f64>,
    /// Share of the numbers answered that have all digits that double
    /// precision can reach.
    pub attained_share: Option<f64>,
    /// Number of right outcomes.
    pub fates_right: usize,
    /// Number of wrong outcomes.
    pub fates_wrong: usize,
    /// Number of missing outcomes.
    pub fates_missing: usize,
    /// Number of right counts of impacts.
    pub counts_right: usize,
    /// Number of wrong counts of impacts.
    pub counts_wrong: usize,
}

/// The score of one quantity.
#[derive(Clone, Debug, Serialize)]
pub struct QuantityScore {
    /// The scene.
    pub scene: &'static str,
    /// The quantity.
    pub quantity: &'static str,
    /// The answer.
    pub value: Value,
    /// The certified value, as a double.
    pub certified: &'static Value,
    /// -log10 of the relative error, from 0 to `attainable_digits`; `None` for
    /// outcomes and counts.
    pub digits: Option<f64>,
    /// Digits that double precision can reach; `None` for outcomes and counts.
    pub attainable_digits: Option<f64>,
    /// True if the digits reach this number, or if an outcome or a count is
    /// right.
    pub attained: bool,
}

/// The score of a known code on a level, as the data set has it.
#[derive(Clone, Debug, PartialEq, serde::Deserialize)]
pub struct Code {
    /// Name of the code.
    pub code: String,
    /// `default`, as delivered, or `best`, the finest setting tried.
    pub setting: String,
    /// Version of the code, if it has one.
    pub version: String,
    /// 1 to 5.
    pub level: u8,
    /// Median of its digits.
    pub median_digits: f64,
    /// Its fewest digits.
    pub worst_digits: f64,
    /// Number of wrong outcomes.
    pub fates_wrong: usize,
    /// Number of outcomes answered.
    pub fates_answered: usize,
}

const CODES: &str = rocking_fixtures::text("benchmark/codes.csv");

/// The known codes that were scored, a line for each level.
///
/// # Panics
/// Never: the file is part of the program, and a test reads it.
pub fn codes() -> Vec<Code> {
    let mut csv = csv::Reader::from_reader(CODES.as_bytes());
    let rows: Result<_, _> = csv.deserialize().collect();
    rows.unwrap_or_else(|e| panic!("fixtures/benchmark/codes.csv: {e}"))
}

fn quantity_score(item: &'static Item, value: &Value) -> QuantityScore {
    let exact = item.value.number().zip(value.number());
    // An error of 0 has every digit.
    let found = exact.map(|(c, x)| -libm::log10(((x - c) / c).abs()));
    let cap = item.attainable;
    let attained = match (found, cap) {
        (Some(digits), Some(cap)) => digits >= cap,
        _ => *value == item.value,
    };
    QuantityScore {
        scene: &reference().scene(item).name,
        quantity: &item.quantity,
        value: value.clone(),
        certified: &item.value,
        digits: found
            .zip(cap)
            .map(|(digits, cap)| digits.clamp(0.0, cap) + 0.0),
        attainable_digits: cap,
        attained,
    }
}

/// Scores answers, and diagnoses the code.
pub fn score(answers: &Answers) -> Score {
    let set = reference();
    let mut levels = Vec::new();
    let mut quantities = Vec::new();
    for level in 1..=5 {
        let items = set.items.iter().enumerate();
        let items = items.filter(|(_, item)| set.scene(item).level == level);
        let rows = items.map(|(place, item)| {
            let value = answers.get(place);
            (item, value.map(|value| quantity_score(item, value)))
        });
        let rows: Vec<_> = rows.collect();
        levels.push(level_score(level, &rows));
        quantities.extend(rows.into_iter().filter_map(|(_, row)| row));
    }
    Score {
        data_set: "1",
        asked: set.items.len(),
        answered: quantities.len(),
        levels,
        diagnosis: diagnose(answers, &[]),
        quantities,
    }
}

fn level_score(
    level: u8,
    rows: &[(&Item, Option<QuantityScore>)],
) -> LevelScore {
    let kind =
        rows.first().map(|(item, _)| reference().scene(item).kind.clone());
    let of = |wanted: fn(&Value) -> bool| {
        rows.iter().filter(move |(item, _)| wanted(&item.value))
    };
    let count = |wanted: fn(&Value) -> bool, right: Option<bool>| {
        let found = of(wanted).map(|(_, row)| row.as_ref());
        found.filter(|row| row.map(|row| row.attained) == right).count()
    };
    let numbers = of(|v| matches!(v, Value::Number(_)));
    let asked = numbers.clone().count();
    let given = numbers.filter_map(|(_, row)| row.as_ref());
    let digits = sorted_digits(given.clone());
    let answered = given.clone().count();
    let attained = given.filter(|row| row.attained).count();
    let fate: fn(&Value) -> bool = |v| matches!(v, Value::Fate(_));
    let impacts: fn(&Value) -> bool = |v| matches!(v, Value::Count(_));
    LevelScore {
        level,
        kind: kind.unwrap_or_default(),
        asked,
        answered,
        median_digits: middle(&digits),
        worst_digits: digits.first().copied(),
        attained_share: (answered > 0)
            .then(|| attained as f64 / answered as f64),
        fates_right: count(fate, Some(true)),
        fates_wrong: count(fate, Some(false)),
        fates_missing: count(fate, None),
        counts_right: count(impacts, Some(true)),
        counts_wrong: count(impacts, Some(false)),
    }
}

/// The digits of answers, in order.
fn sorted_digits<'a>(
    answers: impl Iterator<Item = &'a QuantityScore>,
) -> Vec<f64> {
    let mut digits: Vec<f64> = answers.filter_map(|row| row.digits).collect();
    digits.sort_by(f64::total_cmp);
    digits
}

/// The median of numbers in order, if there are any.
fn middle(sorted: &[f64]) -> Option<f64> {
    let n = sorted.len();
    let low = sorted.get(n.checked_sub(1)? / 2)?;
    Some(0.5 * (low + sorted[n / 2]))
}
