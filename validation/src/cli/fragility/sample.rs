//! The fits of a sample file.

use std::path::Path;

use rocking::fragility::{FragilityError, c_max, eq5, eq6, eq7};
use rocking::statistics::bootstrap::{Bootstrap, accelerated, estimate};
use rocking::statistics::lognormal::{FitError, FitMethod, LognormalFit, fit};
use rocking::statistics::{ExtendedSample, Lognormal, QuantileType};
use serde_json::{Map, Value, json};

use super::{Args, Method, insert, show};
use crate::cli::samples::{SampleFile, Shift};
use crate::cli::{Failure, with_threads};
use crate::json;

/// The fit asked for, and what the unshifted statistics give instead.
pub(super) struct Fits {
    pub(super) fit: LognormalFit,
    /// By the same method, without a shift.
    pub(super) unshifted: Option<Lognormal>,
    eq5: Result<f64, FragilityError>,
    eq6: Result<f64, FragilityError>,
    eq7: Result<f64, FragilityError>,
}

/// How a sample is fitted.
#[derive(Clone, Copy)]
pub(super) struct Plan {
    method: FitMethod,
    pub(super) quantile_type: QuantileType,
    shift: Shift,
    c: f64,
}

impl Plan {
    pub(super) fn new(args: &Args) -> Result<Self, Failure> {
        let quantile_type =
            QuantileType::try_new(args.quantile_type.unwrap_or(5))?;
        let method = match args.method.unwrap_or(Method::Mle) {
            Method::Mle => FitMethod::MaximumLikelihood,
            Method::Moment => FitMethod::Moment,
            Method::Trimmed => FitMethod::Trimmed(quantile_type),
            Method::Quantile => FitMethod::Quantile(quantile_type),
            Method::Censored => FitMethod::Censored(quantile_type),
        };
        let shift = args.shift.unwrap_or(Shift::Given(0.0));
        Ok(Self { method, quantile_type, shift, c: args.c.unwrap_or(1.0) })
    }

    pub(super) fn fits(&self, values: &[f64]) -> Result<Fits, FitError> {
        let (shift, above) = self.shift.split(values);
        let whole = sample(values)?;
        let fit = fit(&sample(&above)?, shift, self.method)?;
        let unshifted = fit_unshifted(&whole, self.method);
        let at = |p| {
            let value = self.quantile_type.of_extended(&whole, p);
            value.unwrap_or(f64::NAN)
        };
        let (median, dispersion) = unshifted
            .map_or((f64::NAN, f64::NAN), |u| (u.median(), u.dispersion()));
        Ok(Fits {
            fit,
            unshifted,
            eq5: eq5(median, shift),
            eq6: eq6(at(0.16), at(0.84), shift),
            eq7: eq7(median, dispersion, shift, self.c),
        })
    }
}

fn fit_unshifted(
    sample: &ExtendedSample,
    method: FitMethod,
) -> Option<Lognormal> {
    fit(sample, 0.0, method).ok().map(|fit| fit.distribution)
}

fn sample(values: &[f64]) -> Result<ExtendedSample, FitError> {
    ExtendedSample::try_new(values).map_err(|_| FitError::TooFew(0))
}

pub(super) fn run(args: &Args, path: &Path) -> Result<(), Failure> {
    let plan = Plan::new(args)?;
    if args.bootstrap.is_some() && plan.shift == Shift::Min {
        return Err(Failure::input(
            "--bootstrap with --shift min: a bootstrap of the smallest value \
             gives no interval, its 95 % hold the dispersion in one sample \
             of five; expected a shift that is known, as --shift 1",
        ));
    }
    let file = SampleFile::read(path)?;
    let whole = file.extended()?;
    let values = file.values();
    let in_file =
        |e: FitError| Failure::input(format!("{}: {e}", path.display()));
    let fits = plan.fits(values).map_err(in_file)?;
    let fitted = fits.fit.distribution;
    let left_out = values.len() - plan.shift.split(values).1.len();
    let at = |p| plan.quantile_type.of_extended(&whole, p);
    let (im16, im50, im84) = (at(0.16)?, at(0.5)?, at(0.84)?);
    let number = json::number;
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| {
        out.insert(key.to_owned(), value);
    };
    put("im_unit", "that of the sample".into());
    put("n", whole.len().into());
    put("n_kept", fits.fit.n_kept.into());
    put("n_infinite", whole.censored().into());
    put("left_out_at_shift", left_out.into());
    put("method", plan.method.to_string().into());
    put("shift", number(fitted.shift()));
    put("mu", number(fitted.log_mean()));
    put("beta", number(fitted.dispersion()));
    put("median", number(fitted.median()));
    put("log_likelihood", json::optional(fits.fit.log_likelihood));
    put("ks_distance", number(fitted.kolmogorov_distance(&whole)));
    put("area_distance", json::optional(fitted.area_distance(&whole)));
    put("quantile_type", plan.quantile_type.number().into());
    put("im16", number(im16));
    put("im50", number(im50));
    put("im84", number(im84));
    let unshifted = fits.unshifted;
    put("unshifted_mu", json::optional(unshifted.map(|u| u.log_mean())));
    put("unshifted_beta", json::optional(unshifted.map(|u| u.dispersion())));
    let limit = unshifted
        .and_then(|u| c_max(u.median(), u.dispersion(), fitted.shift()).ok());
    put("c", number(plan.c));
    put("c_max", json::optional(limit));
    insert(&mut out, "eq5", fits.eq5);
    insert(&mut out, "eq5_sample_median", eq5(im50, fitted.shift()));
    insert(&mut out, "eq6", fits.eq6);
    insert(&mut out, "eq7", fits.eq7);
    if let Some(replicates) = args.bootstrap {
        if !(2..=1_000_000).contains(&replicates) {
            return Err(Failure::input(format!(
                "--bootstrap {replicates}: expected 2 to 1000000 samples"
            )));
        }
        let seed = args.seed.unwrap_or(0);
        let intervals = with_threads(args.threads, || {
            bootstrap(&plan, values, &fits, replicates, seed)
        })?;
        out.insert("bootstrap".to_owned(), intervals);
    }
    show(args, out)
}

/// Percentile and BCa intervals (95 %) of the fit's numbers; the shift `min`
/// is taken anew from every sample.
fn bootstrap(
    plan: &Plan,
    values: &[f64],
    fits: &Fits,
    replicates: usize,
    seed: u64,
) -> Value {
    let draws = Bootstrap::new("fragility", seed, values.len(), replicates);
    let numbers = |fits: &Fits| {
        let fitted = fits.fit.distribution;
        let or_nan = |x: &Result<f64, _>| *x.as_ref().unwrap_or(&f64::NAN);
        [
            fitted.log_mean(),
            fitted.dispersion(),
            fitted.median(),
            or_nan(&fits.eq5),
            or_nan(&fits.eq6),
            or_nan(&fits.eq7),
        ]
    };
    let made = |drawn: &[f64]| {
        plan.fits(drawn).map_or([f64::NAN; 6], |fits| numbers(&fits))
    };
    let rows = draws.map(|draw| {
        let drawn: Vec<f64> = draw.iter().map(|&i| values[i]).collect();
        made(&drawn)
    });
    let without: Vec<[f64; 6]> = (0..values.len())
        .map(|k| made(&[&values[..k], &values[k + 1..]].concat()))
        .collect();
    let points = numbers(fits);
    let mut out = Map::new();
    out.insert("replicates".to_owned(), replicates.into());
    out.insert("seed".to_owned(), seed.into());
    out.insert("level".to_owned(), json!(0.95));
    let keys = ["mu", "beta", "median", "eq5", "eq6", "eq7"];
    for (i, key) in keys.into_iter().enumerate() {
        let column: Vec<f64> = rows.iter().map(|row| row[i]).collect();
        let left_out: Vec<f64> = without.iter().map(|row| row[i]).collect();
        let bca = accelerated(points[i], &column, &left_out, 0.95);
        let value = estimate(points[i], &column, 0.95).map(|e| {
            json!({
                "bca_low": json::optional(bca.as_ref().map(|e| e.low)),
                "bca_high": json::optional(bca.as_ref().map(|e| e.high)),
                "standard_error": json::number(e.standard_error),
                "low": json::number(e.low),
                "high": json::number(e.high),
                "used": e.used,
            })
        });
        out.insert(key.to_owned(), json!(value));
    }
    Value::Object(out)
}
