//! Statistics against values from outside: certified data sets, exact and
//! published critical values, other packages, and simulated truths.

mod calibration;
mod choice;
mod equations;
mod fits;
mod inference;
mod inversion;
mod lilliefors;
mod nist;
mod proportion;
mod risk;
mod truths;
mod two_samples;

pub(super) use calibration::{bias, coverage, rejection};
pub(super) use choice::choice;
pub(super) use equations::transforms;
pub(super) use fits::{fits, paired, quantiles, tests};
pub(super) use inference::coverage as inference;
pub(super) use inversion::inversion;
pub(super) use lilliefors::{
    asymptotics, draws, largest, null, published, table,
};
pub(super) use nist::moments;
pub(super) use proportion::intervals as proportions;
pub(super) use risk::{annual_frequency, cornell, interval};
pub(super) use two_samples::two_samples;

use super::MethodError;

/// A refusal of the core where an answer was due.
fn refused(error: impl std::fmt::Display) -> MethodError {
    MethodError::Oracle(error.to_string())
}

/// Rows of a CSV by their first field, the rest as words.
fn rows<'a>(
    csv: &'a str,
    file: &'static str,
    first: &str,
) -> Result<Vec<Vec<&'a str>>, MethodError> {
    let rows: Vec<Vec<&str>> = csv
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .filter(|fields| fields.first() == Some(&first))
        .collect();
    if rows.is_empty() {
        return Err(MethodError::Reference {
            file,
            what: format!("no row `{first}`"),
        });
    }
    Ok(rows)
}

/// A number of a CSV.
fn number(file: &'static str, text: &str) -> Result<f64, MethodError> {
    text.trim().parse().map_err(|_| MethodError::Reference {
        file,
        what: format!("`{text}` is no number"),
    })
}
