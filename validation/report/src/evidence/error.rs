//! Why there is nothing to show.

use rocking_proof::cases::CaseError;
use rocking_proof::scene::EngineError;

/// Why there is nothing to show.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum EvidenceError {
    /// The cases cannot be read.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// A scene of a figure cannot be run.
    #[error(transparent)]
    Engine(#[from] EngineError),
}
