//! `rocking risk`: how often a year a block overturns, or exceeds a demand.

use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args as ClapArgs};
use rocking::fragility::hazard::{Hazard, HazardOptions};
use rocking::procedures::{FitOptions, Shift, risk};
use rocking::statistics::{Lognormal, QuantileType};

use super::fragility::fit::FitArgs;
use super::fragility::source::SourceArgs;
use super::shared::JsonArg;
use super::{Failure, input, note};

/// Mean annual frequency of overturning, or of exceeding a demand, and its
/// probability in T years, from a hazard curve and a fragility.
///
/// The hazard curve is OpenQuake's CSV, or a CSV with the columns `pga_g`,
/// `pgv_m_s`, `pgv_cm_s` or `intensity` (the fragility's own unit), and
/// `annual_frequency` or `probability_of_exceedance`. Between its points the
/// frequency is a power of the intensity. OpenQuake interpolates linearly
/// and finds 10 to 17 % more on a curve of 20 points. Beyond the last point
/// nothing is assumed: lower and upper are bounds of that truncation and no
/// confidence interval.
#[derive(ClapArgs)]
#[command(group = ArgGroup::new("fragility").required(true).multiple(true)
    .args(["median", "sample", "ida", "counts", "surrogate", "blocks"]))]
#[command(after_help = "Examples:\n  \
    rocking risk --hazard hazard.csv --median 0.43 --dispersion 0.71 \
    --shift 0.15\n  \
    rocking risk --hazard hazard.csv --sample capacities.txt --shift 1 \
    --alpha 0.15 --p 3")]
pub struct Args {
    /// Hazard curve, CSV; `-` is standard input.
    #[arg(long, value_name = "HAZARD.csv")]
    hazard: PathBuf,
    /// Longitude and latitude of the site, in OpenQuake's CSV of several.
    #[arg(
        long,
        value_name = "LON,LAT",
        value_parser = site,
        allow_hyphen_values = true
    )]
    site: Option<(f64, f64)>,
    /// Years of probabilities, also of a curve's without its own [default: 50].
    #[arg(long, value_name = "T")]
    years: Option<f64>,
    /// Median of the fragility, in the unit of the hazard curve.
    #[arg(
        long,
        value_name = "X",
        requires = "dispersion",
        conflicts_with_all = [
            "sample", "ida", "counts", "surrogate", "im", "blocks",
            "BlockArgs", "id", "limit_state", "gravity", "method"
        ]
    )]
    median: Option<f64>,
    /// Dispersion of the fragility, of the logarithm above the shift.
    #[arg(long, value_name = "B", requires = "median")]
    dispersion: Option<f64>,
    #[command(flatten)]
    fit: FitArgs,
    #[command(flatten)]
    source: SourceArgs,
    #[command(flatten)]
    json: JsonArg,
}

/// Years of the probabilities that are printed, where none are given.
const YEARS: f64 = 50.0;

fn site(text: &str) -> Result<(f64, f64), String> {
    let degrees = text.split_once(',').and_then(|(lon, lat)| {
        Some((lon.trim().parse().ok()?, lat.trim().parse().ok()?))
    });
    degrees.ok_or_else(|| "expected longitude,latitude in degrees".into())
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a curve, a fragility or a parameter that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    let standard = Path::new("-");
    if args.hazard == standard
        && args.source.inputs().iter().any(|path| path == standard)
    {
        return Err(Failure::input(
            "--hazard - and another file -: expected one of them as a file",
        ));
    }
    let hazard = read(args)?;
    let options = args.fit.options(QuantileType::default());
    let fragilities = match (args.median, args.dispersion) {
        (Some(median), Some(beta)) => given(options.shift, median, beta)?,
        _ => of_source(args, options, &hazard)?,
    };
    let fragilities: Vec<(&str, Lognormal)> =
        fragilities.iter().map(|(name, law)| (name.as_str(), *law)).collect();
    let years = args.years.unwrap_or(YEARS);
    args.json.show(&risk(&hazard, &fragilities, years)?)
}

/// Reads the hazard curve; what is set aside is said on standard error, too.
fn read(args: &Args) -> Result<Hazard, Failure> {
    let place = args.hazard.display().to_string();
    let text = input::text(&args.hazard)?;
    let options = HazardOptions { years: args.years, site_deg: args.site };
    let hazard = Hazard::parse(&place, &text, &options)?;
    for remark in &hazard.remarks {
        note(&format!("{place}: {remark}"));
    }
    Ok(hazard)
}

/// The fragility of given parameters.
fn given(
    shift: Shift,
    median: f64,
    beta: f64,
) -> Result<Vec<(String, Lognormal)>, Failure> {
    let Shift::Given(shift) = shift else {
        return Err(Failure::input(
            "--shift min or free: expected a number with --median",
        ));
    };
    let log_mean = rocking::fragility::eq5(median, shift)?;
    let law = Lognormal::try_new(shift, log_mean, beta)?;
    Ok(vec![(kind(&law).to_owned(), law)])
}

fn kind(law: &Lognormal) -> &'static str {
    if law.shift() > 0.0 { "shifted" } else { "not shifted" }
}

/// The fits of the files, with the shift where there is one and without, in
/// the unit of the hazard curve.
fn of_source(
    args: &Args,
    options: FitOptions,
    hazard: &Hazard,
) -> Result<Vec<(String, Lognormal)>, Failure> {
    let source = args.source.open()?;
    let unshifted = FitOptions { shift: Shift::Given(0.0), ..options.clone() };
    let mut fits = vec![options];
    if fits[0] != unshifted {
        fits.push(unshifted);
    }
    let mut all = Vec::new();
    for options in &fits {
        for (name, law) in source.against(hazard.im.as_ref(), options)? {
            let law = law.scaled(hazard.units_per_im_unit)?;
            let name = name.map_or(String::new(), |name| name + ", ");
            all.push((name + kind(&law), law));
        }
    }
    Ok(all)
}
