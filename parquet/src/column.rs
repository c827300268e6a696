//! Cells of one column, until their group is written.

use parquet::basic::{LogicalType, Repetition, Type as Physical};
use parquet::data_type::{
    BoolType, ByteArray, ByteArrayType, DoubleType, Int64Type,
};
use parquet::errors::ParquetError;
use parquet::file::writer::SerializedColumnWriter;
use parquet::schema::types::Type;

use crate::Kind;

/// A column's name and its cells of a group.
pub struct Buffer {
    name: String,
    cells: Cells,
}

enum Cells {
    Level(Vec<f64>),
    /// The numbers that are there, and for each row whether one is (1 or 0).
    Value(Vec<f64>, Vec<i16>),
    Count(Vec<i64>),
    Flag(Vec<bool>),
    Text(Vec<ByteArray>),
}

impl Buffer {
    pub fn of(name: &str, kind: Kind) -> Self {
        let cells = match kind {
            Kind::Level => Cells::Level(Vec::new()),
            Kind::Value => Cells::Value(Vec::new(), Vec::new()),
            Kind::Count => Cells::Count(Vec::new()),
            Kind::Flag => Cells::Flag(Vec::new()),
            Kind::Text => Cells::Text(Vec::new()),
        };
        Self { name: name.to_owned(), cells }
    }

    pub fn name(&self) -> &str {
        &self.name
    }

    /// The column in the file's schema.
    pub fn field(&self) -> Result<Type, ParquetError> {
        let (physical, logical, repetition) = match self.cells {
            Cells::Level(_) => (Physical::DOUBLE, None, Repetition::REQUIRED),
            Cells::Value(..) => (Physical::DOUBLE, None, Repetition::OPTIONAL),
            Cells::Count(_) => (Physical::INT64, None, Repetition::REQUIRED),
            Cells::Flag(_) => (Physical::BOOLEAN, None, Repetition::REQUIRED),
            Cells::Text(_) => {
                let text = Some(LogicalType::String);
                (Physical::BYTE_ARRAY, text, Repetition::REQUIRED)
            }
        };
        Type::primitive_type_builder(&self.name, physical)
            .with_repetition(repetition)
            .with_logical_type(logical)
            .build()
    }

    /// Takes a cell; else what should stand there.
    pub fn take(&mut self, cell: &str) -> Result<(), &'static str> {
        match &mut self.cells {
            Cells::Level(all) => all.push(number(cell)?),
            Cells::Value(all, there) => {
                if !cell.is_empty() {
                    all.push(number(cell)?);
                }
                there.push(i16::from(!cell.is_empty()));
            }
            Cells::Count(all) => {
                all.push(cell.parse().map_err(|_| "a whole number")?);
            }
            Cells::Flag(all) => {
                all.push(cell.parse().map_err(|_| "true or false")?);
            }
            Cells::Text(all) => {
                // Rows beside each other mostly share their text.
                let same = all.last().filter(|x| x.data() == cell.as_bytes());
                let text = same.cloned().unwrap_or_else(|| cell.into());
                all.push(text);
            }
        }
        Ok(())
    }

    /// Writes the group's cells, and drops them.
    pub fn write(
        &mut self,
        mut column: SerializedColumnWriter<'_>,
    ) -> Result<(), ParquetError> {
        match &mut self.cells {
            Cells::Level(all) => {
                column.typed::<DoubleType>().write_batch(all, None, None)?;
                all.clear();
            }
            Cells::Value(all, there) => {
                let column = column.typed::<DoubleType>();
                column.write_batch(all, Some(there), None)?;
                all.clear();
                there.clear();
            }
            Cells::Count(all) => {
                column.typed::<Int64Type>().write_batch(all, None, None)?;
                all.clear();
            }
            Cells::Flag(all) => {
                column.typed::<BoolType>().write_batch(all, None, None)?;
                all.clear();
            }
            Cells::Text(all) => {
                column
                    .typed::<ByteArrayType>()
                    .write_batch(all, None, None)?;
                all.clear();
            }
        }
        column.close()
    }
}

fn number(cell: &str) -> Result<f64, &'static str> {
    let expected = "a number";
    let number: f64 = cell.parse().map_err(|_| expected)?;
    if number.is_nan() { Err(expected) } else { Ok(number) }
}
