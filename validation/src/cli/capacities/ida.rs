//! Opening the table of `rocking ida`.

use std::path::Path;

use rocking_exchange::ida::{Curves, IdaFileError, IdaTable};

use crate::cli::samples::Opened;
use rocking_common::paper::Intensity;

/// Reads a table, and its curves against an intensity measure.
///
/// # Errors
/// [`IdaFileError`] with file and line.
pub fn read(
    path: &Path,
    measure: Intensity,
) -> Result<(IdaTable, Curves), IdaFileError> {
    let place = || path.to_owned();
    let opened = Opened::open(path).map_err(|error| {
        let source = error.into();
        IdaFileError::Csv { path: place(), source }
    })?;
    let table = IdaTable::read(opened, path)?;
    let curves = table.curves(measure).map_err(|(record, source)| {
        IdaFileError::Curve { path: place(), record, source }
    })?;
    Ok((table, curves))
}
