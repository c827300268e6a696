use rayon::prelude::*;

use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Series,
};
use rocking_proof::edge::edge;
use rocking_proof::engine::Core;
use rocking_proof::oracles::overturning;
use rocking_proof::scene::{
    CaseScene, Engine as _, EngineError, Forcing, Model, Overturning,
    PulseKind,
};

/// Restitution of the figure.
pub(super) const ETA: f64 = 0.92;
/// Slenderness of the block of Eq. 1.
pub(super) const STOCKY_RAD: f64 = 0.25;
/// Top of the panels.
const TOP: f64 = 30.0;
/// Frequencies up to the fold.
const POINTS: u32 = 88;
/// Lowest frequency over p of the whole spectrum, and of the bands.
const LOWEST: f64 = 0.4;

/// Whether a one-sine pulse overturns, and after how many impacts.
pub(super) fn fate(
    equation: Model,
    criterion: Overturning,
    omega: f64,
    amplitude: f64,
) -> Result<Option<usize>, EngineError> {
    let mut scene = CaseScene {
        model: equation,
        overturning: criterion,
        until_s: Some(7.0 / omega + 60.0),
        ..CaseScene::new([STOCKY_RAD, 1.0, 1.0], ETA, Forcing::NONE)
    };
    scene.forcing = Forcing::Pulse(PulseKind::OneSine {
        amplitude: amplitude * scene.threshold_m_s2(),
        omega_rad_s: omega,
    });
    let trace = Core.respond(&scene)?;
    Ok(trace.overturned_s.map(|_| trace.impacts.len()))
}

/// Edges at one frequency.
#[derive(Clone, Copy)]
struct Edges {
    omega: f64,
    lower: f64,
    upper: f64,
    without: f64,
    without_by_alpha: f64,
    /// Eq. 1: mode 1, mode 2, mode 2 by alpha.
    stocky: [f64; 3],
}

fn edges(omega: f64) -> Result<Edges, EngineError> {
    let (two, one) = (Model::Linearized, Model::Nonlinear);
    let (far, near) = (Overturning::HalfPi, Overturning::Alpha);
    let after_one =
        |equation| move |a| Ok(fate(equation, far, omega, a)? == Some(1));
    let without_impact = |equation, criterion| {
        move |a| Ok(fate(equation, criterion, omega, a)? == Some(0))
    };
    let without = overturning::sine_without_impact(2, omega);
    let upper = overturning::mode_1_upper(omega, ETA).unwrap_or(f64::NAN);
    let inside = upper * (1.0 - 1e-7);
    let lower = edge([1.0, inside], 1e-6, after_one(two))?;
    let without_by_alpha =
        edge([1.0, without], 1e-6, without_impact(two, near))?;
    // In Eq. 1 the edges are a few percent off.
    let around = |x: f64, above: &dyn Fn(f64) -> Result<bool, EngineError>| {
        edge([1.0 + 0.9 * (x - 1.0), 1.0 + 1.2 * (x - 1.0)], 1e-6, above)
    };
    Ok(Edges {
        omega,
        lower,
        upper,
        without,
        without_by_alpha,
        stocky: [
            around(lower, &after_one(one))?,
            around(without, &without_impact(one, far))?,
            around(without_by_alpha, &without_impact(one, near))?,
        ],
    })
}

/// Amplitudes at which three impacts or more come before overturning:
/// number of impacts, lower and upper edge.
fn bands(omega: f64, top: f64) -> Result<Vec<(usize, f64, f64)>, EngineError> {
    let count =
        |a: f64| fate(Model::Linearized, Overturning::HalfPi, omega, a);
    let step = 4e-4;
    let (mut found, mut open) = (Vec::new(), None);
    let mut before: Option<usize> = None;
    let mut a = 1.0;
    while a < top {
        let next = a + step;
        let now = count(next)?.filter(|n| *n >= 3);
        if now != before {
            if let (Some(n), Some(low)) = (before, open) {
                let high =
                    edge([a, next], 1e-6, |x| Ok(count(x)? != Some(n)))?;
                found.push((n, low, high));
            }
            open = match now {
                Some(n) => {
                    Some(edge([a, next], 1e-6, |x| Ok(count(x)? == Some(n)))?)
                }
                None => None,
            };
            before = now;
        }
        a = next;
    }
    Ok(found)
}

fn band(label: &str, rows: &[(f64, f64, f64)]) -> Series {
    let x = rows.iter().map(|r| r.0).collect();
    let y = rows.iter().map(|r| r.1).collect();
    let ends = rows.iter().map(|r| (r.1, r.2)).collect();
    Series::new(label, Mark::Line, x, y).with(ends)
}

/// An edge of Eq. 1: grey and without legend, explained in the reading.
fn stocky_edge(x: &[f64], y: impl Iterator<Item = f64>) -> Series {
    Series::new("", Mark::Dashed, x.into(), y.collect())
}

/// Overturning spectrum of one-sine pulses, every mode, both criteria and
/// both equations.
pub(super) fn chart() -> anyhow::Result<Figure> {
    let (fold, at_fold) = overturning::fold(ETA);
    // Up to the fold, which is one of the frequencies, and beyond.
    let mut omegas: Vec<f64> = (0..POINTS)
        .map(|k| {
            LOWEST
                * libm::exp(
                    f64::from(k) / f64::from(POINTS - 1)
                        * libm::log(fold / LOWEST),
                )
        })
        .collect();
    omegas.extend((1..=8).map(|k| {
        fold * libm::exp(f64::from(k) / 8.0 * libm::log(10.0 / fold))
    }));
    let all = omegas
        .par_iter()
        .map(|omega| edges(*omega))
        .collect::<Result<Vec<_>, EngineError>>()?;
    let x: Vec<f64> = all.iter().map(|e| e.omega).collect();
    let mut with_impact: Vec<(f64, f64, f64)> = all
        .iter()
        .filter(|e| e.lower.is_finite() && e.omega < fold)
        .map(|e| (e.omega, e.lower, e.upper))
        .collect();
    with_impact.push((fold, at_fold, at_fold));
    let mut panels = Vec::new();
    for (title, criterion) in [
        ("|*θ*| > *π*/2", Overturning::HalfPi),
        ("|*θ*| ≥ *α*", Overturning::Alpha),
    ] {
        let (without, stocky): (fn(&Edges) -> f64, usize) = match criterion {
            Overturning::HalfPi => (|e| e.without, 1),
            Overturning::Alpha => (|e| e.without_by_alpha, 2),
        };
        let rows: Vec<_> =
            all.iter().map(|e| (e.omega, without(e), TOP)).collect();
        panels.push(ChartPanel {
            title: title.into(),
            x: ChartAxis::logarithmic("*ω*/*p*", (LOWEST, 10.0)),
            y: ChartAxis::logarithmic("amplitude over threshold", (1.0, TOP)),
            series: vec![
                band("after one impact (mode 1)", &with_impact),
                band("without impact (mode 2)", &rows),
                stocky_edge(&x, all.iter().map(|e| e.stocky[0])),
                stocky_edge(&x, all.iter().map(|e| e.stocky[stocky])),
            ],
        });
    }
    let (panel, lowest) = low_frequencies(&with_impact)?;
    panels.push(panel);
    Ok(Chart {
        heading: Heading::numbered(
            20,
            "Overturning spectrum of one-sine pulses",
            "Amplitude over the uplift threshold against \
                              frequency over p at which a block overturns, \
                              restitution 0.92: after one impact, without \
                              impact, and in narrow bands after three and \
                              more; by two criteria, in Eq. 2 (regions) and \
                              in Eq. 1 (dashed).",
            None,
        ),
        panels,
        columns: 3,
    }
    .figure(format!(
        "Mode 1 folds back at omega/p = {fold:.3} and leaves a safe bay \
             below mode 2; by |theta| >= alpha the bay opens at 6.999 only. \
             At omega/p = 0.5 a pulse {:.1} % above the threshold overturns \
             after {} impacts, less than mode 1 needs. Regions are of Eq. 2; \
             dashed, the lower edges of Eq. 1 at alpha = 0.25.",
        100.0 * (lowest.1 - 1.0),
        lowest.0
    )))
}

/// The bands of three impacts and more, and the lowest of them at 0.5.
fn low_frequencies(
    with_impact: &[(f64, f64, f64)],
) -> anyhow::Result<(ChartPanel, (usize, f64))> {
    let highest = 1.2;
    let omegas: Vec<f64> =
        (0..=32).map(|k| LOWEST + 0.025 * f64::from(k)).collect();
    let found = omegas
        .par_iter()
        .map(|omega| bands(*omega, 1.13))
        .collect::<Result<Vec<_>, EngineError>>()?;
    let mut series = Vec::new();
    let mode_1: Vec<_> = with_impact
        .iter()
        .filter(|row| row.0 < highest + 0.1)
        .map(|row| (row.0, row.1, row.2.min(1.2)))
        .collect();
    series.push(band("after one impact (mode 1)", &mode_1));
    for n in [3, 5, 7, 9] {
        let rows: Vec<(f64, f64, f64)> = omegas
            .iter()
            .zip(&found)
            .filter_map(|(omega, bands)| {
                let band = bands.iter().find(|band| band.0 == n)?;
                Some((*omega, band.1, band.2))
            })
            .collect();
        series.push(band(&format!("after {n} impacts"), &rows));
    }
    let at_half = omegas.iter().position(|x| (x - 0.5).abs() < 1e-9);
    let lowest = at_half
        .and_then(|k| found[k].first())
        .map_or((0, f64::NAN), |band| (band.0, band.1));
    let panel = ChartPanel {
        title: "low frequencies, |*θ*| > *π*/2".into(),
        x: ChartAxis::linear("*ω*/*p*", (LOWEST, highest)),
        y: ChartAxis::linear("amplitude over threshold", (1.0, 1.2)),
        series,
    };
    Ok((panel, lowest))
}
