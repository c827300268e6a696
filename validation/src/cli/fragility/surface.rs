//! A block's overturning fragility without an analysis.

use rocking::integrator::{Model, uplift_threshold};
use rocking::units::STANDARD_GRAVITY_M_S2;
use serde_json::{Map, Value, json};

use crate::cli::Failure;
use crate::cli::scene::BlockArgs;
use crate::cli::show::show;
use crate::paper::Intensity;
use crate::surrogate::{RESTITUTION, Surrogate};

/// Overturning fragility of a block under the embedded suites, by a fitted
/// surface and without an analysis, with its errors.
#[derive(clap::Args)]
pub(super) struct Args {
    #[command(flatten)]
    block: BlockArgs,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a block that is none, or lies outside the surface.
pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let block = &args.block.block(STANDARD_GRAVITY_M_S2)?;
    let (alpha, p) = (block.slenderness_rad(), block.frequency_rad_s());
    let onset_g = uplift_threshold(block, Model::Nonlinear);
    let mut suites = Map::new();
    for (model, errors) in Surrogate::embedded()?.models {
        let found = model.at(alpha, p)?;
        let own = json!({
            "median": found.median(),
            "beta": found.dispersion(),
            "median_pga_g": found.median() * onset_g,
            "median_rms": errors.median.rms,
            "median_max": errors.median.largest,
            "beta_rms": errors.dispersion.rms,
            "beta_max": errors.dispersion.largest,
            "prob_rms": errors.probability.rms,
            "prob_max": errors.probability.largest,
            "unseen_blocks": errors.blocks,
        });
        suites.insert(model.suite.name().to_owned(), own);
    }
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| {
        out.insert(key.to_owned(), value);
    };
    put("of", "overturning, embedded suites, no analysis".into());
    put("im_unit", Intensity::Pga.words().into());
    put("alpha_rad", json!(alpha));
    put("p_rad_s", json!(p));
    put("eta", json!(RESTITUTION));
    put("shift", json!(crate::surrogate::SHIFT));
    put(
        "errors",
        "rms and largest at unseen blocks: of median and beta relative, \
         then in probability"
            .into(),
    );
    put("suites", Value::Object(suites));
    show(args.json, &Value::Object(out))
}
