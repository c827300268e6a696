//! Overturning edges of one-sine pulses in Eq. 2.

use serde::Deserialize;
use serde_json::Value;

use super::method::{Answer, Context};
use crate::cases::WrongModel;
use crate::edge::{self, around};
use crate::error::MethodError;
use crate::references::SPECTRUM;
use crate::scene::{Forcing, Model, Overturning, PulseKind, Scene};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Input {
    eta: f64,
    omega_over_p: f64,
    /// Block: alpha (rad), p (rad/s), g (m/s2).
    block: [f64; 3],
}

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
    let input: Input = context.input()?;
    let all = SPECTRUM.read()?;
    let mut found = None;
    for row in SPECTRUM.list(&all, "table")? {
        if SPECTRUM.f64(row, "eta")? == input.eta
            && SPECTRUM.f64(row, "Omega")? == input.omega_over_p
        {
            found = Some(row);
        }
    }
    let row = found.ok_or_else(|| SPECTRUM.lacks("no such row"))?;
    let mut answer = Answer::default();
    let edges = table(row, input.eta)?;
    for edge in &edges {
        let mut criterion = edge.criterion;
        if context.wrong == Some(WrongModel::OtherCriterion) {
            criterion = match criterion {
                Overturning::Alpha => Overturning::HalfPi,
                Overturning::HalfPi => Overturning::Alpha,
            };
        }
        let is_above = |amplitude: f64| -> Result<bool, MethodError> {
            let [alpha, p, g] = input.block;
            let scene = Scene {
                model: Model::Linearized,
                overturning: criterion,

                // The saddle holds a block for 28/p at most when the
                // amplitude is 1e-12 from the edge.
                until_s: Some((7.0 / input.omega_over_p + 100.0) / p),
                ..Scene::new(
                    [alpha, p, g],
                    input.eta,
                    Forcing::Pulse(PulseKind::OneSine {
                        amplitude: amplitude * g * alpha,
                        omega_rad_s: input.omega_over_p * p,
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
        let range = if context.wrong == Some(WrongModel::PlainBisection) {
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

fn table(row: &Value, eta: f64) -> Result<Vec<Edge>, MethodError> {
    let file = &SPECTRUM;
    let mut edges = Vec::new();
    let mut add = |name: &str, amplitude, criterion, flip| {
        edges.push(Edge { name: name.to_owned(), amplitude, criterion, flip });
    };
    let divergence = Overturning::HalfPi;
    add(
        "mode-2",
        file.f64(row, "mode2_lower")?,
        divergence,
        Flip::WithoutImpact,
    );
    let first_sign = file.f64(row, "mode2_lower_alpha_criterion")?;
    add("mode-2-alpha", first_sign, Overturning::Alpha, Flip::WithoutImpact);
    if let Some(lower) = file.optional(row, "mode1_lower")? {
        add("mode-1-lower", lower, divergence, Flip::Overturns);
    }
    // Without loss, mode 1 goes over into mode 2: no fate flips there.
    if let Some(upper) = file.optional(row, "mode1_upper")?
        && eta < 1.0
    {
        add("mode-1-upper", upper, divergence, Flip::Stands);
    }
    if let Some(bands) = row.get("multi_impact_bands") {
        for band in bands.as_array().into_iter().flatten() {
            let n = file.f64(band, "n_impacts")?;
            let lower = file.f64(band, "lower")?;
            let upper = file.f64(band, "upper")?;
            add(
                &format!("{n}-impacts-lower"),
                lower,
                divergence,
                Flip::Overturns,
            );
            add(
                &format!("{n}-impacts-upper"),
                upper,
                divergence,
                Flip::Stands,
            );
        }
    }
    Ok(edges)
}
