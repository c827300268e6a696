//! What a recipe does over all blocks.

use rocking_common::paper::Intensity;
use rocking_procedures::fragility::options::Recipe;
use rocking_statistics::QuantileType;
use rocking_statistics::lognormal::FitMethod;

/// One recipe over all blocks and thresholds.
pub struct Summary {
    pub recipe: Recipe,
    pub intensity: Intensity,
    pub defined: f64,
    pub ks: f64,
    pub largest: f64,
    pub area: f64,
}

pub const MLE: FitMethod = FitMethod::MaximumLikelihood;

pub fn trimmed() -> FitMethod {
    FitMethod::Trimmed(QuantileType::default())
}
