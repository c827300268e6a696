//! Columns of the tables that commands write and read: the one place that
//! names them. `docs/tables.md` is made of it.
//!
//! A table that a command writes ends with the column `schema`. It is a
//! column and no comment line, since pandas, Polars and DuckDB take a first
//! line of comment for the header.

use Kind::{Count, Flag, Number, Text};

/// Number of the shape of all tables and JSON that commands write. It rises
/// when a column or a field changes its name, its unit or its meaning.
pub const SCHEMA: u32 = 1;

/// Name of the column that has [`SCHEMA`].
pub const SCHEMA_COLUMN: &str = "schema";

/// What the cells of a column are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Kind {
    /// Text.
    Text,
    /// Numbers, `inf` among them; an empty cell is a missing one.
    Number,
    /// Whole numbers, not negative.
    Count,
    /// `true` or `false`.
    Flag,
}

/// A column: its name, what its cells are, their unit and their meaning.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Column {
    /// Name in the header line.
    pub name: &'static str,
    /// What the cells are.
    pub kind: Kind,
    /// Unit; `1` for a number without one, empty for other kinds.
    pub unit: &'static str,
    /// Meaning.
    pub meaning: &'static str,
}

/// A table of one or several files.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Layout {
    /// Name of the table.
    pub name: &'static str,
    /// Which commands write and read it, and what a row is.
    pub about: &'static str,
    /// Whether a command writes it; it then ends with the schema number.
    pub is_written: bool,
    /// Its columns without the schema number, in order.
    pub columns: &'static [Column],
}

impl Layout {
    /// Names of the columns, the schema number's included.
    pub fn names(&self) -> impl Iterator<Item = &'static str> {
        let schema = self.is_written.then_some(SCHEMA_COLUMN);
        self.columns.iter().map(|column| column.name).chain(schema)
    }

    /// Whether a header line has these columns, with a schema number or,
    /// where people wrote the table, without.
    ///
    /// ```
    /// use rocking_exchange::columns::COUNTS;
    /// assert!(COUNTS.has(["intensity", "exceeded", "n", "schema"]));
    /// assert!(COUNTS.has(["intensity", "exceeded", "n"]));
    /// assert!(!COUNTS.has(["intensity", "n", "exceeded"]));
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

const fn number(
    name: &'static str,
    unit: &'static str,
    meaning: &'static str,
) -> Column {
    Column { name, kind: Number, unit, meaning }
}

const fn of(name: &'static str, kind: Kind, meaning: &'static str) -> Column {
    Column { name, kind, unit: "", meaning }
}

/// Analyses of `rocking ida`.
pub const IDA: Layout = Layout {
    name: "ida",
    about: "`rocking ida --out` writes it; `capacities`, `stripes` and \
            `rank` read it. A row is an analysis, by record, then level.",
    is_written: true,
    columns: &[
        of("record", Text, "name of the record"),
        number("alpha_rad", "rad", "slenderness angle"),
        number("p_rad_s", "rad/s", "frequency parameter"),
        number("pga_g", "g", "peak ground acceleration"),
        number("pgv_m_s", "m/s", "peak ground velocity"),
        number("intensity_pga", "1", "PGA/(g tan alpha)"),
        number("intensity_pgv", "1", "p PGV/(g tan alpha)"),
        number("edp", "1", "peak of |theta|/alpha, inf where overturned"),
        of(
            "outcome",
            Text,
            "no-uplift, rocked, overturned, overturned-refined (end of the \
             bisection) or unresolved",
        ),
        number("margin", "1", "distance from the other fate, over alpha"),
        of("remarks", Text, "codes of what is suspicious about the record"),
        number("eta", "1", "coefficient of restitution"),
        of("model", Text, "equation of motion"),
        of("overturn", Text, "when the block counts as overturned"),
        of("by", Text, "how intensity is reached"),
        number("gravity_m_s2", "m/s2", "gravity"),
        of("processing", Text, "what was done to the records"),
        of("software", Text, "program and version"),
    ],
};

/// Forces at the pivot of the analyses of `rocking ida`.
pub const FORCES: Layout = Layout {
    name: "forces",
    about: "`rocking ida --forces` writes it. A row is an analysis.",
    is_written: true,
    columns: &[
        of("record", Text, "name of the record"),
        number("intensity_pga", "1", "PGA/(g tan alpha)"),
        number("pga_g", "g", "peak ground acceleration"),
        number("edp", "1", "peak of |theta|/alpha, inf where overturned"),
        number("friction", "1", "largest |H|/N that the motion needs"),
        number("friction_time_s", "s", "its time"),
        number("least_normal_over_weight", "1", "least N/(m g)"),
        number("least_normal_time_s", "s", "its time"),
    ],
};

/// History of `rocking respond`.
pub const HISTORY: Layout = Layout {
    name: "history",
    about: "`rocking respond --history` writes it. A row is a time.",
    is_written: true,
    columns: &[
        number("time_s", "s", "time"),
        number("rotation_rad", "rad", "rotation theta"),
        number("velocity_rad_s", "rad/s", "angular velocity"),
        number("rotation_ratio", "1", "theta/alpha"),
    ],
};

/// Counts of records that exceeded a level.
pub const COUNTS: Layout = Layout {
    name: "counts",
    about: "`rocking stripes --counts` writes it, and `rocking fragility \
            counts` reads it, with or without `schema`. A row is an \
            intensity.",
    is_written: true,
    columns: &[
        number("intensity", "own", "intensity of the stripe"),
        of("exceeded", Count, "records that exceeded the level"),
        of("n", Count, "records that were run"),
    ],
};

/// Band of a fragility.
pub const BAND: Layout = Layout {
    name: "band",
    about: "`rocking fragility fit --band-csv` writes it. A row is an \
            intensity.",
    is_written: true,
    columns: &[
        number("intensity", "own", "intensity, in the sample's unit"),
        number("probability", "1", "fragility"),
        number("low", "1", "lower end of its bootstrap interval"),
        number("high", "1", "upper end"),
        number(
            "delta_low",
            "1",
            "lower end of its interval of the normal \
                approximation",
        ),
        number("delta_high", "1", "upper end"),
    ],
};

/// Hazard curve that `rocking risk` reads.
pub const HAZARD: Layout = Layout {
    name: "hazard",
    about: "`rocking risk` reads it: one of the first four columns, and one \
            of the last two. It reads OpenQuake's CSV of hazard curves, too.",
    is_written: false,
    columns: &[
        number("pga_g", "g", "peak ground acceleration"),
        number("pgv_m_s", "m/s", "peak ground velocity"),
        number("pgv_cm_s", "cm/s", "peak ground velocity"),
        number("intensity", "own", "intensity, in the fragility's unit"),
        number("annual_frequency", "1/year", "frequency of exceedance"),
        number("probability_of_exceedance", "1", "in the years of --years"),
    ],
};

const ALPHA: Column = number("alpha_rad", "rad", "slenderness angle");
const P: Column = number("p_rad_s", "rad/s", "frequency parameter");
const ETA: Column = number("eta", "1", "coefficient of restitution");

/// Fragilities of a sweep's blocks.
pub const SWEEP_FRAGILITIES: Layout = Layout {
    name: "sweep fragilities",
    about: "`rocking sweep merge` writes it, and `sweep fit` reads it. A row \
            is a block, a measure and a demand.",
    is_written: true,
    columns: &[
        ALPHA,
        P,
        ETA,
        of("im", Text, "intensity measure, pga or pgv"),
        number("demand", "1", "EDP level, 1 for overturning"),
        of("records", Count, "records of the suite"),
        of("reached", Count, "records that reach the demand"),
        number(
            "shift",
            "1",
            "least intensity at uplift, PGA/(g tan alpha) \
                or p PGV/(g tan alpha)",
        ),
        number("median", "1", "median, the shift included"),
        number(
            "dispersion",
            "1",
            "dispersion of the logarithm above the \
                shift",
        ),
        number("median_low", "1", "lower end of its 95 % interval"),
        number("median_high", "1", "upper end"),
        number("dispersion_low", "1", "lower end of its 95 % interval"),
        number("dispersion_high", "1", "upper end"),
        of("unresolved", Count, "analyses that double precision leaves open"),
    ],
};

/// Capacities of a sweep's records.
pub const SWEEP_CAPACITIES: Layout = Layout {
    name: "sweep capacities",
    about: "`rocking sweep merge --what capacities` writes it. A row is a block \
            and a record. Before `schema`, a column `intensity_at_D` for \
            each demand D has the capacity, PGA/(g tan alpha).",
    is_written: true,
    columns: &[
        ALPHA,
        P,
        ETA,
        of("record", Text, "name of the record"),
        number(
            "velocity_factor",
            "1",
            "p PGV/PGA, the factor from one \
                intensity to the other",
        ),
        number("first_overturning", "1", "PGA/(g tan alpha) of it, or inf"),
        of("analyses", Count, "analyses of the curve"),
        of("unresolved", Count, "analyses that double precision leaves open"),
    ],
};

/// Analyses of a sweep.
pub const SWEEP_ROWS: Layout = Layout {
    name: "sweep rows",
    about: "`rocking sweep merge --what rows` writes it. A row is an analysis.",
    is_written: true,
    columns: &[
        ALPHA,
        P,
        ETA,
        of("record", Text, "name of the record"),
        number("intensity_pga", "1", "PGA/(g tan alpha)"),
        number("pga_g", "g", "peak ground acceleration"),
        number("edp", "1", "peak of |theta|/alpha, inf where overturned"),
        of("refined", Flag, "whether it is the end of the bisection"),
        of("resolved", Flag, "whether double precision decides the outcome"),
    ],
};

/// All tables.
pub const TABLES: [&Layout; 9] = [
    &IDA,
    &FORCES,
    &HISTORY,
    &COUNTS,
    &BAND,
    &HAZARD,
    &SWEEP_FRAGILITIES,
    &SWEEP_CAPACITIES,
    &SWEEP_ROWS,
];
