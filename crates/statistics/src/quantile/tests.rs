use super::*;

#[test]
fn infinities_count_only_with_positive_weight() {
    let inf = f64::INFINITY;
    let sample = ExtendedSample::try_new(&[1.0, 2.0, inf]).unwrap();
    let of = |number, p| {
        let quantile_type = QuantileType::try_new(number).unwrap();
        quantile_type.extended_quantile(&sample, p).unwrap()
    };
    for number in 5..=9 {
        assert_eq!(of(number, 0.5), 2.0, "type {number}");
        assert_eq!(of(number, 0.51), inf, "type {number}");
    }
    assert_eq!(of(1, 2.0 / 3.0), 2.0);
}

#[test]
fn finite_84_percent_needs_at_most_13_of_86_overturned() {
    // statistics.md 3.2: 13 overturned leave it finite, 14 don't; 16 % 71.
    let at = |overturned: usize, p| {
        let mut values: Vec<f64> =
            (1..=86 - overturned as u32).map(f64::from).collect();
        values.resize(86, f64::INFINITY);
        let sample = ExtendedSample::try_new(&values).unwrap();
        QuantileType::default().extended_quantile(&sample, p).unwrap()
    };
    assert!(at(13, 0.84).is_finite() && at(14, 0.84).is_infinite());
    assert!(at(71, 0.16).is_finite() && at(72, 0.16).is_infinite());
    assert!(at(42, 0.50).is_finite() && at(43, 0.50).is_infinite());
}

#[test]
fn bad_probabilities_and_types_are_refused() {
    let sample = Sample::try_new(&[1.0]).unwrap();
    for p in [-0.1, 1.1, f64::NAN] {
        assert!(QuantileType::default().quantile(&sample, p).is_err());
    }
    assert_eq!(QuantileType::try_new(0), Err(QuantileError::Type(0)));
    assert_eq!(QuantileType::try_new(10), Err(QuantileError::Type(10)));
}
