//! The page's sections, in order, but for findings and declared cases.

use maud::{Markup, PreEscaped, html};

use super::annexes::Annex;
use super::chapter::{columns, drawings, folded, folded_table, list};
use super::content::{Page, TITLE};
use super::{cases, findings};
use crate::answers::{self, AnswerRow};
use crate::credibility;
use crate::evidence::{NOT_RUN, Proof};
use crate::head;
use rocking_common::table::PlainTable;
use rocking_common::words::capital;
use rocking_draw::figures::Place;
use rocking_draw::page::table::{self, joined, scrolled};
use rocking_study::results::StudyResults;

/// A block, at rest and tilted.
const SKETCH: &str = include_str!("sketch.svg");

/// Eqs. 1 to 7 as MathML, in a table.
const EQUATIONS: &str = include_str!("equations.html");

/// Anchor, title and body of a section.
type PageSection = (&'static str, &'static str, Markup);

/// What the page is about: what was done, the result, the status, a block.
///
/// # Errors
/// For kept results that cannot be read.
pub fn head(page: &Page<'_>) -> anyhow::Result<Markup> {
    let Page { basis, proof, .. } = page;
    Ok(html! {
        div.about {
            div {
                h1 { (TITLE) }
                @for (first, words) in answers::summary(basis, *proof)? {
                    p { strong { (first) } " " (joined(&words)) }
                }
            }
            figure {
                (PreEscaped(SKETCH))
                figcaption { (page.words.intro) }
            }
        }
    })
}

/// The sections.
///
/// # Errors
/// For kept files that cannot be read.
pub fn page_sections(
    page: &Page<'_>,
    annexes: &[Annex<'_>],
    files: &PlainTable,
) -> anyhow::Result<Vec<PageSection>> {
    Ok(vec![
        ("answers", "Answers", answers(page)?),
        ("scope", "Scope", columns(&page.words.scope)),
        ("findings", "Findings", findings::section(page)),
        ("method", "Method", method(page)),
        ("shaking", "Shaking-table tests", shaking(page)),
        ("evidence", "Proof of the integrator", evidence(page)),
        ("speed", "Speed against error", speed(page)),
        ("limits", "Limits and references", limits(page)),
        ("provenance", "Provenance and sign-off", provenance(page)),
        ("annexes", "Annexes", folded_annexes(page, annexes, files)),
    ])
}

fn answers(page: &Page<'_>) -> anyhow::Result<Markup> {
    let Page { basis, timings, proof, .. } = page;
    let rows = answers::rows(basis, timings, *proof, &page.shown())?;
    let head = ["Question", "Answer", "How much (90 % interval)", "See"];
    let table = html! {
        table.cards.answers {
            caption {
                span.unseen { "Eight questions and their answers." }
            }
            (table::head(&head))
            tbody {
                @for AnswerRow { question, answer, effect, shown } in &rows {
                    tr {
                        th scope="row" { (question) }
                        td data-label="Answer" { (joined(answer)) }
                        td data-label="How much" { (joined(effect)) }
                        td data-label="See" { (links(shown)) }
                    }
                }
            }
        }
    };
    Ok(html! {
        (scrolled("Questions and answers", table))
        @if let Some(words) = answers::differing(basis)? {
            (folded("other-motions", "Answers on other motions", &html! {
                p { (words) }
            }))
        }
        (drawings(&page.placed(Place::Answers)))
    })
}

fn links(shown: &[(String, String)]) -> Markup {
    html! {
        @for (k, (anchor, words)) in shown.iter().enumerate() {
            @if k > 0 { ", " }
            a href={ "#" (anchor) } { (words) }
        }
    }
}

fn method(page: &Page<'_>) -> Markup {
    let mut paragraphs = page.words.method.clone();
    paragraphs.extend(page.proof.map(|proof| proof.coverage().words()));
    html! {
        (folded(
            "procedure",
            "Model, suites, grids, estimators, inference",
            &columns(&paragraphs),
        ))
        (folded("equations", "Equations", &PreEscaped(EQUATIONS.into())))
        (folded("glossary", "Glossary", &html! {
            div.columns { (list(&page.words.glossary)) }
        }))
    }
}

fn shaking(page: &Page<'_>) -> Markup {
    let tests = page.tests;
    html! {
        p { (tests.introduction()) }
        p { (tests.fates()) }
        (table::untitled(&tests.predictors()))
        p { (tests.left_out()) }
        (drawings(&page.placed(Place::ShakingTable)))
        (table::plain(&tests.sentences()))
        (folded_table("shaking-choices", &tests.sensitivity()))
        p { (tests.unknown()) }
    }
}

fn evidence(page: &Page<'_>) -> Markup {
    let cases = page.proof.map_or(NOT_RUN.into(), Proof::to_string);
    html! {
        p { (cases) " " (capital(&page.basis.rounding())) " (annex)." }
        (drawings(&page.placed(Place::Proof)))
    }
}

fn speed(page: &Page<'_>) -> Markup {
    html! {
        p { (page.timings.plain()) }
        (drawings(&page.placed(Place::Speed)))
        (folded_table("settings", &page.timings.settings()))
    }
}

fn limits(page: &Page<'_>) -> Markup {
    let Page { study, basis, proof, words, .. } = page;
    let results = &study.results;
    let credibility = credibility::assessment(results, *proof, basis, words);
    html! {
        @for words in limits_of(results) { p { (words) } }
        p {
            "The model leaves out " (answers::LEFT_OUT) "."
        }
        (folded(
            "deviations",
            "Deviations from the paper",
            &list(&words.deviations),
        ))
        (folded_table("credibility", &credibility.table()))
        (folded("references", "References", &list(&words.references)))
    }
}

/// Limits that the records set.
pub(crate) fn limits_of(results: &StudyResults) -> Vec<&'static str> {
    let mut out = vec![
        "The paper does not list its records, so these suites are not its suites.",
    ];
    if results.embedded() {
        out.push(
            "The embedded suites are synthetic: they show how the procedure \
             works, not how blocks respond to recorded motions.",
        );
    }
    out
}

/// Where the page comes from, and who signs for it, or lines to sign on.
fn provenance(page: &Page<'_>) -> Markup {
    let mut inputs = head::inputs(
        &page.study.results,
        page.proof.is_some(),
        page.signatures,
        page.basis,
    );
    inputs.extend(page.tests.origin());
    html! {
        (folded("inputs", "Program, suites, command", &list(&inputs)))
        div.sign {
        p { (answers::confirmed(page.proof)) }
        ul.signatures {
            @for (what, words) in page.signatures.lines() {
                li {
                    (what) ": "
                    @if let Some(words) = words {
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

fn folded_annexes(
    page: &Page<'_>,
    annexes: &[Annex<'_>],
    files: &PlainTable,
) -> Markup {
    html! {
        (folded("files", &files.title, &table::untitled(files)))
        (folded("all-results", "Every result", &findings::every_result(page)))
        @if let Some(proof) = page.proof {
            (folded("cases", "Every reference case", &cases::every_case(proof)))
        }
        @for one in annexes { (folded(one.id, one.title, &one.body())) }
    }
}
