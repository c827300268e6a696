//! Section 5, Figures 15 to 18: measures of fitted and transformed
//! fragilities, p = 3, alpha = 0.20.

use libm::log;
use rocking_procedures::fragility::risk::HazardCurve;
use rocking_statistics::bootstrap::Bootstrap;
use rocking_statistics::resampling::{RecordRanks, Resampling};
use rocking_statistics::{
    Estimate, ExtendedSample, Lognormal, QuantileType, Range, normal,
};

use super::scope::{MeasureResult, Measured, Scope, geometric_mean};
use crate::distributions::factors;
use crate::estimates::mean;
use crate::fits::{BLOCK, Fits, THRESHOLDS, distance, usfl7};
use crate::inference::{Replicates, Resample};
use rocking_common::findings::SampleCount;
use rocking_common::paper::{Intensity, demand_index};

/// One threshold of one intensity measure, in a draw.
pub(crate) struct DemandFits {
    pub(crate) sample: ExtendedSample,
    pub(crate) shift: f64,
    pub(crate) fits: Fits,
}

/// The thresholds of a block in an intensity measure.
pub(crate) struct Thresholds {
    ranked: Vec<RecordRanks>,
    /// Intensities at uplift by record; the shift is the least of them.
    onsets: Vec<f64>,
}

impl Thresholds {
    pub(crate) fn new(scope: &Scope<'_>) -> anyhow::Result<Self> {
        let (suite, intensity) = (scope.suite(), scope.intensity);
        let block = suite.block(scope.arm, intensity, BLOCK)?;
        let ranked = THRESHOLDS
            .iter()
            .map(|edp| RecordRanks::new(&block.samples[demand_index(*edp)]))
            .collect();
        let onsets = factors(&suite.records, intensity, block.p_rad_s);
        Ok(Self { ranked, onsets })
    }

    fn shift(&self, counts: &[u32]) -> f64 {
        let drawn = self.onsets.iter().zip(counts).filter(|(_, c)| **c > 0);
        drawn.fold(f64::INFINITY, |m, (x, _)| if *x < m { *x } else { m })
    }

    pub(crate) fn at(
        &self,
        counts: &[u32],
        place: usize,
    ) -> Option<DemandFits> {
        let drawn = self.ranked[place].drawn(counts);
        let sample = ExtendedSample::try_new(&drawn).ok()?;
        let shift = self.shift(counts);
        let fits = Fits::new(&sample, shift);
        Some(DemandFits { sample, shift, fits })
    }

    fn each(
        &self,
        counts: &[u32],
        f: impl Fn(&DemandFits) -> f64,
    ) -> Vec<f64> {
        (0..THRESHOLDS.len())
            .map(|k| self.at(counts, k).as_ref().map_or(f64::NAN, &f))
            .collect()
    }
}

/// Largest difference of two fragilities in probability; NaN where one of
/// them does not exist. Of different shifts it is that at 200 quantiles of
/// each, which miss the largest by less than 1e-4 of it.
fn apart(a: Option<Lognormal>, b: Option<Lognormal>) -> f64 {
    let (Some(a), Some(b)) = (a, b) else { return f64::NAN };
    a.distance(&b).unwrap_or_else(|| {
        let of = |k: u32| (f64::from(k) + 0.5) / 200.0;
        let places =
            (0..200).flat_map(|k| [&a, &b].map(|f| f.quantile(of(k))));
        let at = |x: f64| (a.cdf(x) - b.cdf(x)).abs();
        places.map(at).fold(0.0, f64::max)
    })
}

/// Largest difference of USFL7 to the SSFL in probability.
pub(crate) fn to_ssfl(
    usfl: Option<Lognormal>,
    at: &DemandFits,
    c: f64,
) -> f64 {
    apart(usfl7(usfl, at.shift, c), at.fits.ssfl)
}

/// A number of each threshold, over the replicates.
pub(crate) fn by_demand(
    scope: &Scope<'_>,
    thresholds: &Thresholds,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> Replicates {
    scope.smooth(|counts| thresholds.each(counts, &f))
}

/// Where a number is a mean over the thresholds.
const MEAN: &str = "mean over demands 0.15, 0.35 and 1.00";

/// Name of the mean distance to the SSFL.
const TO_SSFL: &str = "distance to the SSFL, mean over demands";

fn arithmetic(row: &[f64]) -> f64 {
    mean(row.iter().copied())
}

fn geometric(row: &[f64]) -> f64 {
    geometric_mean(row.iter().copied())
}

/// How many demands have a number that is such.
fn demands(of: &Replicates, is: impl Fn(f64) -> bool) -> Vec<SampleCount> {
    vec![SampleCount::among(of.points.iter().copied(), is)]
}

/// A gain by demand: at how many it is one, and its mean.
fn gain(
    scope: &Scope<'_>,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> MeasureResult {
    let each = by_demand(scope, &Thresholds::new(scope)?, f);
    let counts = demands(&each, |gain| gain > 0.0);
    Ok(Measured::new(counts, each.one(arithmetic), MEAN))
}

/// Mean over the demands of a distance to the SSFL.
fn mean_distance(
    scope: &Scope<'_>,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> anyhow::Result<Estimate> {
    let each = by_demand(scope, &Thresholds::new(scope)?, f);
    Ok(scope.estimate(Range::Share, &each.one(arithmetic)))
}

/// A number of one threshold.
fn at_place(
    scope: &Scope<'_>,
    place: usize,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> anyhow::Result<Replicates> {
    let thresholds = Thresholds::new(scope)?;
    Ok(scope.one(|counts| {
        thresholds.at(counts, place).as_ref().map_or(f64::NAN, &f)
    }))
}

/// Name of a threshold.
fn named(place: usize) -> String {
    format!("demand {:.2}", THRESHOLDS[place])
}

/// Gain in distance to the sample by shifting, over subsets: a draw with
/// replacement would tie values.
fn shift_gains(
    scope: &Scope<'_>,
    intensity: Intensity,
) -> anyhow::Result<Replicates> {
    let scope = Scope { intensity, ..*scope };
    let thresholds = Thresholds::new(&scope)?;
    let kind = scope.kind();
    let of = |draw: Resample<'_>| {
        thresholds.each(draw.of(kind), |at| {
            distance(at.fits.usfl, &at.sample)
                - distance(at.fits.ssfl, &at.sample)
        })
    };
    Ok(scope.draws.untied(kind, &of))
}

/// Gain in distance to the sample by shifting. In PGV it is compared with
/// the gain in PGA.
pub(super) fn shift_gain(scope: &Scope<'_>) -> MeasureResult {
    let each = shift_gains(scope, scope.intensity)?;
    let mut counts = demands(&each, |gain| gain > 0.0);
    if scope.intensity != Intensity::Pga {
        let pga = shift_gains(scope, Intensity::Pga)?;
        let more = arithmetic(&pga.points) - arithmetic(&each.points);
        counts.push(SampleCount::number(more));
    }
    Ok(Measured::new(counts, each.one(arithmetic), MEAN))
}

fn trimmed_to_ssfl(at: &DemandFits) -> f64 {
    to_ssfl(at.fits.trimmed, at, 1.0)
}

fn untrimmed_to_ssfl(at: &DemandFits) -> f64 {
    to_ssfl(at.fits.usfl, at, 1.0)
}

/// Distance of the trimmed USFL7 to the SSFL over that of the trimmed USFL.
pub(super) fn trimmed(scope: &Scope<'_>) -> MeasureResult {
    let each = by_demand(scope, &Thresholds::new(scope)?, |at| {
        trimmed_to_ssfl(at) / apart(at.fits.trimmed, at.fits.ssfl)
    });
    let counts = demands(&each, |ratio| ratio < 1.0);
    let to_sample = |fit: fn(&DemandFits) -> Option<Lognormal>| {
        let thresholds = Thresholds::new(scope)?;
        let each =
            thresholds.each(scope.every(), |at| distance(fit(at), &at.sample));
        anyhow::Ok(Estimate::exact(arithmetic(&each)))
    };
    let at_uplift = mean_distance(scope, |at| {
        at.fits.trimmed.map_or(f64::NAN, |fit| fit.cdf(at.shift))
    })?;
    let untrimmed = mean_distance(scope, untrimmed_to_ssfl)?;
    Ok(Measured::new(counts, each.one(geometric), MEAN)
        .and(TO_SSFL, mean_distance(scope, trimmed_to_ssfl)?)
        .and("distance to the SSFL without trimming", untrimmed)
        .and(
            "distance to the sample, trimmed USFL, mean over demands",
            to_sample(|at| at.fits.trimmed)?,
        )
        .and(
            "distance to the sample, trimmed USFL7, mean over demands",
            to_sample(|at| usfl7(at.fits.trimmed, at.shift, 1.0))?,
        )
        .and("probability by the USFL at uplift, where it is 0", at_uplift))
}

/// Reduction of the distance of USFL7 to the SSFL by trimming.
pub(super) fn trimming_gain(scope: &Scope<'_>) -> MeasureResult {
    gain(scope, |at| untrimmed_to_ssfl(at) - trimmed_to_ssfl(at))
}

/// Reduction of the distance of the trimmed USFL7 to the SSFL by c = 0.5 to 1
/// instead of 0.25.
pub(super) fn high_constant_gain(scope: &Scope<'_>) -> MeasureResult {
    gain(scope, |at| {
        let of = |c| to_ssfl(at.fits.trimmed, at, c);
        of(0.25) - mean([0.5, 0.75, 1.0].map(of))
    })
}

/// Slopes k of the hazard H = x^-k: from the flat hazard of a strong
/// earthquake zone to a steep one.
const SLOPES: [f64; 5] = [1.5, 2.0, 2.5, 3.0, 4.0];

/// Position of the slope whose number is shown, 2.5.
const SHOWN: usize = 2;

/// Overturning under each slope of the hazard: two numbers, the first below
/// the second for how many slopes, and the first for the slope shown.
fn by_slope(
    scope: &Scope<'_>,
    f: impl Fn(f64, &DemandFits) -> f64 + Sync,
    closer: impl Fn(f64, &DemandFits) -> bool,
) -> MeasureResult {
    let thresholds = Thresholds::new(scope)?;
    let last = THRESHOLDS.len() - 1;
    let whole = thresholds.at(scope.every(), last);
    let is = |k| whole.as_ref().is_some_and(|at| closer(k, at));
    let counts = [SampleCount::among(SLOPES, is)];
    let effect = at_place(scope, last, |at| f(SLOPES[SHOWN], at))?;
    let at = format!("hazard of slope {}", SLOPES[SHOWN]);
    Ok(Measured::new(counts, effect, at))
}

/// Annual frequency by a sample's own fragility under H = x^-k, from the
/// capacities above a limit: the mean of x^-k. A capacity that was never
/// reached adds nothing.
fn sample_rate(at: &DemandFits, k: f64, above: f64) -> f64 {
    let capacities = at.sample.sorted();
    let rates = capacities.iter().filter(|x| **x > above);
    let sum = rates.fold(0.0, |sum, x| sum + libm::exp(-k * log(*x)));
    sum / capacities.len() as f64
}

/// Share of the annual frequency of overturning that comes from the
/// capacities above the 84 % quantile.
pub(super) fn tail_rate(scope: &Scope<'_>) -> MeasureResult {
    let share = |k: f64, at: &DemandFits| {
        let quantile =
            QuantileType::default().extended_quantile(&at.sample, 0.84);
        let quantile = quantile.unwrap_or(f64::NAN);
        sample_rate(at, k, quantile) / sample_rate(at, k, 0.0)
    };
    by_slope(scope, share, |k, at| share(k, at) < 0.16)
}

/// Annual frequency of overturning by a fit over the frequency by the sample.
fn rate_of(fit: Option<Lognormal>, k: f64, at: &DemandFits) -> f64 {
    // One segment, so wide that nothing lies outside.
    let end = |x: f64| (x, libm::exp(-k * log(x)));
    let hazard = HazardCurve::try_new(&[end(1e-3), end(1e3)]);
    let (Some(fit), Ok(hazard)) = (fit, hazard) else { return f64::NAN };
    hazard.annual_frequency(fit).truncation_lower / sample_rate(at, k, 0.0)
}

/// Whether one fit gives the annual frequency of the sample better than
/// another, as a ratio.
fn is_closer(
    fit: Option<Lognormal>,
    other: Option<Lognormal>,
    k: f64,
    at: &DemandFits,
) -> bool {
    let off = |fit| log(rate_of(fit, k, at)).abs();
    off(fit) < off(other)
}

/// Annual frequency by the SSFL over the sample's.
pub(super) fn shifted_rate(scope: &Scope<'_>) -> MeasureResult {
    by_slope(
        scope,
        |k, at| rate_of(at.fits.ssfl, k, at),
        |k, at| is_closer(at.fits.ssfl, at.fits.usfl, k, at),
    )
}

/// Annual frequency by trimmed USFL7 over the sample's.
pub(super) fn transformed_rate(scope: &Scope<'_>) -> MeasureResult {
    let usfl7 = |at: &DemandFits| usfl7(at.fits.trimmed, at.shift, 1.0);
    by_slope(
        scope,
        |k, at| rate_of(usfl7(at), k, at),
        |k, at| is_closer(usfl7(at), at.fits.trimmed, k, at),
    )
}

/// Distance of untrimmed USFL7 to the SSFL in PGA over the distance of the
/// trimmed one; in PGV over the distance in PGA.
pub(super) fn untrimmed(scope: &Scope<'_>) -> MeasureResult {
    let found = match scope.intensity {
        Intensity::Pga => {
            let of =
                |at: &DemandFits| untrimmed_to_ssfl(at) / trimmed_to_ssfl(at);
            let each = by_demand(scope, &Thresholds::new(scope)?, of);
            let counts = demands(&each, |ratio| ratio > 1.0);
            Measured::new(counts, each.one(geometric), MEAN)
        }
        _ => {
            let pga = Scope { intensity: Intensity::Pga, ..*scope };
            let both = [Thresholds::new(scope)?, Thresholds::new(&pga)?];
            let each = scope.smooth(|counts| {
                let [pgv, pga] = both
                    .each_ref()
                    .map(|own| own.each(counts, untrimmed_to_ssfl));
                pgv.iter().zip(&pga).map(|(a, b)| a / b).collect()
            });
            let counts = demands(&each, |ratio| ratio < 1.0);
            Measured::new(counts, each.one(geometric), MEAN)
        }
    };
    Ok(found.and(TO_SSFL, mean_distance(scope, untrimmed_to_ssfl)?))
}

/// Gain in the distance of untrimmed USFL7 to SSFL from c = 1 to c = 0.25.
pub(super) fn low_constant(scope: &Scope<'_>) -> MeasureResult {
    let gain = at_place(scope, 0, |at| {
        to_ssfl(at.fits.usfl, at, 1.0) - to_ssfl(at.fits.usfl, at, 0.25)
    })?;
    Ok(Measured::number(gain, named(0)))
}

/// Distance of USFL7 for c = 0.25 to USFL7 for c = 1, trimmed over untrimmed.
pub(super) fn constant_spread(scope: &Scope<'_>) -> MeasureResult {
    let spread = |fit, at: &DemandFits| {
        let of = |c| usfl7(fit, at.shift, c);
        apart(of(0.25), of(1.0))
    };
    let trimmed = at_place(scope, 0, |at| spread(at.fits.trimmed, at))?;
    let ratio = at_place(scope, 0, |at| {
        spread(at.fits.trimmed, at) / spread(at.fits.usfl, at)
    })?;
    let counts = [SampleCount::number(trimmed.points[0])];
    let own = scope.estimate(Range::Share, &trimmed);
    Ok(Measured::new(counts, ratio, named(0))
        .and("largest distance in probability, trimmed", own))
}

/// Dispersion of the whole sample over the dispersion of the trimmed one, over
/// the same of as many quantiles of a lognormal.
pub(super) fn tail_inflation(scope: &Scope<'_>) -> MeasureResult {
    let inflation = |fits: &Fits| {
        let of =
            |fit: Option<Lognormal>| fit.map_or(f64::NAN, |f| f.dispersion());
        of(fits.usfl) / of(fits.trimmed)
    };
    let n = scope.records() as f64;
    let score = |k: usize| normal::quantile((k as f64 + 0.5) / n);
    let scores = (0..scope.records()).map(|k| libm::exp(score(k)));
    let scores = ExtendedSample::try_new(&scores.collect::<Vec<f64>>())?;
    let expected = inflation(&Fits::new(&scores, 0.0));
    let last = THRESHOLDS.len() - 1;
    let ratio = at_place(scope, last, |at| inflation(&at.fits) / expected)?;
    Ok(Measured::number(ratio, named(last)))
}

/// Draws of a scatter of the whole sample, and of a sample without an
/// earthquake: they know its ratio to 1 and to 2 %.
const SCATTER: [usize; 2] = [20_000, 4000];

/// Scatter of the dispersion by the 16 and 84 % quantiles over that by the
/// standard deviation of the logarithms: ratio of the standard deviations of
/// their logarithms over a bootstrap of earthquakes, by demand.
pub(super) fn scatter(scope: &Scope<'_>) -> MeasureResult {
    let thresholds = Thresholds::new(scope)?;
    let clusters = scope.draws.clusters(scope.tested);
    let of = |held: &[u32], draws: usize| -> Vec<f64> {
        let records: Vec<usize> =
            (0..held.len()).filter(|r| held[*r] > 0).collect();
        let part = clusters.part(&records);
        let draws = Bootstrap::of_clusters("study/scatter", 0, &part, draws);
        let rows = draws.map(|places| {
            let mut counts = vec![0; held.len()];
            for place in places {
                counts[records[*place]] += 1;
            }
            let each = thresholds.ranked.iter();
            each.map(|own| dispersions(own, &counts)).collect::<Vec<_>>()
        });
        let ratio = |place: usize| {
            let scatter = |k: usize| {
                let logs = rows.iter().map(|row| log(row[place][k]));
                variance(&logs.collect::<Vec<f64>>()).sqrt()
            };
            scatter(0) / scatter(1)
        };
        (0..THRESHOLDS.len()).map(ratio).collect()
    };
    let [whole, part] = SCATTER;
    let rows = (0..clusters.count()).map(|g| of(&clusters.without(g), part));
    let each = Replicates {
        how: Resampling::Without(1),
        points: of(scope.every(), whole),
        rows: rows.collect(),
    };
    let counts = demands(&each, |ratio| ratio > 1.0);
    Ok(Measured::new(counts, each.one(geometric), MEAN))
}

/// Dispersion of a sample: half the logarithm of its 84 over its 16 %
/// quantile, and the standard deviation of its logarithms.
fn dispersions(ranked: &RecordRanks, counts: &[u32]) -> [f64; 2] {
    let logs: Vec<f64> =
        ranked.drawn(counts).iter().map(|x| log(*x)).collect();
    let at = |p| log(ranked.quantile(counts, p));
    [0.5 * (at(0.84) - at(0.16)), variance(&logs).sqrt()]
}

fn variance(values: &[f64]) -> f64 {
    let centre = mean(values.iter().copied());
    mean(values.iter().map(|x| (x - centre) * (x - centre)))
}
