//! Section 4, Figures 2 to 5: measures of records one by one.

use super::capacities::mean_of_medians;
use super::{Measure, Prepared, Source};
use crate::analyses::{Apart, SuiteResults};
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
                .map(|apart| super::mean(apart.iter().map(&of)))
                .collect();
            out.push((
                format!("p = {p}, intensity {im}"),
                Ranked::new(&by_record),
            ));
        }
    }
    out
}

pub(super) fn prepare(
    source: &Source<'_>,
    measure: Measure,
) -> Option<Prepared> {
    match measure {
        Measure::HistoryDifference => Some(histories(source)),
        Measure::PeakDifference => Some(peaks(source)),
        Measure::CurveDifference => Some(curves(source)),
        _ => None,
    }
}

/// Median distance of histories, ordinary minus pulse-type, at the same
/// intensities; mean over frequency parameters and intensities at which
/// enough records stand in both suites.
fn histories(source: &Source<'_>) -> Prepared {
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
    source.value(&at, records, move |draw| {
        mean_of_medians(&ordinary, draw.of(SuiteKind::Ordinary))
            - mean_of_medians(&pulse, draw.of(SuiteKind::PulseType))
    })
}

fn peaks(source: &Source<'_>) -> Prepared {
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
    Prepared {
        cells: ranked.iter().map(cell).collect(),
        measured: source.draws.smooth(source.tested, &of),
        criterion: None,
    }
}

/// Mean |ln| of the ratio of intensities at equal demand, by record; median
/// over the records.
fn curves(source: &Source<'_>) -> Prepared {
    let kind = source.kind();
    let suite = source.results.suite(kind);
    let by_record: Vec<f64> = (0..suite.records.len())
        .map(|record| {
            let of = |single: &crate::analyses::SingleRecords| {
                single.apart[record].iter().map(|a| a.mean_ln_im).collect()
            };
            let all: Vec<Vec<f64>> = suite.single.iter().map(of).collect();
            super::mean(all.into_iter().flatten())
        })
        .collect();
    let ranked = Ranked::new(&by_record);
    let records = ranked.records();
    source
        .value("all blocks", records, move |draw| ranked.median(draw.of(kind)))
}
