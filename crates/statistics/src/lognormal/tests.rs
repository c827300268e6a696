use super::*;
use crate::{CensoredSample, QuantileType};

/// The sample of `fixtures/oracles/lognormal.py`.
const X: [f64; 22] = [
    1.05, 1.12, 1.2, 1.21, 1.3, 1.33, 1.41, 1.5, 1.52, 1.6, 1.75, 1.8, 1.93,
    2.0, 2.2, 2.4, 2.45, 2.9, 3.1, 3.8, 4.5, 7.5,
];

#[test]
fn trimming_keeps_82_of_86_by_type_5_and_81_by_type_7() {
    let values: Vec<f64> = (1..=86).map(f64::from).collect();
    let sample = ExtendedSample::try_new(&values).unwrap();
    for (number, kept) in [(5, 82), (7, 81)] {
        let quantile_type = QuantileType::try_new(number).unwrap();
        let trimmed = FitMethod::Trimmed(quantile_type);
        assert_eq!(fit(&sample, 0.0, trimmed).unwrap().n_kept, kept);
    }
}

#[test]
fn infinite_values_meet_only_the_methods_that_take_them() {
    let mut values = X.to_vec();
    values.extend([f64::INFINITY; 2]);
    let sample = ExtendedSample::try_new(&values).unwrap();
    let quantile_type = QuantileType::default();
    for method in [FitMethod::MaximumLikelihood, FitMethod::Moment] {
        let error = fit(&sample, 0.0, method).unwrap_err();
        assert_eq!(error, FitError::Infinite { censored: 2, n: 24 });
    }
    // 2 of 24 leave no finite 95 % quantile.
    let error =
        fit(&sample, 0.0, FitMethod::Trimmed(quantile_type)).unwrap_err();
    assert!(matches!(error, FitError::InfiniteQuantile { .. }));
    assert!(fit(&sample, 0.0, FitMethod::Quantile(quantile_type)).is_ok());
    let censored =
        fit(&sample, 0.0, FitMethod::Censored(quantile_type)).unwrap();
    assert_eq!((censored.n, censored.n_kept), (24, 22));
    // Two records beyond the largest move the fit up and widen it.
    let complete = ExtendedSample::try_new(&X).unwrap();
    let plain = fit(&complete, 0.0, FitMethod::MaximumLikelihood)
        .unwrap()
        .distribution;
    assert!(censored.distribution.log_mean() > plain.log_mean());
    assert!(censored.distribution.dispersion() > plain.dispersion());
    assert_eq!(plain.area_distance(&sample), None);
    assert!(plain.kolmogorov_distance(&sample) >= 2.0 / 24.0);
}

#[test]
fn degenerate_samples_are_refused() {
    let mle = FitMethod::MaximumLikelihood;
    let refused = |values: &[f64], shift| {
        let sample = ExtendedSample::try_new(values).unwrap();
        fit(&sample, shift, mle).unwrap_err()
    };
    assert_eq!(refused(&[2.0, 2.0], 0.0), FitError::Degenerate);
    assert_eq!(refused(&[2.0], 0.0), FitError::TooFew(1));
    let at_shift = FitError::NotAboveShift { value: 1.0, shift: 1.0 };
    assert_eq!(refused(&[1.0, 2.0], 1.0), at_shift);
    assert!(matches!(refused(&[1.0, 2.0], -1.0), FitError::Parameters(_)));
    assert!(matches!(refused(&[1.0, 2.0], f64::NAN), FitError::Parameters(_)));
}

const CENSORED: &str = rocking_fixtures::text("oracles/censored.csv");
/// The sample of `fixtures/oracles/censored.py`: exact values, limits.
const EXACT: [f64; 17] = [
    1.05, 1.12, 1.2, 1.21, 1.33, 1.41, 1.5, 1.52, 1.6, 1.75, 1.8, 1.93, 2.2,
    2.4, 2.45, 3.1, 3.8,
];
const LIMITS: [f64; 6] = [1.25, 1.7, 2.0, 4.0, 3.0, 0.9];

/// Cells of a row of the oracle, NaN if one is no number.
fn censored(name: &str) -> Vec<f64> {
    let mut rows = CENSORED.lines().map(|line| line.split(','));
    let row = rows.find_map(|mut row| (row.next()? == name).then_some(row));
    let cells = row.unwrap().map(|cell| cell.parse().unwrap_or(f64::NAN));
    cells.collect()
}

#[test]
fn values_censored_at_limits_of_their_own_agree_with_scipy_and_mpmath() {
    let exact = EXACT.map(|x| (x, x));
    let cells = [&exact[..], &LIMITS.map(|x| (x, f64::INFINITY))].concat();
    for shift in [0.0, 1.0] {
        let expected = censored(&format!("own-limits-{shift}"));
        let fit = fit_intervals(&cells, shift).unwrap();
        // The limit 0.9 says nothing of what lies above 1.
        assert_eq!(fit.n, 23);
        assert_eq!(fit.n_kept as f64, expected[0]);
        let near = |ours: f64, theirs: f64| {
            assert!((ours / theirs - 1.0).abs() < 1e-12, "{ours} {theirs}");
        };
        near(fit.distribution.log_mean(), expected[1]);
        near(fit.distribution.dispersion(), expected[2]);
        near(fit.log_likelihood.unwrap(), expected[3]);
        // One limit for all, the largest value, is another model.
        let last = LIMITS.map(|_| (3.8, f64::INFINITY));
        let common = [&exact[..], &last].concat();
        let common = fit_intervals(&common, shift).unwrap().distribution;
        assert!(common.dispersion() / expected[2] > 1.1);
    }
}

/// The levels of `fixtures/oracles/censored.py`: exact values, limits.
const LEVELS: [(&[f64], &[f64]); 3] = [
    (&[1.04, 1.1, 1.15, 1.22, 1.3, 1.31, 1.4, 1.47, 1.6, 1.66, 1.9, 2.3], &[]),
    (&[1.1, 1.21, 1.25, 1.5, 1.45, 1.8, 1.77, 2.1, 2.6, 3.2], &[2.5, 4.0]),
    (&[1.3, 1.52, 1.9, 2.4, 3.1], &[1.5, 2.0, 2.0, 2.2, 2.5, 3.0, 4.0]),
];

#[test]
fn samples_of_one_dispersion_agree_with_scipy_and_mpmath() {
    let sample = |(exact, limits): &(&[f64], &[f64])| {
        let censored =
            limits.iter().map(|limit| (f64::INFINITY, Some(*limit)));
        let all = exact.iter().map(|x| (*x, None)).chain(censored);
        let (values, limits): (Vec<_>, Vec<_>) = all.unzip();
        CensoredSample::try_new(&values, &limits).unwrap()
    };
    let samples = LEVELS.each_ref().map(sample);
    for shift in [0.0, 1.0] {
        let fits = CensoredSample::fit_together(&samples, shift).unwrap();
        for (k, fit) in fits.iter().enumerate() {
            let expected = censored(&format!("common-{shift}-{}", k + 1));
            let law = fit.distribution;
            let own = fit.log_likelihood.unwrap();
            let found = [law.log_mean(), law.dispersion(), own];
            for (ours, theirs) in found.iter().zip(&expected[1..]) {
                assert!((ours - theirs).abs() < 1e-12 * theirs.abs().max(1.0));
            }
            assert_eq!(fit.n_kept as f64, expected[0]);
        }
        // A sample alone has the bits of its own fit.
        let alone = CensoredSample::fit_together(&samples[1..2], shift);
        let method = FitMethod::MaximumLikelihood;
        assert_eq!(alone.unwrap(), [samples[1].fit(shift, method).unwrap()]);
    }
    assert_eq!(CensoredSample::fit_together(&[], 0.0), Ok(Vec::new()));
}

#[test]
fn counts_that_tell_no_dispersion_are_refused() {
    let stripe = |im, exceeded| Stripe { im, exceeded, n: 9 };
    let refused = |stripes: &[Stripe]| fit_counts(stripes, 1.0).unwrap_err();
    let parted = FitError::Parted { below: 1.5, above: 2.0 };
    assert_eq!(refused(&[stripe(1.5, 0), stripe(2.0, 9)]), parted);
    let one = FitError::OneMixedStripe { im: 1.5 };
    assert_eq!(refused(&[stripe(1.5, 3)]), one);
    assert_eq!(refused(&[stripe(1.2, 0), stripe(1.5, 3)]), one);
    assert_eq!(refused(&[stripe(1.5, 3), stripe(2.0, 9)]), one);
    assert_eq!(refused(&[stripe(1.5, 0); 3]), FitError::NoneExceeded);
    assert_eq!(refused(&[stripe(1.5, 9); 3]), FitError::AllExceeded);
    assert_eq!(refused(&[]), FitError::NoneExceeded);
    // More exceed at the lower intensity, or as many at both: also if all do
    // at the lower one and none at the higher.
    for falling in [(5, 2), (3, 3), (9, 0), (1, 1)] {
        let stripes = [stripe(1.5, falling.0), stripe(2.0, falling.1)];
        assert_eq!(refused(&stripes), FitError::NotRising, "{falling:?}");
    }
    // The least rise has a fit.
    let stripe = |im, exceeded| Stripe { im, exceeded, n: 900 };
    let (least, more) = (stripe(1.5, 300), stripe(2.0, 301));
    assert!(fit_counts(&[least, more], 1.0).is_ok());
    let stripe = |im, exceeded| Stripe { im, exceeded, n: 9 };
    for wrong in [stripe(1.0, 3), stripe(2.0, 10), stripe(f64::NAN, 3)] {
        let error = refused(&[stripe(1.5, 3), wrong]);
        assert!(matches!(error, FitError::Stripe { number: 2, .. }));
    }
}

#[test]
fn what_is_all_censored_is_refused_as_such() {
    let inf = f64::INFINITY;
    let limits = [Some(3.0), Some(4.0), Some(5.0)];
    let sample = CensoredSample::try_new(&[inf; 3], &limits).unwrap();
    let unlimited = CensoredSample::try_new(&[inf; 3], &[]).unwrap();
    for method in FitMethod::all(QuantileType::default()) {
        let refused = |s: &CensoredSample| s.fit(0.0, method).unwrap_err();
        assert_eq!(refused(&sample), FitError::AllCensored(3), "{method}");
        assert_eq!(refused(&unlimited), FitError::AllCensored(3), "{method}");
    }
    // Values that may all be one, the censored ones too.
    let limits = [None, Some(3.0), None];
    let sample = CensoredSample::try_new(&[4.0, inf, 4.0], &limits).unwrap();
    let error = sample.fit(0.0, FitMethod::MaximumLikelihood).unwrap_err();
    assert_eq!(error, FitError::OneValue { value: 4.0, n: 3 });
}

#[test]
fn the_distance_of_two_lognormals_is_that_of_a_fine_grid() {
    let of = |m, b| Lognormal::try_new(1.0, m, b).unwrap();
    for (one, other) in [
        (of(0.0, 0.5), of(0.1, 0.5)),
        (of(0.0, 0.5), of(0.0, 0.6)),
        (of(0.3, 0.6), of(0.1, 0.4)),
        (of(-1.0, 0.3), of(-1.2, 0.35)),
    ] {
        let off = |k: i32| {
            let z = f64::from(k) / 1000.0;
            let x = (one.dispersion() * z + one.log_mean() - other.log_mean())
                / other.dispersion();
            (normal::cdf(z) - normal::cdf(x)).abs()
        };
        let most = (-8000..8000).map(off).fold(0.0, f64::max);
        let found = one.distance(&other).unwrap();
        assert!((found - most).abs() < 1e-6, "{found} {most}");
        assert!((found - other.distance(&one).unwrap()).abs() < 1e-12);
    }
    let one = of(0.2, 0.5);
    assert!(one.distance(&one).unwrap() < 1e-15);
    let elsewhere = Lognormal::try_new(0.0, 0.2, 0.5).unwrap();
    assert!(one.distance(&elsewhere).is_none());
}

const LIKELIHOODS: &str = rocking_fixtures::text("oracles/likelihoods.csv");

fn close(ours: f64, theirs: f64, tolerance: f64) -> bool {
    (ours / theirs - 1.0).abs() < tolerance
}

#[test]
fn fits_to_intervals_agree_with_mpmath() {
    let mut count = 0;
    let lines = LIKELIHOODS.lines();
    for line in lines.filter(|line| line.starts_with("interval,")) {
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
    let row = LIKELIHOODS.lines().find(|line| line.starts_with("profile"));
    let theirs: Vec<f64> =
        row.unwrap().split(',').skip(1).map(|f| f.parse().unwrap()).collect();
    let sample = ExtendedSample::try_new(&X).unwrap();
    let profile = profile_shift(&sample).unwrap();
    let shift = profile.fit.distribution.shift();
    assert!(close(shift, theirs[0], 1e-7), "{shift}");
    assert!(close(profile.interval.low(), theirs[1], 1e-9), "{profile:?}");
    assert!(close(profile.interval.high(), theirs[2], 1e-9), "{profile:?}");
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
    let sample = ExtendedSample::try_new(&X).unwrap();
    let exact =
        fit(&sample, 1.0, FitMethod::MaximumLikelihood).unwrap().distribution;
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
