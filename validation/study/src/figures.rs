//! The paper's figures, filled from the analyses.

mod distributions;
mod fragilities;
mod quantiles;
mod ratios;
mod single;

pub(crate) use fragilities::{BLOCK, Fits, THRESHOLDS, distance, usfl7};
pub(crate) use ratios::{adjusted_boxes, adjusted_split, of_arm, pairs};
pub(crate) use single::median_of;

use super::StudyError;
use super::analyses::{Plan, SuiteResults};
use super::distributions::Distributions;
use super::inference::Draws;
use super::sensitivities::Varied;
use rocking_common::paper::{Arm, SuiteKind};
use rocking_draw::figures::Figure;

/// Everything that the figures are made of.
#[derive(Clone, Debug)]
pub struct Results {
    /// What was run.
    pub plan: Plan,
    /// The ordinary suite.
    pub ordinary: SuiteResults,
    /// The pulse-type suite.
    pub pulse: SuiteResults,
    /// Capacity samples: suites, arms, measures.
    pub distributions: Vec<Distributions>,
    /// Curves under other choices, ordinary suite.
    pub varied: Vec<Varied>,
}

impl Results {
    /// Figures 1 to 18, in order; those of the grid's arms once for each arm
    /// drawn. Bands are of these draws of the records.
    ///
    /// # Errors
    /// [`StudyError`] where a curve cannot be read.
    pub fn figures(&self, draws: &Draws) -> Result<Vec<Figure>, StudyError> {
        let drawn = self.plan.drawn();
        let mut out = vec![single::sketch()];
        let one = self.plan.common();
        out.push(single::histories(&self.ordinary, one, 2));
        out.push(single::histories(&self.pulse, one, 3));
        out.push(single::curves(&self.ordinary, one, 4)?);
        out.push(single::curves(&self.pulse, one, 5)?);
        for number in [6, 7] {
            for arm in &drawn {
                out.extend(ratios::slendernesses(
                    &self.ordinary,
                    *arm,
                    number,
                )?);
            }
        }
        out.push(quantiles::slendernesses(&self.ordinary, &drawn)?);
        for arm in &drawn {
            out.extend(ratios::adjusted(&self.ordinary, *arm)?);
        }
        for arm in &drawn {
            out.push(quantiles::adjusted(&self.ordinary, *arm)?);
        }
        out.push(distributions::inverted(self, one)?);
        out.push(distributions::shares(self, 12)?);
        for arm in &drawn {
            out.push(distributions::along(self, *arm)?);
        }
        out.push(distributions::shares(self, 14)?);
        for number in [15, 16, 17] {
            out.push(fragilities::thresholds(self, draws, one, number)?);
        }
        out.push(fragilities::constants(self, one)?);
        Ok(out)
    }

    /// The draws of the records that bands and claims share.
    #[must_use]
    pub fn draws(&self) -> Draws {
        Draws::new([&self.ordinary, &self.pulse].map(|s| s.records.len()))
    }

    /// Whether the suites are the embedded ones.
    #[must_use]
    pub fn embedded(&self) -> bool {
        let suites = [&self.ordinary, &self.pulse];
        suites.iter().all(|suite| suite.source.is_embedded())
    }

    /// The suite of that kind.
    #[must_use]
    pub fn suite(&self, kind: SuiteKind) -> &SuiteResults {
        if kind == self.pulse.kind { &self.pulse } else { &self.ordinary }
    }
}

/// Name of a figure, with the arm's letter where both arms have one.
fn name(number: u32, arm: Option<Arm>) -> String {
    match arm {
        Some(arm) => {
            format!("figure-{number:02}-{}", arm.letter().to_lowercase())
        }
        None => format!("figure-{number:02}"),
    }
}
