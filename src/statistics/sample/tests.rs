use super::*;

#[test]
fn refuses_what_it_cannot_hold() {
    assert_eq!(Sample::try_new(&[]), Err(SampleError::Empty));
    assert!(Sample::try_new(&[1.0, f64::NAN]).is_err());
    assert!(ExtendedSample::try_new(&[f64::NAN]).is_err());
    assert!(ExtendedSample::try_new(&[f64::NEG_INFINITY]).is_err());
    let error = Sample::try_new(&[1.0, f64::INFINITY]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "value 2 of the sample is inf: expected a finite number"
    );
}

/// The first value, then the two others 500 times over.
fn numerical_accuracy(first: f64, others: [f64; 2]) -> Sample {
    let mut values = vec![first];
    values.extend(others.repeat(500));
    Sample::try_new(&values).unwrap()
}

#[test]
fn two_pass_moments_meet_nist_certified_values() {
    // NIST StRD, univariate: NumAcc1 to NumAcc4.
    let three = Sample::try_new(&[1e7 + 1.0, 1e7 + 3.0, 1e7 + 2.0]).unwrap();
    assert_eq!((three.mean(), three.sum_of_squares()), (1e7 + 2.0, 2.0));
    for (first, others, mean, digits_of_deviation) in [
        (1.2, [1.1, 1.3], 1.2, 1e-14),
        (1_000_000.2, [1_000_000.1, 1_000_000.3], 1_000_000.2, 1e-9),
        (10_000_000.2, [10_000_000.1, 10_000_000.3], 10_000_000.2, 1e-8),
    ] {
        let sample = numerical_accuracy(first, others);
        assert!((sample.mean() / mean - 1.0).abs() < 1e-15);
        let deviation = (sample.sum_of_squares() / 1000.0).sqrt();
        // What the rounding of the data themselves leaves.
        assert!((deviation - 0.1).abs() < digits_of_deviation, "{deviation}");
    }
}

#[test]
fn ties_are_counted() {
    let sample = Sample::try_new(&[2.0, 1.0, 2.0, 3.0, 2.0]).unwrap();
    assert_eq!((sample.distinct(), sample.largest_tie()), (3, 3));
}
