//! Questions and their answers.

use serde::{Deserialize, Serialize};
use serde_json::Value;

use crate::block;
use crate::case;

/// A request of a page.
#[derive(Debug, Deserialize)]
#[serde(tag = "ask", rename_all = "kebab-case", deny_unknown_fields)]
enum LabQuestion {
    /// The list of reference cases.
    Cases,
    /// Run one reference case.
    Case {
        /// Its id.
        id: String,
    },
    /// The embedded motions.
    Motions,
    /// Read a record file.
    Read(block::LabFile),
    /// The response of a block to a ground motion.
    Response(block::LabScene),
    /// The IDA of the block under that motion.
    Ida(block::LabScene),
    /// Outcomes around the chosen point.
    Fates {
        /// The point in the middle.
        scene: block::LabScene,
        /// Intensities, PGA/(g tan alpha).
        intensities: Vec<f64>,
        /// Frequency parameters, rad/s.
        p_rad_s: Vec<f64>,
    },
    /// Probability of overturning by the law of AvgSA.
    Fragility(block::LabScene),
}

/// Answers a question; an error is an object with the one field `error`.
pub fn answer(question: &str) -> String {
    let found = serde_json::from_str(question)
        .map_err(|error| error.to_string())
        .and_then(found);
    let found =
        found.unwrap_or_else(|error| serde_json::json!({ "error": error }));
    found.to_string()
}

fn found(question: LabQuestion) -> Result<Value, String> {
    match question {
        LabQuestion::Cases => value(case::list()),
        LabQuestion::Case { id } => value(case::run(&id)),
        LabQuestion::Motions => value(block::motions()),
        LabQuestion::Read(file) => value(block::read(&file)),
        LabQuestion::Response(scene) => value(scene.response()),
        LabQuestion::Ida(scene) => value(scene.ida()),
        LabQuestion::Fates { scene, intensities, p_rad_s } => {
            value(scene.fates(&intensities, &p_rad_s))
        }
        LabQuestion::Fragility(scene) => value(scene.fragility()),
    }
}

fn value<T: Serialize>(
    found: Result<T, Box<dyn std::error::Error>>,
) -> Result<Value, String> {
    let found = found.map_err(|error| error.to_string())?;
    serde_json::to_value(found).map_err(|error| error.to_string())
}
