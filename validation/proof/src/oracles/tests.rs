//! The oracles against references of 40 digits.

use rocking::excitation::{PulseName as N, PulseParameter as P};
use serde_json::Value;

use super::{free_rocking, linear, overturning, rectangular, square};

fn close(found: f64, wanted: f64, tolerance: f64) {
    let error = (found - wanted).abs() / wanted.abs().max(1.0);
    assert!(error <= tolerance, "{found:e} for {wanted:e}: {error:e}");
}

fn number(value: &Value) -> f64 {
    let text = value.as_str().expect("a decimal string");
    let word = text.split_whitespace().next().expect("a word");
    word.parse().expect("a number")
}

fn file(text: &str) -> Value {
    serde_json::from_str(text).expect("valid JSON")
}

fn list(value: &Value) -> &[Value] {
    value.as_array().expect("a list")
}

#[test]
fn validates_free_rocking() {
    let all = file(include_str!(
        "../../../../fixtures/references/free_rocking.json"
    ));
    for case in list(&all["cases"]) {
        let get = |key: &str| number(&case[key]);
        let (alpha, p, eta) = (get("alpha"), get("p"), get("eta"));
        let theta = get("theta0");
        let near = 1.0 / (1.0 - theta / alpha);
        for (key, free) in [
            ("nonlinear", free_rocking::nonlinear(alpha, eta, theta, 14)),
            ("linear", free_rocking::linearized(alpha, eta, theta, 14)),
        ] {
            let expected = &case[key];
            let impacts = list(&expected["impacts"]);
            assert_eq!(impacts.len(), 14);
            for (i, impact) in impacts.iter().enumerate() {
                let time = free.impact_times_p[i] / p;
                close(time, number(&impact["t"]), 1e-14 * near);
                let speed = free.impact_speeds_p[i] * p;
                let wanted = number(&impact["speed"]);
                close(speed / wanted, 1.0, 1e-14);
                let peak = number(&impact["next_peak_over_alpha"]);
                close(free.peak_ratios[i] / peak, 1.0, 1e-13);
            }
            let settling = number(&expected["settling_time"]);
            close(free.settling_p / p, settling, 1e-13 * near);
        }
    }
}

#[test]
fn validates_pulses_in_the_linear_equation() {
    let all = file(include_str!(
        "../../../../fixtures/references/linear_pulses.json"
    ));
    for case in list(&all["cases"]) {
        let get = |key: &str| number(&case[key]);
        let name = match case["pulse"].as_str().expect("a name") {
            "one_sine" => N::OneSine,
            "half_sine" => N::HalfSine,
            "one_cosine" => N::OneCosine,
            "rectangular" => N::Rectangle,
            "triangular" => N::Triangle,
            "ricker_sym" => N::RickerSymmetric,
            "ricker_anti" => N::RickerAntisymmetric,
            "mavroeidis" => N::MavroeidisPapageorgiou,
            other => panic!("pulse {other}"),
        };
        let pulse = name.kind(|parameter| -> Result<f64, ()> {
            Ok(match parameter {
                P::Amplitude => get("A"),
                P::Omega => get("Omega"),
                P::Duration => get("tau_d"),
                P::Period => get("tau_p"),
                P::Cycles => 4.0,
                P::Velocity => get("A_v"),
                P::Frequency => get("f_p"),
                P::Gamma => get("gamma"),
                P::Phase => get("nu"),
            })
        });
        let pulse = pulse.expect("a pulse");
        let found = linear::respond(pulse, get("eta"), 6);
        let expected = &case["expected"];
        let uplift = found.uplift.expect("uplift");
        close(uplift, number(&expected["uplift_tau"]), 1e-14);
        assert_eq!(found.side, expected["side"].as_f64().expect("a side"));
        let impacts = list(&expected["impacts"]);
        assert_eq!(found.impacts.len(), impacts.len(), "{case:#}");
        for (found, wanted) in found.impacts.iter().zip(impacts) {
            close(found.0, number(&wanted["tau"]), 1e-12);
            let speed = number(&wanted["phi_dot_before"]).abs();
            close(found.1 / speed, 1.0, 1e-12);
        }
        let over = &expected["tau_first_abs_phi_eq_1"];
        assert_eq!(found.overturned.is_some(), !over.is_null());
        if let Some(time) = found.overturned {
            close(time, number(over), 1e-12);
        }
    }
}

#[test]
fn validates_overturning_conditions() {
    let all = file(include_str!(
        "../../../../fixtures/references/linear_overturning_spectrum.json"
    ));
    for row in list(&all["table"]) {
        let (eta, omega) = (number(&row["eta"]), number(&row["Omega"]));
        let mode_2 = overturning::sine_without_impact(2, omega);
        close(mode_2, number(&row["mode2_lower"]), 1e-14);
        let upper = overturning::mode_1_upper(omega, eta);
        if eta < 1.0 {
            assert_eq!(upper.is_some(), !row["mode1_upper"].is_null());
            if let Some(upper) = upper {
                close(upper, number(&row["mode1_upper"]), 1e-13);
            }
        }
    }
    // Table of the mathematics, section 2.4, and of 2.3.
    for (eta, omega, a) in [
        (0.8, 4.333_889_596_488_976, 3.680_796_547_067_753),
        (0.9, 6.583_562_485_756_409, 7.584_968_505_061_99),
        (0.92, 7.460_451_116_737_134, 9.544_130_193_455_187),
        (0.98, 15.512_860_885_011_794, 38.983_943_482_641_346),
    ] {
        let fold = overturning::fold(eta);
        close(fold.0, omega, 1e-12);
        close(fold.1, a, 1e-12);
    }
    for (omega, a) in [
        (0.5, 1.109_417_823_239_134),
        (2.0, 1.800_723_930_560_746),
        (20.0, 10.785_709_408_695_77),
    ] {
        close(overturning::sine_without_impact(1, omega), a, 1e-14);
    }
}

#[test]
fn validates_rectangular_pulses() {
    let all =
        file(include_str!("../../../../fixtures/references/rect_pulse.json"));
    for case in list(&all["cases"]) {
        let get = |key: &str| number(&case[key]);
        let pulse = rectangular::Rectangular {
            alpha_rad: get("alpha"),
            frequency_rad_s: get("p"),
            pull: get("a0") / 9.81,
        };
        let y = get("y_at_td");
        close(pulse.time_s(y), get("td"), 1e-14);
        close(pulse.rotation_rad(get("td")), y, 1e-14);
        close(pulse.critical_duration_s(), get("critical_td"), 1e-14);
    }
}

/// A rectangular pulse, and stretches of silence after it.
#[test]
fn validates_square_waves() {
    let all =
        file(include_str!("../../../../fixtures/references/rect_pulse.json"));
    for case in list(&all["cases"]) {
        let get = |key: &str| number(&case[key]);
        let (p, duration_p) = (get("p"), get("td") * get("p"));
        let wave = |quiet_p: f64| square::SquareWave {
            alpha_rad: get("alpha"),
            eta: get("eta"),
            stretches: vec![
                (get("a0") / 9.81, 0.25 * duration_p),
                (get("a0") / 9.81, 0.75 * duration_p),
                (0.0, 0.5 * quiet_p),
                (0.0, 0.5 * quiet_p),
            ],
        };
        let end = wave(0.0).motion().end;
        close(end.y, get("y_at_td"), 1e-14);
        close(end.w * p, get("ydot_at_td"), 1e-14);
        if case["outcome"] == "overturns" {
            // On the way out it is nowhere turned back.
            let ending = wave(0.0).ending(end);
            assert_eq!((ending.overturned, ending.impact), (end.side, None));
            continue;
        }
        let impacts = list(&case["impacts"]);
        let last = impacts.last().expect("an impact");
        let after = number(&last["t"]) * p - duration_p;
        let motion = wave(after + 1e-9).motion();
        assert_eq!(motion.impacts.len(), impacts.len());
        for (found, impact) in motion.impacts.iter().zip(impacts) {
            close(found.0 / p, number(&impact["t"]), 1e-13);
            close(found.1 * p, number(&impact["speed"]), 1e-14);
        }
        let peak = get("peak_over_alpha") * get("alpha");
        close(motion.peak_rad, peak, 1e-14);
    }
}
