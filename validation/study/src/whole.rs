//! The study from suites to findings.

use indicatif::ProgressBar;

use crate::analyses::Plan;
use crate::claims;
use crate::figures;
use crate::findings::study_findings;
use crate::questions::{self, StudyAnswer};
use crate::results::StudyResults;
use rocking_common::findings::Findings;
use rocking_common::suites::StudySuite;
use rocking_draw::figures::Figure;

/// A finished study.
pub struct Study {
    /// Results of the analyses.
    pub results: StudyResults,
    /// The figures; those of the answers come last.
    pub figures: Vec<Figure>,
    /// The findings.
    pub findings: Findings,
    /// Answers to the questions beyond the paper, without their figures.
    pub answers: Vec<StudyAnswer>,
}

impl Study {
    /// Runs everything on the ordinary and the pulse-type suite.
    ///
    /// # Errors
    /// If an analysis fails.
    pub fn run(
        plan: Plan,
        suites: &[StudySuite; 2],
        progress: &ProgressBar,
    ) -> anyhow::Result<Self> {
        let [first, second] = suites;
        let ordinary = plan.run_suite(first, progress)?;
        let pulse = plan.run_suite(second, progress)?;
        let varied = plan.sensitivities(first)?;
        let results = StudyResults { plan, ordinary, pulse, varied };
        let draws = results.draws();
        let mut figures = figures::paper_figures(&results, &draws)?;
        let mut answers = questions::study_answers(&results)?;
        for answer in &mut answers {
            figures.append(&mut answer.figures);
        }
        let claims = claims::measured_claims(&results, &draws)?;
        let findings = study_findings(&results, &draws, claims, &answers)?;
        Ok(Self { results, figures, findings, answers })
    }
}
