//! The measures of the claims: functions from typed results to the cells of
//! a claim, over a set of records.
//!
//! Each measure is registered under the name that a claim gives it. It reads
//! what the analyses gave once, and is then a function of how often each
//! record is drawn.

mod capacities;
mod fragilities;
mod shares;
mod single;
mod stripes;

use serde::Deserialize;

pub(crate) use fragilities::{At, Thresholds, by_demand, to_ssfl};
pub use shares::{Shares, all as all_shares};
pub use stripes::without_closed_form;

use crate::error::StudyError;
use crate::inference::{Cell, Draws, Replicated};
use crate::results::Results;
use rocking_common::findings::{Tested, Unit};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, SuiteKind,
};

/// A measure by its registered name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Measure {
    /// First overturning by the other criterion over that by the study's.
    FirstOverturningByCriterion,
    /// Median overturning with another restitution over the study's.
    RestitutionEffect,
    /// Quantiles of capacities of the other component over the study's.
    ComponentEffect,
    /// Change of accepted shares by the geometric mean's intensity.
    GeometricMeanShares,
    /// Share of records that uplift the stockiest block unscaled.
    UpliftUnscaled,
    /// Probability of overturning without minus with resurrections.
    ResurrectionProbability,
    /// Median overturning with over without resurrections.
    ResurrectionMedian,
    /// Share of resurrections, large minus small blocks.
    ResurrectionsBySize,
    /// Share of resurrections, stocky minus slender blocks.
    ResurrectionsBySlenderness,
    /// Mean capacity by median-point over monotone inversion.
    InversionBias,
    /// Paired ratio stocky over slender with Housner's restitution.
    HousnerSpread,
    /// Distance of histories, ordinary minus pulse-type.
    HistoryDifference,
    /// Difference of peaks.
    PeakDifference,
    /// Difference of single IDA curves.
    CurveDifference,
    /// Median paired ratios on stripes, p = 1, all but the exception.
    StripeRatiosLarge,
    /// The paper's exception: alpha = 0.25 on the lowest stripe.
    StripeRatioException,
    /// Median paired ratios on stripes, p = 3 and 4.
    StripeRatiosSmall,
    /// All of them, the closed form divided out.
    StripeRatiosCorrected,
    /// Share of ratios far from 1.
    StripeOutliers,
    /// Median paired ratios of intensities at equal demand.
    DemandRatios,
    /// 16, 50 and 84 % quantiles over those of the reference.
    Quantiles,
    /// Median paired ratios, slenderness adjusted over records scaled.
    AdjustmentRatios,
    /// The same where the adjusted slenderness is at most 0.25.
    AdjustmentRatiosSlender,
    /// The same where it is above.
    AdjustmentRatiosStocky,
    /// 16, 50 and 84 % quantiles, adjusted over scaled.
    AdjustmentQuantiles,
    /// 84 over 16 % quantile of the onset in PGV.
    OnsetSpreadPgv,
    /// Mean accepted share, original PGA.
    ShareOriginalPga,
    /// The same of p = 1 minus p = 3 and 4.
    ShareLargeMinusSmall,
    /// Mean gain of the accepted share by shifting, PGA.
    ShareGainPga,
    /// Share of blocks above 70 %, original PGV.
    BlocksAbove70Pgv,
    /// Mean gain of the accepted share by shifting, PGV.
    ShareGainPgv,
    /// Share of blocks above 90 %, shifted PGV.
    BlocksAbove90Pgv,
    /// Accepted shares of alpha = 0.05, p = 3, original and shifted.
    ShareSlender,
    /// Accepted share of alpha = 0.20 minus 0.05, p = 3, shifted.
    ShareLessSlenderGain,
    /// Gain of alpha = 0.05 without its three earliest overturnings.
    ShareEarliestRemoved,
    /// Gain in distance to the sample by shifting, PGA.
    ShiftGainPga,
    /// The same, PGV.
    ShiftGainPgv,
    /// Distance of trimmed USFL7 to SSFL, PGA.
    TrimmedToSsfl,
    /// Distance of untrimmed USFL7 to SSFL, PGA.
    UntrimmedToSsfl,
    /// The same, PGV.
    UntrimmedToSsflPgv,
    /// Gain in that distance from c = 1 to c = 0.25, PGA.
    LowConstantGain,
    /// Distance of trimmed USFL7 for c = 0.25 to that for c = 1, PGA.
    ConstantSpread,
    /// Dispersion of the whole over that of the trimmed sample.
    TailInflation,
    /// Scatter of the 16 and 84 % quantiles over that of the dispersion.
    QuantileScatter,
}

impl Measure {
    /// All of them, in the order of the paper.
    pub const ALL: [Self; 44] = [
        Self::FirstOverturningByCriterion,
        Self::RestitutionEffect,
        Self::ComponentEffect,
        Self::GeometricMeanShares,
        Self::UpliftUnscaled,
        Self::ResurrectionProbability,
        Self::ResurrectionMedian,
        Self::ResurrectionsBySize,
        Self::ResurrectionsBySlenderness,
        Self::InversionBias,
        Self::HousnerSpread,
        Self::HistoryDifference,
        Self::PeakDifference,
        Self::CurveDifference,
        Self::StripeRatiosLarge,
        Self::StripeRatioException,
        Self::StripeRatiosSmall,
        Self::StripeRatiosCorrected,
        Self::StripeOutliers,
        Self::DemandRatios,
        Self::Quantiles,
        Self::AdjustmentRatios,
        Self::AdjustmentRatiosSlender,
        Self::AdjustmentRatiosStocky,
        Self::AdjustmentQuantiles,
        Self::OnsetSpreadPgv,
        Self::ShareOriginalPga,
        Self::ShareLargeMinusSmall,
        Self::ShareGainPga,
        Self::BlocksAbove70Pgv,
        Self::ShareGainPgv,
        Self::BlocksAbove90Pgv,
        Self::ShareSlender,
        Self::ShareLessSlenderGain,
        Self::ShareEarliestRemoved,
        Self::ShiftGainPga,
        Self::ShiftGainPgv,
        Self::TrimmedToSsfl,
        Self::UntrimmedToSsfl,
        Self::UntrimmedToSsflPgv,
        Self::LowConstantGain,
        Self::ConstantSpread,
        Self::TailInflation,
        Self::QuantileScatter,
    ];

    /// Unit of a cell, and the ends that no value can cross.
    #[must_use]
    pub fn unit(self) -> (Unit, (f64, f64)) {
        let any = (f64::NEG_INFINITY, f64::INFINITY);
        match self {
            Self::UpliftUnscaled
            | Self::StripeOutliers
            | Self::ShareOriginalPga
            | Self::BlocksAbove70Pgv
            | Self::BlocksAbove90Pgv
            | Self::ShareSlender => (Unit::Share, (0.0, 1.0)),
            Self::ResurrectionProbability
            | Self::TrimmedToSsfl
            | Self::UntrimmedToSsfl
            | Self::UntrimmedToSsflPgv
            | Self::ConstantSpread => (Unit::Probability, (0.0, 1.0)),
            Self::GeometricMeanShares
            | Self::ResurrectionsBySize
            | Self::ResurrectionsBySlenderness
            | Self::ShareLargeMinusSmall
            | Self::ShareGainPga
            | Self::ShareGainPgv
            | Self::ShareLessSlenderGain
            | Self::ShareEarliestRemoved => (Unit::Points, (-1.0, 1.0)),
            Self::ShiftGainPga
            | Self::ShiftGainPgv
            | Self::LowConstantGain => (Unit::Probability, (-1.0, 1.0)),
            Self::HistoryDifference => (Unit::Distance, any),
            Self::PeakDifference
            | Self::CurveDifference
            | Self::HousnerSpread => (Unit::One, (0.0, f64::INFINITY)),
            _ => (Unit::One, any),
        }
    }
}

/// What a measure reads.
#[derive(Clone, Copy)]
pub struct Source<'a> {
    /// The analyses.
    pub results: &'a Results,
    /// The draws that all claims share.
    pub draws: &'a Draws,
    /// Accepted shares of all draws, by suite and arm.
    pub shares: &'a [Shares],
    /// The suite, or both.
    pub tested: Tested,
    /// The arm.
    pub arm: Arm,
}

/// The cells of a measure and their replicates; the share of cells that meet
/// the paper's own criterion, where there is one.
pub struct Prepared {
    /// Where the cells are.
    pub cells: Vec<Cell>,
    /// Their values.
    pub measured: Replicated,
    /// Of each replicate, the share of cells whose notch covers 1.
    pub criterion: Option<Replicated>,
}

impl Source<'_> {
    fn kind(&self) -> SuiteKind {
        match self.tested {
            Tested::PulseType => SuiteKind::PulseType,
            _ => SuiteKind::Ordinary,
        }
    }

    /// The cells of a measure; none where what it needs was not run.
    ///
    /// # Errors
    /// [`StudyError`] where a curve cannot be read.
    pub fn prepare(
        &self,
        measure: Measure,
    ) -> Result<Option<Prepared>, StudyError> {
        use Measure as M;
        match measure {
            M::FirstOverturningByCriterion
            | M::RestitutionEffect
            | M::ComponentEffect
            | M::InversionBias
            | M::HousnerSpread
            | M::UpliftUnscaled
            | M::DemandRatios
            | M::Quantiles
            | M::AdjustmentQuantiles
            | M::OnsetSpreadPgv => capacities::prepare(self, measure),
            M::HistoryDifference | M::PeakDifference | M::CurveDifference => {
                Ok(single::prepare(self, measure))
            }
            M::ResurrectionProbability
            | M::ResurrectionMedian
            | M::ResurrectionsBySize
            | M::ResurrectionsBySlenderness
            | M::StripeRatiosLarge
            | M::StripeRatioException
            | M::StripeRatiosSmall
            | M::StripeRatiosCorrected
            | M::StripeOutliers
            | M::AdjustmentRatios
            | M::AdjustmentRatiosSlender
            | M::AdjustmentRatiosStocky => stripes::prepare(self, measure),
            M::GeometricMeanShares
            | M::ShareOriginalPga
            | M::ShareLargeMinusSmall
            | M::ShareGainPga
            | M::BlocksAbove70Pgv
            | M::ShareGainPgv
            | M::BlocksAbove90Pgv
            | M::ShareSlender
            | M::ShareLessSlenderGain
            | M::ShareEarliestRemoved => Ok(shares::prepare(self, measure)),
            M::ShiftGainPga
            | M::ShiftGainPgv
            | M::TrimmedToSsfl
            | M::UntrimmedToSsfl
            | M::UntrimmedToSsflPgv
            | M::LowConstantGain
            | M::ConstantSpread
            | M::TailInflation
            | M::QuantileScatter => fragilities::prepare(self, measure),
        }
    }

    /// One value, smooth in the records.
    fn value(
        &self,
        at: &str,
        records: usize,
        f: impl Fn(super::inference::Draw<'_>) -> f64 + Sync,
    ) -> Prepared {
        Prepared {
            cells: vec![Cell { at: at.into(), records }],
            measured: self.draws.smooth(self.tested, &|d| vec![f(d)]),
            criterion: None,
        }
    }
}

/// A block in words: `p = 3, alpha = 0.20`.
fn block(frequency: usize, slenderness: usize) -> String {
    format!(
        "p = {}, alpha = {:.2}",
        FREQUENCIES_RAD_S[frequency], SLENDERNESSES_RAD[slenderness]
    )
}

/// Mean of the finite ones among some numbers.
fn mean(values: impl IntoIterator<Item = f64>) -> f64 {
    let (mut sum, mut count) = (0.0, 0.0);
    for x in values.into_iter().filter(|x| x.is_finite()) {
        sum += x;
        count += 1.0;
    }
    sum / count
}
