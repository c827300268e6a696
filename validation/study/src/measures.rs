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
use rocking_statistics::Range;

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

            /// Unit of a cell, and the range of its values.
            #[must_use]
            pub fn unit(self) -> (Unit, Range) {
                match self {
                    $(Self::$name => (Unit::$unit, Range::$range),)+
                }
            }

            /// The cells of the measure.
            ///
            /// # Errors
            /// Where a curve cannot be read, or an arm was not run.
            pub fn prepare(self, scope: &Scope<'_>) -> MeasureResult {
                let prepare: fn(&Scope<'_>) -> MeasureResult = match self {
                    $(Self::$name => $of,)+
                };
                prepare(scope)
            }
        }
    };
}

measures! {
    /// First overturning by the other criterion over the study's, paired.
    FirstOverturningByCriterion: One, NotNegative, capacities::criterion;
    /// Overturning with another restitution over the study's, paired.
    RestitutionEffect: One, NotNegative, capacities::restitution;
    /// Effect of restitution on overturning over the effect of size.
    RestitutionBesideSize: Share, NotNegative, capacities::restitution_beside_size;
    /// Capacities of the other component over the study's, paired.
    ComponentEffect: One, NotNegative, capacities::component;
    /// Change of the excess of D by the geometric mean's intensity.
    GeometricMeanDistance: Probability, Difference, distances::geometric_mean;
    /// Share of records that uplift the stockiest block unscaled.
    UpliftUnscaled: Share, Share, capacities::uplift;
    /// Probability of overturning without minus with resurrections.
    ResurrectionProbability: Probability, Share, stripes::probabilities;
    /// Median overturning with over without resurrections.
    ResurrectionMedian: One, NotNegative, stripes::median_again;
    /// Share of resurrections, large minus small blocks.
    ResurrectionsBySize: Points, Difference, stripes::again_by_size;
    /// Share of resurrections, stocky minus slender blocks.
    ResurrectionsBySlenderness: Points, Difference, stripes::again_by_slenderness;
    /// Mean capacity by median-point over monotone inversion.
    InversionBias: One, NotNegative, capacities::inversion;
    /// Paired ratio stocky over slender with Housner's restitution.
    HousnerSpread: One, NotNegative, capacities::housner;
    /// Share of histories further than 5 % from the reference's.
    HistoriesApart: Share, Share, |s| Ok(single::histories_apart(s));
    /// Median distance of histories.
    HistoryDistance: Distance, NotNegative, |s| Ok(single::history_distance(s));
    /// Distance of histories, ordinary over pulse-type motions.
    HistoryContrast: One, NotNegative, |s| Ok(single::histories(s));
    /// Difference of peaks.
    PeakDifference: One, NotNegative, |s| Ok(single::peaks(s));
    /// Share of stripes at which blocks of one p have different fates.
    MixedFates: Share, Share, single::fates;
    /// Difference of single IDA curves.
    CurveDifference: One, NotNegative, |s| Ok(single::curves(s));
    /// Difference of single IDA curves, ordinary over pulse-type motions.
    CurveContrast: One, NotNegative, |s| Ok(single::curve_contrast(s));
    /// Median paired ratios on stripes, p = 1, all but the exception.
    StripeRatiosLarge: One, NotNegative, |s| stripes::ratios(s, &[0]);
    /// The paper's exception: alpha = 0.25 on the lowest stripe.
    StripeRatioException: One, NotNegative, stripes::only_exception;
    /// Deviation of the smaller over the deviation of the larger demands, in the
    /// cell of the paper's exception.
    SmallAmplitudes: One, NotNegative, stripes::small_amplitudes;
    /// Median paired ratios on stripes, p = 3 and 4.
    StripeRatiosSmall: One, NotNegative, |s| stripes::ratios(s, &[1, 2]);
    /// Median paired ratios on stripes of all blocks, the closed form divided out.
    StripeRatiosCorrected: One, NotNegative, stripes::corrected;
    /// Share of ratios far from 1.
    StripeOutliers: Share, Share, stripes::outliers;
    /// Median paired ratios of intensities at equal demand.
    DemandRatios: One, NotNegative, capacities::demand_ratios;
    /// 16, 50 and 84 % quantiles over those of the reference.
    Quantiles: One, NotNegative, capacities::quantiles;
    /// Median paired ratios, slenderness adjusted over records scaled.
    AdjustmentRatios: One, NotNegative, |s| stripes::adjusted(s, None);
    /// Median paired ratios where the adjusted slenderness is at most 0.25.
    AdjustmentRatiosSlender: One, NotNegative, |s| stripes::adjusted(s, Some(true));
    /// Median paired ratios where the adjusted slenderness is above 0.25.
    AdjustmentRatiosStocky: One, NotNegative, |s| stripes::adjusted(s, Some(false));
    /// Median paired ratios of Figure 9, the closed form divided out record by
    /// record.
    AdjustmentRatiosCorrected: One, NotNegative, stripes::adjusted_corrected;
    /// 16, 50 and 84 % quantiles, adjusted over scaled.
    AdjustmentQuantiles: One, NotNegative, capacities::adjusted_quantiles;
    /// 84 over 16 % quantile of the onset in PGV.
    OnsetSpreadPgv: One, NotNegative, |s| Ok(capacities::onset(s));
    /// Distance from a lognormal (Lilliefors' D less its mean for a lognormal),
    /// original samples.
    DistanceOriginal: Probability, Difference, distances::original;
    /// Distance from a lognormal for p = 3 and 4 minus the distance for p = 1.
    DistanceSmallMinusLarge: Probability, Difference, distances::small_minus_large;
    /// Reduction of the distance by shifting.
    DistanceGain: Probability, Difference, distances::gain;
    /// Distance from a lognormal, shifted samples.
    DistanceShifted: Probability, Difference, distances::shifted;
    /// Distance for alpha = 0.05, p = 3, original and shifted samples in PGA.
    DistanceSlender: Probability, Difference, distances::slender;
    /// Reduction of the distance without the three earliest overturnings.
    DistanceEarliestRemoved: Probability, Difference, distances::earliest_removed;
    /// Distance for alpha = 0.05 minus the distance for 0.20, p = 3, shifted PGA.
    DistanceSlenderMinusStocky: Probability, Difference, distances::less_slender;
    /// Distance of original samples in PGA minus the distance in PGV.
    DistancePgvGain: Probability, Difference, distances::pgv_gain;
    /// Gain in distance to the sample by shifting.
    ShiftGain: Probability, Difference, fragilities::shift_gain;
    /// Probability of the trimmed USFL at the intensity of uplift.
    AtUplift: Probability, Share, fragilities::at_uplift;
    /// Distance of trimmed USFL7 to SSFL.
    TrimmedToSsfl: Probability, Share, fragilities::trimmed;
    /// Annual frequency by trimmed USFL7 over the sample's.
    TransformedRate: One, NotNegative, fragilities::transformed_rate;
    /// Share of the annual frequency from capacities above the 84 % quantile.
    TailRate: Share, Share, fragilities::tail_rate;
    /// Annual frequency by the SSFL over the sample's.
    ShiftedRate: One, NotNegative, fragilities::shifted_rate;
    /// Reduction of the distance of USFL7 to SSFL by trimming.
    TrimmingGain: Probability, Difference, fragilities::trimming_gain;
    /// Reduction of the distance of trimmed USFL7 to SSFL by c = 0.5 to 1 instead
    /// of 0.25.
    HighConstantGain: Probability, Difference, fragilities::high_constant_gain;
    /// Distance of untrimmed USFL7 to SSFL.
    UntrimmedToSsfl: Probability, Share, fragilities::untrimmed;
    /// Gain in the distance of untrimmed USFL7 to SSFL from c = 1 to c = 0.25.
    LowConstantGain: Probability, Difference, fragilities::low_constant;
    /// Distance of trimmed USFL7 for c = 0.25 to USFL7 for c = 1.
    ConstantSpread: Probability, Share, fragilities::constant_spread;
    /// Dispersion of the whole sample over the dispersion of the trimmed one.
    TailInflation: One, NotNegative, fragilities::tail_inflation;
    /// Scatter of the dispersion by quantiles over its scatter by the standard
    /// deviation.
    QuantileScatter: One, NotNegative, fragilities::scatter;
}
