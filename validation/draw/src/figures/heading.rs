//! A figure, and the words that go with it.

use crate::scene::Scene;
use rocking_common::findings::Theme;
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
    /// Its number, where it has one.
    pub number: Option<u32>,
    /// Where it belongs.
    pub place: Place,
}

/// Where a figure belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Place {
    /// To the answers.
    Answers,
    /// To a theme, which it opens.
    Opens(Theme),
    /// To a theme, folded.
    Folded(Theme),
    /// To the proof of the integrator.
    Proof,
    /// To the folded checks of the proof.
    Checks,
    /// To the speed of the program.
    Speed,
    /// To the comparison of suites.
    Suites,
    /// To that comparison block by block.
    SuitesByBlock,
    /// To the questions beyond the paper.
    Beyond,
}

/// The figures with numbers, those of the paper first: where each belongs,
/// and whether it is drawn once for each arm.
const NUMBERED: [(Place, bool); 21] = {
    use Place::{Answers, Checks, Folded, Opens, Proof};
    use Theme::{
        Choices, Fragilities, Lognormality, SingleRecords, Statistics,
    };
    [
        (Folded(Choices), false),
        (Opens(SingleRecords), false),
        (Folded(SingleRecords), false),
        (Opens(SingleRecords), false),
        (Folded(SingleRecords), false),
        (Opens(Statistics), true),
        (Opens(Statistics), true),
        (Answers, false),
        (Folded(Statistics), true),
        (Folded(Statistics), true),
        (Opens(Lognormality), false),
        (Opens(Lognormality), false),
        (Folded(Lognormality), true),
        (Folded(Lognormality), false),
        (Opens(Fragilities), false),
        (Answers, false),
        (Opens(Fragilities), false),
        (Folded(Fragilities), false),
        (Checks, false),
        (Proof, false),
        (Proof, false),
    ]
};

impl Heading {
    /// The words of a figure without a number.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        description: impl Into<String>,
    ) -> Self {
        let (name, title) = (name.into(), title.into());
        let (description, place) = (description.into(), Place::Beyond);
        Self { name, title, description, arm: None, number: None, place }
    }

    /// The same words of an arm.
    pub fn of(self, arm: Arm) -> Self {
        Self { arm: Some(arm), ..self }
    }

    /// The words of a figure with a number from 1 to 21, and its name:
    /// `figure-06`, or `figure-06-c` where it is drawn once for each arm.
    pub fn numbered(
        number: u32,
        title: impl Into<String>,
        description: impl Into<String>,
        arm: Option<Arm>,
    ) -> Self {
        let (place, by_arm) = NUMBERED[number as usize - 1];
        let of_arm = |arm: Arm| format!("-{}", arm.letter().to_lowercase());
        let suffix = arm.filter(|_| by_arm).map_or(String::new(), of_arm);
        let name = format!("figure-{number:02}{suffix}");
        let words = Self::new(name, title, description);
        Self { place, arm, number: Some(number), ..words }
    }

    /// The arm, where it is drawn once for each.
    pub fn own_arm(&self) -> Option<Arm> {
        let by_arm = |n: u32| NUMBERED[n as usize - 1].1;
        self.arm.filter(|_| self.number.is_some_and(by_arm))
    }

    /// What stands before its title: `Figure 6, arm C`.
    pub fn label(&self) -> String {
        match (self.number, self.own_arm(), self.place) {
            (Some(n), Some(arm), _) => {
                format!("Figure {n}, arm {}", arm.letter())
            }
            (Some(n), None, _) => format!("Figure {n}"),
            (None, _, Place::Speed) => "Speed".into(),
            (None, ..) => "Beyond the paper".into(),
        }
    }
}

/// A figure: its words, its shapes and its numbers.
#[derive(Debug)]
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
