//! A block's fragility without an analysis.

use rocking_procedures::{ModelError, law_fragility};

use crate::cli::scene::{BlockArgs, Eta};
use crate::cli::shared::{JsonArg, ModelErrorArgs};
use crate::failure::Failure;
use rocking::units::STANDARD_GRAVITY_M_S2;

/// Fragility of a block in AvgSA(0.15 to 1.0 times 2 pi/p) by one law for all
/// blocks and ground motions, without an analysis. It includes the errors of
/// the law and of the model.
#[derive(clap::Args)]
pub(super) struct FragilityLawCommand {
    #[command(flatten)]
    block: BlockArgs,
    /// Coefficient of restitution, or `housner` for 1 - 1.5 sin^2(alpha).
    #[arg(long, value_name = "E|housner", default_value = "0.92")]
    eta: Eta,
    /// Peak |theta|/alpha; inf: overturning.
    #[arg(long, value_name = "E", default_value_t = f64::INFINITY)]
    at: f64,
    #[command(flatten)]
    model_error: ModelErrorArgs,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking fragility law`.
///
/// # Errors
/// [`Failure`] for a block outside the range of the law.
pub(super) fn run_fragility_law(
    args: &FragilityLawCommand,
) -> Result<(), Failure> {
    let block = args.block.block(STANDARD_GRAVITY_M_S2)?;
    let eta = args.eta.restitution(&block)?.velocity_ratio();
    let error = args.model_error.or(ModelError::default());
    let found = law_fragility(&block, eta, args.at, error)?;
    let sentences = [
        "At |theta|/alpha = {edp} AvgSA has a median of {total.median} g, and \
         a dispersion of {total.dispersion}.",
        "At overturning AvgSA has a median of {total.median} g, and a \
         dispersion of {total.dispersion}.",
    ];
    args.json.show(&sentences, &found)
}
