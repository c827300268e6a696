//! Speed against error: single analyses with a reference, and throughput.
//! `fixtures/speed` keeps the timings.
//!
//! Times differ from run to run, so they are not results of the study and no
//! test compares them.

pub mod answers;
pub mod cases;
pub mod clock;
pub mod export;
pub mod many;
pub mod measured;
pub mod rest;
pub mod singles;
pub mod throughput;

use serde::Serialize;
use serde::de::DeserializeOwned;

/// Rows of a table as [`csv`] writes it.
///
/// # Errors
/// As the reader.
pub fn parse<T: DeserializeOwned>(text: &str) -> Result<Vec<T>, csv::Error> {
    csv::Reader::from_reader(text.as_bytes()).deserialize().collect()
}

/// Rows as CSV.
fn csv<T: Serialize>(
    rows: impl Iterator<Item = T>,
) -> Result<Vec<u8>, csv::Error> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    for row in rows {
        writer.serialize(row)?;
    }
    writer.into_inner().map_err(|e| e.into_error().into())
}

#[cfg(test)]
mod tests;
