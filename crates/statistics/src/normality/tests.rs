use super::*;

#[test]
fn tails_do_not_underflow() {
    // The last score is 31.6, where 1 - Phi is 1e-219.
    let mut values = vec![0.0; 999];
    values.push(1.0);
    let sample = Sample::try_new(&values).unwrap();
    let test = anderson_darling(&sample).unwrap();
    assert!(test.statistic.is_finite() && test.statistic > 100.0);
}

#[test]
fn simulated_critical_values_are_the_published_ones() {
    // Stephens' case 3 at 5 % (modified A^2 0.752, W^2 0.126), and Shapiro
    // and Wilk's own table at n = 20 (W 0.905), to the digits printed.
    let n = 20.0;
    let battery = Battery::simulate(20, 40_000, 0).unwrap();
    let [a, w, s] = battery.nulls();
    for (null, scale, offset, published) in [
        (a, 1.0 + 0.75 / n + 2.25 / (n * n), 0.0, 0.752),
        (w, 1.0 + 0.5 / n, 0.0, 0.126),
        (s, -1.0, 1.0, 0.905),
    ] {
        let critical = null.critical_value(0.05).unwrap();
        let ours = offset + scale * critical.estimate.value();
        let bound = 4.0 * scale.abs() * critical.standard_error + 5e-4;
        // The asymptotic forms themselves err by half a percent here.
        let bound = bound + 0.005 * published;
        assert!((ours - published).abs() < bound, "{ours} {published}");
    }
}

#[test]
fn a_battery_serves_its_own_size_and_says_so() {
    let battery = Battery::simulate(12, 1000, 0).unwrap();
    let sample = |n: u32| {
        let values: Vec<f64> = (0..n).map(|i| f64::from(i * i)).collect();
        Sample::try_new(&values).unwrap()
    };
    assert_eq!(
        battery.assess(&sample(13)),
        Err(LillieforsError::Size { found: 13, expected: 12 })
    );
    let [ad, cvm, sw] = battery.assess(&sample(12)).unwrap();
    // The statistics are those of the single tests, and so are the
    // p-values, to the replicates' error and the approximations'.
    let tests = [anderson_darling, cramer_von_mises, shapiro_wilk];
    for (ours, test) in [ad, cvm, sw].iter().zip(tests) {
        let single = test(&sample(12)).unwrap();
        assert_eq!(ours.statistic, single.statistic);
        let p = ours.p_value;
        let (low, high) = p.interval().unwrap().ends();
        assert!(low < p.value() && p.value() < high);
        assert!(low - 0.01 < single.p_value.value());
        assert!(high + 0.01 > single.p_value.value());
    }
    // Farther off than every replicate.
    let mut far = [0.0; 12];
    far[11] = 1.0;
    let far = Sample::try_new(&far).unwrap();
    let p = battery.assess(&far).unwrap().map(|test| test.p_value.value());
    assert_eq!(p, [1.0 / 1001.0; 3]);
    assert!(Battery::simulate(3, 1000, 0).is_err());
    assert!(Battery::simulate(12, 99, 0).is_err());
}

#[test]
fn batteries_do_not_depend_on_threads() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let simulate = || Battery::simulate(9, 3000, 1).unwrap();
        let battery = pool.build().unwrap().install(simulate);
        battery.nulls().clone().map(|null| null.sorted().to_vec())
    };
    assert_eq!(run(1), run(3));
}

/// One value apart: A^2 of 30 values is 11.4, beyond the approximation's 10,
/// of 24 values 9.05.
#[test]
fn where_an_approximation_ends_p_is_a_bound() {
    let of = |n: usize| {
        let mut values = vec![0.0; n];
        values[0] = 1.0;
        let sample = Sample::try_new(&values).unwrap();
        anderson_darling(&sample).unwrap().p_value
    };
    assert_eq!((of(30).low(), of(30).value()), (Some(0.0), 3.7e-24));
    assert!(of(24).interval().is_none() && of(24).value() > 3.7e-24);
}
