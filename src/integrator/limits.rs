//! Input validation and work limits of a run.

use thiserror::Error;

use crate::excitation::Excitation;
use crate::integrator::forcing::pieces_of;
use crate::integrator::{Observe, Scene};

/// Most pieces of a pulse. Beyond 1e15 a double cannot distinguish one piece
/// (0.1/p) from the next.
const MOST_PIECES: f64 = 1e15;

/// Limit of the work of a run, beyond which it is refused with
/// [`SceneError::Work`].
///
/// A block that loses little or no energy at impacts, or that lifts again and
/// again, may hit the base without end.
///
/// ```
/// use rocking::block::{Block, Restitution};
/// use rocking::excitation::Excitation;
/// use rocking::integrator::{
///     Model, Observe, Overturning, Scene, SceneError, WorkLimit, respond,
/// };
/// let scene = Scene {
///     block: Block::try_new(0.2, 2.0)?,
///     restitution: Restitution::constant(0.99)?,
///     model: Model::Nonlinear,
///     overturning: Overturning::Alpha,
///     excitation: Excitation::Free,
///     initial_ratio: 0.5,
/// };
/// // Some 2,000 impacts are logged before rest.
/// let observe = Observe { events: true, ..Observe::default() };
/// assert!(respond(&scene, &observe).is_ok());
/// let work_limit = WorkLimit { impacts: 1000, ..WorkLimit::default() };
/// let found = respond(&scene, &Observe { work_limit, ..observe });
/// assert!(matches!(found, Err(SceneError::Work { limit: 1000, .. })));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WorkLimit {
    /// Impacts.
    pub impacts: u64,
    /// Steps, and points of a history.
    pub steps: u64,
}

impl WorkLimit {
    /// For many analyses at once, some six times as fast: 1e7 impacts and
    /// 2e7 steps, about a second.
    pub const IDA: Self = Self { impacts: 10_000_000, steps: 20_000_000 };
}

impl Default for WorkLimit {
    /// 1e6 impacts and 1e7 steps: about a second.
    fn default() -> Self {
        Self { impacts: 1_000_000, steps: 10_000_000 }
    }
}

/// Why a scene cannot be integrated.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The initial rotation must lie below overturning.
    #[error("initial rotation ratio {0}: expected a number in [0, 1)")]
    InitialRatio(f64),
    /// The amplitude of a record must be finite.
    #[error(
        "record scaled by {0}: expected a finite amplitude of the excitation"
    )]
    Amplitude(f64),
    /// Intervals and horizons must be positive.
    #[error("{what} {found} s: expected a positive number")]
    Time {
        /// Use of the time.
        what: &'static str,
        /// The given time.
        found: f64,
    },
    /// A pulse must not be so long that rounding of the time reaches a step.
    #[error(
        "pulse of {pieces:e} steps of at most 0.1/p and a phase of 1/4: \
         expected at most {most:e}; beyond, double precision cannot tell \
         their times apart"
    )]
    Pieces {
        /// Steps that cover the pulse.
        pieces: f64,
        /// The most that are taken.
        most: f64,
    },
    /// The run passed its [`WorkLimit`].
    #[error(
        "more than {limit} {what} by {time_s} s: expected at most {limit}, \
         the limit of work, which can be raised"
    )]
    Work {
        /// Counted quantity: impacts, steps, or history points, which the
        /// limit of steps bounds.
        what: &'static str,
        /// The limit.
        limit: u64,
        /// Time in the scene at which the limit was passed, s.
        time_s: f64,
    },
    /// Rotation or velocity went beyond the largest number.
    #[error(
        "rotation or velocity is not a number at {time_s:e} s: expected \
         accelerations and times within the range of double precision"
    )]
    NotANumber {
        /// Time in the scene, s.
        time_s: f64,
    },
}

/// Rejects invalid scenes and impossible requests.
pub(crate) fn check(
    scene: &Scene<'_>,
    observe: &Observe,
) -> Result<(), SceneError> {
    if !(scene.initial_ratio >= 0.0 && scene.initial_ratio < 1.0) {
        return Err(SceneError::InitialRatio(scene.initial_ratio));
    }
    for (what, time) in [
        ("history interval", observe.history_interval_s),
        ("end of observation", observe.until_s),
    ] {
        if let Some(found) = time
            && !(found > 0.0 && found.is_finite())
        {
            return Err(SceneError::Time { what, found });
        }
    }
    if let Excitation::Record(record) = scene.excitation
        && !record.amplitude().is_finite()
    {
        return Err(SceneError::Amplitude(record.amplitude()));
    }
    if let Excitation::Pulse(pulse) = scene.excitation {
        let pieces = pieces_of(pulse, scene.block.frequency_rad_s());
        if !(pieces <= MOST_PIECES) {
            return Err(SceneError::Pieces { pieces, most: MOST_PIECES });
        }
    }
    Ok(())
}
