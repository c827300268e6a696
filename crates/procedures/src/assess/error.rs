//! Why objects cannot be assessed.

use thiserror::Error;

use super::{Assumption, LEAST_RECORDS};
use crate::ProcedureError;
use rocking::block::BlockError;
use rocking::capacity::CapacityError;
use rocking::ida::IdaError;
use rocking_records::floor::FloorError;
use rocking_records::intensity::IntensityError;

/// Why objects cannot be assessed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AssessError {
    /// There is nothing to assess.
    #[error("no object: expected at least one")]
    NoObject,
    /// Too few records to estimate the scatter of intensities.
    #[error(
        "{0} records: expected at least {LEAST_RECORDS}, to estimate the \
         scatter of intensities of damage"
    )]
    Records(usize),
    /// A target that is no return period of the hazard curve.
    #[error(
        "target {found} years: expected a return period of at most {longest:.0} \
         years, that of the hazard curve's last point"
    )]
    Target {
        /// The target in years.
        found: f64,
        /// The longest return period of the hazard curve in years.
        longest: f64,
    },
    /// A target without a hazard curve.
    #[error("a target return period: expected a hazard curve beside it")]
    TargetAlone,
    /// A share that is not in [0, 1).
    #[error("sliding share {0}: expected a number from 0 to below 1")]
    SlidingShare(f64),
    /// A limit of rotation that is not a fraction of the slenderness.
    #[error("{id}: limit_ratio {found}: expected a number between 0 and 1")]
    Limit {
        /// The object.
        id: String,
        /// Its limit.
        found: f64,
    },
    /// The measure of the hazard curve cannot be computed from records.
    #[error(
        "hazard curve in {0}: expected pga_g, pgv_m_s, pgv_cm_s, a spectral \
         acceleration or AvgSA"
    )]
    Measure(String),
    /// An analysis was rejected.
    #[error(transparent)]
    Analysis(#[from] IdaError),
    /// The forces at an object's pivot cannot be computed.
    #[error("{id}: {source}")]
    Ida {
        /// The object.
        id: String,
        /// Why.
        source: IdaError,
    },
    /// An object's capacities make no fit.
    #[error("{id}: {source}")]
    Fit {
        /// The object.
        id: String,
        /// Why.
        source: ProcedureError,
    },
    /// An object's capacities have no fit under another assumption.
    #[error("{id}, {assumption}: {source}")]
    Alternative {
        /// The object.
        id: String,
        /// The assumption.
        assumption: Assumption,
        /// Why.
        source: ProcedureError,
    },
    /// A record has no measures.
    #[error("record {record}: {source}")]
    Record {
        /// The record.
        record: String,
        /// Why.
        source: IntensityError,
    },
    /// The motion of a floor under a record cannot be computed.
    #[error("record {record}, floor {floor}: {source}")]
    Floor {
        /// The record.
        record: String,
        /// The floor.
        floor: String,
        /// Why.
        source: FloorError,
    },
    /// A curve has no capacities.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// A coefficient is out of range.
    #[error(transparent)]
    Block(#[from] BlockError),
}
