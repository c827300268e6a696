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
mod source;
mod stripes;

use serde::Deserialize;

pub(crate) use fragilities::{At, Thresholds, by_demand, to_ssfl};
pub use source::{Prepared, Source};
pub use stripes::without_closed_form;

use rocking_common::findings::Unit;
use rocking_common::paper::Intensity;
use source::Found;

/// A measure as it is registered.
struct Row {
    unit: Unit,
    /// Ends that no value can cross.
    range: (f64, f64),
    prepare: fn(&Source<'_>) -> Found,
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
        pub enum Measure {
            $($(#[$doc])+ $name,)+
        }

        impl Measure {
            /// All of them, in the order of the paper.
            pub const ALL: &[Self] = &[$(Self::$name,)+];

            fn row(self) -> Row {
                match self {
                    $(Self::$name => Row {
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
    /// First overturning by the other criterion over that by the study's.
    FirstOverturningByCriterion: One, ANY, capacities::criterion;
    /// Median overturning with another restitution over the study's.
    RestitutionEffect: One, ANY, capacities::restitution;
    /// Quantiles of capacities of the other component over the study's.
    ComponentEffect: One, ANY, capacities::component;
    /// Change of accepted shares by the geometric mean's intensity.
    GeometricMeanShares: Points, SIGNED, shares::geometric_mean;
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
    /// Distance of histories, ordinary minus pulse-type.
    HistoryDifference: Distance, ANY, single::histories;
    /// Difference of peaks.
    PeakDifference: One, NOT_NEGATIVE, single::peaks;
    /// Difference of single IDA curves.
    CurveDifference: One, NOT_NEGATIVE, single::curves;
    /// Median paired ratios on stripes, p = 1, all but the exception.
    StripeRatiosLarge: One, ANY, |s| stripes::ratios(s, &[0], Some(false));
    /// The paper's exception: alpha = 0.25 on the lowest stripe.
    StripeRatioException: One, ANY, |s| stripes::ratios(s, &[0], Some(true));
    /// Median paired ratios on stripes, p = 3 and 4.
    StripeRatiosSmall: One, ANY, |s| stripes::ratios(s, &[1, 2], None);
    /// All of them, the closed form divided out.
    StripeRatiosCorrected: One, ANY, stripes::corrected;
    /// Share of ratios far from 1.
    StripeOutliers: Share, FROM_0_TO_1, stripes::outliers;
    /// Median paired ratios of intensities at equal demand.
    DemandRatios: One, ANY, capacities::demand_ratios;
    /// 16, 50 and 84 % quantiles over those of the reference.
    Quantiles: One, ANY, capacities::quantiles;
    /// Median paired ratios, slenderness adjusted over records scaled.
    AdjustmentRatios: One, ANY, |s| stripes::adjusted(s, None);
    /// The same where the adjusted slenderness is at most 0.25.
    AdjustmentRatiosSlender: One, ANY, |s| stripes::adjusted(s, Some(true));
    /// The same where it is above.
    AdjustmentRatiosStocky: One, ANY, |s| stripes::adjusted(s, Some(false));
    /// 16, 50 and 84 % quantiles, adjusted over scaled.
    AdjustmentQuantiles: One, ANY, capacities::adjusted_quantiles;
    /// 84 over 16 % quantile of the onset in PGV.
    OnsetSpreadPgv: One, ANY, capacities::onset;
    /// Mean accepted share, original PGA.
    ShareOriginalPga: Share, FROM_0_TO_1, shares::original_pga;
    /// The same of p = 1 minus p = 3 and 4.
    ShareLargeMinusSmall: Points, SIGNED, shares::large_minus_small;
    /// Mean gain of the accepted share by shifting, PGA.
    ShareGainPga: Points, SIGNED, |s| shares::gain(s, Intensity::Pga);
    /// Share of blocks above 70 %, original PGV.
    BlocksAbove70Pgv: Share, FROM_0_TO_1, shares::above_70;
    /// Mean gain of the accepted share by shifting, PGV.
    ShareGainPgv: Points, SIGNED, |s| shares::gain(s, Intensity::Pgv);
    /// Share of blocks above 90 %, shifted PGV.
    BlocksAbove90Pgv: Share, FROM_0_TO_1, shares::above_90;
    /// Accepted shares of alpha = 0.05, p = 3, original and shifted.
    ShareSlender: Share, FROM_0_TO_1, shares::slender;
    /// Accepted share of alpha = 0.20 minus 0.05, p = 3, shifted.
    ShareLessSlenderGain: Points, SIGNED, shares::less_slender;
    /// Gain of alpha = 0.05 without its three earliest overturnings.
    ShareEarliestRemoved: Points, SIGNED, shares::earliest_removed;
    /// Gain in distance to the sample by shifting, PGA.
    ShiftGainPga: Probability, SIGNED, |s| fragilities::shift_gain(s, Intensity::Pga);
    /// The same, PGV.
    ShiftGainPgv: Probability, SIGNED, |s| fragilities::shift_gain(s, Intensity::Pgv);
    /// Distance of trimmed USFL7 to SSFL, PGA.
    TrimmedToSsfl: Probability, FROM_0_TO_1, fragilities::trimmed;
    /// Distance of untrimmed USFL7 to SSFL, PGA.
    UntrimmedToSsfl: Probability, FROM_0_TO_1, |s| fragilities::untrimmed(s, Intensity::Pga);
    /// The same, PGV.
    UntrimmedToSsflPgv: Probability, FROM_0_TO_1, |s| fragilities::untrimmed(s, Intensity::Pgv);
    /// Gain in that distance from c = 1 to c = 0.25, PGA.
    LowConstantGain: Probability, SIGNED, fragilities::low_constant;
    /// Distance of trimmed USFL7 for c = 0.25 to that for c = 1, PGA.
    ConstantSpread: Probability, FROM_0_TO_1, fragilities::constant_spread;
    /// Dispersion of the whole over that of the trimmed sample.
    TailInflation: One, ANY, fragilities::tail_inflation;
    /// Scatter of the 16 and 84 % quantiles over that of the dispersion.
    QuantileScatter: One, ANY, fragilities::scatter;
}

impl Measure {
    /// Unit of a cell, and the ends that no value can cross.
    #[must_use]
    pub fn unit(self) -> (Unit, (f64, f64)) {
        let row = self.row();
        (row.unit, row.range)
    }

    /// The cells of the measure; none where what it needs was not run.
    ///
    /// # Errors
    /// Where a curve cannot be read.
    pub fn prepare(self, source: &Source<'_>) -> Found {
        (self.row().prepare)(source)
    }
}
