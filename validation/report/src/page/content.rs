//! Results from which every section of the page takes its own.

use crate::basis::FindingSets;
use crate::evidence::Proof;
use crate::head::Signatures;
use crate::shaking::RockTests;
use crate::timings::Timings;
use crate::words::Words;
use rocking_common::paper::Arm;
use rocking_draw::figures::{Figure, Place};
use rocking_study::Study;

/// Title of the page.
pub(crate) const TITLE: &str =
    "Rocking blocks: a published study repeated and checked";

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
    /// The kept tests on a shaking table.
    pub tests: &'a RockTests,
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
    pub fn is_on_the_papers_grid(&self, figure: &Figure) -> bool {
        self.study.results.plan.drawn().len() > 1
            && figure.heading.own_arm() == Some(Arm::A)
    }

    /// The figures that stand outside that annex.
    pub fn shown(&self) -> Vec<&'a Figure> {
        let all = self.figures.iter().chain(self.charts);
        all.filter(|figure| !self.is_on_the_papers_grid(figure)).collect()
    }

    /// The figures that belong to a place.
    pub fn placed(&self, place: Place) -> Vec<&'a Figure> {
        let mut figures = self.shown();
        figures.retain(|figure| figure.heading.place == place);
        figures
    }
}
