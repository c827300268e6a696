//! Overturning edges of one-sine pulses in Eq. 2.

use serde::Deserialize;
use serde_json::Value;

use super::references::SPECTRUM;
use super::{Answer, Context, MethodError};
use crate::proof::cases::WrongModel;
use crate::proof::scene::{Criterion, Equation, Forcing, Scene};

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
    criterion: Criterion,
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
                Criterion::Alpha => Criterion::HalfPi,
                Criterion::HalfPi => Criterion::Alpha,
            };
        }
        let is_above = |amplitude: f64| -> Result<bool, MethodError> {
            let [alpha, p, g] = input.block;
            let scene = Scene {
                slenderness_rad: alpha,
                frequency_rad_s: p,
                restitution: input.eta,
                gravity_m_s2: g,
                equation: Equation::Linearized,
                criterion,
                forcing: Forcing::Sine {
                    amplitude_m_s2: amplitude * g * alpha,
                    omega_rad_s: input.omega_over_p * p,
                    half_cycles: 2,
                },
                // The saddle holds a block for 28/p at most when the
                // amplitude is 1e-12 from the edge.
                until_s: Some((7.0 / input.omega_over_p + 100.0) / p),
            };
            let trace = context.engine.respond(&scene)?;
            let over = trace.overturned_s.is_some();
            Ok(match edge.flip {
                Flip::WithoutImpact => over && trace.impacts.is_empty(),
                Flip::Overturns => over,
                Flip::Stands => !over,
            })
        };
        let (low, high) = if context.wrong == Some(WrongModel::PlainBisection)
        {
            (1.0, 3.0 * edges[0].amplitude)
        } else {
            (edge.amplitude * (1.0 - 1e-6), edge.amplitude * (1.0 + 1e-6))
        };
        answer.put(
            &edge.name,
            vec![bisect(low, high, is_above)?],
            vec![edge.amplitude],
        );
    }
    Ok(answer)
}

/// The flip between `low` and `high`; not a number without one.
fn bisect(
    mut low: f64,
    mut high: f64,
    above: impl Fn(f64) -> Result<bool, MethodError>,
) -> Result<f64, MethodError> {
    if above(low)? || !above(high)? {
        return Ok(f64::NAN);
    }
    while high - low > 1e-12 * high {
        let mid = 0.5 * (low + high);
        if above(mid)? { high = mid } else { low = mid }
    }
    Ok(0.5 * (low + high))
}

fn table(row: &Value, eta: f64) -> Result<Vec<Edge>, MethodError> {
    let file = &SPECTRUM;
    let mut edges = Vec::new();
    let mut add = |name: &str, amplitude, criterion, flip| {
        edges.push(Edge { name: name.to_owned(), amplitude, criterion, flip });
    };
    let divergence = Criterion::HalfPi;
    add(
        "mode-2",
        file.f64(row, "mode2_lower")?,
        divergence,
        Flip::WithoutImpact,
    );
    let first_sign = file.f64(row, "mode2_lower_alpha_criterion")?;
    add("mode-2-alpha", first_sign, Criterion::Alpha, Flip::WithoutImpact);
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
