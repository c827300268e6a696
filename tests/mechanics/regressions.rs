//! What a run says about itself, as it is: a change of these numbers is to be
//! meant.

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Model, Observe, Overturning, Response, Scene, respond,
};
use rocking::record::Accelerogram;

/// Two chirps, 3 s each.
fn record(dt_s: f64, peak_g: f64) -> Accelerogram {
    let count = (6.0 / dt_s) as usize;
    let sample = |k: usize| {
        let t = dt_s * k as f64;
        let wave = libm::sin(t * (5.0 + 2.0 * t)) + 0.4 * libm::sin(31.0 * t);
        peak_g * wave * libm::sin(0.5 * t)
    };
    let samples = (0..count).map(sample).collect();
    Accelerogram::try_new("chirp", dt_s, samples).unwrap()
}

fn scene<'a>(model: Model, excitation: Excitation<'a>) -> Scene<'a> {
    Scene {
        block: Block::try_new(0.15, 2.5).unwrap(),
        restitution: Restitution::constant(0.9).unwrap(),
        model,
        overturning: Overturning::Alpha,
        excitation,
        initial_ratio: 0.0,
    }
}

fn text(response: &Response) -> String {
    let short = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.5e}"));
    let work = response.work;
    format!(
        "{:.9e} {:.9e} {} {} {} {}/{}/{}/{}/{} {}",
        response.peak_ratio,
        response.fate_margin,
        short(response.error_estimate),
        short(response.fate_error),
        short(response.condition_number),
        if response.outcome.is_overturned() { "over" } else { "stands" },
        work.steps,
        work.impacts,
        work.turning_points,
        work.uplifts,
        work.rest_scans,
    )
}

#[test]
fn regresses_estimates_margins_and_work() {
    let observe =
        Observe { events: true, accuracy: true, ..Observe::default() };
    let mut lines = Vec::new();
    for model in [Model::Nonlinear, Model::Linearized] {
        for overturning in [Overturning::Alpha, Overturning::HalfPi] {
            for (dt_s, peak_g) in [
                (0.02, 0.2),
                (0.02, 0.5),
                (0.05, 0.25),
                (0.1, 0.35),
                (0.01, 0.16),
            ] {
                let record = record(dt_s, peak_g);
                let record = ScaledRecord::by_factor(&record, 1.0);
                let base = scene(model, Excitation::Record(record));
                let scene = Scene { overturning, ..base };
                for eta in [0.9, 1.0, 0.5] {
                    let restitution = Restitution::constant(eta).unwrap();
                    let scene = Scene { restitution, ..scene };
                    lines.push(text(&respond(&scene, &observe).unwrap()));
                }
            }
            for (amplitude_g, omega_rad_s) in
                [(0.3, 7.0), (0.5, 12.0), (0.4, 5.0), (1.3, 12.0)]
            {
                for kind in [
                    PulseKind::OneSine { amplitude_g, omega_rad_s },
                    PulseKind::RickerSymmetric {
                        amplitude_g,
                        period_s: 6.0 / omega_rad_s,
                        cycles: 3.0,
                    },
                ] {
                    let pulse = Pulse::try_new(kind).unwrap();
                    let base = scene(model, Excitation::Pulse(&pulse));
                    let scene = Scene { overturning, ..base };
                    lines.push(text(&respond(&scene, &observe).unwrap()));
                }
            }
            for initial_ratio in [0.1, 0.9] {
                let base = scene(model, Excitation::Free);
                let scene = Scene { overturning, initial_ratio, ..base };
                lines.push(text(&respond(&scene, &observe).unwrap()));
            }
        }
    }
    let expected: Vec<&str> =
        include_str!("regressions.txt").lines().collect();
    assert_eq!(lines, expected);
}
