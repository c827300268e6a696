//! A block's overturning fragility without an analysis.

use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_surrogate::Surrogate;

use crate::cli::scene::BlockArgs;
use crate::cli::shared::JsonArg;
use crate::failure::Failure;

/// Overturning fragility of a block under the embedded suites, by a fitted
/// surface and without an analysis, with its errors.
#[derive(clap::Args)]
pub(super) struct FragilitySurfaceCommand {
    #[command(flatten)]
    block: BlockArgs,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking fragility surface`.
///
/// # Errors
/// [`Failure`] for a block that is none, or lies outside the surface.
pub(super) fn run_fragility_surface(
    args: &FragilitySurfaceCommand,
) -> Result<(), Failure> {
    let block = args.block.block(STANDARD_GRAVITY_M_S2)?;
    args.json.show(&Surrogate::embedded()?.fragility(&block)?)
}
