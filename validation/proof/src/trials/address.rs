//! A scene with its address.

use crate::scene::CaseScene;

/// A scene with its address.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Stratum, index and kind of the excitation.
    pub name: String,
    /// The scene.
    pub scene: CaseScene,
}
