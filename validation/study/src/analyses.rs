//! All analyses of a study, in the same order for any number of threads.

mod plan;
mod single;
mod stripes;
mod suite;

pub use plan::Plan;
pub use single::HISTORY_INTERVAL_S;
pub use suite::{
    Deviation, ShownHistory, SingleRecords, StripeDemands, SuiteResults,
};

use indicatif::ProgressBar;
use rayon::prelude::*;
use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::ida::Adjust;

use crate::distributions::suite_distributions;
use crate::facts::{Facts, facts};
use crate::runs::curves_of;
use rocking_common::paper::BLOCKS;
use rocking_common::suites::StudySuite;

/// The study components, prepared for analyses.
pub(crate) fn normalised(suite: &StudySuite) -> Vec<NormalisedRecord> {
    let motions = suite.motions.iter();
    motions.map(|m| NormalisedRecord::new(&m.study)).collect()
}

impl Plan {
    /// Runs everything for one suite.
    ///
    /// # Errors
    /// If an analysis fails.
    pub fn run_suite(
        &self,
        suite: &StudySuite,
        progress: &ProgressBar,
    ) -> anyhow::Result<SuiteResults> {
        let records = normalised(suite);
        let facts: Vec<Facts> =
            suite.motions.par_iter().map(facts).collect::<Result<_, _>>()?;
        let chains = |blocks: &[Block], arms: &[_], adjust| {
            self.setup.chains(blocks, &records, arms, adjust, progress)
        };
        let (arms, work) = chains(&BLOCKS, &self.arms, Adjust::RecordScaling)?;
        let common = curves_of(&arms, self.common())?;
        let chosen = single::shown_alone(common, &facts);
        let single =
            single::single_records(&self.setup, &records, common, chosen)?;
        let adjusting = Adjust::SlendernessAdjustment;
        let (adjusted, _) =
            chains(&stripes::references(), &self.drawn(), adjusting)?;
        let stripes =
            stripes::stripe_demands(&self.setup, &records, &arms, &adjusted)?;
        let distributions =
            suite_distributions(suite.kind, &facts, &arms, self.common())?;
        Ok(SuiteResults {
            kind: suite.kind,
            source: suite.source.clone(),
            component_rule: suite.component_rule.clone(),
            remarks: suite.remarks.words(),
            set_aside: suite.set_aside.clone(),
            sha256: suite.sha256(),
            list: suite.list(),
            work,
            records: facts,
            clusters: suite.clusters.clone(),
            chosen,
            arms,
            distributions,
            single,
            stripes,
            adjusted,
        })
    }
}
