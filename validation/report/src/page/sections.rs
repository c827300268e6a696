//! The page's sections, in order.

use maud::{Markup, html};

use super::figures::{self, ShownFigure};
use super::input::{
    Answers, Chapter, Column, Family, Finding, Outcome, Part, ReportInput,
    Theme,
};
use super::table::{self, scrolled};
use rocking_common::findings::Tested;
use rocking_common::paper::Verdict;
use rocking_common::words::capital;

/// What the page is about, and who signs for it.
pub fn head(input: &ReportInput) -> Markup {
    html! {
        @if !input.head.is_empty() { (list(&input.head)) }
        @if !input.signatures.is_empty() {
            ul.signatures {
                @for (what, given) in &input.signatures {
                    li {
                        (what) ": "
                        @if let Some(words) = given {
                            (words)
                        } @else {
                            span.line { span.unseen { "to be filled in" } "\u{a0}" }
                        }
                    }
                }
            }
        }
    }
}

/// Those that have something to show.
pub fn all(input: &ReportInput) -> Vec<Part> {
    let i = input;
    let mut parts = Vec::new();
    let mut add =
        |wanted: bool, id, title: &str, body: &dyn Fn() -> Markup| {
            if wanted {
                parts.push(Part { id, title: title.into(), body: body() });
            }
        };
    add(!i.answers.rows.is_empty(), "answers", "Answers", &|| {
        answers(&i.answers, &i.columns)
    });
    add(!i.findings.is_empty(), "findings", "Findings", &|| {
        html! {
            p { (legend()) }
            @for column in &i.columns { (counts(column)) }
            @for t in &i.findings { (theme(t, &i.columns)) }
            @if !i.identities.rows.is_empty() {
                (folded(
                    "true-by-definition",
                    &i.identities.title,
                    &table::untitled(&i.identities),
                ))
            }
        }
    });
    add(!i.method.is_empty(), "method", "Method and glossary", &|| {
        html! {
            div.columns { @for words in &i.method { p { (words) } } }
            @if !i.glossary.is_empty() {
                h3 { "Glossary" }
                div.columns { (list(&i.glossary)) }
            }
        }
    });
    let proof = !i.proof.is_empty() || !i.families.is_empty();
    add(proof, "evidence", "Proof of the integrator", &|| {
        html! {
            @if !i.proof.is_empty() { p { (i.proof) } }
            @if !i.families.is_empty() { (families(&i.families)) }
            (chapter(&i.evidence))
        }
    });
    for one in &i.chapters {
        add(true, one.id, &one.title, &|| chapter(one));
    }
    let annexes = !i.annexes.is_empty() || !i.families.is_empty();
    add(annexes, "annexes", "Annexes", &|| {
        html! {
            @if !i.findings.is_empty() {
                (folded("all-results", "Every result", &every_result(i)))
            }
            @if !i.families.is_empty() {
                (folded("cases", "Every declared case", &html! {
                    @for family in &i.families { (cases(family)) }
                }))
            }
            @for one in &i.annexes {
                (folded(one.id, &one.title, &chapter(one)))
            }
        }
    });
    parts
}

/// A heading whose part is folded on a screen.
fn folded(id: &str, title: &str, body: &Markup) -> Markup {
    html! {
        div id=(id) {
            h3 { (title) }
            details {
                summary { "Show: " (title) }
                (body)
            }
        }
    }
}

fn list(pairs: &[(String, String)]) -> Markup {
    html! {
        dl {
            @for (name, value) in pairs {
                dt { (name) }
                dd { (value) }
            }
        }
    }
}

fn chapter(one: &Chapter) -> Markup {
    html! {
        @for words in &one.text { p { (words) } }
        @if !one.list.is_empty() { (list(&one.list)) }
        (drawings(&one.figures))
        @for t in &one.tables { (table::plain(t)) }
        @for part in &one.folded {
            (folded(part.id, &part.title, &chapter(part)))
        }
    }
}

fn drawings(shown: &[ShownFigure]) -> Markup {
    html! {
        @if !shown.is_empty() {
            div.figures { @for f in shown { (figures::figure(f)) } }
        }
    }
}

fn answers(answers: &Answers, columns: &[Column]) -> Markup {
    let body = html! {
        table.cards.answers {
            caption {
                span.unseen { "Questions, and what the verdicts answer." }
            }
            thead {
                tr {
                    th scope="col" { "Question" }
                    th scope="col" { "Answer" }
                    th scope="col" { "Effect (95 % interval)" }
                    @for column in columns {
                        th scope="col" { (column.name) }
                    }
                    th scope="col" { "Shown in" }
                }
            }
            tbody {
                @for row in &answers.rows {
                    tr {
                        th scope="row" { (row.question) }
                        td data-label="Answer" { strong { (row.answer) } }
                        td data-label="Effect" { (row.effect) }
                        @for (column, words) in
                            columns.iter().zip(&row.columns)
                        {
                            td data-label=(column.name) { (words) }
                        }
                        td data-label="Shown in" { (links(&row.shown)) }
                    }
                }
            }
        }
    };
    html! {
        (scrolled("Questions and answers", body))
        (drawings(&answers.figures))
    }
}

fn links(shown: &[(String, String)]) -> Markup {
    html! {
        @for (k, (anchor, words)) in shown.iter().enumerate() {
            @if k > 0 { ", " }
            a href={ "#" (anchor) } { (words) }
        }
    }
}

fn legend() -> Markup {
    html! {
        "A cell shows the value and its 95 % interval. Where the limit is \
         about a share of cells, it is that of the cells with 30 records or \
         more; 28/128 counts these and all. The arm is C, or A where C was not run. Figures are of the \
         suites of this run. Values on all suites and arms, measures and reasons: "
        a href="#all-results" { "every result" } "."
    }
}

fn counts(column: &Column) -> Markup {
    html! {
        p {
            (capital(&column.name)) ", " (column.suites) ": "
            @for (k, (verdict, count)) in column.counts.iter().enumerate() {
                @if k > 0 { ", " }
                (count) " " (mark(*verdict))
            }
            "."
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

/// The verdict as a sign, its name for those who do not see it.
fn short(verdict: Verdict) -> Markup {
    html! {
        span class=(class(verdict)) title=(verdict.name()) {
            span aria-hidden="true" { (sign(verdict)) }
            span.unseen { (verdict.name()) }
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

fn theme(theme: &Theme, columns: &[Column]) -> Markup {
    html! {
        div id=(theme.id) {
            h3 { (theme.question) }
            p { (theme.paragraph) }
            (drawings(&theme.figures))
            @if !theme.more.is_empty() {
                details {
                    summary { "Show: " (called(&theme.more)) }
                    (drawings(&theme.more))
                }
            }
            (scrolled(&theme.question, findings(theme, columns)))
        }
    }
}

fn called(figures: &[ShownFigure]) -> String {
    let names: Vec<&str> = figures.iter().map(|f| f.number.as_str()).collect();
    names.join(", ")
}

/// Suites of the columns of a table of findings.
const SUITES: [Tested; 2] = [Tested::Ordinary, Tested::PulseType];

fn findings(theme: &Theme, columns: &[Column]) -> Markup {
    // Claims that share a quotation stand under it.
    let groups = theme.findings.chunk_by(|a, b| a.quote == b.quote);
    html! {
        table.cards.findings {
            caption { span.unseen { "Claims and verdicts." } }
            thead {
                tr {
                    th scope="col" rowspan="2" { "The paper's words" }
                    th scope="col" rowspan="2" {
                        "In plain words, and the limit in practice"
                    }
                    @for column in columns {
                        th scope="colgroup" colspan=(SUITES.len()) {
                            (column.name)
                        }
                    }
                }
                tr {
                    @for _ in columns {
                        @for suite in SUITES {
                            th scope="col" { (suite.name()) }
                        }
                    }
                }
            }
            tbody {
                @for group in groups {
                    @for (k, one) in group.iter().enumerate() {
                        tr id={ "finding-" (one.id) } {
                            @if k == 0 {
                                th scope="row" rowspan=(group.len()) {
                                    (quotation(one))
                                }
                            }
                            (finding(one, columns))
                        }
                    }
                }
            }
        }
    }
}

fn quotation(f: &Finding) -> Markup {
    html! {
        "\u{201c}" (f.quote) "\u{201d} "
        span.source { (f.source) }
    }
}

fn finding(f: &Finding, columns: &[Column]) -> Markup {
    html! {
        td data-label="In plain words" {
            (f.plain) ": " span.source { (f.rule) }
            @if !f.criterion.is_empty() {
                span.source { ". The paper: " (f.criterion) }
            }
        }
        @for (k, column) in columns.iter().enumerate() {
            @let own = f.columns.get(k).map_or(&[][..], |all| all);
            @let both = own.iter().any(|o| o.suite == Tested::Both);
            @if both {
                td data-label=(column.name) colspan=(SUITES.len()) {
                    (outcomes(own, Tested::Both, k == 0))
                }
            } @else {
                @for suite in SUITES {
                    td data-label={ (column.name) ", " (suite.name()) } {
                        (outcomes(own, suite, k == 0))
                    }
                }
            }
        }
    }
}

/// What came out on a suite, in the arm that stands among the findings: the
/// first column has the value, the others the verdict alone.
fn outcomes(all: &[Outcome], suite: Tested, value: bool) -> Markup {
    html! {
        @for one in all.iter().filter(|o| o.first && o.suite == suite) {
            @if value {
                (outcome(one, ""))
            } @else if let Some(verdict) = one.by_equivalence {
                (short(verdict))
            } @else {
                "\u{2013}"
            }
        }
    }
}

fn outcome(one: &Outcome, place: &str) -> Markup {
    html! {
        div.outcome {
            @if let Some(verdict) = one.by_equivalence { (short(verdict)) " " }
            @if !place.is_empty() { span.source { (place) ": " } }
            (one.value)
            @if let Some(verdict) = one.by_criterion {
                "; the paper: " (short(verdict))
            }
        }
    }
}

fn every_result(input: &ReportInput) -> Markup {
    html! {
        @for theme in &input.findings {
            (scrolled(&format!("{}, every result", theme.question), html! {
                table.cards.findings {
                    caption { span { (theme.question) } }
                    thead {
                        tr {
                            th scope="col" { "Claim and measure" }
                            @for column in &input.columns {
                                th scope="col" { (column.name) }
                            }
                        }
                    }
                    tbody {
                        @for f in &theme.findings {
                            (results(f, &input.columns))
                        }
                    }
                }
            }))
        }
    }
}

fn results(f: &Finding, columns: &[Column]) -> Markup {
    html! {
        tr {
            th scope="row" {
                a href={ "#finding-" (f.id) } { (f.id) }
                p.source { (f.measure) }
                @if !f.remark.is_empty() { p.source { (f.remark) } }
            }
            @for (k, column) in columns.iter().enumerate() {
                td data-label=(column.name) {
                    @for one in f.columns.get(k).into_iter().flatten() {
                        (outcome(one, &one.place))
                        @if !one.remarks.is_empty() {
                            p.source { (one.remarks.join("; ")) "." }
                        }
                    }
                }
            }
        }
    }
}

fn families(families: &[Family]) -> Markup {
    let body = html! {
        table.cards {
            caption {
                span {
                    "One row a family of declared cases, with its largest \
                     error as a share of the tolerance."
                }
            }
            thead {
                tr {
                    th scope="col" { "Family" }
                    th scope="col" { "Cases passed" }
                    th scope="col" { "Worst share of tolerance" }
                    th scope="col" { "Wrong models rejected" }
                }
            }
            tbody {
                @for family in families {
                    tr {
                        th scope="row" {
                            a href={ "#cases-" (family.name) } {
                                (family.name)
                            }
                        }
                        td data-label="Cases passed" {
                            (passed(family)) " of " (family.cases.len())
                        }
                        td data-label="Worst share of tolerance" { (family.worst) }
                        td data-label="Wrong models rejected" {
                            (family.rejected)
                        }
                    }
                }
            }
        }
    };
    scrolled("Families of declared cases", body)
}

fn passed(family: &Family) -> usize {
    family.cases.iter().filter(|c| c.passed).count()
}

fn cases(family: &Family) -> Markup {
    let body = html! {
        table.cards {
            caption { span { "Cases of the family " (family.name) "." } }
            thead {
                tr {
                    th scope="col" { "Case" }
                    th scope="col" { "Claim" }
                    th scope="col" { "Source" }
                    th scope="col" { "Tolerance and why" }
                    th scope="col" { "Worst share of tolerance" }
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
                        td data-label="Tolerance and why" {
                            (c.tolerance) " "
                            span.source { (c.because) }
                        }
                        td data-label="Worst share of tolerance" { (c.worst) }
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
        div id={ "cases-" (family.name) } {
            h4 { (family.name) }
            (scrolled(&family.name, body))
        }
    }
}
