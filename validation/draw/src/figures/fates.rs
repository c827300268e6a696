//! A map of fates in the plane of frequency and amplitude.

use super::chart::{ChartAxis, ChartPanel, Layout, Panels};
use super::figure::{Figure, Graphic};
use super::heading::Heading;
use super::series::Series;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::panel::Look;
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

    fn fill(self) -> Fill {
        match self {
            Self::Stands => Fill::solid(Ink::Paper),
            Self::Before => Fill::tint(Ink::Series(0), 45),
            Self::AfterOne => Fill::tint(Ink::Series(2), 60),
            Self::AfterMore => Fill::solid(Ink::Series(1)),
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
        let drawn = Graphic::Fates(self.clone());
        Figure::new(&self.heading, drawn, reading)
    }

    /// `what,frequency_over_p,amplitude_from,amplitude_to`: in each column
    /// the rows of one fate together, at its middle; then the boundaries.
    pub(super) fn csv(&self) -> String {
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

/// Columns as bands, and the boundaries over them.
pub(super) fn panels(figure: &FateMap) -> Panels {
    let legend = |fate: MapFate| {
        let look = Look::band(fate.fill());
        Series::of(look, vec![], vec![]).labelled(fate.name())
    };
    let mut series: Vec<_> = MapFate::ALL.into_iter().map(legend).collect();
    for (x, cells) in figure.frequencies.windows(2).zip(&figure.cells) {
        let mut runs = figure.runs(cells);
        runs.retain(|(fate, ..)| *fate != MapFate::Stands);
        for (fate, from, to) in runs {
            let (look, y) = (Look::band(fate.fill()), vec![f64::NAN; 2]);
            let column = Series::of(look, x.to_vec(), y);
            series.push(column.with(vec![(from, to); 2]));
        }
    }
    let dashes = [Dash::Solid, Dash::Dashed].into_iter().cycle();
    for ((name, points), dash) in figure.boundaries.iter().zip(dashes) {
        let look = Look::line(Pen::new(Ink::Text, 1.6).dash(dash));
        let (x, y) = points.iter().copied().unzip();
        series.push(Series::of(look, x, y).labelled(name.as_str()));
    }
    let ends = |of: &[f64]| of.first().copied().zip(of.last().copied());
    let panel = ChartPanel::new(
        "",
        ChartAxis::logarithmic(
            "pulse frequency *ω*/*p*",
            ends(&figure.frequencies),
        ),
        ChartAxis::logarithmic(
            "amplitude over the threshold *g* tan *α*",
            ends(&figure.amplitudes),
        ),
        series,
    );
    let grid = Grid { above: 10.0, ..Grid::new(1, 1).plot(600.0, 360.0) };
    let layout = Layout { grid: Some(grid), ..Layout::default() };
    Panels { panels: vec![panel], columns: 1, layout }
}
