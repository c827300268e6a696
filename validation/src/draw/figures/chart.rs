//! Lines and marks over two axes: the figures that the paper does not have.

use super::Figure;
use super::common;
use super::data;
use super::data::{Chart, ChartPanel, Heading, Mark, Scale, Series};
use crate::draw::{
    Axis, Dash, Entry, Fill, Grid, Ink, Marker, Panel, Pen, Sample, Scene,
};

impl Figure for Chart {
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

/// Sizes of the plotting areas for a number of columns.
pub(super) fn grid(panels: usize, columns: usize) -> Grid {
    let grid = Grid::new(panels, columns);
    match grid.columns {
        1 => grid.plot(560.0, 320.0),
        2 => grid.plot(440.0, 280.0),
        _ => grid,
    }
}

pub(super) fn scene(figure: &Chart) -> Scene {
    let mut labels: Vec<&Series> = Vec::new();
    for series in figure.panels.iter().flat_map(|p| &p.series) {
        let known = labels.iter().any(|s| s.label == series.label);
        if !series.label.is_empty() && !known {
            labels.push(series);
        }
    }
    let legend: Vec<Entry> = labels
        .iter()
        .enumerate()
        .map(|(k, s)| Entry::new(sample(s.mark, k), s.label.as_str()))
        .collect();
    let grid = grid(figure.panels.len(), figure.columns);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    for (i, shown) in figure.panels.iter().enumerate() {
        let (x, y) = axes(shown);
        let mut panel = Panel::new(&mut scene, grid.frame(i), x, y);
        for series in &shown.series {
            let rank = labels.iter().position(|s| s.label == series.label);
            draw_series(&mut panel, series, rank);
        }
        let title = if figure.panels.len() > 1 {
            common::panel_title(i, &shown.title)
        } else {
            shown.title.clone()
        };
        panel.finish(&title, "");
    }
    scene
}

fn sample(mark: Mark, rank: usize) -> Sample {
    let pen = pen(mark, Some(rank));
    let marker = Marker::of_series(rank);
    match mark {
        Mark::Line | Mark::Dashed => Sample::Line(pen),
        Mark::Points => Sample::Mark(marker, pen.ink),
        Mark::LineAndPoints => Sample::LineAndMark(pen, marker),
    }
}

fn pen(mark: Mark, rank: Option<usize>) -> Pen {
    let Some(rank) = rank else {
        return Pen::new(Ink::Muted, 0.9).dash(Dash::Dashed);
    };
    match mark {
        Mark::Dashed => Pen::new(Ink::Series(rank), 1.1).dash(Dash::Dashed),
        Mark::Line => Pen::of_series(rank),
        Mark::Points | Mark::LineAndPoints => Pen::new(Ink::Series(rank), 1.1),
    }
}

fn axes(shown: &ChartPanel) -> (Axis, Axis) {
    let xs = shown.series.iter().flat_map(|s| s.x.iter().copied());
    let ys = shown.series.iter().flat_map(|s| {
        let ends = s.interval.iter().flat_map(|(low, high)| [*low, *high]);
        s.y.iter().copied().chain(ends)
    });
    (axis(&shown.x, xs), axis(&shown.y, ys))
}

/// The axis asked for, fitted to the data where no range is given.
pub(super) fn axis(
    asked: &data::Axis,
    values: impl Iterator<Item = f64>,
) -> Axis {
    if !asked.categories.is_empty() {
        return Axis::named(&asked.categories).label(asked.label.as_str());
    }
    let logarithmic = asked.scale == Scale::Logarithmic;
    let span = asked.range.or_else(|| common::span(values, logarithmic));
    let (low, high) = span.unwrap_or((1.0, 10.0));
    let axis = match (logarithmic, asked.range) {
        (true, Some(_)) => Axis::logarithmic(low, high),
        (true, None) => Axis::logarithmic(low / 1.3, high * 1.3),
        (false, Some(_)) => Axis::linear(low, high, 6),
        (false, None) => Axis::around(low, high, 6),
    };
    axis.label(asked.label.as_str())
}

fn draw_series(panel: &mut Panel<'_>, series: &Series, rank: Option<usize>) {
    let pen = pen(series.mark, rank);
    let points = || series.x.iter().zip(&series.y).map(|(x, y)| (*x, *y));
    let ends = series.x.iter().zip(&series.interval);
    let marked = matches!(series.mark, Mark::Points | Mark::LineAndPoints);
    if marked {
        for (x, (low, high)) in ends {
            let bar = Pen { width_px: 0.8, ..pen };
            panel.line([(*x, *low), (*x, *high)], bar);
        }
    } else {
        let rows: Vec<_> = ends.map(|(x, (a, b))| (*x, *a, *b)).collect();
        panel.band(&rows, Fill::tint(pen.ink, 16));
    }
    if series.mark != Mark::Points {
        panel.line(points(), pen);
    }
    if marked {
        let marker = Marker::of_series(rank.unwrap_or(0));
        panel.marks(points(), marker, 3.0, pen.ink);
    }
}
