//! Sines of N half periods in Eq. 2: Housner's approximation for one, and
//! more than the two that the core knows as pulses.

use std::f64::consts::PI;

use anyhow::Result;

use super::closed_forms::{overturns_at_once, overturns_from};
use super::method::{Context, Reply, WrongModel, pairs};
use crate::edge::{around, edge};
use crate::oracles::overturning::sine_without_impact;
use crate::scene::{CaseScene, Forcing, Model, PulseName};

/// Least amplitude at which a sine that never ends overturns without impact:
/// Housner's for the half sine, and the limit of many half cycles.
fn semi_infinite(omega: f64) -> f64 {
    (1.0 + omega * omega).sqrt()
}

/// Housner's sqrt(1 + Omega^2) over the least amplitude at which a half sine
/// overturns.
pub fn approximation(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        omega_over_p: Vec<f64>,
        /// Block: alpha (rad), p (rad/s), g (m/s2).
        block: [f64; 3],
    }
    for &omega in &omega_over_p {
        let classic = semi_infinite(omega);
        let exact = sine_without_impact(1, omega);
        let condition =
            context.or(WrongModel::SemiInfiniteSine, classic, exact);
        let sine = (PulseName::HalfSine, omega);
        let found = overturns_from(context, sine, block, condition)?;
        answer.see("classic-over-exact", [classic / found]);
    }
    Ok(())
}

/// Least amplitudes at which sines of N half periods overturn without
/// impact. The core reads such a sine as a record, whose broken line lies
/// below the curve by the second order of the interval: extrapolated from
/// two intervals to none.
pub fn many(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        half_cycles: Vec<u32>, omega_over_p: Vec<f64>, block: [f64; 3],
        /// Intervals that a half cycle is divided into, and then into twice as
        /// many.
        intervals: u32,
    }
    for (half_cycles, omega) in pairs(&half_cycles, &omega_over_p) {
        let exact = sine_without_impact(half_cycles, omega);
        let due = context.or(
            WrongModel::SemiInfiniteSine,
            semi_infinite(omega),
            exact,
        );
        let critical = |intervals: u32| {
            edge(around(exact, 1e-3), 1e-13, |a| {
                let [alpha, p, g] = block;
                let sine = (a * (g * alpha), omega * p, half_cycles);
                let forcing = broken(sine, intervals);
                let scene = CaseScene::new(block, 0.92, forcing);
                let scene = scene.in_equation(Model::Linearized);
                overturns_at_once(context.engine, scene.until(200.0 / p))
            })
        };
        let coarse = critical(intervals)?;
        let fine = critical(2 * intervals)?;
        let found = fine + (fine - coarse) / 3.0;
        answer.put("critical-amplitude", [found], [due]);
    }
    Ok(())
}

/// A sine (amplitude in m/s2, rad/s, half periods) as a broken line with so
/// many intervals a half period.
fn broken(
    (amplitude_m_s2, omega_rad_s, half_cycles): (f64, f64, u32),
    intervals: u32,
) -> Forcing {
    let sample = |k: u32| {
        // Exact zeros where a half period ends.
        let (whole, part) = (k / intervals, k % intervals);
        let sign = if whole.is_multiple_of(2) { 1.0 } else { -1.0 };
        let phase = PI * f64::from(part) / f64::from(intervals);
        sign * amplitude_m_s2 * libm::sin(phase)
    };
    let dt_s = PI / (omega_rad_s * f64::from(intervals));
    let samples = (0..=half_cycles * intervals).map(sample);
    Forcing::samples(dt_s, samples.collect())
}
