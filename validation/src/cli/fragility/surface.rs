//! A block's overturning fragility without an analysis.

use rocking::integrator::{Model, uplift_threshold};
use rocking::units::STANDARD_GRAVITY_M_S2;
use serde_json::{Map, Value, json};

use crate::cli::Failure;
use crate::cli::scene::BlockArgs;
use crate::cli::show::show;
use rocking_common::paper::Intensity;
use rocking_surrogate::{RESTITUTION, Recorded, Surrogate};

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
    let surrogate = Surrogate::embedded()?;
    let kept = Recorded::kept()?;
    let mut tables = [(); 4].map(|()| Map::new());
    for (model, errors) in &surrogate.models {
        let found = model.at(alpha, p)?;
        let records = surrogate.sampling(model.suite)?;
        let recorded = model.to_recorded(&kept)?;
        let own = [
            json!({
                "median": found.median(),
                "beta": found.dispersion(),
                "median_pga_g": found.median() * onset_g,
            }),
            json!({
                "median_rms": errors.median.rms,
                "median_max": errors.median.largest,
                "beta_rms": errors.dispersion.rms,
                "beta_max": errors.dispersion.largest,
                "prob_rms": errors.probability.rms,
                "prob_max": errors.probability.largest,
                "blocks": errors.blocks,
            }),
            json!({
                "median_half": records.median,
                "beta_half": records.dispersion,
                "prob_half": records.probability,
            }),
            json!({
                "median_rms": recorded.median.rms,
                "median_max": recorded.median.largest,
                "prob_rms": recorded.probability.rms,
                "prob_max": recorded.probability.largest,
                "blocks": recorded.blocks,
            }),
        ];
        for (table, own) in tables.iter_mut().zip(own) {
            table.insert(model.suite.name().to_owned(), own);
        }
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
    put("shift", json!(rocking_surrogate::SHIFT));
    put(
        "errors",
        "median and beta relative, prob in probability; none holds another"
            .into(),
    );
    put(
        "of_surface",
        "to analyses, embedded suites, at blocks not fitted to".into(),
    );
    put(
        "of_records",
        "half of 95 %, by the choice of an embedded suite's records".into(),
    );
    put(
        "to_recorded",
        "to recorded suites at the study's blocks, their sampling in it"
            .into(),
    );
    let names = ["suites", "surface", "records", "recorded"];
    for (name, table) in names.into_iter().zip(tables) {
        put(name, Value::Object(table));
    }
    show(args.json, &Value::Object(out))
}
