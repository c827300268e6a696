use super::*;
use crate::statistics::lognormal::{fit_intervals, profile_shift};

const ORACLE: &str = rocking_fixtures::text("oracles/rivals.csv");
/// The sample of `fixtures/oracles/rivals.py`.
const X: [f64; 22] = [
    1.05, 1.12, 1.2, 1.21, 1.3, 1.33, 1.41, 1.5, 1.52, 1.6, 1.75, 1.8, 1.93,
    2.0, 2.2, 2.4, 2.45, 2.9, 3.1, 3.8, 4.5, 7.5,
];

fn close(ours: f64, theirs: f64, tolerance: f64) -> bool {
    (ours / theirs - 1.0).abs() < tolerance
}

#[test]
fn fits_to_intervals_agree_with_mpmath() {
    let mut count = 0;
    for line in ORACLE.lines().filter(|line| line.starts_with("interval,")) {
        let cells = line.split(',').skip(1).map(|cell| cell.parse().unwrap());
        let cells: Vec<f64> = cells.collect();
        let [shift, theirs @ ..] = cells.as_slice() else { panic!("{line}") };
        let mut cells: Vec<(f64, f64)> = X
            .iter()
            .map(|x| 0.25 * ((x - shift) / 0.25).floor())
            .map(|low| (shift + low, shift + low + 0.25))
            .collect();
        for cell in &mut cells[20..] {
            cell.1 = f64::INFINITY;
        }
        let fit = fit_intervals(&cells, *shift).unwrap();
        let (fitted, value) = (fit.distribution, fit.log_likelihood.unwrap());
        let ours = [fitted.log_mean(), fitted.dispersion(), value];
        for (a, b) in ours.iter().zip(theirs) {
            assert!(close(*a, *b, 1e-11), "{line}: {a}");
        }
        count += 1;
    }
    assert_eq!(count, 2);
}

#[test]
fn profile_of_the_shift_agrees_with_mpmath() {
    let row = ORACLE.lines().find(|line| line.starts_with("profile"));
    let theirs: Vec<f64> =
        row.unwrap().split(',').skip(1).map(|f| f.parse().unwrap()).collect();
    let sample = ExtendedSample::try_new(&X).unwrap();
    let profile = profile_shift(&sample).unwrap();
    let shift = profile.fit.distribution.shift();
    assert!(close(shift, theirs[0], 1e-7), "{shift}");
    assert!(close(profile.low.unwrap(), theirs[1], 1e-9), "{profile:?}");
    assert!(close(profile.high.unwrap(), theirs[2], 1e-9), "{profile:?}");
    let value = profile.fit.log_likelihood.unwrap();
    assert!(close(value, theirs[3], 1e-13), "{value}");
}

#[test]
fn a_sample_without_a_shift_has_no_interior_maximum() {
    // Skewed to the left on the logarithmic scale: a shift only harms.
    let sample =
        ExtendedSample::try_new(&[1.0, 4.0, 6.0, 7.0, 7.5, 7.9]).unwrap();
    assert_eq!(profile_shift(&sample), Err(FitError::NoInteriorMaximum));
}

#[test]
fn intervals_shrink_to_the_exact_fit() {
    use crate::statistics::lognormal::{self, FitMethod};
    let sample = ExtendedSample::try_new(&X).unwrap();
    let exact = lognormal::fit(&sample, 1.0, FitMethod::MaximumLikelihood)
        .unwrap()
        .distribution;
    let cells = X.map(|x| (x - 1e-5, x + 1e-5));
    let cells = fit_intervals(&cells, 1.0).unwrap().distribution;
    assert!((cells.log_mean() - exact.log_mean()).abs() < 1e-6);
    assert!(close(cells.dispersion(), exact.dispersion(), 1e-6));
}

#[test]
fn intervals_without_a_maximum_are_refused() {
    let refused =
        |cells: &[(f64, f64)]| fit_intervals(cells, 1.0).unwrap_err();
    let one = FitError::OneValue { value: 1.2, n: 5 };
    assert_eq!(refused(&[(1.0, 1.2); 5]), one);
    let error = refused(&[(1.0, 1.2), (1.5, 1.4)]);
    assert!(matches!(error, FitError::Interval { number: 2, .. }));
    let error = refused(&[(1.0, 1.2), (0.5, 1.0)]);
    assert!(matches!(error, FitError::Interval { number: 2, .. }));
    let error = refused(&[(1.0, 1.2), (f64::NAN, 2.0)]);
    assert!(matches!(error, FitError::Interval { number: 2, .. }));
}

#[test]
fn digamma_has_its_known_values() {
    let euler = 0.577_215_664_901_532_9;
    assert!((digamma(1.0) + euler).abs() < 1e-15);
    let half = -euler - 2.0 * std::f64::consts::LN_2;
    assert!((digamma(0.5) - half).abs() < 3e-15);
}
