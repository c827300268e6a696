//! What few records leave open: intervals of a fit, and bands over
//! intensity.

use super::{BootstrapFits, Draws, FitOptions, SampleFit};
use crate::LEVEL;
use crate::fragility::FragilityError;
use rocking::stop;
use rocking_statistics::bootstrap::{Bootstrap, BootstrapEstimate};
#[cfg(feature = "serde")]
use rocking_statistics::estimate::keys;
use rocking_statistics::lognormal::FitMethod;
use rocking_statistics::{CensoredSample, Clusters, Estimate, Lognormal};

/// Bootstrap intervals (95 %) of one number.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Intervals {
    /// Percentile interval; none where fewer than two replicates have one.
    pub percentile: Option<BootstrapEstimate>,
    /// Bias-corrected and accelerated interval.
    pub bca: Option<BootstrapEstimate>,
}

/// Bootstrap intervals of the numbers of a fit; earthquakes are drawn with
/// all their records, or records where no earthquake is known.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct FitIntervals {
    /// The draws.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub draws: Draws,
    /// What was drawn.
    pub drawn: Clusters,
    /// Level of the intervals.
    pub level: f64,
    /// Logarithmic mean above the shift.
    pub log_mean: Intervals,
    /// Dispersion above the shift.
    pub dispersion: Intervals,
    /// Median.
    pub median: Intervals,
    /// Eq. 5.
    pub eq5: Intervals,
    /// Eq. 6.
    pub eq6: Intervals,
    /// Eq. 7.
    pub eq7: Intervals,
}

/// The numbers of a fit that get an interval.
type Numbers = [f64; 6];

/// A replicate: its numbers, and its distribution where it has a fit.
pub(super) type Replicate = (Numbers, Option<Lognormal>);

fn numbers(found: &SampleFit) -> Numbers {
    let fitted = found.fit.distribution;
    let own = &found.transformed;
    let or_nan = |x: &Option<Result<f64, FragilityError>>| {
        x.as_ref().and_then(|x| x.as_ref().ok()).copied().unwrap_or(f64::NAN)
    };
    [
        fitted.log_mean(),
        fitted.dispersion(),
        fitted.median(),
        or_nan(&own.eq5),
        or_nan(&own.eq6),
        or_nan(&own.eq7),
    ]
}

fn refitted(
    sample: &CensoredSample,
    options: &FitOptions,
    places: &[usize],
) -> Replicate {
    let found = options.once(&sample.resample(places));
    found.map_or(([f64::NAN; 6], None), |found| {
        (numbers(&found), Some(found.fit.distribution))
    })
}

/// The replicates asked for, in the order of their draws.
pub(super) fn replicates(
    sample: &CensoredSample,
    options: &FitOptions,
    clusters: &Clusters,
) -> Vec<Replicate> {
    let Some(draws) = options.draws else { return Vec::new() };
    let (seed, replicates) = (draws.seed, draws.replicates);
    let all = Bootstrap::of_clusters("fragility", seed, clusters, replicates);
    all.map(|places| refitted(sample, options, places))
}

impl FitIntervals {
    pub(super) fn new(
        sample: &CensoredSample,
        options: &FitOptions,
        (draws, clusters): (Draws, &Clusters),
        found: &SampleFit,
        replicates: &[Replicate],
    ) -> Self {
        let without: Vec<Replicate> = (0..clusters.count())
            .map(|k| {
                stop::point();
                let all = 0..clusters.records();
                let others: Vec<_> =
                    all.filter(|i| clusters.cluster_of(*i) != k).collect();
                refitted(sample, options, &others)
            })
            .collect();
        let points = numbers(found);
        let of = |i: usize| {
            let column = |rows: &[Replicate]| -> Vec<f64> {
                rows.iter().map(|row| row.0[i]).collect()
            };
            let (drawn, left_out) = (column(replicates), column(&without));
            Intervals {
                percentile: clusters.estimate(points[i], &drawn, LEVEL),
                bca: clusters.accelerated(points[i], &drawn, &left_out, LEVEL),
            }
        };
        Self {
            draws,
            drawn: clusters.clone(),
            level: LEVEL,
            log_mean: of(0),
            dispersion: of(1),
            median: of(2),
            eq5: of(3),
            eq6: of(4),
            eq7: of(5),
        }
    }
}

/// Probabilities of a fragility with bands of one intensity at a time.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Band {
    /// The draws of the bootstrap.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub draws: Draws,
    /// What was drawn.
    pub drawn: Clusters,
    /// Level of the bands.
    pub level: f64,
    /// One point an intensity.
    pub points: Vec<BandPoint>,
}

/// The probability at one intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct BandPoint {
    /// The intensity, in the unit of the sample.
    pub intensity: f64,
    /// Probability of the fit, with its interval by the bootstrap.
    #[cfg_attr(
        feature = "serde",
        serde(flatten, serialize_with = "keys::probability")
    )]
    pub probability: Estimate,
    /// The same probability with its interval by the delta method: of
    /// complete samples of independent records, fitted by maximum likelihood
    /// or moments above a known shift.
    #[cfg_attr(
        feature = "serde",
        serde(flatten, serialize_with = "keys::delta_ends")
    )]
    pub delta: Estimate,
}

impl Band {
    pub(super) fn new(
        sample: &CensoredSample,
        options: &FitOptions,
        fitted: &Lognormal,
        sampled: &BootstrapFits,
    ) -> Self {
        let complete = sample.censored() == 0;
        let known = matches!(
            options.method,
            FitMethod::MaximumLikelihood | FitMethod::Moment
        );
        let mut band = sampled.band(fitted, &options.band);
        if complete && known && sampled.clusters.is_singletons() {
            for point in &mut band.points {
                point.delta = fitted.estimate_of_cdf(
                    sample.len(),
                    point.intensity,
                    LEVEL,
                );
            }
        }
        band
    }
}

impl BootstrapFits {
    /// Probabilities of a fit at these intensities, with the 95 % band of
    /// these draws; the ends by the delta method are none.
    #[must_use]
    pub fn band(&self, fitted: &Lognormal, intensities: &[f64]) -> Band {
        let point = |&intensity: &f64| {
            let probability = fitted.cdf(intensity);
            let delta = Estimate::exact(probability);
            let found = self.estimate(probability, |fit| fit.cdf(intensity));
            let probability = found.map_or(delta, |found| found.estimate);
            BandPoint { intensity, probability, delta }
        };
        let points = intensities.iter().map(point).collect();
        let drawn = self.clusters.clone();
        Band { draws: self.draws, drawn, level: LEVEL, points }
    }
}
