//! A map of fates in the plane of frequency and amplitude.

use super::common;
use super::figure::{Figure, Graphic};
use super::heading::Heading;
use crate::axis::Axis;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::legend::{Entry, Sample};
use crate::panel::Panel;
use crate::scene::Drawing;
use rocking::names::named;
use rocking_common::table::{Table, number};

named! {
    /// What becomes of a block.
    pub enum MapFate: "fate" {
        /// It comes to rest.
        Stands = "stands",
        /// It overturns before an impact.
        Before = "overturns before an impact",
        /// It overturns after one impact.
        AfterOne = "overturns after one impact",
        /// It overturns after two impacts or more.
        AfterMore = "overturns after two impacts or more",
    }
}

impl MapFate {
    /// The fate of a block that overturns after so many impacts, if it does.
    pub fn after(impacts: Option<usize>) -> Self {
        match impacts {
            None => Self::Stands,
            Some(0) => Self::Before,
            Some(1) => Self::AfterOne,
            Some(_) => Self::AfterMore,
        }
    }

    fn fill(self) -> Option<Fill> {
        match self {
            Self::Stands => None,
            Self::Before => Some(Fill::tint(Ink::Series(0), 45)),
            Self::AfterOne => Some(Fill::tint(Ink::Series(2), 60)),
            Self::AfterMore => Some(Fill::solid(Ink::Series(1))),
        }
    }
}

/// Fates by frequency and amplitude, with boundaries over them.
#[derive(Debug, Clone, PartialEq)]
pub struct FateMap {
    /// The words.
    pub heading: Heading,
    /// Ends of the columns: frequency of the pulse over p, rising.
    pub frequencies: Vec<f64>,
    /// Ends of the rows: amplitude over the uplift threshold, rising.
    pub amplitudes: Vec<f64>,
    /// By column, then by row.
    pub cells: Vec<Vec<MapFate>>,
    /// Name and points of each boundary.
    pub boundaries: Vec<(String, Vec<(f64, f64)>)>,
}

impl FateMap {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        let drawn = Graphic::Other(scene(self), self.csv());
        Figure::new(&self.heading, drawn, reading)
    }

    /// `what,frequency_over_p,amplitude_from,amplitude_to`: in each column
    /// the rows of one fate together, at its middle; then the boundaries.
    fn csv(&self) -> String {
        let mut table =
            Table::headed("what,frequency_over_p,amplitude_from,amplitude_to");
        for (x, cells) in self.frequencies.windows(2).zip(&self.cells) {
            let middle = number((x[0] * x[1]).sqrt());
            for (fate, from, to) in self.runs(cells) {
                table.row([
                    fate.name().into(),
                    middle.clone(),
                    number(from),
                    number(to),
                ]);
            }
        }
        for (name, points) in &self.boundaries {
            for (x, y) in points {
                table.row([name.clone(), number(*x), number(*y), number(*y)]);
            }
        }
        table.finish()
    }

    /// Rows of a column with the same fate together: fate, ends.
    fn runs(&self, cells: &[MapFate]) -> Vec<(MapFate, f64, f64)> {
        let mut out: Vec<(MapFate, f64, f64)> = Vec::new();
        for (fate, y) in cells.iter().zip(self.amplitudes.windows(2)) {
            match out.last_mut() {
                Some(last) if last.0 == *fate => last.2 = y[1],
                _ => out.push((*fate, y[0], y[1])),
            }
        }
        out
    }
}

fn pen(boundary: usize) -> Pen {
    let dash = if boundary == 0 { Dash::Solid } else { Dash::Dashed };
    Pen::new(Ink::Text, 1.6).dash(dash)
}

fn scene(figure: &FateMap) -> Drawing {
    let entry = |fate: MapFate| {
        Some(Entry::new(Sample::Band(fate.fill()?), fate.name()))
    };
    let mut legend: Vec<Entry> =
        MapFate::ALL.into_iter().filter_map(entry).collect();
    for (k, (name, _)) in figure.boundaries.iter().enumerate() {
        legend.push(Entry::new(Sample::Line(pen(k)), name.as_str()));
    }
    let grid = Grid::new(1, 1).plot(600.0, 360.0);
    let (mut scene, grid) = common::scene(&figure.heading, grid, &legend);
    let ends = |values: &[f64]| match values {
        [first, .., last] => (*first, *last),
        _ => (1.0, 10.0),
    };
    let (low, high) = ends(&figure.frequencies);
    let x = Axis::logarithmic(low, high).label("pulse frequency *ω*/*p*");
    let (low, high) = ends(&figure.amplitudes);
    let y = Axis::logarithmic(low, high)
        .label("amplitude over the threshold *g* tan *α*");
    let mut panel = Panel::new(&mut scene, grid.frame(0), x, y);
    for (x, cells) in figure.frequencies.windows(2).zip(&figure.cells) {
        for (fate, from, to) in figure.runs(cells) {
            if let Some(fill) = fate.fill() {
                panel.bar((x[0], from), (x[1], to), fill);
            }
        }
    }
    for (k, (_, points)) in figure.boundaries.iter().enumerate() {
        panel.line(points.iter().copied(), pen(k));
    }
    panel.finish("white: the block comes to rest", "");
    scene
}
