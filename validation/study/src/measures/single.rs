//! Section 4, Figures 2 to 5: measures of records one by one.

use super::source::{Found, Prepared, Source, mean_of_medians};
use crate::analyses::{Apart, SuiteResults};
use crate::estimates::mean;
use crate::inference::{Cell, LEAST_DECIDING};
use crate::stripes::of_arm;
use rocking_common::paper::{
    FREQUENCIES_RAD_S, SLENDERNESSES_RAD, SuiteKind, position,
};
use rocking_statistics::resampling::Ranked;

/// A frequency parameter at an intensity: what a record's histories or peaks
/// differ by, mean over the slendernesses.
fn at_levels(
    suite: &SuiteResults,
    of: impl Fn(&Apart) -> f64,
) -> Vec<(String, Ranked)> {
    let mut out = Vec::new();
    for (single, p) in suite.single.iter().zip(FREQUENCIES_RAD_S) {
        for (im, apart) in &single.by_level {
            let by_record: Vec<f64> = apart
                .iter()
                .map(|apart| mean(apart.iter().map(&of)))
                .collect();
            out.push((
                format!("p = {p}, intensity {im}"),
                Ranked::new(&by_record),
            ));
        }
    }
    out
}

/// Cells that have enough records to decide.
fn deciding(cells: &[(String, Ranked)]) -> Vec<Ranked> {
    let enough = |r: &&Ranked| r.records() >= LEAST_DECIDING;
    cells.iter().map(|(_, r)| r).filter(enough).cloned().collect()
}

/// Median distance of histories, ordinary over pulse-type, at the same
/// intensities; geometric mean over frequency parameters and intensities at
/// which enough records stand in both suites.
pub(super) fn histories(source: &Source<'_>) -> Found {
    let [ordinary, pulse] = SuiteKind::ALL
        .map(|kind| at_levels(source.results.suite(kind), |a| a.distance));
    let pairs: Vec<(Ranked, Ranked)> = ordinary
        .into_iter()
        .zip(pulse)
        .map(|((_, a), (_, b))| (a, b))
        .filter(|(a, b)| {
            a.records() >= LEAST_DECIDING && b.records() >= LEAST_DECIDING
        })
        .collect();
    let records = source.results.pulse.records.len();
    let at = format!("mean over {} pairs of p and intensity", pairs.len());
    Ok(Some(source.value(&at, records, move |draw| {
        let ratio = |(ordinary, pulse): &(Ranked, Ranked)| {
            libm::log(
                ordinary.median(draw.of(SuiteKind::Ordinary))
                    / pulse.median(draw.of(SuiteKind::PulseType)),
            )
        };
        libm::exp(mean(pairs.iter().map(ratio)))
    })))
}

/// Median distance of histories of one suite; mean over frequency parameters
/// and intensities at which enough records stand.
pub(super) fn history_distance(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let ranked = deciding(&at_levels(suite, |a| a.distance));
    let at = format!("mean over {} pairs of p and intensity", ranked.len());
    let records = suite.records.len();
    Ok(Some(source.value(&at, records, move |draw| {
        mean_of_medians(&ranked, draw.of(kind))
    })))
}

/// Share of the histories that are further than 5 % from that of the
/// reference.
pub(super) fn histories_apart(source: &Source<'_>) -> Found {
    let suite = source.results.suite(source.kind());
    let n = suite.records.len();
    let (mut far, mut all) = (vec![0_u32; n], vec![0_u32; n]);
    for (_, by_record) in suite.single.iter().flat_map(|s| &s.by_level) {
        for (record, apart) in by_record.iter().enumerate() {
            let there = apart.iter().filter(|a| a.distance.is_finite());
            for a in there {
                all[record] += 1;
                far[record] += u32::from(a.distance > 0.05);
            }
        }
    }
    let at = format!("{} histories", all.iter().sum::<u32>());
    Ok(Some(source.share(&at, far, all)))
}

pub(super) fn peaks(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let (cells, ranked) = at_levels(suite, |a| (a.peak_ratio - 1.0).abs())
        .into_iter()
        .map(|(at, r)| (Cell { at, records: r.records() }, r))
        .unzip();
    let measured = source.draws.medians(kind, ranked);
    Ok(Some(Prepared::new(cells, measured)))
}

/// Mean |ln| of the ratio of intensities at equal demand, by record.
fn apart_by_record(suite: &SuiteResults) -> Ranked {
    let by_record: Vec<f64> = (0..suite.records.len())
        .map(|record| {
            let of = |single: &crate::analyses::SingleRecords| {
                single.apart[record].iter().map(|a| a.mean_ln_im).collect()
            };
            let all: Vec<Vec<f64>> = suite.single.iter().map(of).collect();
            mean(all.into_iter().flatten())
        })
        .collect();
    Ranked::new(&by_record)
}

/// Distance of single curves, median over the records.
pub(super) fn curves(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let ranked = apart_by_record(source.results.suite(kind));
    let records = ranked.records();
    Ok(Some(source.value("all blocks", records, move |draw| {
        ranked.median(draw.of(kind))
    })))
}

/// That median of ordinary over that of pulse-type motions.
pub(super) fn curve_contrast(source: &Source<'_>) -> Found {
    let [ordinary, pulse] =
        SuiteKind::ALL.map(|kind| apart_by_record(source.results.suite(kind)));
    let records = pulse.records();
    Ok(Some(source.value("all blocks", records, move |draw| {
        ordinary.median(draw.of(SuiteKind::Ordinary))
            / pulse.median(draw.of(SuiteKind::PulseType))
    })))
}

/// Share of the stripes of a record and a frequency parameter at which some
/// of the five blocks have overturned and some have not.
pub(super) fn fates(source: &Source<'_>) -> Found {
    let suite = source.results.suite(source.kind());
    let Some(stripes) = of_arm(suite, source.arm) else { return Ok(None) };
    let n = suite.records.len();
    let (mut mixed, mut all) = (vec![0_u32; n], vec![0_u32; n]);
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        let blocks: Vec<&Vec<Vec<f64>>> = (0..SLENDERNESSES_RAD.len())
            .map(|s| &stripes.demands[position(frequency, s)])
            .collect();
        let used = blocks.iter().map(|b| b.len()).min().unwrap_or(0);
        for stripe in 0..used {
            for record in 0..n {
                let fell =
                    |b: &&&Vec<Vec<f64>>| b[stripe][record].is_infinite();
                let fallen = blocks.iter().filter(fell).count();
                all[record] += 1;
                mixed[record] +=
                    u32::from(fallen > 0 && fallen < blocks.len());
            }
        }
    }
    let at = "of all records, p and stripes";
    Ok(Some(source.share(at, mixed, all)))
}
