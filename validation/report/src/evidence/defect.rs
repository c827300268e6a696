//! Figure 19: the departure of Eq. 1 from similarity.

use rocking_common::words::range;
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Series,
};
use rocking_proof::engine::Core;
use rocking_proof::scene::{
    CaseScene, Engine as _, EngineError, Forcing, Model, Overturning,
    PulseKind,
};

/// One-sine pulses: frequency over p and amplitude over the threshold.
const PULSES: [(f64, f64); 4] =
    [(2.0, 1.15), (4.0, 1.6), (6.0, 3.5), (8.0, 6.0)];

/// Number of slendernesses; each is the one before times the square root of 2.
const SLENDERNESSES: i32 = 11;

fn slenderness_rad(k: i32) -> f64 {
    let even = libm::scalbn(0.0125, k / 2);
    if k % 2 == 0 { even } else { even * 2.0_f64.sqrt() }
}

/// The departure of Eq. 1 from similarity as alpha grows, and its order.
pub(super) fn chart() -> anyhow::Result<Figure> {
    let alphas: Vec<f64> = (0..SLENDERNESSES).map(slenderness_rad).collect();
    let mut slopes = Vec::new();
    let mut panel = |title, is_tangent| -> anyhow::Result<ChartPanel> {
        let mut series = Vec::new();
        for (omega, amplitude) in PULSES {
            let own = |alpha| departure(omega, amplitude, alpha, is_tangent);
            let y = alphas.iter().copied().map(own);
            let y = y.collect::<Result<Vec<f64>, EngineError>>()?;
            // Slope over the first octave.
            slopes.push(libm::log2(y[2] / y[0]));
            let label = format!("*ω*/*p* = {omega}, *A* = {amplitude}");
            let mark = Mark::LineAndPoints;
            series.push(Series::new(label, mark, alphas.clone(), y));
        }
        let ends = [0.0125, 0.4];
        let square = ends.map(|alpha| 0.02 * alpha * alpha);
        let square = (ends.into(), square.into());
        series.push(Series::new("slope 2", Mark::Dashed, square.0, square.1));
        let x = ChartAxis::logarithmic("slenderness *α* (rad)", (0.01, 0.5));
        let label = "|change of the first impact speed|";
        let y = ChartAxis::logarithmic(label, (1e-6, 2.0));
        Ok(ChartPanel::new(title, x, y, series))
    };
    let panels = vec![
        panel("amplitude / (*g* tan *α*)", true)?,
        panel("amplitude / (*g* *α*)", false)?,
    ];
    let heading = Heading::numbered(
        19,
        "Departure of Eq. 1 from similarity as the slenderness grows",
        "Relative change of the first impact speed divided by p alpha under \
         four one-sine pulses, against slenderness, on logarithmic axes, for \
         two normalizations of the amplitude; a dashed line has slope 2.",
        None,
    );
    let (low, high) = range(slopes.into_iter());
    Ok(Chart { heading, panels, columns: 2 }.figure(format!(
        "In Eq. 2 the response divided by alpha does not depend on alpha. In \
         Eq. 1 the departure from similarity grows with the square of alpha: \
         slopes of {low:.3} to {high:.3} between 0.0125 and 0.025 rad."
    )))
}

/// |X(alpha)/X_linear - 1| of the first impact speed over p alpha.
fn departure(
    omega: f64,
    amplitude: f64,
    alpha: f64,
    is_tangent: bool,
) -> Result<f64, EngineError> {
    let p = 2.0;
    let speed = |model| -> Result<f64, EngineError> {
        let unit = match model {
            Model::Nonlinear if is_tangent => libm::tan(alpha),
            _ => alpha,
        };
        let pulse = PulseKind::OneSine {
            amplitude: amplitude * unit,
            omega_rad_s: omega * p,
        };
        let trace = Core.respond(&CaseScene {
            model,
            overturning: Overturning::HalfPi,
            until_s: Some(20.0),
            ..CaseScene::new([alpha, p, 1.0], 0.92, Forcing::Pulse(pulse))
        })?;
        Ok(trace.impacts.first().map_or(f64::NAN, |i| i.speed_before_rad_s))
    };
    let linear = speed(Model::Linearized)?;
    Ok((speed(Model::Nonlinear)? / linear - 1.0).abs())
}
