use super::*;
use crate::ExtendedSample;

fn statistic(values: &[f64]) -> Statistic {
    Statistic::try_new(&Sample::try_new(values).unwrap()).unwrap()
}

#[test]
fn refuses_what_it_cannot_test() {
    let refused = |values: &[f64]| {
        Statistic::try_new(&Sample::try_new(values).unwrap()).unwrap_err()
    };
    let few = refused(&[1.0, 2.0]).to_string();
    assert_eq!(few, "2 values: expected at least 3");
    assert_eq!(refused(&[5.0; 8]), LillieforsError::Degenerate);
}

#[test]
fn squares_may_overflow_and_underflow() {
    let values = [1.0, 2.0, 4.0, 7.0, 7.5];
    let expected = statistic(&values).d;
    for unit in [1e-200, 1e200] {
        let d = statistic(&values.map(|x| unit * x)).d;
        assert!((d - expected).abs() < 1e-12, "{unit}: {d}");
    }
}

#[test]
fn a_null_distribution_holds_for_its_own_size() {
    let values: Vec<f64> = (1..=30).map(f64::from).collect();
    let sample = ExtendedSample::try_new(&values).unwrap();
    let null = NullDistribution::simulate(20, 1000, 0).unwrap();
    let null = Null::Simulated(&null);
    let found = LillieforsTest::new(&sample, Scale::Linear, 0.05, null);
    let size = LillieforsError::Size { found: 30, expected: 20 };
    assert_eq!(found.verdict, Err(Inapplicable::Test(size)));
}

#[test]
fn three_values_have_a_statistic_and_no_test() {
    // NIST's NumAcc1: three equally spaced values, the least D possible,
    // 1/3 - Phi(-1) by 15 digits of Phi.
    let d = statistic(&[10_000_001.0, 10_000_003.0, 10_000_002.0]).d;
    assert!((d - 0.174_678_079_401_876).abs() < 1e-14, "{d}");
    let table = LillieforsTable::embedded();
    assert_eq!(
        table.p_value(3, d),
        Err(LillieforsError::TooFew { found: 3, least: 4 })
    );
    assert_eq!(
        NullDistribution::simulate(3, 1000, 0).unwrap_err(),
        LillieforsError::TooFew { found: 3, least: 4 }
    );
}

#[test]
fn mirrored_samples_exchange_the_sides() {
    let values = [0.3, 0.9, 1.0, 1.4, 4.0, 9.0];
    let mirrored = values.map(|x| -x);
    let (a, b) = (statistic(&values), statistic(&mirrored));
    assert!((a.d_plus - b.d_minus).abs() < 1e-15);
    assert!((a.d_minus - b.d_plus).abs() < 1e-15);
    assert!((a.d_plus - a.d_minus).abs() > 0.01);
    assert!((a.d - b.d).abs() < 1e-15);
}

#[test]
fn table_is_complete_and_falls_with_size_and_level() {
    let table = LillieforsTable::embedded();
    for (n, _) in LillieforsTable::sizes() {
        let values = LillieforsTable::LEVELS
            .map(|level| table.critical_value(n, level).unwrap().0);
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{n}");
        assert!(values[31] < Statistic::largest(n), "{n}");
    }
    let at = |n| table.critical_value(n, 0.05).unwrap().0;
    assert!((5..=1100).all(|n| at(n) < at(n - 1)));
    assert!(table.critical_value(3, 0.05).is_err());
    assert!(table.critical_value(86, 1e-5).is_err());
}

#[test]
fn p_values_invert_the_table_and_end_at_the_largest_statistic() {
    let table = LillieforsTable::embedded();
    for n in [4, 12, 44, 86, 250, 777] {
        for level in LillieforsTable::LEVELS {
            let (value, _) = table.critical_value(n, level).unwrap();
            let p = table.p_value(n, value).unwrap().estimate;
            assert!((p.value() / level - 1.0).abs() < 1e-9, "{n}, {level}");
            assert!(p.interval().unwrap().holds(level));
        }
    }
    let beyond = table.p_value(86, 0.55).unwrap().estimate;
    assert_eq!((beyond.value(), beyond.high()), (0.0, Some(0.0)));
    let tail = table.p_value(86, 0.2).unwrap().estimate;
    assert!(tail.value() > 0.0 && tail.high() == Some(1e-4));
    assert_eq!(tail.low(), Some(0.0));
    assert!(table.p_value(86, 0.0).is_err());
    assert!(table.p_value(86, f64::NAN).is_err());
}

#[test]
fn interpolated_p_values_agree_with_direct_simulation() {
    for n in [12, 86, 120] {
        let null = NullDistribution::simulate(n, 100_000, 99).unwrap();
        for i in 1..40 {
            let d = null.sorted()[2_500 * i - 1];
            let direct = null.p_value(d);
            let table = LillieforsTable::embedded();
            let table = table.p_value(n, d).unwrap().estimate;
            let spread = (table.value() * (1.0 - table.value()) / 1e5).sqrt();
            let gap = (direct.value() - table.value()).abs();
            assert!(gap < 4.5 * spread, "{n}, {d}: {direct:?} {table:?}");
        }
    }
}

#[test]
fn regresses_the_generator_of_the_table() {
    let &(n, replicates) = LillieforsTable::sizes().first().unwrap();
    let null = NullDistribution::simulate(n, replicates, 0).unwrap();
    for level in LillieforsTable::LEVELS {
        let ours = null.critical_value(level).unwrap();
        let (value, _) =
            LillieforsTable::embedded().critical_value(n, level).unwrap();
        assert!(
            (ours.estimate.value() - value).abs() < 2e-8,
            "{level}: {ours:?}"
        );
    }
}

/// Levels of simulated values (`fixtures/oracles/lilliefors_large.py`), whose
/// standard error is at most 0.0013.
#[test]
fn beyond_the_sizes_of_the_table_p_is_that_of_a_simulation() {
    const CSV: &str = rocking_fixtures::text("oracles/lilliefors_large.csv");
    for line in CSV.lines().skip(1) {
        let cells: Vec<f64> =
            line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let [n, _, level, d] = cells[..] else { panic!("{line}") };
        let table = LillieforsTable::embedded();
        let found = table.p_value(n as usize, d).unwrap();
        assert_eq!(found.source, NullSource::Scaled);
        let p = found.estimate;
        assert!((p.value() - level).abs() < 0.003, "{line}: {found:?}");
        assert!(p.interval().unwrap().holds(level), "{line}");
    }
}
