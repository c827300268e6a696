//! Figures 6, 7 and 9: notched boxplots of paired ratios by stripe. plotters
//! has boxplots, but without a notch and in single precision.

use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number};
use rocking_common::words::letter;
use rocking_statistics::Boxplot;
use serde::{Deserialize, Serialize};

use super::chart::{ChartPanel, Layout, Panels};
use super::common;
use super::series::{Mark, Series};
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::geometry::Point;
use crate::grid::Grid;
use crate::panel::{Look, Marker};

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
        self.usable as f64 / self.records.max(1) as f64
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
                let mut rows = vec![
                    ("usable", stripe.usable as f64),
                    ("records", stripe.records as f64),
                ];
                rows.extend(stripe.closed_form.map(|r| ("closed_form", r)));
                rows.extend(stripe.summary.iter().flat_map(quantities));
                for (quantity, value) in rows {
                    table.row([
                        letter(i),
                        number(panel.p_rad_s),
                        number(panel.alpha_rad),
                        String::new(),
                        Intensity::Pga.name().into(),
                        number(stripe.level),
                        quantity.into(),
                        number(value),
                    ]);
                }
            }
        }
        table.finish()
    }
}

/// What the CSV has of a box.
fn quantities(b: &Boxplot) -> Vec<(&'static str, f64)> {
    let interval = b.median_interval.map(|i| i.interval.ends());
    let (low, high) = interval.unwrap_or((f64::NAN, f64::NAN));
    let mut all = vec![
        ("whisker_low", b.whisker_low),
        ("q1", b.q1),
        ("notch_low", b.notch_low),
        ("median", b.median),
        ("notch_high", b.notch_high),
        ("q3", b.q3),
        ("whisker_high", b.whisker_high),
        ("median_low", low),
        ("median_high", high),
    ];
    all.extend(b.outliers.iter().map(|outlier| ("outlier", *outlier)));
    all
}

/// Half height of a box in units of the distance between stripes.
const HALF: f64 = 0.30;
/// Fewest ratios of a box with a notch: of fewer the notch often reaches
/// beyond the quartiles.
const NOTCHED: usize = 20;
/// Opacity of a box in percent.
const TINT: u8 = 24;
/// Half height at the notch.
const WAIST: f64 = 0.15;
/// Where the interval of the median is drawn, below the box.
const BELOW: f64 = -0.43;
const INTERVAL: Pen = Pen::new(Ink::Text, 1.0);
const ONE: Mark = Mark::Upright(Pen::new(Ink::Muted, 0.9));
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
    let width = [400.0, 400.0, 262.0, 166.0][grid.columns.min(4) - 1];
    let grid = Grid { right: 44.0, ..grid }.plot(width, height);
    // The usual range, or what boxes and whiskers need.
    let ends = boxes().flat_map(|b| {
        [b.notch_low, b.notch_high, b.whisker_low, b.whisker_high]
    });
    let (low, high) = common::span(ends, false).unwrap_or((1.0, 1.0));
    let low = (0.9 * low).clamp(WIDEST.0, USUAL.0);
    let high = (1.12 * high).clamp(USUAL.1, WIDEST.1);
    let x = Axis::about_one(low, high, STRETCH, 27.0 / width)
        .label(format!("{} (scale stretched about 1)", figure.ratio_label));
    let key = |shown: &BoxPanel| {
        let fill = Fill::tint(common::ink(shown.alpha_rad), TINT);
        let words = common::slenderness(shown.alpha_rad);
        Series::of(Look::band(fill), vec![], vec![]).labelled(words)
    };
    let panel = |shown: &BoxPanel| {
        let levels = shown.stripes.iter().map(|s| common::short(s.level));
        let y = Axis::named(&levels.collect::<Vec<_>>());
        let stripes = || (1..).map(f64::from).zip(&shown.stripes);
        let alpha = common::slenderness(shown.alpha_rad);
        let ink = common::ink(shown.alpha_rad);
        let mut series: Vec<_> = figure.panels.iter().map(key).collect();
        series.push(Series::note(ONE, "ratio 1", (1.0, 1.0)));
        for (y, stripe) in stripes() {
            series.extend(drawn(stripe, y, ink, (low, high)));
        }
        // Over the boxes: it is what their medians are compared with.
        let limits = stripes().filter_map(|(y, s)| Some((s.closed_form?, y)));
        let limits: Vec<Point> =
            limits.flat_map(|(x, y)| [(x, y - 0.5), (x, y + 0.5)]).collect();
        if !limits.is_empty() {
            let words = "closed form (sin *α*/*α*)/(sin 0.1/0.1)";
            series.push(line(limits, CLOSED_FORM).labelled(words));
        }
        let title = format!("{}, {alpha}", common::frequency(shown.p_rad_s));
        let level = Intensity::Pga.row().label;
        ChartPanel::new(title, x.clone(), y.label(level), series)
    };
    let panels = figure.panels.iter().map(panel).collect();
    let layout = Layout { grid: Some(grid), ..Layout::default() };
    Panels { panels, columns: figure.columns, layout }
}

fn line(points: impl IntoIterator<Item = Point>, pen: Pen) -> Series {
    let (x, y) = points.into_iter().unzip();
    Series::of(Look::line(pen), x, y)
}

/// A box at an ordinate, with the share of usable ratios beside it.
fn drawn(stripe: &Stripe, y: f64, ink: Ink, range: Point) -> Vec<Series> {
    let (low, high) = range;
    let share = format!("{} %", (100.0 * stripe.usable_share()).round());
    let mut all = vec![Series::note(Mark::Edge, share, (1.0, y))];
    let Some(b) = &stripe.summary else { return all };
    // Without a notch its ends are the median.
    let (notch_low, notch_high, waist) = match stripe.usable >= NOTCHED {
        true => (b.notch_low, b.notch_high, WAIST),
        false => (b.median, b.median, HALF),
    };
    let ends = [b.q1, notch_low, b.median, notch_high, b.q3];
    if ends.iter().any(|x| !x.is_finite()) {
        return all;
    }
    let x = ends.map(|x| x.clamp(low, high));
    let half = [HALF, HALF, waist, HALF, HALF];
    let body =
        Series::of(Look::band(Fill::tint(ink, TINT)), x.into(), vec![y; 5])
            .with(half.map(|up| (y - up, y + up)).into());
    let mark = |marker, half_px, x: Vec<f64>, words| {
        let words = if x.is_empty() { "" } else { words };
        let (look, y) = (Look::marks(marker, half_px, ink), vec![y; x.len()]);
        Series::of(look, x, y).labelled(words)
    };
    let outside = |is: fn(f64, f64) -> bool, end: f64| {
        let any = b.outliers.iter().any(|x| is(*x, end));
        any.then_some(end).into_iter().collect()
    };
    let inside = b.outliers.iter().copied();
    let inside = inside.filter(|x| (low..=high).contains(x)).collect();
    let more = "more outliers beyond the axis";
    let upper = x.into_iter().zip(half.map(|up| y + up));
    let lower = x.into_iter().zip(half.map(|up| y - up)).rev();
    let around = upper.chain(lower).chain([(x[0], y + HALF)]);
    let pen = Pen::new(ink, 0.9);
    let flat = |from, to| line([(from, y), (to, y)], pen);
    let across = |x, up, pen| line([(x, y - up), (x, y + up)], pen);
    all.extend([
        mark(Marker::Cross, 2.6, inside, "outlier"),
        mark(Marker::Beyond, 3.0, outside(|x, end| x > end, high), more),
        mark(Marker::BeyondLeft, 3.0, outside(|x, end| x < end, low), more),
        flat(b.whisker_low, b.q1),
        flat(b.q3, b.whisker_high),
        across(b.whisker_low, HALF / 2.0, pen),
        across(b.whisker_high, HALF / 2.0, pen),
        body,
        line(around, pen),
        across(b.median, waist, Pen::new(ink, 1.6)),
    ]);
    let interval = b.median_interval.map(|i| i.interval.ends());
    all.extend(interval.map(|(from, to)| {
        let points = [(from, y + BELOW), (to, y + BELOW)];
        line(points, INTERVAL).labelled("exact 95 % interval of the median")
    }));
    all
}
