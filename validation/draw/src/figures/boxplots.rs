//! Figures 6, 7 and 9: medians and notched boxplots of paired ratios by stripe.
//! plotters has boxplots, but without a notch and in single precision.

use rocking_common::paper::Intensity;
use rocking_common::table::{Table, number};
use rocking_common::words::letter;
use rocking_statistics::Boxplot;
use serde::{Deserialize, Serialize};

use super::chart::{ChartPanel, Layout, Panels};
use super::common;
use super::series::{Mark, Series};
use crate::axis::Axis;
use crate::colour::{Fill, Ink, Pen};
use crate::geometry::Point;
use crate::grid::Grid;
use crate::panel::{Look, Marker};

/// Notched boxplots of paired ratios, stripe by stripe.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Boxplots {
    /// What is compared, in markup: `*r*_{α} = *θ̃*_{α} / *θ̃*_{0.10}`.
    pub ratio_label: String,
    /// The blocks, those of one frequency parameter behind each other.
    pub panels: Vec<BoxPanel>,
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
/// Distance between the medians of one stripe.
const APART: f64 = 0.18;
const ZERO: Mark = Mark::Upright(Pen::new(Ink::Muted, 0.9));
/// Ratios that the boxes show, as in the paper; outliers beyond are left out,
/// with an arrow head at the edge.
const RATIOS: (f64, f64) = (0.5, 2.0);
/// Width of a panel, and height of a stripe, in px.
const WIDTH: f64 = 400.0;
const STRIPE: f64 = 21.0;

/// For each frequency parameter the medians against the closed form, and the
/// boxes of its last block, as in the paper.
pub(super) fn panels(figure: &Boxplots) -> Panels {
    let most = figure.panels.iter().map(|p| p.stripes.len()).max();
    let height = STRIPE * most.unwrap_or(0).clamp(6, 16) as f64;
    let by_p = || figure.panels.chunk_by(|a, b| a.p_rad_s == b.p_rad_s);
    let grid = Grid::new(2 * by_p().count(), 2);
    let grid = Grid { right: 44.0, ..grid }.plot(WIDTH, height);
    let all = figure.panels.iter().flat_map(|p| &p.stripes);
    let known = all.filter(|s| s.usable >= NOTCHED).filter_map(Stripe::median);
    let most = known.fold(0.2, |most: f64, (at, ..)| most.max(at.abs()));
    let reach = 1.6 * most;
    let panels = by_p().flat_map(|blocks| {
        let last = &blocks[blocks.len() - 1];
        let levels = |shown: &BoxPanel| {
            let names = shown.stripes.iter().map(|s| common::short(s.level));
            let axis = Axis::named(&names.collect::<Vec<_>>());
            axis.label(Intensity::Pga.row().label)
        };
        let longest = blocks.iter().max_by_key(|b| b.stripes.len());
        let p = common::frequency(last.p_rad_s);
        let medians = ChartPanel::new(
            format!("{p}, medians"),
            Axis::linear(-reach, reach, 6).label(format!(
                "deviation of median {} from closed form (%)",
                figure.ratio_label
            )),
            levels(longest.unwrap_or(last)),
            medians(blocks, reach),
        );
        let mut series = vec![Series::note(ZERO, "", (1.0, 1.0))];
        for (y, stripe) in (1..).map(f64::from).zip(&last.stripes) {
            series.extend(drawn(stripe, y, common::ink(last.alpha_rad)));
        }
        let alpha = common::slenderness(last.alpha_rad);
        let boxes = ChartPanel::new(
            format!("{p}, {alpha}, boxplots"),
            Axis::linear(RATIOS.0, RATIOS.1, 6).label(&*figure.ratio_label),
            levels(last),
            series,
        );
        [medians, boxes]
    });
    let layout = Layout { grid: Some(grid), ..Layout::default() };
    Panels { panels: panels.collect(), columns: 2, layout }
}

/// The medians of blocks with their intervals, per cent off the closed form;
/// an interval that reaches the frame ends in an arrow head.
fn medians(blocks: &[BoxPanel], reach: f64) -> Vec<Series> {
    let mut all = vec![Series::note(ZERO, "", (0.0, 0.0))];
    let middle = (blocks.len() as f64 - 1.0) / 2.0;
    for (k, shown) in blocks.iter().enumerate() {
        let ink = common::ink(shown.alpha_rad);
        let own: Vec<(f64, MedianOff)> = (1..)
            .map(|row| f64::from(row) + APART * (k as f64 - middle))
            .zip(&shown.stripes)
            .filter_map(|(y, stripe)| Some((y, stripe.median()?)))
            .collect();
        for &(y, (_, interval)) in &own {
            let Some((low, high)) = interval else { continue };
            let (from, to) = (low.max(-reach), high.min(reach));
            let pen = Pen::new(ink, 1.0);
            all.push(line([(from, y), (to, y)], pen));
            let cut = |marker, x| {
                Series::of(Look::marks(marker, 2.6, ink), vec![x], vec![y])
            };
            all.extend((high > reach).then(|| cut(Marker::Beyond, reach)));
            all.extend(
                (low < -reach).then(|| cut(Marker::BeyondLeft, -reach)),
            );
        }
        let inside = own.iter().filter(|(_, (at, _))| at.abs() <= reach);
        let (x, y) = inside.map(|(y, (at, _))| (*at, *y)).unzip();
        let look = Look::marks(Marker::of_series(k), 2.6, ink);
        let words = common::slenderness(shown.alpha_rad);
        all.push(Series::of(look, x, y).labelled(words));
    }
    all
}

/// A median and its interval.
type MedianOff = (f64, Option<(f64, f64)>);

impl Stripe {
    /// The median and its interval, per cent off the closed form.
    fn median(&self) -> Option<MedianOff> {
        let b = self.summary.as_ref()?;
        let of = self.closed_form.unwrap_or(1.0);
        let off = |x: f64| 100.0 * (x / of - 1.0);
        let interval = b.median_interval.map(|i| i.interval.ends());
        let interval = interval.map(|(low, high)| (off(low), off(high)));
        b.median.is_finite().then_some((off(b.median), interval))
    }
}

fn line(points: impl IntoIterator<Item = Point>, pen: Pen) -> Series {
    let (x, y) = points.into_iter().unzip();
    Series::of(Look::line(pen), x, y)
}

/// A box at an ordinate, with the share of usable ratios beside it.
fn drawn(stripe: &Stripe, y: f64, ink: Ink) -> Vec<Series> {
    let (low, high) = RATIOS;
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
    all
}
