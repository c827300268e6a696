use rocking::statistics::resampling::Ranked;

use super::*;
use rocking::statistics::Proportion;
use rocking_common::paper::SuiteKind;

fn rule(quantifier: Quantifier, region: Region) -> Rule {
    let range = (f64::NEG_INFINITY, f64::INFINITY);
    Rule { quantifier, region, unit: Unit::One, range }
}

/// 80 values about 1 for each cell, and how far each cell is shifted.
fn cells(shifts: &[f64]) -> (Vec<Cell>, Vec<Ranked>) {
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
            Ranked::new(&values)
        })
        .collect();
    let cell = |k: usize| Cell { at: format!("cell {k}"), records: 80 };
    ((0..shifts.len()).map(cell).collect(), ranked)
}

fn judged(quantifier: Quantifier, shifts: &[f64]) -> ClaimResult {
    let draws = Draws::new([80, 40]);
    let (cells, ranked) = cells(shifts);
    let medians = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        ranked.iter().map(|r| r.median(counts)).collect()
    };
    let measured = draws.smooth(Tested::Ordinary, &medians);
    let rule = rule(quantifier, Region::Within(0.8, 1.2));
    judge(&draws, Tested::Ordinary, None, &rule, &cells, &measured)
}

#[test]
fn the_quantifier_decides_how_many_cells_must_hold() {
    use Verdict::{Confirmed, Inconclusive, NotConfirmed};
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
        assert!(found.low <= found.value && found.value <= found.high);
    }
}

#[test]
fn the_cell_that_is_shown_is_the_one_that_decides() {
    let found = judged(Quantifier::All, &[0.0, 0.2, -0.1]);
    assert_eq!(found.at, "cell 1");
    assert!(found.low < 1.2 && found.high > 1.2);
    assert!(found.records_needed.is_none_or(|n| n > 80));
    // A cell with few records is shown and decides nothing.
    let draws = Draws::new([80, 40]);
    let (mut cells, ranked) = cells(&[0.0, 0.9]);
    cells[1].records = LEAST_DECIDING - 1;
    let medians = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        ranked.iter().map(|r| r.median(counts)).collect()
    };
    let measured = draws.smooth(Tested::Ordinary, &medians);
    let rule = rule(Quantifier::All, Region::Within(0.8, 1.2));
    let found =
        judge(&draws, Tested::Ordinary, None, &rule, &cells, &measured);
    assert_eq!(found.by_equivalence, Some(Verdict::Confirmed));
    assert_eq!(found.cells.map(|c| c.too_few), Some(1));
}

#[test]
fn suites_are_drawn_independently_and_records_jointly() {
    let draws = Draws::new([30, 30]);
    let both = |draw: Draw<'_>| {
        let of = |suite| f64::from(draw.of(suite)[0]);
        vec![of(SuiteKind::Ordinary), of(SuiteKind::PulseType)]
    };
    let found = draws.smooth(Tested::Both, &both);
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
    let draws = Draws::new([50, 40]);
    let carried =
        |draw: Draw<'_>| vec![f64::from(draw.of(SuiteKind::Ordinary)[0])];
    let measured = draws.subsampled(Tested::Ordinary, &carried);
    let cells = [Cell { at: "one record".into(), records: 50 }];
    let rule = Rule {
        range: (0.0, 1.0),
        ..rule(Quantifier::One, Region::Above(0.5))
    };
    let found =
        judge(&draws, Tested::Ordinary, None, &rule, &cells, &measured);
    assert_eq!((found.value, found.low), (1.0, 0.0));
    assert_eq!(found.by_equivalence, Some(Verdict::Inconclusive));
}

/// Counts of records, judged in every cell at once.
fn counted(counts: &[(usize, usize)], quantifier: Quantifier) -> ClaimResult {
    let draws = Draws::new([86, 44]);
    let cell = |(k, (_, records)): (usize, &(usize, usize))| Cell {
        at: format!("cell {k}"),
        records: *records,
    };
    let cells: Vec<Cell> = counts.iter().enumerate().map(cell).collect();
    let all = counts.iter().map(|(k, n)| Proportion::try_new(*k, *n).unwrap());
    let measured = Replicated::counted(all.collect());
    let rule =
        Rule { range: (0.0, 1.0), ..rule(quantifier, Region::Below(0.05)) };
    judge(&draws, Tested::Ordinary, None, &rule, &cells, &measured)
}

#[test]
fn none_of_a_few_records_is_not_shown_to_be_below_a_limit() {
    // 0 of 44: the probability may be 8 %.
    let found = counted(&[(0, 44)], Quantifier::One);
    assert_eq!(found.interval, Some(Interval::Exact));
    assert!(found.low == 0.0 && (found.high - 0.0804).abs() < 1e-4);
    assert_eq!(found.by_equivalence, Some(Verdict::Inconclusive));
    assert_eq!(found.records_needed, None);
    // 0 of 86 is below 5 % alone, and not with 240 others at once.
    let alone = counted(&[(0, 86)], Quantifier::One);
    assert_eq!(alone.by_equivalence, Some(Verdict::Confirmed));
    let many = counted(&[(0, 86); 240], Quantifier::All);
    assert_eq!(many.interval, Some(Interval::ExactSimultaneous));
    assert_eq!(many.by_equivalence, Some(Verdict::Inconclusive));
    assert_eq!(many.cells.map(|c| (c.inside, c.outside)), Some((0, 0)));
}

#[test]
fn a_count_far_above_a_limit_is_seen_among_many_cells() {
    for above in [16, 19] {
        let mut counts = vec![(0, 86); 239];
        counts.push((above, 86));
        let found = counted(&counts, Quantifier::All);
        assert_eq!(found.by_equivalence, Some(Verdict::NotConfirmed));
        assert_eq!(found.at, "cell 239");
        assert!(found.low > 0.05, "{}", found.low);
    }
}

#[test]
fn a_cell_that_no_replicate_moves_is_open() {
    // All records have the value 1: the bootstrap knows no error.
    let draws = Draws::new([80, 40]);
    let (cells, ranked) = cells(&[0.0, 0.2]);
    let constant = Ranked::new(&[1.0; 80]);
    let medians = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(SuiteKind::Ordinary);
        vec![constant.median(counts), ranked[1].median(counts)]
    };
    let measured = draws.smooth(Tested::Ordinary, &medians);
    let rule = rule(Quantifier::All, Region::Within(0.8, 1.2));
    let found =
        judge(&draws, Tested::Ordinary, None, &rule, &cells, &measured);
    assert_eq!(found.cells.map(|c| c.inside), Some(0));
    assert_eq!(found.by_equivalence, Some(Verdict::Inconclusive));
    // The cell that is shown has an interval.
    assert_eq!(found.at, "cell 1");
    assert!(found.low.is_finite() && found.high.is_finite());
}
