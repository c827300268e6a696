//! Fragilities of blocks as files of other programs.

use std::path::{Path, PathBuf};

use rocking_exchange::{BlockFragility, ExchangeFormat, Id};
use rocking_procedures::ModelError;
use rocking_statistics::QuantileType;
use serde::Serialize;

use super::fit::FitArgs;
use super::source::{DispersionArg, SourceArgs};
use crate::cli::names::named;
use crate::cli::shared::{JsonArg, ModelErrorArgs};
use crate::failure::{Failure, bail};
use rocking_common::files::Outputs;

/// Writes fragilities of blocks for another program, with the error of the
/// model.
#[derive(clap::Args)]
pub(super) struct FragilityExportCommand {
    #[command(flatten)]
    source: SourceArgs,
    #[command(flatten)]
    fit: FitArgs,
    #[command(flatten)]
    dispersion: DispersionArg,
    #[command(flatten)]
    model_error: ModelErrorArgs,
    /// Format of the file.
    #[arg(long, value_name = "FORMAT", value_parser = named(
        ExchangeFormat::ALL,
        |format| format.name,
        ExchangeFormat::ALL.iter().map(|format| format.help),
    ))]
    format: &'static ExchangeFormat,
    /// The file; `-` is standard output, and then nothing else is printed.
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Serialize)]
struct ExportSummary<'a> {
    model_error: ModelError,
    blocks: Vec<LimitStateRow<'a>>,
}

/// A limit state of a block: the law of its records.
#[derive(Serialize)]
struct LimitStateRow<'a> {
    id: &'a Id,
    limit_state: &'a Id,
    im: String,
    unit: &'static str,
    shift: f64,
    median: f64,
    beta: f64,
    /// With the error of the model.
    total_median: f64,
}

/// Runs `rocking fragility export`.
///
/// # Errors
/// [`Failure`] for input or a place that is refused, and for fragilities that
/// the format cannot represent; nothing is written then.
pub(super) fn run_fragility_export(
    args: &FragilityExportCommand,
) -> Result<(), Failure> {
    let source = args.source.open()?;
    let inputs = [args.source.inputs(), source.inputs()].concat();
    let mut outputs = Outputs::of(inputs);
    let file = outputs.open(&args.out)?;
    let second = outputs.open_some(args.beside()?.as_ref())?;
    let mut options = args.fit.options(QuantileType::default());
    options.family = source.family(args.dispersion.dispersion);
    let model_error = args.model_error.or(ModelError::default());
    let fragilities = source.all(&options)?.into_iter();
    let fragilities: Vec<BlockFragility> = fragilities
        .map(|(own, _)| BlockFragility { model_error, ..own })
        .collect();
    let texts = args.format.texts(&fragilities)?;
    file.write(texts.main)?;
    if let (Some(second), Some(text)) = (second, texts.beside) {
        second.write(text)?;
    }
    let mut blocks = Vec::new();
    for one in &fragilities {
        for state in &one.limit_states {
            let law = state.fragility;
            blocks.push(LimitStateRow {
                id: &one.id,
                limit_state: &state.name,
                im: one.im.to_string(),
                unit: one.im.unit(),
                shift: law.shift(),
                median: law.median(),
                beta: law.dispersion(),
                total_median: model_error.total(law)?.median(),
            });
        }
    }
    let sentence = format!("The fragilities are in {}.", args.out.display());
    let found = ExportSummary { model_error, blocks };
    args.json.show_beside(&outputs, &[&sentence], &found)
}

impl FragilityExportCommand {
    /// The second file of the format, beside the first.
    fn beside(&self) -> Result<Option<PathBuf>, Failure> {
        let Some(extension) = self.format.beside else { return Ok(None) };
        let second = self.out.with_extension(extension);
        if self.out == Path::new("-") || second == self.out {
            bail!(
                "--out {}: expected a file .csv, beside which a file \
                 .{extension} is written",
                self.out.display()
            );
        }
        Ok(Some(second))
    }
}
