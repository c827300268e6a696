//! Results of declared cases as items.

use serde::Deserialize as _;
use serde_json::{Map, Value};

use super::flaw::{amount, flaw};
use super::item::{Content, Item, Limit};
use rocking_proof::verdict::snapshot::{
    CaseResult, QuantityResult, supported_digits,
};

/// The items of `validation.json`.
pub fn items(map: &Map<String, Value>) -> anyhow::Result<Vec<Item>> {
    let mut out = Vec::new();
    for (id, value) in map {
        let result = CaseResult::deserialize(value).map_err(|e| {
            flaw(
                &format!("case {id}"),
                &e.to_string(),
                "kind, method, oracle, quantities, rejected and verdict",
            )
        })?;
        add(&mut out, id, result)?;
    }
    Ok(out)
}

fn add(
    out: &mut Vec<Item>,
    id: &str,
    entry: CaseResult,
) -> anyhow::Result<()> {
    let family = id.split('/').next().unwrap_or(id).to_owned();
    let owner = format!("case {id}");
    let mut item = |name: String, words: String, content| {
        let group = format!("cases: {family}");
        out.push(Item { owner: owner.clone(), name, group, words, content });
    };
    let evidence = format!(
        "{}, {} against {}",
        entry.kind.name(),
        entry.method,
        entry.oracle.name()
    );
    let verdict = entry.verdict.name().to_owned();
    item("verdict".into(), owner.clone(), Content::Verdict(verdict));
    item(
        "evidence".into(),
        format!("{owner}: evidence"),
        Content::Setting(evidence),
    );
    let models: Vec<&str> =
        entry.rejected.keys().map(String::as_str).collect();
    item(
        "rejects".into(),
        format!("{owner}: wrong models"),
        Content::Setting(models.join(", ")),
    );
    for (model, by) in &entry.rejected {
        let value = by.margin.0;
        item(
            format!("rejects {model}"),
            format!("{owner}: error of {model} in {} over bound", by.quantity),
            Content::Number { value, limit: Limit::Verdict },
        );
    }
    for (name, q) in entry.quantities {
        let place = format!("{id}, {name}");
        let bound = bound(&place, &q)?;
        item(
            format!("{name} bound"),
            format!("{owner}: tolerance of {name}"),
            Content::Setting(format!("{} {}", q.kind, q.bound)),
        );
        item(
            format!("{name} values"),
            format!("{owner}: number of values of {name}"),
            Content::Number {
                value: q.values as f64,
                limit: Limit::Tolerance(0.0, 0.0),
            },
        );
        item(
            format!("{name} margin"),
            format!("{owner}: error of {name} over tolerance"),
            Content::Number { value: q.margin.0, limit: Limit::Verdict },
        );
        let first: Vec<f64> = q.first.iter().map(|value| value.0).collect();
        let digits = digits(&q.kind, bound, &first);
        for (k, value) in first.into_iter().enumerate() {
            let unit = unit(value, digits);
            let limit = match q.kind.as_str() {
                "exact" => Limit::Tolerance(0.0, 0.0),
                "absolute" => Limit::Tolerance(bound, unit),
                "relative" => Limit::Tolerance(bound * value.abs(), unit),
                _ => Limit::Verdict,
            };
            let which = if q.values > 1 {
                format!(", value {} of {}", k + 1, q.values)
            } else {
                String::new()
            };
            item(
                format!("{name} {k}"),
                format!("{owner}: {name}{which}"),
                Content::Number { value, limit },
            );
        }
    }
    Ok(())
}

/// The tolerance where it is one number; zero where it is none.
fn bound(place: &str, q: &QuantityResult) -> anyhow::Result<f64> {
    match (q.kind.as_str(), &q.bound) {
        ("exact" | "absolute" | "relative" | "order" | "coverage", b) => {
            amount(place, b)
        }
        ("interval", Value::Array(ends)) if ends.len() == 2 => Ok(0.0),
        ("waived", Value::Null) => Ok(0.0),
        (kind, bound) => Err(flaw(
            &format!("{place}, bound"),
            &format!("{kind} {bound}"),
            "exact, absolute, relative, order or coverage with a number, \
             interval with two, or waived with none",
        )),
    }
}

/// Significant digits that were printed of these values.
fn digits(kind: &str, bound: f64, values: &[f64]) -> usize {
    let largest = values.iter().fold(0.0_f64, |a, x| a.max(x.abs()));
    supported_digits(match kind {
        "relative" => bound,
        "absolute" if largest > 0.0 => bound / largest,
        "exact" => 0.0,
        _ => 1e-3,
    })
}

/// Unit of the last of so many significant digits.
fn unit(value: f64, digits: usize) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return 0.0;
    }
    let text = format!("{value:e}");
    let exponent: i64 =
        text.split('e').nth(1).and_then(|e| e.parse().ok()).unwrap_or(0);
    let last = exponent + 1 - digits as i64;
    format!("1e{last}").parse().unwrap_or(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn unit_of_the_last_digit() {
        assert_eq!(digits("absolute", 5e-4, &[14.7, 14.641]), 5);
        assert_eq!(digits("relative", 1e-12, &[0.5]), 9);
        assert_eq!(digits("exact", 0.0, &[7.0]), 9);
        assert_eq!(unit(14.697, 5), 1e-3);
        assert_eq!(unit(-0.0817, 3), 1e-4);
        assert_eq!(unit(1.0, 9), 1e-8);
        assert_eq!(unit(0.0, 9), 0.0);
    }
}
