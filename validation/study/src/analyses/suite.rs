//! Results of the analyses of a suite.

use rocking::capacity::ResponseCurve;
use rocking_records::SetAside;
use rocking_statistics::Clusters;

use crate::distributions::{BlockSamples, Distributions};
use crate::estimates::median;
use crate::facts::Facts;
use crate::runs::{ArmCurves, ChainWork, curves_of, not_run};
use rocking_common::findings::RecordName;
use rocking_common::paper::{Arm, Intensity, SuiteKind, position};
use rocking_common::suites::SuiteSource;

/// Demands on the stripes, cut by the first overturnings of one grid.
#[derive(Clone, Debug)]
pub struct StripeDemands {
    /// The grid.
    pub arm: Arm,
    /// By block (15), then by stripe, then by record.
    pub demands: Vec<Vec<Vec<f64>>>,
    /// Demands with adjusted slenderness: by frequency, then by stripe, then by
    /// record.
    pub adjusted: Vec<Vec<Vec<f64>>>,
    /// Whether a record stands at a stripe at or above its first
    /// overturning, by block, then by stripe, then by record.
    pub stands_again: Vec<Vec<Vec<bool>>>,
}

/// Results of one suite.
#[derive(Clone, Debug)]
pub struct SuiteResults {
    /// `ordinary` or `pulse-type`.
    pub kind: SuiteKind,
    /// Origin of the records.
    pub source: SuiteSource,
    /// Rule by which the study component was chosen, in words.
    pub component_rule: String,
    /// Remarks on suspicious records.
    pub remarks: Option<String>,
    /// Files of the folder or archive that are not records.
    pub set_aside: SetAside,
    /// Hash of the input.
    pub sha256: String,
    /// The records' names and hashes.
    pub list: Vec<RecordName>,
    /// Work of the chains.
    pub work: ChainWork,
    /// The records.
    pub records: Vec<Facts>,
    /// The earthquakes of the records.
    pub clusters: Clusters,
    /// Positions of the records that the single-record figures show.
    pub chosen: [usize; 3],
    /// Curves by grid.
    pub arms: Vec<ArmCurves>,
    /// Capacity samples by grid, PGA then PGV.
    pub distributions: Vec<Distributions>,
    /// Single records by frequency parameter.
    pub single: Vec<SingleRecords>,
    /// Demands on the stripes by grid.
    pub stripes: Vec<StripeDemands>,
    /// Curves with adjusted slenderness by grid, then by frequency, then by
    /// record.
    pub adjusted: Vec<ArmCurves>,
}

impl SuiteResults {
    /// Curves on a grid by block, then by record.
    ///
    /// # Errors
    /// If the grid was not run.
    pub fn curves(&self, arm: Arm) -> anyhow::Result<&[Vec<ResponseCurve>]> {
        curves_of(&self.arms, arm)
    }

    /// Capacity samples on a grid in an intensity measure.
    ///
    /// # Errors
    /// If the grid was not run.
    pub fn distributions(
        &self,
        arm: Arm,
        intensity: Intensity,
    ) -> anyhow::Result<&Distributions> {
        let is = |d: &&Distributions| d.arm == arm && d.intensity == intensity;
        self.distributions.iter().find(is).ok_or_else(|| not_run(arm))
    }

    /// Capacity samples of a block, by the positions of frequency parameter
    /// and slenderness.
    ///
    /// # Errors
    /// If the grid was not run.
    pub fn block(
        &self,
        arm: Arm,
        intensity: Intensity,
        (frequency, slenderness): (usize, usize),
    ) -> anyhow::Result<&BlockSamples> {
        let found = self.distributions(arm, intensity)?;
        Ok(&found.blocks[position(frequency, slenderness)])
    }

    /// Demands on the stripes of a grid.
    ///
    /// # Errors
    /// If the grid was not run.
    pub fn stripes(&self, arm: Arm) -> anyhow::Result<&StripeDemands> {
        let found = self.stripes.iter().find(|own| own.arm == arm);
        found.ok_or_else(|| not_run(arm))
    }
}

/// Theta/alpha every [`HISTORY_INTERVAL_S`](super::HISTORY_INTERVAL_S), and the
/// peak: infinite if the block overturned.
pub type ShownHistory = (Vec<f64>, f64);

/// Histories of the chosen records, and the distance of all records' histories
/// and curves from the reference slenderness, for one frequency parameter.
#[derive(Clone, Debug)]
pub struct SingleRecords {
    /// Level of the histories.
    pub im: f64,
    /// Histories of the chosen records, by record, then by slenderness.
    pub histories: Vec<Vec<ShownHistory>>,
    /// By record, then by slenderness other than the reference.
    pub apart: Vec<Vec<Deviation>>,
    /// The deviations at each of `LEVELS_IM`, which compare the suites.
    pub by_level: Vec<Vec<Vec<Deviation>>>,
}

/// A block compared with the reference slenderness under one record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Normalized L2 distance of the histories; NaN if one overturned.
    pub distance: f64,
    /// Ratio of the peaks; NaN if one overturned.
    pub peak_ratio: f64,
    /// Mean |ln| of the ratio of intensities at equal demand; NaN without a
    /// finite ratio.
    pub mean_ln_im: f64,
}

impl SingleRecords {
    /// Median over records and slendernesses of the defined values.
    pub(crate) fn median_of(&self, of: impl Fn(&Deviation) -> f64) -> f64 {
        let values = self.apart.iter().flatten().map(of);
        let values: Vec<f64> = values.filter(|x| x.is_finite()).collect();
        median(&values).value()
    }
}
