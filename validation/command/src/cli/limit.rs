//! Flags that say how much work a run may take.

use rocking::ida::IdaError;
use rocking::integrator::{SceneError, WorkLimit};

use crate::failure::Failure;

/// Work beyond which a run is refused.
#[derive(clap::Args, Clone, Copy, Debug)]
pub struct LimitArgs {
    /// Largest number of impacts in a run [default: 1e6, `ida` 1e7].
    #[arg(long, value_name = "N")]
    most_impacts: Option<u64>,
    /// Largest number of steps of a run, or of points of a history [default:
    /// 1e7, `ida` 2e7].
    #[arg(long, value_name = "N")]
    most_steps: Option<u64>,
}

impl LimitArgs {
    /// The limit; by default `own`, that of the command.
    pub fn limit(&self, own: WorkLimit) -> WorkLimit {
        WorkLimit {
            impacts: self.most_impacts.unwrap_or(own.impacts),
            steps: self.most_steps.unwrap_or(own.steps),
        }
    }
}

/// Names the flag that raises the limit which a scene passed, if it did.
fn with_flag(failure: Failure, error: &SceneError) -> Failure {
    let flag = match error {
        SceneError::Work { what: "impacts", .. } => "--most-impacts",
        SceneError::Work { .. } => "--most-steps",
        _ => return failure,
    };
    Failure { message: format!("{} by {flag}", failure.message), ..failure }
}

/// Why a scene was refused, and how to raise a limit.
pub fn refused(error: SceneError) -> Failure {
    with_flag(error.into(), &error)
}

/// Why a curve was refused, and how to raise a limit.
pub fn curve_refused(error: IdaError) -> Failure {
    match error {
        IdaError::Work { source, .. } => with_flag(error.into(), &source),
        other => other.into(),
    }
}
