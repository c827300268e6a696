//! The whole study: 15 blocks, two suites, three arms of the intensity grid;
//! figures, their data, and what was found about the paper's claims.

pub mod analyses;
pub mod certainty;
pub mod claims;
pub mod distributions;
pub mod figures;
pub mod findings;
pub mod normality;
pub mod questions;
pub mod runs;
pub mod sensitivities;

use indicatif::ProgressBar;
use rocking::block::BlockError;
use rocking::capacity::CapacityError;
use rocking::ida::IdaError;
use rocking::integrator::SceneError;
use rocking::intensity::IntensityError;
use rocking::statistics::SampleError;
use rocking::statistics::boxplot::BoxplotError;
use rocking::statistics::paired::PairedError;
use rocking::statistics::quantile::QuantileError;
use thiserror::Error;

use crate::draw::figures::Figure;
use crate::suites::{StudySuite, StudySuiteError};
use analyses::Plan;
use claims::Claim;
use distributions::of_suite;
use figures::Results;
use findings::Findings;
use questions::Answer;

/// Why a study could not be done.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum StudyError {
    /// A suite that was refused.
    #[error(transparent)]
    Suite(#[from] StudySuiteError),
    /// A block outside the model's range.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// A chain that cannot be done.
    #[error(transparent)]
    Ida(#[from] IdaError),
    /// A run that cannot be done.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A record whose intensity cannot be measured.
    #[error(transparent)]
    Intensity(#[from] IntensityError),
    /// A curve that cannot be inverted.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// A sample without values, or with one that is not a number.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// A quantile that does not exist.
    #[error(transparent)]
    Quantile(#[from] QuantileError),
    /// A box that reaches infinity.
    #[error(transparent)]
    Boxplot(#[from] BoxplotError),
    /// Pairs that cannot be compared.
    #[error(transparent)]
    Paired(#[from] PairedError),
    /// At least one arm must be run.
    #[error("no arm of the grid: expected one of A, B, C")]
    NoArm,
}

/// A finished study.
pub struct Study {
    /// What the analyses gave.
    pub results: Results,
    /// The figures, those of the answers at the end.
    pub figures: Vec<Figure>,
    /// The claims and what was found about them.
    pub claims: Vec<Claim>,
    /// Answers to the questions beyond the paper; their figures are among
    /// the others.
    pub answers: Vec<Answer>,
    findings: Findings,
}

impl Study {
    /// Runs everything: `suites` are the ordinary and the pulse-type one;
    /// `full` runs other choices on all blocks.
    ///
    /// # Errors
    /// [`StudyError`] where an analysis cannot be done.
    pub fn run(
        plan: Plan,
        suites: &[StudySuite; 2],
        full: bool,
        progress: &ProgressBar,
    ) -> Result<Self, StudyError> {
        let [first, second] = suites;
        let ordinary = plan.run(first, true, progress)?;
        let pulse = plan.run(second, false, progress)?;
        let common = plan.common();
        let mut distributions = of_suite(&ordinary, common)?;
        distributions.extend(of_suite(&pulse, common)?);
        let varied = plan.sensitivities(first, full)?;
        let results = Results { plan, ordinary, pulse, distributions, varied };
        let mut figures = results.figures()?;
        let mut answers = questions::all(&results, full)?;
        for answer in &mut answers {
            figures.append(&mut answer.figures);
        }
        let claims = claims::all(&results)?;
        let findings = findings::all(&results, &claims, &answers)?;
        Ok(Self { results, figures, claims, findings, answers })
    }

    /// Text of `findings.json`.
    #[must_use]
    pub fn findings_text(&self) -> String {
        findings::text(&self.findings)
    }
}
