use super::super::*;
use crate::accelerogram::Accelerogram;
use crate::integrator::Arithmetic;

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
fn certified_fates_agree_where_double_precision_resolves_them() {
    let analysis = analysis(Some(1e-4));
    let plain = curve(&lobe(), &analysis).unwrap();
    let certified = Analysis { certify: true, ..analysis };
    let certified = curve(&lobe(), &certified).unwrap();
    let bits = |curve: &IdaCurve| {
        let of = |p: &IdaPoint| (p.im, p.outcome, p.fate_margin);
        curve.points.iter().map(of).collect::<Vec<_>>()
    };
    assert_eq!(bits(&certified), bits(&plain));
    let count = certified.resolution;
    assert_eq!((count.unresolved, count.wrong_in_double), (0, 0));
    assert!(plain.overturning.is_some());
}

/// A bracket of 0.25 is at most 0.01 wide after five halvings: 0.25/32.
#[test]
fn each_halving_of_a_bracket_is_an_analysis() {
    let grid = Grid::Im { step: 0.25 };
    let plain = Analysis { grid, ..analysis(None) };
    let plain = curve(&lobe(), &plain).unwrap();
    let levels = plain.points.len() as u64;
    assert!(plain.overturning.is_some() && levels > 1);
    assert_eq!(plain.analyses, levels);
    let refined = Analysis { grid, ..analysis(Some(0.01)) };
    let refined = curve(&lobe(), &refined).unwrap();
    assert_eq!(refined.points.len() as u64, levels);
    assert_eq!(refined.analyses, levels + 5);
}

/// Twice an intensity of the grid is one, too: the last above the first
/// overturning.
#[test]
fn resurrections_are_sought_up_to_a_multiple_of_the_overturned_level() {
    let grid = Grid::Im { step: 0.25 };
    let resurrections = Some(Resurrections::Multiple(2.0));
    let all = Analysis { grid, resurrections, ..analysis(None) };
    let found = curve(&lobe(), &all).unwrap();
    let first = found.overturning.unwrap().scanned_im;
    let last = found.above.last().unwrap().im;
    assert_eq!(last, 2.0 * first);
    let between = ((last - first) / 0.25).round() as usize;
    assert_eq!(found.above.len(), between);
}

#[test]
fn bisection_to_the_last_bit_needs_double_double() {
    // The bracket's ends are neighbours, a rounding of the margin apart.
    let analysis = analysis(Some(f64::MIN_POSITIVE));
    let plain = curve(&lobe(), &analysis).unwrap().overturning.unwrap();
    assert!(!plain.refined.unwrap().resolution.resolved);
    let certified = Analysis { certify: true, ..analysis };
    let curve = curve(&lobe(), &certified).unwrap();
    let count = curve.resolution;
    let first = curve.overturning.unwrap();
    let top = first.refined.unwrap();
    assert!(count.resolved_by_double_double > 0, "{count:?}");
    assert_eq!(count.unresolved, 0, "{count:?}");
    assert!(top.resolution.resolved && top.outcome.is_overturned());
    assert_eq!(top.resolution.by, Some(Arithmetic::DoubleDouble));
    assert!(first.standing_im.next_up() >= top.im, "{first:?}");
    // Double precision is off by roundings.
    let plain_im = plain.refined.unwrap().im;
    assert!((plain_im - top.im).abs() < 1e-12);
}
