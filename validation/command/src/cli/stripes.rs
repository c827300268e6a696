//! `rocking stripes`: EDP given IM from an IDA table.

use std::path::PathBuf;

use rocking::capacity::ResponseCurve;
use rocking_procedures::counts::RecordOutcome;
use rocking_procedures::{StripeResponses, stripes};
use serde::Serialize;

use super::capacities::{EdpLevels, intensities};
use super::names;
use super::shared::{JsonArg, PlotArg};
use crate::failure::Failure;
use crate::input;
use rocking_common::files::Outputs;
use rocking_common::paper::Intensity;
use rocking_common::table::{Table, columns::OUTCOMES};
use rocking_draw::figures::of_suite::stripes_svg;
use rocking_exchange::ida::IdaTable;

/// Responses at given intensities, of all records of an IDA table.
///
/// At a stripe the response of a record is read from its curve, linear between
/// analyses, and infinite from the first overturning on. If a record was not
/// run up to a stripe, the stripe is open for it: such records are counted and
/// left out, so that quantiles are too high. Counts of such a suite would
/// mislead a fit, so --counts then writes the two analyses between which each
/// record exceeds the level, or where its run ends.
#[derive(clap::Args)]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw the responses with their 16, 50 and 84 % quantiles, and the shares \
     that overturn"
)))]
#[command(after_help = "Examples:\n  \
    rocking stripes --ida ida.csv --levels 1.5,2,3\n  \
    rocking stripes --ida ida.csv --levels 1.2:4:0.2 --at 0.5 \
    --counts counts.csv")]
pub struct StripesCommand {
    /// Table of `rocking ida`; `-` is standard input.
    #[arg(long, value_name = "FILE")]
    ida: PathBuf,
    /// Intensity measure.
    #[arg(long, value_parser = names::intensity(), default_value = "pga")]
    im: Intensity,
    /// Intensities, FIRST:LAST:STEP or separated by commas.
    #[arg(
        long,
        value_name = "LEVELS",
        value_parser = intensities,
        allow_hyphen_values = true
    )]
    levels: EdpLevels,
    /// EDP level for which --counts counts exceedances; `inf` is overturning.
    #[arg(long, value_name = "E", requires = "counts")]
    at: Option<f64>,
    /// Write which records exceed --at at each intensity, for `rocking
    /// fragility counts`; `-` is standard output, and then nothing else is
    /// printed.
    #[arg(long, value_name = "OUT.csv", requires = "at")]
    counts: Option<PathBuf>,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Serialize)]
struct StripesSummary {
    /// Number of records.
    n: usize,
    /// The EDP level whose exceedances are counted.
    edp: Option<f64>,
    stripes: Vec<StripeResponses>,
}

/// Runs `rocking stripes`.
///
/// # Errors
/// [`Failure`] for a file or a level that is refused.
pub fn run_stripes(args: &StripesCommand) -> Result<(), Failure> {
    let mut outputs = Outputs::of(vec![args.ida.clone()]);
    let counts = outputs.open_some(args.counts.as_ref())?;
    let plot = args.plot.open(&mut outputs)?;
    let (table, curves) = input::ida(&args.ida, args.im)?;
    let curves = curves.into_curves();
    let stripes = stripes(&curves, &args.levels, args.at)?;
    let axis = args.im.row().label;
    if let Some(out) = plot {
        out.write(stripes_svg(&curves, &stripes, axis))?;
    }
    if let (Some(out), Some(edp)) = (counts, args.at) {
        out.write(outcomes(&table, &curves, &args.levels, edp)?)?;
    }
    let found = StripesSummary { n: curves.len(), edp: args.at, stripes };
    let sentence = "At an intensity of {stripes.last.intensity} the block \
                    overturns under {stripes.last.overturned} of \
                    {stripes.last.n} records.";
    args.json.show_beside(&outputs, &[sentence], &found)
}

/// The table of the outcomes of the records.
fn outcomes(
    table: &IdaTable,
    curves: &[ResponseCurve],
    levels: &[f64],
    edp: f64,
) -> Result<String, Failure> {
    let mut out = Table::of(&OUTCOMES);
    let (records, events) =
        (table.records().collect::<Vec<_>>(), table.events());
    for found in RecordOutcome::from_curves(curves, levels, edp)? {
        let event = events.as_ref().map_or("", |all| all[found.record]);
        out.row([
            found.im.to_string(),
            records[found.record].to_owned(),
            event.to_owned(),
            u8::from(found.exceeded).to_string(),
        ]);
    }
    Ok(out.finish())
}
