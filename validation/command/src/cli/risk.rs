//! `rocking risk`: how often a year a block overturns, or exceeds a demand.

use std::path::{Path, PathBuf};

use clap::ArgGroup;
use rocking_procedures::fragility::hazard::{
    Hazard, HazardOptions, Site, SpectralCorrelation, average_hazard,
};
use rocking_procedures::{
    FitOptions, FragilityInput, ModelError, Shift, risk,
};
use rocking_statistics::{Lognormal, QuantileType};

use super::fragility::fit::FitArgs;
use super::fragility::source::{FragilitySource, SourceArgs};
use super::shared::{
    BootstrapArgs, JsonArg, ModelErrorArgs, PlotArg, ThreadsArg,
};
use super::show::number;
use crate::failure::{Failure, bail, ensure};
use crate::input;
use crate::terminal::note;
use rocking_assessment::once_in;
use rocking_common::files::Outputs;
use rocking_draw::figures::of_suite::risk_svg;

/// Annual frequency of overturning, or of exceeding a demand, and its
/// probability in T years.
///
/// The hazard curve is OpenQuake's CSV, or a CSV with the columns `pga_g`,
/// `pgv_m_s`, `pgv_cm_s` or `intensity` (the fragility's own unit), and
/// `annual_frequency` or `probability_of_exceedance`; it is interpolated as a
/// power law. Frequencies are bounded below and above, since the curve ends at
/// its last point. The 95 % interval covers the choice of the records, by a
/// bootstrap that draws earthquakes if they are known, and the error of the
/// model; a fragility of --median has an interval only if that error is given.
/// Several curves in SA give one in AvgSA.
#[derive(clap::Args)]
#[command(group = ArgGroup::new("fragility").required(true).multiple(true)
    .args(["median", "sample", "ida", "counts", "law", "blocks"]))]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw hazard, fragilities and annual frequency by intensity"
)))]
#[command(after_help = "Examples:\n  \
    rocking risk --hazard hazard.csv --median 0.43 --dispersion 0.71 \
    --shift 0.15\n  \
    rocking risk --hazard hazard.csv --sample capacities.txt --shift 1 \
    --alpha 0.15 --p 3")]
pub struct RiskCommand {
    /// Hazard curve, CSV; `-` is standard input; repeat for more SA(T).
    #[arg(long, value_name = "HAZARD.csv", required = true)]
    hazard: Vec<PathBuf>,
    /// With several --hazard: mean correlation (1: upper bound), dispersion.
    #[arg(long, value_name = "R,S")]
    correlation: Option<SpectralCorrelation>,
    #[command(flatten)]
    site: SiteArgs,
    /// Median of the fragility, in the unit of the hazard curve.
    #[arg(
        long,
        value_name = "X",
        requires = "dispersion",
        conflicts_with_all = [
            "sample", "ida", "counts", "law", "im", "blocks",
            "BlockArgs", "id", "limit_state", "gravity", "method",
            "bootstrap", "seed"
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
    model_error: ModelErrorArgs,
    #[command(flatten)]
    bootstrap: BootstrapArgs,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    json: JsonArg,
}

/// Site and years of a hazard curve.
#[derive(clap::Args, Clone, Debug)]
pub struct SiteArgs {
    /// Site in an OpenQuake CSV: its coordinates or its custom_site_id.
    #[arg(long, value_name = "LON,LAT|ID", allow_hyphen_values = true)]
    site: Option<Site>,
    /// Years of probabilities, also if a curve states none [default: 50].
    #[arg(long, value_name = "T")]
    years: Option<f64>,
}

/// Years of the printed probabilities by default.
const YEARS: f64 = 50.0;

impl SiteArgs {
    /// Years of the probabilities that are printed.
    pub fn years(&self) -> f64 {
        self.years.unwrap_or(YEARS)
    }

    /// Reads a hazard curve; what is set aside is said on standard error,
    /// too.
    ///
    /// # Errors
    /// [`Failure`] with file and line.
    pub fn read(&self, path: &Path) -> Result<Hazard, Failure> {
        let place = path.display().to_string();
        let text = input::text(path)?;
        let site = self.site.clone();
        let options = HazardOptions { years: self.years, site };
        let hazard = Hazard::parse(&place, &text, &options)?;
        for remark in &hazard.remarks {
            note(&format!("{place}: {remark}"));
        }
        Ok(hazard)
    }
}

/// Runs `rocking risk`.
///
/// # Errors
/// [`Failure`] for a curve, a fragility or a parameter that is refused.
pub fn run_risk(args: &RiskCommand) -> Result<(), Failure> {
    let standard = Path::new("-");
    let read = args.source.inputs();
    let read = read.iter().chain(&args.hazard);
    if read.filter(|path| *path == standard).count() > 1 {
        bail!("--hazard - and another input -: expected at most one of them");
    }
    let source = match args.median {
        None => Some(args.source.open()?),
        Some(_) => None,
    };
    let named = source.iter().flat_map(FragilitySource::inputs);
    let inputs = args.source.inputs().into_iter().chain(named);
    let mut outputs = Outputs::of(inputs.chain(args.hazard.clone()).collect());
    let plot = args.plot.open(&mut outputs)?;
    let hazard = args.hazard(source.as_ref())?;
    let options = args.fit.options(QuantileType::default());
    let fragilities = match (&source, args.median.zip(args.dispersion)) {
        (Some(source), _) => args
            .threads
            .run(|| of_source(args, source, options, &hazard))??,
        (None, Some((median, beta))) => {
            let error = args.model_error.or(ModelError::none());
            given(options.shift, median, beta, &error)?
        }
        (None, None) => bail!("--median: expected --dispersion"),
    };
    let years = args.site.years();
    let found = args.threads.run(|| risk(&hazard, &fragilities, years))??;
    if let Some(out) = plot {
        ensure!(
            fragilities.len() <= MOST_DRAWN,
            "--plot: {} fragilities: expected at most {MOST_DRAWN}",
            fragilities.len()
        );
        out.write(risk_svg(&hazard, &fragilities))?;
    }
    let sentence = found.fragilities.first().map_or(String::new(), |first| {
        let least = first.annual_frequency_truncation_lower;
        let ends = first
            .sampling
            .as_ref()
            .and_then(|own| own.annual_frequency.map(f64::recip).interval());
        let often = once_in(least.recip(), ends.map(|ends| ends.ends()));
        format!("Damage is expected {often}: {} a year.", number(least, None))
    });
    args.json.show_beside(&outputs, &[&sentence], &found)
}

impl RiskCommand {
    /// The hazard curve, or the average of several.
    fn hazard(
        &self,
        source: Option<&FragilitySource>,
    ) -> Result<Hazard, Failure> {
        let all = self.hazard.iter().map(|path| self.site.read(path));
        let mut all = all.collect::<Result<Vec<Hazard>, Failure>>()?;
        match (self.correlation, source) {
            (None, _) if all.len() == 1 => Ok(all.remove(0)),
            (Some(correlation), Some(source)) => {
                Ok(average_hazard(&all, &source.im()?, correlation)?)
            }
            (Some(_), _) => bail!(
                "--correlation: expected a fragility in AvgSA, such as --law"
            ),
            (None, _) => bail!(
                "--hazard: {} curves: expected one, or several in SA with \
                 --correlation",
                all.len()
            ),
        }
    }
}

/// Largest number of fragilities in a drawing.
const MOST_DRAWN: usize = 6;

/// The fragility of given parameters.
fn given(
    shift: Shift,
    median: f64,
    beta: f64,
    error: &ModelError,
) -> Result<Vec<FragilityInput>, Failure> {
    let Shift::Given(shift) = shift else {
        bail!("--shift min or free: expected a number with --median");
    };
    let log_mean = rocking_procedures::fragility::eq5(median, shift)?;
    let law = Lognormal::try_new(shift, log_mean, beta)?;
    let name = kind(&law).to_owned();
    Ok(vec![FragilityInput::with(name, (law, None), error)?])
}

fn kind(law: &Lognormal) -> &'static str {
    if law.shift() > 0.0 { "shifted" } else { "not shifted" }
}

/// The fits of the files, with the shift, if there is one, and without, in the
/// unit of the hazard curve.
fn of_source(
    args: &RiskCommand,
    source: &FragilitySource,
    mut options: FitOptions,
    hazard: &Hazard,
) -> Result<Vec<FragilityInput>, Failure> {
    // A bootstrap of the smallest value, or of a free shift, is refused.
    if matches!(options.shift, Shift::Given(_)) {
        options.draws = Some(args.bootstrap.draws());
    }
    let draws = Some(args.bootstrap.draws());
    let shift = Shift::Given(0.0);
    let unshifted = FitOptions { shift, draws, ..options.clone() };
    let mut fits = vec![options];
    if fits[0].shift != unshifted.shift {
        fits.push(unshifted);
    }
    let error = args.model_error.or(ModelError::default());
    let mut all = Vec::new();
    for options in &fits {
        let unit = hazard.units_per_im_unit;
        let own = source.against(&hazard.im, options)?;
        for (name, (law, sampled)) in own {
            let fitted = law.scaled(unit)?;
            let name = name.map_or(String::new(), |name| name + ", ");
            let fragility = name + kind(&fitted);
            let sampled = sampled.map(|all| all.scaled(unit)).transpose()?;
            let drawn = (fitted, sampled);
            all.push(FragilityInput::with(fragility, drawn, &error)?);
        }
    }
    Ok(all)
}
