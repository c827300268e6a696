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
}

impl Heading {
    /// The words of a figure.
    #[must_use]
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        description: impl Into<String>,
        arm: Option<Arm>,
    ) -> Self {
        let (name, title) = (name.into(), title.into());
        Self { name, title, description: description.into(), arm }
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
    #[must_use]
    pub fn svg(&self) -> String {
        self.scene.svg()
    }
}
