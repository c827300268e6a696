//! Sampling intervals of a fit, and bands over intensity.

use std::fmt;

use libm::exp;

use super::levels::resampled;
use super::{BootstrapFits, Draws, FitOptions, SampleFit};
use crate::LEVEL;
use crate::fragility::total::{Parts, TotalFragility};
use crate::model_error::ModelError;
use rocking_statistics::bootstrap::BootstrapEstimate;
use rocking_statistics::estimate::keys;
use rocking_statistics::lognormal::FitMethod;
use rocking_statistics::resampling::{IntervalRemark, Resampling};
use rocking_statistics::{
    CensoredSample, Clusters, Estimate, Interval, Lognormal, QuantileType,
    Range, Sample, normal,
};

/// Basis of the intervals of a result: the draws of a bootstrap.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct IntervalBasis {
    /// The draws.
    #[serde(flatten)]
    pub draws: Draws,
    /// The unit that was drawn: earthquakes with all their records, or records
    /// if no earthquake is known.
    pub drawn: Clusters,
    /// Level of the intervals.
    pub level: f64,
    /// Why the intervals are rough; `None` for at least 8 earthquakes
    /// (records) and 200 draws.
    pub remark: Option<IntervalRemark>,
    /// The model error, from which each draw has its own bias and dispersion;
    /// `None` if only the records are drawn.
    #[serde(skip)]
    pub model_error: Option<ModelError>,
}

impl IntervalBasis {
    pub(crate) fn new(draws: Draws, clusters: &Clusters) -> Self {
        let drawn = clusters.clone();
        let remark = drawn.remark(draws.replicates);
        Self { draws, drawn, level: LEVEL, remark, model_error: None }
    }

    /// A number with its interval from its values in the draws.
    pub(crate) fn estimate(
        &self,
        value: f64,
        drawn: &[f64],
        range: Range,
    ) -> Option<BootstrapEstimate> {
        let how = Resampling::Bootstrap;
        self.drawn.estimate(value, drawn, how, range, self.level)
    }

    /// A number, with its interval if the draws give one.
    pub(crate) fn value(
        &self,
        value: f64,
        drawn: &[f64],
        range: Range,
    ) -> BootstrapEstimate {
        self.estimate(value, drawn, range).unwrap_or_else(|| {
            let (level, drawn) = (self.level, drawn.len());
            BootstrapEstimate::without_interval(value, level, drawn)
        })
    }
}

impl fmt::Display for IntervalBasis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Draws { replicates, seed } = self.draws;
        let drawn = &self.drawn;
        write!(f, "bootstrap, {replicates} draws of seed {seed}, {drawn}")?;
        if let Some(error) = &self.model_error {
            write!(f, ", each with its own error of the model: {error}")?;
        }
        let mut remark = self.remark.iter();
        remark.try_for_each(|remark| write!(f, "; {remark}"))
    }
}

/// Bootstrap intervals of the numbers of a fit; `None` for a number that is
/// missing in a tenth of the draws.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct FitIntervals {
    /// What they rest on.
    #[serde(flatten)]
    pub basis: IntervalBasis,
    /// Logarithmic mean above the shift.
    pub log_mean: Option<BootstrapEstimate>,
    /// Dispersion above the shift.
    pub dispersion: Option<BootstrapEstimate>,
    /// Median, with the standard error of the logarithmic mean.
    pub median: Option<BootstrapEstimate>,
    /// Eq. 5.
    pub eq5: Option<BootstrapEstimate>,
    /// Eq. 6.
    pub eq6: Option<BootstrapEstimate>,
    /// Eq. 7.
    pub eq7: Option<BootstrapEstimate>,
}

/// The numbers of a fit that get an interval.
type Numbers = [f64; 5];

/// A replicate: its numbers, and its distribution if it has a fit.
pub(super) type Replicate = (Numbers, Option<Lognormal>);

fn numbers(found: &SampleFit) -> Numbers {
    let fitted = found.fit.distribution;
    let own = &found.transformed;
    let [eq5, eq6, eq7] = [own.eq5, own.eq6, own.eq7]
        .map(|found| found.and_then(Result::ok).unwrap_or(f64::NAN));
    [fitted.log_mean(), fitted.dispersion(), eq5, eq6, eq7]
}

/// The fit of one draw: of the values of a sample at these places.
pub(super) fn refitted(
    sample: &CensoredSample,
    options: &FitOptions,
    places: &[usize],
) -> Replicate {
    let family = resampled(&options.family, places);
    let found = options.once(&sample.resample(places), &family);
    found.map_or(([f64::NAN; 5], None), |found| {
        (numbers(&found), Some(found.fit.distribution))
    })
}

impl FitIntervals {
    pub(super) fn new(
        basis: IntervalBasis,
        found: &SampleFit,
        replicates: &[Replicate],
    ) -> Self {
        let points = numbers(found);
        let of = |i: usize, range: Range| {
            let drawn: Vec<f64> =
                replicates.iter().map(|row| row.0[i]).collect();
            basis.estimate(points[i], &drawn, range)
        };
        let log_mean = of(0, Range::Real);
        // The same interval above the shift.
        let shift = found.fit.distribution.shift();
        let median = log_mean.clone().map(|mut own| {
            own.estimate = own.estimate.map(|y| shift + exp(y));
            own
        });
        Self {
            log_mean,
            dispersion: of(1, Range::NotNegative),
            median,
            eq5: of(2, Range::Real),
            eq6: of(3, Range::Real),
            eq7: of(4, Range::Real),
            basis,
        }
    }
}

/// Probabilities of a fragility with pointwise intervals.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Band {
    /// What it rests on.
    #[serde(flatten)]
    pub basis: IntervalBasis,
    /// One point per intensity.
    pub points: Vec<BandPoint>,
}

/// The probability at one intensity.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct BandPoint {
    /// The intensity, in the unit of the sample.
    pub intensity: f64,
    /// Probability of the fit, with its interval by the bootstrap.
    #[serde(flatten, serialize_with = "keys::probability")]
    pub probability: Estimate,
    /// The same probability with its interval by the delta method, for
    /// complete samples of independent records, fitted by maximum likelihood
    /// or moments above a known shift.
    #[serde(flatten, serialize_with = "keys::delta_ends")]
    pub delta: Estimate,
}

impl Band {
    pub(super) fn new(
        sample: &CensoredSample,
        options: &FitOptions,
        fitted: &Lognormal,
        sampled: &BootstrapFits,
    ) -> Self {
        let mut band = sampled.band(&(*fitted).into(), &options.band);
        let has_delta = sample.censored() == 0
            && options.family.is_empty()
            && sampled.basis.drawn.is_singletons()
            && matches!(
                options.method,
                FitMethod::MaximumLikelihood | FitMethod::Moment
            );
        for point in band.points.iter_mut().filter(|_| has_delta) {
            let (n, im) = (sample.len(), point.intensity);
            point.delta = fitted.estimate_of_cdf(n, im, LEVEL);
        }
        band
    }
}

impl BootstrapFits {
    /// Probabilities of a fit at these intensities, with the 95 % band of
    /// these draws, symmetric in the normal score, or between quantiles of the
    /// draws if they have a model error; without intervals by the delta
    /// method.
    pub fn band(&self, fitted: &TotalFragility, intensities: &[f64]) -> Band {
        let drawn = self.fitted.iter().flatten();
        let drawn: Vec<Parts> = drawn.map(TotalFragility::parts).collect();
        let point = |&intensity: &f64| {
            let score = |fit: &TotalFragility| fit.score(intensity);
            let probability = if self.basis.model_error.is_some() {
                let value = fitted.cdf(intensity);
                let all = drawn.iter().map(|fit| fit.cdf(intensity));
                let between =
                    self.between_draws(value, &all.collect::<Vec<_>>());
                between.unwrap_or(Estimate::exact(value))
            } else {
                let own = self.estimate(score(fitted), Range::Real, score);
                own.map(normal::cdf)
            };
            let delta = Estimate::exact(probability.value());
            BandPoint { intensity, probability, delta }
        };
        let points = intensities.iter().map(point).collect();
        Band { basis: self.basis.clone(), points }
    }

    /// A probability between two quantiles of the draws, further out by as
    /// much as Student's t is wider than the normal distribution (Hesterberg,
    /// The American Statistician 69 (2015) 371). Near the onset of rocking the
    /// scores of draws with and without a dispersion of the model lie so far
    /// apart that they have no useful standard error.
    fn between_draws(&self, value: f64, all: &[f64]) -> Option<Estimate> {
        let clusters = &self.basis.drawn;
        let effective = clusters.effective();
        let t = clusters.student(self.basis.level)?;
        let tail =
            normal::survival(t * (effective / (effective - 1.0)).sqrt());
        if !(clusters.count() > 2 && 10 * all.len() > 9 * self.fitted.len()) {
            return None;
        }
        let sample = Sample::try_new(all).ok()?;
        let [low, high] = [tail, 1.0 - tail]
            .map(|p| QuantileType::default().quantile(&sample, p));
        let (low, high) = (low.ok()?.min(value), high.ok()?.max(value));
        let interval = Interval::try_new(low, high).ok()?;
        Estimate::try_new(value, interval, Range::Share).ok()
    }
}
