//! Questions and their answers.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::block;
use crate::case;

/// What a page can ask.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case", deny_unknown_fields)]
enum Question {
    /// Which declared cases there are.
    Cases,
    /// Run one declared case.
    Case {
        /// Its id.
        id: String,
    },
    /// The embedded motions.
    Motions,
    /// Read a record file.
    Read(block::File),
    /// What a block does under a ground motion.
    Response(block::Scene),
    /// The IDA of the block under that motion.
    Ida(block::Scene),
    /// Fates around the chosen point.
    Fates {
        /// The point in the middle.
        scene: block::Scene,
        /// Intensities, PGA/(g tan alpha).
        intensities: Vec<f64>,
        /// Frequency parameters, rad/s.
        p_rad_s: Vec<f64>,
    },
    /// Probability of overturning by the surrogate.
    Fragility {
        /// The block.
        block: block::Shape,
        /// PGA/(g tan alpha).
        intensity: f64,
    },
}

/// Answers a question; an error is an object with the one field `error`.
#[must_use]
pub fn answer(question: &str) -> String {
    let found = serde_json::from_str(question)
        .map_err(|error| error.to_string())
        .and_then(found);
    let found =
        found.unwrap_or_else(|error| serde_json::json!({ "error": error }));
    found.to_string()
}

/// The same for the bytes of a page.
pub fn answered(question: &[u8]) -> Vec<u8> {
    answer(&String::from_utf8_lossy(question)).into_bytes()
}

fn found(question: Question) -> Result<Value, String> {
    match question {
        Question::Cases => value(case::list()),
        Question::Case { id } => value(case::run(&id)),
        Question::Motions => value(block::motions()),
        Question::Read(file) => value(block::read(&file)),
        Question::Response(scene) => value(scene.response()),
        Question::Ida(scene) => value(scene.ida()),
        Question::Fates { scene, intensities, p_rad_s } => {
            value(scene.fates(&intensities, &p_rad_s))
        }
        Question::Fragility { block, intensity } => {
            value(block::fragility(&block, intensity))
        }
    }
}

fn value<T: Serialize>(
    found: Result<T, Box<dyn std::error::Error>>,
) -> Result<Value, String> {
    let found = found.map_err(|error| error.to_string())?;
    serde_json::to_value(found).map_err(|error| error.to_string())
}
