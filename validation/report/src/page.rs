//! The report: one HTML file that reads without network and without
//! scripts, on a phone, on paper, light or dark.
//!
//! Each section of the [`Page`] is a function of the results themselves.

mod annexes;
mod cases;
mod chapter;
mod content;
mod findings;
mod sections;

use maud::{DOCTYPE, html};

use crate::lab::LAB;
use rocking_common::table::PlainTable;
use rocking_draw::page::head;

pub(crate) use annexes::{Annex, annexes};
pub(crate) use content::{Page, TITLE};
#[cfg(test)]
pub(crate) use sections::limits_of;

/// The page with these annexes and this list of files.
///
/// # Errors
/// For kept files that cannot be read.
pub(crate) fn html(
    page: &Page<'_>,
    annexes: &[Annex<'_>],
    files: &PlainTable,
) -> anyhow::Result<String> {
    let header = sections::head(page)?;
    let sections = sections::page_sections(page, annexes, files)?;
    let markup = html! {
        (DOCTYPE)
        html lang="en" {
            (head(TITLE))
            body {
                a.skip href="#main" { "Skip to the content" }
                header { (header) }
                nav aria-label="Contents" {
                    ul {
                        @for (id, title, _) in &sections {
                            li { a href={ "#" (id) } { (title) } }
                        }
                        @if page.lab {
                            li {
                                a href=(LAB) { "Recompute" }
                            }
                        }
                    }
                }
                main id="main" tabindex="-1" {
                    @for (id, title, body) in &sections {
                        section id=(id)
                            aria-labelledby={ (id) "-title" }
                        {
                            h2 id={ (id) "-title" } { (title) }
                            (body)
                        }
                    }
                }
                footer {
                    p { "Drawn from the data files beside this page." }
                }
            }
        }
    };
    Ok(markup.into_string() + "\n")
}

#[cfg(test)]
mod tests;
