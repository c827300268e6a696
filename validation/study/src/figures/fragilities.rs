//! Figures 15 to 18: fitted and transformed fragilities.

mod curves;
mod thresholds;

pub(super) use thresholds::thresholds;

use rocking_statistics::ExtendedSample;

use curves::{KEYS, NUMBERS, along, empirical, exceedance, fitted, most_of};

use crate::fits::{BLOCK, CONSTANTS, Fits, THRESHOLDS};
use crate::results::StudyResults;
use crate::words::paper_heading;
use rocking_common::paper::{Arm, Intensity, demand_index};
use rocking_draw::axis::Axis;
use rocking_draw::colour::{Dash, Ink, Pen};
use rocking_draw::figures::{Chart, ChartPanel, Figure, Layout, Mark, Series};
use rocking_draw::grid::Grid;

/// Figure 18: demand 0.15, PGA. Its caption has the distances to the SSFL, which
/// the claims on c use.
pub(super) fn constants(
    results: &StudyResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let at = (Intensity::Pga, THRESHOLDS[0]);
    let block = results.ordinary.block(arm, at.0, BLOCK)?;
    let data = &block.samples[demand_index(at.1)];
    let sample = ExtendedSample::try_new(data)?;
    let fits = Fits::new(sample, block.shift);
    let benchmark = Pen::new(Ink::Text, 1.3);
    let dashes = [Dash::Dotted, Dash::Dashed, Dash::DashDot, Dash::Long];
    // The axis shows the benchmark's bulk and most of the data.
    let bulk = fits.ssfl.map_or(1.0, |f| {
        let spread = 2.0_f64.mul_add(f.dispersion(), f.log_mean());
        f.shift() + libm::exp(spread)
    });
    let most = most_of(data).into_iter().fold(1.0, f64::max);
    let x = || {
        Axis::around(0.0, (1.02 * most).max(bulk), 7).label(at.0.row().label)
    };
    let grid = along(x().range(), 300);
    let mut words = Vec::new();
    let mut panels = Vec::new();
    for (title, usfl) in [("untrimmed", fits.usfl), ("trimmed", fits.trimmed)]
    {
        let ssfl = fitted(at, ("SSFL", benchmark), fits.ssfl.as_ref(), &grid);
        let mut series = vec![empirical(at, data), ssfl];
        let mut distances = Vec::new();
        let mut missing = Vec::new();
        for (k, (c, dash)) in CONSTANTS.into_iter().zip(dashes).enumerate() {
            let pen = Pen::new(Ink::Series(k), 1.3).dash(dash);
            let fit = fits.usfl7(usfl, c);
            let name = format!("USFL7, *c* = {c}");
            let mut curve = fitted(at, (&name, pen), fit.as_ref(), &grid);
            curve.keys[2] += &format!(", {title}");
            series.push(curve);
            match fit {
                Some(_) => {
                    let apart = fits.to_ssfl(usfl, c);
                    distances.push(format!("{apart:.3}"));
                }
                None => {
                    distances.push("undefined".into());
                    missing.push(c.to_string());
                }
            }
        }
        if !missing.is_empty() {
            let not = format!("not defined for *c* = {}", missing.join(", "));
            series.push(Series::note(Mark::Corner, not, (0.0, 0.0)));
        }
        words.push(format!("{title} {}", distances.join(", ")));
        let title = format!("{title}, *θ̃* = {:.2}", at.1);
        panels.push(ChartPanel::new(title, x(), exceedance(), series));
    }
    let layout = Layout {
        grid: Some(Grid::new(panels.len(), 2).plot(440.0, 230.0)),
        ..Layout::of(&KEYS, &NUMBERS[..2])
    };
    let heading = paper_heading(18, Some(arm));
    let chart = Chart { heading, panels, columns: 2 };
    Ok(chart.thinned((440.0, 230.0)).laid_out(
        &layout,
        format!(
            "Largest difference in probability between USFL7 and the SSFL \
             for c = 0.25, 0.5, 0.75, 1: {}.",
            words.join("; ")
        ),
    ))
}
