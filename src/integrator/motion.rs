//! State of a block in motion, and the results of a run so far.

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

/// Results of a run so far.
#[derive(Default)]
pub(crate) struct RunTrace<N> {
    pub peak: N,
    pub peak_time_s: Option<N>,
    pub uplift_time_s: Option<N>,
    pub rest_time_s: Option<N>,
    pub impacts: Vec<Impact<N>>,
    pub history: Vec<HistoryPoint<N>>,
    pub forces: Option<Forces>,
    pub work: Work,
    /// Why the run is refused, once its work has passed the limit.
    pub exceeded: Option<SceneError>,
    /// Bounds on the errors of the times of rest and of overturning, s.
    pub rest_error_s: Option<f64>,
    pub overturning_error_s: Option<f64>,
    /// Errors of the arithmetic, and, if it is wider than double precision,
    /// of the inputs.
    pub accuracy: Option<Accuracy>,
    pub inputs: Option<Accuracy>,
}

/// Post-impact speed over alpha p below which a geometric series replaces the
/// remaining impacts when events are observed. The error of that series is of
/// second order in the speed (over the square of the least downward
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
