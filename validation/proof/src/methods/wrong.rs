//! How wrong models go wrong.

use crate::cases::WrongModel;
use crate::naive::{
    Events, Hold, Loss, Naive, Pushback, Rest, Rules, Threshold,
};
use crate::scene::{Engine, EngineError, Forcing, Scene, Trace, other};

impl WrongModel {
    /// Rules of the naive integrator, where it carries out the mistake.
    fn rules(self) -> Option<Rules> {
        let right = Rules::default();
        Some(match self {
            Self::MissedImpact => Rules { loss: Loss::FirstMissed, ..right },
            Self::SignOnlyEvents => {
                Rules { events: Events::StepEnds, ..right }
            }
            Self::RotationKeptAtImpact => {
                Rules { events: Events::StepEndsRotationKept, ..right }
            }
            Self::CrudeRest => Rules { rest: Rest::Slower(0.1), ..right },
            Self::SuppressedHop => {
                Rules { pushback: Pushback::Suppressed, ..right }
            }
            Self::ZeroOrderHold => Rules { hold: Hold::Zero, ..right },
            Self::OtherThreshold => {
                Rules { threshold: Threshold::Other, ..right }
            }
            Self::StopsWithTheRecord => Rules { after_end: false, ..right },
            _ => return None,
        })
    }

    /// Whether it runs on the naive integrator.
    #[must_use]
    pub fn is_naive(self) -> bool {
        self.rules().is_some()
    }

    /// Makes the mistake in a scene, where it is one of the input.
    pub fn alter(self, scene: &mut Scene) {
        match self {
            Self::GroundSign => scale(&mut scene.forcing, -1.0),
            Self::EtaSquared => scene.restitution *= scene.restitution,
            Self::OtherEquation => scene.model = other(scene.model),
            Self::POnePercentHigh => scene.frequency_rad_s *= 1.01,
            Self::POnePercentLow => scene.frequency_rad_s *= 0.99,
            Self::AlphaOnePercentLow => scene.slenderness_rad *= 0.99,
            Self::AlphaOnePercentHigh => scene.slenderness_rad *= 1.01,
            Self::OtherGravity => scene.gravity_m_s2 *= 9.80665 / 9.81,
            Self::TangentForAngle => {
                let alpha = scene.slenderness_rad;
                scale(&mut scene.forcing, libm::tan(alpha) / alpha);
            }
            Self::OneSampleLate => {
                if let Forcing::Samples { acceleration_m_s2, .. } =
                    &mut scene.forcing
                {
                    acceleration_m_s2.insert(0, 0.0);
                }
            }
            Self::RecordNormalised => {
                if let Forcing::Samples { acceleration_m_s2, .. } =
                    &mut scene.forcing
                {
                    let a = acceleration_m_s2;
                    let peak = a.iter().fold(0.0, |m: f64, x| m.max(x.abs()));
                    a.iter_mut()
                        .for_each(|x| *x = *x / peak * scene.gravity_m_s2);
                }
            }
            Self::CmReadAsM => scale(&mut scene.forcing, 100.0),
            Self::LastSampleLost => {
                if let Forcing::Samples { acceleration_m_s2, .. } =
                    &mut scene.forcing
                {
                    acceleration_m_s2.pop();
                }
            }
            _ => {}
        }
    }

    /// The engine that makes the mistake, where the method itself does not.
    #[must_use]
    pub fn engine<'a>(self, right: &'a dyn Engine) -> Box<dyn Engine + 'a> {
        match self.rules() {
            Some(rules) => Box::new(Naive(rules)),
            None => Box::new(Changed { right, model: self }),
        }
    }
}

struct Changed<'a> {
    right: &'a dyn Engine,
    model: WrongModel,
}

impl Engine for Changed<'_> {
    fn respond(&self, scene: &Scene) -> Result<Trace, EngineError> {
        let mut scene = scene.clone();
        self.model.alter(&mut scene);
        self.right.respond(&scene)
    }
}

/// Multiplies the ground motion; a release changes sides alone.
pub(super) fn scale(forcing: &mut Forcing, factor: f64) {
    let factor = match forcing {
        Forcing::Free { .. } => factor.signum(),
        _ => factor,
    };
    forcing.amplitudes_mut().iter_mut().for_each(|a| *a *= factor);
}
