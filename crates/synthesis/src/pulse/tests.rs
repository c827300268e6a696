//! Tests of the near-fault model.

use super::*;

#[test]
fn the_published_correlation_is_definite() {
    assert!(cholesky(&CORRELATION).is_some());
}

#[test]
fn the_pulse_leaves_neither_velocity_nor_displacement() {
    let pulse = PulseModel {
        amplitude_m_s: 0.8,
        period_s: 2.0,
        gamma: 2.3,
        phase_rad: 1.0,
        delay_s: 0.0,
        angle_rad: 0.0,
    };
    let (mut v, mut d, mut peak) = (0.0, 0.0, 0.0);
    let step = DT_S;
    for a in &pulse.samples()[0] {
        let a = a * GRAVITY_M_S2;
        d += v * step + 0.5 * a * step * step;
        v += a * step;
        if f64::abs(v) > peak {
            peak = f64::abs(v);
        }
    }
    assert!(f64::abs(v) < 1e-4, "{v}");
    assert!(f64::abs(d) < 2e-3, "{d}");
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
