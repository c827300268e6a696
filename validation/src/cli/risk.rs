//! `rocking risk`: how often a year a block overturns, or exceeds a demand.

use std::io::Read as _;
use std::path::{Path, PathBuf};

use clap::{ArgGroup, Args as ClapArgs};
use rocking::fragility::hazard::{Hazard, HazardOptions};
use rocking::integrator::Model;
use rocking::intensity::IntensityMeasure;
use rocking::procedures::{FitOptions, Shift, fit_sample, risk};
use rocking::statistics::Lognormal;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::unit_intensity;

use super::samples::{Opened, SampleFile};
use super::scene::BlockArgs;
use super::show::show;
use super::{Failure, names, note};
use rocking_common::paper::Intensity;

/// Mean annual frequency of overturning, or of exceeding a demand, and its
/// probability in T years, from a hazard curve and a fragility.
///
/// The hazard curve is OpenQuake's CSV, or a CSV with the columns `pga_g`,
/// `pgv_m_s`, `pgv_cm_s` or `intensity` (the fragility's own unit), and
/// `annual_frequency` or `probability_of_exceedance`. Between its points the
/// frequency is a power of the intensity. OpenQuake interpolates linearly
/// and finds 10 to 17 % more on a curve of 20 points. Beyond the last point
/// nothing is assumed: lower and upper are bounds of that truncation and no
/// confidence interval. Where the fragility at the first point is not 0,
/// weaker motions add to the frequency.
#[derive(ClapArgs)]
#[command(group = ArgGroup::new("fragility").required(true)
    .args(["median", "sample"]))]
#[command(after_help = "Examples:\n  \
    rocking risk --hazard hazard.csv --median 0.43 --dispersion 0.71 \
    --shift 0.15\n  \
    rocking risk --hazard hazard.csv --sample capacities.txt --shift 1 \\\n      \
    --alpha 0.15 --p 3\n\n\
    A hazard curve:\n  \
    pga_g,annual_frequency\n  0.05,0.02\n  0.2,0.002\n  1,0.00003")]
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
    /// Years of the probabilities: of those printed [default: 50], and of a
    /// hazard curve's that does not say its own.
    #[arg(long, value_name = "T")]
    years: Option<f64>,
    /// Median of the fragility, in the unit of the hazard curve.
    #[arg(long, value_name = "X", requires = "dispersion")]
    median: Option<f64>,
    /// Dispersion of the fragility, of the logarithm above the shift.
    #[arg(long, value_name = "B", requires = "median")]
    dispersion: Option<f64>,
    /// Sample of dimensionless capacities, fitted by maximum likelihood
    /// (`>3.2` is a value censored at 3.2), of the block --alpha --p or
    /// --width-m --height-m; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    sample: Option<PathBuf>,
    /// Shift, below which nothing happens: in the unit of the hazard curve
    /// with --median, of the sample with --sample [default: 0].
    #[arg(long, value_name = "X|min", allow_hyphen_values = true)]
    shift: Option<Shift>,
    /// Intensity measure of a sample that does not say it.
    #[arg(long, value_parser = names::intensity(), requires = "sample")]
    im: Option<Intensity>,
    #[command(flatten)]
    block: BlockArgs,
    /// Gravity in m/s2 [default: 9.80665].
    #[arg(long, value_name = "G", requires = "sample")]
    gravity: Option<f64>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
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
/// [`Failure`] for a curve, a sample or a parameter that is refused.
pub fn run(args: &Args) -> Result<(), Failure> {
    if args.sample.as_deref() == Some(Path::new("-"))
        && args.hazard == Path::new("-")
    {
        return Err(Failure::input(
            "--hazard - and --sample -: expected one of them as a file",
        ));
    }
    let hazard = read(args)?;
    let fragilities = match (&args.sample, args.median, args.dispersion) {
        (Some(path), ..) => of_sample(args, path, &hazard)?,
        (None, Some(median), Some(beta)) => given(args, median, beta)?,
        _ => return Err(Failure::input("expected --median or --sample")),
    };
    let years = args.years.unwrap_or(YEARS);
    show(args.json, &risk(&hazard, &fragilities, years)?)
}

/// Reads the hazard curve; what is set aside is said on standard error, too.
fn read(args: &Args) -> Result<Hazard, Failure> {
    let place = args.hazard.display().to_string();
    let mut text = String::new();
    Opened::open(&args.hazard)
        .and_then(|mut file| file.read_to_string(&mut text))
        .map_err(|e| Failure::input(format!("cannot read {place}: {e}")))?;
    let options = HazardOptions { years: args.years, site_deg: args.site };
    let hazard = Hazard::parse(&place, &text, &options)?;
    for remark in &hazard.remarks {
        note(&format!("{place}: {remark}"));
    }
    Ok(hazard)
}

/// The fragility of given parameters.
fn given(
    args: &Args,
    median: f64,
    beta: f64,
) -> Result<Vec<(&'static str, Lognormal)>, Failure> {
    if let Some(flag) = args.block.given() {
        return Err(Failure::input(format!(
            "{flag} is not used without --sample"
        )));
    }
    let shift = match args.shift {
        None => 0.0,
        Some(Shift::Given(shift)) => shift,
        Some(Shift::Smallest | Shift::Free) => {
            return Err(Failure::input(
                "--shift min or free: expected a number with --median",
            ));
        }
    };
    let log_mean = rocking::fragility::eq5(median, shift)?;
    let fragility = Lognormal::try_new(shift, log_mean, beta)?;
    Ok(vec![(if shift > 0.0 { "shifted" } else { "lognormal" }, fragility)])
}

/// The fits of a sample, with the shift where there is one and without, in
/// the unit of the hazard curve.
fn of_sample(
    args: &Args,
    path: &Path,
    hazard: &Hazard,
) -> Result<Vec<(&'static str, Lognormal)>, Failure> {
    let file = SampleFile::read(path)?;
    let name = path.display();
    let at = |what: String| Failure::input(format!("{name}: {what}"));
    let factor = match &hazard.im {
        None => match args.block.given() {
            None => 1.0,
            Some(flag) => {
                return Err(Failure::input(format!(
                    "{flag}: the hazard curve is in the sample's own unit \
                     (`intensity`): expected no block, or pga_g, pgv_m_s or \
                     pgv_cm_s"
                )));
            }
        },
        Some(im) => {
            let given = file.measure(args.im)?.map(Intensity::words);
            let stated = file.of().and_then(|of| of.split(" at EDP ").next());
            let own = given.or(stated);
            if own != Some(im.words().as_str()) {
                return Err(at(format!(
                    "a sample of {}, a hazard curve of {im}: expected the \
                     same measure",
                    own.unwrap_or("a measure not stated"),
                )));
            }
            hazard.units_per_im_unit * in_a_block(args, &file, im, &at)?
        }
    };
    let sample = file.censored()?;
    let fitted = |shift: Shift| {
        let options = FitOptions { shift, ..FitOptions::default() };
        let found = fit_sample(&sample, &options);
        let found = found.map_err(|e| at(e.to_string()))?;
        Ok::<_, Failure>(found.fitted.scaled(factor)?)
    };
    let unshifted = ("not shifted", fitted(Shift::Given(0.0))?);
    Ok(match args.shift {
        None | Some(Shift::Given(0.0)) => vec![unshifted],
        Some(shift) => vec![("shifted", fitted(shift)?), unshifted],
    })
}

/// Number of units of the measure (g or m/s) in a unit of the sample.
fn in_a_block(
    args: &Args,
    file: &SampleFile,
    im: &IntensityMeasure,
    at: &dyn Fn(String) -> Failure,
) -> Result<f64, Failure> {
    let Some(intensity) = im.dimensionless() else {
        return match args.block.given() {
            None => Ok(1.0),
            Some(flag) => Err(Failure::input(format!(
                "{flag} is not used with a hazard curve of {im}"
            ))),
        };
    };
    let gravity = args.gravity.unwrap_or(STANDARD_GRAVITY_M_S2);
    let block = args.block.block(gravity)?;
    file.setting().holds_for(&block, Some(intensity)).map_err(at)?;
    let model = file.setting().model.unwrap_or(Model::Nonlinear);
    Ok(unit_intensity(intensity, &block, model, gravity))
}
