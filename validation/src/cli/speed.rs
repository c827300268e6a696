//! `rocking speed`: error against processor time, on this machine.

use std::fmt::Write as _;
use std::path::PathBuf;

use rocking::excitation::NormalisedRecord;
use rocking::integrator::Model;
use rocking::number::dispatch::Isa;
use rocking::record::ReadOptions;
use serde_json::{Value, json};

use super::{Failure, print, print_json, progress};
use crate::curves::Execution;
use crate::files::Output;
use crate::json::{number, optional};
use crate::paper::BLOCKS;
use crate::speed::answers::Answer;
use crate::speed::cases::{self, Case};
use crate::speed::clock::peak_memory_mib;
use crate::speed::measured::{Total, read_answers, text, totals};
use crate::speed::singles::{self, BASE, ORDERS};
use crate::speed::throughput::{self, Job, Throughput, analyses, on_threads};
use crate::speed::{export, many};
use crate::suites::StudySuite;
use crate::suites::inputs::read_suite;

/// Measures speed and error on this machine: thirty single analyses against
/// double-double, and the paper's whole analysis of a suite, in lanes and
/// one analysis at a time.
///
/// It takes some minutes. Times are processor time; they differ from run to run and from machine to
/// machine, errors and work do not.
#[derive(clap::Args)]
pub struct Args {
    /// Suite of the throughput measurement: a folder of records, an index,
    /// or a zip; may be given more than once [default: both embedded suites].
    #[arg(long, value_name = "PATH")]
    suite: Vec<PathBuf>,
    /// The single analyses alone.
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
    /// JSON for machines.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for a suite or an answer that is refused, or a file that
/// cannot be written.
pub fn run(args: &Args) -> Result<(), Failure> {
    let cases = cases::all()?;
    if let Some(folder) = &args.export {
        export::singles(&folder.join("singles"), &cases)?;
        let records = records(args)?;
        let analyses = analyses(&BLOCKS, Model::Nonlinear, None)?;
        let threads = rayon::current_num_threads();
        let way = Execution::default();
        let job = Job { analyses: &analyses, records: &records, way, threads };
        let (_, found) = job.measure("")?;
        for (analysis, found) in analyses.iter().zip(&found) {
            let block = &analysis.block;
            let (p, alpha) =
                (block.frequency_rad_s(), block.slenderness_rad());
            let folder = folder.join(format!("chains/p{p}-a{alpha:.2}"));
            export::chains(&folder, analysis, &records, found)?;
        }
        return Ok(());
    }
    let out = Output::open_some(args.out.as_ref(), &args.answers)?;
    let table = Output::open_some(args.throughput.as_ref(), &args.answers)?;
    let cases = with_references(cases)?;
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
    let many = if args.singles {
        Vec::new()
    } else {
        let records = records(args)?;
        let bar = progress(many::STEPS);
        let all = many::measure(&records, &|| bar.inc(1))?;
        bar.finish_and_clear();
        all
    };
    if let Some(out) = table {
        out.write(throughput::text(&many)?)?;
    }
    let memory = peak_memory_mib();
    if args.json {
        print_json(machine(&singles, &many, memory))
    } else {
        print(&people(&singles, &many, memory))
    }
}

fn with_references(cases: Vec<Case>) -> Result<Vec<(Case, Answer)>, Failure> {
    cases
        .into_iter()
        .map(|case| {
            let reference = Answer::reference(&case)?;
            Ok((case, reference))
        })
        .collect()
}

fn records(args: &Args) -> Result<Vec<NormalisedRecord>, Failure> {
    if !args.suite.is_empty() {
        let mut records = Vec::new();
        for path in &args.suite {
            let suite = read_suite(path, ReadOptions::default())?;
            records.extend(
                suite
                    .study_components()
                    .map(|member| NormalisedRecord::new(&member.accelerogram)),
            );
        }
        return Ok(records);
    }
    Ok(StudySuite::embedded()?
        .iter()
        .flat_map(|suite| &suite.motions)
        .map(|motion| NormalisedRecord::new(&motion.study))
        .collect())
}

fn machine(
    singles: &[Total],
    many: &[Throughput],
    memory: Option<f64>,
) -> Value {
    json!({
        "isa": Isa::best().name(),
        "ratios_to": BASE.join(", "),
        "singles": singles.iter().map(|t| json!({
            "tool": t.label[0],
            "version": t.label[1],
            "method": t.label[2],
            "setting": t.label[3],
            "cases": t.cases,
            "median_ratio": number(t.ratio),
            "median_cpu_s": number(t.cpu_s),
            "mean_cpu_s": number(t.mean_cpu_s),
            "median_work": number(t.work),
            "median_peak_error": number(t.peak_error),
            "peak_error_90": number(t.peak_error_90),
            "median_impact_error_s": number(t.impact_error_s),
            "wrong_fates": t.wrong_fates,
            "other_impacts": t.other_impacts,
        })).collect::<Vec<_>>(),
        "throughput": many.iter().map(|t| json!({
            "work": t.work,
            "threads": t.threads,
            "cpu_s": number(t.cpu_s),
            "count": t.count,
            "rate_per_cpu_s": number(t.rate_per_s()),
            "samples": t.samples,
            "sample_ns": optional(t.sample_ns()),
            "moved_chains": t.moved,
        })).collect::<Vec<_>>(),
        "peak_memory_mib": optional(memory),
    })
}

fn people(
    singles: &[Total],
    many: &[Throughput],
    memory: Option<f64>,
) -> String {
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "Single analyses, {}: medians over {} cases\n\n{:<44} {:>9} {:>10} \
         {:>8} {:>10} {:>10} {:>10} {:>6} {:>7}",
        Isa::best().name(),
        singles.first().map_or(0, |t| t.cases),
        "method",
        "ratio",
        "CPU s",
        "work",
        "peak error",
        "90 %",
        "impact s",
        "fates",
        "impacts"
    );
    for t in singles {
        let [tool, version, method, setting] = &t.label;
        let _ = writeln!(
            out,
            "{:<44} {:>9.3} {:>10.2e} {:>8} {:>10.1e} {:>10.1e} {:>10.1e} \
             {:>6} {:>7}",
            format!("{tool} {version}, {method}, {setting}"),
            t.ratio,
            t.cpu_s,
            t.work,
            t.peak_error,
            t.peak_error_90,
            t.impact_error_s,
            t.wrong_fates,
            t.other_impacts
        );
    }
    let _ = writeln!(
        out,
        "\nfates: wrong ones; impacts: cases with another number of them; \
         moved: chains\nwith another first overturning level"
    );
    if !many.is_empty() {
        let _ = writeln!(
            out,
            "\n{:<44} {:>7} {:>9} {:>9} {:>12} {:>9} {:>6}",
            "work",
            "threads",
            "CPU s",
            "number",
            "per CPU s",
            "ns/sample",
            "moved"
        );
    }
    for t in many {
        let _ = writeln!(
            out,
            "{:<44} {:>7} {:>9.3} {:>9} {:>12.0} {:>9} {:>6}",
            t.work,
            t.threads,
            t.cpu_s,
            t.count,
            t.rate_per_s(),
            t.sample_ns().map_or(String::new(), |ns| format!("{ns:.2}")),
            t.moved.map_or(String::new(), |n| n.to_string())
        );
    }
    if let Some(memory) = memory {
        let _ = writeln!(out, "\npeak memory {memory:.0} MiB");
    }
    out
}
