//! State of a block in motion, and what a run gathers.

use crate::integrator::accuracy::Accuracy;
use crate::integrator::{
    Forces, HistoryPoint, Impact, SceneError, Side, Work,
};
use crate::number::Real;
use crate::number::double::DoubleDouble;

/// State of a block in motion, in units of 1/p: u = |theta| on a side.
#[derive(Clone, Copy, Debug)]
pub(crate) struct BlockMotion<N> {
    pub side: Side,
    pub u: N,
    pub w: N,
}

/// What a run gathers.
pub(crate) struct RunTrace<N> {
    pub peak: N,
    pub peak_time_s: Option<N>,
    pub uplift_time_s: Option<N>,
    pub rest_time_s: Option<N>,
    pub impacts: Vec<Impact<N>>,
    pub history: Vec<HistoryPoint<N>>,
    pub forces: Option<Forces>,
    pub work: Work,
    /// Why the run is refused, once its work passes the limit.
    pub exceeded: Option<SceneError>,
    /// Bounds of the errors of the times of rest and of overturning, s.
    pub rest_error_s: Option<f64>,
    pub overturning_error_s: Option<f64>,
    /// Errors by this arithmetic, and, where that is wider than the inputs'
    /// own precision, by the inputs.
    pub accuracy: Option<Accuracy>,
    pub inputs: Option<Accuracy>,
}

impl<N: Real> RunTrace<N> {
    pub fn empty() -> Self {
        Self {
            peak: N::zero(),
            peak_time_s: None,
            uplift_time_s: None,
            rest_time_s: None,
            impacts: Vec::new(),
            history: Vec::new(),
            forces: None,
            work: Work::default(),
            exceeded: None,
            rest_error_s: None,
            overturning_error_s: None,
            accuracy: None,
            inputs: None,
        }
    }
}

/// Post-impact speed over alpha p below which an observer of events lets the
/// geometric tail of the impacts stand for the rest of them: the tail's own
/// error is of second order in it (over the square of the least downward
/// acceleration, which grazing uplifts make small).
pub(crate) fn tail_speed<N: Real>() -> f64 {
    if N::ROUNDOFF < DoubleDouble::ROUNDOFF {
        1e-50
    } else if N::ROUNDOFF < f64::ROUNDOFF {
        1e-26
    } else {
        1e-10
    }
}
