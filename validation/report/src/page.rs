//! The report: one HTML file that reads without network and without
//! scripts, on a phone, on paper, light or dark.
//!
//! [`page`] is a pure function: findings, cases and figures arrive as they
//! are, the rest as words and numbers already formatted.

mod input;
mod sections;

use maud::{DOCTYPE, Markup, html};

use rocking_draw::page::head;

use crate::lab::LAB;
use input::Part;

pub use input::{AnswerRow, Chapter, Column, ReportInput, Shown};

/// The page.
///
/// ```
/// use rocking_report::page::{ReportInput, page};
/// let html = page(&ReportInput {
///     title: "A & B".into(),
///     ..ReportInput::default()
/// });
/// assert!(html.starts_with("<!DOCTYPE html>"));
/// assert!(html.contains("<h1>A &amp; B</h1>"));
/// ```
pub fn page(input: &ReportInput<'_>) -> String {
    let parts = sections::all(input);
    html! {
        (DOCTYPE)
        html lang="en" {
            (head(&input.title))
            body {
                a.skip href="#main" { "Skip to the content" }
                header {
                    (sections::head(input))
                }
                nav aria-label="Contents" { (contents(&parts, input.lab)) }
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

fn contents(parts: &[Part], lab: bool) -> Markup {
    html! {
        ul {
            @for part in parts {
                li { a href={ "#" (part.id) } { (part.title) } }
            }
            @if lab { li { a href=(LAB) { "Recompute in your browser" } } }
        }
    }
}

#[cfg(test)]
mod tests;
