//! Several families of distributions beside each other.

use std::path::Path;

use rocking::statistics::choice::{
    Candidate, Distribution, Goodness, Model, candidate, goodness,
};
use rocking::statistics::lognormal::FitError;
use serde_json::{Map, Value, json};

use super::{Args, show};
use crate::cli::samples::{SampleFile, Shift};
use crate::cli::{Failure, print_json, with_threads};

pub(super) fn run(
    args: &Args,
    path: &Path,
    replicates: u64,
) -> Result<(), Failure> {
    let shift = match args.shift {
        None => 0.0,
        Some(Shift::Given(shift)) => shift,
        Some(Shift::Min | Shift::Free) => {
            return Err(Failure::input(
                "--shift with --compare: expected a number, as --shift 1; \
                 the shifted lognormal fits its own",
            ));
        }
    };
    let sample = SampleFile::read(path)?.extended()?;
    let n = sample.len();
    if sample.censored() > 0 {
        let censored = sample.censored();
        let error = FitError::Infinite { censored, n };
        return Err(Failure::input(format!("{}: {error}", path.display())));
    }
    let seed = args.seed.unwrap_or(0);
    let rows = with_threads(args.threads, || {
        Model::ALL.map(|model| {
            let found = candidate(&sample, shift, model)?;
            let tested = goodness(&found, n, shift, replicates, seed);
            Ok::<_, FitError>((found, tested))
        })
    })?;
    let best = rows
        .iter()
        .flatten()
        .map(|(found, _)| found.aic)
        .fold(f64::INFINITY, f64::min);
    let models: Map<String, Value> = Model::ALL
        .into_iter()
        .zip(&rows)
        .map(|(model, row)| (model.to_string(), row_of(model, row, best)))
        .collect();
    let mut out = Map::new();
    out.insert("im_unit".to_owned(), "that of the sample".into());
    out.insert("n".to_owned(), n.into());
    out.insert("shift_given".to_owned(), json!(shift));
    out.insert("replicates".to_owned(), replicates.into());
    out.insert("seed".to_owned(), seed.into());
    out.insert("models".to_owned(), Value::Object(models));
    if args.json {
        return print_json(Value::Object(out));
    }
    show(args, out)
}

/// The cells of a model; without values and with the reason where it has no
/// fit.
fn row_of(
    model: Model,
    row: &Result<(Candidate, Goodness), FitError>,
    best: f64,
) -> Value {
    let fitted = row.as_ref().ok();
    let of = |value: fn(&Candidate) -> f64| {
        json!(fitted.map(|(found, _)| value(found)))
    };
    let tested = |value: fn(&Goodness) -> f64| {
        json!(fitted.map(|(_, tested)| value(tested)))
    };
    let (shape, scale, place) =
        fitted.map_or((None, None, None), |(found, _)| {
            let (shape, scale, place) = parameters(&found.distribution);
            (Some(shape), Some(scale), Some(place))
        });
    json!({
        "parameters": model.parameters(),
        "aic": of(|found| found.aic),
        "delta_aic": json!(fitted.map(|(found, _)| found.aic - best)),
        "bic": of(|found| found.bic),
        "log_likelihood": of(|found| found.log_likelihood),
        "ks_distance": of(|found| found.kolmogorov),
        "ks_p": tested(|tested| tested.kolmogorov_p),
        "a2": of(|found| found.anderson_darling),
        "a2_p": tested(|tested| tested.anderson_darling_p),
        "used": fitted.map(|(_, tested)| tested.used),
        "shape": json!(shape),
        "scale": json!(scale),
        "shift_or_place": json!(place),
        "no_fit": row.as_ref().err().map(ToString::to_string),
    })
}

/// Shape (dispersion), scale (median above the shift) and shift (location).
fn parameters(distribution: &Distribution) -> (f64, f64, f64) {
    match distribution {
        Distribution::Lognormal(own) => {
            let above = own.median() - own.shift();
            (own.dispersion(), above, own.shift())
        }
        Distribution::Rival { fit, shift } => (fit.shape, fit.scale, *shift),
        Distribution::ExtremeValue(own) => {
            (own.shape, own.scale, own.location)
        }
        _ => (f64::NAN, f64::NAN, f64::NAN),
    }
}
