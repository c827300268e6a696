//! A figure, and the words that go with it.

use crate::scene::Scene;
use rocking_common::paper::Arm;

/// The words that go with a figure.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// File stem, unique in a report: `figure-06-c`.
    pub name: String,
    /// Short plain-text title, as a list of figures would have it; also the
    /// SVG's `<title>`.
    pub title: String,
    /// What can be seen, in a sentence or two of plain text, for those who
    /// cannot see it: the SVG's `<desc>`.
    pub description: String,
    /// Arm of the grid that the numbers come from, where there is one.
    pub arm: Option<Arm>,
    /// Where it belongs.
    pub place: Place,
}

/// Where a figure belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// By its number: one of the paper's, or behind them one of the proof's.
    Numbered {
        /// The number.
        number: u32,
        /// Whether it is drawn once for each arm.
        by_arm: bool,
    },
    /// The comparison of suites.
    Suites,
    /// That comparison block by block.
    SuitesByBlock,
    /// Beside these.
    Beside,
}

impl Heading {
    /// The words of a figure.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        description: impl Into<String>,
    ) -> Self {
        let (name, title) = (name.into(), title.into());
        let (description, place) = (description.into(), Place::Beside);
        Self { name, title, description, arm: None, place }
    }

    /// The same words of an arm.
    pub fn of(self, arm: Arm) -> Self {
        Self { arm: Some(arm), ..self }
    }

    /// The words of a figure with a number, and its name: `figure-06`, or
    /// `figure-06-c` where it is drawn once for each arm.
    pub fn numbered(
        number: u32,
        by_arm: bool,
        title: impl Into<String>,
        description: impl Into<String>,
        arm: Option<Arm>,
    ) -> Self {
        let of_arm = |arm: Arm| format!("-{}", arm.letter().to_lowercase());
        let suffix = arm.filter(|_| by_arm).map_or(String::new(), of_arm);
        let name = format!("figure-{number:02}{suffix}");
        let place = Place::Numbered { number, by_arm };
        Self { place, arm, ..Self::new(name, title, description) }
    }

    /// Its number, where it has one.
    pub fn number(&self) -> Option<u32> {
        match self.place {
            Place::Numbered { number, .. } => Some(number),
            _ => None,
        }
    }

    /// The arm, where it is drawn once for each.
    pub fn own_arm(&self) -> Option<Arm> {
        let by_arm =
            matches!(self.place, Place::Numbered { by_arm: true, .. });
        self.arm.filter(|_| by_arm)
    }
}

/// A figure: its words, its shapes and its numbers.
pub struct Figure {
    /// The words that go with it.
    pub heading: Heading,
    /// The shapes, before they are written.
    pub scene: Scene,
    /// The numbers, one header line, long format.
    pub csv: String,
    /// What one sees, in one sentence made from the numbers.
    pub reading: String,
}

impl Figure {
    pub(super) fn new(
        heading: &Heading,
        scene: Scene,
        csv: String,
        reading: String,
    ) -> Self {
        Self { heading: heading.clone(), scene, csv, reading }
    }

    /// The drawing.
    pub fn svg(&self) -> String {
        self.scene.svg()
    }
}
