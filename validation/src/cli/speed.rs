//! `rocking speed`: error against processor time, on this machine.

use std::fmt::Write as _;
use std::path::PathBuf;

use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::integrator::Model;
use rocking::number::dispatch::Isa;
use rocking::record::ReadOptions;
use serde_json::{Value, json};

use super::{Failure, print, progress};
use crate::files::write_atomically;
use crate::inputs::read_suite;
use crate::json::{number, optional};
use crate::speed::answers::Answer;
use crate::speed::cases::{self, Case};
use crate::speed::clock::peak_memory_mib;
use crate::speed::measured::{Total, read_answers, text, totals};
use crate::speed::singles::{BASE, ORDERS};
use crate::speed::throughput::{
    self, Throughput, analyses, at_order, in_lanes, kernel, lilliefors,
    on_threads, one_by_one, samples_of,
};
use crate::speed::{export, singles};
use crate::study::grid::blocks;
use crate::study::suites::StudySuite;

/// Measures speed and error on this machine: thirty single analyses against
/// double-double, and the paper's whole analysis of a suite, in lanes and
/// one analysis at a time.
///
/// It takes some minutes. Times are processor time; they differ from run to run and from machine to
/// machine, errors and work do not.
#[derive(clap::Args)]
pub struct Args {
    /// Suite of the throughput measurement: a folder of records, an index,
    /// or a zip [default: both embedded suites].
    #[arg(long, value_name = "PATH")]
    suite: Option<PathBuf>,
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
        conflicts_with_all = ["suite", "singles", "out", "throughput", "answers", "json"]
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
        let (block, records) = (middle()?, records(args)?);
        let analyses = analyses(&[block], Model::Nonlinear)?;
        let (_, found) = in_lanes("", 1, &records, &analyses)?;
        for (analysis, found) in analyses.iter().zip(&found) {
            let folder = folder.join("chains");
            export::chains(&folder, analysis, &records, found)?;
        }
        return Ok(());
    }
    let cases = with_references(cases)?;
    let bar = progress(((ORDERS.len() + 1) * cases.len()) as u64);
    let (_, rows) = on_threads(1, || singles::measure(&cases, || bar.inc(1)))?;
    bar.finish_and_clear();
    let mut rows = rows?;
    for path in &args.answers {
        rows.extend(read_answers(path, &cases)?);
    }
    if let Some(path) = &args.out {
        write_atomically(path, text(&rows)?)?;
    }
    let singles = totals(&rows, BASE);
    let many = if args.singles { Vec::new() } else { many(args)? };
    if let Some(path) = &args.throughput {
        write_atomically(path, throughput::text(&many)?)?;
    }
    let memory = peak_memory_mib();
    if args.json {
        print(&format!("{}\n", machine(&singles, &many, memory)))
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
    if let Some(path) = &args.suite {
        let suite = read_suite(path, ReadOptions::default())?;
        return Ok(suite
            .study_components()
            .map(|member| NormalisedRecord::new(&member.accelerogram))
            .collect());
    }
    Ok(StudySuite::embedded()?
        .iter()
        .flat_map(|suite| &suite.motions)
        .map(|motion| NormalisedRecord::new(&motion.study))
        .collect())
}

/// The block in the middle of the fifteen, for comparisons with tools that
/// would take hours for all.
fn middle() -> Result<Block, Failure> {
    Ok(Block::try_new(0.15, 3.0)?)
}

/// Everything that takes many analyses.
fn many(args: &Args) -> Result<Vec<Throughput>, Failure> {
    let records = records(args)?;
    let blocks = blocks()?;
    let bar = progress(16);
    let mut all = vec![
        kernel("kernel in lanes, Eq. 1, order 9", Model::Nonlinear, 1e-3)?,
        kernel("kernel in lanes, Eq. 1, order 13", Model::Nonlinear, 0.061)?,
        kernel("kernel in lanes, Eq. 2", Model::Linearized, 1e-3)?,
    ];
    bar.inc(3);
    let one = analyses(&[middle()?], Model::Nonlinear)?;
    let name = |how: &str| format!("p = 3, alpha = 0.15, {how}");
    all.push(in_lanes(&name("in lanes"), 1, &records, &one)?.0);
    all.push(one_by_one(&name("one by one"), &records, &one)?);
    bar.inc(2);
    let threads = rayon::current_num_threads();
    for (model, words) in
        [(Model::Nonlinear, "Eq. 1"), (Model::Linearized, "Eq. 2")]
    {
        let analyses = analyses(&blocks, model)?;
        let name = |how: &str| format!("15 blocks, {words}, {how}");
        let (mut lanes, found) =
            in_lanes(&name("in lanes"), 1, &records, &analyses)?;
        bar.inc(1);
        let steps = Some(samples_of(&records, &analyses, &found)?);
        let mut each = one_by_one(&name("one by one"), &records, &analyses)?;
        bar.inc(1);
        lanes.samples = steps;
        each.samples = steps;
        all.push(lanes);
        all.push(each);
        let orders = ORDERS.iter().filter(|_| model == Model::Nonlinear);
        for (setting, order) in orders {
            let Some(order) = *order else { continue };
            let name = name(&format!("one by one, {setting}"));
            all.push(at_order(&name, &records, &analyses, &found, order)?);
            bar.inc(1);
        }
        if threads > 1 {
            let name = name("in lanes");
            let (mut own, _) = in_lanes(&name, threads, &records, &analyses)?;
            own.samples = steps;
            all.push(own);
        }
        bar.inc(1);
    }
    all.push(lilliefors()?);
    bar.finish_and_clear();
    Ok(all)
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
