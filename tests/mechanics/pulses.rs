//! Every pulse drives the block as its formula says: against a plain
//! Runge-Kutta integration written out here.

use std::f64::consts::{FRAC_PI_2, PI, TAU};

use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind};
use rocking::integrator::{Model, Observe, Overturning, Scene, respond};

use super::compare::near;

const ALPHA: f64 = 0.3;
const P: f64 = 1.5;

type Formula = Box<dyn Fn(f64) -> f64>;

/// Pulses, their end, a place where they have a kink, and a(t)/g.
fn pulses() -> Vec<(PulseKind, f64, Formula)> {
    let a = 0.07;
    let w = 9.0;
    let sine = move |t: f64| a * libm::sin(w * t);
    let (period_s, cycles) = (0.3, 3.0);
    let centre = 0.5 * cycles * period_s;
    let symmetric = move |t: f64| {
        let x = 2.0_f64.sqrt() * PI * (t - centre) / period_s;
        a * (1.0 - x * x) * libm::exp(-0.5 * x * x)
    };
    let antisymmetric = move |t: f64| {
        let x = TAU * (t - centre) / (3.0_f64.sqrt() * period_s);
        let r = 3.0 - 6.0_f64.sqrt();
        let beta = 6.0_f64.sqrt() * r.sqrt() * libm::exp(-0.5 * r);
        a / beta * (x * x - 3.0) * x * libm::exp(-0.5 * x * x)
    };
    let (f, gamma, phase) = (1.7, 1.6, 0.8);
    // v = (V/2) (1 + cos(2 pi f u/gamma)) cos(2 pi f u + nu), derived.
    let mavroeidis = move |t: f64| {
        let u = t - 0.5 * gamma / f;
        let (slow, fast) = (TAU * f / gamma, TAU * f);
        -0.5 * 0.03
            * (slow * libm::sin(slow * u) * libm::cos(fast * u + phase)
                + (1.0 + libm::cos(slow * u))
                    * fast
                    * libm::sin(fast * u + phase))
    };
    vec![
        (
            PulseKind::OneSine { amplitude: a, omega_rad_s: w },
            TAU / w,
            Box::new(sine),
        ),
        (
            PulseKind::HalfSine { amplitude: a, omega_rad_s: w },
            PI / w,
            Box::new(sine),
        ),
        (
            PulseKind::OneCosine { amplitude: a, omega_rad_s: w },
            TAU / w,
            Box::new(move |t| a * libm::sin(w * t + FRAC_PI_2)),
        ),
        (
            PulseKind::Rectangle { amplitude: a, duration_s: 0.6 },
            0.6,
            Box::new(move |_| a),
        ),
        (
            PulseKind::Triangle { amplitude: a, duration_s: 0.8 },
            0.8,
            Box::new(move |t| a * (t / 0.4).min(2.0 - t / 0.4)),
        ),
        (
            PulseKind::RickerSymmetric { amplitude: a, period_s, cycles },
            cycles * period_s,
            Box::new(symmetric),
        ),
        (
            PulseKind::RickerAntisymmetric { amplitude: a, period_s, cycles },
            cycles * period_s,
            Box::new(antisymmetric),
        ),
        (
            PulseKind::MavroeidisPapageorgiou {
                velocity: 0.03,
                frequency_hz: f,
                gamma,
                phase_rad: phase,
            },
            gamma / f,
            Box::new(mavroeidis),
        ),
    ]
}

/// From rest at `theta` > 0, in steps none of which spans the middle or the
/// end of the pulse.
fn runge_kutta(
    model: Model,
    (theta, until): (f64, f64),
    ground: &Formula,
) -> (f64, f64) {
    let f = |y: f64, t: f64| {
        let a = ground(t);
        let x = ALPHA - y;
        match model {
            Model::Nonlinear => -P * P * (libm::sin(x) + a * libm::cos(x)),
            Model::Linearized => -P * P * (x + a),
        }
    };
    let steps = 2000;
    let h = until / f64::from(steps);
    let (mut y, mut v) = (theta, 0.0);
    for k in 0..steps {
        let t = h * f64::from(k);
        let a1 = f(y, t);
        let (y2, v2) = (y + 0.5 * h * v, v + 0.5 * h * a1);
        let a2 = f(y2, t + 0.5 * h);
        let (y3, v3) = (y + 0.5 * h * v2, v + 0.5 * h * a2);
        let a3 = f(y3, t + 0.5 * h);
        let (y4, v4) = (y + h * v3, v + h * a3);
        // The right end of a step is on its own side of a jump.
        let a4 = f(y4, t + h);
        y += h / 6.0 * (v + 2.0 * (v2 + v3) + v4);
        v += h / 6.0 * (a1 + 2.0 * (a2 + a3) + a4);
    }
    (y, v)
}

#[test]
fn pulses_drive_the_block_as_their_formulas_say() {
    for (kind, end, formula) in pulses() {
        let pulse = Pulse::try_new(kind).unwrap();
        for model in [Model::Nonlinear, Model::Linearized] {
            let scene = Scene {
                block: Block::try_new(ALPHA, P).unwrap(),
                restitution: Restitution::constant(0.9).unwrap(),
                model,
                overturning: Overturning::HalfPi,
                excitation: Excitation::Pulse(&pulse),
                initial_ratio: 0.6,
            };
            for share in [0.25, 0.5, 1.0] {
                let until = share * end;
                let observe = Observe {
                    history_interval_s: Some(until),
                    until_s: Some(1.01 * until),
                    ..Observe::default()
                };
                let history = respond(&scene, &observe).unwrap().history;
                let start = (0.6 * ALPHA, until);
                let (y, v) = runge_kutta(model, start, &formula);
                // Still on its first side.
                assert!(y > 0.0, "{kind:?}");
                let name = format!("{model:?}, {kind:?} to {share}");
                let found = &history[1];
                let what = format!("{name}: rotation, rad");
                near(what, found.rotation_rad, y, 5e-12);
                let what = format!("{name}: velocity, rad/s");
                near(what, found.velocity_rad_s, v, 5e-12);
            }
        }
    }
}
