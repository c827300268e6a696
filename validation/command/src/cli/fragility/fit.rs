//! `rocking fragility fit`: fits of a sample, or of the capacities of an IDA.

use std::path::{Path, PathBuf};

use clap::ArgGroup;
use rocking_procedures::fit::Band;
use rocking_procedures::{
    Draws, FitOptions, FragilityFit, FragilityInput, LevelFit, Shift,
    capacities, fit_levels, fit_sample,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::lognormal::FitMethod;
use rocking_statistics::{CensoredSample, Lognormal, QuantileType};
use serde::Serialize;

use super::source::{self, DispersionArg, IdaArgs};
use crate::cli::capacities::{EdpLevels, intensities};
use crate::cli::names;
use crate::cli::shared::{JsonArg, PlotArg, ThreadsArg};
use crate::failure::{AtPlace as _, Failure, bail};
use crate::input;
use rocking_common::files::Outputs;
use rocking_common::table::columns::BAND;
use rocking_common::table::{Table, number, optional};
use rocking_draw::figures::of_suite::fragilities_svg;

/// Fits a lognormal fragility to a sample of capacities, or at EDP levels of
/// an IDA.
///
/// With a shift IM_R, the fit is to the capacities above it. Eqs. 5 to 7 are
/// printed beside the fit: they estimate the same fragility from unshifted
/// statistics.
#[derive(clap::Args)]
#[command(group = ArgGroup::new("source").required(true)
    .args(["sample", "ida"]))]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw fits, capacities and, with --bootstrap, confidence bands"
)))]
pub(super) struct FragilityFitCommand {
    /// Sample file: one value per line, `>3.2` for one censored at 3.2, `inf`
    /// for one censored at an unknown limit; `VALUE # RECORD # EARTHQUAKE` if
    /// the earthquake is known; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    sample: Option<PathBuf>,
    #[command(flatten)]
    ida: IdaArgs,
    /// Intensity measure of --ida [default: pga], or of a sample that does not
    /// state it.
    #[arg(long, value_name = "MEASURE")]
    im: Option<IntensityMeasure>,
    #[command(flatten)]
    fit: FitArgs,
    #[command(flatten)]
    dispersion: DispersionArg,
    /// Type of the quantiles, 1 to 9.
    #[arg(long, value_name = "TYPE", default_value_t = 5)]
    quantile_type: u8,
    /// Constant c of Eq. 7.
    #[arg(long, default_value_t = 1.0)]
    c: f64,
    /// Bootstrap samples for intervals; earthquakes are drawn with all their
    /// records if the sample or the IDA states them.
    #[arg(long, value_name = "N")]
    bootstrap: Option<usize>,
    /// Seed of the bootstrap.
    #[arg(
        long,
        value_name = "S",
        requires = "bootstrap",
        default_value_t = 0
    )]
    seed: u64,
    /// Intensities at which to compute the 95 % band of the probability.
    #[arg(
        long,
        value_name = "LEVELS",
        value_parser = intensities,
        requires = "bootstrap",
        allow_hyphen_values = true
    )]
    band: Option<EdpLevels>,
    /// Write the band as a table.
    #[arg(long, value_name = "FILE.csv", requires_all = ["band", "sample"])]
    band_csv: Option<PathBuf>,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    json: JsonArg,
}

/// How a fragility is fitted.
#[derive(clap::Args)]
pub(in crate::cli) struct FitArgs {
    /// Shift IM_R: a number, `min` (smallest value; overstates the
    /// dispersion, no intervals) or `free` (maximum likelihood).
    #[arg(
        long,
        value_name = "X|min|free",
        default_value = "0",
        allow_hyphen_values = true
    )]
    shift: Shift,
    /// How the lognormal distribution is fitted.
    #[arg(
        long,
        value_parser = names::fit_method(),
        default_value = FitMethod::MaximumLikelihood.name()
    )]
    method: FitMethod,
}

impl FitArgs {
    /// The options of a fit without intervals, quantiles of this type.
    pub(in crate::cli) fn options(
        &self,
        quantile_type: QuantileType,
    ) -> FitOptions {
        let method = self.method.with_quantile_type(quantile_type);
        let (shift, default) = (self.shift, FitOptions::default());
        FitOptions { method, shift, quantile_type, ..default }
    }
}

#[derive(Serialize)]
struct OfSample {
    /// What the values are, by the file.
    sample_of: Option<String>,
    unit: String,
    #[serde(flatten)]
    fit: FragilityFit,
}

#[derive(Serialize)]
struct OfLevels {
    unit: String,
    point: String,
    levels: Vec<LevelFit>,
}

/// Runs `rocking fragility fit`.
///
/// # Errors
/// [`Failure`] for input that is refused.
pub(super) fn run_fragility_fit(
    args: &FragilityFitCommand,
) -> Result<(), Failure> {
    let quantile_type = QuantileType::try_new(args.quantile_type)?;
    let mut options = args.fit.options(quantile_type);
    options.c = args.c;
    let seed = args.seed;
    options.draws =
        args.bootstrap.map(|replicates| Draws { replicates, seed });
    options.band = args.band.clone().unwrap_or_default();
    match (&args.sample, &args.ida.ida) {
        (Some(path), _) => of_sample(args, path, &options),
        (None, Some(path)) => of_levels(args, path, &options),
        (None, None) => bail!("expected --sample or --ida"),
    }
}

fn of_sample(
    args: &FragilityFitCommand,
    path: &Path,
    options: &FitOptions,
) -> Result<(), Failure> {
    let mut outputs = Outputs::of(vec![path.to_owned()]);
    let table = outputs.open_some(args.band_csv.as_ref())?;
    let plot = args.plot.open(&mut outputs)?;
    let file = input::sample(path)?;
    let stated = || file.unit().unwrap_or("that of the sample").to_owned();
    let unit = file.im(args.im.as_ref())?;
    let unit = unit.map_or_else(stated, |measure| measure.words());
    let sample = file.censored()?;
    let clusters = Some(file.clusters());
    let options = FitOptions { clusters, ..options.clone() };
    let found = args.threads.run(|| fit_sample(&sample, &options))?;
    let fit = found.at(path.display())?;
    if let Some(out) = plot {
        let drawn = [("fit".to_owned(), sample, fit.fitted)];
        out.write(args.threads.run(|| svg(drawn, &options, &unit))??)?;
    }
    if let (Some(table), Some(band)) = (table, &fit.band) {
        table.write(csv(band))?;
    }
    let sample_of = file.of().map(str::to_owned);
    let found = OfSample { sample_of, unit, fit };
    let sentences = [
        "The fragility has a median of {bootstrap.median} and, above a shift \
         of {fitted.shift}, a dispersion of {bootstrap.dispersion}. It is \
         fitted to {n} values.",
        "The fragility has a median of {fitted.median} and, above a shift of \
         {fitted.shift}, a dispersion of {fitted.dispersion}. It is fitted to \
         {n} values.",
    ];
    args.json.show_beside(&outputs, &sentences, &found)
}

fn of_levels(
    args: &FragilityFitCommand,
    path: &Path,
    options: &FitOptions,
) -> Result<(), Failure> {
    let mut outputs = Outputs::of(vec![path.to_owned()]);
    let plot = args.plot.open(&mut outputs)?;
    let measure = source::in_table(args.im.as_ref())?;
    let curves = input::ida(path, measure)?.1;
    let clusters = Some(curves.clusters.clone());
    let mut options = FitOptions { clusters, ..options.clone() };
    let curves = curves.into_curves();
    let (at, rule) = args.ida.levels();
    let dispersion = args.dispersion.dispersion;
    let fit = || fit_levels(&curves, at, rule, dispersion, &options);
    let found = args.threads.run(fit)?;
    let levels = found.at(path.display())?;
    let unit = measure.row().words.to_owned();
    let level = |level: &LevelFit| {
        let sample = capacities::sample(&curves, level.edp, rule)?;
        let name = match level.edp.is_finite() {
            true => format!("EDP {}", level.edp),
            false => "overturning".to_owned(),
        };
        Ok((name, sample, level.fit.fitted))
    };
    if let Some(out) = plot {
        let drawn = levels.iter().map(level);
        let drawn = drawn.collect::<Result<Vec<_>, Failure>>()?;
        let samples: Vec<_> = drawn.iter().map(|one| one.1.clone()).collect();
        options.family = dispersion.family(&samples);
        out.write(args.threads.run(|| svg(drawn, &options, &unit))??)?;
    }
    let point = rule.to_string();
    let found = OfLevels { unit, point, levels };
    let sentences = [
        "At |theta|/alpha = {levels.last.edp} the fragility has a median of \
         {levels.last.fitted.median}.",
        "At overturning the fragility has a median of \
         {levels.last.fitted.median}.",
    ];
    args.json.show_beside(&outputs, &sentences, &found)
}

/// Fits to samples, by their names.
fn svg(
    all: impl IntoIterator<Item = (String, CensoredSample, Lognormal)>,
    options: &FitOptions,
    unit: &str,
) -> Result<String, Failure> {
    let (mut fits, mut points) = (Vec::new(), Vec::new());
    for (fragility, sample, fitted) in all {
        let sampled = options.sampled(&sample)?;
        let fitted = fitted.into();
        fits.push(FragilityInput { fragility, fitted, sampled });
        points.push(sample.points());
    }
    let words = (unit, "marks: capacities of the records");
    Ok(fragilities_svg(&fits, &points, words))
}

/// Write the band as a table.
fn csv(band: &Band) -> String {
    let mut table = Table::of(&BAND);
    for point in &band.points {
        table.row([
            number(point.intensity),
            number(point.probability.value()),
            optional(point.probability.low()),
            optional(point.probability.high()),
            optional(point.delta.low()),
            optional(point.delta.high()),
        ]);
    }
    table.finish()
}
