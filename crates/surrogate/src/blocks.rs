//! Blocks with the fragilities that their analyses gave.

use std::fs;
use std::path::Path;

use rocking_records::intensity::Intensity;
use rocking_statistics::Lognormal;
use serde::{Deserialize, Serialize};

use super::{RESTITUTION, SHIFT, SurrogateError};
use rocking_exchange::columns::SCHEMA;
use rocking_exchange::table::{Table, digits};
use rocking_synthesis::SuiteKind;

/// Significant digits of a table.
const DIGITS: usize = 6;

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

/// A row of `rocking sweep merge`; other columns are not read.
#[derive(Deserialize)]
struct Merged {
    alpha_rad: f64,
    p_rad_s: f64,
    eta: f64,
    im: Intensity,
    demand: f64,
    shift: f64,
    median: f64,
    dispersion: f64,
    median_low: f64,
    median_high: f64,
    dispersion_low: f64,
    dispersion_high: f64,
    schema: u32,
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

/// Overturning in PGA of the blocks of a file of `rocking sweep merge`.
///
/// # Errors
/// [`SurrogateError::Table`] with the line for a file of another form, a
/// restitution other than 0.92, and a block that some record never overturns.
pub fn read_merged(
    suite: SuiteKind,
    path: &Path,
) -> Result<Vec<Fitted>, SurrogateError> {
    let expected =
        "overturning of every record with eta 0.92, merged by `rocking sweep`";
    let name = path.display().to_string();
    let flaw = |place: String, found: String| SurrogateError::Table {
        place,
        found,
        expected,
    };
    let text = fs::read_to_string(path)
        .map_err(|e| flaw(name.clone(), e.to_string()))?;
    let mut out = Vec::new();
    for (line, row) in rows::<Merged>(&name, &text, expected)? {
        if row.im != Intensity::Pga || row.demand != 1.0 {
            continue;
        }
        let at = format!("{name}:{line}");
        if row.schema != SCHEMA {
            let found = format!("schema {}", row.schema);
            return Err(flaw(at, found));
        }
        if row.eta != RESTITUTION || row.shift != SHIFT {
            let found = format!("eta {}, shift {}", row.eta, row.shift);
            return Err(flaw(at, found));
        }
        if !(row.median > SHIFT && row.dispersion > 0.0) {
            let found = format!(
                "median {}, dispersion {}",
                row.median, row.dispersion
            );
            return Err(flaw(at, found));
        }
        out.push(Fitted {
            suite,
            alpha_rad: row.alpha_rad,
            p_rad_s: row.p_rad_s,
            median: row.median,
            median_low: row.median_low,
            median_high: row.median_high,
            dispersion: row.dispersion,
            dispersion_low: row.dispersion_low,
            dispersion_high: row.dispersion_high,
        });
    }
    if out.is_empty() {
        return Err(flaw(name, "no row of overturning in PGA".into()));
    }
    Ok(out)
}

/// Blocks of a table of [`table`].
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

/// Blocks as CSV, with six digits.
#[must_use]
pub fn table(blocks: &[Fitted]) -> String {
    let mut table = Table::headed(
        "suite,alpha_rad,p_rad_s,median,median_low,median_high,dispersion,\
         dispersion_low,dispersion_high",
    );
    for b in blocks {
        let numbers = [
            b.alpha_rad,
            b.p_rad_s,
            b.median,
            b.median_low,
            b.median_high,
            b.dispersion,
            b.dispersion_low,
            b.dispersion_high,
        ];
        let cells = numbers.map(|x| digits(x, DIGITS));
        table.row([b.suite.name().to_owned()].into_iter().chain(cells));
    }
    table.finish()
}
