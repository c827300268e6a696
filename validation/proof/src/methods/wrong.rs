//! How wrong models go wrong.

use crate::cases::WrongModel;
use crate::naive::{Events, Naive, Rules};
use crate::scene::{CaseScene, Engine, EngineError, Trace, other};

impl WrongModel {
    /// Rules of the naive integrator, where it carries out the mistake.
    fn rules(self) -> Option<Rules> {
        let right = Rules::default();
        match self {
            Self::SignOnlyEvents => {
                Some(Rules { events: Events::StepEnds, ..right })
            }
            Self::RotationKeptAtImpact => {
                Some(Rules { events: Events::StepEndsRotationKept, ..right })
            }
            Self::MissedImpact
            | Self::CrudeRest
            | Self::SuppressedHop
            | Self::ZeroOrderHold
            | Self::OtherThreshold
            | Self::StopsWithTheRecord => {
                Some(Rules { wrong: Some(self), ..right })
            }
            _ => None,
        }
    }

    /// Whether it runs on the naive integrator.
    pub fn is_naive(self) -> bool {
        self.rules().is_some()
    }

    /// Makes the mistake in a scene, where it is one of the input.
    pub fn alter(self, scene: &mut CaseScene) {
        match self {
            Self::GroundSign => scene.forcing.scale(-1.0),
            Self::EtaSquared => scene.restitution *= scene.restitution,
            Self::OtherEquation => scene.model = other(scene.model),
            Self::POnePercentHigh => scene.frequency_rad_s *= 1.01,
            Self::POnePercentLow => scene.frequency_rad_s *= 0.99,
            Self::AlphaOnePercentLow => scene.slenderness_rad *= 0.99,
            Self::AlphaOnePercentHigh => scene.slenderness_rad *= 1.01,
            Self::OtherGravity => scene.gravity_m_s2 *= 9.80665 / 9.81,
            Self::TangentForAngle => {
                let alpha = scene.slenderness_rad;
                scene.forcing.scale(libm::tan(alpha) / alpha);
            }
            Self::OneSampleLate => {
                let samples = scene.forcing.samples_mut();
                samples.into_iter().for_each(|a| a.insert(0, 0.0));
            }
            Self::RecordNormalised => {
                let (peak, g) = (scene.forcing.peak(), scene.gravity_m_s2);
                let samples = scene.forcing.samples_mut();
                samples.into_iter().flatten().for_each(|a| *a = *a / peak * g);
            }
            Self::CmReadAsM => scene.forcing.scale(100.0),
            Self::LastSampleLost => {
                scene.forcing.samples_mut().and_then(Vec::pop);
            }
            _ => {}
        }
    }

    /// The engine that makes the mistake, where the method itself does not.
    pub fn engine<'a>(self, right: &'a dyn Engine) -> Box<dyn Engine + 'a> {
        match self.rules() {
            Some(rules) => Box::new(Naive(rules)),
            None => Box::new(InputMistake { right, model: self }),
        }
    }
}

struct InputMistake<'a> {
    right: &'a dyn Engine,
    model: WrongModel,
}

impl Engine for InputMistake<'_> {
    fn respond(&self, scene: &CaseScene) -> Result<Trace, EngineError> {
        let mut scene = scene.clone();
        self.model.alter(&mut scene);
        self.right.respond(&scene)
    }
}
