//! Tables as CSV text: one header line, long format, stable bytes.

use crate::columns::{Layout, SCHEMA};

/// Rows under one header line, as CSV.
///
/// ```
/// use rocking_exchange::table::{Table, number};
/// let mut table = Table::new(&["record", "edp"]);
/// table.row([String::from("A, B"), number(1.0 / 3.0)]);
/// assert_eq!(table.finish(), "record,edp\n\"A, B\",0.333333333\n");
/// ```
pub struct Table {
    csv: csv::Writer<Vec<u8>>,
    /// Last cell of every row: the schema number, if the table has it.
    last: Option<String>,
}

impl Table {
    /// A table with this header line, without cells that need quotes.
    pub fn headed(line: &str) -> Self {
        Self::new(&line.split(',').collect::<Vec<_>>())
    }

    /// A table with the cells of its header line.
    pub fn new(header: &[&str]) -> Self {
        let mut csv = csv::WriterBuilder::new();
        let csv = csv.flexible(true).from_writer(vec![]);
        let mut table = Self { csv, last: None };
        table.row(header);
        table
    }

    /// A table of the registry; each row ends with the schema number.
    pub fn of(layout: &Layout) -> Self {
        Self::with_schema(&layout.names().collect::<Vec<_>>())
    }

    /// A table whose last column is the schema number, which
    /// [`row`](Self::row) writes.
    pub fn with_schema(header: &[&str]) -> Self {
        Self { last: Some(SCHEMA.to_string()), ..Self::new(header) }
    }

    /// Adds a row; a cell with a comma, a quote or a line break is quoted.
    pub fn row<C: AsRef<[u8]>>(&mut self, cells: impl IntoIterator<Item = C>) {
        // Writing to memory cannot fail, and rows may differ in length.
        for cell in cells {
            let _ = self.csv.write_field(cell);
        }
        if let Some(last) = &self.last {
            let _ = self.csv.write_field(last);
        }
        let _ = self.csv.write_record(None::<&[u8]>);
    }

    /// The CSV text.
    pub fn finish(self) -> String {
        // Only text was written.
        let bytes = self.csv.into_inner().unwrap_or_default();
        String::from_utf8(bytes).unwrap_or_default()
    }
}

/// The rows of a table's text, without its header line.
pub fn body(text: &str) -> &str {
    text.split_once('\n').map_or("", |(_, rows)| rows)
}

/// A number as a cell: at most nine significant digits, `inf` or `-inf`; empty
/// for NaN.
pub fn number(x: f64) -> String {
    digits(x, 9)
}

/// A number as a cell with at most `digits` significant digits.
pub fn digits(x: f64, digits: usize) -> String {
    if x.is_nan() {
        return String::new();
    }
    if x.is_infinite() {
        return String::from(if x > 0.0 { "inf" } else { "-inf" });
    }
    let rounded = format!("{x:.0$e}", digits.saturating_sub(1));
    match rounded.parse::<f64>() {
        Ok(0.0) => String::from("0"),
        Ok(y) if (1e-5..1e15).contains(&y.abs()) => y.to_string(),
        Ok(y) => format!("{y:e}"),
        Err(_) => rounded,
    }
}

/// A number that may be missing, as a cell.
pub fn optional(x: Option<f64>) -> String {
    x.map_or_else(String::new, number)
}

/// Cells of a line of CSV, without line breaks in quoted cells.
pub fn cells(line: &str) -> Vec<String> {
    let mut reader = csv::ReaderBuilder::new();
    let mut reader = reader.has_headers(false).from_reader(line.as_bytes());
    let record = reader.records().next().and_then(Result::ok);
    record.iter().flatten().map(String::from).collect()
}
