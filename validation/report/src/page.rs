//! The report: one HTML file that reads without network and without
//! scripts, on a phone, on paper, light or dark.
//!
//! Each section of the [`Page`] is a function of the results themselves.

mod annexes;
mod cases;
mod chapter;
mod findings;
mod sections;

use maud::{DOCTYPE, html};

use crate::basis::FindingSets;
use crate::evidence::Proof;
use crate::head::Signatures;
use crate::lab::LAB;
use crate::timings::Timings;
use crate::words::Words;
use rocking_common::paper::Arm;
use rocking_common::table::PlainTable;
use rocking_draw::figures::{Figure, Place};
use rocking_draw::page::head;
use rocking_study::Study;

pub(crate) use annexes::{Annex, annexes};
#[cfg(test)]
pub(crate) use sections::limits_of;

/// Title of the page.
pub(crate) const TITLE: &str = "The statistics of rocking";

/// Results from which every section takes its own.
pub(crate) struct Page<'a> {
    /// The run at hand.
    pub study: &'a Study,
    /// The findings of the run, and the kept ones.
    pub basis: &'a FindingSets<'a>,
    /// Figures of the study, those of the recorded suites among them.
    pub figures: &'a [Figure],
    /// Figures of proof, speed and other codes.
    pub charts: &'a [Figure],
    /// Results of the declared cases, if they were handed in.
    pub proof: Option<&'a Proof>,
    /// Who signs.
    pub signatures: &'a Signatures,
    /// The kept timings.
    pub timings: &'a Timings,
    /// Words that no run changes.
    pub words: Words,
    /// Whether the page that recomputes lies beside this one.
    pub lab: bool,
}

impl<'a> Page<'a> {
    /// Whether a figure stands in the annex of the paper's grid: one of arm A
    /// that arm C has as well.
    fn is_on_the_papers_grid(&self, figure: &Figure) -> bool {
        self.study.results.plan.drawn().len() > 1
            && figure.heading.own_arm() == Some(Arm::A)
    }

    /// The figures that stand outside that annex.
    fn shown(&self) -> Vec<&'a Figure> {
        let all = self.figures.iter().chain(self.charts);
        all.filter(|figure| !self.is_on_the_papers_grid(figure)).collect()
    }

    /// The figures that belong to a place.
    fn placed(&self, place: Place) -> Vec<&'a Figure> {
        let mut figures = self.shown();
        figures.retain(|figure| figure.heading.place == place);
        figures
    }

    /// The page with these annexes and this list of files.
    ///
    /// # Errors
    /// For kept files that cannot be read.
    pub fn html(
        &self,
        annexes: &[Annex<'_>],
        files: &PlainTable,
    ) -> anyhow::Result<String> {
        let sections = sections::page_sections(self, annexes, files)?;
        let page = html! {
            (DOCTYPE)
            html lang="en" {
                (head(TITLE))
                body {
                    a.skip href="#main" { "Skip to the content" }
                    header { (sections::head(self)) }
                    nav aria-label="Contents" {
                        ul {
                            @for (id, title, _) in &sections {
                                li { a href={ "#" (id) } { (title) } }
                            }
                            @if self.lab {
                                li {
                                    a href=(LAB) { "Recompute in your browser" }
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
        Ok(page.into_string() + "\n")
    }
}

#[cfg(test)]
mod tests;
