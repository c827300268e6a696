//! A block's overturning fragility without an analysis.

use rocking::block::Block;
use rocking::integrator::{Model, uplift_threshold};
use serde_json::{Map, Value, json};

use super::{Args, show};
use crate::cli::Failure;
use crate::paper::Intensity;
use crate::surrogate::{RESTITUTION, Surrogate};

/// Flags of fits to a sample, none of which a surrogate has.
fn unused(args: &Args) -> Option<&'static str> {
    [
        ("--shift", args.shift.is_some()),
        ("--method", args.method.is_some()),
        ("--quantile-type", args.quantile_type.is_some()),
        ("--c", args.c.is_some()),
        ("--im", args.im.is_some()),
        ("--bootstrap", args.bootstrap.is_some()),
    ]
    .into_iter()
    .find_map(|(flag, given)| given.then_some(flag))
}

pub(super) fn run(args: &Args, block: &Block) -> Result<(), Failure> {
    if let Some(flag) = unused(args) {
        return Err(Failure::input(format!(
            "{flag} is not used with a block alone: expected --sample, --ida \
             or --counts, too"
        )));
    }
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
    show(args, out)
}
