//! The results of a run as the committed snapshot has them: sorted by id,
//! rounded to the digits that the bounds support, one value a line.

use serde_json::{Map, Value, json};

use super::{Check, Outcome};
use rocking_common::words::rounded;

use crate::cases::{Bound, Case};
use rocking_common::json;

/// Most digits printed of any number.
const MOST_DIGITS: usize = 9;
/// Values printed of a list.
const MOST_VALUES: usize = 3;

/// The snapshot's text, ending in a line feed.
#[must_use]
pub fn text(cases: &[Case], outcomes: &[Outcome]) -> String {
    let mut map = Map::new();
    for outcome in outcomes {
        if let Some(case) = cases.iter().find(|c| c.id == outcome.id) {
            map.insert(outcome.id.clone(), entry(case, outcome));
        }
    }
    let mut text = format!("{:#}", Value::Object(map));
    text.push('\n');
    text
}

fn entry(case: &Case, outcome: &Outcome) -> Value {
    let mut quantities = Map::new();
    for check in &outcome.checks {
        quantities.insert(check.quantity.clone(), quantity(check));
    }
    let mut rejected = Map::new();
    for rejection in &outcome.rejections {
        let by = json!({
            "margin": json::extended(rounded(rejection.margin, 1)),
            "quantity": rejection.quantity,
        });
        rejected.insert(rejection.model.to_owned(), by);
    }
    json!({
        "kind": case.kind.name(),
        "method": case.method,
        "oracle": case.expect.oracle.name(),
        "verdict": outcome.verdict.name(),
        "quantities": quantities,
        "rejected": rejected,
    })
}

fn quantity(check: &Check) -> Value {
    let digits = digits(check);
    let shown = check.observed.iter().take(MOST_VALUES);
    let values: Vec<f64> = shown.map(|x| rounded(*x, digits)).collect();
    let bound = match &check.bound {
        Bound::Absolute(x) | Bound::Relative(x) | Bound::Order(x) => {
            json::extended(*x)
        }
        Bound::Interval(low, high) => json::all_extended(&[*low, *high]),
        Bound::Coverage(trials) => json!(trials),
        Bound::Waived(_) => Value::Null,
        Bound::Exact => json!(0),
    };
    json!({
        "kind": check.bound.kind(),
        "bound": bound,
        "values": check.observed.len(),
        "first": json::all_extended(&values),
        // An error at the rounding level moves with every change of the
        // code: its size is told, not its digits.
        "margin": json::extended(rounded(check.margin, 1)),
    })
}

/// Significant digits that the bound supports.
fn digits(check: &Check) -> usize {
    let largest = check
        .observed
        .iter()
        .fold(0.0, |a: f64, x| if x.abs() > a { x.abs() } else { a });
    let relative = match check.bound {
        Bound::Relative(x) => x,
        Bound::Absolute(x) if largest > 0.0 => x / largest,
        Bound::Exact => 0.0,
        _ => 1e-3,
    };
    supported_digits(relative)
}

/// Significant digits that are printed of a number known to so large a share
/// of itself.
#[must_use]
pub fn supported_digits(relative: f64) -> usize {
    let mut digits = 1;
    let mut unit = 0.1;
    while digits < MOST_DIGITS && relative < unit {
        digits += 1;
        unit *= 0.1;
    }
    digits
}
