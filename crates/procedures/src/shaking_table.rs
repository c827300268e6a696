//! The table of shaking-table tests: an index of a suite, with the outcome of
//! each test.

use std::collections::BTreeMap;

use rocking::accelerogram::Accelerogram;
use rocking_records::{Processing, SuiteError, SuiteMember};
use thiserror::Error;

use crate::shaking::{ShakingTest, TestFate};

/// Default column of the outcomes.
pub const FATE_COLUMN: &str = "fate";
/// Column of the motion that a test repeats, if there is no `event`.
const MOTION_COLUMN: &str = "motion";
/// Column of the factor on the motion of the file.
const SCALE_COLUMN: &str = "scale";

/// Faults that one message shows, at most.
const MOST_SHOWN: usize = 200;

/// Contents of a cell of the column of outcomes.
const FATES: &str = "overturned, stood or unknown, or 1, 0 or an empty cell";

/// All faults of a table of tests, in the order of its lines.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("{}", shown(faults))]
pub struct TestTableError {
    /// The faults, at least one: file, line, what was found and what was
    /// expected.
    pub faults: Vec<String>,
}

fn shown(faults: &[String]) -> String {
    let (first, more) = faults.split_at(faults.len().min(MOST_SHOWN));
    let mut text = first.join("\n");
    if !more.is_empty() {
        text += &format!("\nand {} more faults", more.len());
    }
    text
}

impl TestFate {
    /// The outcome in a cell of a table: a name, `1` or `0`, or nothing.
    ///
    /// ```
    /// use rocking_procedures::shaking::TestFate;
    /// assert_eq!(TestFate::of_cell("1"), Some(TestFate::Overturned));
    /// assert_eq!(TestFate::of_cell(""), Some(TestFate::Unknown));
    /// assert_eq!(TestFate::of_cell("yes"), None);
    /// ```
    pub fn of_cell(cell: &str) -> Option<Self> {
        match cell {
            "1" => Some(Self::Overturned),
            "0" => Some(Self::Stood),
            "" => Some(Self::Unknown),
            name => name.parse().ok(),
        }
    }
}

impl ShakingTest {
    /// The positive numbers among cells, by the names of their columns.
    pub fn columns(cells: &BTreeMap<String, String>) -> BTreeMap<String, f64> {
        let number = |(name, cell): (&String, &String)| {
            Some((name.clone(), positive(cell)?))
        };
        cells.iter().filter_map(number).collect()
    }
}

/// Reader of the tests of a table from its members.
#[derive(Clone, Copy, Debug)]
pub struct TestTable<'a> {
    /// The table, in messages.
    pub path: &'a str,
    /// Column of the outcomes.
    pub fate: &'a str,
    /// Processing of every motion before it is scaled.
    pub processing: Processing,
}

impl TestTable<'_> {
    /// The tests, in their order. A test repeats the motion that the column
    /// `event` names, or `motion` if there is no `event`; its record is the
    /// motion of its file, times the cell of the column `scale` if there is
    /// one.
    ///
    /// # Errors
    /// [`TestTableError`] with every fault of the table and its line.
    pub fn tests(
        &self,
        members: Vec<Result<SuiteMember, SuiteError>>,
    ) -> Result<Vec<ShakingTest>, TestTableError> {
        let first = members.iter().flatten().next();
        let mut faults = first.map_or(Vec::new(), |own| self.missing(own));
        let has_columns = faults.is_empty();
        let (mut tests, mut lines) = (Vec::new(), BTreeMap::new());
        for member in members {
            let member = match member {
                Ok(member) => member,
                Err(error) => {
                    faults.push(error.to_string());
                    continue;
                }
            };
            let line = member.line.unwrap_or(0);
            let place = format!("{}:{line}", self.path);
            let name = member.accelerogram.name();
            if let Some(before) = lines.insert(name.to_owned(), line) {
                faults.push(format!(
                    "{place}: test {name:?} is also on line {before}: \
                     expected a distinct name, in a column `name` if one file \
                     has several tests"
                ));
            }
            if has_columns {
                let refuse = |own: String| format!("{place}: {own}");
                match self.test(&member) {
                    Ok(test) => tests.push(test),
                    Err(own) => faults.extend(own.into_iter().map(refuse)),
                }
            }
        }
        if faults.is_empty() && tests.is_empty() {
            let path = self.path;
            faults.push(format!(
                "{path}: found no test: expected one row for each test"
            ));
        }
        if faults.is_empty() {
            Ok(tests)
        } else {
            Err(TestTableError { faults })
        }
    }

    /// The columns that the table lacks: each row has all columns.
    fn missing(&self, member: &SuiteMember) -> Vec<String> {
        let cells = member.attributes_by_name();
        let has = |name: &str| cells.contains_key(name);
        let mut faults = Vec::new();
        let mut lacks = |column: &str, expected: &str| {
            let path = self.path;
            faults.push(format!(
                "{path}: found no column {column:?}: expected {expected}"
            ));
        };
        if !has(self.fate) {
            lacks(self.fate, &format!("the outcome of each test, {FATES}"));
        }
        if member.event.is_none() && !has(MOTION_COLUMN) {
            lacks(
                "event",
                "the motion that each test repeats, in a column `event` or \
                 `motion`; a test that repeats no other has a unique name there",
            );
        }
        faults
    }

    /// The test of a row, or the faults of the row.
    fn test(&self, member: &SuiteMember) -> Result<ShakingTest, Vec<String>> {
        let cells = member.attributes_by_name();
        let cell = |name: &str| cells.get(name).map(String::as_str);
        let mut faults = Vec::new();
        let mut refuse = |column: &str, found: &str, expected: &str| {
            faults.push(format!(
                "column {column}: found {found:?}: expected {expected}"
            ));
        };
        let stated = cell(self.fate).unwrap_or_default();
        let fate = TestFate::of_cell(stated);
        if fate.is_none() {
            refuse(self.fate, stated, FATES);
        }
        let stated = cell(MOTION_COLUMN);
        let motion = member.event.as_deref().or(stated).unwrap_or_default();
        if motion.is_empty() || stated.is_some_and(|own| own != motion) {
            let expected = "the motion that the test repeats, as in a column \
                            `event`";
            refuse(MOTION_COLUMN, stated.unwrap_or_default(), expected);
        }
        let stated = cell(SCALE_COLUMN).unwrap_or("1");
        let scale = positive(stated);
        if scale.is_none() {
            refuse(SCALE_COLUMN, stated, "a positive factor on the motion");
        }
        let (Some(fate), Some(scale), []) = (fate, scale, &faults[..]) else {
            return Err(faults);
        };
        let processed = self.processing.apply(&member.accelerogram);
        let processed = processed.map_err(|error| vec![error.to_string()])?;
        let samples = processed.samples_g().iter().map(|a| scale * a);
        let (name, dt_s) = (processed.name(), processed.dt_s());
        let record = Accelerogram::try_new(name, dt_s, samples.collect())
            .map_err(|error| vec![error.to_string()])?;
        let columns = ShakingTest::columns(&cells);
        Ok(ShakingTest { record, motion: motion.to_owned(), fate, columns })
    }
}

fn positive(cell: &str) -> Option<f64> {
    let number = cell.parse().ok();
    number.filter(|x: &f64| *x > 0.0 && x.is_finite())
}
