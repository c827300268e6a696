//! Overturning edges of one-sine pulses in Eqs. 1 and 2, the opening of the
//! safe bay, grazing uplift, and properties of blocks.

use anyhow::{Context as _, Result};
use rocking::block::{Block, Restitution};
use serde::Deserialize;

use super::method::{Context, Reply, WrongModel, pairs};
use crate::edge::{self, around};
use crate::oracles::overturning;
use crate::references::{Decimal, ImpactBand, SPECTRUM, SpectrumRow};
use crate::scene::{
    CaseScene, Forcing, Model, Overturning, PulseName, Trace, by_criterion,
    by_equation,
};

/// A property of every run above an edge and of none below it.
type Flip = fn(&Trace) -> bool;

/// The block overturns without an impact; below, it does not, or does so
/// after an impact.
pub(super) const WITHOUT_IMPACT: Flip =
    |trace| trace.overturned_s.is_some() && trace.impacts.is_empty();
/// The block overturns.
const OVERTURNS: Flip = |trace| trace.overturned_s.is_some();
/// The block survives.
const STANDS: Flip = |trace| trace.overturned_s.is_none();

/// An edge of Eq. 2 by its name in the cases.
#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Edge {
    Mode1,
    Mode2,
    Mode2Alpha,
}

impl Edge {
    fn flip(self) -> (Overturning, Flip) {
        match self {
            Self::Mode1 => (Overturning::HalfPi, OVERTURNS),
            Self::Mode2 => (Overturning::HalfPi, WITHOUT_IMPACT),
            Self::Mode2Alpha => (Overturning::Alpha, WITHOUT_IMPACT),
        }
    }
}

/// A one-sine pulse on a block.
struct OneSine {
    equation: Model,
    /// alpha (rad), p (rad/s), g (m/s2).
    block: [f64; 3],
    /// Frequency over p.
    omega: f64,
    eta: f64,
}

impl OneSine {
    /// The amplitude over the threshold at which the outcome changes within a
    /// range; not a number if it does not.
    fn edge(
        &self,
        context: &Context,
        (criterion, flip): (Overturning, Flip),
        range: [f64; 2],
    ) -> Result<f64> {
        let p = self.block[1];
        // A block stays on the saddle for at most 28/p if the amplitude is
        // 1e-12 from the edge.
        let scene = CaseScene::new(self.block, self.eta, Forcing::NONE)
            .in_equation(self.equation)
            .to(criterion)
            .until((7.0 / self.omega + 100.0) / p);
        edge::edge(range, 1e-12, |amplitude| {
            let scene = scene.clone().under(|threshold| {
                let (a, omega) = (amplitude * threshold, self.omega * p);
                Forcing::pulse(PulseName::OneSine, a, omega)
            });
            Ok(flip(&context.engine.respond(&scene)?))
        })
    }
}

/// Relative change of an edge of Eq. 1, over g tan(alpha), against that of
/// Eq. 2, over g alpha; eta 0.92.
pub fn defect(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        edge: Edge, omega_over_p: f64,
        /// The edge in Eq. 2, over g alpha.
        linear: f64,
        slenderness_rad: Vec<f64>,
    }
    let (equation, omega) = (Model::Nonlinear, omega_over_p);
    for &alpha in &slenderness_rad {
        let block = [alpha, 2.0, 9.81];
        let pulse = OneSine { equation, block, omega, eta: 0.92 };
        let found = pulse.edge(context, edge.flip(), around(linear, 0.03))?;
        answer.see("change", [found / linear - 1.0]);
    }
    Ok(())
}

/// The frequency at which the two edges of the bay meet, by |theta| >= alpha:
/// the upper edge of mode 1 and the lower edge of mode 2.
pub fn bay(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; eta: f64, omega_over_p: f64, block: [f64; 3]);
    let (equation, omega) = (Model::Linearized, omega_over_p);
    let pulse = OneSine { equation, block, omega, eta };
    let upper = overturning::mode_1_upper(omega, eta);
    let upper = upper.context("no mode 1")?;
    for (name, flip) in [
        ("mode-1-upper", (Overturning::HalfPi, STANDS)),
        ("mode-2-by-alpha", Edge::Mode2Alpha.flip()),
    ] {
        let found = pulse.edge(context, flip, around(upper, 1e-5))?;
        answer.see(name, [found]);
    }
    Ok(())
}

/// Grazing uplift: with w = sqrt(2 eps)/Omega the block lifts w before the
/// crest, peaks 2 w and lands 3 w after it; the peak is
/// (9/2) eps^2 k/Omega^2 and the landing speed (8/3) (2 eps)^(3/2) k/Omega,
/// k = sin(alpha)/alpha in Eq. 1 and 1 in Eq. 2. To leading order in w.
pub fn grazing(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        equation: Model, slenderness_rad: Vec<f64>, omega_over_p: f64,
        /// Amplitude over the threshold, less 1.
        excess: Vec<f64>,
    }
    let (p, omega) = (2.0, omega_over_p);
    for (alpha, excess) in pairs(&slenderness_rad, &excess) {
        let scene = CaseScene::at_rest([alpha, p], 0.92).in_equation(equation);
        let scene = scene.under(|threshold| {
            let amplitude = (1.0 + excess) * threshold;
            Forcing::pulse(PulseName::HalfSine, amplitude, omega * p)
        });
        let k = by_equation(equation, libm::sin(alpha) / alpha, 1.0);
        let trace = context.engine.respond(&scene)?;
        let crest = 0.5 * std::f64::consts::PI / omega;
        let w = (2.0 * excess).sqrt() / omega;
        let peak = 4.5 * excess * excess * k / (omega * omega);
        let e = 2.0 * excess;
        let speed = 8.0 / 3.0 * e * e.sqrt() * k / omega;
        let first = trace.impacts.first();
        let after = |t: Option<f64>| (t.unwrap_or(f64::NAN) * p - crest) / w;
        let landing = first.map_or(f64::NAN, |i| i.speed_before_rad_s);
        for (name, seen, due) in [
            ("uplift", after(trace.uplift_s), -1.0),
            ("peak-time", after(trace.peak_time_s), 2.0),
            ("landing", after(first.map(|i| i.time_s)), 3.0),
            ("peak", trace.peak_ratio / peak, 1.0),
            ("landing-speed", landing / (p * alpha * speed), 1.0),
        ] {
            answer.put(name, [seen], [due]);
        }
    }
    Ok(())
}

/// Table 1 of the paper: R, 2b and 2h from alpha and p.
pub fn sizes(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; slenderness_rad: Vec<f64>, frequency_rad_s: f64);
    for &alpha in &slenderness_rad {
        let scene = CaseScene::at_rest([alpha, frequency_rad_s], 0.92);
        let scene = context.altered(&scene);
        let (alpha, p) = (scene.slenderness_rad, scene.frequency_rad_s);
        let size = Block::try_new(alpha, p)?.dimensions(scene.gravity_m_s2)?;
        for (name, value) in [
            ("half-diagonal-m", size.half_diagonal_m),
            ("width-m", size.width_m),
            ("height-m", size.height_m),
        ] {
            answer.see(name, [value]);
        }
    }
    Ok(())
}

/// Housner's coefficient of restitution, and the energy that an impact with
/// a constant one takes.
pub fn restitution(context: &Context, answer: &mut Reply) -> Result<()> {
    input!(context; slenderness_rad: Vec<f64>, eta: f64);
    for &alpha in &slenderness_rad {
        let scene = context.altered(&CaseScene::at_rest([alpha, 1.0], eta));
        let block = Block::try_new(scene.slenderness_rad, 1.0);
        let housner = Restitution::housner(&block?);
        answer.see("housner", [housner?.velocity_ratio()]);
        let constant = Restitution::constant(scene.restitution)?;
        answer.see("energy-loss", [1.0 - constant.energy_ratio()]);
    }
    Ok(())
}

/// Every edge at one frequency, by bisection of the engine's outcome
/// within 1e-6 of the reference.
pub fn spectrum(context: &Context, answer: &mut Reply) -> Result<()> {
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
            let (alpha, half_pi) = (Overturning::Alpha, Overturning::HalfPi);
            criterion = by_criterion(criterion, half_pi, alpha);
        }
        let whole = [1.0, 3.0 * row.mode2_lower.near];
        let near = around(amplitude, 1e-6);
        let range = context.or(WrongModel::PlainBisection, whole, near);
        let found = pulse.edge(context, (criterion, flip), range)?;
        answer.put(&name, [found], [amplitude]);
    }
    Ok(())
}

/// Names, amplitudes and outcomes of the edges.
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
    // Without loss, mode 1 merges into mode 2: no outcome changes there.
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
