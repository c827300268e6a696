//! Section 5, Figures 15 to 18: measures of fitted and transformed
//! fragilities, p = 3, alpha = 0.20.

use libm::log;
use rocking_procedures::fragility::risk::HazardCurve;
use rocking_statistics::resampling::{RecordRanks, Subsampling};
use rocking_statistics::{ExtendedSample, Lognormal, QuantileType};

use super::scope::{MeasureCells, MeasureResult, Scope};
use crate::distributions::factors;
use crate::estimates::mean;
use crate::fits::{BLOCK, Fits, THRESHOLDS, distance, usfl7};
use crate::inference::{Cell, Replicates, Resample};
use rocking_common::paper::demand_index;

/// Dispersion of a lognormal sample over the dispersion without its largest
/// twentieth: 1/sqrt(variance of a standard normal cut at its 95 %
/// quantile).
const LOGNORMAL_INFLATION: f64 = 1.104;

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

/// Largest difference of two fragilities in probability; 1 where one of them
/// does not exist.
fn apart(a: Option<Lognormal>, b: Option<Lognormal>) -> f64 {
    let (Some(a), Some(b)) = (a, b) else { return 1.0 };
    a.distance(&b).unwrap_or(f64::NAN)
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

/// A number of each threshold as a measure.
fn each(
    scope: &Scope<'_>,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> MeasureResult {
    let records = scope.records();
    let cell = |edp: f64| Cell { at: format!("demand {edp:.2}"), records };
    let measured = by_demand(scope, &Thresholds::new(scope)?, f);
    Ok(MeasureCells::new(THRESHOLDS.map(cell).into(), measured))
}

/// A number of one threshold as a measure.
fn at_place(
    scope: &Scope<'_>,
    place: usize,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> MeasureResult {
    let thresholds = Thresholds::new(scope)?;
    let at = format!("demand {:.2}", THRESHOLDS[place]);
    Ok(scope.value(&at, scope.records(), |counts| {
        thresholds.at(counts, place).as_ref().map_or(f64::NAN, &f)
    }))
}

/// Name of a cell that is a mean over the thresholds.
const MEAN: &str = "mean over demands 0.15, 0.35 and 1.00";

/// Mean over the thresholds, over draws with replacement.
fn mean_of(
    scope: &Scope<'_>,
    f: impl Fn(&DemandFits) -> f64 + Sync,
) -> MeasureResult {
    let thresholds = Thresholds::new(scope)?;
    let of = |counts: &[u32]| mean(thresholds.each(counts, &f));
    Ok(scope.value(MEAN, scope.records(), of))
}

/// Mean over the thresholds, from subsamples: a draw with replacement would
/// tie values.
fn mean_over(
    scope: &Scope<'_>,
    f: impl Fn(&Thresholds, &[u32]) -> Vec<f64> + Sync,
) -> MeasureResult {
    let thresholds = Thresholds::new(scope)?;
    let kind = scope.kind();
    let of = |draw: Resample<'_>| vec![mean(f(&thresholds, draw.of(kind)))];
    let cell = Cell { at: MEAN.into(), records: scope.records() };
    let measured = scope.draws.subsampled(scope.tested, &of);
    Ok(MeasureCells::new(vec![cell], measured))
}

/// Gain in distance to the sample by shifting.
pub(super) fn shift_gain(scope: &Scope<'_>) -> MeasureResult {
    mean_over(scope, |thresholds, counts| {
        thresholds.each(counts, |at| {
            distance(at.fits.usfl, &at.sample)
                - distance(at.fits.ssfl, &at.sample)
        })
    })
}

/// Distance of trimmed USFL7 to SSFL.
pub(super) fn trimmed(scope: &Scope<'_>) -> MeasureResult {
    each(scope, |at| to_ssfl(at.fits.trimmed, at, 1.0))
}

/// Probability that the unshifted fit of the trimmed sample gives to the
/// demand at uplift, where it is 0.
pub(super) fn at_uplift(scope: &Scope<'_>) -> MeasureResult {
    each(scope, |at| at.fits.trimmed.map_or(f64::NAN, |fit| fit.cdf(at.shift)))
}

/// Reduction of the distance of USFL7 to the SSFL by trimming.
pub(super) fn trimming_gain(scope: &Scope<'_>) -> MeasureResult {
    mean_of(scope, |at| {
        to_ssfl(at.fits.usfl, at, 1.0) - to_ssfl(at.fits.trimmed, at, 1.0)
    })
}

/// Reduction of the distance of the trimmed USFL7 to the SSFL by c = 0.5 to 1
/// instead of 0.25.
pub(super) fn high_constant_gain(scope: &Scope<'_>) -> MeasureResult {
    mean_of(scope, |at| {
        let of = |c| to_ssfl(at.fits.trimmed, at, c);
        of(0.25) - mean([0.5, 0.75, 1.0].map(of))
    })
}

/// Slopes k of the hazard H = x^-k: from the flat hazard of a strong
/// earthquake zone to a steep one.
const SLOPES: [f64; 5] = [1.5, 2.0, 2.5, 3.0, 4.0];

/// Overturning under each slope of the hazard.
fn by_slope(
    scope: &Scope<'_>,
    f: impl Fn(f64, &DemandFits) -> f64 + Sync,
) -> MeasureResult {
    let thresholds = Thresholds::new(scope)?;
    let records = scope.records();
    let cell = |k| Cell { at: format!("hazard of slope {k}"), records };
    let measured = scope.smooth(|counts| {
        let at = thresholds.at(counts, THRESHOLDS.len() - 1);
        let of = |k| at.as_ref().map_or(f64::NAN, |at| f(k, at));
        SLOPES.map(of).into()
    });
    Ok(MeasureCells::new(SLOPES.map(cell).into(), measured))
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
    by_slope(scope, |k, at| {
        let quantile =
            QuantileType::default().extended_quantile(&at.sample, 0.84);
        let quantile = quantile.unwrap_or(f64::NAN);
        sample_rate(at, k, quantile) / sample_rate(at, k, 0.0)
    })
}

/// Annual frequency of overturning by a fit over the frequency by the sample.
fn rate_of(fit: Option<Lognormal>, k: f64, at: &DemandFits) -> f64 {
    // One segment, so wide that nothing lies outside.
    let end = |x: f64| (x, libm::exp(-k * log(x)));
    let hazard = HazardCurve::try_new(&[end(1e-3), end(1e3)]);
    let (Some(fit), Ok(hazard)) = (fit, hazard) else { return f64::NAN };
    hazard.annual_frequency(&fit).truncation_lower / sample_rate(at, k, 0.0)
}

/// Annual frequency by the SSFL over the sample's.
pub(super) fn shifted_rate(scope: &Scope<'_>) -> MeasureResult {
    by_slope(scope, |k, at| rate_of(at.fits.ssfl, k, at))
}

/// Annual frequency by trimmed USFL7 over the sample's.
pub(super) fn transformed_rate(scope: &Scope<'_>) -> MeasureResult {
    by_slope(scope, |k, at| {
        rate_of(usfl7(at.fits.trimmed, at.shift, 1.0), k, at)
    })
}

/// Distance of untrimmed USFL7 to SSFL.
pub(super) fn untrimmed(scope: &Scope<'_>) -> MeasureResult {
    each(scope, |at| to_ssfl(at.fits.usfl, at, 1.0))
}

/// Gain in the distance of untrimmed USFL7 to SSFL from c = 1 to c = 0.25.
pub(super) fn low_constant(scope: &Scope<'_>) -> MeasureResult {
    at_place(scope, 0, |at| {
        to_ssfl(at.fits.usfl, at, 1.0) - to_ssfl(at.fits.usfl, at, 0.25)
    })
}

/// Distance of trimmed USFL7 for c = 0.25 to USFL7 for c = 1.
pub(super) fn constant_spread(scope: &Scope<'_>) -> MeasureResult {
    at_place(scope, 0, |at| {
        let of = |c| usfl7(at.fits.trimmed, at.shift, c);
        apart(of(0.25), of(1.0))
    })
}

/// Dispersion of the whole sample over the dispersion of the trimmed one, over
/// the ratio of a lognormal.
pub(super) fn tail_inflation(scope: &Scope<'_>) -> MeasureResult {
    at_place(scope, THRESHOLDS.len() - 1, |at| {
        let of =
            |fit: Option<Lognormal>| fit.map_or(f64::NAN, |f| f.dispersion());
        of(at.fits.usfl) / of(at.fits.trimmed) / LOGNORMAL_INFLATION
    })
}

/// Scatter of the dispersion by the 16 and 84 % quantiles over that by the
/// standard deviation of the logarithms: root of the ratio of their variances
/// over halves of the drawn records, mean over the demands.
pub(super) fn scatter(scope: &Scope<'_>) -> MeasureResult {
    const HALVES: u64 = 200;
    mean_over(scope, |thresholds, counts| {
        let halves: Vec<Vec<u32>> =
            (0..HALVES).map(|index| half(counts, index)).collect();
        let ratio = |ranked: &RecordRanks| {
            let both = halves.iter().map(|half| dispersions(ranked, half));
            let (quantiles, fit): (Vec<f64>, Vec<f64>) = both.unzip();
            (variance(&quantiles) / variance(&fit)).sqrt()
        };
        thresholds.ranked.iter().map(ratio).collect()
    })
}

/// Dispersion of a sample: half the logarithm of its 84 over its 16 %
/// quantile, and the standard deviation of its logarithms.
fn dispersions(ranked: &RecordRanks, counts: &[u32]) -> (f64, f64) {
    let logs: Vec<f64> =
        ranked.drawn(counts).iter().map(|x| log(*x)).collect();
    let at = |p| log(ranked.quantile(counts, p));
    (0.5 * (at(0.84) - at(0.16)), variance(&logs).sqrt())
}

fn variance(values: &[f64]) -> f64 {
    let centre = mean(values.iter().copied());
    mean(values.iter().map(|x| (x - centre) * (x - centre)))
}

/// Half of the drawn records.
fn half(counts: &[u32], index: u64) -> Vec<u32> {
    let drawn: Vec<usize> =
        (0..counts.len()).filter(|r| counts[*r] > 0).collect();
    let size = drawn.len() / 2;
    let halves = Subsampling::new("study/scatter", 0, drawn.len(), size);
    let mut out = vec![0; counts.len()];
    for (record, count) in drawn.iter().zip(halves.multiplicities(index)) {
        out[*record] = count * counts[*record];
    }
    out
}
