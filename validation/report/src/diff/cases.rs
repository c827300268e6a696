//! Results of declared cases as items.

use anyhow::{Context as _, bail};
use serde::Deserialize as _;

use super::item::{Content, Item};
use super::moved::{LAST_DIGIT, Limit, Number};
use rocking_common::json::Extended;
use rocking_proof::verdict::snapshot::{CaseResult, QuantityResult, Results};

/// The items of `validation.json`.
pub fn items(results: &Results) -> anyhow::Result<Vec<Item>> {
    let mut out = Vec::new();
    for (id, result) in results {
        case(&mut out, id, result).with_context(|| format!("case {id}"))?;
    }
    Ok(out)
}

fn case(
    out: &mut Vec<Item>,
    id: &str,
    result: &CaseResult,
) -> anyhow::Result<()> {
    let owner = format!("case {id}");
    let mut item = |name: &str, place: String, content| {
        out.push(Item {
            topic: "declared cases",
            owner: owner.clone(),
            name: format!("{name}{place}"),
            words: format!("{owner}{name}"),
            place,
            content,
        });
    };
    let none = String::new;
    let verdict = Content::Verdict(result.verdict.name().into());
    item("", none(), verdict);
    let models: Vec<&str> =
        result.rejected.keys().map(String::as_str).collect();
    let evidence = format!(
        "{}, {} against {}; rejects {}",
        result.kind.name(),
        result.method,
        result.oracle.name(),
        models.join(", ")
    );
    item(": evidence", none(), Content::Setting(evidence));
    for (name, q) in &result.quantities {
        let bound = format!("{} {}, {} values", q.kind, q.bound, q.values);
        let words = format!(": tolerance of {name}");
        item(&words, none(), Content::Setting(bound));
        for (k, value) in q.first.iter().enumerate() {
            let limit = limit(q, value.0).context(name.clone())?;
            let value = Number::new(value.0, limit);
            let place = format!("value {} of {}", k + 1, q.values);
            item(&format!(": {name}"), place, Content::Number(value));
        }
    }
    Ok(())
}

/// What a value may move by: its tolerance, and the last digit printed.
fn limit(q: &QuantityResult, value: f64) -> anyhow::Result<Limit> {
    let bound = || Extended::deserialize(&q.bound).map(|bound| bound.0);
    let digit = LAST_DIGIT * value.abs();
    Ok(match q.kind.as_str() {
        "exact" => Limit::Tolerance(0.0),
        "absolute" => Limit::Tolerance(bound()? + digit),
        "relative" => Limit::Tolerance(bound()? * value.abs() + digit),
        "order" | "coverage" | "interval" | "waived" => Limit::None,
        other => bail!(
            "found bound {other}, expected exact, absolute, relative, order, \
             coverage, interval or waived"
        ),
    })
}
