//! Section 4, Figures 2 to 5: measures of single records.

use super::scope::{
    COINCIDE, MeasureResult, Measured, Scope, Tally, geometric_mean,
};
use crate::analyses::{Deviation, SingleRecords};
use crate::estimates::mean;
use crate::inference::{Resample, least_counted};
use rocking_common::findings::SampleCount;
use rocking_common::paper::{FREQUENCIES_RAD_S, SLENDERNESSES_RAD, SuiteKind};
use rocking_common::words::rounded_text;
use rocking_statistics::resampling::RecordRanks;

/// A number of the deviations of each record, mean over the slendernesses.
fn by_record(
    apart: &[Vec<Deviation>],
    of: impl Fn(&Deviation) -> f64,
) -> RecordRanks {
    let each = apart.iter().map(|apart| mean(apart.iter().map(&of)));
    RecordRanks::new(&each.collect::<Vec<f64>>())
}

/// Histories further than a distance from the reference's.
fn further(scope: &Scope<'_>, than: f64) -> Tally {
    let mut tally = Tally::new(scope.records());
    for single in &scope.suite().single {
        for (record, apart) in single.apart.iter().enumerate() {
            for a in apart.iter().filter(|a| a.distance.is_finite()) {
                tally.add(record, a.distance > than);
            }
        }
    }
    tally
}

/// Histories further than this from the reference's are not the same.
const SAME: f64 = 0.05;

/// Share of the histories of Figure 2 that are further than 5 % from the
/// reference's.
pub(super) fn histories_apart(scope: &Scope<'_>) -> Measured {
    let far = further(scope, SAME);
    Measured::new([far.count()], far.share(scope), levels(scope))
}

/// The intensities of Figures 2 and 3.
fn levels(scope: &Scope<'_>) -> String {
    let of = |(p, single): (f64, &SingleRecords)| {
        format!("{} for p = {p}", rounded_text(single.im))
    };
    let all = FREQUENCIES_RAD_S.into_iter().zip(&scope.suite().single);
    let all: Vec<String> = all.map(of).collect();
    format!("PGA/(g tan alpha) = {}", all.join(", "))
}

/// Median distance of histories of Figure 3; mean over frequency parameters.
pub(super) fn history_distance(scope: &Scope<'_>) -> Measured {
    let (not_close, n) = further(scope, COINCIDE).totals();
    let counts =
        [SampleCount::of(n - not_close, n), further(scope, SAME).count()];
    let single = &scope.suite().single;
    let cells: Vec<RecordRanks> =
        single.iter().map(|s| by_record(&s.apart, |a| a.distance)).collect();
    let effect = scope.one(|c| mean(cells.iter().map(|own| own.median(c))));
    Measured::new(counts, effect, levels(scope))
}

/// Differences of peaks over distances of histories at the intensities of
/// Figures 2 and 3, by frequency parameter.
pub(super) fn peaks(scope: &Scope<'_>) -> Measured {
    let both = scope.suite().single.iter().map(|single| {
        let away = |a: &Deviation| (a.peak_ratio - 1.0).abs();
        let of_histories = by_record(&single.apart, |a| a.distance);
        [by_record(&single.apart, away), of_histories]
    });
    let both: Vec<[RecordRanks; 2]> = both.collect();
    let ratios = |counts: &[u32]| -> Vec<f64> {
        let ratio = |[peaks, histories]: &[RecordRanks; 2]| {
            peaks.median(counts) / histories.median(counts)
        };
        both.iter().map(ratio).collect()
    };
    let counts =
        [SampleCount::among(ratios(scope.every()), |ratio| ratio < 1.0)];
    let effect = scope.one(|counts| geometric_mean(ratios(counts)));
    Measured::new(counts, effect, levels(scope))
}

/// Median distance of histories, ordinary over pulse-type, at equal
/// intensities; geometric mean over frequency parameters and intensities at
/// which enough records stand in both suites.
pub(super) fn histories(scope: &Scope<'_>) -> Measured {
    let [ordinary, pulse] = scope.results.suites().map(|suite| {
        let levels = suite.single.iter().flat_map(|s| &s.by_level);
        let ranks = levels.map(|apart| by_record(apart, |a| a.distance));
        let least = least_counted(suite.records.len());
        ranks.map(move |own| (own.records() >= least).then_some(own))
    });
    let pairs = ordinary.zip(pulse).filter_map(|(a, b)| Some((a?, b?)));
    let pairs: Vec<(RecordRanks, RecordRanks)> = pairs.collect();
    let ratios = |draw: Resample<'_>| -> Vec<f64> {
        let [ordinary, pulse] = SuiteKind::ALL.map(|kind| draw.of(kind));
        let pairs = pairs.iter();
        pairs.map(|(a, b)| a.median(ordinary) / b.median(pulse)).collect()
    };
    let found = ratios(scope.draws.whole());
    let counts = [SampleCount::among(found, |ratio| ratio > 1.0)];
    let effect = |draw: Resample<'_>| vec![geometric_mean(ratios(draw))];
    let effect = scope.draws.smooth(scope.tested, &effect);
    Measured::new(counts, effect, "pairs of p and intensity that count")
}

/// Distance of single curves, the mean |ln| of the ratio of intensities at equal
/// demand: median over the records.
pub(super) fn curves(scope: &Scope<'_>) -> Measured {
    let suite = scope.suite();
    let of = |record: usize| {
        let apart = suite.single.iter().flat_map(|s| &s.apart[record]);
        mean(apart.map(|a| a.mean_ln_im))
    };
    let each: Vec<f64> = (0..suite.records.len()).map(of).collect();
    let ranked = RecordRanks::new(&each);
    let each = ranked.each().map(|(x, _)| x);
    let counts =
        [SampleCount::among(each, |x| x <= libm::log(1.0 + COINCIDE))];
    let effect = scope.one(|counts| ranked.median(counts));
    Measured::new(counts, effect, "all blocks")
}

/// Share of the stripes of a record and a frequency parameter at which some
/// of the five blocks have overturned and some have not.
pub(super) fn fates(scope: &Scope<'_>) -> MeasureResult {
    let stripes = scope.stripes()?;
    let mut mixed = Tally::new(scope.records());
    for blocks in stripes.demands.chunks(SLENDERNESSES_RAD.len()) {
        let used = blocks.iter().map(Vec::len).min().unwrap_or(0);
        for stripe in 0..used {
            for record in 0..scope.records() {
                let fell =
                    |b: &&Vec<Vec<f64>>| b[stripe][record].is_infinite();
                let fallen = blocks.iter().filter(fell).count();
                mixed.add(record, fallen > 0 && fallen < blocks.len());
            }
        }
    }
    let share = mixed.share(scope);
    Ok(Measured::new([mixed.count()], share, "all records, p and stripes"))
}
