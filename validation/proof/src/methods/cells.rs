//! Numbers in the CSV files of expected values.

use std::str::FromStr;

use anyhow::{Context as _, Error, Result, anyhow, ensure};
use rocking::number::double::DoubleDouble;

use super::method::Reply;
use crate::arithmetic::decimal;

/// A CSV of expected values, embedded.
pub struct Csv {
    file: &'static str,
    text: &'static str,
}

impl Csv {
    /// The CSV of this path in `fixtures`.
    pub const fn new(file: &'static str) -> Self {
        Self { file, text: rocking_fixtures::text(file) }
    }

    /// Rows by their first field.
    pub fn rows(&self, first: &str) -> Result<Vec<CsvRow>> {
        let (file, lines) = (self.file, self.text.lines());
        let rows = lines.map(|line| line.split(',').collect::<Vec<_>>());
        let rows = rows.filter(|cells| cells[0] == first);
        let rows: Vec<_> = rows.map(|cells| CsvRow { file, cells }).collect();
        ensure!(!rows.is_empty(), self.lacks(format!("no row `{first}`")));
        Ok(rows)
    }

    /// The row that begins with these fields.
    pub fn row(&self, first: &[&str]) -> Result<CsvRow> {
        let mut rows = self.rows(first[0])?.into_iter();
        let found = rows.find(|row| row.cells.starts_with(first));
        let none = || self.lacks(format!("no row `{}`", first.join(",")));
        found.ok_or_else(none)
    }

    pub fn lacks(&self, what: impl std::fmt::Display) -> Error {
        anyhow!("fixtures/{}: {what}", self.file)
    }
}

/// A row.
pub struct CsvRow {
    file: &'static str,
    cells: Vec<&'static str>,
}

impl CsvRow {
    /// The text in a column; empty if there is none.
    pub fn text(&self, column: usize) -> &'static str {
        self.cells.get(column).copied().unwrap_or_default()
    }

    /// N numbers from a column on.
    pub fn numbers<const N: usize>(&self, from: usize) -> Result<[f64; N]> {
        let mut numbers = [f64::NAN; N];
        for (k, number) in numbers.iter_mut().enumerate() {
            *number = self.number(from + k)?;
        }
        Ok(numbers)
    }

    /// The numbers in a column, separated by a character.
    pub fn list(&self, column: usize, by: char) -> Result<Vec<f64>> {
        let cells = self.text(column).split(by);
        cells.map(|cell| self.parsed(cell)).collect()
    }

    /// The decimals in a column, separated by semicolons, to the last bits of
    /// a double-double.
    pub fn decimals(&self, column: usize) -> Result<Vec<DoubleDouble>> {
        let wide = |text| decimal(text).with_context(|| self.no(text));
        self.text(column).split(';').map(wide).collect()
    }

    /// The value of a text.
    pub fn parsed<T: FromStr>(&self, text: &str) -> Result<T> {
        text.trim().parse().ok().with_context(|| self.no(text))
    }

    fn no(&self, text: &str) -> String {
        format!("fixtures/{}: `{text}` is no value", self.file)
    }

    /// The number in a column.
    pub fn number(&self, column: usize) -> Result<f64> {
        self.parsed(self.text(column))
    }

    /// Puts quantities with their expected values from a column on; `NA`
    /// means that the reference has no value.
    pub fn put(
        &self,
        answer: &mut Reply,
        from: usize,
        quantities: &[(&str, f64)],
    ) -> Result<()> {
        for (k, (name, own)) in quantities.iter().enumerate() {
            if self.text(from + k) != "NA" {
                answer.put(name, [*own], [self.number(from + k)?]);
            }
        }
        Ok(())
    }
}
