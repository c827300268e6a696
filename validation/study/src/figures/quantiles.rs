//! Figures 8 and 10: quantiles of the demand given the intensity.

use rayon::prelude::*;
use rocking::capacity::ResponseCurve;

use super::single::demand;
use crate::analyses::SuiteResults;
use crate::estimates::three_quantiles;
use crate::runs::curves_of;
use crate::words::paper_heading;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, REFERENCE, SLENDERNESSES_RAD, position,
};
use rocking_common::table::number;
use rocking_draw::axis::Axis;
use rocking_draw::figures::common::{self, span};
use rocking_draw::figures::{
    Chart, ChartPanel, Column, Figure, Heading, Layout, Mark, Of, Series,
};
use rocking_draw::grid::Grid;
use rocking_draw::markup::plain;
use rocking_draw::text::Horizontal;

/// Most points of a line.
const MOST_POINTS: usize = 160;

/// Columns of the CSV.
const KEYS: [&str; 3] = ["p_rad_s", "im", "group"];
const NUMBERS: [Column; 4] = [
    ("intensity", Of::Y),
    ("q16", Of::Low),
    ("q50", Of::X),
    ("q84", Of::High),
];

/// Quantile curves that are compared at one frequency parameter.
type QuantilePanel = Vec<Series>;

/// Figure 8.
pub(super) fn slendernesses(
    suite: &SuiteResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let curves = suite.curves(arm)?;
    let panels = panels(|frequency| {
        let own =
            SLENDERNESSES_RAD.iter().zip(&curves[position(frequency, 0)..]);
        let one = |(alpha, curves): (&f64, &Vec<ResponseCurve>)| {
            group(format!("*α* = {alpha:.2} rad"), curves)
        };
        own.map(one).collect()
    })?;
    let words =
        "A curve has the demand that 16, 50 or 84 % of the motions do \
                 not exceed, so the curve of 16 % is the uppermost. A curve \
                 turns level where its quantile overturns."
            .to_owned();
    let heading = paper_heading(8, Some(arm));
    Ok(figure(heading, &panels, words))
}

fn figure(
    heading: Heading,
    panels: &[QuantilePanel],
    words: String,
) -> Figure {
    let columns = panels.len();
    let grid = Grid { right: 40.0, ..Grid::new(columns, columns) };
    let grid = grid.plot(264.0, grid.height);
    let layout = Layout { grid: Some(grid), ..Layout::of(&KEYS, &NUMBERS) };
    let shown = panels.iter().zip(FREQUENCIES_RAD_S).map(|(groups, p)| {
        let (low, high) = levels(groups);
        let keyed = groups.iter().map(|group| {
            let im = Intensity::Pga.name().into();
            group.clone().keyed([number(p), im, plain(&group.label)])
        });
        ChartPanel::new(
            common::frequency(p),
            demand(),
            Axis::linear(low, high, 6).label(Intensity::Pga.row().label),
            keyed.chain(edge_words(groups)).collect(),
        )
    });
    let chart = Chart { heading, panels: shown.collect(), columns };
    chart.laid_out(&layout, words)
}

/// Demands of a quantile: 0 is 16 %, 1 the median, 2 is 84 %.
fn demands(group: &Series, quantile: usize) -> Vec<f64> {
    let ends = group.interval.iter().copied();
    match quantile {
        0 => ends.map(|(low, _)| low).collect(),
        1 => group.x.clone(),
        _ => ends.map(|(_, high)| high).collect(),
    }
}

/// Intensity at which a quantile overturns.
fn overturns(group: &Series, quantile: usize) -> Option<f64> {
    let demands = demands(group, quantile);
    let at = demands.iter().position(|q| q.is_infinite())?;
    group.y.get(at).copied()
}

/// Ends of the intensity axis of a panel: 1 (0 if a curve begins lower), and a
/// little above the last overturning level.
fn levels(groups: &[Series]) -> (f64, f64) {
    let ends = groups
        .iter()
        .map(|g| overturns(g, 0).or(g.y.last().copied()).unwrap_or(1.0));
    let starts = groups.iter().filter_map(|g| g.y.first().copied());
    let (_, high) = span(ends, true).unwrap_or((1.0, 2.0));
    let (low, _) = span(starts, true).unwrap_or((1.0, 2.0));
    let low = if low < 0.99 { 0.0 } else { 1.0 };
    (low, 1.06_f64.mul_add(high - low, low))
}

/// `84 %`, `50 %`, `16 %` at the point where the curves leave the panel or end.
fn edge_words(groups: &[Series]) -> Vec<Series> {
    let words = |(quantile, words): (usize, &str)| {
        let ends = groups.iter().filter_map(|g| overturns(g, quantile));
        if let Some((low, high)) = span(ends, true) {
            let at = (0.0, f64::midpoint(low, high));
            return Some(Series::note(Mark::Edge, words, at));
        }
        let last = |g: &Series| {
            let demands = demands(g, quantile);
            let last = demands.iter().rposition(|e| e.is_finite())?;
            Some((demands[last], g.y[last]))
        };
        let ends: Vec<(f64, f64)> = groups.iter().filter_map(last).collect();
        let (_, right) = span(ends.iter().map(|e| e.0), false)?;
        let at = (right + 0.02, ends[0].1);
        Some(Series::note(Mark::Words(Horizontal::Left), words, at))
    };
    let all = [(2, "84 %"), (1, "50 %"), (0, "16 %")];
    all.into_iter().filter_map(words).collect()
}

/// Figure 10.
pub(super) fn adjusted(
    suite: &SuiteResults,
    arm: Arm,
) -> anyhow::Result<Figure> {
    let curves = suite.curves(arm)?;
    let adjusted = curves_of(&suite.adjusted, arm)?;
    let panels = panels(|frequency| {
        let scaled = &curves[position(frequency, REFERENCE)];
        Ok(vec![
            group("scaled records".into(), scaled)?,
            group("adjusted slenderness".into(), &adjusted[frequency])?,
        ])
    })?;
    let words = panels.iter().zip(FREQUENCIES_RAD_S).map(|(groups, p)| {
        let firsts = groups.iter().map(|g| {
            overturns(g, 1).map_or("never".into(), |im| format!("{im:.2}"))
        });
        let firsts = firsts.collect::<Vec<String>>().join(", ");
        format!("at {firsts} for p = {p}")
    });
    let words = words.collect::<Vec<String>>().join("; ");
    let heading = paper_heading(10, Some(arm));
    let words = format!(
        "The median demand reaches overturning {words}, by procedure."
    );
    Ok(figure(heading, &panels, words))
}

fn panels(
    groups: impl Fn(usize) -> anyhow::Result<QuantilePanel>,
) -> anyhow::Result<Vec<QuantilePanel>> {
    (0..FREQUENCIES_RAD_S.len()).map(groups).collect()
}

/// Quantiles at the levels of the scan, up to the first at which the 16 %
/// quantile has overturned; evenly thinned if there are many.
fn group(label: String, curves: &[ResponseCurve]) -> anyhow::Result<Series> {
    // All curves of a block share their levels; the longest has them all.
    let own = curves.iter().map(|curve| curve.vertices().map(|(im, _)| im));
    let own = own.map(Iterator::collect::<Vec<f64>>).rev();
    let mut levels = own.max_by_key(Vec::len).unwrap_or_default();
    let overturned_at = |im: f64| {
        let gone = |c: &&ResponseCurve| {
            c.overturning_im().is_some_and(|first| first <= im)
        };
        curves.iter().filter(gone).count()
    };
    let most = (0.84 * curves.len() as f64).ceil() as usize;
    let end = levels.partition_point(|im| overturned_at(*im) <= most);
    levels.truncate(end + 1);
    let stride = levels.len().div_ceil(MOST_POINTS).max(1);
    let im: Vec<f64> = levels.iter().copied().step_by(stride).collect();
    let at: Vec<[f64; 3]> = im
        .par_iter()
        .map(|im| three(curves, *im))
        .collect::<Result<_, _>>()?;
    let medians = at.iter().map(|q| q[1]).collect();
    let ends = at.iter().map(|q| (q[0], q[2])).collect();
    Ok(Series::new(label, Mark::Quantiles, medians, im).with(ends))
}

/// 16, 50 and 84 % quantile of the demand at an intensity; overturned
/// counts as infinite.
fn three(curves: &[ResponseCurve], im: f64) -> anyhow::Result<[f64; 3]> {
    // Between the last standing level and a refined overturning the curve has
    // no demand; the block stands there.
    let demands: Vec<f64> = curves
        .iter()
        .map(|c| {
            let last = || c.vertices().last().map_or(0.0, |(_, e)| e);
            c.edp_at(im).unwrap_or_else(last)
        })
        .collect();
    three_quantiles(&demands)
}
