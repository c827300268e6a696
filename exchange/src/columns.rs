//! Columns of the tables that commands write and read. `columns.txt` is the
//! one place that names them, and `docs/tables.md` is made of it.
//!
//! A table that a command writes ends with the column `schema`. It is a
//! column and no comment line, since pandas, Polars and DuckDB take a first
//! line of comment for the header.

use std::sync::LazyLock;

/// Number of the shape of all tables and JSON that commands write. It rises
/// when a column or a field changes its name, its unit or its meaning.
pub const SCHEMA: u32 = 1;

/// Name of the column that has [`SCHEMA`].
pub const SCHEMA_COLUMN: &str = "schema";

/// A column: its name, what its cells are, their unit and their meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the header line.
    pub name: &'static str,
    /// What the cells are: `text`, `number` (`inf` is one, and an empty cell
    /// a missing one), `level` (a number that many rows share, never
    /// missing), `count` (whole numbers) or `flag` (`true`, `false`).
    pub cells: &'static str,
    /// Unit; `1` for a number without one, `own` for that of the sample or
    /// the fragility, empty for other cells.
    pub unit: &'static str,
    /// Meaning.
    pub meaning: &'static str,
}

/// A table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Name of the table.
    pub name: &'static str,
    /// Which commands write and read it, and what a row is.
    pub about: &'static str,
    /// Whether a command writes it; it then ends with the schema number.
    pub is_written: bool,
    /// Its columns without the schema number, in order.
    pub columns: Vec<Column>,
}

macro_rules! tables {
    ($($table:ident = $name:literal),+ $(,)?) => {
        $(
            #[doc = concat!("The table `", $name, "`.")]
            pub static $table: LazyLock<Layout> =
                LazyLock::new(|| Layout::named($name));
        )+

        /// All tables.
        pub static TABLES: [&LazyLock<Layout>; [$($name),+].len()] =
            [$(&$table),+];
    };
}

tables!(
    IDA = "ida",
    FORCES = "forces",
    HISTORY = "history",
    OUTCOMES = "outcomes",
    COUNTS = "counts",
    BAND = "band",
    HAZARD = "hazard",
    BLOCKS = "blocks",
    ASSESSED_FRAGILITIES = "assessed fragilities",
    ASSESSED_CAPACITIES = "assessed capacities",
    ASSESSED_RESPONSES = "assessed responses",
    FRAGILITIES = "fragilities",
    SWEEP_FRAGILITIES = "sweep fragilities",
    SWEEP_CAPACITIES = "sweep capacities",
    SWEEP_ROWS = "sweep rows",
);

impl Layout {
    fn named(name: &'static str) -> Self {
        let mut layout =
            Self { name, about: "", is_written: false, columns: Vec::new() };
        for line in include_str!("columns.txt").lines() {
            let mut parts = line.splitn(5, '|').map(str::trim);
            let mut next = || parts.next().unwrap_or_default();
            let (table, column, cells) = (next(), next(), next());
            let (unit, meaning) = (next(), next());
            if table == name && column.is_empty() {
                layout.about = meaning;
                layout.is_written = cells == "written";
            } else if table == name {
                layout.columns.push(Column {
                    name: column,
                    cells,
                    unit,
                    meaning,
                });
            }
        }
        layout
    }

    /// Names of the columns, the schema number's included.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + '_ {
        let schema = self.is_written.then_some(SCHEMA_COLUMN);
        self.columns.iter().map(|column| column.name).chain(schema)
    }

    /// Whether a header line has these columns, with a schema number or,
    /// where people wrote the table, without.
    ///
    /// ```
    /// use rocking_exchange::columns::OUTCOMES;
    /// let own = ["intensity", "record", "event", "exceeded"];
    /// assert!(OUTCOMES.has(own));
    /// assert!(OUTCOMES.has(own.into_iter().chain(["schema"])));
    /// assert!(!OUTCOMES.has(["record", "intensity", "event", "exceeded"]));
    /// ```
    pub fn has<'a>(&self, header: impl IntoIterator<Item = &'a str>) -> bool {
        let header: Vec<&str> = header.into_iter().collect();
        let all: Vec<&str> = self.names().collect();
        header == all || header == all[..self.columns.len()]
    }

    /// Whether a row's cell behind the table's own says this schema, or none.
    pub fn is_current(&self, cell: Option<&str>) -> bool {
        cell.is_none_or(|cell| cell == SCHEMA.to_string())
    }
}
