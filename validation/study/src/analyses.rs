//! All analyses of a study, in a fixed order for any number of threads.

mod plan;
mod single;
mod stripes;
mod suite;

pub use plan::Plan;
pub(crate) use plan::no_arm;
pub use single::HISTORY_INTERVAL_S;
pub use suite::{
    Apart, ArmCurves, Facts, SPECTRUM_PERIODS_S, ShownHistory, SingleRecords,
    StripeDemands, SuiteResults, Work, facts,
};

use indicatif::ProgressBar;
use rayon::prelude::*;
use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::ida::Adjust;

use crate::runs::Setup;
use rocking_common::findings::RecordName;
use rocking_common::paper::{BLOCKS, FREQUENCIES_RAD_S, REFERENCE, position};
use rocking_common::suites::StudySuite;

impl Plan {
    /// Runs everything for one suite.
    ///
    /// # Errors
    /// Where an analysis cannot be done.
    pub fn run(
        &self,
        suite: &StudySuite,
        progress: &ProgressBar,
    ) -> anyhow::Result<SuiteResults> {
        let records: Vec<NormalisedRecord> = suite
            .motions
            .iter()
            .map(|m| NormalisedRecord::new(&m.study))
            .collect();
        let facts: Vec<Facts> =
            suite.motions.par_iter().map(facts).collect::<Result<_, _>>()?;
        let scans = Setup::scans(&self.arms).len();
        let chains = scans * BLOCKS.len() * records.len();
        progress.inc_length(chains as u64);
        let (arms, work) = self.curves(&BLOCKS, &records, progress)?;
        let ratios: Vec<f64> =
            facts.iter().map(|f| f.velocity_ratio_s).collect();
        let mut results = SuiteResults {
            kind: suite.kind,
            source: suite.source.clone(),
            component_rule: suite.component_rule.clone(),
            remarks: suite.remarks.words(),
            set_aside: suite.set_aside.clone(),
            sha256: suite.sha256(),
            list: suite
                .list()
                .into_iter()
                .map(|(name, sha256)| RecordName { name, sha256 })
                .collect(),
            work,
            records: facts,
            clusters: suite.clusters.clone(),
            chosen: [0; 3],
            arms,
            single: Vec::new(),
            stripes: Vec::new(),
            adjusted: Vec::new(),
            contents: self.contents(&records, progress)?,
        };
        results.chosen = self.shown_alone(&results, &ratios)?;
        for frequency in 0..FREQUENCIES_RAD_S.len() {
            let single =
                self.single(frequency, &BLOCKS, &records, &results)?;
            results.single.push(single);
        }
        results.adjusted = self.adjusted(&BLOCKS, &records, progress)?;
        results.stripes = self.stripes(&BLOCKS, &records, &results)?;
        Ok(results)
    }

    fn curves(
        &self,
        blocks: &[Block],
        records: &[NormalisedRecord],
        progress: &ProgressBar,
    ) -> anyhow::Result<(Vec<ArmCurves>, Work)> {
        let method = Adjust::RecordScaling;
        let done = || progress.inc(1);
        let chains =
            self.setup.chains(blocks, records, &self.arms, method, done)?;
        let arms = self.arms.iter().zip(chains.curves);
        let arms = arms.map(|(arm, curves)| ArmCurves { arm: *arm, curves });
        let work =
            Work { analyses: chains.analyses, certainty: chains.certainty };
        Ok((arms.collect(), work))
    }

    fn adjusted(
        &self,
        blocks: &[Block],
        records: &[NormalisedRecord],
        progress: &ProgressBar,
    ) -> anyhow::Result<Vec<ArmCurves>> {
        let drawn = self.drawn();
        let references: Vec<Block> = (0..FREQUENCIES_RAD_S.len())
            .map(|frequency| blocks[position(frequency, REFERENCE)])
            .collect();
        let tasks = drawn.len() * references.len() * records.len();
        progress.inc_length(tasks as u64);
        let method = Adjust::SlendernessAdjustment;
        let done = || progress.inc(1);
        let chains =
            self.setup.chains(&references, records, &drawn, method, done)?;
        let arms = drawn.into_iter().zip(chains.curves);
        Ok(arms.map(|(arm, curves)| ArmCurves { arm, curves }).collect())
    }
}
