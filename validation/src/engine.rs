//! The core behind its public interface.

use crate::naive::Naive;
use crate::scene::{Engine, EngineError, Scene, Trace};

/// The code under test.
pub struct Core;

impl Engine for Core {
    fn respond(&self, scene: &Scene) -> Result<Trace, EngineError> {
        Naive::default().respond(scene)
    }
}
