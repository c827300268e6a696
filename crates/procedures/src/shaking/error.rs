//! Reasons for which tests cannot be compared.

use thiserror::Error;

use super::capacities::ENDS;
use crate::ProcedureError;
use rocking::block::BlockError;
use rocking::ida::IdaError;
use rocking_records::intensity::IntensityError;
use rocking_statistics::lognormal::FitError;

/// Why a block cannot be compared with tests.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ShakingError {
    /// There is no test with a known outcome.
    #[error("{unknown} tests, no known outcome: expected both outcomes")]
    NoTests {
        /// Tests whose outcome is unknown.
        unknown: usize,
    },
    /// Too few motions, the unit of the intervals.
    #[error("{found} motions of {tests} tests: expected at least 3")]
    Motions {
        /// Number of motions with a known outcome.
        found: usize,
        /// Number of tests with a known outcome.
        tests: usize,
    },
    /// Outcomes of one kind bound the capacity on only one side.
    #[error(
        "{which} {tests} tests overturned the specimen: expected both outcomes"
    )]
    OneFate {
        /// `all`, or `none of`.
        which: &'static str,
        /// Number of tests with a known outcome.
        tests: usize,
    },
    /// The outcomes determine no scatter of the capacity.
    #[error("demand over capacity of the tests{}: {source}", less(.without))]
    Fit {
        /// The motion that was left out, if one was.
        without: Option<String>,
        /// Why there is no fit.
        #[source]
        source: FitError,
    },
    /// A PGA, capacity or measure that is not positive.
    #[error("test {test}: {what} is {found}: expected a positive number")]
    Number {
        /// The test.
        test: String,
        /// The quantity.
        what: String,
        /// Its value; NaN if there is none.
        found: f64,
    },
    /// No slenderness makes computed and measured capacities agree.
    #[error(
        "no slenderness between {} and {} rad makes the median of measured over computed capacity 1",
        ENDS[0],
        ENDS[1]
    )]
    Slenderness,
    /// The measures of a record.
    #[error("test {test}: {source}")]
    Record {
        /// The test.
        test: String,
        /// What was wrong.
        #[source]
        source: IntensityError,
    },
    /// Gravity or periods of measures.
    #[error(transparent)]
    Settings(#[from] IntensityError),
    /// The block.
    #[error(transparent)]
    Block(#[from] BlockError),
    /// The draws.
    #[error(transparent)]
    Draws(#[from] ProcedureError),
    /// An analysis.
    #[error(transparent)]
    Ida(#[from] IdaError),
}

fn less(motion: &Option<String>) -> String {
    motion.as_ref().map_or(String::new(), |m| format!(" without motion {m}"))
}
