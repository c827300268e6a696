//! What the analyses of a suite gave.

use rocking::block::Block;
use rocking::capacity::ResponseCurve;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_records::SetAside;
use rocking_records::intensity::{Measures, Settings};
use rocking_statistics::Clusters;

use crate::runs::{ArmCurves, Work, curves_of, not_run};
use rocking_common::findings::RecordName;
use rocking_common::paper::{Arm, SuiteKind};
use rocking_common::suites::{Motion, Source};

/// Periods of the response spectra, in s.
pub const SPECTRUM_PERIODS_S: [f64; 14] = [
    0.05, 0.075, 0.1, 0.15, 0.2, 0.3, 0.5, 0.75, 1.0, 1.5, 2.0, 3.0, 4.0, 5.0,
];

/// What a study knows of a record.
#[derive(Clone, Debug, PartialEq)]
pub struct Facts {
    /// Name.
    pub name: String,
    /// Peak ground acceleration, in g.
    pub pga_g: f64,
    /// PGV/PGA over gravity, in s.
    pub velocity_ratio_s: f64,
    /// PGA of the geometric mean of the pair over this component's.
    pub mean_over_study: Option<f64>,
    /// Intensity measures of the component applied, its spectrum at
    /// [`SPECTRUM_PERIODS_S`].
    pub measures: Measures,
}

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
    pub source: Source,
    /// Who chose the study component, in words.
    pub component_rule: String,
    /// What is suspicious about the records.
    pub remarks: Option<String>,
    /// What the folder or archive holds beside the records.
    pub set_aside: SetAside,
    /// Hash of the input.
    pub sha256: String,
    /// The records' names and hashes.
    pub list: Vec<RecordName>,
    /// What the chains took.
    pub work: Work,
    /// The records.
    pub records: Vec<Facts>,
    /// The earthquakes that they belong to.
    pub clusters: Clusters,
    /// Positions of the records that the single-record figures show.
    pub chosen: [usize; 3],
    /// Curves by arm.
    pub arms: Vec<ArmCurves>,
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
    pub apart: Vec<Vec<Apart>>,
    /// The same at each of `LEVELS_IM`, for comparisons of the suites.
    pub by_level: Vec<(f64, Vec<Vec<Apart>>)>,
}

/// A block against the reference slenderness under one record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Apart {
    /// Normalized L2 distance of the histories; NaN where one overturned.
    pub distance: f64,
    /// Ratio of the peaks; NaN where one overturned.
    pub peak_ratio: f64,
    /// Mean |ln| of the ratio of intensities at equal demand; NaN where
    /// there is none.
    pub mean_ln_im: f64,
}

impl SingleRecords {
    /// Median over records and slendernesses of what is defined.
    pub(crate) fn median_of(&self, of: impl Fn(&Apart) -> f64) -> f64 {
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

/// What a study knows of a motion's component.
///
/// # Errors
/// Where nothing moves.
pub fn facts(motion: &Motion) -> anyhow::Result<Facts> {
    let study = &motion.study;
    let pga_g = study.pga_g();
    let periods_s = SPECTRUM_PERIODS_S.to_vec();
    let settings = Settings::try_new(STANDARD_GRAVITY_M_S2, 0.05, periods_s)?;
    let measures = Measures::of(study, &settings)?;
    Ok(Facts {
        name: study.name().to_owned(),
        pga_g,
        velocity_ratio_s: study.pgv_g_s() / pga_g,
        mean_over_study: motion
            .other
            .as_ref()
            .map(|other| (other.pga_g() / pga_g).sqrt()),
        measures,
    })
}
