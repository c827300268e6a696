//! Section 4, Figures 2 to 5: measures of records one by one.

use super::scope::{
    CellValues, MeasureCells, MeasureResult, Scope, mean_of_medians,
};
use crate::analyses::{Deviation, SuiteResults};
use crate::estimates::mean;
use crate::inference::LEAST_DECIDING;
use rocking_common::paper::{FREQUENCIES_RAD_S, SLENDERNESSES_RAD, position};
use rocking_statistics::resampling::RecordRanks;

/// Cells by frequency parameter and intensity: a distance of each record's
/// histories or peaks, mean over the slendernesses.
fn at_levels(
    suite: &SuiteResults,
    of: impl Fn(&Deviation) -> f64,
) -> Vec<CellValues> {
    let mut cells = Vec::new();
    for (single, p) in suite.single.iter().zip(FREQUENCIES_RAD_S) {
        for (im, apart) in &single.by_level {
            let each = apart.iter().map(|apart| mean(apart.iter().map(&of)));
            cells.push(CellValues {
                at: format!("p = {p}, intensity {im}"),
                values: RecordRanks::new(&each.collect::<Vec<f64>>()),
            });
        }
    }
    cells
}

/// Whether a cell has enough records to decide.
fn decides(cell: &CellValues) -> bool {
    cell.values.records() >= LEAST_DECIDING
}

/// Median distance of histories, ordinary over pulse-type, at equal
/// intensities; geometric mean over frequency parameters and intensities at
/// which enough records stand in both suites.
pub(super) fn histories(scope: &Scope<'_>) -> MeasureCells {
    let [ordinary, pulse] =
        scope.results.suites().map(|suite| at_levels(suite, |a| a.distance));
    let pairs: Vec<(CellValues, CellValues)> = ordinary
        .into_iter()
        .zip(pulse)
        .filter(|(a, b)| decides(a) && decides(b))
        .collect();
    let records = scope.results.pulse.records.len();
    let at = format!("mean over {} pairs of p and intensity", pairs.len());
    scope.contrast(&at, records, |ordinary, pulse| {
        let ratio = |(a, b): &(CellValues, CellValues)| {
            libm::log(a.values.median(ordinary) / b.values.median(pulse))
        };
        libm::exp(mean(pairs.iter().map(ratio)))
    })
}

/// Median distance of histories of one suite; mean over frequency parameters
/// and intensities at which enough records stand.
pub(super) fn history_distance(scope: &Scope<'_>) -> MeasureCells {
    let mut cells = at_levels(scope.suite(), |a| a.distance);
    cells.retain(decides);
    let at = format!("mean over {} pairs of p and intensity", cells.len());
    scope.value(&at, scope.records(), |counts| mean_of_medians(&cells, counts))
}

/// Share of the histories that are further than 5 % from the reference's.
pub(super) fn histories_apart(scope: &Scope<'_>) -> MeasureCells {
    let suite = scope.suite();
    let n = suite.records.len();
    let (mut far, mut all) = (vec![0_u32; n], vec![0_u32; n]);
    for (_, by_record) in suite.single.iter().flat_map(|s| &s.by_level) {
        for (record, apart) in by_record.iter().enumerate() {
            for a in apart.iter().filter(|a| a.distance.is_finite()) {
                all[record] += 1;
                far[record] += u32::from(a.distance > 0.05);
            }
        }
    }
    let at = format!("{} histories", all.iter().sum::<u32>());
    scope.share(&at, &far, &all)
}

/// Median difference of the peaks, cell by cell.
pub(super) fn peaks(scope: &Scope<'_>) -> MeasureCells {
    let away = |a: &Deviation| (a.peak_ratio - 1.0).abs();
    scope.medians(at_levels(scope.suite(), away))
}

/// Mean |ln| of the ratio of intensities at equal demand, by record.
fn apart_by_record(suite: &SuiteResults) -> RecordRanks {
    let of = |record: usize| {
        let apart = suite.single.iter().flat_map(|s| &s.apart[record]);
        mean(apart.map(|a| a.mean_ln_im))
    };
    RecordRanks::new(&(0..suite.records.len()).map(of).collect::<Vec<f64>>())
}

/// Distance of single curves, median over the records.
pub(super) fn curves(scope: &Scope<'_>) -> MeasureCells {
    let ranked = apart_by_record(scope.suite());
    let median = |counts: &[u32]| ranked.median(counts);
    scope.value("all blocks", ranked.records(), median)
}

/// Median distance of single curves, ordinary over pulse-type motions.
pub(super) fn curve_contrast(scope: &Scope<'_>) -> MeasureCells {
    let [a, b] = scope.results.suites().map(apart_by_record);
    scope.contrast("all blocks", b.records(), |ordinary, pulse| {
        a.median(ordinary) / b.median(pulse)
    })
}

/// Share of the stripes of a record and a frequency parameter at which some
/// of the five blocks have overturned and some have not.
pub(super) fn fates(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let n = scope.records();
    let (mut mixed, mut all) = (vec![0_u32; n], vec![0_u32; n]);
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        let first = position(frequency, 0);
        let blocks = &stripes.demands[first..][..SLENDERNESSES_RAD.len()];
        let used = blocks.iter().map(Vec::len).min().unwrap_or(0);
        for stripe in 0..used {
            for record in 0..n {
                let fell =
                    |b: &&Vec<Vec<f64>>| b[stripe][record].is_infinite();
                let fallen = blocks.iter().filter(fell).count();
                all[record] += 1;
                mixed[record] +=
                    u32::from(fallen > 0 && fallen < blocks.len());
            }
        }
    }
    Ok(scope.share("of all records, p and stripes", &mixed, &all))
}
