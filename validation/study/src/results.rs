//! What the analyses gave: what claims, questions, figures and findings read.

use crate::analyses::{Plan, SuiteResults, no_arm};
use crate::distributions::{BlockSamples, Distributions};
use crate::inference::Draws;
use crate::sensitivities::Varied;
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
        let clusters = [&self.ordinary, &self.pulse].map(|s| &s.clusters);
        Draws::new(clusters.map(Clone::clone), times)
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

    /// The capacity samples of a suite in an arm and a measure.
    #[must_use]
    pub fn distributions(
        &self,
        kind: SuiteKind,
        arm: Arm,
        intensity: Intensity,
    ) -> Option<&Distributions> {
        self.distributions.iter().find(|d| {
            d.kind == kind && d.arm == arm && d.intensity == intensity
        })
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
        let found = self.distributions(kind, arm, intensity);
        let found = found.ok_or_else(no_arm)?;
        Ok(&found.blocks[position(frequency, slenderness)])
    }
}
