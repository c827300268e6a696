//! The two suites by name.

use std::fmt;

use serde::{Deserialize, Serialize};

/// One of the two suites, by its kind of motion.
///
/// ```
/// use rocking_synthesis::SuiteKind;
/// let names = SuiteKind::BOTH.map(SuiteKind::name);
/// assert_eq!(names, ["ordinary", "pulse-type"]);
/// ```
#[derive(
    Clone,
    Copy,
    Debug,
    PartialEq,
    Eq,
    PartialOrd,
    Ord,
    Hash,
    Serialize,
    Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum SuiteKind {
    /// Far-field records without pulses.
    Ordinary,
    /// Near-fault records with a pulse in the velocity.
    PulseType,
}

impl SuiteKind {
    /// Both of them.
    pub const BOTH: [Self; 2] = [Self::Ordinary, Self::PulseType];

    /// The name as it stands in files and reports.
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::Ordinary => "ordinary",
            Self::PulseType => "pulse-type",
        }
    }
}

impl fmt::Display for SuiteKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(self.name())
    }
}
