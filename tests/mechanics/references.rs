//! Values of 36 digits and more from outside: `fixtures/references`.

use serde_json::Value;

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Model, Observe, Outcome, Overturning, Response, Scene, respond,
};

const GRAVITY: f64 = 9.81;

macro_rules! fixture {
    ($name:literal) => {
        serde_json::from_str::<Value>(include_str!(concat!(
            "../../fixtures/references/",
            $name
        )))
        .unwrap()
    };
}

/// Numbers are texts, so that none is rounded twice.
fn number(value: &Value) -> f64 {
    match value {
        Value::String(text) => text.parse().unwrap(),
        other => other.as_f64().unwrap_or_else(|| panic!("{other}")),
    }
}

fn list(value: &Value) -> &[Value] {
    value.as_array().map_or(&[], Vec::as_slice)
}

fn cases(file: &Value) -> &[Value] {
    let cases = list(&file["cases"]);
    assert!(cases.len() > 4);
    cases
}

/// A pulse of a trajectory, in m/s2.
fn pulse(forcing: &Value) -> Option<PulseKind> {
    let get = |key: &str| number(&forcing[key]);
    Some(match forcing["kind"].as_str().unwrap() {
        "one_sine" => PulseKind::OneSine {
            amplitude: get("a_p"),
            omega_rad_s: get("omega"),
        },
        "half_sine" => PulseKind::HalfSine {
            amplitude: get("a_p"),
            omega_rad_s: get("omega"),
        },
        "one_cosine" => PulseKind::OneCosine {
            amplitude: get("a_p"),
            omega_rad_s: get("omega"),
        },
        "rectangular" => PulseKind::Rectangle {
            amplitude: get("a_p"),
            duration_s: get("t_d"),
        },
        "triangular" => PulseKind::Triangle {
            amplitude: get("a_p"),
            duration_s: get("t_d"),
        },
        "ricker_sym" => PulseKind::RickerSymmetric {
            amplitude: get("a_p"),
            period_s: get("T_p"),
            cycles: get("n_Tp"),
        },
        "ricker_anti" => PulseKind::RickerAntisymmetric {
            amplitude: get("a_p"),
            period_s: get("T_p"),
            cycles: get("n_Tp"),
        },
        "mavroeidis" => PulseKind::MavroeidisPapageorgiou {
            velocity: get("A_v"),
            frequency_hz: get("f_p"),
            gamma: get("gamma"),
            phase_rad: get("nu"),
        },
        "sampled" => return None,
        other => panic!("{other}"),
    })
}

/// A bound of a comparison: 100 times what a good code in double precision
/// attains, 1e-12 at least.
fn bound(case: &Value, key: &str) -> f64 {
    let attainable = &case["attainable_float64"][key];
    let size = if attainable.is_null() { 0.0 } else { number(attainable) };
    (100.0 * size).max(1e-12)
}

fn near(what: &str, found: f64, expected: f64, tolerance: f64) {
    let gap = (found - expected).abs();
    assert!(
        gap <= tolerance,
        "{what}: {found} {expected} {gap:e} {tolerance:e}"
    );
}

struct Trajectory<'a> {
    case: &'a Value,
    name: &'a str,
    p: f64,
}

impl Trajectory<'_> {
    fn near(&self, what: &str, found: f64, expected: f64, tolerance: f64) {
        let what = format!("{} {what}", self.name);
        near(&what, found, expected, tolerance);
    }

    fn check(&self, criterion: Overturning, response: &Response) {
        let expected = &self.case["expected"];
        let name = self.name;
        let times = bound(self.case, "t_impact_max_abs_err_times_p") / self.p;
        let uplifts = list(&expected["uplifts"]);
        assert_eq!(
            response.uplift_time_s.is_some(),
            !uplifts.is_empty(),
            "{name}"
        );
        if let Some(uplift) = uplifts.first() {
            let found = response.uplift_time_s.unwrap();
            self.near("uplift", found, number(&uplift["t"]), 1e-12);
        }
        let impacts = list(&expected["impacts"]);
        let speeds = bound(self.case, "v_impact_max_rel_err");
        let mut count = 0;
        for (found, impact) in response.impacts.iter().zip(impacts) {
            let time = number(&impact["t"]);
            self.near("impact", found.time_s, time, times * time.max(1.0));
            let speed = number(&impact["theta_dot_before"]).abs();
            let found = found.speed_before_rad_s;
            self.near("speed", found, speed, speeds * speed);
            count += 1;
        }
        let (overturns, at) = match criterion {
            Overturning::Alpha => {
                ("first_reaches_alpha", "t_first_abs_theta_eq_alpha")
            }
            Overturning::HalfPi => {
                ("overturned_pi_over_2", "t_abs_theta_eq_pi_over_2")
            }
        };
        let overturns = expected[overturns].as_bool().unwrap();
        assert_eq!(response.outcome.is_overturned(), overturns, "{name}");
        if let Outcome::Overturned { time_s, .. } = response.outcome {
            let bound = bound(self.case, "t_alpha_abs_err_times_p");
            self.near("end", time_s, number(&expected[at]), bound / self.p);
            let before = &expected["n_impacts_before_that"];
            if criterion == Overturning::Alpha {
                assert_eq!(count as f64, number(before), "{name}");
            }
            return;
        }
        assert_eq!(count, impacts.len(), "{name}");
        let peak = &expected["peak_abs_theta_over_alpha"];
        if uplifts.is_empty() {
            assert_eq!(response.outcome, Outcome::NoUplift, "{name}");
            return;
        }
        let tolerance = bound(self.case, "peak_rel_err");
        let peak = number(peak);
        self.near("peak", response.peak_ratio, peak, tolerance * peak);
        // None where a decision is within the errors of double precision.
        let graze = name.contains("graze");
        assert!(graze || response.error_estimate.is_some(), "{name}");
        if let Some(error) = response.error_estimate {
            self.near("estimate", response.peak_ratio, peak, error);
        }
        let at = number(&expected["t_peak"]);
        // Two peaks of this one are equal but for rounding.
        if name != "os-graze-1e-3-linear" {
            let found = response.peak_time_s.unwrap();
            self.near("peak time", found, at, 1e-6);
        }
        let rests = list(&expected["rest_times"]);
        if let Some(rest) = rests.last() {
            let found = response.rest_time_s.unwrap();
            self.near("rest", found, number(rest), 1e3 * times);
        }
    }
}

#[test]
fn trajectories_are_met() {
    let file = fixture!("trajectories.json");
    let records = fixture!("records.json");
    for case in cases(&file) {
        // Double precision can't tell the threshold of the one, and the fate
        // of the other.
        let told = &case["attainable_float64"]["alpha_verdict_ok"];
        let name = case["name"].as_str().unwrap();
        let untold = name == "adv-touch-ulp-above"
            || name.starts_with("smp-A-divflip")
            || told == false;
        if untold {
            continue;
        }
        let get = |key: &str| number(&case[key]);
        let forcing = &case["forcing"];
        let pulse =
            pulse(forcing).map(|k| Pulse::try_new_si(k, GRAVITY).unwrap());
        let of_record = match forcing["acc"].is_array() {
            true => &forcing["acc"],
            false => &records[forcing["record"].as_str().unwrap_or("")]["acc"],
        };
        let samples: Vec<f64> = list(of_record).iter().map(number).collect();
        let excitation = match &pulse {
            Some(pulse) => Excitation::Pulse(pulse),
            None => {
                let dt_s = number(&forcing["dt"]);
                Excitation::Record(
                    ScaledRecord::try_new_si(&samples, dt_s, GRAVITY).unwrap(),
                )
            }
        };
        let trajectory = Trajectory { case, name, p: get("p") };
        for overturning in [Overturning::Alpha, Overturning::HalfPi] {
            let scene = Scene {
                block: Block::try_new(get("alpha"), get("p")).unwrap(),
                restitution: Restitution::constant(get("eta")).unwrap(),
                model: match case["model"].as_str().unwrap() {
                    "linear" => Model::Linearized,
                    _ => Model::Nonlinear,
                },
                overturning,
                excitation,
                initial_ratio: 0.0,
            };
            let observe =
                Observe { events: true, accuracy: true, ..Observe::default() };
            let response = respond(&scene, &observe).unwrap();
            trajectory.check(overturning, &response);
        }
    }
}

fn observe() -> Observe {
    Observe { events: true, accuracy: true, ..Observe::default() }
}

#[test]
fn free_rocking_is_met() {
    for case in cases(&fixture!("free_rocking.json")) {
        let get = |key: &str| number(&case[key]);
        for (model, key) in
            [(Model::Nonlinear, "nonlinear"), (Model::Linearized, "linear")]
        {
            let scene = Scene {
                block: Block::try_new(get("alpha"), get("p")).unwrap(),
                restitution: Restitution::constant(get("eta")).unwrap(),
                model,
                overturning: Overturning::Alpha,
                excitation: Excitation::Free,
                initial_ratio: get("theta0") / get("alpha"),
            };
            let response = respond(&scene, &observe()).unwrap();
            let expected = &case[key];
            // Near the saddle the ratio's rounding is what counts.
            let room = 1.0 - scene.initial_ratio;
            let tolerance = 1e-14 + 1e-15 / room;
            let impacts = list(&expected["impacts"]);
            assert!(
                impacts.len() > 5 && impacts.len() <= response.impacts.len()
            );
            for (found, impact) in response.impacts.iter().zip(impacts) {
                let (t, v) = (number(&impact["t"]), number(&impact["speed"]));
                near("time", found.time_s, t, 10.0 * tolerance * t);
                near("speed", found.speed_before_rad_s, v, tolerance * v);
            }
            let end = number(&expected["settling_time"]);
            let found = response.rest_time_s.unwrap();
            near("settling", found, end, (1e-9 + tolerance) * end);
            assert_eq!(response.peak_ratio, scene.initial_ratio);
            assert_eq!(response.peak_time_s, Some(0.0));
            // The second peak, from a release at the top of the first.
            let top = number(&impacts[0]["next_peak_over_alpha"]);
            let again = Scene { initial_ratio: top, ..scene };
            let again = respond(&again, &observe()).unwrap();
            let speed = again.impacts[0].speed_before_rad_s;
            let v = number(&impacts[1]["speed"]);
            near("speed from the next peak", speed, v, 1e-13 * v);
        }
    }
}

#[test]
fn rectangular_pulses_are_met() {
    for case in cases(&fixture!("rect_pulse.json")) {
        let get = |key: &str| number(&case[key]);
        let kind = PulseKind::Rectangle {
            amplitude: get("a0"),
            duration_s: get("td"),
        };
        let pulse = Pulse::try_new_si(kind, GRAVITY).unwrap();
        let scene = Scene {
            block: Block::try_new(get("alpha"), get("p")).unwrap(),
            restitution: Restitution::constant(get("eta")).unwrap(),
            model: Model::Nonlinear,
            overturning: Overturning::HalfPi,
            excitation: Excitation::Pulse(&pulse),
            initial_ratio: 0.0,
        };
        // State at the end of the pulse.
        let watched = Observe {
            history_interval_s: Some(get("td")),
            until_s: Some(1.5 * get("td")),
            ..observe()
        };
        let history = respond(&scene, &watched).unwrap().history;
        assert_eq!(history.len(), 2);
        near("y", -history[1].rotation_rad, get("y_at_td"), 1e-14);
        near("y'", -history[1].velocity_rad_s, get("ydot_at_td"), 1e-13);
        let response = respond(&scene, &observe()).unwrap();
        if case["outcome"] == "overturns" {
            let Outcome::Overturned { time_s, side } = response.outcome else {
                panic!("stands");
            };
            assert_eq!(side.sign(), -1.0);
            near("end", time_s, get("t_theta_eq_pi_over_2"), 1e-12);
            let alpha = Scene { overturning: Overturning::Alpha, ..scene };
            let Outcome::Overturned { time_s, .. } =
                respond(&alpha, &observe()).unwrap().outcome
            else {
                panic!("stands");
            };
            near("alpha", time_s, get("t_theta_eq_alpha"), 1e-12);
            continue;
        }
        near("peak", response.peak_ratio, get("peak_over_alpha"), 1e-13);
        near("when", response.peak_time_s.unwrap(), get("t_peak"), 1e-12);
        let impacts = list(&case["impacts"]);
        assert!(impacts.len() > 3);
        for (found, impact) in response.impacts.iter().zip(impacts) {
            let (t, v) = (number(&impact["t"]), number(&impact["speed"]));
            near("time", found.time_s, t, 1e-12);
            near("speed", found.speed_before_rad_s, v, 1e-13);
        }
    }
}
