//! Sections 2 to 4: measures of capacities, the intensities that reach a
//! demand.

use rocking::capacity::{InversionRule, ResponseCurve};

use super::scope::{
    COINCIDE, MeasureResult, Measured, Scope, blocks, compared_blocks,
    geometric_mean, mean_ratio, ranks, ratios, weighted_mean,
};
use super::stripes::{STOCKIEST, conforming, notch_holds_1};
use crate::distributions::{average_factors, factors, scaled};
use crate::estimates::mean;
use crate::inference::least_counted;
use crate::runs::{DEMANDS, capacities, curves_of};
use crate::sensitivities::OtherChoice;
use rocking_common::findings::SampleCount;
use rocking_common::paper::{
    FREQUENCIES_RAD_S, Intensity, REFERENCE, SLENDERNESSES_RAD, demand_index,
    position,
};
use rocking_draw::figures::common::span;
use rocking_statistics::resampling::RecordRanks;
use rocking_statistics::{Estimate, Range};

/// The quantiles of Figures 8 and 10.
const QUANTILES: [f64; 3] = [0.16, 0.50, 0.84];

/// A sample and the reference sample with which its quantiles are compared.
type SamplePair = [RecordRanks; 2];

fn pair(own: &[f64], reference: &[f64]) -> SamplePair {
    [own, reference].map(RecordRanks::new)
}

/// Whether each quantile of a sample lies within 10 % of the reference's; a
/// quantile that is overturned in both is left out.
fn quantiles_coincide(
    [own, reference]: &SamplePair,
    counts: &[u32],
) -> impl Iterator<Item = bool> {
    let ratio = |p| own.quantile(counts, p) / reference.quantile(counts, p);
    let ratios = QUANTILES.map(ratio).into_iter().filter(|x| !x.is_nan());
    ratios.map(|ratio| (ratio - 1.0).abs() <= COINCIDE)
}

/// Share of the quantiles within 10 % of the reference's, over the pairs that
/// count.
fn coinciding(scope: &Scope<'_>, mut pairs: Vec<SamplePair>) -> Measured {
    let least = least_counted(scope.records());
    pairs.retain(|pair| pair.iter().all(|own| own.records() >= least));
    let all = |counts: &[u32]| {
        let each = pairs.iter().flat_map(|p| quantiles_coincide(p, counts));
        SampleCount::among(each, |coincides| coincides)
    };
    let share = scope.one(|counts| all(counts).value);
    Measured::new([all(scope.every())], share, "all quantiles that count")
}

/// First overturning of a curve; infinite if it never overturns, NaN without a
/// curve.
fn first(curve: Option<&ResponseCurve>) -> f64 {
    let first = |c: &ResponseCurve| c.overturning_im();
    curve.map_or(f64::NAN, |c| first(c).unwrap_or(f64::INFINITY))
}

/// First overturning by the other criterion over the study's.
pub(super) fn criterion(scope: &Scope<'_>) -> MeasureResult {
    let results = scope.results;
    let curves = results.ordinary.curves(results.plan.common())?;
    let varied = results.varied(&[OtherChoice::OtherCriterion])?;
    let both = varied.iter().map(|(varied, _)| {
        let base = &curves[position(varied.frequency, varied.slenderness)];
        let own = varied.curves.iter().map(|c| first(c.as_ref()));
        [own.collect(), base.iter().map(|c| first(Some(c))).collect()]
    });
    let both: Vec<[Vec<f64>; 2]> = both.collect();
    let coincides = |[a, b]: &[Vec<f64>; 2]| {
        quantiles_coincide(&pair(a, b), scope.every()).all(|one| one)
    };
    let counts = [SampleCount::among(&both, coincides)];
    let ratios = both.iter().map(|[a, b]| ratios(a, b, 1.0));
    let at = format!("{} blocks", both.len());
    Ok(Measured::new(counts, mean_ratio(scope, ratios), at))
}

/// Overturning with another restitution over the study's, geometric mean.
fn restitution(
    scope: &Scope<'_>,
    choice: OtherChoice,
) -> anyhow::Result<Estimate> {
    let mut cells = Vec::new();
    for (varied, base) in scope.results.varied(&[choice])? {
        cells.push(ratios(&varied.overturning()?, base.overturning(), 1.0));
    }
    Ok(scope.estimate(Range::NotNegative, &mean_ratio(scope, cells)))
}

/// Effect of restitution on overturning over the effect of size: the mean |ln|
/// of the paired ratio between eta = 0.85 and 0.97 over its mean between p = 1
/// and 4, by slenderness.
pub(super) fn restitution_beside_size(scope: &Scope<'_>) -> MeasureResult {
    let results = scope.results;
    let [low, high] = [OtherChoice::Eta085, OtherChoice::Eta097];
    let both =
        results.varied(&[low])?.into_iter().zip(results.varied(&[high])?);
    let logs = |a: &[f64], b: &[f64]| -> Vec<f64> {
        ratios(a, b, 1.0).into_iter().map(libm::log).collect()
    };
    let mut pairs = Vec::new();
    // With --full there are three p, which share this comparison.
    for ((low, _), (high, _)) in both.filter(|(low, _)| low.0.frequency == 1) {
        let own = logs(&low.overturning()?, &high.overturning()?);
        let by_size = |frequency| {
            let (arm, place) =
                (results.plan.common(), (frequency, low.slenderness));
            results.ordinary.block(arm, Intensity::Pga, place)
        };
        let (large, small) = (by_size(0)?, by_size(2)?);
        pairs.push((own, logs(large.overturning(), small.overturning())));
    }
    let each = |counts: &[u32]| -> Vec<f64> {
        let ratio = |(own, size): &(Vec<f64>, Vec<f64>)| {
            (weighted_mean(own, counts) / weighted_mean(size, counts)).abs()
        };
        pairs.iter().map(ratio).collect()
    };
    let counts = [SampleCount::among(each(scope.every()), |x| x < 1.0)];
    let effect = scope.one(|counts| geometric_mean(each(counts)));
    let (low, high) = (restitution(scope, low)?, restitution(scope, high)?);
    Ok(Measured::new(counts, effect, "alpha = 0.10 and 0.20")
        .and("overturning intensity, eta = 0.85 over 0.92", low)
        .and("overturning intensity, eta = 0.97 over 0.92", high))
}

/// Capacities in PGA of a block and of the reference block at a demand.
fn samples<'a>(
    scope: &Scope<'a>,
    frequency: usize,
    slenderness: usize,
    demand: f64,
) -> anyhow::Result<[&'a [f64]; 2]> {
    let of = |slenderness| -> anyhow::Result<&'a [f64]> {
        let place = (frequency, slenderness);
        let found = scope.suite().block(scope.arm, Intensity::Pga, place)?;
        Ok(&found.samples[demand_index(demand)])
    };
    Ok([of(slenderness)?, of(REFERENCE)?])
}

/// Median paired ratios of intensities at equal demand.
pub(super) fn demand_ratios(scope: &Scope<'_>) -> MeasureResult {
    let (mut cells, mut stockiest) = (Vec::new(), Vec::new());
    for (frequency, slenderness) in compared_blocks() {
        for demand in DEMANDS {
            let [own, reference] =
                samples(scope, frequency, slenderness, demand)?;
            let of = || ranks(own, reference, 1.0);
            cells.push(of());
            stockiest.extend((slenderness == STOCKIEST).then(of));
        }
    }
    Ok(conforming(scope, cells, stockiest))
}

/// Factors from PGA to a measure, by frequency parameter, then by record.
type Factors = [Vec<f64>; FREQUENCIES_RAD_S.len()];

/// Factors of PGA itself.
fn in_pga(scope: &Scope<'_>) -> Factors {
    std::array::from_fn(|_| vec![1.0; scope.records()])
}

/// Pairs of capacities of a block and of the reference block, for all blocks and
/// demands, in the measure of these factors.
fn demand_pairs(
    scope: &Scope<'_>,
    factors: &Factors,
) -> anyhow::Result<Vec<SamplePair>> {
    let mut pairs = Vec::new();
    for (frequency, slenderness) in compared_blocks() {
        for demand in DEMANDS {
            let own = samples(scope, frequency, slenderness, demand)?;
            let own = own.map(|sample| scaled(sample, &factors[frequency]));
            pairs.push(own.map(|sample| RecordRanks::new(&sample)));
        }
    }
    Ok(pairs)
}

/// Figure 8: intensity given demand, and demand given intensity.
pub(super) fn quantiles(scope: &Scope<'_>) -> MeasureResult {
    let (stripes, pga) = (scope.stripes()?, in_pga(scope));
    let mut pairs = demand_pairs(scope, &pga)?;
    for (frequency, slenderness) in compared_blocks() {
        let levels = stripes.compared(frequency, Some(slenderness));
        pairs.extend(levels.map(|(_, own, reference)| pair(own, reference)));
    }
    let mut found = coinciding(scope, pairs);
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        let name = format!(
            "spread of the median overturning intensity over slendernesses, \
             p = {p}"
        );
        let own = blocks().filter(|block| block.0 == frequency);
        found = found.and(&name, spread(scope, own, &pga)?);
    }
    Ok(found)
}

/// Figure 8 in AvgSA: intensity given demand.
pub(super) fn average_sa_quantiles(scope: &Scope<'_>) -> MeasureResult {
    let records = &scope.suite().records;
    let average: Factors =
        std::array::from_fn(|frequency| average_factors(records, frequency));
    let mut found = coinciding(scope, demand_pairs(scope, &average)?);
    for (im, factors) in [("PGA", &in_pga(scope)), ("AvgSA", &average)] {
        let name = format!(
            "spread of the median overturning intensity over all blocks, {im}"
        );
        found = found.and(&name, spread(scope, blocks(), factors)?);
    }
    Ok(found)
}

/// Largest over smallest median overturning intensity of some blocks, minus 1,
/// in the measure of these factors. It has no interval: resamples only spread
/// such a number more.
fn spread(
    scope: &Scope<'_>,
    blocks: impl Iterator<Item = (usize, usize)>,
    factors: &Factors,
) -> anyhow::Result<Estimate> {
    let mut medians = Vec::new();
    for (frequency, slenderness) in blocks {
        let [own, _] = samples(scope, frequency, slenderness, 1.0)?;
        let ranks = RecordRanks::new(&scaled(own, &factors[frequency]));
        medians.push(ranks.median(scope.every()));
    }
    let is_reached = medians.iter().all(|x| x.is_finite());
    let ends = span(medians, true).filter(|_| is_reached);
    let spread = ends.map_or(f64::NAN, |(low, high)| high / low - 1.0);
    Ok(Estimate::exact(spread))
}

/// Figure 10: both quantiles, slenderness adjusted over records scaled.
pub(super) fn adjusted_quantiles(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let curves = curves_of(&scope.suite().adjusted, scope.arm)?;
    let mut pairs = Vec::new();
    for (frequency, curves) in curves.iter().enumerate() {
        let own = curves.iter();
        let own = own.map(|c| capacities(c, &DEMANDS, InversionRule::Median));
        let own: Vec<Vec<f64>> = own.collect::<Result<_, _>>()?;
        for (k, demand) in DEMANDS.into_iter().enumerate() {
            let own: Vec<f64> = own.iter().map(|of| of[k]).collect();
            let [reference, _] = samples(scope, frequency, REFERENCE, demand)?;
            pairs.push(pair(&own, reference));
        }
        let levels = stripes.compared(frequency, None);
        pairs.extend(levels.map(|(_, own, reference)| pair(own, reference)));
    }
    Ok(coinciding(scope, pairs))
}

/// Mean capacity by the median point over the mean by the monotone inversion,
/// mean over blocks and demands.
pub(super) fn inversion(scope: &Scope<'_>) -> MeasureResult {
    // By cell, by record: median-point and monotone capacity.
    let mut values: Vec<Vec<(f64, f64)>> = Vec::new();
    for own in scope.suite().curves(scope.arm)? {
        let by = |rule| -> anyhow::Result<Vec<Vec<f64>>> {
            own.iter().map(|c| capacities(c, &DEMANDS, rule)).collect()
        };
        let median = by(InversionRule::Median)?;
        let monotone = by(InversionRule::Monotone)?;
        for k in 0..DEMANDS.len() {
            let pairs = median.iter().zip(&monotone);
            values.push(pairs.map(|(a, b)| (a[k], b[k])).collect());
        }
    }
    let at = format!("mean over {} blocks and demands", values.len());
    let ratio = scope.one(|counts| {
        mean(values.iter().map(|pairs| {
            let (mut a, mut b) = (0.0, 0.0);
            for ((x, y), count) in pairs.iter().zip(counts) {
                if x.is_finite() && y.is_finite() {
                    a += x * f64::from(*count);
                    b += y * f64::from(*count);
                }
            }
            a / b
        }))
    });
    Ok(Measured::number(ratio, at))
}

/// Capacities with Housner's restitution over the study's, stocky over
/// slender: the slenderness's own ratio is divided out.
pub(super) fn housner(scope: &Scope<'_>) -> MeasureResult {
    let mut by_slenderness = [const { Vec::new() }; SLENDERNESSES_RAD.len()];
    let found = scope.results.varied(&[OtherChoice::Housner])?.into_iter();
    for (varied, base) in found.filter(|(v, _)| v.frequency == 1) {
        let own = varied.overturning()?;
        let each = own.iter().zip(base.overturning());
        by_slenderness[varied.slenderness] =
            each.map(|(own, base)| own / base).collect::<Vec<f64>>();
    }
    let [slender, .., stocky] = by_slenderness;
    let ratio = ranks(&stocky, &slender, 1.0);
    let leaves_1_out = usize::from(!notch_holds_1(&ratio, scope.every()));
    let counts = [SampleCount::of(leaves_1_out, 1)];
    let effect = scope.mean_median(&[ratio]);
    Ok(Measured::new(counts, effect, "p = 3, alpha = 0.25 over 0.05"))
}

/// Spread of the intensities at uplift in PGV, p = 1; in PGA it is 1 by
/// definition.
pub(super) fn onset(scope: &Scope<'_>) -> Measured {
    let records = &scope.suite().records;
    let onsets = factors(records, Intensity::Pgv, FREQUENCIES_RAD_S[0]);
    let ranked = RecordRanks::new(&onsets);
    let spread = scope.one(|counts| {
        ranked.quantile(counts, 0.84) / ranked.quantile(counts, 0.16)
    });
    Measured::number(spread, "p = 1")
}
