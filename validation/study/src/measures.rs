//! The measures of the claims: functions from typed results to the numbers of
//! a claim, over a set of records.
//!
//! Each measure is registered under the name that a claim gives it. It reads
//! the analyses once, and is then a function of the records' multiplicities in a
//! draw.

mod capacities;
mod distances;
mod fragilities;
mod scope;
mod single;
mod stripes;

use serde::Deserialize;

pub(crate) use fragilities::{Thresholds, by_demand};
pub(crate) use scope::ranks;
pub use scope::{MeasureResult, Measured, Scope};

use crate::distances::TestedMeasure;

use rocking_common::findings::Unit;
use rocking_statistics::Range;

/// The registry: docs and name of each measure, the unit and range of its
/// effect, and its function.
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
            /// All measures, in the order of the paper.
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            /// Unit of the effect, and the range of its values.
            pub fn unit(self) -> (Unit, Range) {
                match self {
                    $(Self::$name => (Unit::$unit, Range::$range),)+
                }
            }

            /// Numbers of the measure in a scope.
            ///
            /// # Errors
            /// If a curve cannot be read, or a grid was not run.
            pub fn found(self, scope: &Scope<'_>) -> MeasureResult {
                let of: fn(&Scope<'_>) -> MeasureResult = match self {
                    $(Self::$name => $of,)+
                };
                of(scope)
            }
        }
    };
}

measures! {
    /// First overturning by the other criterion over the study's, paired.
    FirstOverturningByCriterion: One, NotNegative, capacities::criterion;
    /// Effect of restitution on overturning over the effect of size.
    RestitutionBesideSize: One, NotNegative, capacities::restitution_beside_size;
    /// Change of the excess of D by the geometric mean's intensity.
    GeometricMeanDistance: Probability, Difference, distances::geometric_mean;
    /// Median overturning with over without resurrections.
    Resurrections: One, NotNegative, stripes::resurrections;
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
    /// Difference of peaks over the distance of histories.
    PeakDifference: One, NotNegative, |s| Ok(single::peaks(s));
    /// Share of stripes at which blocks of one p have different outcomes.
    MixedFates: Share, Share, single::fates;
    /// Difference of single IDA curves.
    CurveDifference: Distance, NotNegative, |s| Ok(single::curves(s));
    /// Median paired ratios on stripes, p = 1, all but the exception.
    StripeRatiosLarge: One, NotNegative, stripes::ratios_large;
    /// The paper's exception: alpha = 0.25 on the lowest stripe.
    StripeRatioException: One, NotNegative, stripes::only_exception;
    /// The median ratio in the cell of the paper's exception.
    SmallAmplitudes: One, NotNegative, stripes::small_amplitudes;
    /// Median paired ratios on stripes, p = 3 and 4.
    StripeRatiosSmall: One, NotNegative, stripes::ratios_small;
    /// Median paired ratios on stripes of all blocks, the closed form divided out.
    StripeRatiosCorrected: One, NotNegative, stripes::corrected;
    /// Share of ratios far from 1.
    StripeOutliers: Share, Share, stripes::outliers;
    /// Median paired ratios of intensities at equal demand.
    DemandRatios: One, NotNegative, capacities::demand_ratios;
    /// 16, 50 and 84 % quantiles that coincide with the reference's.
    Quantiles: Share, Share, capacities::quantiles;
    /// Median paired ratios, slenderness adjusted over records scaled.
    AdjustmentRatios: One, NotNegative, stripes::adjusted;
    /// Median paired ratios by the adjusted slenderness, up to 0.25 and above.
    AdjustmentScope: One, NotNegative, stripes::adjusted_scope;
    /// Median paired ratios of Figure 9, the closed form divided out record by
    /// record.
    AdjustmentRatiosCorrected: One, NotNegative, stripes::adjusted_corrected;
    /// 16, 50 and 84 % quantiles that coincide, adjusted and scaled.
    AdjustmentQuantiles: Share, Share, capacities::adjusted_quantiles;
    /// 84 over 16 % quantile of the onset in PGV.
    OnsetSpreadPgv: One, NotNegative, |s| Ok(capacities::onset(s));
    /// Distance from a lognormal (Lilliefors' D minus its mean for a lognormal),
    /// original samples.
    DistanceOriginal: Probability, Difference, |s| distances::original(s, distances::tested(s));
    /// Distance from a lognormal for p = 3 and 4 minus the distance for p = 1.
    DistanceSmallMinusLarge: Probability, Difference, distances::small_minus_large;
    /// Reduction of the distance by shifting.
    DistanceGain: Probability, Difference, |s| distances::gain(s, distances::tested(s));
    /// Distance from a lognormal, shifted samples.
    DistanceShifted: Probability, Difference, distances::shifted;
    /// Distance for alpha = 0.05, p = 3, shifted sample in PGA.
    DistanceSlender: Probability, Difference, distances::slender;
    /// Reduction of the distance without the three earliest overturnings.
    DistanceEarliestRemoved: Probability, Difference, distances::earliest_removed;
    /// Distance for alpha = 0.05 minus the distance for 0.20, p = 3, shifted PGA.
    DistanceSlenderMinusStocky: Probability, Difference, distances::less_slender;
    /// Distance of original samples in PGA minus the distance in PGV.
    DistancePgvGain: Probability, Difference, distances::pgv_gain;
    /// Distance of original samples in AvgSA.
    DistanceAverageSa: Probability, Difference, |s| distances::original(s, TestedMeasure::AverageSa);
    /// Reduction of the distance by shifting, in AvgSA.
    DistanceAverageSaGain: Probability, Difference, |s| distances::gain(s, TestedMeasure::AverageSa);
    /// 16, 50 and 84 % quantiles in AvgSA that coincide with the reference's.
    QuantilesAverageSa: Share, Share, capacities::average_sa_quantiles;
    /// Gain in distance to the sample by shifting.
    ShiftGain: Probability, Difference, fragilities::shift_gain;
    /// Distance to the SSFL, trimmed USFL7 over trimmed USFL.
    TrimmedToSsfl: One, NotNegative, fragilities::trimmed;
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
    /// Distance of USFL7 to SSFL: in PGA untrimmed over trimmed; in PGV over the
    /// distance in PGA.
    UntrimmedToSsfl: One, NotNegative, fragilities::untrimmed;
    /// Gain in the distance of untrimmed USFL7 to SSFL from c = 1 to c = 0.25.
    LowConstantGain: Probability, Difference, fragilities::low_constant;
    /// Distance of USFL7 for c = 0.25 to USFL7 for c = 1, trimmed over untrimmed.
    ConstantSpread: One, NotNegative, fragilities::constant_spread;
    /// Dispersion of the whole sample over the dispersion of the trimmed one.
    TailInflation: One, NotNegative, fragilities::tail_inflation;
    /// Scatter of the dispersion by quantiles over its scatter by the standard
    /// deviation.
    QuantileScatter: One, NotNegative, fragilities::scatter;
}
