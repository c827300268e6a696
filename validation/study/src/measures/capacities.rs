//! Sections 2 to 4: measures of capacities, the intensities that reach a
//! demand.

use libm::tan;
use rocking::capacity::{InversionRule, ResponseCurve};

use super::source::{
    Found, Prepared, Source, block, geometric_means, ratios, weighted_mean,
};
use crate::analyses::no_arm;
use crate::distributions::factors;
use crate::estimates::mean;
use crate::inference::{Cell, Draw, Replicated};
use crate::runs::capacities;
use crate::sensitivities::{Choice, Varied};
use crate::stripes::of_arm;
use rocking_common::paper::{
    FREQUENCIES_RAD_S, Intensity, REFERENCE, SLENDERNESSES_RAD, STRIPES,
    demand_index, position,
};
use rocking_statistics::Proportion;
use rocking_statistics::resampling::Ranked;

/// Demands at which intensities are compared.
pub const DEMANDS: [f64; 10] =
    [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Demands of other choices' capacities: the paper's thresholds.
const THRESHOLDS: [f64; 3] = [0.15, 0.35, 1.0];

/// The quantiles of Figures 8 and 10.
const QUANTILES: [f64; 3] = [0.16, 0.50, 0.84];

/// A sample whose quantiles are compared with another's.
struct Pair {
    at: String,
    own: Ranked,
    reference: Ranked,
}

/// Quantiles of one sample over those of another, for all pairs of samples;
/// NaN where one of the two is infinite.
fn quantile_ratios(source: &Source<'_>, pairs: &[Pair]) -> Prepared {
    let kind = source.kind();
    let mut cells = Vec::new();
    for pair in pairs {
        let records = pair.own.records().min(pair.reference.records());
        for p in QUANTILES {
            let at = format!("{}, {:.0} %", pair.at, 100.0 * p);
            cells.push(Cell { at, records });
        }
    }
    let of = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(kind);
        let mut out = Vec::with_capacity(cells.len());
        for pair in pairs {
            for p in QUANTILES {
                let ratio = pair.own.quantile(counts, p)
                    / pair.reference.quantile(counts, p);
                out.push(if ratio > 0.0 { ratio } else { f64::NAN });
            }
        }
        out
    };
    let measured = source.draws.smooth(source.tested, &of);
    Prepared::new(cells, measured)
}

/// Medians of paired ratios, cell by cell.
fn paired(source: &Source<'_>, cells: Vec<(String, Vec<f64>)>) -> Prepared {
    let (cells, ranked) = cells
        .into_iter()
        .map(|(at, values)| {
            let ranked = Ranked::new(&values);
            (Cell { at, records: ranked.records() }, ranked)
        })
        .unzip();
    let measured = source.draws.medians(source.kind(), ranked);
    Prepared::new(cells, measured)
}

/// Other choices that were run, and the study's own curves of that block.
fn varied<'a>(
    source: &Source<'a>,
    choices: &'a [Choice],
) -> anyhow::Result<Vec<(&'a Varied, &'a [ResponseCurve])>> {
    let results = source.results;
    let curves = results.ordinary.curves(results.plan.common());
    let curves = curves.ok_or_else(no_arm)?;
    let of = |v: &'a Varied| {
        let at = position(v.frequency, v.slenderness);
        (v, curves[at].as_slice())
    };
    let found = results.varied.iter();
    Ok(found.filter(|v| choices.contains(&v.choice)).map(of).collect())
}

/// Capacity of a curve at a demand; NaN where there is no curve.
fn capacity(
    curve: Option<&ResponseCurve>,
    demand: f64,
) -> anyhow::Result<f64> {
    let of = |c: &ResponseCurve| {
        Ok(c.capacity(demand, InversionRule::Median)?.im())
    };
    curve.map_or(Ok(f64::NAN), of)
}

/// First overturning of a curve; infinite where it never overturns.
fn first(curve: &ResponseCurve) -> f64 {
    curve.overturning_im().unwrap_or(f64::INFINITY)
}

/// Paired ratios of other choices over the study's, by cell.
fn varied_ratios(
    source: &Source<'_>,
    choices: &[Choice],
    demands: &[f64],
) -> anyhow::Result<Vec<(String, Vec<f64>)>> {
    let mut cells = Vec::new();
    for (varied, base) in varied(source, choices)? {
        for demand in demands {
            let own: Vec<f64> = varied
                .curves
                .iter()
                .map(|c| capacity(c.as_ref(), *demand))
                .collect::<Result<_, _>>()?;
            let reference: Vec<f64> = base
                .iter()
                .map(|c| capacity(Some(c), *demand))
                .collect::<Result<_, _>>()?;
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

pub(super) fn criterion(source: &Source<'_>) -> Found {
    let mut cells = Vec::new();
    for (varied, base) in varied(source, &[Choice::OtherCriterion])? {
        let own: Vec<f64> = varied
            .curves
            .iter()
            .map(|c| c.as_ref().map_or(f64::NAN, first))
            .collect();
        let reference: Vec<f64> = base.iter().map(first).collect();
        let at = block(varied.frequency, varied.slenderness);
        cells.push((at, ratios(&own, &reference, 1.0)));
    }
    Ok(Some(geometric_means(source, cells)))
}

pub(super) fn restitution(source: &Source<'_>) -> Found {
    let choices = [Choice::Eta085, Choice::Eta097];
    let cells = varied_ratios(source, &choices, &[1.0])?;
    Ok(Some(geometric_means(source, cells)))
}

pub(super) fn component(source: &Source<'_>) -> Found {
    let choices = [Choice::OtherComponent];
    let cells = varied_ratios(source, &choices, &THRESHOLDS)?;
    Ok(Some(geometric_means(source, cells)))
}

/// What restitution does to overturning beside what the size does: the mean
/// |ln| of the paired ratio between eta = 0.85 and 0.97 over that between
/// p = 1 and 4, by slenderness.
pub(super) fn restitution_beside_size(source: &Source<'_>) -> Found {
    let results = source.results;
    let curves = results.ordinary.curves(results.plan.common());
    let curves = curves.ok_or_else(no_arm)?;
    let at_overturning =
        |curves: &[ResponseCurve]| -> anyhow::Result<Vec<f64>> {
            curves.iter().map(|c| capacity(Some(c), 1.0)).collect()
        };
    let low = varied(source, &[Choice::Eta085])?;
    let high = varied(source, &[Choice::Eta097])?;
    let logs = |a: &[f64], b: &[f64]| -> Vec<f64> {
        ratios(a, b, 1.0).into_iter().map(libm::log).collect()
    };
    let (mut cells, mut pairs) = (Vec::new(), Vec::new());
    for ((low, _), (high, _)) in low.iter().zip(&high) {
        // With --full there are three p, which share this comparison.
        if low.frequency != 1 {
            continue;
        }
        let of = |varied: &Varied| -> anyhow::Result<Vec<f64>> {
            varied.curves.iter().map(|c| capacity(c.as_ref(), 1.0)).collect()
        };
        let own = logs(&of(low)?, &of(high)?);
        let by_size = |frequency| {
            at_overturning(&curves[position(frequency, low.slenderness)])
        };
        let size = logs(&by_size(0)?, &by_size(2)?);
        cells.push(Cell {
            at: format!("alpha = {:.2}", SLENDERNESSES_RAD[low.slenderness]),
            records: own.iter().filter(|x| x.is_finite()).count(),
        });
        pairs.push((own, size));
    }
    let kind = source.kind();
    let of = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(kind);
        let ratio = |(own, size): &(Vec<f64>, Vec<f64>)| {
            (weighted_mean(own, counts) / weighted_mean(size, counts)).abs()
        };
        pairs.iter().map(ratio).collect()
    };
    let measured = source.draws.smooth(source.tested, &of);
    Ok(Some(Prepared::new(cells, measured)))
}

/// Samples of a suite at a demand, by block.
fn samples<'a>(
    source: &Source<'a>,
    frequency: usize,
    slenderness: usize,
    demand: f64,
) -> Option<&'a [f64]> {
    let results = source.results;
    let found =
        results.distributions(source.kind(), source.arm, Intensity::Pga)?;
    let block = &found.blocks[position(frequency, slenderness)];
    Some(&block.samples[demand_index(demand)])
}

pub(super) fn demand_ratios(source: &Source<'_>) -> Found {
    let Some(cells) = demand_cells(source) else { return Ok(None) };
    Ok(Some(paired(source, cells)))
}

fn demand_cells(source: &Source<'_>) -> Option<Vec<(String, Vec<f64>)>> {
    let mut cells = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            if slenderness == REFERENCE {
                continue;
            }
            for demand in DEMANDS {
                let own = samples(source, frequency, slenderness, demand)?;
                let reference = samples(source, frequency, REFERENCE, demand)?;
                let at = format!(
                    "{}, demand {demand}",
                    block(frequency, slenderness)
                );
                cells.push((at, ratios(own, reference, 1.0)));
            }
        }
    }
    Some(cells)
}

/// Figure 8: intensity given demand, and demand given intensity.
pub(super) fn quantiles(source: &Source<'_>) -> Found {
    Ok(quantile_pairs(source).map(|pairs| quantile_ratios(source, &pairs)))
}

fn quantile_pairs(source: &Source<'_>) -> Option<Vec<Pair>> {
    let suite = source.results.suite(source.kind());
    let stripes = of_arm(suite, source.arm)?;
    let mut pairs = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            if slenderness == REFERENCE {
                continue;
            }
            let name = block(frequency, slenderness);
            for demand in DEMANDS {
                let own = samples(source, frequency, slenderness, demand)?;
                let reference = samples(source, frequency, REFERENCE, demand)?;
                pairs.push(Pair {
                    at: format!("{name}, intensity at demand {demand}"),
                    own: Ranked::new(own),
                    reference: Ranked::new(reference),
                });
            }
            let of = |s| &stripes.demands[position(frequency, s)];
            let levels = of(slenderness).iter().zip(of(REFERENCE));
            for (im, (own, reference)) in STRIPES.iter().zip(levels) {
                pairs.push(Pair {
                    at: format!("{name}, demand at intensity {im}"),
                    own: Ranked::new(own),
                    reference: Ranked::new(reference),
                });
            }
        }
    }
    Some(pairs)
}

/// Figure 10: the same, slenderness adjusted over records scaled.
pub(super) fn adjusted_quantiles(source: &Source<'_>) -> Found {
    let suite = source.results.suite(source.kind());
    let stripes = of_arm(suite, source.arm);
    let curves = suite.adjusted.iter().find(|a| a.arm == source.arm);
    let (Some(stripes), Some(curves)) = (stripes, curves) else {
        return Ok(None);
    };
    let mut pairs = Vec::new();
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        for demand in DEMANDS {
            let own: Vec<f64> = curves.curves[frequency]
                .iter()
                .map(|c| capacity(Some(c), demand))
                .collect::<Result<_, _>>()?;
            let Some(reference) =
                samples(source, frequency, REFERENCE, demand)
            else {
                return Ok(None);
            };
            pairs.push(Pair {
                at: format!("p = {p}, intensity at demand {demand}"),
                own: Ranked::new(&own),
                reference: Ranked::new(reference),
            });
        }
        let scaled = &stripes.demands[position(frequency, REFERENCE)];
        let levels = stripes.adjusted[frequency].iter().zip(scaled);
        for (im, (own, reference)) in STRIPES.iter().zip(levels) {
            pairs.push(Pair {
                at: format!("p = {p}, demand at intensity {im}"),
                own: Ranked::new(own),
                reference: Ranked::new(reference),
            });
        }
    }
    Ok(Some(quantile_ratios(source, &pairs)))
}

/// Mean capacity by the median point over that by the monotone inversion,
/// mean over blocks and demands.
pub(super) fn inversion(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let Some(curves) = suite.curves(source.arm) else { return Ok(None) };
    // By cell, by record: median-point and monotone capacity.
    let mut values: Vec<Vec<(f64, f64)>> = Vec::new();
    for own in curves {
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
    let records = suite.records.len();
    let at = format!("mean over {} blocks and demands", values.len());
    Ok(Some(source.value(&at, records, move |draw| {
        let counts = draw.of(kind);
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
    })))
}

/// Capacities with Housner's restitution, stocky over slender, by way of the
/// study's: what the slenderness's own ratio does is divided out.
pub(super) fn housner(source: &Source<'_>) -> Found {
    let found = varied(source, &[Choice::Housner])?;
    let of = |slenderness| -> anyhow::Result<Option<Vec<f64>>> {
        let is =
            |v: &&Varied| v.frequency == 1 && v.slenderness == slenderness;
        let one = found.iter().find(|(v, _)| is(v));
        let Some((varied, base)) = one else { return Ok(None) };
        let pairs = varied.curves.iter().zip(*base);
        let each = pairs.map(|(own, base)| {
            Ok(capacity(own.as_ref(), 1.0)? / capacity(Some(base), 1.0)?)
        });
        each.collect::<anyhow::Result<_>>().map(Some)
    };
    let (Some(stocky), Some(slender)) = (of(4)?, of(0)?) else {
        return Ok(None);
    };
    let ranked = Ranked::new(&ratios(&stocky, &slender, 1.0));
    let kind = source.kind();
    let at = "p = 3, alpha = 0.25 over 0.05";
    let records = ranked.records();
    Ok(Some(source.value(at, records, move |draw| {
        (ranked.median(draw.of(kind)) - 1.0).abs()
    })))
}

pub(super) fn uplift(source: &Source<'_>) -> Found {
    let records = &source.results.suite(source.kind()).records;
    let stockiest = SLENDERNESSES_RAD[SLENDERNESSES_RAD.len() - 1];
    let moved = records.iter().filter(|r| r.pga_g > tan(stockiest));
    let share = Proportion::try_new(moved.count(), records.len())?;
    let cell = Cell { at: "alpha = 0.25".into(), records: records.len() };
    let measured = Replicated::counted(vec![share]);
    Ok(Some(Prepared::new(vec![cell], measured)))
}

/// Spread of the intensities at uplift in PGV, p = 1; in PGA it is 1 by
/// definition.
pub(super) fn onset(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let onsets = factors(suite, Intensity::Pgv, FREQUENCIES_RAD_S[0]);
    let ranked = Ranked::new(&onsets);
    Ok(Some(source.value("p = 1", onsets.len(), move |draw| {
        let counts = draw.of(kind);
        ranked.quantile(counts, 0.84) / ranked.quantile(counts, 0.16)
    })))
}
