//! Forces at the pivot, against closed forms and against how the momentum of
//! the centre of mass changes along a history.

use anyhow::{Context as _, Result, bail};
use rocking::integrator::{Forces, Observe};

use super::method::{Context, Reply, WrongModel, pairs};
use crate::engine;
use crate::scene::{CaseScene, Forcing, Model, by_equation};

/// R p^2/g of a rectangle.
const ARM: f64 = 0.75;

/// The forces by the core, for the scene with the mistake of the wrong model.
fn forces(context: &Context, scene: &CaseScene) -> Result<Forces> {
    let observe = Observe { forces: true, ..Observe::default() };
    let run = engine::respond(&context.altered(scene), &observe)?;
    run.forces.context("no forces")
}

/// A record that goes up to `intensity` times the threshold and back.
pub fn uplift(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, frequency_rad_s: f64,
        /// Peak of the record over the threshold.
        intensity: f64,
    }
    for &alpha in &slenderness_rad {
        let scene = CaseScene::at_rest([alpha, frequency_rad_s], 0.92);
        let scene = scene.in_equation(equation).under(|threshold| {
            let peak = intensity * threshold;
            let samples = vec![0.0, 0.5 * peak, peak, 0.5 * peak, 0.0];
            Forcing::samples(0.01, samples)
        });
        let found = forces(context, &scene)?;
        let threshold = by_equation(equation, libm::tan(alpha), alpha);
        let expected = threshold * intensity.min(1.0);
        answer.put("friction", [found.friction], [expected]);
        if intensity < 1.0 {
            let normal = found.least_normal_over_weight;
            answer.put("least-normal", [normal], [1.0]);
        }
    }
    Ok(())
}

/// Sampled places of the orbit.
const PLACES: usize = 200_000;

/// Rocking without loss: one orbit, on which the energy gives velocity and
/// acceleration at every rotation.
pub fn free(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, initial_ratio: Vec<f64>,
    }
    for (alpha, initial_ratio) in pairs(&slenderness_rad, &initial_ratio) {
        let p = 3.0;
        let rotation_rad = initial_ratio * alpha;
        let release = Forcing::Free { rotation_rad };
        let scene = CaseScene::new([alpha, p, 9.81], 1.0, release);
        let scene = scene.in_equation(equation).until(20.0 / p);
        let found = forces(context, &scene)?;
        let top = alpha * (1.0 - initial_ratio);
        let (mut friction, mut normal) = (0.0_f64, f64::INFINITY);
        for k in 0..=PLACES {
            let part = k as f64 / PLACES as f64;
            let phi = top + (alpha - top) * part;
            let (s, c) = libm::sincos(phi);
            let turned =
                (-libm::sin(phi), 2.0 * (libm::cos(top) - libm::cos(phi)));
            let linear = (-phi, phi * phi - top * top);
            let (push, speed2) = by_equation(equation, turned, linear);
            let wrong = WrongModel::WithoutCentripetal;
            let speed2 = context.or(wrong, 0.0, speed2);
            let h = ARM * (push * c + speed2 * s);
            let n = 1.0 + ARM * (push * s - speed2 * c);
            friction = friction.max(h.abs() / n);
            normal = normal.min(n);
        }
        answer.put("friction", [found.friction], [friction]);
        let found = found.least_normal_over_weight;
        answer.put("least-normal", [found], [normal]);
    }
    Ok(())
}

/// Second differences of the position of the centre of mass, only from the
/// rotations of a history: they and gravity give the force at the pivot.
pub fn momentum(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, blocks: Vec<[f64; 2]>, restitution: f64,
        /// Peak over the threshold, and phase of a sample in rad.
        intensity: f64,
        phase: f64, dt_p: f64, samples: usize,
        /// Interval of the differences, times p.
        interval_p: f64,
    }
    for &[alpha, p] in &blocks {
        let scene = CaseScene::at_rest([alpha, p], restitution);
        let mut scene = scene.in_equation(equation);
        let peak = intensity * scene.threshold_m_s2();
        let dt_s = dt_p / p;
        let sample = |k: usize| peak * libm::sin(phase * k as f64);
        scene.until_s = Some(1.3 * dt_s * samples as f64);
        let samples = (0..samples).map(sample).collect();
        scene.forcing = Forcing::samples(dt_s, samples);
        let found = forces(context, &scene)?;
        let (friction, normal) = differences(context, &scene, interval_p / p)?;
        answer.put("friction", [found.friction], [friction]);
        answer.put("least-normal", [found.least_normal_over_weight], [normal]);
    }
    Ok(())
}

/// Largest |H|/N and least N/(m g) of a scene, by differences over `h`.
fn differences(
    context: &Context,
    scene: &CaseScene,
    h: f64,
) -> Result<(f64, f64)> {
    let Forcing::Samples { dt_s, acceleration_m_s2 } = &scene.forcing else {
        bail!("no samples");
    };
    let last = acceleration_m_s2.len() - 1;
    let (alpha, g) = (scene.slenderness_rad, scene.gravity_m_s2);
    let p = scene.frequency_rad_s;
    let observe = Observe {
        events: true,
        history_interval_s: Some(h),
        ..Observe::default()
    };
    let run = engine::respond(scene, &observe)?;
    // The radius of a slender rod of the same p, or the block's.
    let share = context.or(WrongModel::InertiaOfAPoint, 1.0, ARM);
    let arm = share * g / (p * p);
    let place = |theta: f64| {
        let phi = alpha - theta.abs();
        let x = arm * (libm::sin(alpha) - libm::sin(phi));
        (theta.signum() * x, arm * libm::cos(phi))
    };
    let ground = |t: f64| {
        let k = (t / dt_s) as usize;
        if k < last { scene.forcing.at(k, t) } else { 0.0 }
    };
    let mut breaks: Vec<f64> = run.impacts.iter().map(|i| i.time_s).collect();
    breaks.extend(run.uplift_time_s);
    let (mut friction, mut normal) = (0.0_f64, f64::INFINITY);
    for three in run.history.windows(3) {
        let middle = three[1].time_s;
        let broken = breaks.iter().any(|t| (t - middle).abs() <= 1.001 * h);
        // The end of the record is a step of the ground.
        let ends = (dt_s * last as f64 - middle).abs() <= 1.001 * h;
        if broken || ends || three.iter().any(|q| q.rotation_rad == 0.0) {
            continue;
        }
        let [a, b, c] = [0, 1, 2].map(|k| place(three[k].rotation_rad));
        let second = |a: f64, b: f64, c: f64| (a - 2.0 * b + c) / (h * h * g);
        let horizontal = ground(middle) / g + second(a.0, b.0, c.0);
        let vertical = 1.0 + second(a.1, b.1, c.1);
        friction = friction.max(horizontal.abs() / vertical);
        normal = normal.min(vertical);
    }
    Ok((friction, normal))
}
