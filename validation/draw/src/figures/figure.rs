//! A figure: its words, and the numbers that it draws.

use super::boxplots::{self, Boxplots};
use super::chart::{self, Chart, Layout, NUMBERS, Panels};
use super::heading::Heading;
use super::sketch::{self, BlockSketch};
use crate::drawing::Drawing;
use serde::{Deserialize, Serialize};

/// A figure: its words, its shapes and its numbers.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub struct Figure {
    /// The words that go with it.
    pub heading: Heading,
    /// The numbers that it draws.
    drawn: Graphic,
    /// What one sees, in one sentence made from the numbers.
    pub reading: String,
}

/// The numbers of a figure in the form in which they are drawn.
#[derive(Debug, Clone, Serialize, Deserialize)]
enum Graphic {
    Chart(Panels),
    Boxplots(Boxplots),
    /// Not kept.
    #[serde(skip)]
    Sketch(BlockSketch),
}

impl Figure {
    /// The drawing, before it is finished.
    pub(crate) fn scene(&self) -> Drawing {
        match &self.drawn {
            Graphic::Chart(panels) => chart::scene(&self.heading, panels),
            Graphic::Boxplots(boxes) => {
                chart::scene(&self.heading, &boxplots::panels(boxes))
            }
            Graphic::Sketch(block) => sketch::scene(block),
        }
    }

    /// The numbers, one header line, long format.
    pub fn csv(&self) -> String {
        match &self.drawn {
            Graphic::Chart(panels) => panels.csv(),
            Graphic::Boxplots(boxes) => boxes.csv(),
            Graphic::Sketch(block) => block.csv(),
        }
    }

    /// The drawing.
    pub fn svg(&self) -> String {
        self.scene().finish()
    }
}

impl Chart {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: impl Into<String>) -> Figure {
        self.laid_out(&Layout::of(&["series"], &NUMBERS), reading)
    }

    /// The figure in this layout.
    pub fn laid_out(
        &self,
        layout: &Layout,
        reading: impl Into<String>,
    ) -> Figure {
        let Self { heading, panels, columns } = self.clone();
        let layout = layout.clone();
        let drawn = Graphic::Chart(Panels { panels, columns, layout });
        Figure { heading, drawn, reading: reading.into() }
    }
}

impl Boxplots {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(self, heading: &Heading, reading: String) -> Figure {
        let drawn = Graphic::Boxplots(self);
        Figure { heading: heading.clone(), drawn, reading }
    }
}

impl BlockSketch {
    /// The figure, with a sentence that says what one sees in it.
    pub fn figure(&self, reading: String) -> Figure {
        let (heading, drawn) = (self.heading.clone(), self.clone());
        Figure { heading, drawn: Graphic::Sketch(drawn), reading }
    }
}
