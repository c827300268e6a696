use rocking_common::words::rounded;
use rocking_proof::cases::{Bound, Case, Cost, FAMILIES};
use rocking_proof::verdict::snapshot::{CaseResult, Results};

/// Declared cases of one kind, each with its result if there is one.
#[derive(Clone, Debug)]
pub struct Family {
    /// Name: `free-rocking`.
    pub name: &'static str,
    /// The cases.
    pub cases: Vec<(Case, Option<CaseResult>)>,
}

impl Family {
    /// The results that there are.
    pub fn results(&self) -> impl Iterator<Item = &CaseResult> {
        self.cases.iter().filter_map(|(_, result)| result.as_ref())
    }
}

/// Declared cases with their results, as the snapshot has them: all but those
/// that are run only with `--full`.
pub fn families(cases: &[Case], results: &Results) -> Vec<Family> {
    let quick = |name: &str| {
        let own = cases.iter().filter(|c| c.family == name);
        let quick = own.filter(|c| c.cost == Cost::Quick);
        quick.map(|c| (c.clone(), results.get(&c.id).cloned())).collect()
    };
    let names = FAMILIES.iter().map(|(name, _)| *name);
    names.map(|name| Family { name, cases: quick(name) }).collect()
}

/// Where the expected values of a case come from.
pub fn source(case: &Case) -> String {
    let source = &case.source;
    let note = match source.note.as_str() {
        "" => String::new(),
        note => format!("; {note}"),
    };
    format!("{}, {}{note}", source.cite, source.place)
}

/// The largest share of a tolerance, and the quantity that uses it.
pub fn worst<'a>(results: impl IntoIterator<Item = &'a CaseResult>) -> String {
    let worst = results
        .into_iter()
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
pub fn tolerance(case: &Case) -> String {
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
pub fn rejects(case: &Case, result: Option<&CaseResult>) -> String {
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
        let all: Vec<_> = shown.iter().flat_map(|f| &f.cases).collect();
        let quick = cases.iter().filter(|c| c.cost == Cost::Quick).count();
        assert_eq!(all.len(), quick);
        assert!(all.iter().all(|(c, _)| !tolerance(c).is_empty()));
        assert!(all.iter().all(|(c, r)| !rejects(c, r.as_ref()).is_empty()));
        let (_, first) =
            all.iter().find(|(c, _)| c.id == cases[0].id).unwrap();
        assert!(first.as_ref().is_some_and(CaseResult::passed));
        assert_eq!(worst(first), "50 %, a");
        let without = all.iter().filter(|(_, r)| r.is_none()).count();
        assert_eq!(without, quick - 1);
    }
}
