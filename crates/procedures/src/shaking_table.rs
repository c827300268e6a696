//! The table of shaking-table tests: an index of a suite, with the fate of
//! each test.

use std::collections::BTreeMap;
use std::fmt;

use rocking::accelerogram::{Accelerogram, AccelerogramError};
use rocking_records::{Processing, ProcessingError, SuiteError, SuiteMember};
use thiserror::Error;

use crate::shaking::{ShakingTest, TestFate};

/// Column of the fates, where no other one is named.
pub const FATE_COLUMN: &str = "fate";
/// Column of the motion that a test repeats, if there is no `event`.
const MOTION_COLUMN: &str = "motion";
/// Column of the factor on the motion of the file.
const SCALE_COLUMN: &str = "scale";

/// Faults that one message shows, at most.
const MOST_SHOWN: usize = 200;

/// What a cell of fates holds.
const FATES: &str = "overturned, stood or unknown, or 1, 0 or an empty cell";

/// A fault of a table of tests.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum TestFault {
    /// A file that was refused, or a row that does not describe it.
    #[error(transparent)]
    Suite(#[from] SuiteError),
    /// A column that the table lacks.
    #[error("{path}: found no column {column:?}: expected {expected}")]
    Column {
        /// The table.
        path: String,
        /// The column.
        column: String,
        /// What the column holds.
        expected: String,
    },
    /// A cell that is none of its column.
    #[error(
        "{path}:{line}: column {column}: found {found:?}: expected {expected}"
    )]
    Cell {
        /// The table.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// The column.
        column: String,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// Two tests of one name.
    #[error(
        "{path}:{line}: test {name:?} stands on line {before} too: expected \
         a name of its own, in a column `name` if one file has several tests"
    )]
    Name {
        /// The table.
        path: String,
        /// Line of the second test, counted from 1.
        line: usize,
        /// The name.
        name: String,
        /// Line of the first test.
        before: usize,
    },
    /// A motion that cannot be processed.
    #[error("{path}:{line}: {source}")]
    Processing {
        /// The table.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// Why.
        #[source]
        source: ProcessingError,
    },
    /// A motion that is none at the scale of its test.
    #[error("{path}:{line}: {source}")]
    Scaled {
        /// The table.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// Why.
        #[source]
        source: AccelerogramError,
    },
    /// No test.
    #[error("{0}: found no test: expected one row for each test")]
    Empty(String),
}

/// All faults of a table of tests, in the order of its lines.
#[derive(Clone, Debug, PartialEq)]
pub struct TestTableError {
    /// The faults; at least one.
    pub faults: Vec<TestFault>,
}

impl fmt::Display for TestTableError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (k, fault) in self.faults.iter().take(MOST_SHOWN).enumerate() {
            let gap = if k == 0 { "" } else { "\n" };
            write!(f, "{gap}{fault}")?;
        }
        match self.faults.len().saturating_sub(MOST_SHOWN) {
            0 => Ok(()),
            more => write!(f, "\nand {more} faults more"),
        }
    }
}

impl std::error::Error for TestTableError {}

impl TestFate {
    /// The fate that a cell of a table states: a name, `1` or `0`, or
    /// nothing.
    ///
    /// ```
    /// use rocking_procedures::shaking::TestFate;
    /// assert_eq!(TestFate::of_cell("1"), Some(TestFate::Overturned));
    /// assert_eq!(TestFate::of_cell(""), Some(TestFate::Unknown));
    /// assert_eq!(TestFate::of_cell("yes"), None);
    /// ```
    #[must_use]
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
    pub fn columns<'a>(
        cells: impl Iterator<Item = (&'a str, &'a str)>,
    ) -> BTreeMap<String, f64> {
        let number = |(name, cell): (&str, &str)| {
            Some((name.to_owned(), positive(cell)?))
        };
        cells.filter_map(number).collect()
    }
}

/// How the tests of a table are read from its members.
#[derive(Clone, Copy, Debug)]
pub struct TestTable<'a> {
    /// The table, in messages.
    pub path: &'a str,
    /// Column of the fates.
    pub fate: &'a str,
    /// What is done to every motion before it is scaled.
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
        let (mut tests, mut faults) = (Vec::new(), Vec::new());
        self.check_columns(&members, &mut faults);
        let has_columns = faults.is_empty();
        let mut names = BTreeMap::new();
        for member in members {
            let member = match member {
                Ok(member) => member,
                Err(error) => {
                    faults.push(error.into());
                    continue;
                }
            };
            let line = member.line.unwrap_or(0);
            let name = member.accelerogram.name().to_owned();
            if let Some(before) = names.insert(name.clone(), line) {
                let path = self.path.to_owned();
                faults.push(TestFault::Name { path, line, name, before });
            }
            if has_columns {
                match self.test(&member, line) {
                    Ok(test) => tests.push(test),
                    Err(all) => faults.extend(all),
                }
            }
        }
        if faults.is_empty() && tests.is_empty() {
            faults.push(TestFault::Empty(self.path.to_owned()));
        }
        if faults.is_empty() {
            Ok(tests)
        } else {
            Err(TestTableError { faults })
        }
    }

    /// The table has each column that is needed, or none of its rows does.
    fn check_columns(
        &self,
        members: &[Result<SuiteMember, SuiteError>],
        faults: &mut Vec<TestFault>,
    ) {
        let Some(member) = members.iter().flatten().next() else { return };
        let has = |name: &str| cell(member, name).is_some();
        let mut lacks = |column: &str, expected: &str| {
            faults.push(TestFault::Column {
                path: self.path.to_owned(),
                column: column.to_owned(),
                expected: expected.to_owned(),
            });
        };
        if !has(self.fate) {
            lacks(self.fate, &format!("the fate of each test, {FATES}"));
        }
        if member.event.is_none() && !has(MOTION_COLUMN) {
            lacks(
                "event",
                "the motion that each test repeats, in a column `event` or \
                 `motion`; a test of its own motion has its own name there",
            );
        }
    }

    fn test(
        &self,
        member: &SuiteMember,
        line: usize,
    ) -> Result<ShakingTest, Vec<TestFault>> {
        let mut faults = Vec::new();
        let path = || self.path.to_owned();
        let mut refuse = |column: &str, found: &str, expected: &str| {
            faults.push(TestFault::Cell {
                path: path(),
                line,
                column: column.to_owned(),
                found: found.to_owned(),
                expected: expected.to_owned(),
            });
        };
        let stated = cell(member, self.fate).unwrap_or_default();
        let fate = TestFate::of_cell(stated);
        if fate.is_none() {
            refuse(self.fate, stated, FATES);
        }
        let motion = cell(member, MOTION_COLUMN).unwrap_or_default();
        let motion = member.event.as_deref().unwrap_or(motion);
        if motion.is_empty() {
            refuse(MOTION_COLUMN, motion, "the motion that the test repeats");
        }
        let stated = cell(member, SCALE_COLUMN);
        let scale = stated.map_or(Some(1.0), positive);
        if scale.is_none() {
            let found = stated.unwrap_or_default();
            refuse(SCALE_COLUMN, found, "a positive factor on the motion");
        }
        let (Some(fate), Some(scale), true) = (fate, scale, faults.is_empty())
        else {
            return Err(faults);
        };
        let processed = self.processing.apply(&member.accelerogram);
        let processed = processed.map_err(|source| {
            vec![TestFault::Processing { path: path(), line, source }]
        })?;
        let record = scaled(processed, scale).map_err(|source| {
            vec![TestFault::Scaled { path: path(), line, source }]
        })?;
        let columns = member.attributes.iter();
        let columns = columns.map(|(name, cell)| (&**name, &**cell));
        let columns = ShakingTest::columns(columns);
        let motion = motion.to_owned();
        Ok(ShakingTest { record, motion, fate, columns })
    }
}

/// A cell of a column that is no column of a suite.
fn cell<'a>(member: &'a SuiteMember, column: &str) -> Option<&'a str> {
    let mut cells = member.attributes.iter();
    let found = cells.find(|(name, _)| **name == *column);
    found.map(|(_, cell)| cell.as_str())
}

fn positive(cell: &str) -> Option<f64> {
    let number = cell.parse().ok();
    number.filter(|x: &f64| *x > 0.0 && x.is_finite())
}

fn scaled(
    record: Accelerogram,
    scale: f64,
) -> Result<Accelerogram, AccelerogramError> {
    if scale == 1.0 {
        return Ok(record);
    }
    let samples = record.samples_g().iter().map(|a| scale * a).collect();
    Accelerogram::try_new(record.name(), record.dt_s(), samples)
}
