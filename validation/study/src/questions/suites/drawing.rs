//! Figures of the comparison.

use super::row::{Group, Row};
use super::row::{MOTIONS, of_motion};
use crate::analyses::SPECTRUM_PERIODS_S;
use rocking_common::paper::{FREQUENCIES_RAD_S, Intensity};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Place, Scale, Series,
};

/// Demands at which capacities are drawn.
const SHOWN: [f64; 2] = [0.15, 1.0];

/// Equality, as a grey line.
fn one(range: (f64, f64)) -> Series {
    Series::new("", Mark::Dashed, vec![range.0, range.1], vec![1.0, 1.0])
}

/// Ratios of the motions' measures, and spectra of both.
pub(super) fn motions(rows: &[Row], kinds: [&str; 2]) -> Figure {
    let mut panels: Vec<ChartPanel> =
        kinds.iter().map(|kind| ratios(rows, kind)).collect();
    panels.extend(kinds.iter().map(|kind| spectra(rows, kind)));
    Chart {
        heading: Heading {
            place: Place::Suites,
            ..Heading::new(
                "figure-suites",
                "Embedded motions beside recorded ones",
                "Above, the ratio of the embedded to the \
                              recorded median of eight measures with its 95 \
                              % interval; below, median and 16 to 84 % of \
                              the response spectra at 5 % damping; ordinary \
                              and pulse-type suites.",
                None,
            )
        },
        panels,
        columns: 2,
    }
    .figure(
        "Where a bar does not reach the dashed line the embedded \
                  median differs from the recorded one; bands are 16 to 84 \
                  % of the motions.",
    )
}

fn ratios(rows: &[Row], kind: &str) -> ChartPanel {
    let found: Vec<Option<&Row>> = MOTIONS
        .iter()
        .map(|(quantity, _)| of_motion(rows, kind, quantity))
        .collect();
    let of = |value: fn(&Row) -> f64| -> Vec<f64> {
        found.iter().map(|r| r.map_or(f64::NAN, value)).collect()
    };
    let places = (1..=MOTIONS.len()).map(|k| k as f64).collect();
    ChartPanel {
        title: format!("{kind}: ratio of medians"),
        x: ChartAxis {
            label: String::new(),
            scale: Scale::Linear,
            range: None,
            categories: MOTIONS.map(|(_, label)| label.into()).into(),
            second: None,
        },
        y: ChartAxis::new(
            "embedded / recorded",
            Scale::Logarithmic,
            Some((0.25, 4.0)),
        ),
        series: vec![
            one((0.5, MOTIONS.len() as f64 + 0.5)),
            Series {
                label: "ratio of medians, 95 %".into(),
                mark: Mark::Points,
                x: places,
                y: of(|r| r.ratio.value),
                interval: of(|r| r.ratio.low)
                    .into_iter()
                    .zip(of(|r| r.ratio.high))
                    .collect(),
            },
        ],
    }
}

fn spectra(rows: &[Row], kind: &str) -> ChartPanel {
    let found: Vec<(f64, &Row)> = SPECTRUM_PERIODS_S
        .iter()
        .filter_map(|t| {
            Some((*t, of_motion(rows, kind, &format!("sa_{t}_g"))?))
        })
        .collect();
    let series = |label: &str, embedded: bool| {
        let sides = found.iter().map(|(_, row)| {
            if embedded { row.embedded } else { row.recorded }
        });
        Series {
            label: label.into(),
            mark: Mark::Line,
            x: found.iter().map(|(t, _)| *t).collect(),
            y: sides.clone().map(|s| s.middle).collect(),
            interval: sides.map(|s| (s.low, s.high)).collect(),
        }
    };
    ChartPanel {
        title: format!("{kind}: spectra"),
        x: ChartAxis::new(
            "period *T* (s)",
            Scale::Logarithmic,
            Some((0.05, 5.0)),
        ),
        y: ChartAxis::new(
            "*S*_{a} (g)",
            Scale::Logarithmic,
            Some((0.01, 3.0)),
        ),
        series: vec![
            series("recorded, median and 16 to 84 %", false),
            series("embedded, median and 16 to 84 %", true),
        ],
    }
}

/// Ratios of the capacities' medians, block by block.
pub(super) fn capacities(rows: &[Row], kinds: [&str; 2]) -> Figure {
    let mut panels = Vec::new();
    for kind in kinds {
        for edp in SHOWN {
            for intensity in [Intensity::Pga, Intensity::Pgv] {
                panels.push(blocks(rows, kind, edp, intensity));
            }
        }
    }
    Chart {
        heading: Heading {
            place: Place::SuitesByBlock,
            ..Heading::new(
                "figure-suites-capacities",
                "Capacities under embedded and recorded motions",
                "Ratio of the embedded to the recorded median \
                              capacity with its 95 % interval, block by \
                              block, at demands 0.15 and 1.00, for PGA and \
                              PGV, ordinary and pulse-type suites.",
                None,
            )
        },
        panels,
        columns: 2,
    }
    .figure(
        "Ratio of median capacities, embedded over recorded; a bar \
                  that does not reach the dashed line is a difference of \
                  the suites that records alone don't explain.",
    )
}

fn blocks(
    rows: &[Row],
    kind: &str,
    edp: f64,
    intensity: Intensity,
) -> ChartPanel {
    let mut series = vec![one((0.02, 0.28))];
    for (k, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        let own: Vec<&Row> = rows
            .iter()
            .filter(|r| {
                r.group == Group::Capacity
                    && r.suite == kind
                    && r.quantity == intensity.name()
                    && r.p_rad_s == *p
                    && r.edp == edp
            })
            .collect();
        // Beside each other, not on each other.
        let shift = 0.006 * (k as f64 - 1.0);
        series.push(Series {
            label: format!("*p* = {p} s^{{−1}}"),
            mark: Mark::Points,
            x: own.iter().map(|r| r.alpha_rad + shift).collect(),
            y: own.iter().map(|r| r.ratio.value).collect(),
            interval: own
                .iter()
                .map(|r| (r.ratio.low, r.ratio.high))
                .collect(),
        });
    }
    let kind = if kind.starts_with('p') { "pulse-type" } else { "ordinary" };
    ChartPanel {
        title: format!(
            "{kind}, *θ̃* = {edp:.2}, {}",
            intensity.name().to_uppercase()
        ),
        x: ChartAxis::new("*α* (rad)", Scale::Linear, Some((0.02, 0.28))),
        y: ChartAxis::new(
            "embedded / recorded",
            Scale::Logarithmic,
            Some((0.4, 2.5)),
        ),
        series,
    }
}
