use std::collections::BTreeSet;

use serde_json::{Map, Value};

use crate::proof::cases::{Bound, Case, Cost, FAMILIES};
use crate::report::page::{Family, ShownCase};

/// Declared cases with their results, as the snapshot has them: all but those
/// that are run only with `--full`.
#[must_use]
pub fn families(cases: &[Case], results: &Map<String, Value>) -> Vec<Family> {
    FAMILIES
        .iter()
        .map(|(name, _)| {
            let own = || {
                cases.iter().filter(|case| {
                    case.family == *name && case.cost == Cost::Quick
                })
            };
            let kinds: BTreeSet<&str> =
                own().map(|case| case.kind.name()).collect();
            let kinds: Vec<&str> = kinds.into_iter().collect();
            Family {
                name: (*name).to_owned(),
                purpose: kinds.join(", "),
                cases: own().map(|case| shown(case, results)).collect(),
            }
        })
        .collect()
}

fn shown(case: &Case, results: &Map<String, Value>) -> ShownCase {
    let result = results.get(&case.id).unwrap_or(&Value::Null);
    let worst = worst(result);
    let (error, margin) = match &worst {
        Some((quantity, margin)) => {
            (format!("largest in {quantity}"), format!("{margin:.0e}"))
        }
        None => ("no result".to_owned(), String::new()),
    };
    let source = &case.source;
    let note = if source.note.is_empty() {
        String::new()
    } else {
        format!("; {}", source.note)
    };
    ShownCase {
        id: case.id.clone(),
        claim: case.claim.clone(),
        source: format!("{}, {}{note}", source.cite, source.place),
        tolerance: tolerance(case),
        because: case.tolerance.because.clone(),
        error,
        margin,
        rejects: rejects(case, result),
        passed: result["verdict"] == "pass",
    }
}

/// The quantity with the largest margin.
fn worst(result: &Value) -> Option<(&str, f64)> {
    let quantities = result["quantities"].as_object()?;
    quantities
        .iter()
        .map(|(name, q)| {
            let margin = q["margin"].as_f64().unwrap_or(f64::INFINITY);
            (name.as_str(), margin)
        })
        .max_by(|a, b| a.1.total_cmp(&b.1))
}

/// Bounds in words, equal ones together.
fn tolerance(case: &Case) -> String {
    let mut groups: Vec<(String, Vec<&str>)> = Vec::new();
    for (quantity, bound) in &case.tolerance.bounds {
        let words = words(bound);
        match groups.iter_mut().find(|(text, _)| *text == words) {
            Some((_, names)) => names.push(quantity),
            None => groups.push((words, vec![quantity])),
        }
    }
    let texts: Vec<String> = groups
        .iter()
        .map(|(words, names)| format!("{}: {words}", names.join(", ")))
        .collect();
    format!("{}.", texts.join("; "))
}

fn words(bound: &Bound) -> String {
    match bound {
        Bound::Exact => "exact".to_owned(),
        Bound::Absolute(x) => format!("{x:.1e} absolute"),
        Bound::Relative(x) => format!("{x:.1e} relative"),
        Bound::Interval(low, high) => format!("{low} to {high}"),
        Bound::Order(slack) => format!("order, less {slack}"),
        Bound::Coverage(trials) => format!("coverage in {trials} trials"),
        Bound::Waived(reason) => format!("waived ({reason})"),
    }
}

/// Wrong models that fail the case, each with its error over the bound.
fn rejects(case: &Case, result: &Value) -> String {
    let texts: Vec<String> = case
        .tolerance
        .reject
        .iter()
        .map(|wrong| wrong.name())
        .map(|name| match result["rejected"][name]["margin"].as_f64() {
            Some(margin) => format!("{name} ({margin:.0e})"),
            // Infinite: a fate, a count or a side.
            None => name.to_owned(),
        })
        .collect();
    texts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::proof::cases::load_all;

    #[test]
    fn shows_every_case_with_bound_and_rejections() {
        let cases = load_all().unwrap();
        let id = cases[0].id.clone();
        let results = serde_json::json!({ id: {
            "verdict": "pass",
            "quantities": { "a": { "margin": 0.5 }, "b": { "margin": 0.25 } },
            "rejected": {},
        } });
        let shown = families(&cases, results.as_object().unwrap());
        let all: Vec<&ShownCase> =
            shown.iter().flat_map(|f| &f.cases).collect();
        let quick = cases.iter().filter(|c| c.cost == Cost::Quick).count();
        assert_eq!(all.len(), quick);
        assert!(all.iter().all(|c| !c.tolerance.is_empty()));
        assert!(all.iter().all(|c| !c.rejects.is_empty()));
        let first = all.iter().find(|c| c.id == cases[0].id).unwrap();
        assert!(first.passed && first.margin == "5e-1");
        assert_eq!(first.error, "largest in a");
        // What has no result has not passed.
        let failed = all.iter().filter(|c| !c.passed).count();
        assert_eq!(failed, quick - 1);
    }
}
