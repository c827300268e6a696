//! Rows of text cells as a Parquet file with typed columns.
//!
//! The crate is apart from the harness because `parquet` takes longer to
//! compile than all that the harness uses; `rocking-cli` uses it with
//! the feature `parquet` alone.
//!
//! A file holds groups of a fixed number of rows, so that memory does not
//! grow with the file. The same rows give the same bytes: neither clock nor
//! machine is in them. Numbers that hardly repeat are stored byte by byte
//! (`BYTE_STREAM_SPLIT`), all others by a dictionary; Snappy compresses both.
//! Format: <https://parquet.apache.org/docs/file-format/>.

mod column;

use std::io::{self, Write};
use std::sync::Arc;

use parquet::basic::{Compression, Encoding};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::{EnabledStatistics, WriterProperties};
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};
use thiserror::Error;

use column::Buffer;

/// What the cells of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Numbers that many rows share (`DOUBLE`, never missing).
    Level,
    /// Numbers that hardly repeat (`DOUBLE`, null where the cell is empty).
    Value,
    /// Whole numbers (`INT64`).
    Count,
    /// `true` or `false` (`BOOLEAN`).
    Flag,
    /// Text (`BYTE_ARRAY`, UTF-8).
    Text,
}

/// Why a file could not be written.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum Error {
    /// A cell that is not of its column's kind.
    #[error("row {row}, column {column}: {found:?}; expected {expected}")]
    Cell {
        /// The row, from 1.
        row: u64,
        /// The column's name.
        column: String,
        /// The cell.
        found: String,
        /// What should stand there.
        expected: &'static str,
    },
    /// A row with more or fewer cells than there are columns.
    #[error("row {row}: {found} cells; expected {expected}")]
    Cells {
        /// The row, from 1.
        row: u64,
        /// Its cells.
        found: usize,
        /// The columns.
        expected: usize,
    },
    /// What the system said.
    #[error(transparent)]
    Io(#[from] io::Error),
    /// What the format does not allow.
    #[error("Parquet: {0}")]
    Format(ParquetError),
}

impl From<ParquetError> for Error {
    fn from(error: ParquetError) -> Self {
        let ParquetError::External(inner) = error else {
            return Self::Format(error);
        };
        match inner.downcast::<io::Error>() {
            Ok(error) => Self::Io(*error),
            Err(inner) => Self::Format(ParquetError::External(inner)),
        }
    }
}

impl From<Error> for io::Error {
    fn from(error: Error) -> Self {
        match error {
            Error::Io(error) => error,
            other => Self::other(other),
        }
    }
}

/// Rows of a file.
///
/// ```
/// use rocking_parquet::{Kind, Table, Writer};
/// let columns = [("record", Kind::Text), ("edp", Kind::Value)];
/// let table = Table { columns: &columns, notes: &[], group_rows: 1 << 20 };
/// let mut file = Vec::new();
/// let mut writer = Writer::begin(&mut file, &table, "rocking version 0.1.0")?;
/// writer.row(["a", "0.25"])?;
/// writer.row(["b", "inf"])?;
/// writer.finish()?;
/// assert_eq!((&file[..4], &file[file.len() - 4..]), (&b"PAR1"[..], &b"PAR1"[..]));
/// # Ok::<(), rocking_parquet::Error>(())
/// ```
pub struct Writer<W: Write + Send> {
    file: SerializedFileWriter<W>,
    buffers: Vec<Buffer>,
    group_rows: usize,
    /// Rows taken, and those of them that wait in the buffers.
    rows: u64,
    waiting: usize,
}

/// What a file holds beside its rows.
#[derive(Clone, Copy, Debug)]
pub struct Table<'a> {
    /// Name and kind of each column.
    pub columns: &'a [(&'a str, Kind)],
    /// Keys and values of the file's metadata.
    pub notes: &'a [(&'a str, &'a str)],
    /// Rows of a group, at least 1; memory grows with it.
    pub group_rows: usize,
}

impl<W: Write + Send> Writer<W> {
    /// Begins a file in `sink`; `by` is the program that writes it, as
    /// `NAME version VERSION`.
    ///
    /// # Errors
    /// [`Error::Io`] where nothing can be written.
    pub fn begin(sink: W, table: &Table<'_>, by: &str) -> Result<Self, Error> {
        let buffers: Vec<Buffer> =
            table.columns.iter().map(|c| Buffer::of(c.0, c.1)).collect();
        let fields = buffers
            .iter()
            .map(|buffer| buffer.field().map(Arc::new))
            .collect::<Result<Vec<_>, _>>()?;
        let schema =
            Type::group_type_builder("table").with_fields(fields).build()?;
        let notes = table.notes.iter().map(|(key, value)| {
            KeyValue::new((*key).to_owned(), (*value).to_owned())
        });
        let mut properties = WriterProperties::builder()
            .set_created_by(by.to_owned())
            .set_compression(Compression::SNAPPY)
            .set_statistics_enabled(EnabledStatistics::Chunk)
            .set_offset_index_disabled(true)
            .set_key_value_metadata(Some(notes.collect()));
        for (name, kind) in table.columns {
            if *kind == Kind::Value {
                let path = ColumnPath::from(*name);
                properties = properties
                    .set_column_dictionary_enabled(path.clone(), false)
                    .set_column_encoding(path, Encoding::BYTE_STREAM_SPLIT);
            }
        }
        let properties = Arc::new(properties.build());
        let file =
            SerializedFileWriter::new(sink, Arc::new(schema), properties)?;
        let group_rows = table.group_rows.max(1);
        Ok(Self { file, buffers, group_rows, rows: 0, waiting: 0 })
    }

    /// Takes a row; its cells are as in CSV, `inf` and empty ones too.
    ///
    /// # Errors
    /// [`Error::Cell`] and [`Error::Cells`] for a row of another form,
    /// [`Error::Io`] where a group cannot be written. The file is then given
    /// up.
    pub fn row<'c>(
        &mut self,
        cells: impl IntoIterator<Item = &'c str>,
    ) -> Result<(), Error> {
        self.rows += 1;
        let row = self.rows;
        let mut found = 0;
        for cell in cells {
            if let Some(buffer) = self.buffers.get_mut(found) {
                buffer.take(cell).map_err(|expected| Error::Cell {
                    row,
                    column: buffer.name().to_owned(),
                    found: cell.to_owned(),
                    expected,
                })?;
            }
            found += 1;
        }
        let expected = self.buffers.len();
        if found != expected {
            return Err(Error::Cells { row, found, expected });
        }
        self.waiting += 1;
        if self.waiting == self.group_rows { self.flush() } else { Ok(()) }
    }

    /// Writes the rows that wait as a group.
    fn flush(&mut self) -> Result<(), Error> {
        let mut group = self.file.next_row_group()?;
        for buffer in &mut self.buffers {
            let column = group.next_column()?;
            let missing = || ParquetError::General("no such column".into());
            buffer.write(column.ok_or_else(missing)?)?;
        }
        group.close()?;
        self.waiting = 0;
        Ok(())
    }

    /// Writes what waits, and the end of the file.
    ///
    /// # Errors
    /// [`Error::Io`] where it cannot be written.
    pub fn finish(mut self) -> Result<(), Error> {
        if self.waiting > 0 {
            self.flush()?;
        }
        self.file.finish()?;
        Ok(())
    }
}

#[cfg(test)]
mod tests;
