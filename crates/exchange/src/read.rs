//! Reading tables of the registry.

mod closed;

use std::fmt::Display;
use std::io::Read;
use std::path::{Path, PathBuf};
use std::rc::Rc;
use std::str::FromStr;

use csv::StringRecord;
use rocking::accelerogram::result_name;
use rocking::stop;
use thiserror::Error;

use crate::columns::{Layout, SCHEMA, SCHEMA_COLUMN};
pub use closed::Closed;

/// Why a file was refused: the place, the found and the expected content.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "{}{}: {message}",
    path.display(), line.map_or(String::new(), |line| format!(":{line}"))
)]
#[non_exhaustive]
pub struct FileError {
    /// The file.
    pub path: PathBuf,
    /// Line number from 1, if one line is at fault.
    pub line: Option<u64>,
    /// The found and the expected content, in words.
    pub message: String,
}

/// A result of reading a file.
pub(crate) type Result<T, E = FileError> = std::result::Result<T, E>;

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

/// The cells of one line of a table of the registry, by their columns.
#[derive(Clone)]
pub struct Cells<'a> {
    path: &'a Path,
    layout: &'a Layout,
    /// Places of the columns of the layout among the fields.
    places: Rc<[Option<usize>]>,
    /// Line number from 1.
    pub line: u64,
    fields: StringRecord,
}

impl Cells<'_> {
    /// A refusal of the line.
    pub fn error(&self, message: impl Display) -> FileError {
        FileError::new(self.path, self.line, message)
    }

    /// The text of a cell, empty if the table lacks the column.
    ///
    /// # Panics
    /// As [`Layout::place`].
    pub fn text(&self, column: &str) -> &str {
        let place = self.places[self.layout.place(column)];
        place.map_or("", |place| &self.fields[place])
    }

    /// A refusal of one cell.
    pub fn refuse(&self, column: &str, expected: impl Display) -> FileError {
        let found = self.text(column);
        self.error(format_args!(
            "found `{found}` in column {column}: expected {expected}"
        ))
    }

    /// A cell that is empty or a valid name for results.
    ///
    /// # Errors
    /// [`FileError`] for a control character, and for a formula.
    pub fn name(&self, column: &str) -> Result<&str, FileError> {
        result_name(self.text(column)).map_err(|_| {
            let expected = "a name without a control character, and without \
                            =, +, - or @ at its start";
            self.refuse(column, expected)
        })
    }

    /// The value of a cell.
    ///
    /// # Errors
    /// [`FileError`] for a cell that is not a value of the type, or for which
    /// `fits` is false.
    pub fn parsed<T: FromStr>(
        &self,
        column: &str,
        fits: impl Fn(&T) -> bool,
        expected: &str,
    ) -> Result<T, FileError> {
        let value = self.text(column).parse().ok().filter(fits);
        value.ok_or_else(|| self.refuse(column, expected))
    }
}

/// A reader of CSV, which fails if the file ends within a quoted cell; lines
/// that begin with `comment` are ignored.
pub fn reader<R: Read>(
    from: R,
    trim: csv::Trim,
    comment: Option<u8>,
) -> csv::Reader<Closed<R>> {
    let mut builder = csv::ReaderBuilder::new();
    builder.trim(trim).comment(comment);
    builder.from_reader(Closed::new(from, comment, b','))
}

/// A refusal of text that is not CSV; `path` is its name in messages.
pub fn no_csv(path: &Path, error: csv::Error) -> FileError {
    match error.into_kind() {
        csv::ErrorKind::Io(error) => FileError::new(path, None, error),
        csv::ErrorKind::UnequalLengths { pos, expected_len, len } => {
            let line = pos.map(|pos| pos.line());
            let message =
                format!("found {len} cells: expected {expected_len}");
            FileError::new(path, line, message)
        }
        csv::ErrorKind::Utf8 { pos, err } => {
            FileError::new(path, pos.map(|pos| pos.line()), err)
        }
        kind => FileError::new(path, None, format_args!("{kind:?}")),
    }
}

/// The lines of a table; `path` is its name in messages. Columns are found by
/// name, in any order. A table without the column of the schema is read; a
/// table with another schema is refused.
///
/// # Errors
/// [`FileError`] for text that is not CSV, and for other columns.
pub fn rows<'a, R: Read>(
    layout: &'a Layout,
    reader: &'a mut csv::Reader<R>,
    path: &'a Path,
) -> Result<impl Iterator<Item = Result<Cells<'a>, FileError>>, FileError> {
    let header = reader.headers().map_err(|e| no_csv(path, e))?;
    let places = layout.places(header);
    let places = places.map_err(|message| FileError::new(path, 1, message))?;
    let places: Rc<[_]> = places.into();
    Ok(reader.records().map(move |fields| {
        stop::point();
        let fields = fields.map_err(|e| no_csv(path, e))?;
        let line = fields.position().map_or(0, csv::Position::line);
        let schema = places[layout.columns.len()].map(|p| &fields[p]);
        let is_ours = schema.is_none_or(|cell| cell == SCHEMA.to_string());
        let places = Rc::clone(&places);
        let cells = Cells { path, layout, places, line, fields };
        if is_ours {
            return Ok(cells);
        }
        let expected = format_args!("{SCHEMA}, the schema of this program");
        Err(cells.refuse(SCHEMA_COLUMN, expected))
    }))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::columns::OUTCOMES;

    fn read(text: &str) -> Result<Vec<Vec<String>>, String> {
        let path = Path::new("t.csv");
        let mut reader = reader(text.as_bytes(), csv::Trim::All, Some(b'#'));
        let rows = rows(&OUTCOMES, &mut reader, path);
        let rows = rows.map_err(|error| error.to_string())?;
        let cells = |cells: Result<Cells<'_>, FileError>| {
            let cells = cells.map_err(|error| error.to_string())?;
            let names = OUTCOMES.columns.iter().map(|column| column.name);
            Ok(names.map(|name| cells.text(name).to_owned()).collect())
        };
        rows.map(cells).collect()
    }

    #[test]
    fn columns_are_found_by_name_and_some_may_be_missing() {
        let expected = Ok(vec![vec![
            "1.5".to_owned(),
            "a".to_owned(),
            String::new(),
            "1".to_owned(),
        ]]);
        for text in [
            "intensity,record,event,exceeded,schema\n1.5,a,,1,1\n",
            "intensity,record,event,exceeded\n1.5,a,,1\n",
            "intensity,record,exceeded\n1.5,a,1\n",
            "# a comment\nrecord, exceeded ,intensity\n\"a\",1,1.5\n",
            "schema,exceeded,record,intensity\n1,1,a,1.5\n",
        ] {
            assert_eq!(read(text), expected, "{text}");
        }
    }

    #[test]
    fn other_tables_are_refused_with_what_is_needed() {
        let columns = "expected `intensity,record,exceeded`, and, if known, \
                       `event`";
        for (text, words) in [
            ("intensity,record\n1,a\n", columns),
            ("intensity,record,exceeded,n\n1,a,1,2\n", columns),
            ("intensity,record,record,exceeded\n1,a,a,1\n", columns),
            (
                "intensity,record,exceeded\n1,a\n",
                "t.csv:2: found 2 cells: expected 3",
            ),
            (
                "intensity,record,exceeded,schema\n1,a,1,7\n",
                "t.csv:2: found `7` in column schema",
            ),
            (
                "intensity,record,exceeded\n1,\"a,1\n2,b,0\n",
                "t.csv: a cell that begins with a quote on line 2 has no \
                 closing quote",
            ),
        ] {
            let error = read(text).unwrap_err();
            assert!(error.contains(words), "{error}");
        }
    }
}
