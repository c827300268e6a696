use rocking::integrator::{Assessment, Observe, Outcome, Response};
use rocking::number::Real;
use rocking::number::double::DoubleDouble;

use super::core::{Quotient, respond, respond_in};
use crate::arithmetic::{RoundedConstants, Single, wide};
use crate::scene::{CaseScene, EngineError};

/// What a run in any arithmetic saw, as double-doubles.
#[derive(Clone, Debug, PartialEq)]
pub struct WideTrace {
    /// First uplift, s.
    pub uplift_s: Option<DoubleDouble>,
    /// Impacts: time in s and speed before in rad/s.
    pub impacts: Vec<(DoubleDouble, DoubleDouble)>,
    /// Largest |theta|/alpha reached.
    pub peak_ratio: DoubleDouble,
    /// When it overturned, s.
    pub overturned_s: Option<DoubleDouble>,
    /// When it came to rest, s.
    pub rest_s: Option<DoubleDouble>,
    /// Bound on the error of the peak ratio.
    pub error_estimate: f64,
    /// False where the run leaves its fate open.
    pub resolved: bool,
}

/// Arithmetic of a run. A page has none that is wrong.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Precision {
    /// Every operation rounded to 24 bits.
    #[cfg(not(target_family = "wasm"))]
    Single,
    /// Double precision, the engine that users get.
    Double,
    /// Double-double; the quotients by gravity too.
    DoubleDouble,
    /// Double-double from inputs over gravity rounded to double precision:
    /// the very problem that double precision solves.
    DoubleDoubleOfRounded,
    /// Double-double with coefficients rounded to double precision: a
    /// mistake.
    #[cfg(not(target_family = "wasm"))]
    RoundedConstants,
}

impl WideTrace {
    fn of<N: Real>(
        response: Result<Response<N>, EngineError>,
    ) -> Result<Self, EngineError> {
        let response = response?;
        Ok(Self {
            uplift_s: response.uplift_time_s.map(wide),
            impacts: response
                .impacts
                .iter()
                .map(|i| (wide(i.time_s), wide(i.speed_before_rad_s)))
                .collect(),
            peak_ratio: wide(response.peak_ratio),
            overturned_s: match response.outcome {
                Outcome::Overturned { time_s, .. } => Some(wide(time_s)),
                Outcome::Rocked { .. } | Outcome::NoUplift => None,
            },
            rest_s: response.rest_time_s.map(wide),
            error_estimate: response.error_estimate.unwrap_or(f64::INFINITY),
            resolved: response.assessment() == Assessment::Clear,
        })
    }

    /// Runs a scene, with events and accuracy.
    ///
    /// # Errors
    /// [`EngineError::Refused`] with the core's own words.
    pub fn run(
        scene: &CaseScene,
        arithmetic: Precision,
    ) -> Result<Self, EngineError> {
        let observe = Observe {
            events: true,
            accuracy: true,
            until_s: scene.until_s,
            ..Observe::default()
        };
        let (o, kept) = (&observe, Quotient::Kept);
        let wide = |by| Self::of(respond_in::<DoubleDouble>(scene, o, by));
        match arithmetic {
            #[cfg(not(target_family = "wasm"))]
            Precision::Single => {
                Self::of(respond_in::<Single>(scene, o, kept))
            }
            Precision::Double => Self::of(respond(scene, o)),
            Precision::DoubleDouble => wide(kept),
            Precision::DoubleDoubleOfRounded => wide(Quotient::Rounded),
            #[cfg(not(target_family = "wasm"))]
            Precision::RoundedConstants => {
                Self::of(respond_in::<RoundedConstants>(scene, o, kept))
            }
        }
    }
}
