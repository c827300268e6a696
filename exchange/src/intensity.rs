//! The intensity measures of a fragility.

use serde::{Deserialize, Serialize};

/// Dimensionless intensity measure.
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
#[serde(rename_all = "lowercase")]
pub enum Intensity {
    /// PGA/(g tan alpha).
    Pga,
    /// p PGV/(g tan alpha).
    Pgv,
}

impl Intensity {
    /// All of them.
    pub const ALL: [Self; 2] = [Self::Pga, Self::Pgv];

    /// The name as it stands in files and reports.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Pga => "pga",
            Self::Pgv => "pgv",
        }
    }

    /// The measure as the paper writes it.
    #[must_use]
    pub fn words(self) -> &'static str {
        match self {
            Self::Pga => "PGA/(g tan alpha)",
            Self::Pgv => "p PGV/(g tan alpha)",
        }
    }
}
