//! Columns of the tables that commands write and read. Only `columns.txt`
//! names them, and `docs/tables.md` is generated from it.
//!
//! A table that a command writes ends with the column `schema`. It is a column
//! instead of a comment line, because pandas, Polars and DuckDB read a first
//! comment line as the header.

use std::sync::LazyLock;

/// Version of the form of all tables and JSON that commands write. It rises
/// when a column or a field changes its name, its unit or its meaning.
pub const SCHEMA: u32 = 1;

/// Name of the column of [`SCHEMA`].
pub const SCHEMA_COLUMN: &str = "schema";

/// A column: its name, and the kind, unit and meaning of its cells.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the header line.
    pub name: &'static str,
    /// Kind of the cells: `text`, `number` (also `inf`; an empty cell is a
    /// missing number), `count` (whole numbers) or `flag` (`true`, `false`).
    pub cells: &'static str,
    /// Whether an input table may lack it: `?` after the kind of its cells.
    pub is_optional: bool,
    /// Unit; `1` for a number without unit, `own` for the unit of the sample
    /// or the fragility, empty for other cells.
    pub unit: &'static str,
    /// Meaning.
    pub meaning: &'static str,
}

/// A table.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Name of the table.
    pub name: &'static str,
    /// The commands that write and read it, and the meaning of a row.
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
    ASSESSED_OBJECTS = "assessed objects",
    ASSESSED_FRAGILITIES = "assessed fragilities",
    ASSESSED_CAPACITIES = "assessed capacities",
    ASSESSED_RESPONSES = "assessed responses",
    COMPARED_TESTS = "compared tests",
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
            let [table, column, cells, unit, meaning] =
                [(); 5].map(|()| parts.next().unwrap_or_default());
            if table == name && column.is_empty() {
                layout.about = meaning;
                layout.is_written = cells == "written";
            } else if table == name {
                layout.columns.push(Column {
                    name: column,
                    cells: cells.trim_end_matches('?'),
                    is_optional: cells.ends_with('?'),
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

    /// Place of a column.
    ///
    /// # Panics
    /// If there is no column of this name.
    pub fn place(&self, column: &str) -> usize {
        self.names().position(|name| name == column).expect("a known column")
    }

    /// Places of the columns, and of the schema number behind them, in a
    /// header line of any order; `None` for an optional column that is
    /// missing.
    ///
    /// ```
    /// use rocking_exchange::columns::OUTCOMES;
    /// let own = ["record", "exceeded", "intensity"];
    /// let places = OUTCOMES.places(own);
    /// // Neither the earthquake nor the schema number.
    /// assert_eq!(places, Ok(vec![Some(2), Some(0), None, Some(1), None]));
    /// assert!(OUTCOMES.places(["record", "intensity"]).is_err());
    /// ```
    ///
    /// # Errors
    /// The found and the expected columns, in words.
    pub fn places<'a>(
        &self,
        header: impl IntoIterator<Item = &'a str>,
    ) -> Result<Vec<Option<usize>>, String> {
        let header: Vec<&str> = header.into_iter().collect();
        let place = |name: &str| header.iter().position(|own| *own == name);
        let schema = self.is_written.then(|| place(SCHEMA_COLUMN)).flatten();
        let own = self.columns.iter().map(|column| place(column.name));
        let places: Vec<Option<usize>> = own.chain([schema]).collect();
        let mut both = self.columns.iter().zip(&places);
        let missing = both.any(|(own, at)| at.is_none() && !own.is_optional);
        // An unknown or repeated name has no place.
        if missing || places.iter().flatten().count() != header.len() {
            let names = |optional: bool| {
                let own = self.columns.iter();
                let own = own.filter(|column| column.is_optional == optional);
                own.map(|column| column.name).collect::<Vec<_>>().join(",")
            };
            let mut expected = format!("`{}`", names(false));
            if self.columns.iter().any(|column| column.is_optional) {
                expected += &format!(", and, if known, `{}`", names(true));
            }
            let found: String = header.join(",").chars().take(200).collect();
            return Err(format!(
                "found columns `{found}`: expected {expected}"
            ));
        }
        Ok(places)
    }
}
