//! The mistakes of the wrong models that engines make.

use crate::cases::WrongModel;
use crate::engine::Core;
use crate::naive::{Events, Naive, Rules};
use crate::scene::{CaseScene, Engine, EngineResult, Trace, other};

impl WrongModel {
    /// Rules of the naive integrator, if it makes the mistake.
    fn rules(self) -> Option<Rules> {
        let right = Events::Located;
        let (events, wrong) = match self {
            Self::SignOnlyEvents => (Events::StepEnds, None),
            Self::RotationKeptAtImpact => (Events::StepEndsRotationKept, None),
            Self::MissedImpact
            | Self::CrudeRest
            | Self::SuppressedHop
            | Self::ZeroOrderHold
            | Self::OtherThreshold
            | Self::StopsWithTheRecord => (right, Some(self)),
            _ => return None,
        };
        Some(Rules { events, wrong, ..Rules::default() })
    }

    /// True if it runs on the naive integrator.
    pub fn is_naive(self) -> bool {
        self.rules().is_some()
    }

    /// The scene with the mistake, if it is one of the input.
    pub fn altered(self, scene: &CaseScene) -> CaseScene {
        let mut scene = scene.clone();
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
        scene
    }
}

/// The engine that makes the mistake, unless the method itself does.
impl Engine for WrongModel {
    fn respond(&self, scene: &CaseScene) -> EngineResult<Trace> {
        match self.rules() {
            Some(rules) => Naive(rules).respond(scene),
            None => Core.respond(&self.altered(scene)),
        }
    }
}
