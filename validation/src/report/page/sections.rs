//! The page's sections, in order.

use maud::{Markup, html};

use super::figures::{self, ShownFigure};
use super::table::{self, scrolled};
use super::{Family, Finding, Part, ReportInput, Summary};
use crate::paper::Verdict;

/// Those that have something to show.
pub fn all(input: &ReportInput) -> Vec<Part> {
    let mut parts = vec![Part {
        id: "summary",
        title: "Summary",
        body: summary(&input.summary, &input.findings),
    }];
    let mut add = |wanted: bool, id, title, body: &dyn Fn() -> Markup| {
        if wanted {
            parts.push(Part { id, title, body: body() });
        }
    };
    let i = input;
    add(!i.findings.is_empty(), "findings", "Findings", &|| {
        findings(&i.findings, &i.figures)
    });
    let proof = !i.proof.is_empty() || !i.families.is_empty();
    add(proof, "evidence", "Evidence", &|| {
        html! {
            @if !i.proof.is_empty() { p { (i.proof) } }
            @for family in &i.families { (cases(family)) }
        }
    });
    add(!i.tables.is_empty(), "tables", "Tables", &|| {
        html! { @for t in &i.tables { (table::plain(t)) } }
    });
    add(!i.figures.is_empty(), "figures", "Figures", &|| {
        html! { @for f in &i.figures { (figures::figure(f)) } }
    });
    add(!i.credibility.is_empty(), "credibility", "Credibility", &|| {
        html! { @for t in &i.credibility { (table::plain(t)) } }
    });
    add(
        !i.limits.is_empty(),
        "limits",
        "Known limits, and what was not checked",
        &|| html! { ul { @for limit in &i.limits { li { (limit) } } } },
    );
    add(!i.provenance.is_empty(), "provenance", "Provenance", &|| {
        html! {
            dl {
                @for (name, value) in &i.provenance {
                    dt { (name) }
                    dd { (value) }
                }
            }
        }
    });
    parts
}

fn summary(summary: &Summary, findings: &[Finding]) -> Markup {
    html! {
        @if !summary.asked.is_empty() {
            h3 { "What was asked" }
            p { (summary.asked) }
        }
        @if !findings.is_empty() || !summary.found.is_empty() {
            h3 { "What was found" }
        }
        @if !findings.is_empty() { (counts(findings)) }
        @if !summary.found.is_empty() {
            ul { @for found in &summary.found { li { (found) } } }
        }
        @if !summary.trust.is_empty() {
            h3 { "How far to trust it" }
            p { (summary.trust) }
        }
    }
}

fn counts(findings: &[Finding]) -> Markup {
    let count =
        |v: Verdict| findings.iter().filter(|f| f.verdict == v).count();
    html! {
        ul.counts {
            @for verdict in Verdict::ALL {
                li {
                    span.number { (count(verdict)) } " "
                    (mark(verdict))
                }
            }
        }
    }
}

fn mark(verdict: Verdict) -> Markup {
    html! {
        span class=(class(verdict)) {
            span aria-hidden="true" { (sign(verdict)) " " }
            (verdict.name())
        }
    }
}

/// A sign that stands without colour.
fn sign(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Confirmed => "✓",
        Verdict::NotConfirmed => "✗",
        Verdict::Inconclusive => "?",
    }
}

fn class(verdict: Verdict) -> &'static str {
    match verdict {
        Verdict::Confirmed => "verdict yes",
        Verdict::NotConfirmed => "verdict no",
        Verdict::Inconclusive => "verdict open",
    }
}

fn findings(findings: &[Finding], shown: &[ShownFigure]) -> Markup {
    let body = html! {
        table.cards {
            caption { "Claims, what was measured, and the verdict." }
            thead {
                tr {
                    th scope="col" { "Claim" }
                    th scope="col" { "Tested on" }
                    th scope="col" { "Measure" }
                    th scope="col" { "Value" }
                    th scope="col" { "Interval" }
                    th scope="col" { "Margin" }
                    th scope="col" { "Verdict" }
                }
            }
            tbody { @for f in findings { (finding(f, shown)) } }
        }
    };
    scrolled("Findings, table", body)
}

/// A link to a figure, by its number where the page has it.
fn link(name: &str, shown: &[ShownFigure]) -> Markup {
    html! {
        @if let Some(figure) = shown.iter().find(|f| f.name == name) {
            a href={ "#" (name) } { (figure.number) }
        } @else {
            (name)
        }
    }
}

fn finding(f: &Finding, shown: &[ShownFigure]) -> Markup {
    html! {
        tr id={ "finding-" (f.id) } {
            th scope="row" {
                (f.claim)
                " " span.source { "(" (f.source) ")" }
                @if !f.figures.is_empty() {
                    span.source {
                        @for (k, name) in f.figures.iter().enumerate() {
                            @if k > 0 { ", " } @else { " See " }
                            (link(name, shown))
                        }
                        "."
                    }
                }
            }
            td data-label="Tested on" { (f.tested_on) }
            td data-label="Measure" { (f.measure) }
            td data-label="Value" { (f.value) }
            td data-label="Interval" { (f.interval) }
            td data-label="Margin" { (f.margin) }
            td data-label="Verdict" {
                (mark(f.verdict))
                @if !f.remark.is_empty() {
                    " " span.source { (f.remark) }
                }
            }
        }
    }
}

fn cases(family: &Family) -> Markup {
    let passed = family.cases.iter().filter(|c| c.passed).count();
    let body = html! {
        table.cards {
            caption { "Cases of the family " (family.name) "." }
            thead {
                tr {
                    th scope="col" { "Case" }
                    th scope="col" { "Claim" }
                    th scope="col" { "Source" }
                    th scope="col" { "Error" }
                    th scope="col" { "Tolerance and why" }
                    th scope="col" { "Margin" }
                    th scope="col" { "Rejects" }
                    th scope="col" { "Result" }
                }
            }
            tbody {
                @for c in &family.cases {
                    tr {
                        th scope="row" { (c.id) }
                        td data-label="Claim" { (c.claim) }
                        td data-label="Source" { (c.source) }
                        td data-label="Error" { (c.error) }
                        td data-label="Tolerance and why" {
                            (c.tolerance) " "
                            span.source { (c.because) }
                        }
                        td data-label="Margin" { (c.margin) }
                        td data-label="Rejects" { (c.rejects) }
                        td data-label="Result" {
                            @if c.passed {
                                span.verdict.yes { "✓ passed" }
                            } @else {
                                span.verdict.no { "✗ failed" }
                            }
                        }
                    }
                }
            }
        }
    };
    html! {
        h3 { (family.name) }
        @if !family.purpose.is_empty() { p { (family.purpose) } }
        details {
            summary {
                (passed) " of " (family.cases.len()) " cases passed"
            }
            (scrolled(&family.name, body))
        }
    }
}
