//! What a recipe does over all blocks.

use rocking::fragility::options::Recipe;
use rocking::statistics::QuantileType;
use rocking::statistics::lognormal::FitMethod;
use rocking_common::paper::Intensity;

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
