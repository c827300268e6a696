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

#[test]
fn two_pass_moments_survive_a_large_offset() {
    // NIST StRD NumAcc4: mean 10000000.2, standard deviation 0.1 (certified).
    let mut values = vec![10_000_000.2];
    for _ in 0..500 {
        values.extend([10_000_000.1, 10_000_000.3]);
    }
    let sample = Sample::try_new(&values).unwrap();
    assert!((sample.mean() / 10_000_000.2 - 1.0).abs() < 1e-15);
    let deviation = (sample.sum_of_squares() / 1000.0).sqrt();
    // 7.4 digits remain of the data's own rounding.
    assert!((deviation - 0.1).abs() < 1e-8, "{deviation}");
}

#[test]
fn ties_are_counted() {
    let sample = Sample::try_new(&[2.0, 1.0, 2.0, 3.0, 2.0]).unwrap();
    assert_eq!((sample.distinct(), sample.largest_tie()), (3, 3));
}
