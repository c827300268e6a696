//! Figures 6, 7 and 9: notched boxplots of paired ratios by stripe.

use super::common;
use super::heading::Heading;
use rocking_statistics::Boxplot;

use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::drawing::Drawing;
use crate::geometry::Point;
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::{Marker, Panel};
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number};
use rocking_common::words::letter;
use serde::{Deserialize, Serialize};

/// Notched boxplots of paired ratios, stripe by stripe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Boxplots {
    /// What is compared, in markup: `*r*_{α} = *θ̃*_{α} / *θ̃*_{0.10}`.
    pub ratio_label: String,
    /// Panels row by row.
    pub panels: Vec<BoxPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One pair of blocks.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BoxPanel {
    /// Frequency parameter p.
    pub p_rad_s: f64,
    /// Slenderness of the compared block; the colour of the boxes goes by
    /// it.
    pub alpha_rad: f64,
    /// Stripes in rising level.
    pub stripes: Vec<Stripe>,
}

/// One level of the intensity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Stripe {
    /// The level.
    pub level: f64,
    /// Number of well-defined ratios.
    pub usable: usize,
    /// Number of records.
    pub records: usize,
    /// The ratio that the small-rotation limit of Eq. 1 gives, where there is
    /// one: a thin line.
    pub closed_form: Option<f64>,
    /// The box; none where too few ratios are usable.
    pub summary: Option<Boxplot>,
}

impl Stripe {
    /// Share of the records with a well-defined ratio, 0 to 1.
    pub fn usable_share(&self) -> f64 {
        if self.records == 0 {
            return 0.0;
        }
        self.usable as f64 / self.records as f64
    }
}

impl Boxplots {
    /// One row a stripe, then one row an outlier:
    /// `panel,p_rad_s,alpha_rad,note,stripe_kind,level,quantity,value`.
    pub(super) fn csv(&self) -> String {
        let mut table = Table::headed(
            "panel,p_rad_s,alpha_rad,note,stripe_kind,level,quantity,value",
        );
        for (i, panel) in self.panels.iter().enumerate() {
            for stripe in &panel.stripes {
                let mut row = |quantity: &str, value: String| {
                    table.row([
                        letter(i),
                        number(panel.p_rad_s),
                        number(panel.alpha_rad),
                        String::new(),
                        Intensity::Pga.name().into(),
                        number(stripe.level),
                        quantity.into(),
                        value,
                    ]);
                };
                row("usable", stripe.usable.to_string());
                row("records", stripe.records.to_string());
                if let Some(ratio) = stripe.closed_form {
                    row("closed_form", number(ratio));
                }
                let Some(b) = &stripe.summary else { continue };
                let interval = b.median_interval.map(|i| i.interval.ends());
                let (low, high) = interval.unwrap_or((f64::NAN, f64::NAN));
                for (quantity, value) in [
                    ("whisker_low", b.whisker_low),
                    ("q1", b.q1),
                    ("notch_low", b.notch_low),
                    ("median", b.median),
                    ("notch_high", b.notch_high),
                    ("q3", b.q3),
                    ("whisker_high", b.whisker_high),
                    ("median_low", low),
                    ("median_high", high),
                ] {
                    row(quantity, number(value));
                }
                for outlier in &b.outliers {
                    row("outlier", number(*outlier));
                }
            }
        }
        table.finish()
    }
}

/// Half height of a box in units of the distance between stripes.
const HALF: f64 = 0.30;
/// Fewest ratios of a box with a notch: of fewer the notch often reaches
/// beyond the quartiles.
const NOTCHED: usize = 20;
/// Half height at the notch.
const WAIST: f64 = 0.15;
/// Where the interval of the median is drawn, below the box.
const BELOW: f64 = -0.43;
const INTERVAL: Pen = Pen::new(Ink::Text, 1.0);
const ONE: Pen = Pen::new(Ink::Muted, 0.9);
const CLOSED_FORM: Pen = Pen::new(Ink::Series(1), 1.1).dash(Dash::Short);
/// The range of every figure, unless a whisker reaches farther; outliers
/// beyond are left out, with an arrow head at the edge.
const USUAL: (f64, f64) = (0.2, 5.0);
/// The widest range.
const WIDEST: (f64, f64) = (0.1, 10.0);
/// Width about 1, in ln, within which the axis of every figure is linear.
const STRETCH: f64 = 0.005;

pub(super) fn scene(heading: &Heading, figure: &Boxplots) -> Drawing {
    let most = figure.panels.iter().map(|p| p.stripes.len()).max();
    let height = 21.0 * most.unwrap_or(0).clamp(6, 16) as f64;
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let width = match grid.columns {
        1 | 2 => 400.0,
        3 => 262.0,
        _ => 166.0,
    };
    let grid = Grid { right: 44.0, ..grid }.plot(width, height);
    let (low, high) = ratio_range(figure);
    let mut legend: Vec<Entry> = Vec::new();
    for alpha in figure.panels.iter().map(|p| p.alpha_rad) {
        let words = common::slenderness(alpha);
        if figure.panels.len() > 1 && legend.iter().all(|e| e.label != words) {
            legend.push(Entry::new(Sample::Box(common::ink(alpha)), words));
        }
    }
    let cross = Sample::Mark(Marker::Cross, Ink::Text);
    legend.push(Entry::new(cross, "outlier"));
    if summaries(figure).any(|b| b.median_interval.is_some()) {
        let words = "exact 95 % interval of the median";
        legend.push(Entry::new(Sample::Line(INTERVAL), words));
    }
    let mut stripes = figure.panels.iter().flat_map(|panel| &panel.stripes);
    if stripes.any(|stripe| stripe.closed_form.is_some()) {
        legend.push(Entry::new(Sample::Line(ONE), "ratio 1"));
        let words = "closed form (sin *α*/*α*)/(sin 0.1/0.1)";
        legend.push(Entry::new(Sample::Line(CLOSED_FORM), words));
    }
    let beyond =
        |b: &Boxplot| b.outliers.iter().any(|x| *x > high || *x < low);
    if summaries(figure).any(beyond) {
        let arrow = Sample::Mark(Marker::Beyond, Ink::Text);
        legend.push(Entry::new(arrow, "more outliers beyond the axis"));
    }
    let level = Intensity::Pga.row().label;
    common::panels(heading, grid, &legend, |canvas, grid| {
        for (i, shown) in figure.panels.iter().enumerate() {
            let levels = shown.stripes.iter().map(|s| common::short(s.level));
            let y = Axis::named(&levels.collect::<Vec<_>>()).label(level);
            let x = Axis::about_one(low, high, STRETCH, 27.0 / width).label(
                format!("{} (scale stretched about 1)", figure.ratio_label),
            );
            let mut panel = Panel::new(canvas, grid.frame(i), (x, y), None);
            panel.vertical(1.0, ONE);
            let ink = common::ink(shown.alpha_rad);
            draw_stripes(&mut panel, shown, ink, (low, high));
            // Over the boxes: it is what their medians are compared with.
            let stripes = shown.stripes.iter().enumerate();
            let expected = stripes.filter_map(|(k, stripe)| {
                let (ratio, y) = (stripe.closed_form?, (k + 1) as f64);
                Some([(ratio, y - 0.5), (ratio, y + 0.5)])
            });
            panel.line(expected.flatten(), CLOSED_FORM);
            let title = format!(
                "{}, {}",
                common::frequency(shown.p_rad_s),
                common::slenderness(shown.alpha_rad)
            );
            panel.finish(&common::panel_title(i, &title), "");
        }
    })
}

fn summaries(figure: &Boxplots) -> impl Iterator<Item = &Boxplot> {
    let stripes = figure.panels.iter().flat_map(|p| &p.stripes);
    stripes.filter_map(|s| s.summary.as_ref())
}

/// The usual range, or what boxes and whiskers need.
fn ratio_range(figure: &Boxplots) -> (f64, f64) {
    let ends = summaries(figure).flat_map(|b| {
        [b.notch_low, b.notch_high, b.whisker_low, b.whisker_high]
    });
    let (low, high) = common::span(ends, false).unwrap_or((1.0, 1.0));
    (
        (0.9 * low).clamp(WIDEST.0, USUAL.0),
        (1.12 * high).clamp(USUAL.1, WIDEST.1),
    )
}

/// Boxes, with the share of usable ratios beside them.
fn draw_stripes(
    panel: &mut Panel<'_>,
    shown: &BoxPanel,
    ink: Ink,
    (low, high): (f64, f64),
) {
    for (k, stripe) in shown.stripes.iter().enumerate() {
        let y = (k + 1) as f64;
        let percent = (100.0 * stripe.usable_share()).round();
        let (_, y_px) = panel.to_px((1.0, y));
        panel.right_of_px(y_px, &format!("{percent} %"));
        let Some(b) = &stripe.summary else { continue };
        let notched = stripe.usable >= NOTCHED;
        let pen = Pen::new(ink, 0.9);
        let waist = if notched { WAIST } else { HALF };
        // Without a notch its ends are the median.
        let notch = |end: f64| if notched { end } else { b.median };
        let upper = [
            (b.q1, HALF),
            (notch(b.notch_low), HALF),
            (b.median, waist),
            (notch(b.notch_high), HALF),
            (b.q3, HALF),
        ];
        let lower = upper.iter().rev().map(|(x, up)| (*x, -up));
        let at = |(x, up): Point| (x.clamp(low, high), y + up);
        let mut corners: Vec<Point> =
            upper.into_iter().chain(lower).map(at).collect();
        if corners.iter().any(|c| !c.0.is_finite()) {
            continue;
        }
        let inside = b.outliers.iter().filter(|x| (low..=high).contains(*x));
        let cross = (Marker::Cross, 2.6, ink);
        panel.marks(inside.map(|x| (*x, y)), cross, (0.0, 0.0));
        panel.line([(b.whisker_low, y), (b.q1, y)], pen);
        panel.line([(b.q3, y), (b.whisker_high, y)], pen);
        for end in [b.whisker_low, b.whisker_high] {
            let cap = HALF / 2.0;
            panel.line([(end, y - cap), (end, y + cap)], pen);
        }
        panel.area(corners.clone(), Fill::tint(ink, 24));
        corners.push(corners[0]);
        panel.line(corners, pen);
        let median = [(b.median, y - waist), (b.median, y + waist)];
        panel.line(median, Pen::new(ink, 1.6));
        if let Some(interval) = b.median_interval {
            let (from, to) = interval.interval.ends();
            panel.line([(from, y + BELOW), (to, y + BELOW)], INTERVAL);
        }
        let above = b.outliers.iter().any(|x| *x > high);
        let below = b.outliers.iter().any(|x| *x < low);
        let (right, left) = (Marker::Beyond, Marker::BeyondLeft);
        let above = above.then_some((high, y));
        panel.marks(above, (right, 3.0, ink), (-8.0, 0.0));
        let below = below.then_some((low, y));
        panel.marks(below, (left, 3.0, ink), (8.0, 0.0));
    }
}
