//! Overturning edges of one-sine pulses in Eq. 2.

use super::method::{Answer, Context, MethodError, WrongModel};
use crate::edge::{self, around};
use crate::references::{Band, Digits, SPECTRUM, SpectrumRow};
use crate::scene::{Forcing, Model, Overturning, PulseKind, Scene};

/// What flips at an edge.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Flip {
    /// Above, the block overturns without an impact; below, it does not, or
    /// does so after an impact.
    WithoutImpact,
    /// Above, the block overturns; below, it stands.
    Overturns,
    /// Above, the block stands; below, it overturns.
    Stands,
}

/// One edge.
struct Edge {
    name: String,
    amplitude: f64,
    criterion: Overturning,
    flip: Flip,
}

/// Every edge at one frequency, found again by bisecting the engine's fate
/// within 1e-6 of the reference.
pub(super) fn edges(context: &Context) -> Result<Answer, MethodError> {
    input! { context;
        eta: f64, omega_over_p: f64,
        /// Block: alpha (rad), p (rad/s), g (m/s2).
        block: [f64; 3],
    }
    let is = |row: &&SpectrumRow| {
        (row.eta.near, row.omega.near) == (eta, omega_over_p)
    };
    let found = SPECTRUM.read()?.table.iter().rfind(is);
    let row = found.ok_or_else(|| SPECTRUM.lacks("no such row"))?;
    let mut answer = Answer::default();
    let edges = table(row);
    for edge in &edges {
        let mut criterion = edge.criterion;
        if context.is(WrongModel::OtherCriterion) {
            criterion = match criterion {
                Overturning::Alpha => Overturning::HalfPi,
                Overturning::HalfPi => Overturning::Alpha,
            };
        }
        let is_above = |amplitude: f64| -> Result<bool, MethodError> {
            let [alpha, p, g] = block;
            let scene = Scene {
                model: Model::Linearized,
                overturning: criterion,

                // The saddle holds a block for 28/p at most when the
                // amplitude is 1e-12 from the edge.
                until_s: Some((7.0 / omega_over_p + 100.0) / p),
                ..Scene::new(
                    [alpha, p, g],
                    eta,
                    Forcing::Pulse(PulseKind::OneSine {
                        amplitude: amplitude * g * alpha,
                        omega_rad_s: omega_over_p * p,
                    }),
                )
            };
            let trace = context.engine.respond(&scene)?;
            let over = trace.overturned_s.is_some();
            Ok(match edge.flip {
                Flip::WithoutImpact => over && trace.impacts.is_empty(),
                Flip::Overturns => over,
                Flip::Stands => !over,
            })
        };
        let range = if context.is(WrongModel::PlainBisection) {
            [1.0, 3.0 * edges[0].amplitude]
        } else {
            around(edge.amplitude, 1e-6)
        };
        answer.put(
            &edge.name,
            [edge::edge(range, 1e-12, is_above)?],
            [edge.amplitude],
        );
    }
    Ok(answer)
}

fn table(row: &SpectrumRow) -> Vec<Edge> {
    let mut edges = Vec::new();
    let mut add = |name: &str, amplitude: Digits, criterion, flip| {
        let (name, amplitude) = (name.to_owned(), amplitude.near);
        edges.push(Edge { name, amplitude, criterion, flip });
    };
    let divergence = Overturning::HalfPi;
    add("mode-2", row.mode2_lower, divergence, Flip::WithoutImpact);
    let first_sign = row.mode2_lower_alpha_criterion;
    add("mode-2-alpha", first_sign, Overturning::Alpha, Flip::WithoutImpact);
    if let Some(lower) = row.mode1_lower {
        add("mode-1-lower", lower, divergence, Flip::Overturns);
    }
    // Without loss, mode 1 goes over into mode 2: no fate flips there.
    if let Some(upper) = row.mode1_upper
        && row.eta.near < 1.0
    {
        add("mode-1-upper", upper, divergence, Flip::Stands);
    }
    for Band { n_impacts: n, lower, upper } in &row.multi_impact_bands {
        let name = format!("{n}-impacts-lower");
        add(&name, *lower, divergence, Flip::Overturns);
        let name = format!("{n}-impacts-upper");
        add(&name, *upper, divergence, Flip::Stands);
    }
    edges
}
