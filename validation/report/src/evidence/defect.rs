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

/// Slendernesses, each the one before times the square root of 2.
const SLENDERNESSES: i32 = 11;

fn slenderness_rad(k: i32) -> f64 {
    let even = libm::scalbn(0.0125, k / 2);
    if k % 2 == 0 { even } else { even * 2.0_f64.sqrt() }
}

/// Order of the departure of Eq. 1 from similarity as alpha grows.
pub(super) fn chart() -> anyhow::Result<Figure> {
    let mut panels = Vec::new();
    let mut slopes = Vec::new();
    for (tangent, title) in [
        (true, "amplitude over *g* tan *α*"),
        (false, "amplitude over *g* *α*"),
    ] {
        let mut series = Vec::new();
        for (omega, amplitude) in PULSES {
            let x: Vec<f64> =
                (0..SLENDERNESSES).map(slenderness_rad).collect();
            let y = x
                .iter()
                .map(|alpha| departure(omega, amplitude, *alpha, tangent))
                .collect::<Result<Vec<f64>, EngineError>>()?;
            // Slope over the first octave.
            slopes.push(libm::log2(y[2] / y[0]));
            series.push(Series::new(
                format!("*ω*/*p* = {omega}, *A* = {amplitude}"),
                Mark::LineAndPoints,
                x,
                y,
            ));
        }
        let ends = [0.0125, 0.4];
        series.push(Series::new(
            "slope 2",
            Mark::Dashed,
            ends.into(),
            ends.map(|alpha| 0.02 * alpha * alpha).into(),
        ));
        panels.push(ChartPanel {
            title: title.into(),
            x: ChartAxis::logarithmic("slenderness *α* (rad)", (0.01, 0.5)),
            y: ChartAxis::logarithmic(
                "|change of the first impact speed|",
                (1e-6, 2.0),
            ),
            series,
        });
    }
    let (low, high) = rocking_common::words::range(slopes.into_iter());
    Ok(Chart {
        heading: Heading::numbered(
            19,
            "Departure of Eq. 1 from similarity as the \
                        slenderness grows",
            "Relative change of the first impact speed \
                              over p alpha under four one-sine pulses, \
                              against the slenderness, on logarithmic axes, \
                              for two normalizations of the amplitude; a \
                              dashed line has slope 2.",
            None,
        ),
        panels,
        columns: 2,
    }
    .figure(format!(
        "In Eq. 2 the response over alpha does not depend on alpha; in \
             Eq. 1 it departs from that with the square of alpha: slopes of \
             {low:.3} to {high:.3} between 0.0125 and 0.025 rad."
    )))
}

/// |X(alpha)/X_linear - 1| of the first impact speed over p alpha.
fn departure(
    omega: f64,
    amplitude: f64,
    alpha: f64,
    tangent: bool,
) -> Result<f64, EngineError> {
    let p = 2.0;
    let speed = |equation| -> Result<f64, EngineError> {
        let unit = match equation {
            Model::Nonlinear if tangent => libm::tan(alpha),
            _ => alpha,
        };
        let trace = Core.respond(&CaseScene {
            model: equation,
            overturning: Overturning::HalfPi,
            until_s: Some(20.0),
            ..CaseScene::new(
                [alpha, p, 1.0],
                0.92,
                Forcing::Pulse(PulseKind::OneSine {
                    amplitude: amplitude * unit,
                    omega_rad_s: omega * p,
                }),
            )
        })?;
        Ok(trace.impacts.first().map_or(f64::NAN, |i| i.speed_before_rad_s))
    };
    let linear = speed(Model::Linearized)?;
    Ok((speed(Model::Nonlinear)? / linear - 1.0).abs())
}
