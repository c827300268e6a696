//! Forces at the pivot, against closed forms and against how the momentum of
//! the centre of mass changes along a history.

use rocking::integrator::{Forces, Observe};

use super::method::{Answer, Context, MethodError, WrongModel};
use crate::engine;
use crate::scene::{Forcing, Model, Scene};

/// R p^2/g of a rectangle.
const ARM: f64 = 0.75;

/// The forces that the core reports, for the scene as the wrong model has it.
fn forces(context: &Context, scene: &Scene) -> Result<Forces, MethodError> {
    let observe =
        Observe { forces: true, until_s: scene.until_s, ..Observe::default() };
    let run = engine::respond(&context.altered(scene), &observe)?;
    run.forces.ok_or_else(|| MethodError::Oracle("no forces".to_owned()))
}

/// A record that goes up to `intensity` times the threshold and back.
pub(super) fn uplift(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, frequency_rad_s: f64,
        /// Peak of the record over the threshold.
        intensity: f64,
    }
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        let block = [alpha, frequency_rad_s, 9.81];
        let mut scene = Scene {
            model: equation,
            ..Scene::new(block, 0.92, Forcing::NONE)
        };
        let peak = intensity * scene.threshold_m_s2();
        let acceleration_m_s2 = vec![0.0, 0.5 * peak, peak, 0.5 * peak, 0.0];
        scene.forcing = Forcing::Samples { dt_s: 0.01, acceleration_m_s2 };
        let found = forces(context, &scene)?;
        let threshold = match scene.model {
            Model::Nonlinear => libm::tan(alpha),
            Model::Linearized => alpha,
        };
        let expected = threshold * intensity.min(1.0);
        answer.put("friction", [found.friction], [expected]);
        if intensity < 1.0 {
            answer.put(
                "least-normal",
                [found.least_normal_over_weight],
                [1.0],
            );
        }
    }
    Ok(answer)
}

/// Places at which the energy's orbit is looked at.
const PLACES: usize = 200_000;

/// Rocking without loss: one orbit, on which the energy tells velocity and
/// acceleration at every rotation.
pub(super) fn free(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, initial_ratio: Vec<f64>,
    }
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        for &initial_ratio in &initial_ratio {
            let p = 3.0;
            let scene = Scene {
                model: equation,
                until_s: Some(20.0 / p),
                ..Scene::new(
                    [alpha, p, 9.81],
                    1.0,
                    Forcing::Free { rotation_rad: initial_ratio * alpha },
                )
            };
            let found = forces(context, &scene)?;
            let top = alpha * (1.0 - initial_ratio);
            let (mut friction, mut normal) = (0.0_f64, f64::INFINITY);
            for k in 0..=PLACES {
                let part = k as f64 / PLACES as f64;
                let phi = top + (alpha - top) * part;
                let (push, speed2) = match scene.model {
                    Model::Nonlinear => (
                        -libm::sin(phi),
                        2.0 * (libm::cos(top) - libm::cos(phi)),
                    ),
                    Model::Linearized => (-phi, phi * phi - top * top),
                };
                let speed2 =
                    context.or(WrongModel::WithoutCentripetal, 0.0, speed2);
                let (s, c) = libm::sincos(phi);
                let h = ARM * (push * c + speed2 * s);
                let n = 1.0 + ARM * (push * s - speed2 * c);
                friction = friction.max(h.abs() / n);
                normal = normal.min(n);
            }
            answer.put("friction", [found.friction], [friction]);
            answer.put(
                "least-normal",
                [found.least_normal_over_weight],
                [normal],
            );
        }
    }
    Ok(answer)
}

/// Second differences of the position of the centre of mass, from the
/// rotations of a history alone: the pivot gives what they and gravity ask.
pub(super) fn momentum(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        equation: Model, blocks: Vec<[f64; 2]>, restitution: f64,
        /// Peak over the threshold, and phase of a sample in rad.
        intensity: f64,
        phase: f64, dt_p: f64, samples: usize,
        /// Interval of the differences, times p.
        interval_p: f64,
    }
    let mut answer = Answer::default();
    for &[alpha, p] in &blocks {
        let mut scene = Scene {
            model: equation,
            ..Scene::new([alpha, p, 9.81], restitution, Forcing::NONE)
        };
        let peak = intensity * scene.threshold_m_s2();
        let dt_s = dt_p / p;
        let sample = |k: usize| peak * libm::sin(phase * k as f64);
        scene.until_s = Some(1.3 * dt_s * samples as f64);
        let samples: Vec<f64> = (0..samples).map(sample).collect();
        scene.forcing =
            Forcing::Samples { dt_s, acceleration_m_s2: samples.clone() };
        let found = forces(context, &scene)?;
        let (friction, normal) =
            differences(context, &scene, &samples, interval_p / p)?;
        answer.put("friction", [found.friction], [friction]);
        answer.put("least-normal", [found.least_normal_over_weight], [normal]);
    }
    Ok(answer)
}

/// Largest |H|/N and least N/(m g) of a scene, by differences over `h`.
fn differences(
    context: &Context,
    scene: &Scene,
    samples: &[f64],
    h: f64,
) -> Result<(f64, f64), MethodError> {
    let Forcing::Samples { dt_s, .. } = scene.forcing else {
        return Err(MethodError::Oracle("no samples".to_owned()));
    };
    let (alpha, g) = (scene.slenderness_rad, scene.gravity_m_s2);
    let p = scene.frequency_rad_s;
    let observe = Observe {
        events: true,
        history_interval_s: Some(h),
        until_s: scene.until_s,
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
        let at = |k: usize| samples.get(k).copied().unwrap_or(0.0);
        let part = t / dt_s - k as f64;
        if k + 1 >= samples.len() {
            0.0
        } else {
            at(k) + part * (at(k + 1) - at(k))
        }
    };
    let mut breaks: Vec<f64> = run.impacts.iter().map(|i| i.time_s).collect();
    breaks.extend(run.uplift_time_s);
    let (mut friction, mut normal) = (0.0_f64, f64::INFINITY);
    for three in run.history.windows(3) {
        let middle = three[1].time_s;
        let broken = breaks.iter().any(|t| (t - middle).abs() <= 1.001 * h);
        // The end of the record is a step of the ground.
        let last = dt_s * (samples.len() - 1) as f64;
        let ends = (last - middle).abs() <= 1.001 * h;
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
