//! A map of fates in the plane of frequency and amplitude.

use rocking::names::named;

use super::chart::{Chart, ChartAxis, ChartPanel, Column, Layout, Of};
use super::figure::Figure;
use super::heading::Heading;
use super::series::Series;
use crate::colour::{Dash, Fill, Ink, Pen};
use crate::grid::Grid;
use crate::panel::Look;

const NUMBERS: [Column; 3] = [
    ("frequency_over_p", Of::X),
    ("amplitude_from", Of::Low),
    ("amplitude_to", Of::High),
];

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
            Self::Stands => Fill::tint(Ink::Paper, 0),
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
    /// The figure, with a sentence that says what one sees in it. Its CSV has
    /// the rows of one fate in a column together, at both ends of the column,
    /// then the boundaries.
    pub fn figure(&self, reading: String) -> Figure {
        let legend = |fate: MapFate| {
            let of = Series::of(Look::band(fate.fill()), vec![], vec![]);
            of.labelled(fate.name())
        };
        let mut series: Vec<_> =
            MapFate::ALL.into_iter().map(legend).collect();
        for (x, cells) in self.frequencies.windows(2).zip(&self.cells) {
            let rows = cells.iter().zip(self.amplitudes.windows(2));
            let rows: Vec<(&MapFate, &[f64])> = rows.collect();
            for same in rows.chunk_by(|a, b| a.0 == b.0) {
                let (fate, ends) = (same[0].0, same[same.len() - 1].1);
                let look = Look::band(fate.fill());
                let column = Series::of(look, x.to_vec(), vec![f64::NAN; 2]);
                let column = column.with(vec![(same[0].1[0], ends[1]); 2]);
                series.push(column.keyed([fate.name().into()]));
            }
        }
        let dashes = [Dash::Solid, Dash::Dashed].into_iter().cycle();
        for ((name, points), dash) in self.boundaries.iter().zip(dashes) {
            let look = Look::line(Pen::new(Ink::Text, 1.6).dash(dash));
            let (x, y): (Vec<f64>, Vec<f64>) = points.iter().copied().unzip();
            let ends = y.iter().map(|y| (*y, *y)).collect();
            let line = Series::of(look, x, y).with(ends);
            series.push(line.labelled(name).keyed([name.clone()]));
        }
        let ends = |of: &[f64]| of.first().copied().zip(of.last().copied());
        let (x, y) = (ends(&self.frequencies), ends(&self.amplitudes));
        let panel = ChartPanel::new(
            "",
            ChartAxis::logarithmic("pulse frequency *ω*/*p*", x),
            ChartAxis::logarithmic("amplitude / (*g* tan *α*)", y),
            series,
        );
        let grid = Grid { above: 10.0, ..Grid::new(1, 1).plot(600.0, 360.0) };
        let layout =
            Layout { grid: Some(grid), ..Layout::of(&["what"], &NUMBERS) };
        let (heading, panels) = (self.heading.clone(), vec![panel]);
        Chart { heading, panels, columns: 1 }.laid_out(&layout, reading)
    }
}
