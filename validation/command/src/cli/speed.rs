//! `rocking speed`: error against processor time, on this machine.

use std::path::PathBuf;

use rocking::excitation::NormalisedRecord;
use rocking::integrator::Model;
use rocking::number::dispatch::Isa;
use rocking_records::{ReadOptions, SetAside};
use serde::Serialize;

use super::shared::JsonArg;
use crate::failure::Failure;
use crate::terminal::progress;
use rocking_common::curves::Execution;
use rocking_common::files::Outputs;
use rocking_common::paper::BLOCKS;
use rocking_common::suites::StudySuite;
use rocking_common::suites::inputs::read_suite;
use rocking_report::speed::answers::ToolAnswer;
use rocking_report::speed::cases::speed_cases;
use rocking_report::speed::clock::peak_memory_mib;
use rocking_report::speed::measured::{Total, read_answers, text, totals};
use rocking_report::speed::singles::{self, BASE, ORDERS};
use rocking_report::speed::throughput::{
    self, AgainstLoop, CurveWork, Throughput, analyses, on_threads,
};
use rocking_report::speed::{export, many};

/// Measures speed and error on this machine: thirty single analyses against
/// double-double, and the paper's whole analysis of a suite, in lanes and
/// one analysis at a time.
///
/// It takes a few minutes. Times are processor time and differ from run to run
/// and machine to machine; errors and work do not.
#[derive(clap::Args)]
pub struct SpeedCommand {
    /// Suite of the throughput measurement: a folder of records, an index, or
    /// a zip; may be repeated [default: both embedded suites].
    #[arg(long, value_name = "PATH")]
    suite: Vec<PathBuf>,
    /// Only the single analyses.
    #[arg(long, conflicts_with = "suite")]
    singles: bool,
    /// Write one row for each method and case.
    #[arg(long, value_name = "FILE.csv")]
    out: Option<PathBuf>,
    /// Write the throughput.
    #[arg(long, value_name = "FILE.csv", conflicts_with = "singles")]
    throughput: Option<PathBuf>,
    /// Write the cases for other tools, and measure nothing.
    #[arg(
        long,
        value_name = "DIR",
        hide = true,
        conflicts_with_all = ["singles", "out", "throughput", "answers", "json"]
    )]
    export: Option<PathBuf>,
    /// Judge the answers of other tools beside our own.
    #[arg(long, value_name = "FILE.csv", hide = true)]
    answers: Vec<PathBuf>,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking speed`.
///
/// # Errors
/// [`Failure`] for a suite or an answer that is refused, or a file that
/// cannot be written.
pub fn run_speed(args: &SpeedCommand) -> Result<(), Failure> {
    let cases = speed_cases()?;
    if let Some(folder) = &args.export {
        let (records, _) = records(args)?;
        let analyses = analyses(&BLOCKS, Model::Nonlinear, None)?;
        let threads = rayon::current_num_threads();
        let way = Execution::default();
        let job =
            CurveWork { analyses: &analyses, records: &records, way, threads };
        let (_, found) = job.measure("")?;
        export::cases_and_chains(folder, &cases, &job, &found)?;
        return Ok(());
    }
    let mut outputs = Outputs::of(args.answers.clone());
    let out = outputs.open_some(args.out.as_ref())?;
    let table = outputs.open_some(args.throughput.as_ref())?;
    let referenced = |case| {
        let reference = ToolAnswer::reference(&case)?;
        Ok((case, reference))
    };
    let cases = cases.into_iter().map(referenced);
    let cases = cases.collect::<Result<Vec<_>, Failure>>()?;
    let bar = progress(((ORDERS.len() + 1) * cases.len()) as u64);
    let (_, rows) = on_threads(1, || singles::measure(&cases, || bar.inc(1)))?;
    bar.finish_and_clear();
    let mut rows = rows?;
    for path in &args.answers {
        rows.extend(read_answers(path, &cases)?);
    }
    if let Some(out) = out {
        out.write(text(&rows)?)?;
    }
    let singles = totals(&rows, BASE);
    let mut set_aside = SetAside::default();
    let mut kernel_and_loop = Vec::new();
    let many = if args.singles {
        Vec::new()
    } else {
        let (records, aside) = records(args)?;
        set_aside = aside;
        kernel_and_loop = throughput::against_loop()?;
        let bar = progress(many::STEPS);
        let all = many::measure(&records, &|| bar.inc(1))?;
        bar.finish_and_clear();
        all
    };
    if let Some(out) = table {
        out.write(throughput::text(&many)?)?;
    }
    let found = SpeedSummary {
        isa: Isa::best().name(),
        ratios_to: BASE.join(", "),
        set_aside,
        singles: &singles,
        throughput: many.iter().map(rate).collect(),
        kernel_and_loop,
        peak_memory_mib: peak_memory_mib(),
    };
    let sentence = "Processor times with {isa}, and their ratios to \
                    {ratios_to}.";
    args.json.show(&[sentence], &found)
}

/// The records that are analysed, and what was set aside beside them.
fn records(
    args: &SpeedCommand,
) -> Result<(Vec<NormalisedRecord>, SetAside), Failure> {
    let mut set_aside = SetAside::default();
    if args.suite.is_empty() {
        let suites = StudySuite::embedded()?;
        let motions = suites.iter().flat_map(|suite| &suite.motions);
        let records = motions.map(|m| NormalisedRecord::new(&m.study));
        return Ok((records.collect(), set_aside));
    }
    let mut records = Vec::new();
    for path in &args.suite {
        let suite = read_suite(path, ReadOptions::default())?;
        set_aside.extend(suite.set_aside().all().iter().cloned());
        let members = suite.study_components();
        records
            .extend(members.map(|m| NormalisedRecord::new(&m.accelerogram)));
    }
    Ok((records, set_aside))
}

/// The measurements.
#[derive(Serialize)]
struct SpeedSummary<'a> {
    isa: &'static str,
    ratios_to: String,
    set_aside: SetAside,
    /// Medians over the cases.
    singles: &'a [Total],
    throughput: Vec<Rate<'a>>,
    /// Kernel in lanes beside a loop written by hand.
    kernel_and_loop: Vec<AgainstLoop>,
    peak_memory_mib: Option<f64>,
}

#[derive(Serialize)]
struct Rate<'a> {
    #[serde(flatten)]
    of: &'a Throughput,
    rate_per_cpu_s: f64,
    sample_ns: Option<f64>,
}

fn rate(of: &Throughput) -> Rate<'_> {
    let (rate_per_cpu_s, sample_ns) = (of.rate_per_s(), of.sample_ns());
    Rate { of, rate_per_cpu_s, sample_ns }
}
