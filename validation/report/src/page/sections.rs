//! The page's sections, in order.

use maud::{Markup, PreEscaped, html};

use super::input::{AnswerRow, Chapter, Column, Part, ReportInput, Shown};
use crate::evidence::families::{Family, rejects, source, tolerance, worst};
use crate::quantity::{remarks, rule_text, value_text};
use rocking_common::findings::{Claim, ClaimResult, Kind, Tested, Theme};
use rocking_common::paper::Verdict;
use rocking_common::words::capital;
use rocking_draw::figures::Figure;
use rocking_draw::page;
use rocking_draw::page::table::{self, joined, scrolled};
use rocking_proof::verdict::snapshot::CaseResult;

/// A block, at rest and tilted.
const SKETCH: &str = include_str!("sketch.svg");

/// Eqs. 1 to 7 as MathML, in a table.
const EQUATIONS: &str = include_str!("equations.html");

/// What the page is about.
pub fn head(input: &ReportInput<'_>) -> Markup {
    html! {
        div.about {
            div {
                h1 { (input.title) }
                @for words in &input.intro { p { (words) } }
            }
            (PreEscaped(SKETCH))
        }
    }
}

/// Who signs for the page, or lines to sign on.
fn signatures(signed: &[(String, Option<String>)]) -> Markup {
    html! {
        ul.signatures {
            @for (what, given) in signed {
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

/// Those that have something to show.
pub fn all(input: &ReportInput<'_>) -> Vec<Part> {
    let i = input;
    let mut parts = Vec::new();
    let mut add =
        |wanted: bool, id, title: &str, body: &dyn Fn() -> Markup| {
            if wanted {
                parts.push(Part { id, title: title.into(), body: body() });
            }
        };
    add(!i.answers.is_empty(), "answers", "Answers", &|| {
        html! {
            (answers(&i.answers))
            @if let Some(words) = &i.otherwise { p { (words) } }
            (drawings(&i.first))
        }
    });
    add(!i.scope.text.is_empty(), i.scope.id, &i.scope.title, &|| {
        html! {
            div.columns { @for words in &i.scope.text { p { (joined(words)) } } }
            @for part in &i.scope.folded {
                (folded(part.id, &part.title, &chapter(part)))
            }
        }
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
            div.columns { @for words in &i.method { p { (joined(words)) } } }
            (folded("equations", "Equations", &PreEscaped(EQUATIONS.into())))
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
    add(true, "provenance", "Provenance and sign-off", &|| {
        html! {
            (folded("inputs", "Program, suites, command", &list(&i.head)))
            (signatures(&i.signatures))
        }
    });
    let annexes = !i.annexes.is_empty() || !i.families.is_empty();
    add(annexes, "annexes", "Annexes", &|| {
        html! {
            (folded("files", &i.files.title, &table::untitled(&i.files)))
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
        details.part id=(id) {
            summary { h3 { (title) } }
            (body)
        }
    }
}

fn list(pairs: &[(String, String)]) -> Markup {
    html! {
        dl {
            @for (name, value) in pairs {
                dt { (name) }
                dd { (joined(value)) }
            }
        }
    }
}

fn chapter(one: &Chapter<'_>) -> Markup {
    html! {
        @for words in &one.text { p { (words) } }
        @if !one.list.is_empty() { (list(&one.list)) }
        (drawings(&one.figures))
        @for t in &one.tables {
            @if t.title == one.title {
                div id=(t.name) { (table::untitled(t)) }
            } @else {
                (table::plain(t))
            }
        }
        @for part in &one.folded {
            (folded(part.id, &part.title, &chapter(part)))
        }
    }
}

fn drawings(shown: &[&Figure]) -> Markup {
    html! {
        @if !shown.is_empty() {
            div.figures {
                @for same in shown.chunk_by(|a, b| beside(a, b)) {
                    (page::figure(same[0], &same[1..]))
                }
            }
        }
    }
}

fn answers(rows: &[AnswerRow]) -> Markup {
    let head = ["Question", "Answer", "Numbers (90 % interval)", "Shown in"];
    let body = html! {
        table.cards.answers {
            caption {
                span.unseen { "Questions, and what the verdicts answer." }
            }
            (table::head(&head))
            tbody {
                @for row in rows {
                    tr {
                        th scope="row" { (row.question) }
                        td data-label="Answer" {
                            strong { (joined(&row.answer)) }
                        }
                        td data-label="Numbers" { (joined(&row.effect)) }
                        td data-label="Shown in" { (links(&row.shown)) }
                    }
                }
            }
        }
    };
    scrolled("Questions and answers", body)
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
        "A cell shows the value and the 90 % interval that decides: each end \
         misses in a nominal 5 % (simulated: Coverage, under Method). Where the limit is \
         about a share of cells, it is that of the cells with 30 records or \
         more; 28/128 counts these and all. The arm is C, or A where C was not run. Figures are of the \
         suites of the first column. Values on all suites and arms, measures and reasons: "
        a href="#all-results" { "every result" } "."
    }
}

fn counts(column: &Column) -> Markup {
    let suites = &column.findings.suites;
    html! {
        p {
            (capital(column.name)) ", "
            @for (k, suite) in suites.iter().enumerate() {
                @if k > 0 { " + " }
                (suite.records) " " (suite.kind)
                @if let Some(earthquakes) = suite.earthquakes {
                    " of " (earthquakes) " earthquakes"
                }
            }
            ". Of the paper's sentences, "
            @for (k, (verdict, count)) in column.score.iter().enumerate() {
                @if k > 0 { ", " }
                (count) " " (mark(*verdict))
            }
            "."
        }
    }
}

fn mark(verdict: Verdict) -> Markup {
    let (class, sign) = looks(verdict);
    html! {
        span class=(class) {
            span aria-hidden="true" { (sign) " " }
            (verdict.name())
        }
    }
}

/// The verdict as a sign, its name for those who do not see it.
fn short(verdict: Verdict) -> Markup {
    let (class, sign) = looks(verdict);
    html! {
        span class=(class) title=(verdict.name()) {
            span aria-hidden="true" { (sign) }
            span.unseen { (verdict.name()) }
        }
    }
}

/// Class, and a sign that stands without colour.
fn looks(verdict: Verdict) -> (&'static str, &'static str) {
    match verdict {
        Verdict::Confirmed => ("verdict yes", "✓"),
        Verdict::NotConfirmed => ("verdict no", "✗"),
        Verdict::Inconclusive => ("verdict open", "?"),
    }
}

fn theme(shown: &Shown<'_>, columns: &[Column]) -> Markup {
    let question = shown.theme.question();
    html! {
        div id=(anchor(shown.theme)) {
            h3 { (question) }
            p { (shown.paragraph) }
            (drawings(&shown.figures))
            @if !shown.more.is_empty() {
                details {
                    summary { "Show: " (called(&shown.more)) }
                    (drawings(&shown.more))
                }
            }
            (scrolled(question, findings(shown.theme, columns)))
        }
    }
}

fn anchor(theme: Theme) -> &'static str {
    match theme {
        Theme::Choices => "theme-choices",
        Theme::SingleRecords => "theme-single-records",
        Theme::Statistics => "theme-statistics",
        Theme::Lognormality => "theme-lognormality",
        Theme::Fragilities => "theme-fragilities",
        Theme::Beyond => "theme-beyond",
    }
}

/// The findings among the claims about a theme, as the run at hand has them.
fn about(theme: Theme, columns: &[Column]) -> Vec<&Claim> {
    let here = columns.last().map_or(&[][..], |c| &c.findings.claims);
    let own = |c: &&Claim| c.theme == theme && c.kind == Kind::Finding;
    here.iter().filter(own).collect()
}

/// What came out on a claim in a column: the claim as that column has it, and
/// its results.
fn came_out<'a>(
    claim: &Claim,
    column: &'a Column,
) -> impl Iterator<Item = (&'a Claim, &'a ClaimResult)> {
    let own = column.findings.claims.iter().find(|c| c.id == claim.id);
    own.into_iter().flat_map(|own| own.results.iter().map(move |r| (own, r)))
}

fn called(figures: &[&Figure]) -> String {
    let each = figures.chunk_by(|a, b| beside(a, b));
    let names: Vec<String> = each.map(|f| f[0].heading.label()).collect();
    names.join(", ")
}

fn beside(a: &Figure, b: &Figure) -> bool {
    a.heading.is_beside(&b.heading)
}

/// Suites of the columns of a table of findings.
const SUITES: [Tested; 2] = [Tested::Ordinary, Tested::PulseType];

fn findings(theme: Theme, columns: &[Column]) -> Markup {
    let claims = about(theme, columns);
    // Claims that share a quotation stand under it.
    let groups = claims.chunk_by(|a, b| a.quote == b.quote);
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

/// Where the paper says it; its words unfold.
fn quotation(claim: &Claim) -> Markup {
    html! {
        details {
            summary { "Section " (claim.section) }
            "\u{201c}" (claim.quote) "\u{201d} "
            span.source { "(" (claim.section) ")" }
        }
    }
}

fn finding(claim: &Claim, columns: &[Column]) -> Markup {
    html! {
        td data-label="In plain words" {
            (claim.plain) ": " span.source { (joined(&rule_text(claim))) }
            @if !claim.criterion.is_empty() {
                span.source { ". The paper: " (claim.criterion) }
            }
        }
        @for (k, column) in columns.iter().enumerate() {
            @let both = came_out(claim, column)
                .any(|(_, r)| r.suite == Tested::Both);
            @if both {
                td data-label=(column.name) colspan=(SUITES.len()) {
                    (outcomes(claim, column, Tested::Both, k == 0))
                }
            } @else {
                @for suite in SUITES {
                    td data-label={ (column.name) ", " (suite.name()) } {
                        (outcomes(claim, column, suite, k == 0))
                    }
                }
            }
        }
    }
}

/// What came out on a suite, in the arm that stands among the findings: the
/// first column has the value, the others the verdict alone.
fn outcomes(
    claim: &Claim,
    column: &Column,
    suite: Tested,
    value: bool,
) -> Markup {
    let first = column.first;
    let shown = |r: &ClaimResult| {
        r.suite == suite && r.arm.is_none_or(|arm| arm == first)
    };
    html! {
        @for (own, one) in came_out(claim, column).filter(|(_, r)| shown(r)) {
            @if value {
                (outcome(own, one, ""))
            } @else if let Some(verdict) = one.by_equivalence {
                (short(verdict))
            } @else {
                "\u{2013}"
            }
        }
    }
}

fn outcome(claim: &Claim, one: &ClaimResult, place: &str) -> Markup {
    html! {
        div.outcome {
            @if let Some(verdict) = one.by_equivalence { (short(verdict)) " " }
            @if !place.is_empty() { span.source { (place) ": " } }
            (joined(&value_text(claim, one)))
            @if let Some(verdict) = one.by_criterion {
                "; the paper: " (short(verdict))
            }
        }
    }
}

fn every_result(input: &ReportInput<'_>) -> Markup {
    let columns = &input.columns;
    let mut head = vec!["Claim and measure"];
    head.extend(columns.iter().map(|column| column.name));
    html! {
        @for theme in input.findings.iter().map(|shown| shown.theme) {
            @let question = theme.question();
            (scrolled(&format!("{question}, every result"), html! {
                table.cards.findings {
                    caption { span { (question) } }
                    (table::head(&head))
                    tbody {
                        @for claim in about(theme, columns) {
                            (results(claim, columns))
                        }
                    }
                }
            }))
        }
    }
}

fn results(claim: &Claim, columns: &[Column]) -> Markup {
    html! {
        tr {
            th scope="row" {
                a href={ "#finding-" (claim.id) } { (claim.id) }
                p.source {
                    (claim.measure) " (" (claim.blocks)
                    "). Why this limit: " (claim.reason) "."
                }
                @if !claim.note.is_empty() { p.source { (claim.note) } }
            }
            @for column in columns {
                td data-label=(column.name) {
                    @for (own, one) in came_out(claim, column) {
                        (outcome(own, one, &one.place()))
                        p.source { (remarks(own, one).join("; ")) "." }
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
            (table::head(&[
                "Family", "Cases passed", "Worst share of tolerance",
                "Wrong models rejected",
            ]))
            tbody {
                @for family in families {
                    tr {
                        th scope="row" {
                            a href={ "#cases-" (family.name) } {
                                (family.name)
                            }
                        }
                        td data-label="Cases passed" {
                            (family.results().filter(|r| r.passed()).count())
                            " of " (family.cases.len())
                        }
                        td data-label="Worst share of tolerance" {
                            (worst(family.results()))
                        }
                        td data-label="Wrong models rejected" {
                            (family.results().map(|r| r.rejected.len()).sum::<usize>())
                        }
                    }
                }
            }
        }
    };
    scrolled("Families of declared cases", body)
}

fn cases(family: &Family) -> Markup {
    let body = html! {
        table.cards.cases {
            caption { span { "Cases of the family " (family.name) "." } }
            (table::head(&[
                "Case", "Claim", "Source", "Tolerance and why",
                "Worst share of tolerance", "Rejects", "Result",
            ]))
            tbody {
                @for (c, result) in &family.cases {
                    @let result = result.as_ref();
                    tr {
                        th scope="row" { (c.id) }
                        td data-label="Claim" { (c.claim) }
                        td data-label="Source" { (source(c)) }
                        td data-label="Tolerance and why" {
                            (joined(&tolerance(c))) " "
                            span.source { (joined(&c.tolerance.because)) }
                        }
                        td data-label="Worst share of tolerance" { (worst(result)) }
                        td data-label="Rejects" { (joined(&rejects(c, result))) }
                        td data-label="Result" {
                            @if result.is_some_and(CaseResult::passed) {
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
            (scrolled(family.name, body))
        }
    }
}
