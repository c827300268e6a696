//! Results of the analyses of a suite.

use rocking::block::Block;
use rocking::capacity::ResponseCurve;
use rocking_records::SetAside;
use rocking_statistics::Clusters;

use crate::distributions::{BlockSamples, Distributions};
use crate::facts::Facts;
use crate::runs::{ArmCurves, ChainWork, curves_of, not_run};
use rocking_common::findings::RecordName;
use rocking_common::paper::{Arm, Intensity, SuiteKind, position};
use rocking_common::suites::SuiteSource;

/// Demands on the stripes for one arm's first overturnings.
#[derive(Clone, Debug)]
pub struct StripeDemands {
    /// The arm.
    pub arm: Arm,
    /// By block (15), then by stripe, then by record.
    pub demands: Vec<Vec<Vec<f64>>>,
    /// By frequency, then by stripe, then by record: slenderness adjusted.
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
    /// Where the records come from.
    pub source: SuiteSource,
    /// Who chose the study component, in words.
    pub component_rule: String,
    /// Remarks on suspicious records.
    pub remarks: Option<String>,
    /// Files of the folder or archive that are no records.
    pub set_aside: SetAside,
    /// Hash of the input.
    pub sha256: String,
    /// The records' names and hashes.
    pub list: Vec<RecordName>,
    /// Work that the chains took.
    pub work: ChainWork,
    /// The records.
    pub records: Vec<Facts>,
    /// The earthquakes that they belong to.
    pub clusters: Clusters,
    /// Positions of the records that the single-record figures show.
    pub chosen: [usize; 3],
    /// Curves by arm.
    pub arms: Vec<ArmCurves>,
    /// Capacity samples by arm, PGA then PGV.
    pub distributions: Vec<Distributions>,
    /// By frequency parameter.
    pub single: Vec<SingleRecords>,
    /// By arm.
    pub stripes: Vec<StripeDemands>,
    /// Slenderness-adjusted curves by arm; by frequency instead of block,
    /// then by record.
    pub adjusted: Vec<ArmCurves>,
    /// Curves of the contents by item, then by record, in the common arm.
    pub contents: Vec<Vec<ResponseCurve>>,
}

impl SuiteResults {
    /// Curves of an arm by block, then by record.
    ///
    /// # Errors
    /// If the arm was not run.
    pub fn curves(&self, arm: Arm) -> anyhow::Result<&[Vec<ResponseCurve>]> {
        curves_of(&self.arms, arm)
    }

    /// Capacity samples of an arm in a measure.
    ///
    /// # Errors
    /// If the arm was not run.
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
    /// If the arm was not run.
    pub fn block(
        &self,
        arm: Arm,
        intensity: Intensity,
        (frequency, slenderness): (usize, usize),
    ) -> anyhow::Result<&BlockSamples> {
        let found = self.distributions(arm, intensity)?;
        Ok(&found.blocks[position(frequency, slenderness)])
    }

    /// Demands on the stripes of an arm.
    ///
    /// # Errors
    /// If the arm was not run.
    pub fn stripes(&self, arm: Arm) -> anyhow::Result<&StripeDemands> {
        let found = self.stripes.iter().find(|own| own.arm == arm);
        found.ok_or_else(|| not_run(arm))
    }

    /// Number of records that uplift the block without scaling.
    #[must_use]
    pub fn uplift_unscaled(&self, block: &Block) -> usize {
        let threshold = libm::tan(block.slenderness_rad());
        self.records.iter().filter(|r| r.pga_g > threshold).count()
    }
}

/// Theta/alpha every [`HISTORY_INTERVAL_S`](super::HISTORY_INTERVAL_S), and whether the block
/// overturned.
pub type ShownHistory = (Vec<f64>, bool);

/// Histories of the chosen records, and how far all records' histories and
/// curves are from the reference slenderness, for one frequency parameter.
#[derive(Clone, Debug)]
pub struct SingleRecords {
    /// Level of the histories.
    pub im: f64,
    /// Theta/alpha of the chosen records, by record, then by slenderness,
    /// and whether the block overturned.
    pub histories: Vec<Vec<ShownHistory>>,
    /// By record, then by slenderness other than the reference.
    pub apart: Vec<Vec<Deviation>>,
    /// The deviations at each of `LEVELS_IM`, for comparisons of the suites.
    pub by_level: Vec<(f64, Vec<Vec<Deviation>>)>,
}

/// A block against the reference slenderness under one record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// Normalized L2 distance of the histories; NaN where one overturned.
    pub distance: f64,
    /// Ratio of the peaks; NaN where one overturned.
    pub peak_ratio: f64,
    /// Mean |ln| of the ratio of intensities at equal demand; NaN where
    /// there is none.
    pub mean_ln_im: f64,
}

impl SingleRecords {
    /// Median over records and slendernesses of the defined values.
    pub(crate) fn median_of(&self, of: impl Fn(&Deviation) -> f64) -> f64 {
        let mut values: Vec<f64> = self
            .apart
            .iter()
            .flatten()
            .map(of)
            .filter(|x| x.is_finite())
            .collect();
        values.sort_by(f64::total_cmp);
        match values.len() {
            0 => f64::NAN,
            n => 0.5 * (values[(n - 1) / 2] + values[n / 2]),
        }
    }
}
