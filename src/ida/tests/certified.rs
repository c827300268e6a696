use super::super::*;
use crate::record::Accelerogram;

/// A triangular lobe of half a second, 0.2 g high.
fn lobe() -> NormalisedRecord {
    let samples =
        (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
    let record = Accelerogram::try_new("lobe", 0.01, samples.collect());
    NormalisedRecord::new(&record.unwrap())
}

fn analysis(refine: Option<f64>) -> Analysis {
    let block = Block::try_new(0.1, 3.0).unwrap();
    let eta = Restitution::constant(0.92).unwrap();
    let overturning = Overturning::HalfPi;
    Analysis { refine, overturning, ..Analysis::paper(block, eta) }
}

#[test]
fn certified_fates_agree_where_double_precision_tells_them() {
    let analysis = analysis(Some(1e-4));
    let plain = curve(&lobe(), &analysis).unwrap();
    let (certified, count) = certified_curve(&lobe(), &analysis).unwrap();
    assert_eq!(certified, plain);
    assert_eq!(count, Certification::default());
    assert!(plain.overturning.is_some());
}

#[test]
fn bisection_to_the_last_bit_needs_double_double() {
    // The bracket's ends are neighbours, a rounding of the margin apart.
    let analysis = analysis(Some(f64::MIN_POSITIVE));
    let plain = curve(&lobe(), &analysis).unwrap().overturning.unwrap();
    assert!(!plain.refined.unwrap().resolved);
    let (curve, count) = certified_curve(&lobe(), &analysis).unwrap();
    let first = curve.overturning.unwrap();
    let top = first.refined.unwrap();
    assert!(count.needed > 0 && count.unresolved == 0, "{count:?}");
    assert!(top.resolved && top.outcome.is_overturned());
    assert!(first.standing_im.next_up() >= top.im, "{first:?}");
    // Double precision is off by roundings.
    let plain_im = plain.refined.unwrap().im;
    assert!((plain_im - top.im).abs() < 1e-12);
}
