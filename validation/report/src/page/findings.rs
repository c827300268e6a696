//! The findings: the paper by its own criteria, theme by theme, and every
//! result.

use maud::{Markup, html};

use super::chapter::{drawings, folded, labels};
use super::content::Page;
use crate::basis::FindingColumn;
use crate::findings::identities;
use crate::quantity::{
    EstimateText, ValueScale, count_text, effect_text, rule_text, said_text,
};
use crate::sentences::{SuiteResult, by_suite, by_theme};
use rocking_common::findings::{
    Claim, ClaimResult, Detail, Exists, Kind, StatedEffect, SuiteSet, Theme,
};
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

/// What stands where there is nothing to say.
const NOTHING: &str = "\u{2013}";

/// The section.
pub fn section(page: &Page<'_>) -> Markup {
    let identities = identities(page.basis.here);
    html! {
        p {
            (legend())
        }
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
        strong { "Seen here?" }
        " Yes if the numbers of this sample, on the paper's own grid (grid A, \
         steps of 0.01 g), meet every criterion of the paper; no if they meet \
         none; in part if they meet some; not testable without data. "
        strong { "Beyond these records?" }
        " Yes if the 90 % interval of the effect, by resampled earthquakes, \
         excludes no effect in the direction of the statement; the opposite \
         if it does so in the other direction; no sign if it does not exclude \
         it. ● marks an effect that the statement denies: its size says \
         whether it matters. "
        strong { "How large?" }
        " The estimate and that interval, on grid C (equal dimensionless \
         steps). If only one grid was run, it serves for both. See "
        a href="#all-results" { "every result" } "."
    }
}

/// A word on a claim behind a sign that stands without colour.
fn mark(word: &str) -> Markup {
    marked(word, html! { " " (word) })
}

/// The sign of a word before other words.
fn marked(word: &str, words: Markup) -> Markup {
    let (class, sign) = match word {
        "yes" => ("verdict yes", "✓"),
        "no" | "the opposite" => ("verdict no", "✗"),
        "in part" => ("verdict open", "◐"),
        "no sign" => ("verdict open", "○"),
        NOTHING => return html! { (NOTHING) },
        _ => ("verdict open", "?"),
    };
    html! {
        span class=(class) { span aria-hidden="true" { (sign) } (words) }
    }
}

/// Whether an effect exists, in a word. One that the sentence denies is no
/// success.
fn existing(claim: &Claim, result: &ClaimResult) -> Markup {
    let says = claim.no_effect.map(|own| own.says);
    match (result.exists, says) {
        (Some(Exists::Yes), Some(StatedEffect::Nothing)) => html! {
            span class="verdict open" { span aria-hidden="true" { "● " } "yes" }
        },
        (exists, _) => mark(exists.map_or(NOTHING, Exists::name)),
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

/// The claim as a column has it.
fn own<'a>(claim: &Claim, column: FindingColumn<'a>) -> Option<&'a Claim> {
    column.1.claims.iter().find(|c| c.id == claim.id)
}

/// What a column has on a suite.
fn on<'a>(
    claim: &Claim,
    column: FindingColumn<'a>,
    suite: SuiteSet,
) -> Option<(&'a Claim, SuiteResult<'a>)> {
    let own = own(claim, column)?;
    let one = by_suite(own).into_iter().find(|one| one.suite == suite)?;
    Some((own, one))
}

fn findings(page: &Page<'_>, theme: Theme) -> Markup {
    let columns = page.basis.columns();
    html! {
        table.cards.findings {
            caption { span.unseen { "Statements of the paper, by its own criteria." } }
            thead {
                tr {
                    th scope="col" rowspan="2" {
                        "The paper says; criterion"
                    }
                    th scope="col" rowspan="2" { "Suite" }
                    @for (k, (name, _)) in columns.iter().enumerate() {
                        @let span = if k == 0 { 3 } else { 1 };
                        th scope="colgroup" colspan=(span) { (name) }
                    }
                }
                tr {
                    @for k in 0..columns.len() {
                        th scope="col" { "Seen here?" }
                        @if k == 0 {
                            th scope="col" { "Beyond these records?" }
                            th scope="col" { "How large?" }
                        }
                    }
                }
            }
            tbody {
                @for claim in claims(page, theme) {
                    (finding(claim, &columns))
                }
            }
        }
    }
}

/// The rows of a claim, one for each suite on which a column has it.
fn finding(claim: &Claim, columns: &[FindingColumn<'_>]) -> Markup {
    let tested = |suite: &SuiteSet| {
        columns.iter().any(|own| on(claim, *own, *suite).is_some())
    };
    let suites: Vec<SuiteSet> =
        SuiteSet::ALL.into_iter().filter(tested).collect();
    html! {
        @for (k, suite) in suites.iter().enumerate() {
            tr id=[(k == 0).then(|| format!("finding-{}", claim.id))] {
                @if k == 0 {
                    th scope="row" rowspan=(suites.len()) {
                        (statement(claim))
                    }
                }
                td data-label="Suite" { (suite.name()) }
                @for (k, column) in columns.iter().enumerate() {
                    (cells(claim, *column, *suite, k == 0))
                }
            }
        }
    }
}

/// What came out on a suite: the words, and for the column that leads the
/// numbers.
fn cells(
    claim: &Claim,
    column: FindingColumn<'_>,
    suite: SuiteSet,
    leads: bool,
) -> Markup {
    let Some((own, one)) = on(claim, column, suite) else {
        return html! {
            @for _ in 0..(if leads { 3 } else { 1 }) { td { (NOTHING) } }
        };
    };
    html! {
        td data-label={ "Seen here, " (column.0) } {
            @let word = one.sample.seen.name();
            @if leads {
                (mark(word)) " " (unbroken(&counted(own, one.sample)))
            } @else {
                (marked(word, html! { span.unseen { (word) } }))
            }
        }
        @if leads {
            td data-label={ "Beyond these records, " (column.0) } {
                (existing(own, one.effect))
            }
            td data-label="How large" {
                (unbroken(&effect_text(own, one.effect).whole()))
            }
        }
    }
}

/// The statement in plain words, behind which the paper's own unfold, and
/// what the effect is; its rules for its sample, and what it says of the
/// effect.
fn statement(claim: &Claim) -> Markup {
    html! {
        details {
            summary { (claim.plain) " (section " (claim.section) ")" }
            "\u{201c}" (claim.quote) "\u{201d} How large: " (claim.measure) "."
        }
        span.source {
            @for (k, one) in claim.yardsticks.iter().enumerate() {
                (if k == 0 { "Seen: " } else { "; " })
                (one.words) ", " (joined(&rule_text(one)))
            }
            @if let Some(said) = said_text(claim) {
                ". Effect: " (joined(&said))
            }
        }
    }
}

/// Numbers that break before their brackets alone.
fn unbroken(text: &str) -> String {
    joined(text)
        .replace(" of ", "\u{a0}of\u{a0}")
        .replace(" to ", "\u{a0}to\u{a0}")
}

/// The numbers by which a result is seen or not.
fn counted(claim: &Claim, result: &ClaimResult) -> String {
    let both = claim.yardsticks.iter().zip(&result.counts);
    let all: Vec<String> = both.map(|(y, n)| count_text(y, n)).collect();
    all.join("; ")
}

/// Every result on every claim.
pub fn every_result(page: &Page<'_>) -> Markup {
    let columns = page.basis.columns();
    let mut head = vec!["Statement and effect"];
    head.extend(columns.iter().map(|(name, _)| name));
    html! {
        @for (theme, _) in THEMES {
            @let question = theme.question();
            (scrolled(&format!("{question}, every result"), html! {
                table.cards.results {
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
            p.source { (claim.measure) " (" (claim.blocks) ")." }
            @if !claim.note.is_empty() { p.source { (claim.note) } }
        }
        @for column in columns {
            td data-label=(column.0) {
                @if let Some(own) = own(claim, *column) {
                    @for one in &own.results { (result(own, one)) }
                }
            }
        }
    }
}

/// A result with all its numbers.
fn result(claim: &Claim, one: &ClaimResult) -> Markup {
    let details: Vec<String> = one.details.iter().map(detail).collect();
    html! {
        div.outcome {
            span.source { (one.place()) ": " }
            (mark(one.seen.name())) ", " (joined(&counted(claim, one)))
            "; beyond these records: " (existing(claim, one)) ", "
            (joined(&effect_text(claim, one).whole()))
            @if !one.at.is_empty() { span.source { " (" (one.at) ")" } }
            @if !details.is_empty() {
                p.source { (joined(&details.join("; "))) "." }
            }
        }
    }
}

fn detail(of: &Detail) -> String {
    let number = EstimateText::of(&of.estimate, ValueScale::Plain, None);
    format!("{}: {}", of.name, number.whole())
}
