//! Tables: as CSV text by [`rocking_exchange::table`], and as a page shows them.

pub use rocking_exchange::columns;
pub use rocking_exchange::table::{
    Table, body, cells, digits, number, optional,
};

/// A table with its title.
#[derive(Debug, Clone, Default)]
pub struct PlainTable {
    /// Unique name, also the anchor.
    pub name: String,
    /// Title: `Table 1. The 15 blocks`.
    pub title: String,
    /// Explanation of the table, in a sentence.
    pub reading: String,
    /// Column heads with units.
    pub header: Vec<String>,
    /// Rows; the first cell names the row.
    pub rows: Vec<Vec<String>>,
}

impl PlainTable {
    /// A table of these rows.
    pub fn new(
        name: &str,
        title: &str,
        reading: impl Into<String>,
        header: &[&str],
        rows: Vec<Vec<String>>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            reading: reading.into(),
            header: header.iter().map(|cell| (*cell).into()).collect(),
            rows,
        }
    }
}
