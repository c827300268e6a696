use super::*;
use crate::statistics::QuantileType;

const ORACLE: &str = include_str!("../../../fixtures/oracles/lognormal.csv");
/// The sample of `fixtures/oracles/lognormal.py`.
const X: [f64; 22] = [
    1.05, 1.12, 1.2, 1.21, 1.3, 1.33, 1.41, 1.5, 1.52, 1.6, 1.75, 1.8, 1.93,
    2.0, 2.2, 2.4, 2.45, 2.9, 3.1, 3.8, 4.5, 7.5,
];

fn method(name: &str) -> FitMethod {
    let quantile_type = QuantileType::default();
    match name {
        "mle" => FitMethod::MaximumLikelihood,
        "moment" => FitMethod::Moment,
        "quantile" => FitMethod::Quantile(quantile_type),
        "trimmed" => FitMethod::Trimmed(quantile_type),
        "censored" => FitMethod::Censored(quantile_type),
        _ => panic!("{name}"),
    }
}

#[test]
fn fits_and_distances_agree_with_scipy_and_mpmath() {
    let sample = ExtendedSample::try_new(&X).unwrap();
    let mut count = 0;
    for line in ORACLE.lines().skip(1) {
        let f: Vec<&str> = line.split(',').collect();
        let number = |i: usize| f[i].parse::<f64>().unwrap();
        let fit = fit(&sample, number(1), method(f[0])).unwrap();
        let fitted = fit.distribution;
        assert_eq!(fit.n_kept as f64, number(2), "{line}");
        let ours = [
            fitted.log_mean(),
            fitted.dispersion(),
            fit.log_likelihood.unwrap(),
            fitted.kolmogorov_distance(&sample),
            fitted.area_distance(&sample).unwrap(),
        ];
        for (i, value) in ours.into_iter().enumerate() {
            let error = (value / number(i + 3) - 1.0).abs();
            assert!(error < 1e-12, "{line}: {value}, {error:e}");
        }
        count += 1;
    }
    assert_eq!(count, 10);
}

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
    for name in ["mle", "moment"] {
        let error = fit(&sample, 0.0, method(name)).unwrap_err();
        assert_eq!(error, FitError::Infinite { censored: 2, n: 24 });
    }
    // 2 of 24 leave no finite 95 % quantile.
    let error = fit(&sample, 0.0, method("trimmed")).unwrap_err();
    assert!(matches!(error, FitError::InfiniteQuantile { .. }));
    assert!(fit(&sample, 0.0, method("quantile")).is_ok());
    let censored = fit(&sample, 0.0, method("censored")).unwrap();
    assert_eq!((censored.n, censored.n_kept), (24, 22));
    // Two records beyond the largest move the fit up and widen it.
    let complete = ExtendedSample::try_new(&X).unwrap();
    let plain = fit(&complete, 0.0, method("mle")).unwrap().distribution;
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

#[test]
fn the_distribution_is_consistent_with_itself() {
    let fragility = Lognormal::try_new(1.0, 0.2, 0.6).unwrap();
    for p in [1e-6, 0.16, 0.5, 0.84, 0.999] {
        let x = fragility.quantile(p);
        assert!((fragility.cdf(x) / p - 1.0).abs() < 1e-10);
        let upper = fragility.survival(x) / (1.0 - p);
        assert!((upper - 1.0).abs() < 1e-9);
    }
    assert_eq!(fragility.cdf(0.5), 0.0);
    assert_eq!(fragility.ln_pdf(1.0), f64::NEG_INFINITY);
    // The slope of F is the density.
    let slope = (fragility.cdf(2.001) - fragility.cdf(1.999)) / 0.002;
    assert!((slope / exp(fragility.ln_pdf(2.0)) - 1.0).abs() < 1e-5);
}
