//! The measures of the claims: functions from typed results to the cells of
//! a claim, over a set of records.
//!
//! Each measure is registered under the name that a claim gives it. It reads
//! what the analyses gave once, and is then a function of how often each
//! record is drawn.

mod capacities;
mod distances;
mod fragilities;
mod scope;
mod single;
mod stripes;

use serde::Deserialize;

pub(crate) use fragilities::{DemandFits, Thresholds, by_demand, to_ssfl};
pub use scope::{Criterion, MeasureCells, MeasureResult, Scope};
pub use stripes::without_closed_form;

use rocking_common::findings::Unit;

/// A measure as it is registered.
struct MeasureRow {
    unit: Unit,
    /// Ends that no value can cross.
    range: (f64, f64),
    prepare: fn(&Scope<'_>) -> MeasureResult,
}

const ANY: (f64, f64) = (f64::NEG_INFINITY, f64::INFINITY);
const NOT_NEGATIVE: (f64, f64) = (0.0, f64::INFINITY);
const FROM_0_TO_1: (f64, f64) = (0.0, 1.0);
const SIGNED: (f64, f64) = (-1.0, 1.0);

/// The registry: what a measure is, its name, the unit of a cell, its range
/// and its function.
macro_rules! measures {
    ($($(#[$doc:meta])+ $name:ident: $unit:ident, $range:ident, $of:expr;)+)
    => {
        /// A measure by its registered name.
        #[derive(
            Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize,
        )]
        #[serde(rename_all = "kebab-case")]
        pub enum ClaimMeasure {
            $($(#[$doc])+ $name,)+
        }

        impl ClaimMeasure {
            /// All of them, in the order of the paper.
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            fn row(self) -> MeasureRow {
                match self {
                    $(Self::$name => MeasureRow {
                        unit: Unit::$unit,
                        range: $range,
                        prepare: $of,
                    },)+
                }
            }
        }
    };
}

measures! {
    /// First overturning by the other criterion over the study's, paired.
    FirstOverturningByCriterion: One, ANY, capacities::criterion;
    /// Overturning with another restitution over the study's, paired.
    RestitutionEffect: One, ANY, capacities::restitution;
    /// Effect of restitution on overturning over the effect of size.
    RestitutionBesideSize: Share, NOT_NEGATIVE, capacities::restitution_beside_size;
    /// Capacities of the other component over the study's, paired.
    ComponentEffect: One, ANY, capacities::component;
    /// Change of the excess of D by the geometric mean's intensity.
    GeometricMeanDistance: Probability, SIGNED, distances::geometric_mean;
    /// Share of records that uplift the stockiest block unscaled.
    UpliftUnscaled: Share, FROM_0_TO_1, capacities::uplift;
    /// Probability of overturning without minus with resurrections.
    ResurrectionProbability: Probability, FROM_0_TO_1, stripes::probabilities;
    /// Median overturning with over without resurrections.
    ResurrectionMedian: One, ANY, stripes::median_again;
    /// Share of resurrections, large minus small blocks.
    ResurrectionsBySize: Points, SIGNED, stripes::again_by_size;
    /// Share of resurrections, stocky minus slender blocks.
    ResurrectionsBySlenderness: Points, SIGNED, stripes::again_by_slenderness;
    /// Mean capacity by median-point over monotone inversion.
    InversionBias: One, ANY, capacities::inversion;
    /// Paired ratio stocky over slender with Housner's restitution.
    HousnerSpread: One, NOT_NEGATIVE, capacities::housner;
    /// Share of histories further than 5 % from the reference's.
    HistoriesApart: Share, FROM_0_TO_1, |s| Ok(single::histories_apart(s));
    /// Median distance of histories.
    HistoryDistance: Distance, NOT_NEGATIVE, |s| Ok(single::history_distance(s));
    /// Distance of histories, ordinary over pulse-type motions.
    HistoryContrast: One, NOT_NEGATIVE, |s| Ok(single::histories(s));
    /// Difference of peaks.
    PeakDifference: One, NOT_NEGATIVE, |s| Ok(single::peaks(s));
    /// Share of stripes at which blocks of one p have different fates.
    MixedFates: Share, FROM_0_TO_1, single::fates;
    /// Difference of single IDA curves.
    CurveDifference: One, NOT_NEGATIVE, |s| Ok(single::curves(s));
    /// Difference of single IDA curves, ordinary over pulse-type motions.
    CurveContrast: One, NOT_NEGATIVE, |s| Ok(single::curve_contrast(s));
    /// Median paired ratios on stripes, p = 1, all but the exception.
    StripeRatiosLarge: One, ANY, |s| stripes::ratios(s, &[0]);
    /// The paper's exception: alpha = 0.25 on the lowest stripe.
    StripeRatioException: One, ANY, stripes::only_exception;
    /// Deviation of the smaller over the deviation of the larger demands, in the
    /// cell of the paper's exception.
    SmallAmplitudes: One, NOT_NEGATIVE, stripes::small_amplitudes;
    /// Median paired ratios on stripes, p = 3 and 4.
    StripeRatiosSmall: One, ANY, |s| stripes::ratios(s, &[1, 2]);
    /// Median paired ratios on stripes of all blocks, the closed form divided out.
    StripeRatiosCorrected: One, ANY, stripes::corrected;
    /// Share of ratios far from 1.
    StripeOutliers: Share, FROM_0_TO_1, stripes::outliers;
    /// Median paired ratios of intensities at equal demand.
    DemandRatios: One, ANY, capacities::demand_ratios;
    /// 16, 50 and 84 % quantiles over those of the reference.
    Quantiles: One, ANY, capacities::quantiles;
    /// Median paired ratios, slenderness adjusted over records scaled.
    AdjustmentRatios: One, ANY, |s| stripes::adjusted(s, None);
    /// Median paired ratios where the adjusted slenderness is at most 0.25.
    AdjustmentRatiosSlender: One, ANY, |s| stripes::adjusted(s, Some(true));
    /// Median paired ratios where the adjusted slenderness is above 0.25.
    AdjustmentRatiosStocky: One, ANY, |s| stripes::adjusted(s, Some(false));
    /// Median paired ratios of Figure 9, the closed form divided out record by
    /// record.
    AdjustmentRatiosCorrected: One, ANY, stripes::adjusted_corrected;
    /// 16, 50 and 84 % quantiles, adjusted over scaled.
    AdjustmentQuantiles: One, ANY, capacities::adjusted_quantiles;
    /// 84 over 16 % quantile of the onset in PGV.
    OnsetSpreadPgv: One, ANY, |s| Ok(capacities::onset(s));
    /// Distance from a lognormal (Lilliefors' D less its mean for a lognormal),
    /// original samples.
    DistanceOriginal: Probability, SIGNED, distances::original;
    /// Distance from a lognormal for p = 3 and 4 minus the distance for p = 1.
    DistanceSmallMinusLarge: Probability, SIGNED, distances::small_minus_large;
    /// Reduction of the distance by shifting.
    DistanceGain: Probability, SIGNED, distances::gain;
    /// Distance from a lognormal, shifted samples.
    DistanceShifted: Probability, SIGNED, distances::shifted;
    /// Distance for alpha = 0.05, p = 3, original and shifted samples in PGA.
    DistanceSlender: Probability, SIGNED, distances::slender;
    /// Reduction of the distance without the three earliest overturnings.
    DistanceEarliestRemoved: Probability, SIGNED, distances::earliest_removed;
    /// Distance for alpha = 0.05 minus the distance for 0.20, p = 3, shifted PGA.
    DistanceSlenderMinusStocky: Probability, SIGNED, distances::less_slender;
    /// Distance of original samples in PGA minus the distance in PGV.
    DistancePgvGain: Probability, SIGNED, distances::pgv_gain;
    /// Gain in distance to the sample by shifting.
    ShiftGain: Probability, SIGNED, fragilities::shift_gain;
    /// Probability of the trimmed USFL at the intensity of uplift.
    AtUplift: Probability, FROM_0_TO_1, fragilities::at_uplift;
    /// Distance of trimmed USFL7 to SSFL.
    TrimmedToSsfl: Probability, FROM_0_TO_1, fragilities::trimmed;
    /// Annual frequency by trimmed USFL7 over the sample's.
    TransformedRate: One, NOT_NEGATIVE, fragilities::transformed_rate;
    /// Share of the annual frequency from capacities above the 84 % quantile.
    TailRate: Share, FROM_0_TO_1, fragilities::tail_rate;
    /// Annual frequency by the SSFL over the sample's.
    ShiftedRate: One, NOT_NEGATIVE, fragilities::shifted_rate;
    /// Reduction of the distance of USFL7 to SSFL by trimming.
    TrimmingGain: Probability, SIGNED, fragilities::trimming_gain;
    /// Reduction of the distance of trimmed USFL7 to SSFL by c = 0.5 to 1 instead
    /// of 0.25.
    HighConstantGain: Probability, SIGNED, fragilities::high_constant_gain;
    /// Distance of untrimmed USFL7 to SSFL.
    UntrimmedToSsfl: Probability, FROM_0_TO_1, fragilities::untrimmed;
    /// Gain in the distance of untrimmed USFL7 to SSFL from c = 1 to c = 0.25.
    LowConstantGain: Probability, SIGNED, fragilities::low_constant;
    /// Distance of trimmed USFL7 for c = 0.25 to USFL7 for c = 1.
    ConstantSpread: Probability, FROM_0_TO_1, fragilities::constant_spread;
    /// Dispersion of the whole sample over the dispersion of the trimmed one.
    TailInflation: One, ANY, fragilities::tail_inflation;
    /// Scatter of the dispersion by quantiles over its scatter by the standard
    /// deviation.
    QuantileScatter: One, ANY, fragilities::scatter;
}

impl ClaimMeasure {
    /// Unit of a cell, and the ends that no value can cross.
    #[must_use]
    pub fn unit(self) -> (Unit, (f64, f64)) {
        let row = self.row();
        (row.unit, row.range)
    }

    /// The cells of the measure.
    ///
    /// # Errors
    /// Where a curve cannot be read, or an arm was not run.
    pub fn prepare(self, scope: &Scope<'_>) -> MeasureResult {
        (self.row().prepare)(scope)
    }
}
