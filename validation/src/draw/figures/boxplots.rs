//! Figures 6, 7 and 9: notched boxplots of paired ratios by stripe.

use super::Figure;
use super::common;
use super::common::Slendernesses;
use super::data::{BoxPanel, Boxplots, Heading, NotchedBox, StripeKind};
use crate::draw::axis::Tick;
use crate::draw::{
    Axis, Entry, Fill, Grid, Ink, Marker, Panel, Pen, Point, Sample, Scene,
};

impl Figure for Boxplots {
    fn heading(&self) -> &Heading {
        &self.heading
    }

    fn scene(&self) -> Scene {
        scene(self)
    }

    fn csv(&self) -> String {
        self.csv()
    }
}

/// Half height of a box in units of the distance between stripes.
const HALF: f64 = 0.30;
/// Half height at the notch.
const WAIST: f64 = 0.15;
/// Where the interval of the median is drawn, below the box.
const BELOW: f64 = -0.43;
const INTERVAL: Pen = Pen::new(Ink::Text, 1.0);
/// Ratios beyond are left out, with an arrow head at the edge.
const WIDEST: (f64, f64) = (0.1, 10.0);

pub(super) fn scene(figure: &Boxplots) -> Scene {
    let inks = Slendernesses::new(figure.panels.iter().map(|p| p.alpha_rad));
    let most = figure.panels.iter().map(|p| p.stripes.len()).max();
    let height = 21.0 * most.unwrap_or(0).clamp(6, 16) as f64;
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let width = match grid.columns {
        1 | 2 => 400.0,
        3 => 262.0,
        _ => 196.0,
    };
    let grid = Grid { right: 44.0, ..grid }.plot(width, height);
    let grid = if figure.panels.iter().any(|p| !p.note.is_empty()) {
        grid.with_subtitles()
    } else {
        grid
    };
    let (low, high) = ratio_range(figure);
    let near = box_width(figure);
    let mut legend =
        if figure.panels.len() > 1 { inks.boxes() } else { vec![] };
    let cross = Sample::Mark(Marker::Cross, Ink::Text);
    legend.push(Entry::new(cross, "outlier"));
    if summaries(figure).any(|b| b.median_interval.is_some()) {
        let words = "exact 95 % interval of the median";
        legend.push(Entry::new(Sample::Line(INTERVAL), words));
    }
    let beyond =
        |b: &NotchedBox| b.outliers.iter().any(|x| *x > high || *x < low);
    if summaries(figure).any(beyond) {
        let arrow = Sample::Mark(Marker::Beyond, Ink::Text);
        legend.push(Entry::new(arrow, "more outliers beyond the axis"));
    }
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    let level = match figure.stripes {
        StripeKind::Intensity(kind) => common::intensity(kind),
        StripeKind::Demand => common::DEMAND,
    };
    for (i, shown) in figure.panels.iter().enumerate() {
        let ticks = shown
            .stripes
            .iter()
            .enumerate()
            .map(|(k, s)| Tick {
                at: (k + 1) as f64,
                label: common::short(s.level),
            })
            .collect();
        let names = vec![String::new(); shown.stripes.len()];
        let y = Axis::named(&names).with_ticks(ticks).label(level);
        let x = Axis::about_one(low, high, near, 34.0 / width).label(format!(
            "{} (scale stretched about 1)",
            figure.ratio_label
        ));
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y)
            .empty_because("too few usable ratios");
        panel.vertical(1.0, Pen::new(Ink::Muted, 0.8));
        let ink = Ink::Series(inks.series(shown.alpha_rad));
        draw_stripes(&mut panel, shown, ink, (low, high));
        let title = format!(
            "{}, {}",
            common::frequency(shown.p_rad_s),
            common::slenderness(shown.alpha_rad)
        );
        panel.finish(
            &common::panel_title(i, &title),
            &common::words(&shown.note),
        );
    }
    scene
}

fn summaries(figure: &Boxplots) -> impl Iterator<Item = &NotchedBox> {
    let stripes = figure.panels.iter().flat_map(|p| &p.stripes);
    stripes.filter_map(|s| s.summary.as_ref())
}

/// The same range for all panels: what the whiskers need, and most of the
/// outliers.
fn ratio_range(figure: &Boxplots) -> (f64, f64) {
    let ends = summaries(figure).flat_map(|b| {
        let notch = [b.notch_low, b.notch_high];
        let whiskers = [b.whisker_low, b.whisker_high];
        notch.into_iter().chain(whiskers).chain(b.outliers.iter().copied())
    });
    let (low, high) = common::span(ends, false).unwrap_or((0.5, 1.5));
    // Room for a cross within the axes.
    let low = (0.9 * low).clamp(WIDEST.0, 0.9);
    let high = (1.12 * high).clamp(1.1, WIDEST.1);
    (low, high)
}

/// Width about 1 within which the axis is linear: half the median box, in
/// ln, but 0.01 to 0.2.
fn box_width(figure: &Boxplots) -> f64 {
    let half = |b: &NotchedBox| 0.5 * libm::log(b.q3 / b.q1);
    let mut widths: Vec<f64> =
        summaries(figure).map(half).filter(|w| w.is_finite()).collect();
    widths.sort_by(f64::total_cmp);
    let middle = widths.get(widths.len() / 2).copied().unwrap_or(0.2);
    middle.clamp(0.01, 0.2)
}

fn draw_stripes(
    panel: &mut Panel<'_>,
    shown: &BoxPanel,
    ink: Ink,
    range: (f64, f64),
) {
    for (k, stripe) in shown.stripes.iter().enumerate() {
        let y = (k + 1) as f64;
        let percent = (100.0 * stripe.usable_share()).round();
        panel.right_of(y, format!("{percent} %"));
        if let Some(summary) = &stripe.summary {
            draw_box(panel, summary, y, ink, range);
        }
    }
}

fn draw_box(
    panel: &mut Panel<'_>,
    b: &NotchedBox,
    y: f64,
    ink: Ink,
    (low, high): (f64, f64),
) {
    let pen = Pen::new(ink, 0.9);
    let corners: Vec<Point> = [
        (b.q1, HALF),
        (b.notch_low, HALF),
        (b.median, WAIST),
        (b.notch_high, HALF),
        (b.q3, HALF),
        (b.q3, -HALF),
        (b.notch_high, -HALF),
        (b.median, -WAIST),
        (b.notch_low, -HALF),
        (b.q1, -HALF),
    ]
    .into_iter()
    .map(|(x, up)| panel.to_px((x.clamp(low, high), y + up)))
    .collect();
    if corners.iter().any(|c| !c.0.is_finite()) {
        return;
    }
    panel.mark_used();
    for x in &b.outliers {
        if *x >= low && *x <= high {
            panel.marks([(*x, y)], Marker::Cross, 2.6, ink);
        }
    }
    panel.line([(b.whisker_low, y), (b.q1, y)], pen);
    panel.line([(b.q3, y), (b.whisker_high, y)], pen);
    for end in [b.whisker_low, b.whisker_high] {
        let cap = HALF / 2.0;
        panel.line([(end, y - cap), (end, y + cap)], pen);
    }
    panel.scene().area(&corners, Fill::tint(ink, 24));
    panel.scene().outline(&corners, pen);
    let waist = [(b.median, y - WAIST), (b.median, y + WAIST)];
    panel.line(waist, Pen::new(ink, 1.6));
    if let Some((from, to)) = b.median_interval {
        panel.line([(from, y + BELOW), (to, y + BELOW)], INTERVAL);
    }
    let edges = [
        (b.outliers.iter().any(|x| *x > high), high, Marker::Beyond, -8.0),
        (b.outliers.iter().any(|x| *x < low), low, Marker::BeyondLeft, 8.0),
    ];
    for (wanted, edge, marker, inwards) in edges {
        if wanted {
            let (x, y) = panel.to_px((edge, y));
            marker.draw(panel.scene(), (x + inwards, y), 3.0, ink);
        }
    }
}
