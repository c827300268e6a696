//! The fits of a sample file.

use std::path::Path;

use rocking::fragility::{FragilityError, c_max, eq5, eq6, eq7};
use rocking::statistics::bootstrap::{Bootstrap, accelerated, estimate};
use rocking::statistics::lognormal::{
    FitError, FitMethod, LognormalFit, fit, profile_shift,
};
use rocking::statistics::{ExtendedSample, Lognormal, QuantileType};
use serde_json::{Map, Value, json};

use super::band::Band;
use super::limits::Limited;
use super::{Args, insert, rows, show};
use crate::cli::samples::{SampleFile, Shift};
use crate::cli::{Failure, print, print_json, with_threads};
use crate::files::{Output, Outputs};
use crate::paper::Intensity;

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
        let named = args.method.unwrap_or(FitMethod::MaximumLikelihood);
        let method = named.with_quantile_type(quantile_type);
        let shift = args.shift.unwrap_or(Shift::Given(0.0));
        if shift == Shift::Free && method != FitMethod::MaximumLikelihood {
            return Err(Failure::input(format!(
                "--shift free with --method {method}: the shift maximises a \
                 likelihood; expected --method mle"
            )));
        }
        Ok(Self { method, quantile_type, shift, c: args.c.unwrap_or(1.0) })
    }

    pub(super) fn method(&self) -> FitMethod {
        self.method
    }

    pub(super) fn fits(&self, values: &Limited) -> Result<Fits, FitError> {
        let (shift, above) = self.shift.split(&values.values)?;
        let fit = if above.len() < values.values.len() {
            fit(&sample(&above)?, shift, self.method)?
        } else {
            values.fit(shift, self.method)?
        };
        let unshifted = values.fit(0.0, self.method).ok();
        let unshifted = unshifted.map(|fit| fit.distribution);
        let at =
            |p| values.quantile(self.quantile_type, p).unwrap_or(f64::NAN);
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

fn sample(values: &[f64]) -> Result<ExtendedSample, FitError> {
    ExtendedSample::try_new(values).map_err(|_| FitError::TooFew(0))
}

/// The unit of a sample's values in words.
fn unit(
    file: &SampleFile,
    given: Option<Intensity>,
) -> Result<String, Failure> {
    let of = file.of().and_then(|of| of.split(" at EDP ").next());
    Ok(match (file.measure(given)?, of) {
        (Some(measure), _) => measure.words().to_owned(),
        (None, Some(of)) => of.to_owned(),
        (None, None) => "that of the sample".to_owned(),
    })
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
    if args.bootstrap.is_some() && plan.shift == Shift::Free {
        return Err(Failure::input(
            "--bootstrap with --shift free: expected no --bootstrap, the \
             likelihood gives the interval of the shift",
        ));
    }
    let file = SampleFile::read(path)?;
    let whole = file.extended()?;
    let values = file.values();
    let limited = Limited::new(values, file.limits());
    let in_file =
        |e: FitError| Failure::input(format!("{}: {e}", path.display()));
    if plan.shift == Shift::Min && limited.count() > 0 {
        return Err(Failure::input(format!(
            "{}: {} values censored at limits of their own with --shift min: \
             expected a shift that is known, as --shift 1",
            path.display(),
            limited.count()
        )));
    }
    let fits = plan.fits(&limited).map_err(in_file)?;
    let fitted = fits.fit.distribution;
    let above = plan.shift.split(values).map_err(in_file)?.1;
    let left_out = values.len() - above.len();
    let at = |p| limited.quantile(plan.quantile_type, p);
    let (im16, im50, im84) = (at(0.16), at(0.5), at(0.84));
    let number = |x: f64| json!(x);
    let mut out = Map::new();
    let mut put = |key: &str, value: Value| {
        out.insert(key.to_owned(), value);
    };
    if let Some(of) = file.of() {
        put("sample_of", of.into());
    }
    put("im_unit", unit(&file, args.im)?.into());
    put("n", whole.len().into());
    put("n_kept", fits.fit.n_kept.into());
    put("n_infinite", whole.censored().into());
    put("n_with_own_limit", limited.count().into());
    if let FitMethod::Censored(_) = plan.method {
        let at = match (limited.count(), whole.censored()) {
            (0, 0) => "at the largest value kept",
            (0, _) => {
                "at the largest value kept, the infinite ones too: the file \
                 tells no limits of theirs"
            }
            (own, all) if own == all => "each at its own limit",
            _ => {
                "each at its own limit, at the largest value kept where the \
                 file tells none"
            }
        };
        put("censored", at.into());
    }
    put("left_out_at_shift", left_out.into());
    put("method", plan.method.to_string().into());
    put("shift", number(fitted.shift()));
    if plan.shift == Shift::Free {
        let profile = profile_shift(&whole).map_err(in_file)?;
        // Down to no shift at all where the likelihood falls too little.
        put("shift_low", number(profile.low.unwrap_or(0.0)));
        put("shift_high", json!(profile.high));
        put("shift_interval_level", json!(0.95));
    }
    put("mu", number(fitted.log_mean()));
    put("beta", number(fitted.dispersion()));
    put("median", number(fitted.median()));
    put("log_likelihood", json!(fits.fit.log_likelihood));
    // The empirical distribution is that of values with one limit.
    let distance =
        (limited.count() == 0).then(|| fitted.kolmogorov_distance(&whole));
    put("ks_distance", json!(distance));
    put("area_distance", json!(fitted.area_distance(&whole)));
    put("quantile_type", plan.quantile_type.number().into());
    put("im16", json!(im16));
    put("im50", json!(im50));
    put("im84", json!(im84));
    let unshifted = fits.unshifted;
    put("unshifted_mu", json!(unshifted.map(|u| u.log_mean())));
    put("unshifted_beta", json!(unshifted.map(|u| u.dispersion())));
    let limit = unshifted
        .and_then(|u| c_max(u.median(), u.dispersion(), fitted.shift()).ok());
    put("c", number(plan.c));
    put("c_max", json!(limit));
    let sample_median = im50.unwrap_or(f64::NAN);
    insert(&mut out, "eq5", fits.eq5);
    insert(&mut out, "eq5_sample_median", eq5(sample_median, fitted.shift()));
    insert(&mut out, "eq6", fits.eq6);
    insert(&mut out, "eq7", fits.eq7);
    if let Some(replicates) = args.bootstrap {
        if !(2..=1_000_000).contains(&replicates) {
            return Err(Failure::input(format!(
                "--bootstrap {replicates}: expected 2 to 1000000 samples"
            )));
        }
        let mut outputs = Outputs::of(vec![path.to_owned()]);
        let table = outputs.open_some(args.band.band_csv.as_ref())?;
        let seed = args.seed.unwrap_or(0);
        let intervals = with_threads(args.threads, || {
            bootstrap(&plan, &limited, &fits, replicates, seed)
        })?;
        out.insert("bootstrap".to_owned(), intervals);
        if let Some(levels) = &args.band.band {
            let band = with_threads(args.threads, || {
                let drawn = (levels, replicates, seed);
                Band::new(&plan, &limited, &fitted, drawn)
            })?;
            return banded(args, table, out, &band);
        }
    }
    show(args, out)
}

/// Shows the fit with its band, and writes the band's table.
fn banded(
    args: &Args,
    table: Option<Output>,
    mut out: Map<String, Value>,
    band: &Band,
) -> Result<(), Failure> {
    if let Some(table) = table {
        let is_standard = table.is_standard();
        table.write(band.csv())?;
        if is_standard {
            return Ok(());
        }
    }
    if args.json {
        out.insert("band".to_owned(), band.json());
        return print_json(Value::Object(out));
    }
    print(&(rows(&out) + &band.text()))
}

/// Percentile and BCa intervals (95 %) of the fit's numbers; the shift `min`
/// is taken anew from every sample.
fn bootstrap(
    plan: &Plan,
    values: &Limited,
    fits: &Fits,
    replicates: usize,
    seed: u64,
) -> Value {
    let n = values.values.len();
    let draws = Bootstrap::new("fragility", seed, n, replicates);
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
    let made = |places: &[usize]| {
        let fits = plan.fits(&values.at(places));
        fits.map_or([f64::NAN; 6], |fits| numbers(&fits))
    };
    let rows = draws.map(made);
    let without: Vec<[f64; 6]> = (0..n)
        .map(|k| made(&(0..n).filter(|i| *i != k).collect::<Vec<_>>()))
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
                "bca_low": json!(bca.as_ref().map(|e| e.low)),
                "bca_high": json!(bca.as_ref().map(|e| e.high)),
                "standard_error": json!(e.standard_error),
                "low": json!(e.low),
                "high": json!(e.high),
                "used": e.used,
            })
        });
        out.insert(key.to_owned(), json!(value));
    }
    Value::Object(out)
}
