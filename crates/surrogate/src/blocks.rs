//! Blocks with the fragilities that their analyses gave.

use rocking_statistics::Lognormal;
use serde::{Deserialize, Serialize};

use super::{SHIFT, SurrogateError};
use rocking_synthesis::SuiteKind;

/// A block's overturning fragility in PGA/(g tan alpha), fitted to its own
/// capacities, with 95 % intervals from resampled records.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Fitted {
    /// The suite.
    pub suite: SuiteKind,
    /// Slenderness angle.
    pub alpha_rad: f64,
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Median.
    pub median: f64,
    /// Low end of its interval.
    pub median_low: f64,
    /// High end of its interval.
    pub median_high: f64,
    /// Dispersion above the uplift.
    pub dispersion: f64,
    /// Low end of its interval.
    pub dispersion_low: f64,
    /// High end of its interval.
    pub dispersion_high: f64,
}

impl Fitted {
    /// As a distribution.
    ///
    /// # Errors
    /// [`SurrogateError::Lognormal`] for a median at or below the uplift.
    pub fn lognormal(&self) -> Result<Lognormal, SurrogateError> {
        let mu = libm::log(self.median - SHIFT);
        Ok(Lognormal::try_new(SHIFT, mu, self.dispersion)?)
    }
}

pub(super) fn rows<R: for<'d> Deserialize<'d>>(
    place: &str,
    text: &str,
    expected: &'static str,
) -> Result<Vec<(u64, R)>, SurrogateError> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let mut out = Vec::new();
    for (row, line) in reader.deserialize().zip(2_u64..) {
        let row = row.map_err(|e| SurrogateError::Table {
            place: format!("{place}:{line}"),
            found: e.to_string(),
            expected,
        })?;
        out.push((line, row));
    }
    Ok(out)
}

/// Blocks of a table of `fixtures/surrogate`.
///
/// # Errors
/// [`SurrogateError::Table`] with the line for another form.
pub fn read_table(
    place: &str,
    text: &str,
) -> Result<Vec<Fitted>, SurrogateError> {
    let expected = "a table of fixtures/surrogate";
    let found = rows(place, text, expected)?;
    Ok(found.into_iter().map(|(_, row)| row).collect())
}
