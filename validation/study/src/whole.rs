//! The study from suites to findings.

use indicatif::ProgressBar;

use crate::analyses::{Plan, SuiteResults};
use crate::claims;
use crate::estimates::median;
use crate::figures;
use crate::findings::study_findings;
use crate::questions::{self, StudyAnswer};
use crate::results::StudyResults;
use rocking_common::findings::Findings;
use rocking_common::paper::{
    FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, position,
};
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
    /// Runs everything on the ordinary and the pulse-type suite. The message
    /// of `progress` is the current stage; `first_answer` receives a sentence
    /// on each suite as soon as its curves are there.
    ///
    /// # Errors
    /// If an analysis fails.
    pub fn run(
        plan: Plan,
        suites: &[StudySuite; 2],
        progress: &ProgressBar,
        first_answer: &dyn Fn(&str),
    ) -> anyhow::Result<Self> {
        let on = |suite: &StudySuite| -> anyhow::Result<SuiteResults> {
            progress.set_message(format!("{} suite", suite.kind));
            let results = plan.run_suite(suite, progress)?;
            first_answer(&median_intensities(&results, &plan)?);
            Ok(results)
        };
        let [first, second] = suites;
        let (ordinary, pulse) = (on(first)?, on(second)?);
        progress.set_message("other choices");
        let varied = plan.sensitivities(first)?;
        progress.set_message("figures and findings");
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

/// Intensities PGA/(g tan alpha) at which half of the motions of a suite
/// overturn the blocks of the reference slenderness, in a sentence.
fn median_intensities(
    suite: &SuiteResults,
    plan: &Plan,
) -> anyhow::Result<String> {
    let curves = suite.curves(plan.common())?;
    let of_frequency = |(k, p): (usize, &f64)| {
        let first = curves[position(k, REFERENCE)]
            .iter()
            .map(|curve| curve.overturning_im().unwrap_or(f64::INFINITY));
        let im = median(&first.collect::<Vec<f64>>()).value();
        if im.is_finite() {
            format!("{im:.2} (p = {p} rad/s)")
        } else {
            format!("no intensity of the grid (p = {p} rad/s)")
        }
    };
    let all = FREQUENCIES_RAD_S.iter().enumerate().map(of_frequency);
    Ok(format!(
        "half of the {} {} motions overturn a block with alpha = {} at \
         PGA/(g tan alpha) = {}",
        suite.records.len(),
        suite.kind,
        SLENDERNESSES_RAD[REFERENCE],
        all.collect::<Vec<_>>().join(", "),
    ))
}
