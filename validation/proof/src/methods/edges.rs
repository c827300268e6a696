//! Overturning edges of Eq. 1 against those of Eq. 2, where the safe bay of
//! a one-sine pulse opens, and grazing uplift.

use rocking::block::{Block, BlockError, Restitution};
use serde::Deserialize;

use super::method::{Answer, Context, MethodError};
use crate::edge::{self, around};
use crate::oracles::overturning;
use crate::scene::{Forcing, Model, Overturning, PulseKind, Scene};

/// What flips at an edge.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Edge {
    /// Mode 1, lower: overturns above, by divergence.
    Mode1,
    /// Mode 1, upper: stands above, by divergence.
    Mode1Upper,
    /// Mode 2: overturns without impact above, by divergence.
    Mode2,
    /// The same by |theta| >= alpha.
    Mode2Alpha,
}

/// A one-sine pulse on a block.
struct OneSine {
    equation: Model,
    block: [f64; 3],
    omega: f64,
    eta: f64,
}

impl OneSine {
    /// Whether the amplitude over the threshold lies above the edge.
    fn is_above(
        &self,
        context: &Context,
        edge: Edge,
        amplitude: f64,
    ) -> Result<bool, MethodError> {
        let [alpha, p, g] = self.block;
        let mut scene = Scene {
            model: self.equation,
            overturning: match edge {
                Edge::Mode2Alpha => Overturning::Alpha,
                _ => Overturning::HalfPi,
            },
            until_s: Some((7.0 / self.omega + 100.0) / p),
            ..Scene::new([alpha, p, g], self.eta, Forcing::NONE)
        };
        scene.forcing = Forcing::Pulse(PulseKind::OneSine {
            amplitude: amplitude * scene.threshold_m_s2(),
            omega_rad_s: self.omega * p,
        });
        let trace = context.engine.respond(&scene)?;
        let over = trace.overturned_s.is_some();
        Ok(match edge {
            Edge::Mode1 => over,
            Edge::Mode1Upper => !over,
            Edge::Mode2 | Edge::Mode2Alpha => over && trace.impacts.is_empty(),
        })
    }

    /// The edge within `reach` of `near`; not a number where there is none.
    fn edge(
        &self,
        context: &Context,
        edge: Edge,
        near: f64,
        reach: f64,
    ) -> Result<f64, MethodError> {
        let above = |amplitude| self.is_above(context, edge, amplitude);
        edge::edge(around(near, reach), 1e-12, above)
    }
}

/// Relative change of an edge of Eq. 1, over g tan(alpha), against that of
/// Eq. 2, over g alpha; eta 0.92.
pub(super) fn defect(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        edge: Edge, omega_over_p: f64,
        /// The edge in Eq. 2, over g alpha.
        linear: f64,
        slenderness_rad: Vec<f64>,
    }
    let mut changes = Vec::new();
    for &alpha in &slenderness_rad {
        let pulse = OneSine {
            equation: Model::Nonlinear,
            block: [alpha, 2.0, 9.81],
            omega: omega_over_p,
            eta: 0.92,
        };
        let found = pulse.edge(context, edge, linear, 0.03)?;
        changes.push(found / linear - 1.0);
    }
    let mut answer = Answer::default();
    answer.see("change", changes);
    Ok(answer)
}

/// The frequency at which the two edges of the bay meet, by |theta| >= alpha:
/// the upper edge of mode 1 and the lower edge of mode 2.
pub(super) fn bay(context: &Context) -> Result<Answer, MethodError> {
    input!(context; eta: f64, omega_over_p: f64, block: [f64; 3]);
    let pulse = OneSine {
        equation: Model::Linearized,
        block,
        omega: omega_over_p,
        eta,
    };
    let upper = overturning::mode_1_upper(omega_over_p, eta)
        .ok_or_else(|| MethodError::Oracle("no mode 1".to_owned()))?;
    let mut answer = Answer::default();
    for (name, edge) in [
        ("mode-1-upper", Edge::Mode1Upper),
        ("mode-2-by-alpha", Edge::Mode2Alpha),
    ] {
        let found = pulse.edge(context, edge, upper, 1e-5)?;
        answer.see(name, [found]);
    }
    Ok(answer)
}

/// Grazing uplift: with w = sqrt(2 eps)/Omega the block lifts w before the
/// crest, peaks 2 w and lands 3 w after it; the peak is
/// (9/2) eps^2 k/Omega^2 and the landing speed (8/3) (2 eps)^(3/2) k/Omega,
/// k = sin(alpha)/alpha in Eq. 1 and 1 in Eq. 2. To leading order in w.
pub(super) fn grazing(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, omega_over_p: f64,
        /// Amplitude over the threshold, less 1.
        excess: Vec<f64>,
    }
    let p = 2.0;
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        for &excess in &excess {
            let mut scene = Scene {
                model: equation,
                ..Scene::new([alpha, p, 9.81], 0.92, Forcing::NONE)
            };
            let omega = omega_over_p;
            scene.forcing = Forcing::Pulse(PulseKind::HalfSine {
                amplitude: (1.0 + excess) * scene.threshold_m_s2(),
                omega_rad_s: omega * p,
            });
            let k = match scene.model {
                Model::Nonlinear => libm::sin(alpha) / alpha,
                Model::Linearized => 1.0,
            };
            let trace = context.engine.respond(&scene)?;
            let crest = 0.5 * std::f64::consts::PI / omega;
            let w = (2.0 * excess).sqrt() / omega;
            let peak = 4.5 * excess * excess * k / (omega * omega);
            let e = 2.0 * excess;
            let speed = 8.0 / 3.0 * e * e.sqrt() * k / omega;
            let first = trace.impacts.first();
            let after =
                |t: Option<f64>| (t.unwrap_or(f64::NAN) * p - crest) / w;
            for (name, seen, due) in [
                ("uplift", after(trace.uplift_s), -1.0),
                ("peak-time", after(trace.peak_time_s), 2.0),
                ("landing", after(first.map(|i| i.time_s)), 3.0),
                ("peak", trace.peak_ratio / peak, 1.0),
                (
                    "landing-speed",
                    first.map_or(f64::NAN, |i| i.speed_before_rad_s)
                        / (p * alpha * speed),
                    1.0,
                ),
            ] {
                answer.put(name, [seen], [due]);
            }
        }
    }
    Ok(answer)
}

fn refused(error: BlockError) -> MethodError {
    MethodError::Input(error.to_string())
}

/// Table 1 of the paper: R, 2b and 2h from alpha and p.
pub(super) fn sizes(context: &Context) -> Result<Answer, MethodError> {
    input!(context; slenderness_rad: Vec<f64>, frequency_rad_s: f64);
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        let scene = context.altered(&Scene::new(
            [alpha, frequency_rad_s, 9.81],
            0.92,
            Forcing::NONE,
        ));
        let block =
            Block::try_new(scene.slenderness_rad, scene.frequency_rad_s);
        let size = block
            .map_err(refused)?
            .dimensions(scene.gravity_m_s2)
            .map_err(refused)?;
        for (name, value) in [
            ("half-diagonal-m", size.half_diagonal_m),
            ("width-m", size.width_m),
            ("height-m", size.height_m),
        ] {
            answer.see(name, [value]);
        }
    }
    Ok(answer)
}

/// Housner's coefficient of restitution, and the energy that an impact with
/// a constant one takes.
pub(super) fn restitution(context: &Context) -> Result<Answer, MethodError> {
    input!(context; slenderness_rad: Vec<f64>, eta: f64);
    let mut answer = Answer::default();
    for &alpha in &slenderness_rad {
        let scene = context.altered(&Scene::new(
            [alpha, 1.0, 9.81],
            eta,
            Forcing::NONE,
        ));
        let block = Block::try_new(scene.slenderness_rad, 1.0);
        let housner = Restitution::housner(&block.map_err(refused)?);
        answer.see("housner", [housner.map_err(refused)?.velocity_ratio()]);
        let constant =
            Restitution::constant(scene.restitution).map_err(refused)?;
        answer.see("energy-loss", [1.0 - constant.energy_ratio()]);
    }
    Ok(answer)
}
