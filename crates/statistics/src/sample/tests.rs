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
fn ties_are_counted() {
    let sample = Sample::try_new(&[2.0, 1.0, 2.0, 3.0, 2.0]).unwrap();
    assert_eq!((sample.distinct(), sample.largest_tie()), (3, 3));
}
