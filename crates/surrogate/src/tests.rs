use super::*;
use rocking_synthesis::SuiteKind;

const DESIGN: &str = rocking_fixtures::text("surrogate/design.csv");
const COEFFICIENTS: &str =
    rocking_fixtures::text("surrogate/coefficients.csv");

#[test]
fn a_surface_of_its_own_form_is_found_again() {
    // mu = 0.3 - 0.8 u + 0.2 u^2 + 0.05 v and ln beta = -0.5 + 0.1 u, plus a
    // ripple that no low degree follows.
    let of = |index: u64, suite| {
        let (alpha_rad, p_rad_s) = point(index);
        let u = 2.0 * libm::log(p_rad_s) / libm::log(6.0) - 1.0;
        let v = 2.0 * (alpha_rad - 0.05) / 0.55 - 1.0;
        let ripple = 0.01 * libm::sin(977.0 * index as f64);
        let mu = 0.3 - 0.8 * u + 0.2 * u * u + 0.05 * v + ripple;
        let dispersion = libm::exp(-0.5 + 0.1 * u + ripple);
        let median = 1.0 + libm::exp(mu);
        Fitted {
            suite,
            alpha_rad,
            p_rad_s,
            median,
            median_low: median,
            median_high: median,
            dispersion,
            dispersion_low: dispersion,
            dispersion_high: dispersion,
        }
    };
    let blocks: Vec<Fitted> = SuiteKind::ALL
        .into_iter()
        .flat_map(|suite| (1..=300).map(move |k| of(k, suite)))
        .collect();
    let (models, choices) = fit(&blocks).unwrap();
    assert_eq!(models[0].terms, Degrees { p: 2, alpha: 1 }.terms());
    // In P_0, P_1 of v; u^2 = (2 P_2 + 1)/3.
    let mu = &models[0].coefficients[0];
    for (found, expected) in
        mu.iter().zip([0.3 + 0.2 / 3.0, 0.05, -0.8, 0.0, 0.4 / 3.0])
    {
        assert!((found - expected).abs() < 3e-3, "{mu:?}");
    }
    assert!(choices.windows(2).all(|c| c[0].terms <= c[1].terms));
    // What has no v leaves 0.02, a plane 0.04; the ripple is 0.005.
    for choice in &choices {
        let Degrees { p, alpha } = choice.degrees;
        let whole = p >= 2 && alpha >= 1;
        assert_eq!(choice.error < 0.01, whole, "{choice:?}");
    }
    let too_few = fit(&blocks[..20]).unwrap_err().to_string();
    assert!(too_few.contains("blocks: expected"), "{too_few}");
}

#[test]
fn the_coefficients_that_ship_are_the_fit_to_the_blocks_that_are_kept() {
    let blocks = read_table("design.csv", DESIGN).unwrap();
    // Without those that a record never overturns.
    assert!((1980..=2000).contains(&blocks.len()), "{}", blocks.len());
    for block in &blocks {
        let is_own = |(alpha, p): (f64, f64)| {
            (block.alpha_rad - alpha).abs() < 1e-6
                && (block.p_rad_s - p).abs() < 1e-5
        };
        assert!((1..=1000).map(point).any(is_own), "{block:?}");
    }
    let (models, _) = fit(&blocks).unwrap();
    assert_eq!(Surrogate::coefficients(&models), COEFFICIENTS);
}

#[test]
fn unseen_blocks_are_others_and_the_error_there_is_small() {
    let surrogate = Surrogate::embedded().unwrap();
    for (model, errors) in &surrogate.models {
        assert_eq!(errors.blocks, 100);
        // 0.05 in probability: what the claims take for the same.
        assert!(errors.probability.rms < 0.025, "{errors:?}");
        assert!(errors.median.rms < 0.02, "{errors:?}");
        // A surface without p is far off.
        let flat = Surface {
            suite: model.suite,
            terms: vec![(0, 0)],
            coefficients: model.coefficients.each_ref().map(|c| vec![c[0]]),
        };
        let wrong = flat.errors(&surrogate.unseen).unwrap();
        assert!(wrong.probability.rms > 0.2, "{wrong:?}");
    }
    for (k, block) in surrogate.unseen.iter().enumerate() {
        let (alpha, p) = point(k as u64 % 100 + 1001);
        assert!((block.alpha_rad - alpha).abs() < 1e-6);
        assert!((block.p_rad_s - p).abs() < 1e-5);
    }
}

#[test]
fn it_answers_in_its_range_alone() {
    let surrogate = Surrogate::embedded().unwrap();
    let model = &surrogate.models[0].0;
    assert!(model.at(0.05, 1.0).is_ok() && model.at(0.6, 6.0).is_ok());
    for (alpha, p, word) in [
        (0.049, 3.0, "alpha"),
        (0.61, 3.0, "alpha"),
        (f64::NAN, 3.0, "alpha"),
        (0.2, 0.99, "p 0.99"),
        (0.2, 6.01, "p 6.01"),
    ] {
        let error = model.at(alpha, p).unwrap_err().to_string();
        assert!(error.contains(word), "{error}");
        assert!(error.contains("expected"), "{error}");
    }
}

/// numpy's least squares and SciPy's normal distribution.
#[test]
fn coefficients_and_errors_are_those_of_another_program() {
    let expected = rocking_fixtures::text("oracles/surrogate.csv");
    let surrogate = Surrogate::embedded().unwrap();
    let kept = Recorded::kept("pga").unwrap();
    let mut compared = 0;
    for line in expected.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let value: f64 = cells[4].parse().unwrap();
        let (model, errors) = surrogate
            .models
            .iter()
            .find(|(model, _)| model.suite.name() == cells[0])
            .unwrap();
        let term = || {
            let degrees =
                (cells[2].parse().unwrap(), cells[3].parse().unwrap());
            model.terms.iter().position(|t| *t == degrees).unwrap()
        };
        let records = surrogate.sampling(model.suite).unwrap();
        let recorded = model.to_recorded(&kept).unwrap();
        assert_eq!(recorded.blocks, 15);
        // Nine digits are kept of numbers below 10.
        // The grid of the largest difference has steps of 5e-4.
        let (found, tolerance) = match cells[1] {
            "mu" => (model.coefficients[0][term()], 5e-9),
            "ln_dispersion" => (model.coefficients[1][term()], 5e-9),
            "median_rms" => (errors.median.rms, 1e-7),
            "median_largest" => (errors.median.largest, 1e-7),
            "dispersion_rms" => (errors.dispersion.rms, 1e-7),
            "dispersion_largest" => (errors.dispersion.largest, 1e-7),
            "probability_rms" => (errors.probability.rms, 1e-6),
            "probability_largest" => (errors.probability.largest, 1e-6),
            "records_median" => (records.median, 1e-7),
            "records_dispersion" => (records.dispersion, 1e-7),
            "records_probability" => (records.probability, 1e-7),
            "recorded_median_rms" => (recorded.median.rms, 1e-7),
            "recorded_median_largest" => (recorded.median.largest, 1e-7),
            "recorded_probability_rms" => (recorded.probability.rms, 1e-7),
            "recorded_probability_largest" => {
                (recorded.probability.largest, 1e-7)
            }
            other => panic!("{other}"),
        };
        assert!((found - value).abs() < tolerance, "{line}: {found}");
        compared += 1;
    }
    let terms: usize =
        surrogate.models.iter().map(|(m, _)| 2 * m.terms.len()).sum();
    assert_eq!(compared, terms + 26);
}
