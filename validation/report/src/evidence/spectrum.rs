//! Figure 20: the overturning spectrum of one-sine pulses.

use rayon::prelude::*;

use rocking_draw::colour::{Dash, Ink, Pen};
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
/// Intervals between frequencies up to the fold.
const INTERVALS: usize = 87;
/// Lowest frequency over p of the whole spectrum, and of the bands.
const LOWEST: f64 = 0.4;

/// Ends of `count` intervals of equal ratio.
pub(super) fn spaced((low, high): (f64, f64), count: usize) -> Vec<f64> {
    let step = libm::log(high / low) / count as f64;
    (0..=count).map(|k| low * libm::exp(step * k as f64)).collect()
}

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

/// Amplitudes over the threshold at which the outcome changes, at one
/// frequency.
struct Edges {
    omega: f64,
    /// Ends of mode 1 (after one impact) in Eq. 2.
    mode_1: (f64, f64),
    /// Lower end of mode 2 (without impact) in Eq. 2, by each criterion.
    mode_2: [f64; 2],
    /// The lower ends in Eq. 1: mode 1, mode 2 by each criterion.
    stocky: [f64; 3],
}

fn edges(omega: &f64) -> Result<Edges, EngineError> {
    let omega = *omega;
    let (two, one) = (Model::Linearized, Model::Nonlinear);
    let (far, near) = (Overturning::HalfPi, Overturning::Alpha);
    let after = |impacts, model, criterion| {
        move |a| Ok(fate(model, criterion, omega, a)? == Some(impacts))
    };
    let without = overturning::sine_without_impact(2, omega);
    let upper = overturning::mode_1_upper(omega, ETA).unwrap_or(f64::NAN);
    let inside = upper * (1.0 - 1e-7);
    let lower = edge([1.0, inside], 1e-6, after(1, two, far))?;
    let by_alpha = edge([1.0, without], 1e-6, after(0, two, near))?;
    // In Eq. 1 the edges are a few percent off.
    let around = |x: f64, impacts, criterion| {
        let range = [1.0 + 0.9 * (x - 1.0), 1.0 + 1.2 * (x - 1.0)];
        edge(range, 1e-6, after(impacts, one, criterion))
    };
    Ok(Edges {
        omega,
        mode_1: (lower, upper),
        mode_2: [without, by_alpha],
        stocky: [
            around(lower, 1, far)?,
            around(without, 0, far)?,
            around(by_alpha, 0, near)?,
        ],
    })
}

/// Amplitudes at which three impacts or more come before overturning:
/// number of impacts, lower and upper edge.
fn bands(omega: f64, top: f64) -> Result<Vec<(usize, f64, f64)>, EngineError> {
    let count =
        |a: f64| fate(Model::Linearized, Overturning::HalfPi, omega, a);
    let mut found = Vec::new();
    // Impacts and lower edge of the band that is not closed yet.
    let mut open: Option<(usize, f64)> = None;
    let mut a = 1.0;
    while a < top {
        let next = a + 4e-4;
        let now = count(next)?.filter(|n| *n >= 3);
        if now != open.map(|(n, _)| n) {
            let flips = |n, is_in| {
                edge([a, next], 1e-6, |x| Ok((count(x)? == Some(n)) == is_in))
            };
            if let Some((n, low)) = open {
                found.push((n, low, flips(n, false)?));
            }
            open = match now {
                Some(n) => Some((n, flips(n, true)?)),
                None => None,
            };
        }
        a = next;
    }
    Ok(found)
}

/// A region between amplitudes, by frequency.
fn band(label: &str, rows: &[(f64, (f64, f64))]) -> Series {
    let (x, ends): (Vec<f64>, Vec<(f64, f64)>) = rows.iter().copied().unzip();
    let y = ends.iter().map(|(low, _)| *low).collect();
    Series::new(label, Mark::Line, x, y).with(ends)
}

/// Overturning spectrum of one-sine pulses, every mode, both criteria and
/// both equations.
pub(super) fn chart() -> anyhow::Result<Figure> {
    let (fold, at_fold) = overturning::fold(ETA);
    // Up to the fold, which is one of the frequencies, and beyond.
    let mut omegas = spaced((LOWEST, fold), INTERVALS);
    omegas.extend(&spaced((fold, 10.0), 8)[1..]);
    let all: Result<Vec<_>, _> =
        omegas.par_iter().panic_fuse().map(edges).collect();
    let all = all?;
    let mut mode_1: Vec<_> = all
        .iter()
        .filter(|e| e.mode_1.0.is_finite() && e.omega < fold)
        .map(|e| (e.omega, e.mode_1))
        .collect();
    mode_1.push((fold, (at_fold, at_fold)));
    // Grey and without a legend: the reading explains it.
    let stocky = |k: usize| {
        let y = all.iter().map(|e| e.stocky[k]).collect();
        Series::new("", Mark::Dashed, omegas.clone(), y)
    };
    let titles = ["|*θ*| > *π*/2", "|*θ*| ≥ *α*"];
    let spectrum = |(k, title): (usize, &str)| {
        let mode_2 = all.iter().map(|e| (e.omega, (e.mode_2[k], TOP)));
        let mode_2: Vec<_> = mode_2.collect();
        ChartPanel::new(
            title,
            ChartAxis::logarithmic("*ω*/*p*", (LOWEST, 10.0)),
            ChartAxis::logarithmic("amplitude / threshold", (1.0, TOP)),
            vec![
                band("after one impact (mode 1)", &mode_1),
                band("without impact (mode 2)", &mode_2),
                stocky(0),
                stocky(1 + k),
            ],
        )
    };
    let panels = titles.into_iter().enumerate().map(spectrum);
    let (panel, (impacts, lowest)) = low_frequencies(&mode_1)?;
    let heading = Heading::numbered(
        20,
        "Overturning spectrum of one-sine pulses",
        "Amplitude at which a block overturns, divided by the uplift \
         threshold, against frequency divided by p, restitution 0.92: after \
         one impact, without impact, and in narrow bands after three and \
         more; two criteria, in Eq. 2 (regions) and in Eq. 1 (dashed).",
        None,
    );
    let panels = panels.chain([panel]).collect();
    let reading = format!(
        "Mode 1 ends at omega/p = {fold:.3}; above it a safe zone opens below \
         mode 2. For |theta| >= alpha it opens only at 6.999. At omega/p \
         = 0.5 a pulse {:.1} % above the threshold overturns the block after \
         {impacts} impacts; mode 1 needs a stronger pulse. Shaded: Eq. 2.",
        100.0 * (lowest - 1.0)
    );
    Ok(Chart { heading, panels, columns: 3 }.figure(reading))
}

/// The bands of three impacts and more; number of impacts and amplitude of
/// the lowest at 0.5.
fn low_frequencies(
    mode_1: &[(f64, (f64, f64))],
) -> anyhow::Result<(ChartPanel, (usize, f64))> {
    let highest = 1.2;
    let omegas: Vec<f64> =
        (0..=32).map(|k| LOWEST + 0.025 * f64::from(k)).collect();
    let found: Result<Vec<_>, _> = omegas
        .par_iter()
        .panic_fuse()
        .map(|omega| bands(*omega, 1.13))
        .collect();
    let found = found?;
    let mode_1: Vec<_> = mode_1
        .iter()
        .filter(|row| row.0 < highest + 0.1)
        .map(|(omega, (low, high))| (*omega, (*low, high.min(1.2))))
        .collect();
    let mut series = vec![band("after one impact (mode 1)", &mode_1)];
    for n in [3, 5, 7, 9] {
        let rows = omegas.iter().zip(&found).filter_map(|(omega, bands)| {
            let (_, low, high) = bands.iter().find(|band| band.0 == n)?;
            Some((*omega, (*low, *high)))
        });
        let rows: Vec<_> = rows.collect();
        series.push(band(&format!("after {n} impacts"), &rows));
    }
    // Outside the panel: for the legend of all.
    let grey = Pen::new(Ink::Muted, 0.9).dash(Dash::Dashed);
    let words = "lower edges in Eq. 1, *α* = 0.25 rad";
    series.push(Series::note(Mark::Across(grey), words, (0.0, 0.0)));
    let at_half = omegas.iter().position(|x| (x - 0.5).abs() < 1e-9);
    let lowest = at_half
        .and_then(|k| found[k].first())
        .map_or((0, f64::NAN), |band| (band.0, band.1));
    let panel = ChartPanel::new(
        "low frequencies, |*θ*| > *π*/2, Eq. 2",
        ChartAxis::linear("*ω*/*p*", (LOWEST, highest)),
        ChartAxis::linear("amplitude / threshold", (1.0, 1.2)),
        series,
    );
    Ok((panel, lowest))
}
