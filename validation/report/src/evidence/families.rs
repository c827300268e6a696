use crate::page::{Family, ShownCase};
use rocking_common::words::rounded;
use rocking_proof::cases::{Bound, Case, Cost, FAMILIES};
use rocking_proof::verdict::snapshot::{CaseResult, Results};

/// Declared cases with their results, as the snapshot has them: all but those
/// that are run only with `--full`.
#[must_use]
pub fn families(cases: &[Case], results: &Results) -> Vec<Family> {
    FAMILIES
        .iter()
        .map(|(name, _)| {
            let own = || {
                cases.iter().filter(|case| {
                    case.family == *name && case.cost == Cost::Quick
                })
            };
            Family {
                name: (*name).to_owned(),
                worst: worst_of(
                    own().filter_map(|case| results.get(&case.id)),
                ),
                rejected: own()
                    .filter_map(|case| results.get(&case.id))
                    .map(|result| result.rejected.len())
                    .sum(),
                cases: own().map(|case| shown(case, results)).collect(),
            }
        })
        .collect()
}

fn shown(case: &Case, results: &Results) -> ShownCase {
    let result = results.get(&case.id);
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
        worst: worst_of(result.into_iter()),
        rejects: rejects(case, result),
        passed: result.is_some_and(CaseResult::passed),
    }
}

/// The largest share of a tolerance, and the quantity that uses it.
fn worst_of<'a>(results: impl Iterator<Item = &'a CaseResult>) -> String {
    let worst = results
        .flat_map(CaseResult::compared)
        .map(|(name, q)| {
            let margin = q.margin.0;
            let known = if margin.is_nan() { f64::INFINITY } else { margin };
            (name.as_str(), known)
        })
        .max_by(|a, b| a.1.total_cmp(&b.1));
    match worst {
        None => "no result".into(),
        Some((_, 0.0)) => "no error".into(),
        Some((name, margin)) => {
            format!("{}, {name}", share(margin))
        }
    }
}

/// A share of a tolerance in per cent.
fn share(margin: f64) -> String {
    let percent = 100.0 * margin;
    if percent < 0.001 {
        "less than 0.001 %".into()
    } else if percent.is_finite() {
        format!("{} %", rounded(percent, 3))
    } else {
        "more than all".into()
    }
}

/// A number of times, with two digits.
fn times(margin: f64) -> String {
    if margin < 1e5 {
        format!("{} times", rounded(margin, 2))
    } else {
        format!("{margin:.1e} times")
    }
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
fn rejects(case: &Case, result: Option<&CaseResult>) -> String {
    let texts: Vec<String> = case
        .tolerance
        .reject
        .iter()
        .map(|wrong| wrong.name())
        .map(|name| {
            let by = result.and_then(|result| result.rejected.get(name));
            match by.map(|by| by.margin.0).filter(|x| x.is_finite()) {
                Some(margin) => format!("{name} ({})", times(margin)),
                // Infinite: a fate, a count or a side.
                None => name.to_owned(),
            }
        })
        .collect();
    texts.join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_proof::cases::load_all;

    #[test]
    fn shows_every_case_with_bound_and_rejections() {
        let cases = load_all().unwrap();
        let id = cases[0].id.clone();
        let of = |margin: f64| {
            serde_json::json!({
                "bound": 1.0,
                "first": [],
                "kind": "absolute",
                "margin": margin,
                "values": 1,
            })
        };
        let results = serde_json::json!({ id: {
            "kind": "regression",
            "method": "m",
            "oracle": "own-output",
            "verdict": "pass",
            "quantities": { "a": of(0.5), "b": of(0.25) },
            "rejected": {},
        } });
        let results = serde_json::from_value(results).unwrap();
        let shown = families(&cases, &results);
        let all: Vec<&ShownCase> =
            shown.iter().flat_map(|f| &f.cases).collect();
        let quick = cases.iter().filter(|c| c.cost == Cost::Quick).count();
        assert_eq!(all.len(), quick);
        assert!(all.iter().all(|c| !c.tolerance.is_empty()));
        assert!(all.iter().all(|c| !c.rejects.is_empty()));
        let first = all.iter().find(|c| c.id == cases[0].id).unwrap();
        assert!(first.passed);
        assert_eq!(first.worst, "50 %, a");
        // What has no result has not passed.
        let failed = all.iter().filter(|c| !c.passed).count();
        assert_eq!(failed, quick - 1);
    }
}
