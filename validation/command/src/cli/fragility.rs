//! `rocking fragility`: lognormal fragilities, one subcommand a source.

pub mod counts;
mod export;
pub(super) mod fit;
mod law;
pub mod source;
mod transform;

use clap::Subcommand;

use crate::failure::Failure;

/// Lognormal fragilities: fitted, transformed, or by the law of AvgSA.
///
/// Medians, quantiles and shift are in the unit of the sample.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking fragility fit --ida ida.csv --at 0.3,0.5,1 --shift 1\n  \
    rocking fragility fit --sample capacities.txt --shift 1 \
    --bootstrap 1000\n  \
    rocking fragility counts --counts counts.csv\n  \
    rocking fragility transform --shift 1 --im50 2.5 --beta 0.4\n  \
    rocking fragility law --alpha 0.15 --p 3\n  \
    rocking fragility export --sample capacities.txt --shift 1 \\\n      \
    --alpha 0.15 --p 3 --format nrml --out block.xml")]
pub struct FragilityCommand {
    #[command(subcommand)]
    action: FragilityAction,
}

#[derive(Subcommand)]
enum FragilityAction {
    Fit(Box<fit::FragilityFitCommand>),
    Counts(counts::FragilityCountsCommand),
    Transform(transform::FragilityTransformCommand),
    Law(law::FragilityLawCommand),
    Export(Box<export::FragilityExportCommand>),
}

/// Runs `rocking fragility`.
///
/// # Errors
/// [`Failure`] for input that is refused.
pub fn run_fragility(args: &FragilityCommand) -> Result<(), Failure> {
    match &args.action {
        FragilityAction::Fit(args) => fit::run_fragility_fit(args),
        FragilityAction::Counts(args) => counts::run_fragility_counts(args),
        FragilityAction::Transform(args) => {
            transform::run_fragility_transform(args)
        }
        FragilityAction::Law(args) => law::run_fragility_law(args),
        FragilityAction::Export(args) => export::run_fragility_export(args),
    }
}
