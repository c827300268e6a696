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
use crate::sentences::{SentenceCounts, SuiteResult, by_suite, by_theme};
use rocking_common::findings::{
    Claim, ClaimResult, Detail, Exists, Kind, SuiteSet, Theme,
};
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

/// What stands where there is nothing to say.
const NOTHING: &str = "\u{2013}";

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
        "The paper by its own criteria. Seen here: the paper's rule as a \
         plain number of the sample, on the paper's grid (arm A) where this \
         was run. Exists: whether the 90 % interval of the effect, by \
         resampled earthquakes, leaves no effect out: yes, also of an effect \
         that the sentence denies, or the opposite of what it says. How \
         large: the effect with that interval, on the finer grid (arm C) where this was \
         run. Figures are of the suites of the first columns. All suites and \
         grids: "
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
            ". " (SentenceCounts::of(findings).words())
        }
    }
}

/// A word on a claim behind a sign that stands without colour.
fn mark(word: &str) -> Markup {
    let (class, sign) = match word {
        "yes" => ("verdict yes", "✓"),
        "no" | "the opposite" => ("verdict no", "✗"),
        "in part" => ("verdict open", "◐"),
        "no sign" => ("verdict open", "○"),
        NOTHING => return html! { (NOTHING) },
        _ => ("verdict open", "?"),
    };
    html! {
        span class=(class) { span aria-hidden="true" { (sign) " " } (word) }
    }
}

/// Whether an effect exists, in a word.
fn existing(result: &ClaimResult) -> &'static str {
    result.exists.map_or(NOTHING, Exists::name)
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

/// A row of a table of findings: a claim on a suite, with how many rows its
/// sentence and the claim span where they begin.
struct FindingRow<'a> {
    claim: &'a Claim,
    suite: SuiteSet,
    sentence: Option<usize>,
    claim_rows: Option<usize>,
}

/// The rows of claims of one sentence.
fn rows<'a>(
    group: &[&'a Claim],
    columns: &[FindingColumn<'_>],
) -> Vec<FindingRow<'a>> {
    let mut rows = Vec::new();
    for claim in group {
        let tested =
            |suite| columns.iter().any(|own| on(claim, *own, suite).is_some());
        let suites: Vec<SuiteSet> =
            SuiteSet::ALL.into_iter().filter(|s| tested(*s)).collect();
        rows.extend(suites.iter().enumerate().map(|(k, suite)| FindingRow {
            claim,
            suite: *suite,
            sentence: None,
            claim_rows: (k == 0).then_some(suites.len()),
        }));
    }
    let all = rows.len();
    rows.iter_mut().take(1).for_each(|row| row.sentence = Some(all));
    rows
}

fn findings(page: &Page<'_>, theme: Theme) -> Markup {
    let columns = page.basis.columns();
    let claims = claims(page, theme);
    // Claims of one sentence stand under it.
    let groups = claims.chunk_by(|a, b| a.quote == b.quote);
    html! {
        table.cards.findings {
            caption { span.unseen { "The paper by its own criteria." } }
            thead {
                tr {
                    th scope="col" rowspan="2" { "The paper's words" }
                    th scope="col" rowspan="2" {
                        "In plain words, with the paper's criterion and the \
                         effect"
                    }
                    th scope="col" rowspan="2" { "Suite" }
                    @for (k, (name, _)) in columns.iter().enumerate() {
                        @let span = if k == 0 { 3 } else { 2 };
                        th scope="colgroup" colspan=(span) { (name) }
                    }
                }
                tr {
                    @for k in 0..columns.len() {
                        th scope="col" { "Seen here?" }
                        th scope="col" { "Exists beyond?" }
                        @if k == 0 { th scope="col" { "How large" } }
                    }
                }
            }
            tbody {
                @for row in groups.flat_map(|group| rows(group, &columns)) {
                    (finding(&row, &columns))
                }
            }
        }
    }
}

fn finding(row: &FindingRow<'_>, columns: &[FindingColumn<'_>]) -> Markup {
    let FindingRow { claim, suite, .. } = *row;
    let id = row.claim_rows.map(|_| format!("finding-{}", claim.id));
    html! {
        tr id=[id] {
            @if let Some(rows) = row.sentence {
                th scope="row" rowspan=(rows) { (quotation(claim)) }
            }
            @if let Some(rows) = row.claim_rows {
                td data-label="In plain words" rowspan=(rows) {
                    (statement(claim))
                }
            }
            td data-label="Suite" { (suite.name()) }
            @for (k, column) in columns.iter().enumerate() {
                @let found = on(claim, *column, suite);
                td data-label={ "Seen here, " (column.0) } {
                    @if let Some((own, one)) = found {
                        (mark(one.sample.seen.name()))
                        @if k == 0 { " " (unbroken(&counted(own, one.sample))) }
                    } @else { (NOTHING) }
                }
                td data-label={ "Exists, " (column.0) } {
                    (mark(found.map_or(NOTHING, |(_, one)| existing(one.effect))))
                }
                @if k == 0 {
                    td data-label="How large" {
                        @if let Some((own, one)) = found {
                            (unbroken(&effect_text(own, one.effect).whole()))
                        } @else { (NOTHING) }
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

/// The statement, the paper's rules for its sample, and its effect.
fn statement(claim: &Claim) -> Markup {
    html! {
        (claim.plain)
        span.source {
            @for (k, one) in claim.yardsticks.iter().enumerate() {
                (if k == 0 { ". Seen: " } else { "; " })
                (one.words) ", " (joined(&rule_text(one)))
            }
            ". Effect: " (claim.measure)
            @if let Some(said) = said_text(claim) {
                "; said: " (joined(&said))
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
    let mut head = vec!["Claim and effect"];
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
            "; exists: " (mark(existing(one))) ", "
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
