//! What the analyses gave: what claims, questions, figures and findings read.

use crate::analyses::{Plan, SuiteResults};
use crate::distributions::{BlockSamples, Distributions};
use crate::inference::Draws;
use crate::runs::not_run;
use crate::sensitivities::{Choice, Varied};
use rocking::capacity::ResponseCurve;
use rocking_common::paper::{Arm, Intensity, SuiteKind, position};

/// The analyses of both suites.
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
    /// The draws of the earthquakes that bands and claims share; `times` as
    /// many as are enough for most claims.
    #[must_use]
    pub fn draws(&self, times: usize) -> Draws {
        Draws::new(self.suites().map(|s| s.clusters.clone()), times)
    }

    /// Whether the suites are the embedded ones.
    #[must_use]
    pub fn embedded(&self) -> bool {
        self.suites().iter().all(|suite| suite.source.is_embedded())
    }

    /// The ordinary and the pulse-type suite.
    #[must_use]
    pub fn suites(&self) -> [&SuiteResults; 2] {
        [&self.ordinary, &self.pulse]
    }

    /// The suite of that kind.
    #[must_use]
    pub fn suite(&self, kind: SuiteKind) -> &SuiteResults {
        if kind == self.pulse.kind { &self.pulse } else { &self.ordinary }
    }

    /// The capacity samples of a suite in an arm and a measure.
    ///
    /// # Errors
    /// If the arm was not run.
    pub fn distributions(
        &self,
        kind: SuiteKind,
        arm: Arm,
        intensity: Intensity,
    ) -> anyhow::Result<&Distributions> {
        let is = |d: &&Distributions| {
            d.kind == kind && d.arm == arm && d.intensity == intensity
        };
        self.distributions.iter().find(is).ok_or_else(|| not_run(arm))
    }

    /// The capacity samples in the arm of all suites: ordinary and
    /// pulse-type records, PGA and PGV each.
    pub(crate) fn common(
        &self,
    ) -> impl Iterator<Item = (&SuiteResults, &Distributions)> {
        let arm = self.plan.common();
        let own = self.distributions.iter().filter(move |d| d.arm == arm);
        own.map(|d| (self.suite(d.kind), d))
    }

    /// The ordinary curves under these choices, each with the study's own
    /// curves of that block.
    ///
    /// # Errors
    /// If the arm was not run.
    pub(crate) fn varied(
        &self,
        choices: &[Choice],
    ) -> anyhow::Result<Vec<(&Varied, &[ResponseCurve])>> {
        let curves = self.ordinary.curves(self.plan.common())?;
        let of = |v: &Varied| position(v.frequency, v.slenderness);
        let found = self.varied.iter().filter(|v| choices.contains(&v.choice));
        Ok(found.map(|v| (v, curves[of(v)].as_slice())).collect())
    }

    /// One block of the ordinary suite.
    ///
    /// # Errors
    /// If the arm was not run.
    pub(crate) fn ordinary_block(
        &self,
        arm: Arm,
        intensity: Intensity,
        frequency: usize,
        slenderness: usize,
    ) -> anyhow::Result<&BlockSamples> {
        let kind = self.ordinary.kind;
        let found = self.distributions(kind, arm, intensity)?;
        Ok(&found.blocks[position(frequency, slenderness)])
    }
}
