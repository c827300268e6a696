//! Numbers of a reference's CSV, and refusals.

use crate::methods::method::{Answer, MethodError};

/// A refusal of the core where an answer was due.
pub fn refused(error: impl std::fmt::Display) -> MethodError {
    MethodError::Oracle(error.to_string())
}

/// A CSV of expected values, embedded.
pub struct Csv {
    pub file: &'static str,
    pub text: &'static str,
}

/// The CSV of this path in `fixtures`.
macro_rules! csv {
    ($path:literal) => {
        Csv {
            file: concat!("fixtures/", $path),
            text: include_str!(concat!("../../../../../fixtures/", $path)),
        }
    };
}
pub(super) use csv;

impl Csv {
    /// Rows by their first field.
    pub fn rows(&self, first: &str) -> Result<Vec<Row>, MethodError> {
        let file = self.file;
        let cells = |line: &'static str| line.split(',').collect::<Vec<_>>();
        let lines = self.text.lines().map(cells);
        let rows: Vec<Row> = lines
            .filter(|cells| cells.first() == Some(&first))
            .map(|cells| Row { file, cells })
            .collect();
        if rows.is_empty() {
            return Err(self.lacks(format!("no row `{first}`")));
        }
        Ok(rows)
    }

    pub fn lacks(&self, what: String) -> MethodError {
        MethodError::Reference { file: self.file, what }
    }
}

/// A row.
pub struct Row {
    file: &'static str,
    cells: Vec<&'static str>,
}

impl Row {
    /// The text in a column, empty where there is none.
    pub fn text(&self, column: usize) -> &'static str {
        self.cells.get(column).copied().unwrap_or_default()
    }

    /// The numbers from a column on, so many.
    pub fn numbers<const N: usize>(
        &self,
        from: usize,
    ) -> Result<[f64; N], MethodError> {
        let mut numbers = [f64::NAN; N];
        for (k, number) in numbers.iter_mut().enumerate() {
            *number = self.number(from + k)?;
        }
        Ok(numbers)
    }

    /// The number in a column.
    pub fn number(&self, column: usize) -> Result<f64, MethodError> {
        let text = self.text(column).trim();
        let what = || format!("`{text}` is no number");
        let lacks =
            || MethodError::Reference { file: self.file, what: what() };
        text.parse().map_err(|_| lacks())
    }

    /// Puts quantities, whose expected values stand from a column on; `NA`
    /// stands where the reference has none.
    pub fn put(
        &self,
        answer: &mut Answer,
        from: usize,
        quantities: &[(&str, f64)],
    ) -> Result<(), MethodError> {
        for (k, (name, own)) in quantities.iter().enumerate() {
            if self.text(from + k) != "NA" {
                answer.put(name, [*own], [self.number(from + k)?]);
            }
        }
        Ok(())
    }
}
