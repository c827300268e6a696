//! Measured and computed fragilities of the same tests.

use super::DistributionComparison;
use super::fates::Fates;
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::{Lognormal, Range};

/// Ratio of the medians, difference of the dispersions, difference of their
/// squares.
pub(super) type Differences = [f64; 3];

pub(super) fn differences(
    measured: &Lognormal,
    computed: &Lognormal,
) -> Differences {
    let [s, t] = [measured, computed].map(Lognormal::dispersion);
    [measured.median() / computed.median(), s - t, (s - t) * (s + t)]
}

/// The comparison with its intervals from the differences in the draws.
pub(super) fn distribution(
    im: &IntensityMeasure,
    fates: &Fates,
    measured: &Lognormal,
    computed: &Lognormal,
    drawn: &[Differences],
) -> DistributionComparison {
    let ranges = [Range::NotNegative, Range::Real, Range::Real];
    let [median_ratio, dispersion_difference, squares] =
        fates.estimates(differences(measured, computed), drawn, ranges);
    DistributionComparison {
        im: im.to_string(),
        unit: im.unit().to_owned(),
        measured_median: measured.median(),
        measured_dispersion: measured.dispersion(),
        computed_median: computed.median(),
        computed_dispersion: computed.dispersion(),
        median_ratio,
        dispersion_difference,
        missing_dispersion: squares.map(|square| square.max(0.0).sqrt()),
    }
}
