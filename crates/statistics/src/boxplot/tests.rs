use super::*;

fn one_to(n: u32) -> ExtendedSample {
    let values: Vec<f64> = (1..=n).map(f64::from).collect();
    ExtendedSample::try_new(&values).unwrap()
}

#[test]
fn median_interval_has_the_published_ranks_and_coverage() {
    // statistics.md section 4; coverage of 1 - 2 P(Bin(n, 1/2) < rank).
    for (n, low, high, coverage) in [
        (86, 34.0, 53.0, 0.960),
        (44, 16.0, 29.0, 0.951),
        (73, 28.0, 46.0, 0.966),
    ] {
        let interval = median_interval(&one_to(n), 0.95).unwrap();
        assert_eq!(interval.interval.ends(), (low, high), "n = {n}");
        assert!((interval.coverage - coverage).abs() < 5e-4);
    }
    // Five values cover with 1 - 2/32 only, six with 1 - 2/64.
    assert!(median_interval(&one_to(5), 0.95).is_none());
    let six = median_interval(&one_to(6), 0.95).unwrap();
    assert!((six.coverage - 0.96875).abs() < 1e-14);
}

#[test]
fn whiskers_end_at_data_and_the_fence_is_closed() {
    // Quartiles 2 and 4, fences -1 and 7 (type 7, n = 5 would move them).
    let values = [-1.0, 2.0, 2.0, 3.0, 4.0, 4.0, 7.0];
    let sample = ExtendedSample::try_new(&values).unwrap();
    let boxplot = Boxplot::try_new(&sample, QuantileType::default()).unwrap();
    assert_eq!((boxplot.q1, boxplot.q3), (2.0, 4.0));
    assert_eq!((boxplot.whisker_low, boxplot.whisker_high), (-1.0, 7.0));
    assert!(boxplot.outliers.is_empty());
    let half = 1.57 * 2.0 / 7.0_f64.sqrt();
    assert_eq!(boxplot.notch_high, 3.0 + half);
}

#[test]
fn censored_values_are_outliers_until_they_reach_the_box() {
    let mut values: Vec<f64> = (1..=9).map(f64::from).collect();
    values.push(f64::INFINITY);
    let sample = ExtendedSample::try_new(&values).unwrap();
    let boxplot = Boxplot::try_new(&sample, QuantileType::default()).unwrap();
    assert_eq!(boxplot.outliers, [f64::INFINITY]);
    assert_eq!(boxplot.whisker_high, 9.0);
    values.extend([f64::INFINITY; 3]);
    let sample = ExtendedSample::try_new(&values).unwrap();
    assert!(Boxplot::try_new(&sample, QuantileType::default()).is_err());
}
