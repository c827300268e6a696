//! Tests of floors beyond the declared cases.

use std::f64::consts::PI;

use super::*;

fn record(dt_s: f64, samples_g: Vec<f64>) -> Accelerogram {
    Accelerogram::try_new("ground", dt_s, samples_g).expect("a record")
}

fn floor(period_s: f64, damping: f64, height_ratio: f64) -> Floor {
    Floor::try_new(period_s, damping, height_ratio).expect("a floor")
}

/// Ten cycles of a sine at 0.01 s, as the mode resonates with.
fn resonant(period_s: f64) -> Accelerogram {
    let at = |i: u32| 0.1 * libm::sin(TAU * 0.01 * f64::from(i) / period_s);
    record(0.01, (0..=(1e3 * period_s) as u32).map(at).collect())
}

#[test]
fn what_is_no_floor_is_refused() {
    for period in [0.0, -1.0, 9e-4, 20.1, f64::INFINITY, f64::NAN] {
        let found = Floor::try_new(period, 0.05, 1.0);
        assert!(matches!(found, Err(FloorError::Period(_))), "{period}");
    }
    for damping in [0.0, 0.0049, 1.0, -0.05, 5.0, f64::NAN] {
        let found = Floor::try_new(0.5, damping, 1.0);
        assert!(matches!(found, Err(FloorError::Damping(_))), "{damping}");
    }
    for ratio in [-0.1, 3.1, f64::INFINITY, f64::NAN] {
        let found = Floor::try_new(0.5, 0.05, ratio);
        assert!(matches!(found, Err(FloorError::HeightRatio(_))), "{ratio}");
    }
}

#[test]
fn work_and_accelerations_without_end_are_refused() {
    let quick = floor(1e-3, 0.05, 1.0);
    let coarse = quick.motion(&record(1e6, vec![0.0, 0.1, 0.0]));
    assert_eq!(coarse, Err(FloorError::Steps(6e10)));
    let fine = floor(20.0, 0.005, 1.0).motion(&record(1e-9, vec![0.1; 9]));
    assert!(matches!(fine, Err(FloorError::Steps(n)) if n > 1e7));
    let large = quick.motion(&record(0.01, vec![0.0, -1e308, 1e308]));
    assert!(matches!(large, Err(FloorError::Record(_))));
}

#[test]
fn a_floor_on_the_ground_has_the_bits_of_the_ground() {
    let ground = record(0.01, vec![0.1, -0.3, 0.2, 0.05]);
    assert_eq!(floor(0.5, 0.05, 0.0).motion(&ground), Ok(ground));
    let still = record(0.01, vec![0.0; 3]);
    assert_eq!(floor(0.5, 0.05, 1.4).motion(&still), Ok(still));
}

#[test]
fn free_motion_ends_after_so_many_periods_at_most() {
    let ground = record(0.01, vec![0.0, 0.2, -0.1, 0.0]);
    for (damping, most) in [(0.005, 219.9), (0.02, 55.0), (0.05, 22.0)] {
        let moved = floor(0.5, damping, 1.0).motion(&ground).unwrap();
        let periods = (moved.duration_s() - ground.duration_s()) / 0.5;
        assert!(periods > 0.9 * most && periods < most + 0.02, "{periods}");
        let samples = moved.samples_g();
        let last = samples[samples.len() - 51..].iter();
        let last = last.fold(0.0, |last: f64, a| last.max(a.abs()));
        // Within one period of the end it falls by exp(2 pi zeta).
        let least = 1e-3 * moved.pga_g();
        let ratio = last / least;
        assert!(ratio > 0.95 && ratio < libm::exp(TAU * damping) * 1.01);
    }
}

/// The error of straight lines between samples of the floor in resonance, by
/// a ground that is sampled 16 times as finely and has the same straight
/// lines.
#[test]
fn lines_between_samples_miss_the_floor_by_the_error_that_is_stated() {
    for periods in [5.0, 10.0, 20.0, 50.0] {
        let own = floor(0.01 * periods, 0.05, 1.0);
        let ground = resonant(own.period_s);
        let mut fine = vec![ground.samples_g()[0]];
        for pair in ground.samples_g().windows(2) {
            let at = |k: u32| {
                f64::from(k).mul_add((pair[1] - pair[0]) / 16.0, pair[0])
            };
            fine.extend((1..=16).map(at));
        }
        let coarse = own.motion(&ground).unwrap();
        let exact = own.motion(&record(0.01 / 16.0, fine)).unwrap();
        let mut error: f64 = 0.0;
        for (i, due) in exact.samples_g().iter().enumerate() {
            let Some([a, b]) = coarse.samples_g().get(i / 16..i / 16 + 2)
            else {
                break;
            };
            let missed = (a + (b - a) * (i % 16) as f64 / 16.0 - due).abs();
            assert!(i % 16 > 0 || missed < 1e-12);
            error = error.max(missed);
        }
        let stated = (PI / periods) * (PI / periods) / 2.0;
        let ratio = error / exact.pga_g() / stated;
        assert!(ratio > 0.8 && ratio < 1.05, "{periods}: {ratio}");
    }
}
