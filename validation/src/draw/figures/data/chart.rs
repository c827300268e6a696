//! Lines and marks over two axes: speed against error, convergence,
//! overturning spectra, power of tests, arms and options compared.

use super::Heading;
use super::thin::{largest, thin};
use crate::table::{Table, number};

/// Size of a panel for [`Chart::thinned`], in px.
const WIDTH_PX: f64 = 560.0;
const HEIGHT_PX: f64 = 320.0;
/// Columns of a panel within which a line is its ends and extremes.
const COLUMNS: usize = 1120;

/// A figure of one or more panels with a shared legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Chart {
    /// The words.
    pub heading: Heading,
    /// Panels row by row.
    pub panels: Vec<ChartPanel>,
    /// Panels in a row.
    pub columns: usize,
}

/// One pair of axes.
#[derive(Debug, Clone, PartialEq)]
pub struct ChartPanel {
    /// Title in markup, or nothing.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// What is drawn, in this order.
    pub series: Vec<Series>,
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// Label with unit, in markup.
    pub label: String,
    /// Linear or logarithmic.
    pub scale: Scale,
    /// Both ends; none: from the data.
    pub range: Option<(f64, f64)>,
    /// Names of the ticks at 1, 2, 3 and so on; empty: numbers.
    pub categories: Vec<String>,
}

/// Scale of an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Scale {
    /// Linear.
    Linear,
    /// Logarithmic; values that are not positive are gaps.
    Logarithmic,
}

/// One legend entry's data.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Legend in markup; the same label has the same colour in every panel,
    /// an empty one is drawn in grey and has no legend.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
    /// Abscissas.
    pub x: Vec<f64>,
    /// Ordinates.
    pub y: Vec<f64>,
    /// Intervals of the ordinates (error bars, or a band with
    /// [`Mark::Line`]); empty: none.
    pub interval: Vec<(f64, f64)>,
}

/// How a series is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line.
    Line,
    /// A dashed line, such as a reference slope or a limit.
    Dashed,
    /// Marks alone.
    Points,
    /// Marks joined by a line.
    LineAndPoints,
}

impl Chart {
    /// The chart with no more points in its lines over linear axes than a
    /// drawing shows.
    #[must_use]
    pub fn thinned(mut self) -> Self {
        let linear = |p: &&mut ChartPanel| {
            p.x.scale == Scale::Linear && p.y.scale == Scale::Linear
        };
        for panel in self.panels.iter_mut().filter(linear) {
            let series = || panel.series.iter();
            let wide = largest(series().flat_map(|s| &s.x));
            let high = largest(series().flat_map(|s| &s.y));
            let px = (WIDTH_PX / wide, HEIGHT_PX / high);
            for series in &mut panel.series {
                if series.interval.is_empty() {
                    extremes(&mut series.x, &mut series.y);
                    thin(&mut series.x, &mut series.y, px);
                }
            }
        }
        self
    }

    /// `panel,series,x,y,y_low,y_high`.
    #[must_use]
    pub fn csv(&self) -> String {
        let mut table =
            Table::new(&["panel", "series", "x", "y", "y_low", "y_high"]);
        for (i, panel) in self.panels.iter().enumerate() {
            for series in &panel.series {
                for (k, (x, y)) in series.x.iter().zip(&series.y).enumerate() {
                    let (low, high) = series
                        .interval
                        .get(k)
                        .copied()
                        .unwrap_or((f64::NAN, f64::NAN));
                    table.row([
                        super::letter(i),
                        super::plain(&series.label),
                        number(*x),
                        number(*y),
                        number(low),
                        number(high),
                    ]);
                }
            }
        }
        table.finish()
    }
}

/// Leaves, of a long line, the first, lowest, highest and last point of every
/// stretch of it that a drawing cannot resolve.
fn extremes(x: &mut Vec<f64>, y: &mut Vec<f64>) {
    let stretch = y.len() / COLUMNS;
    if stretch < 8 {
        return;
    }
    let mut keep = vec![false; y.len()];
    for start in (0..y.len()).step_by(stretch) {
        let end = y.len().min(start + stretch);
        let (mut low, mut high) = (start, start);
        for i in start..end {
            if y[i] < y[low] {
                low = i;
            }
            if y[i] > y[high] {
                high = i;
            }
        }
        for i in [start, low, high, end - 1] {
            keep[i] = true;
        }
    }
    for values in [x, y] {
        let mut keep = keep.iter();
        values.retain(|_| keep.next() == Some(&true));
    }
}
