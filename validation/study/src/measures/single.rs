//! Section 4, Figures 2 to 5: measures of records one by one.

use super::source::{Found, Prepared, Source, mean_of_medians};
use crate::analyses::{Apart, SuiteResults};
use crate::estimates::mean;
use crate::inference::{Cell, Draw, LEAST_DECIDING};
use rocking::statistics::resampling::Ranked;
use rocking_common::paper::{FREQUENCIES_RAD_S, SuiteKind};

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

/// Median distance of histories, ordinary minus pulse-type, at the same
/// intensities; mean over frequency parameters and intensities at which
/// enough records stand in both suites.
pub(super) fn histories(source: &Source<'_>) -> Found {
    let [ordinary, pulse] = SuiteKind::BOTH
        .map(|kind| at_levels(source.results.suite(kind), |a| a.distance));
    let (ordinary, pulse): (Vec<Ranked>, Vec<Ranked>) = ordinary
        .into_iter()
        .zip(pulse)
        .map(|((_, a), (_, b))| (a, b))
        .filter(|(a, b)| {
            a.records() >= LEAST_DECIDING && b.records() >= LEAST_DECIDING
        })
        .unzip();
    let records = source.results.pulse.records.len();
    let at = format!("mean over {} pairs of p and intensity", pulse.len());
    Ok(Some(source.value(&at, records, move |draw| {
        mean_of_medians(&ordinary, draw.of(SuiteKind::Ordinary))
            - mean_of_medians(&pulse, draw.of(SuiteKind::PulseType))
    })))
}

pub(super) fn peaks(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let ranked = at_levels(suite, |a| (a.peak_ratio - 1.0).abs());
    let of = |draw: Draw<'_>| -> Vec<f64> {
        ranked.iter().map(|(_, r)| r.median(draw.of(kind))).collect()
    };
    let cell = |(at, r): &(String, Ranked)| Cell {
        at: at.clone(),
        records: r.records(),
    };
    Ok(Some(Prepared {
        cells: ranked.iter().map(cell).collect(),
        measured: source.draws.smooth(source.tested, &of),
        criterion: None,
    }))
}

/// Mean |ln| of the ratio of intensities at equal demand, by record; median
/// over the records.
pub(super) fn curves(source: &Source<'_>) -> Found {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let by_record: Vec<f64> = (0..suite.records.len())
        .map(|record| {
            let of = |single: &crate::analyses::SingleRecords| {
                single.apart[record].iter().map(|a| a.mean_ln_im).collect()
            };
            let all: Vec<Vec<f64>> = suite.single.iter().map(of).collect();
            mean(all.into_iter().flatten())
        })
        .collect();
    let ranked = Ranked::new(&by_record);
    let records = ranked.records();
    Ok(Some(source.value("all blocks", records, move |draw| {
        ranked.median(draw.of(kind))
    })))
}
