//! The findings: theme by theme, and every result.

use maud::{Markup, html};

use super::chapter::{drawings, folded, labels};
use super::content::Page;
use crate::basis::FindingColumn;
use crate::findings::identities;
use crate::quantity::{remarks, rule_text, value_text};
use crate::verdicts::{by_theme, first_arm, score};
use rocking_common::findings::{Claim, ClaimResult, Kind, SuiteSet, Theme};
use rocking_common::paper::{Arm, ClaimVerdict};
use rocking_common::words::capital;
use rocking_draw::figures::Place;
use rocking_draw::page::table::{self, joined, scrolled};

/// The themes in the order of the page, each with its anchor.
const THEMES: [(Theme, &str); 6] = [
    (Theme::SingleRecords, "theme-single-records"),
    (Theme::Statistics, "theme-statistics"),
    (Theme::Lognormality, "theme-lognormality"),
    (Theme::Fragilities, "theme-fragilities"),
    (Theme::Choices, "theme-choices"),
    (Theme::Beyond, "theme-beyond"),
];

/// The section.
pub fn section(page: &Page<'_>) -> Markup {
    let identities = identities(page.basis.here);
    html! {
        p { (legend()) }
        @for column in page.basis.columns() { (counts(column)) }
        @for (theme, anchor) in THEMES { (about(page, theme, anchor)) }
        (folded(
            "true-by-definition",
            &identities.title,
            &table::untitled(&identities),
        ))
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

fn counts((name, findings): FindingColumn<'_>) -> Markup {
    html! {
        p {
            (capital(name)) ", "
            @for (k, suite) in findings.suites.iter().enumerate() {
                @if k > 0 { " + " }
                (suite.records) " " (suite.kind)
                @if let Some(earthquakes) = suite.earthquakes {
                    " of " (earthquakes) " earthquakes"
                }
            }
            ". Of the paper's sentences, "
            @let score = score(findings).into_iter();
            @for (k, (verdict, count)) in score.enumerate() {
                @if k > 0 { ", " }
                (count) " " (mark(verdict))
            }
            "."
        }
    }
}

fn mark(verdict: ClaimVerdict) -> Markup {
    let (class, sign) = looks(verdict);
    html! {
        span class=(class) {
            span aria-hidden="true" { (sign) " " }
            (verdict.name())
        }
    }
}

/// The verdict as a sign, its name for those who do not see it.
fn short(verdict: ClaimVerdict) -> Markup {
    let (class, sign) = looks(verdict);
    html! {
        span class=(class) title=(verdict.name()) {
            span aria-hidden="true" { (sign) }
            span.unseen { (verdict.name()) }
        }
    }
}

/// Class, and a sign that stands without colour.
fn looks(verdict: ClaimVerdict) -> (&'static str, &'static str) {
    match verdict {
        ClaimVerdict::Confirmed => ("verdict yes", "✓"),
        ClaimVerdict::NotConfirmed => ("verdict no", "✗"),
        ClaimVerdict::Inconclusive => ("verdict open", "?"),
    }
}

fn about(page: &Page<'_>, theme: Theme, anchor: &str) -> Markup {
    let question = theme.question();
    let more = page.placed(Place::Folded(theme));
    html! {
        div id=(anchor) {
            h3 { (question) }
            p { (by_theme(theme, page.basis)) }
            (drawings(&page.placed(Place::Opens(theme))))
            @if !more.is_empty() {
                details {
                    summary { "Show: " (labels(&more)) }
                    (drawings(&more))
                }
            }
            (scrolled(question, findings(page, theme)))
        }
    }
}

/// The findings among the claims about a theme, as the run at hand has them.
fn claims<'a>(page: &Page<'a>, theme: Theme) -> Vec<&'a Claim> {
    let is_own = |c: &&Claim| c.theme == theme && c.kind == Kind::Finding;
    page.basis.here.claims.iter().filter(is_own).collect()
}

/// The claim as a column has it, with each of its results.
fn results<'a>(
    claim: &Claim,
    (_, findings): FindingColumn<'a>,
) -> impl Iterator<Item = (&'a Claim, &'a ClaimResult)> {
    let own = findings.claims.iter().find(|c| c.id == claim.id);
    own.into_iter().flat_map(|own| own.results.iter().map(move |r| (own, r)))
}

/// Suites of the columns of a table of findings.
const SUITES: [SuiteSet; 2] = [SuiteSet::Ordinary, SuiteSet::PulseType];

fn findings(page: &Page<'_>, theme: Theme) -> Markup {
    let claims = claims(page, theme);
    let columns = page.basis.columns();
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
                    @for (name, _) in &columns {
                        th scope="colgroup" colspan=(SUITES.len()) {
                            (name)
                        }
                    }
                }
                tr {
                    @for _ in &columns {
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
                            (finding(page, one))
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

fn finding(page: &Page<'_>, claim: &Claim) -> Markup {
    let first = first_arm(page.basis.here);
    html! {
        td data-label="In plain words" {
            (claim.plain) ": " span.source { (joined(&rule_text(claim))) }
            @if !claim.criterion.is_empty() {
                span.source { ". The paper: " (claim.criterion) }
            }
        }
        @for (k, column) in page.basis.columns().into_iter().enumerate() {
            @let outcomes =
                |suite| outcomes(claim, column, first, suite, k == 0);
            @let both = results(claim, column)
                .any(|(_, r)| r.suite == SuiteSet::Both);
            @if both {
                td data-label=(column.0) colspan=(SUITES.len()) {
                    (outcomes(SuiteSet::Both))
                }
            } @else {
                @for suite in SUITES {
                    td data-label={ (column.0) ", " (suite.name()) } {
                        (outcomes(suite))
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
    column: FindingColumn<'_>,
    first: Arm,
    suite: SuiteSet,
    value: bool,
) -> Markup {
    let shown = |r: &ClaimResult| {
        r.suite == suite && r.arm.is_none_or(|arm| arm == first)
    };
    html! {
        @for (own, one) in results(claim, column).filter(|(_, r)| shown(r)) {
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

/// Every result on every claim.
pub fn every_result(page: &Page<'_>) -> Markup {
    let columns = page.basis.columns();
    let mut head = vec!["Claim and measure"];
    head.extend(columns.iter().map(|(name, _)| name));
    html! {
        @for (theme, _) in THEMES {
            @let question = theme.question();
            (scrolled(&format!("{question}, every result"), html! {
                table.cards.findings {
                    caption { span { (question) } }
                    (table::head(&head))
                    tbody {
                        @for claim in claims(page, theme) {
                            tr { (all_of(claim, &columns)) }
                        }
                    }
                }
            }))
        }
    }
}

fn all_of(claim: &Claim, columns: &[FindingColumn<'_>]) -> Markup {
    html! {
        th scope="row" {
            a href={ "#finding-" (claim.id) } { (claim.id) }
            p.source {
                (claim.measure) " (" (claim.blocks)
                "). Why this limit: " (claim.reason) "."
            }
            @if !claim.note.is_empty() { p.source { (claim.note) } }
        }
        @for column in columns {
            td data-label=(column.0) {
                @for (own, one) in results(claim, *column) {
                    (outcome(own, one, &one.place()))
                    p.source { (remarks(own, one).join("; ")) "." }
                }
            }
        }
    }
}
