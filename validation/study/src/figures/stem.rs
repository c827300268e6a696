//! Names of figures.

use rocking_common::paper::Arm;

/// Name of a figure, with the arm's letter where both arms have one.
pub fn name(number: u32, arm: Option<Arm>) -> String {
    match arm {
        Some(arm) => {
            format!("figure-{number:02}-{}", arm.letter().to_lowercase())
        }
        None => format!("figure-{number:02}"),
    }
}
