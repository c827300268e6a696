//! The declared cases with their results.

use maud::{Markup, html};

use crate::evidence::Proof;
use rocking_common::words::rounded;
use rocking_draw::page::table::{self, joined, scrolled};
use rocking_proof::cases::{Bound, Case};
use rocking_proof::verdict::snapshot::CaseResult;

/// Every case, family by family.
pub fn every_case(proof: &Proof) -> Markup {
    html! {
        @for (name, cases) in proof.families() {
            div id={ "cases-" (name) } {
                h4 { (name) }
                (scrolled(name, family(name, &cases)))
            }
        }
    }
}

fn family(name: &str, cases: &[(&Case, &CaseResult)]) -> Markup {
    html! {
        table.cards.cases {
            caption {
                @let results = || cases.iter().map(|(_, result)| *result);
                @let passed = results().filter(|r| r.passed()).count();
                span {
                    "Cases of the family " (name) ": " (passed) " of "
                    (cases.len()) " passed; the largest error is "
                    (worst(results())) "."
                }
            }
            (table::head(&[
                "Case", "Claim", "Source", "Tolerance and why",
                "Worst share of tolerance", "Rejects", "Result",
            ]))
            tbody {
                @for (c, result) in cases {
                    tr {
                        th scope="row" { (c.id) }
                        td data-label="Claim" { (c.claim) }
                        td data-label="Source" { (source(c)) }
                        td data-label="Tolerance and why" {
                            (joined(&tolerance(c))) " "
                            span.source { (joined(&c.tolerance.because)) }
                        }
                        td data-label="Worst share of tolerance" {
                            (worst([*result]))
                        }
                        td data-label="Rejects" {
                            (joined(&rejects(c, result)))
                        }
                        td data-label="Result" {
                            @if result.passed() {
                                span.verdict.yes { "✓ passed" }
                            } @else {
                                span.verdict.no { "✗ failed" }
                            }
                        }
                    }
                }
            }
        }
    }
}

/// Where the expected values of a case come from.
fn source(case: &Case) -> String {
    let source = &case.source;
    let note = match source.note.as_str() {
        "" => String::new(),
        note => format!("; {note}"),
    };
    format!("{}, {}{note}", source.cite, source.place)
}

/// The largest share of a tolerance, and the quantity that uses it.
fn worst<'a>(results: impl IntoIterator<Item = &'a CaseResult>) -> String {
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
        Bound::Waived(reason) => format!("waived ({reason})"),
    }
}

/// Wrong models that fail the case, each with its error over the bound.
fn rejects(case: &Case, result: &CaseResult) -> String {
    let texts: Vec<String> = case
        .tolerance
        .reject
        .iter()
        .map(|wrong| wrong.name())
        .map(|name| {
            match result
                .rejected
                .get(name)
                .map(|by| by.margin.0)
                .filter(|x| x.is_finite())
            {
                Some(margin) => format!("{name} ({})", times(margin)),
                // Infinite: a fate, a count or a side.
                None => name.to_owned(),
            }
        })
        .collect();
    texts.join(", ")
}
