//! What results say, one thing each.

/// One thing that results say.
#[derive(Clone, Debug, PartialEq)]
pub struct Item {
    /// What it belongs to: a case, a claim, a row of a table.
    pub owner: String,
    /// Its name within the owner.
    pub name: String,
    /// Suite and subject, or family: what it is listed under.
    pub group: String,
    /// What it is, in words.
    pub words: String,
    /// What it says.
    pub content: Content,
}

/// What an item says.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Whether a claim or a case holds.
    Verdict(String),
    /// What makes two runs different runs: a setting, a suite, a declared
    /// tolerance.
    Setting(String),
    /// Words around results.
    Text(String),
    /// A result.
    Number {
        /// The value; NaN where there is none.
        value: f64,
        /// What it may change by.
        limit: Limit,
    },
}

/// What a number may change by before the change means something.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Limit {
    /// Its 95 % interval.
    Interval(f64, f64),
    /// A declared tolerance, and the unit of the last digit printed.
    Tolerance(f64, f64),
    /// Nothing is stated.
    None,
    /// The verdict beside it tells.
    Verdict,
}
