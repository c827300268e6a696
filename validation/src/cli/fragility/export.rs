//! Fragilities of blocks of given size, as files of other programs.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use rocking::block::Block;
use rocking::integrator::Model;
use rocking::procedures::fit_sample;
use rocking::units::STANDARD_GRAVITY_M_S2;
use rocking_exchange::{
    BlockFragility, Format, Id, unit, unit_intensity, unstated_origin,
};
use serde_json::json;

use super::blocks;
use super::fit::FitArgs;
use crate::cli::names::{self, named};
use crate::cli::samples::SampleFile;
use crate::cli::scene::BlockArgs;
use crate::cli::{Failure, print, print_json};
use rocking_common::files::Outputs;
use rocking_common::paper::Intensity;

/// What the help says of the formats.
const FORMATS: [&str; 4] = [
    "OpenQuake's NRML 0.5: PGA in g, PGV in cm/s",
    "CSV, and JSON beside it: g, m/s",
    "Median and dispersion, not shifted: g, m/s",
    "All parameters: g, m/s",
];

/// Writes fragilities of blocks of given size for another program.
#[derive(clap::Args)]
pub(super) struct Args {
    /// Format of the file.
    #[arg(
        long,
        value_name = "FORMAT",
        value_parser = named(Format::ALL, Format::name, FORMATS)
    )]
    format: Format,
    /// The file; `-` is standard output, and nothing else is printed then.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Sample of dimensionless capacities.
    #[arg(long, value_name = "FILE")]
    sample: Option<PathBuf>,
    /// Intensity measure of a sample that does not say it.
    #[arg(long, value_parser = names::intensity())]
    im: Option<Intensity>,
    #[command(flatten)]
    fit: FitArgs,
    /// Table of blocks: alpha,p or width_m,height_m, and where wanted id,
    /// eta and sample (a file beside the table, in place of --sample).
    #[arg(
        long,
        value_name = "BLOCKS.csv",
        conflicts_with_all = ["alpha", "p", "width_m", "height_m", "id"]
    )]
    blocks: Option<PathBuf>,
    #[command(flatten)]
    block: BlockArgs,
    /// Name of the block in the file [default: from alpha and p].
    #[arg(long, value_name = "NAME")]
    id: Option<Id>,
    /// Name of the damage in the file.
    #[arg(long, value_name = "NAME", default_value = "exceeded")]
    limit_state: Id,
    /// Gravity in m/s2.
    #[arg(long, value_name = "G", default_value_t = STANDARD_GRAVITY_M_S2)]
    gravity: f64,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// A block to export, and where it was found.
struct Wanted {
    place: String,
    id: Option<Id>,
    block: Block,
    eta: Option<f64>,
    sample: PathBuf,
}

pub(super) fn run(args: &Args) -> Result<(), Failure> {
    let (export, format) = (args, args.format);
    let gravity_m_s2 = export.gravity;
    if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
        return Err(Failure::input(format!(
            "--gravity {gravity_m_s2}: expected a positive number"
        )));
    }
    let wanted = wanted(args, gravity_m_s2)?;
    let out = export.out.as_path();
    let mut inputs: Vec<PathBuf> = export.blocks.iter().cloned().collect();
    inputs.extend(wanted.iter().map(|one| one.sample.clone()));
    let beside = beside(format, out)?;
    let mut outputs = Outputs::of(inputs);
    let file = outputs.open(out)?;
    let second = outputs.open_some(beside.as_ref())?;
    let mut fragilities = Vec::new();
    let mut names = BTreeSet::new();
    // Each file is read once: standard input has no second time.
    let mut samples: BTreeMap<&Path, SampleFile> = BTreeMap::new();
    for one in &wanted {
        let path = one.sample.as_path();
        if !samples.contains_key(path) {
            samples.insert(path, SampleFile::read(path)?);
        }
        let made = made(args, one, &samples[path], gravity_m_s2)?;
        if !names.insert(made.id.clone()) {
            return Err(Failure::input(format!(
                "{}{} is there twice: expected a name of its own",
                one.place, made.id
            )));
        }
        fragilities.push(made);
    }
    let texts = format.texts(&fragilities, &export.limit_state)?;
    let is_standard = file.is_standard();
    file.write(texts.main)?;
    if let (Some(second), Some((_, text))) = (second, texts.beside) {
        second.write(text)?;
    }
    if is_standard { Ok(()) } else { show(args, &fragilities) }
}

/// The second file of a format, beside the first.
fn beside(format: Format, out: &Path) -> Result<Option<PathBuf>, Failure> {
    let Some(extension) = format.beside() else { return Ok(None) };
    let second = out.with_extension(extension);
    if out == Path::new("-") || second == out {
        return Err(Failure::input(format!(
            "--out {}: expected a file .csv, beside which a file \
             .{extension} is written",
            out.display()
        )));
    }
    Ok(Some(second))
}

fn wanted(args: &Args, gravity_m_s2: f64) -> Result<Vec<Wanted>, Failure> {
    let export = args;
    let none = || {
        Failure::input(
            "expected a sample: --sample FILE, or a column `sample`",
        )
    };
    let Some(path) = &export.blocks else {
        return Ok(vec![Wanted {
            place: String::new(),
            id: export.id.clone(),
            block: export.block.block(gravity_m_s2)?,
            eta: None,
            sample: args.sample.clone().ok_or_else(none)?,
        }]);
    };
    let rows = blocks::read(path, gravity_m_s2)?.into_iter();
    rows.map(|row| {
        let sample = row.sample.or_else(|| args.sample.clone());
        Ok(Wanted {
            place: format!("{}:{}: ", path.display(), row.line),
            id: row.id,
            block: row.block,
            eta: row.eta,
            sample: sample.ok_or_else(none)?,
        })
    })
    .collect()
}

/// The fragility of one block in its own units.
fn made(
    args: &Args,
    wanted: &Wanted,
    file: &SampleFile,
    gravity_m_s2: f64,
) -> Result<BlockFragility, Failure> {
    let name = wanted.sample.display();
    let at = |what: String| {
        Failure::input(format!("{}{name}: {what}", wanted.place))
    };
    let Some(intensity) = file.measure(args.im)? else {
        return Err(at(match file.of() {
            Some(of) => format!("a sample of {of}: expected PGA or PGV"),
            None => "it does not say its measure: expected --im".to_owned(),
        }));
    };
    let (setting, block) = (file.setting(), wanted.block);
    file.holds_for(&block).map_err(at)?;
    if let (Some(own), Some(eta)) = (setting.eta, wanted.eta)
        && own != eta
    {
        return Err(at(format!(
            "capacities at eta {own}, the block has {eta}: expected the same"
        )));
    }
    let sample = file.censored()?;
    let found = fit_sample(&sample, &args.fit.options()?);
    let fitted = found.map_err(|e| at(e.to_string()))?.fitted;
    let model = setting.model.unwrap_or(Model::Nonlinear);
    let factor = unit_intensity(intensity, &block, model, gravity_m_s2);
    let id = match &wanted.id {
        Some(id) => id.clone(),
        None => Id::of(&block).map_err(at)?,
    };
    Ok(BlockFragility {
        id,
        block,
        eta: wanted.eta.or(setting.eta),
        intensity,
        fragility: fitted.scaled(factor)?,
        origin: origin(file, intensity),
    })
}

/// What the file says of itself, and what it does not.
fn origin(file: &SampleFile, intensity: Intensity) -> String {
    let mut text = match file.of() {
        Some(of) => format!("{} capacities, {of}", file.values().len()),
        None => unstated_origin(file.values().len(), intensity),
    };
    let setting = file.setting();
    for (name, value, unit) in [
        ("alpha", setting.alpha_rad, " rad"),
        ("p", setting.p_rad_s, " rad/s"),
        ("eta", setting.eta, ""),
    ] {
        if let Some(value) = value {
            let _ = write!(text, ", {name} {value}{unit}");
        }
    }
    text
}

fn show(args: &Args, fragilities: &[BlockFragility]) -> Result<(), Failure> {
    if args.json {
        let rows = fragilities.iter().map(|one| {
            json!({
                "id": one.id.to_string(),
                "im": one.intensity.name(),
                "unit": unit(one.intensity),
                "shift": json!(one.fragility.shift()),
                "median": json!(one.fragility.median()),
                "beta": json!(one.fragility.dispersion()),
            })
        });
        return print_json(json!({ "blocks": rows.collect::<Vec<_>>() }));
    }
    let mut text = format!(
        "{:<28} {:>9} {:>9} {:>9} {:>9}\n",
        "block", "intensity", "shift", "median", "beta"
    );
    for one in fragilities {
        let measure = match one.intensity {
            Intensity::Pga => "PGA, g",
            Intensity::Pgv => "PGV, m/s",
        };
        writeln!(
            text,
            "{:<28} {measure:>9} {:>9.5} {:>9.5} {:>9.5}",
            one.id,
            one.fragility.shift(),
            one.fragility.median(),
            one.fragility.dispersion(),
        )?;
    }
    print(&text)
}
