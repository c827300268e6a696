//! Digits of answers, against what can be attained.

use serde::Serialize;

use crate::answers::Answers;
use crate::diagnosis::{Diagnosis, diagnose};
use crate::reference::{Item, Value, reference};

/// The score of a code's answers, and what is wrong with the code.
#[derive(Clone, Debug, Serialize)]
pub struct Score {
    /// Version of the data set.
    pub data_set: &'static str,
    /// Quantities asked.
    pub asked: usize,
    /// Quantities answered.
    pub answered: usize,
    /// The five levels.
    pub levels: Vec<LevelScore>,
    /// What is wrong with the code.
    pub diagnosis: Diagnosis,
    /// Every quantity that was answered.
    pub quantities: Vec<QuantityScore>,
}

/// The score on a level of difficulty.
#[derive(Clone, Debug, Serialize)]
pub struct LevelScore {
    /// 1 to 5.
    pub level: u8,
    /// The level in words.
    pub kind: String,
    /// Numbers asked.
    pub asked: usize,
    /// Numbers answered.
    pub answered: usize,
    /// Median of the digits of the numbers answered.
    pub median_digits: Option<f64>,
    /// Fewest digits of the numbers answered.
    pub worst_digits: Option<f64>,
    /// Share of the numbers answered that have all digits that double
    /// precision can get.
    pub attained_share: Option<f64>,
    /// Fates that are right.
    pub fates_right: usize,
    /// Fates that are wrong.
    pub fates_wrong: usize,
    /// Fates that are missing.
    pub fates_missing: usize,
    /// Counts of impacts that are right.
    pub counts_right: usize,
    /// Counts of impacts that are wrong.
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
    /// -log10 of the relative error, from 0 to what can be attained; none
    /// of fates and counts.
    pub digits: Option<f64>,
    /// Digits that can be attained; none of fates and counts.
    pub attainable_digits: Option<f64>,
    /// True where the digits reach that, or a fate or count is right.
    pub attained: bool,
}

/// The score of a known code on a level, as the data set has it.
#[derive(Clone, Debug, PartialEq, serde::Deserialize)]
pub struct Code {
    /// Name of the code.
    pub code: String,
    /// `default`, as it is shipped, or `best`, the finest setting tried.
    pub setting: String,
    /// Version of the code, where it has one.
    pub version: String,
    /// 1 to 5.
    pub level: u8,
    /// Median of its digits.
    pub median_digits: f64,
    /// Its fewest digits.
    pub worst_digits: f64,
    /// Fates that are wrong.
    pub fates_wrong: usize,
    /// Fates that were answered.
    pub fates_answered: usize,
}

const CODES: &str = rocking_fixtures::text("benchmark/codes.csv");

/// The known codes that were scored, a line for each level.
///
/// # Panics
/// Never: the file is part of the program, and a test reads it.
#[must_use]
pub fn codes() -> Vec<Code> {
    let mut csv = csv::Reader::from_reader(CODES.as_bytes());
    let rows: Result<_, _> = csv.deserialize().collect();
    rows.unwrap_or_else(|e| panic!("fixtures/benchmark/codes.csv: {e}"))
}

fn quantity_score(item: &'static Item, value: &Value) -> QuantityScore {
    let exact = item.value.number().zip(value.number());
    // The least error that a double can show is 0; it has every digit.
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

/// Scores answers, and says what is wrong with the code.
#[must_use]
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
    let given: Vec<&QuantityScore> =
        numbers.filter_map(|(_, row)| row.as_ref()).collect();
    let mut digits: Vec<f64> =
        given.iter().filter_map(|row| row.digits).collect();
    digits.sort_by(f64::total_cmp);
    let attained = given.iter().filter(|row| row.attained).count();
    let any = !given.is_empty();
    let fate: fn(&Value) -> bool = |v| matches!(v, Value::Fate(_));
    let impacts: fn(&Value) -> bool = |v| matches!(v, Value::Count(_));
    LevelScore {
        level,
        kind: kind.unwrap_or_default(),
        asked,
        answered: given.len(),
        median_digits: any.then(|| middle(&digits)),
        worst_digits: digits.first().copied(),
        attained_share: any.then(|| attained as f64 / given.len() as f64),
        fates_right: count(fate, Some(true)),
        fates_wrong: count(fate, Some(false)),
        fates_missing: count(fate, None),
        counts_right: count(impacts, Some(true)),
        counts_wrong: count(impacts, Some(false)),
    }
}

/// The median of numbers in order.
fn middle(sorted: &[f64]) -> f64 {
    let n = sorted.len();
    0.5 * (sorted[(n - 1) / 2] + sorted[n / 2])
}
