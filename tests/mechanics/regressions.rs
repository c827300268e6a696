//! What a run says about itself, as it is: a change of these numbers is to be
//! meant.

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Model, Observe, Overturning, Response, Scene, respond,
};

use super::compare::hold;

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

/// What the function below writes of a response.
const COLUMNS: &str = "peak ratio, fate margin, error estimate, least \
                       clearance, condition number, fate/steps/impacts/ \
                       turning points/uplifts, rest scans";

fn text(response: &Response) -> String {
    let short = |x: Option<f64>| x.map_or("-".into(), |x| format!("{x:.5e}"));
    let work = response.work;
    format!(
        "{:.9e} {:.9e} {} {} {} {}/{}/{}/{}/{} {}",
        response.peak_ratio,
        response.fate_margin,
        short(response.error_estimate),
        short(response.certificate.map(|c| c.least().ratio)),
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
    let mut put = |scene: &Scene<'_>, motion: String| {
        let Scene { model, overturning, restitution, .. } = scene;
        let eta = restitution.velocity_ratio();
        let name =
            format!("{model:?} to {overturning:?}, {motion}, eta {eta}");
        lines.push((name, text(&respond(scene, &observe).unwrap())));
    };
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
                    put(&scene, format!("chirp {dt_s} s, {peak_g} g"));
                }
            }
            for (amplitude, omega_rad_s) in
                [(0.3, 7.0), (0.5, 12.0), (0.4, 5.0), (1.3, 12.0)]
            {
                for kind in [
                    PulseKind::OneSine { amplitude, omega_rad_s },
                    PulseKind::RickerSymmetric {
                        amplitude,
                        period_s: 6.0 / omega_rad_s,
                        cycles: 3.0,
                    },
                ] {
                    let pulse = Pulse::try_new(kind).unwrap();
                    let base = scene(model, Excitation::Pulse(&pulse));
                    let scene = Scene { overturning, ..base };
                    put(&scene, format!("{kind:?}"));
                }
            }
            for initial_ratio in [0.1, 0.9] {
                let base = scene(model, Excitation::Free);
                let scene = Scene { overturning, initial_ratio, ..base };
                put(&scene, format!("released at {initial_ratio} alpha"));
            }
        }
    }
    hold("regressions.txt", COLUMNS, &lines);
}

/// Short records of steps, plateaus about the threshold and spikes.
fn short(seed: u64) -> Vec<f64> {
    let mut state = seed.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
    let mut draw = || {
        state = state
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (state >> 40) as f64 / 16_777_216.0
    };
    let mut out = vec![0.0];
    for _ in 0..8 {
        let level = match (draw() * 4.0) as u32 {
            0 => 0.15 * (0.6 + 0.8 * draw()),
            1 => -0.15 * (0.6 + 0.8 * draw()),
            2 => 0.0,
            _ => 0.9 * draw() - 0.45,
        };
        let times = 1 + (draw() * 3.0) as usize;
        out.extend(vec![level; times]);
    }
    out
}

#[test]
fn regresses_the_sums_of_many_short_runs() {
    let mut lines = Vec::new();
    for group in 0..16_u64 {
        let model = [Model::Nonlinear, Model::Linearized][group as usize % 2];
        let events = group % 4 < 2;
        let observe = Observe { events, ..Observe::default() };
        let (mut work, mut sums) = ([0; 5], [0.0; 3]);
        for k in 0..40 {
            let seed = 40 * group + k;
            let dt_s = 0.01 + 0.002 * (seed % 37) as f64;
            let record =
                Accelerogram::try_new("short", dt_s, short(seed)).unwrap();
            let record = ScaledRecord::by_factor(&record, 1.0);
            let base = scene(model, Excitation::Record(record));
            let eta = 0.3 + 0.02 * (seed % 33) as f64;
            let restitution = Restitution::constant(eta).unwrap();
            let scene = Scene { restitution, ..base };
            let response = respond(&scene, &observe).unwrap();
            let w = response.work;
            let counts = [
                w.steps,
                w.impacts,
                w.turning_points,
                w.uplifts,
                w.rest_scans,
            ];
            for (sum, count) in work.iter_mut().zip(counts) {
                *sum += count;
            }
            sums[0] += response.peak_ratio;
            sums[1] += response.fate_margin.min(9.0);
            sums[2] += response.rest_time_s.unwrap_or(0.0);
        }
        let [a, b, c] = sums.map(|x| format!("{x:.8e}"));
        let name = format!("group {group} of 40 runs, {model:?}");
        lines.push((name, format!("{work:?} {a} {b} {c}")));
    }
    let columns = "sums of steps, impacts, turning points, uplifts, rest \
                   scans, peak ratios, fate margins, times of rest (s)";
    hold("short.txt", columns, &lines);
}
