//! Figures of the comparison.

use super::row::{MOTIONS, QuantityRow, RowGroup, of_group, of_motion};
use crate::facts::SPECTRUM_PERIODS_S;
use crate::words::{caption, heading};
use rocking_common::paper::{FREQUENCIES_RAD_S, Intensity};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Place, Series,
};
use rocking_statistics::Estimate;

/// Demands at which capacities are drawn.
const SHOWN: [f64; 2] = [0.15, 1.0];

/// A grey line at equality.
fn one(range: (f64, f64)) -> Series {
    Series::new("", Mark::Dashed, vec![range.0, range.1], vec![1.0, 1.0])
}

fn placed(name: &str) -> Heading {
    Heading { place: Place::SuitesByBlock, ..heading(name) }
}

/// Ratios of the motions' measures, and spectra of both.
pub(super) fn motions(rows: &[QuantityRow], kinds: [&str; 2]) -> Figure {
    let mut panels: Vec<ChartPanel> =
        kinds.iter().map(|kind| ratios(rows, kind)).collect();
    panels.extend(kinds.iter().map(|kind| spectra(rows, kind)));
    Chart { heading: placed("suites"), panels, columns: 2 }
        .figure(caption("suites"))
}

fn ratios(rows: &[QuantityRow], kind: &str) -> ChartPanel {
    let found = MOTIONS.map(|(quantity, _)| {
        of_motion(rows, kind, quantity)
            .map_or(Estimate::exact(f64::NAN), |r| r.ratio)
    });
    let places = (1..=MOTIONS.len()).map(|k| k as f64).collect();
    let own = ratio_series("ratio of medians, 95 %", places, &found);
    ChartPanel {
        title: format!("{kind}: ratio of medians"),
        x: ChartAxis::named(MOTIONS.map(|(_, label)| label.into()).into()),
        y: ChartAxis::logarithmic("embedded / recorded", (0.25, 4.0)),
        series: vec![one((0.5, MOTIONS.len() as f64 + 0.5)), own],
    }
}

fn ratio_series(
    label: impl Into<String>,
    x: Vec<f64>,
    of: &[Estimate],
) -> Series {
    let y = of.iter().map(Estimate::value).collect();
    let ends = of.iter().map(Estimate::ends);
    Series::new(label, Mark::Points, x, y).with(ends.collect())
}

fn spectra(rows: &[QuantityRow], kind: &str) -> ChartPanel {
    let found: Vec<(f64, &QuantityRow)> = SPECTRUM_PERIODS_S
        .iter()
        .filter_map(|t| {
            Some((*t, of_motion(rows, kind, &format!("sa_{t}_g"))?))
        })
        .collect();
    let series = |label: &str, embedded: bool| {
        let side = |row: &QuantityRow| match embedded {
            true => row.embedded,
            false => row.recorded,
        };
        let sides = found.iter().map(|(_, row)| side(row));
        let x = found.iter().map(|(t, _)| *t).collect();
        let y = sides.clone().map(|s| s.middle).collect();
        let ends = sides.map(|s| (s.low, s.high)).collect();
        Series::new(label, Mark::Line, x, y).with(ends)
    };
    ChartPanel {
        title: format!("{kind}: spectra"),
        x: ChartAxis::logarithmic("period *T* (s)", (0.05, 5.0)),
        y: ChartAxis::logarithmic("*S*_{a} (g)", (0.01, 3.0)),
        series: vec![
            series("recorded, median and 16 to 84 %", false),
            series("embedded, median and 16 to 84 %", true),
        ],
    }
}

/// Ratios of the capacities' medians, block by block.
pub(super) fn capacities(rows: &[QuantityRow], kinds: [&str; 2]) -> Figure {
    let mut panels = Vec::new();
    for kind in kinds {
        for edp in SHOWN {
            for intensity in [Intensity::Pga, Intensity::Pgv] {
                panels.push(blocks(rows, kind, edp, intensity));
            }
        }
    }
    Chart { heading: placed("suites-capacities"), panels, columns: 2 }
        .figure(caption("suites-capacities"))
}

fn blocks(
    rows: &[QuantityRow],
    kind: &str,
    edp: f64,
    intensity: Intensity,
) -> ChartPanel {
    let mut series = vec![one((0.02, 0.28))];
    for (k, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        let mut own =
            of_group(rows, RowGroup::Capacity, kind, intensity.name());
        own.retain(|r| r.p_rad_s == *p && r.edp == edp);
        // Side by side, so that the bars do not overlap.
        let shift = 0.006 * (k as f64 - 1.0);
        let x = own.iter().map(|r| r.alpha_rad + shift).collect();
        let ratios: Vec<Estimate> = own.iter().map(|r| r.ratio).collect();
        let label = format!("*p* = {p} s^{{−1}}");
        series.push(ratio_series(label, x, &ratios));
    }
    let name = intensity.name().to_uppercase();
    ChartPanel {
        title: format!("{kind}, *θ̃* = {edp:.2}, {name}"),
        x: ChartAxis::linear("*α* (rad)", (0.02, 0.28)),
        y: ChartAxis::logarithmic("embedded / recorded", (0.4, 2.5)),
        series,
    }
}
