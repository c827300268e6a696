use rocking_statistics::resampling::RecordRanks;

use super::*;
use rocking_common::findings::Unit;
use rocking_common::findings::{ERROR, IntervalMethod};
use rocking_common::paper::SuiteKind;
use rocking_statistics::{Clusters, Proportion};

/// Draws of suites without earthquakes.
fn drawn(sizes: [usize; 2]) -> Resamples {
    Resamples::new(sizes.map(Clusters::singletons), 1)
}

fn rule(quantifier: Quantifier, region: Region) -> ClaimRule {
    ClaimRule { quantifier, region, unit: Unit::One, range: Range::Real }
}

fn low(of: &ClaimResult) -> f64 {
    of.estimate.ends().0
}

fn high(of: &ClaimResult) -> f64 {
    of.estimate.ends().1
}

/// 80 values about 1 for each cell, and how far each cell is shifted.
fn cells(shifts: &[f64]) -> (Vec<Cell>, Vec<RecordRanks>) {
    let ranked = shifts
        .iter()
        .enumerate()
        .map(|(k, shift)| {
            let values: Vec<f64> = (0..80)
                .map(|i| {
                    let phase = f64::from(i) * (1.0 + 0.37 * k as f64);
                    1.0 + shift + 0.1 * libm::sin(phase)
                })
                .collect();
            RecordRanks::new(&values)
        })
        .collect();
    let cell = |k: usize| Cell { at: format!("cell {k}"), records: 80 };
    ((0..shifts.len()).map(cell).collect(), ranked)
}

fn judged(quantifier: Quantifier, shifts: &[f64]) -> ClaimResult {
    let draws = drawn([80, 40]);
    let (cells, ranked) = cells(shifts);
    let medians = |draw: Resample<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        ranked.iter().map(|r| r.median(counts)).collect()
    };
    let measured = draws.smooth(SuiteSet::Ordinary, &medians);
    let rule = rule(quantifier, Region::Within(0.8, 1.2));
    judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured).result
}

#[test]
fn the_quantifier_decides_how_many_cells_must_hold() {
    use ClaimVerdict::{Confirmed, Inconclusive, NotConfirmed};
    let near = [0.0, 0.02, -0.02, 0.01];
    let one_off = [0.0, 0.5, -0.02, 0.01];
    let most_off = [0.0, 0.5, 0.6, 0.7];
    let on_the_edge = [0.0, 0.2, -0.02, 0.01];
    for (quantifier, shifts, expected) in [
        (Quantifier::All, near, Confirmed),
        (Quantifier::All, one_off, NotConfirmed),
        (Quantifier::All, on_the_edge, Inconclusive),
        (Quantifier::Most, one_off, Confirmed),
        (Quantifier::Most, most_off, NotConfirmed),
        (Quantifier::AlmostAll, one_off, NotConfirmed),
        (Quantifier::AlmostAll, on_the_edge, Inconclusive),
        (Quantifier::One, near, Confirmed),
    ] {
        let found = judged(quantifier, &shifts);
        assert_eq!(
            found.by_equivalence,
            Some(expected),
            "{quantifier:?} {shifts:?}: {found:?}"
        );
        let interval = found.estimate.interval().unwrap();
        assert!(interval.holds(found.estimate.value()));
    }
}

#[test]
fn the_cell_that_is_shown_is_the_one_that_decides() {
    let found = judged(Quantifier::All, &[0.0, 0.2, -0.1]);
    assert_eq!(found.at, "cell 1");
    assert!(low(&found) < 1.2 && high(&found) > 1.2);
    // A cell of few records that is no median decides nothing.
    let draws = drawn([80, 40]);
    let (mut cells, ranked) = cells(&[0.0, 0.9]);
    cells[1].records = LEAST_DECIDING - 1;
    let medians = |draw: Resample<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        ranked.iter().map(|r| r.median(counts)).collect()
    };
    let measured = draws.smooth(SuiteSet::Ordinary, &medians);
    let rule = rule(Quantifier::All, Region::Within(0.8, 1.2));
    let found =
        judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured)
            .result;
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Confirmed));
    assert_eq!(found.cells.map(|c| c.too_few), Some(1));
}

/// Shares near 0 whose largest is above its limit by chance: the simultaneous
/// interval of the cell reaches below 0.
#[test]
fn simultaneous_ends_lie_in_the_range_of_the_quantity() {
    let draws = drawn([20, 20]);
    let names = ["a", "b", "c"].map(str::to_owned);
    let cells = names.map(|at| Cell { at, records: 80 });
    let shares = |draw: Resample<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        let share = |k: usize| f64::from(counts[k] + counts[k + 3]) / 20.0;
        (0..3).map(share).collect()
    };
    let measured = draws.smooth(SuiteSet::Ordinary, &shares);
    let judged = |range| {
        let region = Region::Below(0.09);
        let rule = ClaimRule { range, ..rule(Quantifier::All, region) };
        judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured)
            .result
    };
    let [free, limited] = [Range::Real, Range::Share].map(judged);
    assert_eq!(free.interval, Some(IntervalMethod::Simultaneous));
    assert!(low(&free) < 0.0 && high(&free) > 0.0);
    assert_eq!(limited.estimate.ends(), (0.0, high(&free)));
    assert_eq!(limited.by_equivalence, free.by_equivalence);
}

#[test]
fn suites_are_drawn_independently_and_records_jointly() {
    let draws = drawn([30, 30]);
    let both = |draw: Resample<'_>| {
        let of = |suite| f64::from(draw.of(suite)[0]);
        vec![of(SuiteKind::Ordinary), of(SuiteKind::PulseType)]
    };
    let found = draws.smooth(SuiteSet::Both, &both);
    let (mut equal, mut all) = (0, 0);
    for row in &found.replicates {
        all += 1;
        equal += usize::from(row[0] == row[1]);
    }
    // Two independent Poisson(1) counts agree in 31 % of the draws.
    assert!(
        (0.25..0.37)
            .contains(&(f64::from(equal as u32) / f64::from(all as u32)))
    );
}

#[test]
fn one_record_that_carries_a_share_keeps_it_open() {
    // The measure is 1 with record 0 and 0 without it.
    let draws = drawn([50, 40]);
    let carried =
        |draw: Resample<'_>| vec![f64::from(draw.of(SuiteKind::Ordinary)[0])];
    let measured = draws.subsampled(SuiteSet::Ordinary, &carried);
    let cells = [Cell { at: "one record".into(), records: 50 }];
    let rule = ClaimRule {
        range: Range::Share,
        ..rule(Quantifier::One, Region::Above(0.5))
    };
    let found =
        judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured)
            .result;
    assert_eq!((found.estimate.value(), low(&found)), (1.0, 0.0));
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Inconclusive));
}

/// Counts of records, judged in every cell at once.
fn counted(counts: &[(usize, usize)], quantifier: Quantifier) -> ClaimResult {
    let draws = drawn([86, 44]);
    let cell = |(k, (_, records)): (usize, &(usize, usize))| Cell {
        at: format!("cell {k}"),
        records: *records,
    };
    let cells: Vec<Cell> = counts.iter().enumerate().map(cell).collect();
    let all = counts.iter().map(|(k, n)| Proportion::try_new(*k, *n).unwrap());
    let measured = Replicates::of_counts(all.collect());
    let rule = ClaimRule {
        range: Range::Share,
        ..rule(quantifier, Region::Below(0.05))
    };
    judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured).result
}

#[test]
fn none_of_a_few_records_is_not_shown_to_be_below_a_limit() {
    // 0 of 44: the probability may be 6.6 %, one-sided; 0 of 59 decide.
    let found = counted(&[(0, 44)], Quantifier::One);
    assert_eq!(found.interval, Some(IntervalMethod::Exact));
    assert!(low(&found) == 0.0 && (high(&found) - 0.0658).abs() < 1e-4);
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Inconclusive));
    let power = found.power.unwrap();
    assert_eq!(power.probability, 0.0);
    assert!((power.times - 59.0 / 44.0).abs() < 0.02, "{power:?}");
    // One of many cells, each with the same limit.
    let many = counted(&[(0, 44); 180], Quantifier::All);
    assert!((high(&many) - 0.0658).abs() < 1e-4, "{many:?}");
    assert_eq!(many.by_equivalence, Some(ClaimVerdict::Inconclusive));
    assert_eq!(many.cells.map(|c| (c.inside, c.outside)), Some((0, 0)));
    // 0 of 86 is below 5 %, alone and in every one of many cells.
    let alone = counted(&[(0, 86)], Quantifier::One);
    assert_eq!(alone.by_equivalence, Some(ClaimVerdict::Confirmed));
    let many = counted(&[(0, 86); 240], Quantifier::All);
    assert_eq!(many.by_equivalence, Some(ClaimVerdict::Confirmed));
}

#[test]
fn a_count_far_above_a_limit_is_seen_among_many_cells() {
    for above in [16, 19] {
        let mut counts = vec![(0, 86); 239];
        counts.push((above, 86));
        let found = counted(&counts, Quantifier::All);
        assert_eq!(found.by_equivalence, Some(ClaimVerdict::NotConfirmed));
        assert_eq!(found.interval, Some(IntervalMethod::ExactSimultaneous));
        assert_eq!(found.at, "cell 239");
        assert!(low(&found) > 0.05, "{}", low(&found));
    }
    // 19 of 86, one of 240: scipy.stats.beta.ppf(0.05/240, 19, 68).
    let mut counts = vec![(0, 86); 239];
    counts.push((19, 86));
    let found = counted(&counts, Quantifier::All);
    assert!((low(&found) - 0.0904).abs() < 1e-4, "{}", low(&found));
    assert_eq!(found.cells.map(|c| (c.inside, c.outside)), Some((239, 1)));
    // 7 of 44, one of 180, may lie below 5 %.
    let mut counts = vec![(0, 86); 179];
    counts.push((7, 44));
    let found = counted(&counts, Quantifier::All);
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Inconclusive));
}

/// Medians of a few values each, judged as cells of a suite of 86.
fn few(samples: &[Vec<f64>], region: Region) -> ClaimResult {
    let draws = drawn([86, 44]);
    let mut all = Vec::new();
    let mut cells = Vec::new();
    for (k, sample) in samples.iter().enumerate() {
        let mut values = sample.clone();
        values.resize(86, f64::NAN);
        all.push(RecordRanks::new(&values));
        cells.push(Cell { at: format!("cell {k}"), records: sample.len() });
    }
    let measured = draws.medians(SuiteKind::Ordinary, all);
    let rule = rule(Quantifier::All, region);
    judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured).result
}

#[test]
fn few_records_have_the_exact_interval_of_their_median() {
    let values = |n: usize| (0..n).map(|i| 1.0 + 1e-3 * i as f64).collect();
    let region = Region::Within(0.95, 1.05);
    // 90 %: the second of eleven to the last but one would be 98.8 %, the
    // third 93.5 %.
    let found = few(&[values(11)], region);
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Confirmed));
    assert_eq!(found.interval, Some(IntervalMethod::Exact));
    assert_eq!(found.estimate.ends(), (1.002, 1.008));
    assert_eq!(found.at, "cell 0, of the 11 survivors");
    // The range of four values holds the median in 87.5 %: no interval.
    let found = few(&[values(4)], region);
    assert_eq!(found.by_equivalence, None);
    assert_eq!(found.cells.map(|c| (c.deciding, c.too_few)), Some((0, 1)));
}

#[test]
fn a_share_of_cells_is_judged_by_its_own_interval() {
    // 80 cells with their median at 1, 10 far away: 89 %.
    let near = |k: usize| if k < 80 { 0.002 * (k % 7) as f64 } else { 0.9 };
    let shifts: Vec<f64> = (0..90).map(near).collect();
    let found = judged(Quantifier::AlmostAll, &shifts);
    assert_eq!(found.interval, Some(IntervalMethod::ShareOfCells));
    assert!((found.estimate.value() - 80.0 / 90.0).abs() < 1e-12);
    assert_eq!(found.estimate.ends(), (80.0 / 90.0, 80.0 / 90.0));
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::NotConfirmed));
    assert_eq!(found.cells.map(|c| (c.inside, c.outside)), Some((80, 10)));
    // Ten on the edge: the share may be 100 %.
    let near = |k: usize| if k < 80 { 0.002 * (k % 7) as f64 } else { 0.2 };
    let shifts: Vec<f64> = (0..90).map(near).collect();
    let found = judged(Quantifier::AlmostAll, &shifts);
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Inconclusive));
    assert!(low(&found) < 0.95 && high(&found) > 0.95, "{found:?}");
}

#[test]
fn a_replicate_without_a_value_lies_outside() {
    // Two records carry cell 0: a replicate that draws none of them leaves
    // it without a value.
    let draws = drawn([40, 40]);
    let of = |draw: Resample<'_>| {
        let counts = draw.of(SuiteKind::Ordinary);
        let carried: u32 = counts[..2].iter().sum();
        let value = if carried > 0 { 1.0 } else { f64::NAN };
        vec![value, 1.0 + 1e-3 * f64::from(counts[39])]
    };
    let measured = draws.smooth(SuiteSet::Ordinary, &of);
    let cell = |k| Cell { at: format!("cell {k}"), records: 40 };
    let rule = rule(Quantifier::AlmostAll, Region::Within(0.9, 1.1));
    let cells = [cell(0), cell(1)];
    let found =
        judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured)
            .result;
    // (38/40)^40 = 13 % of the replicates: one of two cells is inside.
    assert_eq!(found.estimate.value(), 1.0);
    assert_eq!(found.estimate.ends(), (0.5, 1.0));
    assert_eq!(found.cells.map(|c| c.inside), Some(1));
}

#[test]
fn records_of_an_earthquake_are_drawn_together() {
    let labels = (0..40).map(|record| (record / 10).to_string());
    let clusters = Clusters::from_labels(labels);
    let draws = Resamples::new([clusters, Clusters::singletons(40)], 1);
    let first = |draw: Resample<'_>| {
        let counts = draw.of(SuiteKind::Ordinary);
        assert_eq!(counts[..9], counts[1..10]);
        vec![f64::from(counts[0])]
    };
    let found = draws.smooth(SuiteSet::Ordinary, &first);
    assert_eq!(found.replicates.len(), REPLICATES);
    // Each earthquake is left out once.
    assert_eq!(Replicates::column(&found.without_one, 0), [0., 1., 1., 1.]);
    let subsampled = draws.subsampled(SuiteSet::Ordinary, &first);
    assert_eq!(subsampled.replicates.len(), SUBSAMPLES);
}

#[test]
fn a_verdict_that_other_draws_may_change_is_none() {
    // A mean of 80 values whose interval ends next to the limit.
    let draws = drawn([80, 40]);
    let values: Vec<f64> =
        (0..80).map(|i| libm::sin(f64::from(i) * 1.37)).collect();
    let mean = |draw: Resample<'_>| {
        let counts = draw.of(SuiteKind::Ordinary);
        let pairs = values.iter().zip(counts);
        vec![pairs.fold(0.0, |sum, (x, n)| sum + x * f64::from(*n)) / 80.0]
    };
    let measured = draws.smooth(SuiteSet::Ordinary, &mean);
    let cells = [Cell { at: "mean".into(), records: 80 }];
    let judged = |limit| {
        let rule = rule(Quantifier::One, Region::Below(limit));
        judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured)
    };
    let Ruling { result, more } = judged(1.0);
    assert!(!more);
    let (end, error) = (high(&result), result.monte_carlo_error);
    assert!(error > 0.0 && error < 0.2 * (end - result.estimate.value()));
    // Eight times as many draws have errors 2.8 times as small.
    for (away, decides, draws_more) in [
        (5.0, true, false),
        (3.0, false, true),
        (1.0, false, false),
        (-3.0, false, true),
        (-5.0, false, false),
    ] {
        let Ruling { result, more } = judged(end + away * error);
        assert_eq!(more, draws_more, "{away}");
        let decided = result.by_equivalence == Some(ClaimVerdict::Confirmed);
        assert_eq!(decided, decides, "{away}");
    }
    // The p-value belongs to the one-sided test at the limit: four errors
    // beyond an end of 5 % it is a little smaller.
    let beyond = judged(end + 4.001 * error).result.p;
    assert!((0.02..0.05).contains(&beyond), "{beyond}");
}

#[test]
fn a_verdict_and_its_p_value_agree() {
    use Quantifier::{All, AlmostAll, Most, One};
    let mut open = 0;
    for quantifier in [One, All, AlmostAll, Most] {
        for step in 0..60 {
            // One cell moves across the limit at 1.2.
            let shift = 0.1 + 0.004 * f64::from(step);
            let found = judged(quantifier, &[shift, 0.01, -0.02]);
            let verdict = found.by_equivalence.unwrap();
            let decided = verdict != ClaimVerdict::Inconclusive;
            assert_eq!(decided, found.p <= ERROR, "{shift}: {found:?}");
            assert_eq!(found.power.is_none(), decided);
            open += usize::from(!decided);
            let side =
                Region::Within(0.8, 1.2).verdict(low(&found), high(&found));
            if matches!(quantifier, One | All) && decided {
                assert_eq!(side, verdict, "{shift}: {found:?}");
            }
        }
    }
    assert!((20..200).contains(&open), "{open}");
}

#[test]
fn power_says_whether_width_is_what_keeps_a_result_open() {
    let of = |shift: f64| judged(Quantifier::One, &[shift]).power;
    // Far from the limit it is decided; near it more records are needed the
    // nearer it is.
    assert!(of(0.0).is_none());
    let found = [0.19, 0.195, 0.1995].map(|shift| of(shift).unwrap());
    for pair in found.windows(2) {
        assert!(pair[0].probability >= pair[1].probability, "{found:?}");
        assert!(pair[0].times <= pair[1].times, "{found:?}");
    }
    assert!(found.iter().all(|power| power.probability < 0.6));
    assert!(found[0].times > 1.0 && found[2].times.is_infinite());
}

#[test]
fn a_cell_that_no_replicate_moves_is_open() {
    // All records have the value 1: the bootstrap knows no error.
    let draws = drawn([80, 40]);
    let (cells, ranked) = cells(&[0.0, 0.2]);
    let constant = RecordRanks::new(&[1.0; 80]);
    let medians = |draw: Resample<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        vec![constant.median(counts), ranked[1].median(counts)]
    };
    let measured = draws.smooth(SuiteSet::Ordinary, &medians);
    let rule = rule(Quantifier::All, Region::Within(0.8, 1.2));
    let found =
        judge(&draws, SuiteSet::Ordinary, None, &rule, &cells, &measured)
            .result;
    assert_eq!(found.cells.map(|c| c.inside), Some(0));
    assert_eq!(found.by_equivalence, Some(ClaimVerdict::Inconclusive));
    // The cell that is shown has an interval.
    assert_eq!(found.at, "cell 1");
    assert!(low(&found).is_finite() && high(&found).is_finite());
}
