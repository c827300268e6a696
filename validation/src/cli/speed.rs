//! `rocking speed`: error against processor time, on this machine.

use std::fmt::Write as _;
use std::path::PathBuf;

use rocking::excitation::NormalisedRecord;
use rocking::integrator::Model;
use rocking::number::dispatch::Isa;
use rocking::record::{Accelerogram, ReadOptions};
use serde_json::{Value, json};

use super::{Failure, note, print, print_json, progress};
use rocking_common::curves::Execution;
use rocking_common::files::Outputs;
use rocking_common::paper::BLOCKS;
use rocking_common::suites::StudySuite;
use rocking_common::suites::inputs::read_suite;
use rocking_report::speed::answers::Answer;
use rocking_report::speed::cases::{self, Case};
use rocking_report::speed::clock::peak_memory_mib;
use rocking_report::speed::measured::{Total, read_answers, text, totals};
use rocking_report::speed::scale::{self, Axis, growth};
use rocking_report::speed::singles::{self, BASE, ORDERS};
use rocking_report::speed::throughput::{
    self, Job, Throughput, analyses, on_threads,
};
use rocking_report::speed::{export, many};

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
    /// How time and memory grow with records, samples and blocks, alone.
    #[arg(long, conflicts_with_all = ["suite", "singles"])]
    scale: bool,
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
    /// One size of one axis of `--scale`, as JSON.
    #[arg(long, value_name = "AXIS", hide = true, requires = "size")]
    scale_point: Option<Axis>,
    /// The size of it.
    #[arg(long, value_name = "N", hide = true)]
    size: Option<usize>,
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
    if let (Some(axis), Some(size)) = (args.scale_point, args.size) {
        let point = scale::point(axis, size, &motions()?)?;
        return print(&format!("{}\n", serde_json::to_value(point)?));
    }
    if args.scale {
        return scaled(args.json);
    }
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
    let mut outputs = Outputs::of(args.answers.clone());
    let out = outputs.open_some(args.out.as_ref())?;
    let table = outputs.open_some(args.throughput.as_ref())?;
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
            if !suite.set_aside().is_empty() {
                note(&format!("set aside: {}", suite.set_aside()));
            }
            records.extend(
                suite
                    .study_components()
                    .map(|member| NormalisedRecord::new(&member.accelerogram)),
            );
        }
        return Ok(records);
    }
    Ok(motions()?.iter().map(NormalisedRecord::new).collect())
}

/// The embedded motions that the study uses.
fn motions() -> Result<Vec<Accelerogram>, Failure> {
    let suites = StudySuite::embedded()?;
    let motions = suites.into_iter().flat_map(|suite| suite.motions);
    Ok(motions.map(|motion| motion.study).collect())
}

/// Measures, and prints, how time and memory grow.
fn scaled(json: bool) -> Result<(), Failure> {
    let sizes = Axis::ALL.map(|axis| axis.sizes().len());
    let bar = progress(sizes.iter().sum::<usize>() as u64);
    let points = scale::measure(&|| bar.inc(1))?;
    bar.finish_and_clear();
    let mut rows = Vec::new();
    for own in points.chunk_by(|a, b| a.axis == b.axis) {
        for (k, point) in own.iter().enumerate() {
            let grown = (k > 1).then(|| growth(&own[0], &own[k - 1], point));
            rows.push((point, grown));
        }
    }
    if json {
        return print_json(json!({
            "isa": Isa::best().name(),
            "threads": rayon::current_num_threads(),
            "scale": rows.iter().map(|(point, grown)| json!({
                "axis": point.axis,
                "size": point.size,
                "analyses": point.analyses,
                "cpu_s": point.cpu_s,
                "peak_memory_mib": point.peak_memory_mib,
                "time_exponent": grown.map(|g| g.time),
                "memory_exponent": grown.and_then(|g| g.memory),
            })).collect::<Vec<_>>(),
        }));
    }
    let mut out = format!(
        "Growth with records (p = 3, alpha = 0.15), samples (15 blocks, \
          whole runs) and blocks (8 records), {}, {} threads\n\n\
         axis          size  analyses     CPU s  peak MiB    time ~  \
         memory ~\n",
        Isa::best().name(),
        rayon::current_num_threads(),
    );
    let two = |x: Option<f64>| x.map_or(String::new(), |x| format!("{x:.2}"));
    for (point, grown) in rows {
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "{:<8} {:>9} {:>9} {:>9.3} {:>9} {:>9} {:>9}",
            point.axis.to_string(),
            point.size,
            point.analyses,
            point.cpu_s,
            point.peak_memory_mib.map_or(String::new(), |m| format!("{m:.0}")),
            two(grown.map(|g| g.time)),
            two(grown.and_then(|g| g.memory)),
        );
    }
    out.push_str(
        "\n~: exponent between this size and the one before; of memory, \
         beyond that of size 0\n",
    );
    print(&out)
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
            "median_ratio": t.ratio,
            "median_cpu_s": t.cpu_s,
            "mean_cpu_s": t.mean_cpu_s,
            "median_work": t.work,
            "median_peak_error": t.peak_error,
            "peak_error_90": t.peak_error_90,
            "median_impact_error_s": t.impact_error_s,
            "wrong_fates": t.wrong_fates,
            "other_impacts": t.other_impacts,
        })).collect::<Vec<_>>(),
        "throughput": many.iter().map(|t| json!({
            "work": t.work,
            "threads": t.threads,
            "cpu_s": t.cpu_s,
            "count": t.count,
            "rate_per_cpu_s": t.rate_per_s(),
            "samples": t.samples,
            "sample_ns": t.sample_ns(),
            "moved_chains": t.moved,
        })).collect::<Vec<_>>(),
        "peak_memory_mib": memory,
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
        "Single analyses, {}: medians over {} cases\n\n\
         method                                           ratio      \
         CPU s     work peak error       90 %   impact s  fates impacts",
        Isa::best().name(),
        singles.first().map_or(0, |t| t.cases),
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
            "\nwork                                         threads     \
             CPU s    number    per CPU s ns/sample  moved"
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
