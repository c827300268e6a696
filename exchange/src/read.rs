//! Reading tables of the registry, and why a file is refused.

use std::fmt::Display;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use csv::StringRecord;
use rocking::stop;
use thiserror::Error;

use crate::columns::{Layout, SCHEMA, SCHEMA_COLUMN};

/// Why a file was refused: the place, what was found there, and what was
/// expected.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "{}{}: {message}",
    path.display(), line.map_or(String::new(), |line| format!(":{line}"))
)]
#[non_exhaustive]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// Line number from 1, where one line is at fault.
    pub line: Option<u64>,
    /// What was found and what was expected.
    pub message: String,
}

impl FileError {
    /// A refusal of a file, or of one of its lines.
    pub fn new(
        path: &Path,
        line: impl Into<Option<u64>>,
        message: impl Display,
    ) -> Self {
        let (path, message) = (path.to_owned(), message.to_string());
        Self { path, line: line.into(), message }
    }
}

/// The cells of one line of a table of the registry.
pub struct Cells<'a> {
    path: &'a Path,
    layout: &'a Layout,
    /// Line number from 1.
    pub line: u64,
    /// The cells.
    pub fields: StringRecord,
}

impl Cells<'_> {
    /// A refusal of the line.
    #[must_use]
    pub fn error(&self, message: impl Display) -> FileError {
        FileError::new(self.path, self.line, message)
    }

    /// A refusal of one cell.
    #[must_use]
    pub fn refuse(&self, column: usize, expected: impl Display) -> FileError {
        let found = self.fields.get(column).unwrap_or_default();
        let own = self.layout.columns.get(column);
        let name = own.map_or(SCHEMA_COLUMN, |column| column.name);
        self.error(format_args!(
            "found `{found}` in column {name}: expected {expected}"
        ))
    }

    /// The value of a cell.
    ///
    /// # Errors
    /// [`FileError`] for a cell that is no such value, or that does not fit.
    pub fn parsed<T: FromStr>(
        &self,
        column: usize,
        fits: impl Fn(&T) -> bool,
        expected: &str,
    ) -> Result<T, FileError> {
        let value = self.fields[column].parse().ok().filter(fits);
        value.ok_or_else(|| self.refuse(column, expected))
    }
}

/// The lines of a table; `path` is its name in messages. A table without the
/// column of the schema is read, one of another schema is refused.
///
/// # Errors
/// [`FileError`] for text that is no CSV, and for other columns.
pub fn rows<'a, R: Read>(
    layout: &'a Layout,
    reader: &'a mut csv::Reader<R>,
    path: &'a Path,
) -> Result<impl Iterator<Item = Result<Cells<'a>, FileError>>, FileError> {
    let no_csv = move |error: csv::Error| FileError::new(path, None, error);
    let header = reader.headers().map_err(no_csv)?;
    if !layout.has(header) {
        let found: Vec<&str> = header.iter().collect();
        let expected: Vec<&str> = layout.names().collect();
        let (found, expected) = (found.join(","), expected.join(","));
        let message =
            format!("found columns `{found}`: expected `{expected}`");
        return Err(FileError::new(path, 1, message));
    }
    Ok(reader.records().map(move |fields| {
        stop::point();
        let fields = fields.map_err(no_csv)?;
        let line = fields.position().map_or(0, csv::Position::line);
        let cells = Cells { path, layout, line, fields };
        let schema = layout.columns.len();
        if layout.is_current(cells.fields.get(schema)) {
            return Ok(cells);
        }
        let expected = format_args!("{SCHEMA}, the schema of this program");
        Err(cells.refuse(schema, expected))
    }))
}
