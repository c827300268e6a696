//! Figures 1 to 5: the block, and single records.

use crate::analyses::{HISTORY_INTERVAL_S, SingleRecords, SuiteResults};
use crate::words::paper_heading;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, position,
};
use rocking_common::table::number as cell;
use rocking_draw::axis::Axis;
use rocking_draw::figures::common::{self, span};
use rocking_draw::figures::{
    BlockSketch, Chart, ChartPanel, Column, Figure, History, HistoryPanel,
    Layout, Mark, Of, Series, histories,
};
use rocking_draw::grid::Grid;

pub(super) fn sketch() -> Figure {
    BlockSketch {
        heading: paper_heading(1, None),
        alpha_rad: 0.35,
        rotation_rad: 0.15,
    }
    .figure(
        "A block starts to rock when the ground acceleration exceeds g tan \
         alpha; at theta = alpha its weight no longer rights it."
            .into(),
    )
}

pub(super) fn motions(suite: &SuiteResults, arm: Arm, number: u32) -> Figure {
    let mut panels = Vec::new();
    for (single, p_rad_s) in suite.single.iter().zip(FREQUENCIES_RAD_S) {
        for (record, histories) in suite.chosen.iter().zip(&single.histories) {
            let curves = histories.iter().zip(SLENDERNESSES_RAD);
            let curves = curves.map(|((ratio, peak), alpha_rad)| {
                history(alpha_rad, ratio, peak.is_infinite())
            });
            panels.push(HistoryPanel {
                p_rad_s,
                record: suite.records[*record].name.clone(),
                im: single.im,
                curves: curves.collect(),
            });
        }
    }
    let heading = paper_heading(number, Some(arm));
    let distances = by_frequency(suite, |single| {
        format!("{:.3}", single.median_of(|a| a.distance))
    });
    let words = format!(
        "Over all {} records, the median normalized distance of a history \
         from the history for alpha = 0.10 is {distances}.",
        suite.records.len(),
    );
    histories(heading, &panels, 3, words)
}

/// The history up to rest.
fn history(alpha_rad: f64, ratio: &[f64], overturned: bool) -> History {
    let end = ratio.iter().rposition(|y| *y != 0.0).map_or(2, |i| i + 2);
    let ratio = ratio[..end.min(ratio.len())].to_vec();
    let time_s =
        (0..ratio.len()).map(|i| i as f64 * HISTORY_INTERVAL_S).collect();
    History { alpha_rad, time_s, ratio, overturned }
}

/// A number of each frequency parameter in words.
fn by_frequency(
    suite: &SuiteResults,
    number: impl Fn(&SingleRecords) -> String,
) -> String {
    let all = suite.single.iter().zip(FREQUENCIES_RAD_S);
    let all = all.map(|(own, p)| format!("{} at p = {p}", number(own)));
    all.collect::<Vec<String>>().join(", ")
}

/// Side of a panel of IDA curves, in px.
const WIDTH_PX: f64 = 288.0;
const HEIGHT_PX: f64 = 160.0;
/// Columns of their CSV.
const KEYS: [&str; 4] = ["p_rad_s", "record", "im", "alpha_rad"];
const NUMBERS: [Column; 2] = [("intensity", Of::Y), ("edp", Of::X)];

/// The axis of the demand, past 1 so that overturning lies inside.
pub(super) fn demand() -> Axis {
    Axis::linear(0.0, 1.08, 5).label(common::DEMAND)
}

/// IDA curves up to first overturning.
pub(super) fn curves(
    suite: &SuiteResults,
    arm: Arm,
    number: u32,
) -> anyhow::Result<Figure> {
    let all = suite.curves(arm)?;
    let mut panels = Vec::new();
    for (frequency, p_rad_s) in FREQUENCIES_RAD_S.into_iter().enumerate() {
        for record in suite.chosen {
            let name = &suite.records[record].name;
            let curve = |(slenderness, alpha_rad): (usize, f64)| {
                let curve = &all[position(frequency, slenderness)][record];
                let stands = curve.vertices().filter(|(_, e)| e.is_finite());
                let falls = curve.overturning_im().map(|x| (x, f64::INFINITY));
                let (im, edp) = stands.chain(falls).unzip();
                let label = common::slenderness(alpha_rad);
                Series::new(label, Mark::Line, edp, im).keyed([
                    cell(p_rad_s),
                    name.clone(),
                    Intensity::Pga.name().into(),
                    cell(alpha_rad),
                ])
            };
            let curves = SLENDERNESSES_RAD.into_iter().enumerate().map(curve);
            let curves: Vec<Series> = curves.collect();
            let levels = curves.iter().flat_map(|c| c.y.iter().copied());
            let (low, high) = span(levels, true).unwrap_or((1.0, 2.0));
            let top = 1.12_f64.mul_add(high - low, low).max(1.2);
            let bottom = if low < 0.99 { 0.0 } else { 1.0 };
            let p = common::frequency(p_rad_s);
            panels.push(ChartPanel::new(
                format!("{p}\n{}", common::record(name, WIDTH_PX)),
                demand(),
                Axis::linear(bottom, top, 5).label(Intensity::Pga.row().label),
                curves,
            ));
        }
    }
    let differences = by_frequency(suite, |single| {
        format!("{:.2} %", 100.0 * single.median_of(|a| a.mean_ln_im))
    });
    let heading = paper_heading(number, Some(arm));
    let grid = Grid::new(panels.len(), 3).plot(WIDTH_PX, HEIGHT_PX);
    let layout = Layout { grid: Some(grid), ..Layout::of(&KEYS, &NUMBERS) };
    let chart = Chart { heading, panels, columns: 3 };
    Ok(chart.thinned((WIDTH_PX, HEIGHT_PX)).laid_out(
        &layout,
        format!(
            "Over all {} records, the intensity that reaches a given demand \
             differs from the intensity for alpha = 0.10 by a median of \
             {differences}.",
            suite.records.len(),
        ),
    ))
}
