//! Overturning edges of one-sine pulses in Eq. 2.

use anyhow::Result;

use super::edges::{Flip, OVERTURNS, OneSine, STANDS, WITHOUT_IMPACT};
use super::method::{Context, Reply, WrongModel};
use crate::edge::around;
use crate::references::{Decimal, ImpactBand, SPECTRUM, SpectrumRow};
use crate::scene::{Model, Overturning};

/// Every edge at one frequency, found again by bisecting the engine's fate
/// within 1e-6 of the reference.
pub fn edges(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        eta: f64, omega_over_p: f64,
        /// Block: alpha (rad), p (rad/s), g (m/s2).
        block: [f64; 3],
    }
    let is = |row: &&SpectrumRow| {
        (row.eta.near, row.omega.near) == (eta, omega_over_p)
    };
    let found = SPECTRUM.read()?.cases.iter().rfind(is);
    let row = found.ok_or_else(|| SPECTRUM.lacks("no such row"))?;
    let (equation, omega) = (Model::Linearized, omega_over_p);
    let pulse = OneSine { equation, block, omega, eta };
    for (name, amplitude, (mut criterion, flip)) in table(row) {
        if context.is(WrongModel::OtherCriterion) {
            criterion = match criterion {
                Overturning::Alpha => Overturning::HalfPi,
                Overturning::HalfPi => Overturning::Alpha,
            };
        }
        let whole = [1.0, 3.0 * row.mode2_lower.near];
        let near = around(amplitude, 1e-6);
        let range = context.or(WrongModel::PlainBisection, whole, near);
        let found = pulse.edge(context, (criterion, flip), range)?;
        answer.put(&name, [found], [amplitude]);
    }
    Ok(())
}

/// Names, amplitudes and fates of the edges.
fn table(row: &SpectrumRow) -> Vec<(String, f64, (Overturning, Flip))> {
    let mut edges = Vec::new();
    let mut add = |name: &str, amplitude: Decimal, criterion, flip| {
        edges.push((name.to_owned(), amplitude.near, (criterion, flip)));
    };
    let divergence = Overturning::HalfPi;
    add("mode-2", row.mode2_lower, divergence, WITHOUT_IMPACT);
    let first_sign = row.mode2_lower_alpha_criterion;
    add("mode-2-alpha", first_sign, Overturning::Alpha, WITHOUT_IMPACT);
    if let Some(lower) = row.mode1_lower {
        add("mode-1-lower", lower, divergence, OVERTURNS);
    }
    // Without loss, mode 1 goes over into mode 2: no fate flips there.
    if let Some(upper) = row.mode1_upper
        && row.eta.near < 1.0
    {
        add("mode-1-upper", upper, divergence, STANDS);
    }
    for ImpactBand { n_impacts: n, lower, upper } in &row.multi_impact_bands {
        let name = format!("{n}-impacts-lower");
        add(&name, *lower, divergence, OVERTURNS);
        let name = format!("{n}-impacts-upper");
        add(&name, *upper, divergence, STANDS);
    }
    edges
}
