//! `rocking fragility`: lognormal fragilities, one subcommand a source.

pub mod counts;
mod export;
pub(super) mod fit;
pub mod source;
mod surface;
mod transform;

use clap::{Args as ClapArgs, Subcommand};

use crate::failure::Failure;

/// Lognormal fragilities: fitted, transformed, or of a fitted surface.
///
/// Medians, quantiles and shift are in the unit of the sample.
#[derive(ClapArgs)]
#[command(after_help = "Examples:\n  \
    rocking fragility fit --ida ida.csv --at 0.3,0.5,1 --shift 1\n  \
    rocking fragility fit --sample capacities.txt --shift 1 \
    --bootstrap 1000\n  \
    rocking fragility counts --counts counts.csv\n  \
    rocking fragility transform --shift 1 --im50 2.5 --beta 0.4\n  \
    rocking fragility surface --alpha 0.15 --p 3\n  \
    rocking fragility export --sample capacities.txt --shift 1 \\\n      \
    --alpha 0.15 --p 3 --format nrml --out block.xml")]
pub struct Args {
    #[command(subcommand)]
    source: Source,
}

#[derive(Subcommand)]
enum Source {
    Fit(Box<fit::Args>),
    Counts(counts::Args),
    Transform(transform::Args),
    Surface(surface::Args),
    Export(Box<export::Args>),
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for input that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    match &args.source {
        Source::Fit(args) => fit::run(args),
        Source::Counts(args) => counts::run(args),
        Source::Transform(args) => transform::run(args),
        Source::Surface(args) => surface::run(args),
        Source::Export(args) => export::run(args),
    }
}
