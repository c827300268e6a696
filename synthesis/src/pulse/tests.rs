//! Tests of the near-fault model.

use super::*;

#[test]
fn the_published_correlation_is_definite() {
    assert!(cholesky(&CORRELATION).is_some());
}

#[test]
fn modulation_meets_its_three_times() {
    let times = [4.0, 7.0, 14.0];
    let m = Modulation::fit(times);
    for (share, t) in [0.05, 0.3, 0.95].into_iter().zip(times) {
        assert!((m.time_s(share) - t).abs() < 2e-3, "{m:?} {share}");
    }
    // The same times from the function itself, by summation.
    let step = 0.0005;
    let q: Vec<f64> =
        (0..200_000).map(|k| m.value((f64::from(k) + 0.5) * step)).collect();
    let all = q.iter().fold(0.0, |s, q| s + q * q);
    for (share, t) in [0.05, 0.3, 0.95].into_iter().zip(times) {
        let upto = (t / step).round() as usize;
        let part = q[..upto].iter().fold(0.0, |s, q| s + q * q);
        assert!((part / all - share).abs() < 5e-4, "{m:?} {share}");
    }
}

#[test]
fn modulation_without_exact_solution_is_the_nearest_one() {
    // A quarter of the energy in two seconds, then a slow decay: more than
    // a density that rises to its peak and falls can give.
    let times = [3.0, 5.0, 25.0];
    let m = Modulation::fit(times);
    let least = m.miss(times);
    assert!(least < 0.2, "{least}");
    for factor in [0.98, 1.02] {
        for other in [
            Modulation { exponent: m.exponent * factor, ..m },
            Modulation { peak_s: m.peak_s * factor, ..m },
            Modulation { decay_per_s: m.decay_per_s * factor, ..m },
        ] {
            assert!(other.miss(times) > least, "{m:?} {other:?}");
        }
    }
}

#[test]
fn the_pulse_leaves_neither_velocity_nor_displacement() {
    let pulse = Pulse {
        amplitude_m_s: 0.8,
        period_s: 2.0,
        gamma: 2.3,
        phase_rad: 1.0,
        peak_s: 3.0,
    };
    let (mut v, mut d, mut peak) = (0.0, 0.0, 0.0);
    let step = 1e-4;
    for k in 0..60_000 {
        let a = pulse.acceleration_m_s2((f64::from(k) + 0.5) * step);
        d += v * step + 0.5 * a * step * step;
        v += a * step;
        if f64::abs(v) > peak {
            peak = f64::abs(v);
        }
    }
    assert!(f64::abs(v) < 1e-6, "{v}");
    assert!(f64::abs(d) < 1e-6, "{d}");
    // The envelope bounds the velocity; the bump takes a little off.
    assert!(peak > 0.6 && peak < 0.9, "{peak}");
}

#[test]
fn medians_of_a_scenario_are_those_of_the_regression() {
    // M 7, R 5 km, Vs30 400 m/s, strike slip, 20 km towards the site; by
    // hand from the printed coefficients: ln Vp = 1.698626 + 0.608190 * 6.5
    // - 0.576217 * 2.055437 - 0.093932 * 5.991465 + 0.131418.
    let scenario = Scenario {
        earthquake: 1,
        mw: 7.0,
        rrup_km: 5.0,
        vs30_m_s: 400.0,
        reverse: false,
        towards_site_km: 20.0,
    };
    let u = mean(&scenario);
    assert!((u[0] - 4.0361).abs() < 1e-3, "{}", u[0]);
    // ln Tp = -2.479243 + 4.692769 - 1.393307 + 0.158398.
    assert!((u[1] - 0.9786).abs() < 1e-3, "{}", u[1]);
}
