//! Results of the analyses: the input of claims, questions, figures and findings.

use crate::analyses::{Plan, SuiteResults};
use crate::distributions::{BlockSamples, Distributions};
use crate::inference::Resamples;
use crate::sensitivities::{OtherChoice, Variant};
use rocking_common::paper::{Intensity, SuiteKind, position};

/// The analyses of both suites.
#[derive(Clone, Debug)]
pub struct StudyResults {
    /// Plan of the analyses.
    pub plan: Plan,
    /// The ordinary suite.
    pub ordinary: SuiteResults,
    /// The pulse-type suite.
    pub pulse: SuiteResults,
    /// Curves under other choices, ordinary suite.
    pub varied: Vec<Variant>,
}

impl StudyResults {
    /// The draws of the earthquakes that bands and claims share.
    pub fn draws(&self) -> Resamples {
        let clusters = self.suites().map(|s| s.clusters.clone());
        Resamples::new(clusters, self.plan.replicates)
    }

    /// Whether both suites are the embedded ones.
    pub fn embedded(&self) -> bool {
        self.suites().iter().all(|suite| suite.source.is_embedded())
    }

    /// The ordinary and the pulse-type suite.
    pub fn suites(&self) -> [&SuiteResults; 2] {
        [&self.ordinary, &self.pulse]
    }

    /// The suite of a kind.
    pub fn suite(&self, kind: SuiteKind) -> &SuiteResults {
        if kind == self.pulse.kind { &self.pulse } else { &self.ordinary }
    }

    /// The capacity samples on the common grid: ordinary and pulse-type records,
    /// PGA and PGV each.
    pub(crate) fn common(
        &self,
    ) -> impl Iterator<Item = (&SuiteResults, &Distributions)> {
        let arm = self.plan.common();
        self.all_distributions().filter(move |(_, found)| found.arm == arm)
    }

    /// The capacity samples of all suites, grids and intensity measures.
    pub(crate) fn all_distributions(
        &self,
    ) -> impl Iterator<Item = (&SuiteResults, &Distributions)> {
        let suites = self.suites().into_iter();
        suites.flat_map(|own| own.distributions.iter().map(move |d| (own, d)))
    }

    /// The ordinary curves under these choices, each with the study's own
    /// capacities of that block in PGA.
    ///
    /// # Errors
    /// If the common grid was not run.
    pub(crate) fn varied(
        &self,
        choices: &[OtherChoice],
    ) -> anyhow::Result<Vec<(&Variant, &BlockSamples)>> {
        let (arm, pga) = (self.plan.common(), Intensity::Pga);
        let own = &self.ordinary.distributions(arm, pga)?.blocks;
        let of = |v: &Variant| position(v.frequency, v.slenderness);
        let found = self.varied.iter().filter(|v| choices.contains(&v.choice));
        Ok(found.map(|v| (v, &own[of(v)])).collect())
    }
}
