//! Tests of the measures beyond the declared cases.

use super::fourier::Transform;
use super::*;

fn record(dt_s: f64, samples_g: &[f64]) -> Accelerogram {
    Accelerogram::try_new("test", dt_s, samples_g.to_vec()).expect("record")
}

#[test]
fn velocity_has_the_bits_of_the_accelerogram() {
    let samples: Vec<f64> =
        (0..999).map(|i| libm::sin(0.1 * f64::from(i * i % 97))).collect();
    let own = record(0.005, &samples);
    let settings = Settings::try_new(1.0, 0.05, Vec::new()).expect("settings");
    let m = Measures::of(&own, &settings).expect("moves");
    assert_eq!(m.pgv_m_s, own.pgv_g_s());
    assert_eq!(m.pga_g, own.pga_g());
}

#[test]
fn transform_of_a_few_values_is_the_sum_of_its_definition() {
    for n in [1_usize, 2, 8, 64] {
        let value = |i: usize| {
            let x = i as f64;
            (libm::sin(3.0 * x), libm::cos(x * x))
        };
        let mut fast: Vec<(f64, f64)> = (0..n).map(value).collect();
        Transform::new(n).apply(&mut fast);
        for (k, own) in fast.iter().enumerate() {
            let sum = (0..n).fold((0.0, 0.0), |sum, i| {
                let turn = (i * k % n) as f64 / n as f64;
                let angle = -2.0 * std::f64::consts::PI * turn;
                let (sin, cos) = libm::sincos(angle);
                let (re, im) = value(i);
                (sum.0 + re * cos - im * sin, sum.1 + re * sin + im * cos)
            });
            assert!((own.0 - sum.0).abs() < 1e-13 * n as f64);
            assert!((own.1 - sum.1).abs() < 1e-13 * n as f64);
        }
    }
}

#[test]
fn what_cannot_be_measured_is_refused() {
    let silent = record(0.01, &[0.0; 50]);
    let moving = record(0.01, &[0.0, 0.1, 0.0]);
    let slower = record(0.02, &[0.0, 0.1, 0.0]);
    let settings = Settings::default();
    let silence = Err(IntensityError::Silent);
    assert_eq!(Measures::of(&silent, &settings), silence);
    let pair = |a, b| PairMeasures::of(a, b, &settings, &[50.0]);
    assert_eq!(pair(&moving, &silent), Err(IntensityError::Silent));
    let intervals =
        IntensityError::Intervals { first_s: 0.01, second_s: 0.02 };
    assert_eq!(pair(&moving, &slower), Err(intervals));
    for period in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Settings::try_new(9.81, 0.05, vec![period]).is_err());
    }
    for damping in [-0.1, 1.0, f64::NAN] {
        assert!(Settings::try_new(9.81, damping, vec![1.0]).is_err());
    }
    assert!(Settings::try_new(f64::NAN, 0.05, vec![1.0]).is_err());
    for wrong in [-1e-9, 100.1, f64::NAN] {
        let refused = PairMeasures::of(&moving, &moving, &settings, &[wrong]);
        assert!(matches!(refused, Err(IntensityError::Percentile(_))));
    }
}

#[test]
fn an_oscillator_of_any_step_gives_the_same_peak() {
    // The same motion at half the interval: other steps, same answer.
    let coarse = [0.0, 0.3, -0.2, 0.25, -0.1, 0.0];
    let mut fine = vec![coarse[0]];
    for pair in coarse.windows(2) {
        fine.extend([0.5 * (pair[0] + pair[1]), pair[1]]);
    }
    let periods = vec![0.01, 0.07, 0.3, 1.0, 30.0];
    let settings = Settings::try_new(9.81, 0.05, periods).expect("settings");
    let of = |dt_s, samples: &[f64]| {
        let m = Measures::of(&record(dt_s, samples), &settings);
        m.expect("moves").spectral_acceleration_g
    };
    for (a, b) in of(0.2, &coarse).iter().zip(of(0.1, &fine)) {
        assert!((a - b).abs() < 1e-12 * b, "{a} {b}");
    }
}
