//! Sections 2 to 4: measures of capacities, the intensities that reach a
//! demand.

use rocking::capacity::{InversionRule, ResponseCurve};

use super::scope::{
    CellValues, MeasureCells, MeasureResult, Scope, block, compared_blocks,
    geometric_means, ratios, weighted_mean,
};
use crate::distributions::factors;
use crate::estimates::mean;
use crate::fits::THRESHOLDS;
use crate::inference::{Cell, Replicates};
use crate::runs::{capacities, capacities_at, curves_of};
use crate::sensitivities::{OtherChoice, Variant};
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, Intensity, REFERENCE, SLENDERNESSES_RAD,
    demand_index, position,
};
use rocking_statistics::Proportion;
use rocking_statistics::resampling::RecordRanks;

/// Demands at which intensities are compared.
pub const DEMANDS: [f64; 10] =
    [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// The quantiles of Figures 8 and 10.
const QUANTILES: [f64; 3] = [0.16, 0.50, 0.84];

/// A sample whose quantiles are compared with another's.
struct SamplePair {
    at: String,
    own: RecordRanks,
    reference: RecordRanks,
}

impl SamplePair {
    fn new(at: String, own: &[f64], reference: &[f64]) -> Self {
        let [own, reference] = [own, reference].map(RecordRanks::new);
        Self { at, own, reference }
    }
}

/// Quantiles of one sample over those of another, for all pairs of samples;
/// NaN where one of the two is infinite.
fn quantile_ratios(scope: &Scope<'_>, pairs: &[SamplePair]) -> MeasureCells {
    let all = || pairs.iter().flat_map(|pair| QUANTILES.map(|p| (pair, p)));
    let cell = |(pair, p): (&SamplePair, f64)| Cell {
        at: format!("{}, {:.0} %", pair.at, 100.0 * p),
        records: pair.own.records().min(pair.reference.records()),
    };
    let measured = scope.smooth(|counts| {
        let ratio = |(pair, p): (&SamplePair, f64)| {
            let ratio = pair.own.quantile(counts, p)
                / pair.reference.quantile(counts, p);
            if ratio > 0.0 { ratio } else { f64::NAN }
        };
        all().map(ratio).collect()
    });
    MeasureCells::new(all().map(cell).collect(), measured)
}

/// Capacities at a demand under a choice; NaN for a record without a curve.
fn varied_at(varied: &Variant, demand: f64) -> anyhow::Result<Vec<f64>> {
    capacities_at(varied.curves.iter().map(Option::as_ref), demand)
}

/// Capacities at a demand of every record's curve.
fn all_at(curves: &[ResponseCurve], demand: f64) -> anyhow::Result<Vec<f64>> {
    capacities_at(curves.iter().map(Some), demand)
}

/// First overturning of a curve; infinite where it never overturns, NaN where
/// there is no curve.
fn first(curve: Option<&ResponseCurve>) -> f64 {
    let first = |c: &ResponseCurve| c.overturning_im();
    curve.map_or(f64::NAN, |c| first(c).unwrap_or(f64::INFINITY))
}

/// Paired ratios of other choices over the study's, by cell.
fn varied_ratios(
    scope: &Scope<'_>,
    choices: &[OtherChoice],
    demands: &[f64],
) -> anyhow::Result<Vec<(String, Vec<f64>)>> {
    let mut cells = Vec::new();
    for (varied, base) in scope.results.varied(choices)? {
        for demand in demands {
            let own = varied_at(varied, *demand)?;
            let reference = all_at(base, *demand)?;
            let at = block(varied.frequency, varied.slenderness);
            let at = match (choices, demands) {
                ([_], [_]) => at,
                ([_], _) => format!("{at}, demand {demand}"),
                _ => format!("{}, {at}", varied.choice.name()),
            };
            cells.push((at, ratios(&own, &reference, 1.0)));
        }
    }
    Ok(cells)
}

/// First overturning by the other criterion over the study's.
pub(super) fn criterion(scope: &Scope<'_>) -> MeasureResult {
    let all =
        scope.results.varied(&[OtherChoice::OtherCriterion])?.into_iter();
    let cells = all.map(|(varied, base)| {
        let own = varied.curves.iter().map(|c| first(c.as_ref()));
        let reference = base.iter().map(|c| first(Some(c)));
        let [own, reference]: [Vec<f64>; 2] =
            [own.collect(), reference.collect()];
        let at = block(varied.frequency, varied.slenderness);
        (at, ratios(&own, &reference, 1.0))
    });
    Ok(geometric_means(scope, cells.collect()))
}

/// Overturning with another restitution over the study's.
pub(super) fn restitution(scope: &Scope<'_>) -> MeasureResult {
    let choices = [OtherChoice::Eta085, OtherChoice::Eta097];
    let cells = varied_ratios(scope, &choices, &[1.0])?;
    Ok(geometric_means(scope, cells))
}

/// Capacities of the other component over the study's.
pub(super) fn component(scope: &Scope<'_>) -> MeasureResult {
    let choices = [OtherChoice::OtherComponent];
    let cells = varied_ratios(scope, &choices, &THRESHOLDS)?;
    Ok(geometric_means(scope, cells))
}

/// Effect of restitution on overturning beside the effect of size: the mean
/// |ln| of the paired ratio between eta = 0.85 and 0.97 over the mean between
/// p = 1 and 4, by slenderness.
pub(super) fn restitution_beside_size(scope: &Scope<'_>) -> MeasureResult {
    let results = scope.results;
    let curves = results.ordinary.curves(results.plan.common())?;
    let low = results.varied(&[OtherChoice::Eta085])?;
    let high = results.varied(&[OtherChoice::Eta097])?;
    let logs = |a: &[f64], b: &[f64]| -> Vec<f64> {
        ratios(a, b, 1.0).into_iter().map(libm::log).collect()
    };
    let (mut cells, mut pairs) = (Vec::new(), Vec::new());
    let both = low.iter().zip(&high);
    // With --full there are three p, which share this comparison.
    for ((low, _), (high, _)) in both.filter(|(low, _)| low.0.frequency == 1) {
        let own = logs(&varied_at(low, 1.0)?, &varied_at(high, 1.0)?);
        let by_size = |frequency| {
            all_at(&curves[position(frequency, low.slenderness)], 1.0)
        };
        let size = logs(&by_size(0)?, &by_size(2)?);
        cells.push(Cell {
            at: format!("alpha = {:.2}", SLENDERNESSES_RAD[low.slenderness]),
            records: own.iter().filter(|x| x.is_finite()).count(),
        });
        pairs.push((own, size));
    }
    let measured = scope.smooth(|counts| {
        let ratio = |(own, size): &(Vec<f64>, Vec<f64>)| {
            (weighted_mean(own, counts) / weighted_mean(size, counts)).abs()
        };
        pairs.iter().map(ratio).collect()
    });
    Ok(MeasureCells::new(cells, measured))
}

/// Samples of a block and of the reference block at a demand.
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
    let mut cells = Vec::new();
    for (frequency, slenderness) in compared_blocks() {
        for demand in DEMANDS {
            let [own, reference] =
                samples(scope, frequency, slenderness, demand)?;
            let name = block(frequency, slenderness);
            let at = format!("{name}, demand {demand}");
            cells.push(CellValues::ratios(at, own, reference));
        }
    }
    Ok(scope.medians(cells))
}

/// Figure 8: intensity given demand, and demand given intensity.
pub(super) fn quantiles(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let mut pairs = Vec::new();
    for (frequency, slenderness) in compared_blocks() {
        let name = block(frequency, slenderness);
        for demand in DEMANDS {
            let [own, reference] =
                samples(scope, frequency, slenderness, demand)?;
            let at = format!("{name}, intensity at demand {demand}");
            pairs.push(SamplePair::new(at, own, reference));
        }
        let levels = stripes.compared(frequency, Some(slenderness));
        pairs.extend(levels.map(|(im, own, reference)| {
            let at = format!("{name}, demand at intensity {im}");
            SamplePair::new(at, own, reference)
        }));
    }
    Ok(quantile_ratios(scope, &pairs))
}

/// Figure 10: both quantiles, slenderness adjusted over records scaled.
pub(super) fn adjusted_quantiles(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let curves = curves_of(&scope.suite().adjusted, scope.arm)?;
    let mut pairs = Vec::new();
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        for demand in DEMANDS {
            let own = all_at(&curves[frequency], demand)?;
            let [reference, _] = samples(scope, frequency, REFERENCE, demand)?;
            let at = format!("p = {p}, intensity at demand {demand}");
            pairs.push(SamplePair::new(at, &own, reference));
        }
        let levels = stripes.compared(frequency, None);
        pairs.extend(levels.map(|(im, own, reference)| {
            let at = format!("p = {p}, demand at intensity {im}");
            SamplePair::new(at, own, reference)
        }));
    }
    Ok(quantile_ratios(scope, &pairs))
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
    Ok(scope.value(&at, scope.records(), |counts| {
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
    }))
}

/// Capacities with Housner's restitution over the study's, stocky over
/// slender, so that the slenderness's own ratio is divided out.
pub(super) fn housner(scope: &Scope<'_>) -> MeasureResult {
    let mut by_slenderness = [const { Vec::new() }; SLENDERNESSES_RAD.len()];
    let found = scope.results.varied(&[OtherChoice::Housner])?.into_iter();
    for (varied, base) in found.filter(|(v, _)| v.frequency == 1) {
        let (own, base) = (varied_at(varied, 1.0)?, all_at(base, 1.0)?);
        let each = own.iter().zip(&base).map(|(own, base)| own / base);
        by_slenderness[varied.slenderness] = each.collect::<Vec<f64>>();
    }
    let [slender, .., stocky] = by_slenderness;
    let ranked = RecordRanks::new(&ratios(&stocky, &slender, 1.0));
    let at = "p = 3, alpha = 0.25 over 0.05";
    Ok(scope.value(at, ranked.records(), |counts| {
        (ranked.median(counts) - 1.0).abs()
    }))
}

/// Share of records that uplift the stockiest block unscaled.
pub(super) fn uplift(scope: &Scope<'_>) -> MeasureResult {
    let stockiest = &BLOCKS[SLENDERNESSES_RAD.len() - 1];
    let (suite, records) = (scope.suite(), scope.records());
    let share =
        Proportion::try_new(suite.uplift_unscaled(stockiest), records)?;
    let cell = Cell { at: "alpha = 0.25".into(), records };
    Ok(MeasureCells::new(vec![cell], Replicates::of_counts(vec![share])))
}

/// Spread of the intensities at uplift in PGV, p = 1; in PGA it is 1 by
/// definition.
pub(super) fn onset(scope: &Scope<'_>) -> MeasureCells {
    let records = &scope.suite().records;
    let onsets = factors(records, Intensity::Pgv, FREQUENCIES_RAD_S[0]);
    let ranked = RecordRanks::new(&onsets);
    scope.value("p = 1", onsets.len(), |counts| {
        ranked.quantile(counts, 0.84) / ranked.quantile(counts, 0.16)
    })
}
