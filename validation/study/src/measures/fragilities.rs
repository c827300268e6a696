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
use crate::distributions::{factors, least};
use crate::estimates::mean;
use crate::fits::{BLOCK, Fits, THRESHOLDS, apart};
use crate::inference::{Replicates, Resample};
use rocking_common::findings::SampleCount;
use rocking_common::paper::{Intensity, demand_index};

/// The thresholds of a block in an intensity measure.
pub(crate) struct Thresholds {
    ranked: Vec<RecordRanks>,
    /// Intensities at uplift by record: the least is the shift.
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

    /// The fits of one threshold in a draw.
    pub(crate) fn at(&self, counts: &[u32], place: usize) -> Option<Fits> {
        let drawn = self.ranked[place].drawn(counts);
        let sample = ExtendedSample::try_new(&drawn).ok()?;
        let onsets = self.onsets.iter().zip(counts).filter(|(_, c)| **c > 0);
        let onsets: Vec<f64> = onsets.map(|(onset, _)| *onset).collect();
        Some(Fits::new(sample, least(&onsets)))
    }

    fn each(&self, counts: &[u32], f: impl Fn(&Fits) -> f64) -> Vec<f64> {
        (0..THRESHOLDS.len())
            .map(|k| self.at(counts, k).as_ref().map_or(f64::NAN, &f))
            .collect()
    }
}

/// A number of each threshold, over the replicates.
pub(crate) fn by_demand(
    scope: &Scope<'_>,
    f: impl Fn(&Fits) -> f64 + Sync,
) -> anyhow::Result<Replicates> {
    let thresholds = Thresholds::new(scope)?;
    Ok(scope.smooth(|counts| thresholds.each(counts, &f)))
}

/// Place of a number that is a mean over the thresholds.
const MEAN: &str = "mean over demands 0.15, 0.35 and 1.00";

/// Name of the mean distance to the SSFL.
const TO_SSFL: &str = "distance to the SSFL, mean over demands";

fn arithmetic(row: &[f64]) -> f64 {
    mean(row.iter().copied())
}

fn geometric(row: &[f64]) -> f64 {
    geometric_mean(row.iter().copied())
}

/// Number of demands whose value satisfies a condition.
fn demands(of: &Replicates, is: impl Fn(f64) -> bool) -> Vec<SampleCount> {
    vec![SampleCount::among(of.points.iter().copied(), is)]
}

/// A gain by demand: the number of demands with a gain, and the mean gain.
fn gain(scope: &Scope<'_>, f: impl Fn(&Fits) -> f64 + Sync) -> MeasureResult {
    let each = by_demand(scope, f)?;
    let counts = demands(&each, |gain| gain > 0.0);
    Ok(Measured::new(counts, each.one(arithmetic), MEAN))
}

/// Mean over the demands of a distance in probability.
fn mean_distance(
    scope: &Scope<'_>,
    f: impl Fn(&Fits) -> f64 + Sync,
) -> anyhow::Result<Estimate> {
    let each = by_demand(scope, f)?;
    Ok(scope.estimate(Range::Share, &each.one(arithmetic)))
}

/// A number of one threshold.
fn at_place(
    scope: &Scope<'_>,
    place: usize,
    f: impl Fn(&Fits) -> f64 + Sync,
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
            at.to_sample(at.usfl) - at.to_sample(at.ssfl)
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

fn trimmed_to_ssfl(at: &Fits) -> f64 {
    at.to_ssfl(at.trimmed, 1.0)
}

fn untrimmed_to_ssfl(at: &Fits) -> f64 {
    at.to_ssfl(at.usfl, 1.0)
}

/// Distance to the SSFL, trimmed USFL7 over trimmed USFL.
pub(super) fn trimmed(scope: &Scope<'_>) -> MeasureResult {
    let each = by_demand(scope, |at| {
        trimmed_to_ssfl(at) / apart(at.trimmed, at.ssfl)
    })?;
    let counts = demands(&each, |ratio| ratio < 1.0);
    let thresholds = Thresholds::new(scope)?;
    let to_sample = |fit: fn(&Fits) -> Option<Lognormal>| {
        let each = thresholds.each(scope.every(), |at| at.to_sample(fit(at)));
        Estimate::exact(arithmetic(&each))
    };
    let at_uplift = mean_distance(scope, |at| {
        at.trimmed.map_or(f64::NAN, |fit| fit.cdf(at.shift))
    })?;
    let untrimmed = mean_distance(scope, untrimmed_to_ssfl)?;
    Ok(Measured::new(counts, each.one(geometric), MEAN)
        .and(TO_SSFL, mean_distance(scope, trimmed_to_ssfl)?)
        .and("distance to the SSFL without trimming", untrimmed)
        .and(
            "distance to the sample, trimmed USFL, mean over demands",
            to_sample(|at| at.trimmed),
        )
        .and(
            "distance to the sample, trimmed USFL7, mean over demands",
            to_sample(|at| at.usfl7(at.trimmed, 1.0)),
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
        let of = |c| at.to_ssfl(at.trimmed, c);
        of(0.25) - mean([0.5, 0.75, 1.0].map(of))
    })
}

/// Slopes k of the hazard H = x^-k, from the flat hazard of a zone of strong
/// earthquakes to a steep hazard.
const SLOPES: [f64; 5] = [1.5, 2.0, 2.5, 3.0, 4.0];

/// Position of the slope whose number is shown, 2.5.
const SHOWN: usize = 2;

/// A number of overturning under the slope shown, and the number of slopes that
/// satisfy a condition.
fn by_slope(
    scope: &Scope<'_>,
    f: impl Fn(f64, &Fits) -> f64 + Sync,
    is: impl Fn(f64, &Fits) -> bool,
) -> MeasureResult {
    let last = THRESHOLDS.len() - 1;
    let whole = Thresholds::new(scope)?.at(scope.every(), last);
    let is = |k| whole.as_ref().is_some_and(|at| is(k, at));
    let counts = [SampleCount::among(SLOPES, is)];
    let effect = at_place(scope, last, |at| f(SLOPES[SHOWN], at))?;
    let at = format!("hazard of slope {}", SLOPES[SHOWN]);
    Ok(Measured::new(counts, effect, at))
}

/// Annual frequency by the sample's empirical fragility under H = x^-k, from
/// the capacities above a limit: the mean of x^-k. A capacity that was never
/// reached adds nothing.
fn sample_rate(at: &Fits, k: f64, above: f64) -> f64 {
    let capacities = at.sample.sorted();
    let rates = capacities.iter().filter(|x| **x > above);
    let sum = rates.fold(0.0, |sum, x| sum + libm::exp(-k * log(*x)));
    sum / capacities.len() as f64
}

/// Share of the annual frequency of overturning that comes from the
/// capacities above the 84 % quantile.
pub(super) fn tail_rate(scope: &Scope<'_>) -> MeasureResult {
    let share = |k: f64, at: &Fits| {
        let quantile =
            QuantileType::default().extended_quantile(&at.sample, 0.84);
        let quantile = quantile.unwrap_or(f64::NAN);
        sample_rate(at, k, quantile) / sample_rate(at, k, 0.0)
    };
    by_slope(scope, share, |k, at| share(k, at) < 0.16)
}

/// Annual frequency of overturning by a fit over the frequency by the sample.
fn rate_of(fit: Option<Lognormal>, k: f64, at: &Fits) -> f64 {
    // One segment, so wide that nothing lies outside.
    let end = |x: f64| (x, libm::exp(-k * log(x)));
    let hazard = HazardCurve::try_new(&[end(1e-3), end(1e3)]);
    let (Some(fit), Ok(hazard)) = (fit, hazard) else { return f64::NAN };
    hazard.annual_frequency(fit).truncation_lower / sample_rate(at, k, 0.0)
}

/// Annual frequency by a fit over the sample's, and the number of slopes for
/// which the fit is closer to the sample than another fit, as a ratio.
fn rate(
    scope: &Scope<'_>,
    fits: fn(&Fits) -> [Option<Lognormal>; 2],
) -> MeasureResult {
    let ratios = |k: f64, at: &Fits| fits(at).map(|fit| rate_of(fit, k, at));
    by_slope(
        scope,
        |k, at| ratios(k, at)[0],
        |k, at| {
            let [own, other] = ratios(k, at).map(|ratio| log(ratio).abs());
            own < other
        },
    )
}

/// Annual frequency by the SSFL over the sample's.
pub(super) fn shifted_rate(scope: &Scope<'_>) -> MeasureResult {
    rate(scope, |at| [at.ssfl, at.usfl])
}

/// Annual frequency by trimmed USFL7 over the sample's.
pub(super) fn transformed_rate(scope: &Scope<'_>) -> MeasureResult {
    rate(scope, |at| [at.usfl7(at.trimmed, 1.0), at.trimmed])
}

/// Distance of untrimmed USFL7 to the SSFL: in PGA over the distance of the
/// trimmed one, in PGV over the distance in PGA.
pub(super) fn untrimmed(scope: &Scope<'_>) -> MeasureResult {
    let (each, counts) = if scope.intensity == Intensity::Pga {
        let of = |at: &Fits| untrimmed_to_ssfl(at) / trimmed_to_ssfl(at);
        let each = by_demand(scope, of)?;
        let counts = demands(&each, |ratio| ratio > 1.0);
        (each, counts)
    } else {
        let pga = Scope { intensity: Intensity::Pga, ..*scope };
        let both = [Thresholds::new(scope)?, Thresholds::new(&pga)?];
        let each = scope.smooth(|counts| {
            let of = |own: &Thresholds| own.each(counts, untrimmed_to_ssfl);
            let [pgv, pga] = both.each_ref().map(of);
            pgv.iter().zip(&pga).map(|(a, b)| a / b).collect()
        });
        let counts = demands(&each, |ratio| ratio < 1.0);
        (each, counts)
    };
    Ok(Measured::new(counts, each.one(geometric), MEAN)
        .and(TO_SSFL, mean_distance(scope, untrimmed_to_ssfl)?))
}

/// Gain in the distance of untrimmed USFL7 to SSFL from c = 1 to c = 0.25.
pub(super) fn low_constant(scope: &Scope<'_>) -> MeasureResult {
    let gain = at_place(scope, 0, |at| {
        at.to_ssfl(at.usfl, 1.0) - at.to_ssfl(at.usfl, 0.25)
    })?;
    Ok(Measured::number(gain, named(0)))
}

/// Distance of USFL7 for c = 0.25 to USFL7 for c = 1, trimmed over untrimmed.
pub(super) fn constant_spread(scope: &Scope<'_>) -> MeasureResult {
    let spread = |at: &Fits, fit| {
        let [low, high] = [0.25, 1.0].map(|c| at.usfl7(fit, c));
        apart(low, high)
    };
    let trimmed = at_place(scope, 0, |at| spread(at, at.trimmed))?;
    let ratio =
        at_place(scope, 0, |at| spread(at, at.trimmed) / spread(at, at.usfl))?;
    let counts = [SampleCount::number(trimmed.points[0])];
    let own = scope.estimate(Range::Share, &trimmed);
    Ok(Measured::new(counts, ratio, named(0))
        .and("largest distance in probability, trimmed", own))
}

/// Dispersion of the whole sample over the dispersion of the trimmed one,
/// divided by this ratio of equally many quantiles of a lognormal.
pub(super) fn tail_inflation(scope: &Scope<'_>) -> MeasureResult {
    let inflation = |fits: &Fits| {
        let [whole, trimmed] = [fits.usfl, fits.trimmed]
            .map(|fit| fit.map_or(f64::NAN, |f| f.dispersion()));
        whole / trimmed
    };
    let n = scope.records() as f64;
    let score = |k: usize| normal::quantile((k as f64 + 0.5) / n);
    let scores = (0..scope.records()).map(|k| libm::exp(score(k)));
    let scores = ExtendedSample::try_new(&scores.collect::<Vec<f64>>())?;
    let expected = inflation(&Fits::new(scores, 0.0));
    let last = THRESHOLDS.len() - 1;
    let ratio = at_place(scope, last, |at| inflation(at) / expected)?;
    Ok(Measured::number(ratio, named(last)))
}

/// Draws for the scatter of the whole sample, and of a sample without an
/// earthquake: they give the ratio to 1 and to 2 %.
const SCATTER: [usize; 2] = [20_000, 4000];

/// Scatter of the dispersion by the 16 and 84 % quantiles over its scatter by
/// the standard deviation of the logarithms: ratio of the standard deviations of
/// the dispersions' logarithms over a bootstrap of earthquakes, by demand.
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
