//! The numerical error of the energy in flight, and the work of a run.

use anyhow::Result;
use rocking::integrator::Observe;

use super::method::{Context, Reply, WrongModel, pairs};
use crate::engine;
use crate::references;
use crate::scene::{
    CaseScene, Forcing, Model, Overturning, by_equation, other,
};

/// Energy above the base over that of the saddle, along a history in free
/// flight, divided by eta^2 for each impact: it keeps its value at the end of
/// the pulse.
pub fn energy(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, frequency_rad_s: Vec<f64>,
        restitution: f64,
        /// Pulse that sets the block in motion: acceleration over the
        /// threshold, and duration times p.
        intensity: f64,
        duration_p: f64,
    }
    let wrong = WrongModel::EnergyOfTheOtherEquation;
    let law = context.or(wrong, other(equation), equation);
    for (alpha, p) in pairs(&slenderness_rad, &frequency_rad_s) {
        // A record of a rectangle and then of zeros: the block flies
        // through intervals of silence, step by step.
        let dt_s = 0.02 / p;
        let on = (duration_p / 0.02).round() as usize;
        let scene = CaseScene::at_rest([alpha, p], restitution)
            .in_equation(equation)
            .until((duration_p + 12.0) / p)
            .under(|threshold| {
                let mut samples = vec![intensity * threshold; on];
                samples.resize(on + 800, 0.0);
                Forcing::samples(dt_s, samples)
            });
        let observe = Observe {
            events: true,
            history_interval_s: Some(0.013 / p),
            ..Observe::default()
        };
        let run = engine::respond(&scene, &observe)?;
        let quiet_s = (on + 1) as f64 * dt_s;
        let eta2 = restitution * restitution;
        let eta2 = context.or(WrongModel::EtaOnceInEnergy, restitution, eta2);
        let mut start = None;
        let mut deviation: f64 = 0.0;
        for point in run.history.iter().filter(|p| p.time_s >= quiet_s) {
            let times = run.impacts.iter().map(|i| i.time_s);
            let met = times.filter(|t| *t >= quiet_s && *t <= point.time_s);
            let gain = met.fold(1.0, |gain, _| gain * eta2);
            let u = point.rotation_rad.abs();
            let w = point.velocity_rad_s / p;
            let e = level(law, alpha, u, w) / gain;
            let reference = *start.get_or_insert(e);
            let saddle = level(law, alpha, alpha, 0.0);
            deviation = deviation.max((e - reference).abs() / saddle);
        }
        let deviation = start.map_or(f64::NAN, |_| deviation);
        answer.put("energy-drift-over-saddle", [deviation], [0.0]);
    }
    Ok(())
}

/// Energy above the base: w^2/2 + 2 sin(u/2) sin(alpha - u/2), or
/// w^2/2 + u (alpha - u/2).
fn level(equation: Model, alpha: f64, u: f64, w: f64) -> f64 {
    let turned = 2.0 * libm::sin(0.5 * u) * libm::sin(alpha - 0.5 * u);
    0.5 * w * w + by_equation(equation, turned, u * (alpha - 0.5 * u))
}

/// Work of runs of reference trajectories.
pub fn work(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; entries: Vec<String>);
    for entry in &entries {
        let case = references::trajectory(entry)?;
        let scene = context.altered(&case.scene(Overturning::Alpha)?);
        let work = engine::respond(&scene, &Observe::default())?.work;
        for (name, count) in [
            ("steps", work.steps),
            ("impacts", work.impacts),
            ("turning-points", work.turning_points),
            ("uplifts", work.uplifts),
            ("rest-scans", work.rest_scans),
        ] {
            answer.see(name, [count as f64]);
        }
    }
    Ok(())
}
