//! Fates told in the precision that they need.

use crate::integrator::{
    Observe, Outcome, Response, Scene, SceneError, respond, respond_precise,
};
use crate::number::Real;

/// Arithmetic of a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Engine {
    /// Double precision.
    Double,
    /// Double-double, about 30 digits.
    DoubleDouble,
}

/// A fate and the evidence for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certified {
    /// What became of the block, by the engine named in `by`.
    pub outcome: Outcome,
    /// Distance from the other fate, in units of the slenderness angle.
    pub margin: f64,
    /// Bound on the error of that distance.
    pub error: f64,
    /// False where the error reaches the margin in double-double too.
    pub decided: bool,
    /// Which engine decided, or tried last.
    pub by: Engine,
    /// What double precision says.
    pub double: Outcome,
}

impl Certified {
    fn of<N: Real>(response: &Response<N>, by: Engine) -> Self {
        let outcome = match response.outcome {
            Outcome::NoUplift => Outcome::NoUplift,
            Outcome::Rocked { peak_ratio } => {
                Outcome::Rocked { peak_ratio: peak_ratio.to_f64() }
            }
            Outcome::Overturned { time_s, side } => {
                Outcome::Overturned { time_s: time_s.to_f64(), side }
            }
        };
        let margin = response.fate_margin;
        let error = response.fate_error.unwrap_or(f64::INFINITY);
        Self {
            outcome,
            margin,
            error,
            decided: margin > error,
            by,
            double: outcome,
        }
    }

    /// True where the engines disagree about the fate.
    #[must_use]
    pub fn moved(&self) -> bool {
        self.outcome.is_overturned() != self.double.is_overturned()
    }
}

/// Tells a fate: in double precision where its margin clears its error, in
/// double-double where it does not, undecided where that does not either.
///
/// # Errors
/// As [`respond`].
///
/// ```
/// use rocking::block::{Block, Restitution};
/// use rocking::excitation::{Excitation, Pulse, PulseKind};
/// use rocking::integrator::{
///     Engine, Model, Overturning, Scene, certify,
/// };
/// // One unit in the last place above the critical amplitude.
/// let kind = PulseKind::HalfSine {
///     amplitude_g: 4.072395807424461,
///     omega_rad_s: 5.0,
/// };
/// let pulse = Pulse::try_new_si(kind, 9.81)?;
/// let fate = certify(&Scene {
///     block: Block::try_new(0.2, 2.0)?,
///     restitution: Restitution::constant(0.92)?,
///     model: Model::Nonlinear,
///     overturning: Overturning::HalfPi,
///     excitation: Excitation::Pulse(&pulse),
///     initial_ratio: 0.0,
/// })?;
/// assert_eq!(fate.by, Engine::DoubleDouble);
/// assert!(fate.decided && fate.outcome.is_overturned());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify(scene: &Scene<'_>) -> Result<Certified, SceneError> {
    let observe = Observe { accuracy: true, ..Observe::default() };
    let quick = Certified::of(&respond(scene, &observe)?, Engine::Double);
    if quick.decided {
        return Ok(quick);
    }
    let careful = respond_precise(scene, &observe)?;
    let careful = Certified::of(&careful, Engine::DoubleDouble);
    Ok(Certified { double: quick.outcome, ..careful })
}
