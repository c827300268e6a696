//! Figures 6, 7 and 9: notched boxplots of paired ratios by stripe. plotters
//! has boxplots, but without a notch and in single precision.

use std::iter::once;

use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number};
use rocking_common::words::letter;
use rocking_statistics::Boxplot;
use serde::{Deserialize, Serialize};

use super::chart::{ChartPanel, Layout, Panels};
use super::common;
use super::series::{Look, Mark, Series};
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::geometry::Point;
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::Marker;

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

/// The boxes as lines, bands and marks.
pub(super) fn panels(figure: &Boxplots) -> Panels {
    let stripes = || figure.panels.iter().flat_map(|p| &p.stripes);
    let boxes = || stripes().filter_map(|s| s.summary.as_ref());
    let most = figure.panels.iter().map(|p| p.stripes.len()).max();
    let height = 21.0 * most.unwrap_or(0).clamp(6, 16) as f64;
    let grid = Grid::new(figure.panels.len(), figure.columns);
    let width = match grid.columns {
        1 | 2 => 400.0,
        3 => 262.0,
        _ => 166.0,
    };
    let grid = Grid { right: 44.0, ..grid }.plot(width, height);
    // The usual range, or what boxes and whiskers need.
    let ends = boxes().flat_map(|b| {
        [b.notch_low, b.notch_high, b.whisker_low, b.whisker_high]
    });
    let (low, high) = common::span(ends, false).unwrap_or((1.0, 1.0));
    let low = (0.9 * low).clamp(WIDEST.0, USUAL.0);
    let high = (1.12 * high).clamp(USUAL.1, WIDEST.1);
    let mut legend: Vec<Entry> = Vec::new();
    for alpha in figure.panels.iter().map(|p| p.alpha_rad) {
        let words = common::slenderness(alpha);
        if figure.panels.len() > 1 && legend.iter().all(|e| e.label != words) {
            legend.push(Entry::new(Sample::Box(common::ink(alpha)), words));
        }
    }
    let mark = |marker| Sample::Mark(marker, Ink::Text);
    let outside = |x: &f64| *x > high || *x < low;
    let closed = stripes().any(|stripe| stripe.closed_form.is_some());
    for (shown, sample, words) in [
        (true, mark(Marker::Cross), "outlier"),
        (
            boxes().any(|b| b.median_interval.is_some()),
            Sample::Line(INTERVAL),
            "exact 95 % interval of the median",
        ),
        (closed, Sample::Line(ONE), "ratio 1"),
        (
            closed,
            Sample::Line(CLOSED_FORM),
            "closed form (sin *α*/*α*)/(sin 0.1/0.1)",
        ),
        (
            boxes().any(|b| b.outliers.iter().any(outside)),
            mark(Marker::Beyond),
            "more outliers beyond the axis",
        ),
    ] {
        legend.extend(shown.then(|| Entry::new(sample, words)));
    }
    let x = Axis::about_one(low, high, STRETCH, 27.0 / width)
        .label(format!("{} (scale stretched about 1)", figure.ratio_label));
    let panel = |shown: &BoxPanel| {
        let levels = shown.stripes.iter().map(|s| common::short(s.level));
        let y = Axis::named(&levels.collect::<Vec<_>>());
        let ink = common::ink(shown.alpha_rad);
        let stripes = || (1..).map(f64::from).zip(&shown.stripes);
        let boxes = stripes()
            .flat_map(|(y, stripe)| drawn(stripe, y, ink, (low, high)));
        // Over the boxes: it is what their medians are compared with.
        let expected =
            stripes().filter_map(|(y, s)| Some((s.closed_form?, y)));
        let expected =
            expected.flat_map(|(x, y)| [(x, y - 0.5), (x, y + 0.5)]);
        let one = Series::note(Mark::Upright(ONE), "", (1.0, 1.0));
        let series =
            once(one).chain(boxes).chain(once(line(expected, CLOSED_FORM)));
        let title = format!(
            "{}, {}",
            common::frequency(shown.p_rad_s),
            common::slenderness(shown.alpha_rad)
        );
        let level = Intensity::Pga.row().label;
        ChartPanel::new(title, x.clone(), y.label(level), series.collect())
    };
    let panels = figure.panels.iter().map(panel).collect();
    let layout = Layout { grid: Some(grid), legend, ..Layout::default() };
    Panels { panels, columns: figure.columns, layout }
}

fn line(points: impl IntoIterator<Item = Point>, pen: Pen) -> Series {
    let (x, y) = points.into_iter().unzip();
    Series::of(Look::line(pen), x, y)
}

/// A box at an ordinate, with the share of usable ratios beside it.
fn drawn(stripe: &Stripe, y: f64, ink: Ink, range: Point) -> Vec<Series> {
    let percent = (100.0 * stripe.usable_share()).round();
    let share = format!("{percent} %");
    let mut all = vec![Series::note(Mark::Edge, share, (1.0, y))];
    let Some(b) = &stripe.summary else { return all };
    let (low, high) = range;
    let notched = stripe.usable >= NOTCHED;
    let waist = if notched { WAIST } else { HALF };
    // Without a notch its ends are the median.
    let notch = |end: f64| if notched { end } else { b.median };
    let half = [
        (b.q1, HALF),
        (notch(b.notch_low), HALF),
        (b.median, waist),
        (notch(b.notch_high), HALF),
        (b.q3, HALF),
    ];
    if half.iter().any(|(x, _)| !x.is_finite()) {
        return all;
    }
    let half = half.map(|(x, up)| (x.clamp(low, high), up));
    let mut mark = |marker, half_px, x: Vec<f64>| {
        let y = vec![y; x.len()];
        all.push(Series::of(Look::marks(marker, half_px, ink), x, y));
    };
    let (out, rest): (Vec<f64>, Vec<f64>) =
        b.outliers.iter().partition(|x| !(low..=high).contains(*x));
    mark(Marker::Cross, 2.6, rest);
    if out.iter().any(|x| *x > high) {
        mark(Marker::Beyond, 3.0, vec![high]);
    }
    if out.iter().any(|x| *x < low) {
        mark(Marker::BeyondLeft, 3.0, vec![low]);
    }
    let pen = Pen::new(ink, 0.9);
    let flat = |from, to, up, pen| line([(from, y + up), (to, y + up)], pen);
    let across = |x, up, pen| line([(x, y - up), (x, y + up)], pen);
    let body = Look::band(Fill::tint(ink, 24));
    let ends = half.map(|(_, up)| (y - up, y + up)).into();
    let around =
        half.into_iter().chain(half.map(|(x, up)| (x, -up)).into_iter().rev());
    let around = around.chain([half[0]]).map(|(x, up)| (x, y + up));
    all.extend([
        flat(b.whisker_low, b.q1, 0.0, pen),
        flat(b.q3, b.whisker_high, 0.0, pen),
        across(b.whisker_low, HALF / 2.0, pen),
        across(b.whisker_high, HALF / 2.0, pen),
        Series::of(body, half.map(|(x, _)| x).into(), vec![y; 5]).with(ends),
        line(around, pen),
        across(b.median, waist, Pen::new(ink, 1.6)),
    ]);
    let interval = b.median_interval.map(|i| i.interval.ends());
    all.extend(interval.map(|(from, to)| flat(from, to, BELOW, INTERVAL)));
    all
}
