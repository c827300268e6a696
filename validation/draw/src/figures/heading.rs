//! The words that go with a figure.

use rocking::names::named;
use rocking_common::findings::Theme;
use rocking_common::paper::Arm;
use serde::{Deserialize, Serialize};

/// The words that go with a figure.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
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
    /// Whose motions it shows, where a page has it of both.
    pub motions: Option<Motions>,
    /// Where it belongs, which is not kept: the number says it.
    #[serde(skip)]
    pub place: Place,
}

named! {
    /// Motions that a figure of the paper is drawn of.
    pub enum Motions: "motions" {
        /// Recorded in earthquakes.
        Recorded = "recorded",
        /// Synthetic, made by this program.
        Embedded = "embedded",
    }
}

/// Where a figure belongs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
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
    /// To the tests on a shaking table.
    ShakingTable,
    /// To the speed of the program.
    Speed,
    /// To the scores of other codes.
    Others,
    /// To the comparison of suites.
    SuitesByBlock,
    /// To the questions beyond the paper.
    #[default]
    Beyond,
}

/// Where a figure with a number belongs, those of the paper first.
fn place_of(number: u32) -> Place {
    use Place::{Answers, Checks, Folded, Opens, Proof};
    use Theme::{
        Choices, Fragilities, Lognormality, SingleRecords, Statistics,
    };
    match number {
        1 => Folded(Choices),
        4 => Opens(SingleRecords),
        2 | 3 | 5 => Folded(SingleRecords),
        6 => Opens(Statistics),
        7 | 9 | 10 => Folded(Statistics),
        8 => Answers,
        12 => Opens(Lognormality),
        11 | 13 | 14 => Folded(Lognormality),
        16 => Opens(Fragilities),
        15 | 17 | 18 => Folded(Fragilities),
        20 => Proof,
        _ => Checks,
    }
}

/// Whether a figure with a number is drawn once for each arm.
fn is_by_arm(number: u32) -> bool {
    matches!(number, 6..=10 | 13)
}

impl Heading {
    /// The words of a figure without a number.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        description: impl Into<String>,
    ) -> Self {
        let (name, title) = (name.into(), title.into());
        let description = description.into();
        Self { name, title, description, ..Self::default() }
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
        let words = Self::new("", title, description);
        let place = place_of(number);
        let words = Self { place, arm, number: Some(number), ..words };
        let suffix = |arm: Arm| format!("-{}", arm.name().to_lowercase());
        let suffix = words.own_arm().map_or(String::new(), suffix);
        let name = format!("figure-{number:02}{suffix}");
        Self { name, ..words }
    }

    /// The same figure of these motions, where a page has it of both; of the
    /// recorded ones its name ends in `-recorded`.
    pub fn of_motions(self, motions: Motions) -> Self {
        let words = match self.number {
            Some(number) => {
                Self::numbered(number, self.title, self.description, self.arm)
            }
            None => self,
        };
        let suffix = match motions {
            Motions::Recorded => "-recorded",
            Motions::Embedded => "",
        };
        let name = words.name + suffix;
        Self { name, motions: Some(motions), ..words }
    }

    /// Whether both are the same figure, be it of other motions.
    pub fn is_beside(&self, other: &Self) -> bool {
        let key = |one: &Self| (one.number, one.own_arm());
        self.number.is_some() && key(self) == key(other)
    }

    /// The arm, where it is drawn once for each.
    pub fn own_arm(&self) -> Option<Arm> {
        self.arm.filter(|_| self.number.is_some_and(is_by_arm))
    }

    /// What stands before its title: `Figure 6, arm C, recorded motions`.
    pub fn label(&self) -> String {
        let Some(number) = self.number else {
            return match self.place {
                Place::ShakingTable => "Shaking table".into(),
                Place::Speed => "Speed".into(),
                Place::Others => "Other codes".into(),
                _ => "Beyond the paper".into(),
            };
        };
        let mut label = format!("Figure {number}");
        if let Some(arm) = self.own_arm() {
            label += &format!(", grid {}", arm.name());
        }
        if let Some(motions) = self.motions {
            label += &format!(", {} motions", motions.name());
        }
        label
    }
}
