//! The report: one HTML file that reads without network and without
//! scripts, on a phone, on paper, light or dark.
//!
//! [`page`] is a pure function: what it shows arrives as words and numbers
//! already formatted, and the figures as SVG.

mod figures;
mod sections;
mod table;

use maud::{DOCTYPE, Markup, PreEscaped, html};

use crate::draw::colour;
use crate::paper::Verdict;
use crate::table::PlainTable;

pub use figures::ShownFigure;

const STYLE: &str = include_str!("page/page.css");

/// Everything the page shows, in its order. Text is plain unless a field
/// says otherwise; what is empty is left out.
#[derive(Debug, Clone, Default)]
pub struct ReportInput {
    /// Title of the page.
    pub title: String,
    /// One sentence under the title.
    pub subtitle: String,
    /// The first thing read.
    pub summary: Summary,
    /// The table of findings.
    pub findings: Vec<Finding>,
    /// Whose results of the declared cases these are, or that there are
    /// none.
    pub proof: String,
    /// Declared cases, family by family.
    pub families: Vec<Family>,
    /// Table 1 and any other tables that stand before the figures.
    pub tables: Vec<PlainTable>,
    /// The figures in order.
    pub figures: Vec<ShownFigure>,
    /// Name and value: version, suites with hashes, seeds, settings.
    pub provenance: Vec<(String, String)>,
    /// Known limits, and what was not checked.
    pub limits: Vec<String>,
    /// Tables on credibility: comparison error and uncertainty, and the
    /// like.
    pub credibility: Vec<PlainTable>,
}

/// What was asked, what was found, how far to trust it.
#[derive(Debug, Clone, Default)]
pub struct Summary {
    /// The question, a paragraph.
    pub asked: String,
    /// The answers, a sentence each.
    pub found: Vec<String>,
    /// How far to trust them, a paragraph.
    pub trust: String,
}

/// One claim and what came out.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Unique name, also the anchor.
    pub id: String,
    /// The claim, as quoted.
    pub claim: String,
    /// Where the claim stands: `paper, section 4`.
    pub source: String,
    /// Suite, blocks and arm that it was tested on.
    pub tested_on: String,
    /// What was measured.
    pub measure: String,
    /// Its value with unit.
    pub value: String,
    /// Its interval with level, or what it is compared with.
    pub interval: String,
    /// The margin decided beforehand.
    pub margin: String,
    /// The verdict.
    pub verdict: Verdict,
    /// Names of the figures that show it.
    pub figures: Vec<String>,
    /// A remark, or nothing.
    pub remark: String,
}

/// Declared cases of one kind.
#[derive(Debug, Clone)]
pub struct Family {
    /// Name: `free-rocking`.
    pub name: String,
    /// Why the family exists.
    pub purpose: String,
    /// The cases.
    pub cases: Vec<ShownCase>,
}

/// One declared case.
#[derive(Debug, Clone)]
pub struct ShownCase {
    /// Unique name.
    pub id: String,
    /// What is claimed.
    pub claim: String,
    /// Where the expected value comes from.
    pub source: String,
    /// The tolerance with its kind.
    pub tolerance: String,
    /// Why that tolerance.
    pub because: String,
    /// What was measured.
    pub error: String,
    /// Share of the tolerance that was used, or the like.
    pub margin: String,
    /// Wrong models that fail it.
    pub rejects: String,
    /// Whether it passed.
    pub passed: bool,
}

/// The page.
///
/// ```
/// use rocking_validation::report::page::{ReportInput, page};
/// let html = page(&ReportInput {
///     title: "A & B".into(),
///     ..ReportInput::default()
/// });
/// assert!(html.starts_with("<!DOCTYPE html>"));
/// assert!(html.contains("<h1>A &amp; B</h1>"));
/// ```
#[must_use]
pub fn page(input: &ReportInput) -> String {
    let parts = sections::all(input);
    html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport"
                    content="width=device-width, initial-scale=1";
                meta name="color-scheme" content="light dark";
                title { (input.title) }
                style { (PreEscaped(STYLE)) (PreEscaped(colour::STYLE)) }
            }
            body {
                a.skip href="#main" { "Skip to the content" }
                header {
                    h1 { (input.title) }
                    @if !input.subtitle.is_empty() {
                        p.subtitle { (input.subtitle) }
                    }
                }
                nav aria-label="Contents" { (contents(&parts)) }
                main id="main" tabindex="-1" {
                    @for part in &parts {
                        section id=(part.id)
                            aria-labelledby={ (part.id) "-title" }
                        {
                            h2 id={ (part.id) "-title" } { (part.title) }
                            (part.body)
                        }
                    }
                }
                footer {
                    p { "Drawn from the data files beside this page." }
                }
            }
        }
    }
    .into_string()
        + "\n"
}

/// A section of the page.
struct Part {
    id: &'static str,
    title: &'static str,
    body: Markup,
}

fn contents(parts: &[Part]) -> Markup {
    html! {
        ul {
            @for part in parts {
                li { a href={ "#" (part.id) } { (part.title) } }
            }
        }
    }
}

#[cfg(test)]
mod tests;
