use super::*;
use crate::statistics::ExtendedSample;

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
    let found = Assessment::new(&sample, Scale::Linear, 0.05, null);
    let size = LillieforsError::Size { found: 30, expected: 20 };
    assert_eq!(found.verdict, Err(Inapplicable::Test(size)));
}

#[test]
fn three_values_have_a_statistic_and_no_test() {
    // NIST's NumAcc1: three equally spaced values, the least D possible,
    // 1/3 - Phi(-1) by 15 digits of Phi.
    let d = statistic(&[10_000_001.0, 10_000_003.0, 10_000_002.0]).d;
    assert!((d - 0.174_678_079_401_876).abs() < 1e-14, "{d}");
    let table = Table::embedded();
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
fn largest_statistics_are_the_closed_form() {
    for (n, largest) in [
        (4, 0.441_462),
        (5, 0.472_640),
        (10, 0.524_085),
        (44, 0.539_944),
        (86, 0.540_387),
    ] {
        assert!((Statistic::largest(n) - largest).abs() < 5e-7);
    }
    // Attained by n - 1 equal values and one other, to rounding.
    let d = statistic(&[0.0, 0.0, 0.0, 1.0]).d;
    assert!((d - Statistic::largest(4)).abs() < 1e-15);
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

/// n, replicates behind it, and the critical values at levels 0.20, 0.15,
/// 0.10, 0.05, 0.01 with the standard errors of 5 % and 1 %, of an
/// independent simulation (Philox streams, sorted samples).
const INDEPENDENT: [(usize, [f64; 5], [f64; 5]); 8] = [
    (
        10,
        [0.21707, 0.22744, 0.24102, 0.26205, 0.30347],
        [1.2e-5, 1.3e-5, 1.5e-5, 2.0e-5, 3.7e-5],
    ),
    (
        20,
        [0.15869, 0.16632, 0.17634, 0.19193, 0.22323],
        [7.1e-6, 7.9e-6, 9.3e-6, 1.2e-5, 2.3e-5],
    ),
    (
        30,
        [0.13127, 0.13758, 0.14586, 0.15879, 0.18492],
        [1.0e-5, 1.1e-5, 1.3e-5, 1.8e-5, 3.3e-5],
    ),
    (
        44,
        [0.10940, 0.11465, 0.12156, 0.13235, 0.15418],
        [8.5e-6, 9.5e-6, 1.1e-5, 1.5e-5, 2.8e-5],
    ),
    (
        50,
        [0.10289, 0.10783, 0.11432, 0.12448, 0.14500],
        [7.9e-6, 8.9e-6, 1.0e-5, 1.4e-5, 2.7e-5],
    ),
    (
        86,
        [0.07918, 0.08297, 0.08795, 0.09576, 0.11160],
        [6.1e-6, 6.8e-6, 8.0e-6, 1.1e-5, 2.0e-5],
    ),
    (
        100,
        [0.07358, 0.07710, 0.08173, 0.08898, 0.10372],
        [5.7e-6, 6.3e-6, 7.5e-6, 9.8e-6, 1.9e-5],
    ),
    (
        300,
        [0.04295, 0.04499, 0.04767, 0.05189, 0.06047],
        [6.0e-6, 6.7e-6, 7.9e-6, 1.0e-5, 2.0e-5],
    ),
];

#[test]
fn table_agrees_with_an_independent_simulation() {
    for (n, values, errors) in INDEPENDENT {
        for (i, level) in [0.20, 0.15, 0.10, 0.05, 0.01].iter().enumerate() {
            let (ours, error) =
                Table::embedded().critical_value(n, *level).unwrap();
            // Four combined standard errors, and the rounding of theirs.
            let combined = (error * error + errors[i] * errors[i]).sqrt();
            let bound = 4.0 * combined + 5e-6;
            assert!((ours - values[i]).abs() <= bound, "{n}, {level}: {ours}");
        }
    }
    for n in [44, 86] {
        let (_, error) = Table::embedded().critical_value(n, 0.05).unwrap();
        assert!(error <= 1.2e-5, "{n}: {error:e}");
    }
}

#[test]
fn table_agrees_with_the_exact_distribution_for_four_values() {
    // Quadrature over the sphere of standardised residuals, to 1e-5.
    for (level, exact) in [
        (0.5, 0.25824),
        (0.2, 0.30288),
        (0.15, 0.32146),
        (0.1, 0.34528),
        (0.05, 0.37527),
        (0.01, 0.41305),
        (0.001, 0.43270),
    ] {
        let (ours, error) =
            Table::embedded().critical_value(4, level).unwrap();
        let bound = 4.0 * error + 1e-5;
        assert!((ours - exact).abs() <= bound, "{level}: {ours} {error:e}");
    }
}

#[test]
fn table_is_complete_and_falls_with_size_and_level() {
    let table = Table::embedded();
    for (n, _) in Table::sizes() {
        let values = Table::LEVELS
            .map(|level| table.critical_value(n, level).unwrap().0);
        assert!(values.windows(2).all(|pair| pair[0] < pair[1]), "{n}");
        assert!(values[31] < Statistic::largest(n), "{n}");
    }
    let at = |n| table.critical_value(n, 0.05).unwrap().0;
    assert!((5..=1000).all(|n| at(n) < at(n - 1)));
    assert!(table.critical_value(3, 0.05).is_err());
    assert!(table.critical_value(1001, 0.05).is_err());
    assert!(table.critical_value(86, 1e-5).is_err());
}

#[test]
fn p_values_invert_the_table_and_end_at_the_largest_statistic() {
    let table = Table::embedded();
    for n in [4, 12, 44, 86, 250, 777] {
        for level in Table::LEVELS {
            let (value, _) = table.critical_value(n, level).unwrap();
            let p = table.p_value(n, value).unwrap();
            assert!((p.value / level - 1.0).abs() < 1e-9, "{n}, {level}");
            assert!(p.low <= level && level <= p.high);
        }
    }
    let beyond = table.p_value(86, 0.55).unwrap();
    assert_eq!((beyond.value, beyond.high), (0.0, 0.0));
    let tail = table.p_value(86, 0.2).unwrap();
    assert!(tail.value > 0.0 && tail.high < 1e-4 && tail.low == 0.0);
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
            let table = Table::embedded().p_value(n, d).unwrap();
            let spread = (table.value * (1.0 - table.value) / 1e5).sqrt();
            let gap = (direct.value - table.value).abs();
            assert!(gap < 4.5 * spread, "{n}, {d}: {direct:?} {table:?}");
        }
    }
}

#[test]
fn regresses_the_generator_of_the_table() {
    let &(n, replicates) = Table::sizes().first().unwrap();
    let null = NullDistribution::simulate(n, replicates, 0).unwrap();
    for level in Table::LEVELS {
        let ours = null.critical_value(level).unwrap();
        let (value, _) = Table::embedded().critical_value(n, level).unwrap();
        assert!((ours.value - value).abs() < 2e-8, "{level}: {ours:?}");
    }
}
