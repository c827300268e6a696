//! `rocking ida`: incremental dynamic analysis of a suite.

mod forces;

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use clap::ValueEnum;
use rocking::block::Block;
use rocking::capacity::ResponseCurve;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{
    Adjust, Analysis, BracketEnd, Grid, HIGHEST_IM, IdaCurve, REFINEMENT,
    Resurrections,
};
use rocking::integrator::{Extent, Model, Order, WorkLimit, uplift_threshold};
use rocking_procedures::{
    IdaSummary, PivotForces, StripeResponses, summarise_ida,
};
use rocking_records::intensity::Intensity;
use rocking_records::{Profile, RemarkInput, SetAside, Suite, SuiteMember};
use serde::Serialize;

use self::forces::ForcesArgs;
use super::limit::{LimitArgs, curve_refused};
use super::names;
use super::processing::{RecordArgs, words};
use super::scene::{BlockArgs, ModelArgs};
use super::shared::{JsonArg, PlotArg, ThreadsArg, positive};
use super::way::WayArgs;
use crate::failure::{Failure, ensure};
use crate::terminal::{SOFTWARE, logged, progress};
use rocking_common::files::{Output, Outputs};
use rocking_common::suites::inputs::{BLOCK_SAMPLES, SuiteInput, files};
use rocking_common::suites::remarks::Remarks;
use rocking_common::suites::{clusters, earthquakes};
use rocking_common::table::body;
use rocking_common::words::rounded;
use rocking_draw::figures::common;
use rocking_draw::figures::of_suite::ida_svg;
use rocking_exchange::ida::IdaTable;

/// Steps of the quantiles that are drawn.
const STEPS: usize = 100;

/// Incremental dynamic analysis of every record of a suite.
#[derive(clap::Args)]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw the curves with their 16, 50 and 84 % quantiles"
)))]
#[command(after_help = "Examples:\n  \
    rocking ida --alpha 0.1 --p 3 --suite records/ --out ida.csv\n  \
    rocking ida --width-m 0.5 --height-m 1.8 --eta housner \
    --suite index.csv --out ida.csv")]
pub struct IdaCommand {
    #[command(flatten)]
    block: BlockArgs,
    #[command(flatten)]
    model: ModelArgs,
    /// Folder of records, index CSV, zip, or one record file.
    #[arg(long, value_name = "PATH")]
    suite: PathBuf,
    #[command(flatten)]
    input: RecordArgs,
    /// Step of the levels in PGA, g [default: 0.01].
    #[arg(long, value_name = "G", conflicts_with = "step_im")]
    step_g: Option<f64>,
    /// Step of the levels in PGA/(g tan alpha), from 1.
    #[arg(long, value_name = "X")]
    step_im: Option<f64>,
    /// Width in IM to which the first overturning is bisected, or `none`
    /// [default: 1e-4].
    #[arg(long, value_name = "TOL|none", value_parser = refine)]
    refine: Option<Refine>,
    /// How intensity is reached.
    #[arg(
        long,
        value_parser = names::adjustment(),
        default_value_t = Adjust::RecordScaling
    )]
    by: Adjust,
    /// Continue above the first overturning and find the levels at which the
    /// block survives again: up to this IM or, without a number, up to 3 times
    /// the first overturning.
    #[arg(long, value_name = "IM", num_args = 0..=1)]
    resurrections_to: Option<Option<f64>>,
    /// Which components of the pairs.
    #[arg(long, value_enum, default_value_t = ComponentChoice::Study)]
    component: ComponentChoice,
    /// Settle outcome and peak of each analysis with sufficient precision:
    /// double-double if double precision does not suffice, then octuple;
    /// without it, such analyses are flagged `unresolved`.
    #[arg(long)]
    certify: bool,
    /// Order of the Taylor polynomial of Eq. 1, for a table that no command
    /// reads [default: as high as each step needs for double precision].
    #[arg(
        long,
        value_parser = names::order(),
        conflicts_with_all = ["certify", "forces", "friction"]
    )]
    order: Option<Order>,
    #[command(flatten)]
    threads: ThreadsArg,
    #[command(flatten)]
    forces: ForcesArgs,
    #[command(flatten)]
    way: WayArgs,
    /// About how many samples the records of one block have; results do not
    /// depend on it.
    #[arg(long, value_name = "N", hide = true, default_value_t = BLOCK_SAMPLES)]
    block_samples: usize,
    #[command(flatten)]
    limit: LimitArgs,
    /// Table; `-` is standard output, with the summary on standard error.
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,
    #[command(flatten)]
    plot: PlotArg,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum ComponentChoice {
    /// The component that the suite marks for the study.
    Study,
    /// The component of each pair whose file name sorts first.
    First,
    /// The other one.
    Second,
    /// All.
    Both,
}

/// Runs `rocking ida`.
///
/// # Errors
/// [`Failure`] for bad input; no file is written then.
pub fn run_ida(args: &IdaCommand) -> Result<(), Failure> {
    // All of it: a signal that stops it finds the threads that heed it.
    args.threads.run(|| in_threads(args))?
}

fn in_threads(args: &IdaCommand) -> Result<(), Failure> {
    let gravity_m_s2 = args.model.gravity_m_s2;
    let block = args.block.block(gravity_m_s2)?;
    let analysis = args.analysis(block)?;
    args.way.way()?;
    let read = args.input.reading.options(gravity_m_s2);
    let processing = args.input.processing()?;
    let (place, block) = (&args.suite, args.block_samples);
    let (input, suite) =
        SuiteInput::read::<Failure>(place, read, &processing, block)?;
    let mut outputs = Outputs::of(files(&args.suite, &suite));
    let out = outputs.open(&args.out)?;
    let forces_out = outputs.open_some(args.forces.forces.as_ref())?;
    let plot = args.plot.open(&mut outputs)?;
    let chosen = args.chosen(&suite)?;
    let remarked = chosen.iter().map(|member| RemarkInput::from(*member));
    let remarks = Remarks::of(&remarked.collect::<Vec<_>>());
    args.input.reading.judge(suite.set_aside(), &remarks)?;
    let events = chosen
        .iter()
        .map(|m| (m.accelerogram.name(), m.event.as_deref().unwrap_or("")));
    let done = words(&processing);
    let report = IdaReport {
        suite: suite.name(),
        earthquakes: earthquakes(&clusters(&chosen)),
        study_components: suite.study_rule().to_string(),
        processing: done.as_deref(),
        remarks: &remarks,
        set_aside: suite.set_aside(),
        highest_im: HIGHEST_IM,
        order: args.order,
        summary: summarise_ida(&[], &analysis),
        pivot: None,
    };
    let mut work = IdaRun {
        args,
        analysis: &analysis,
        report,
        events: events.collect(),
        bar: progress(chosen.len() as u64),
        out,
        forces_out,
        curves: plot.is_some().then(Vec::new),
    };
    let mut block = Vec::new();
    let mut samples = 0;
    input.each(&chosen, |record, _| {
        samples += record.samples_g().len();
        block.push(NormalisedRecord::new(record));
        if samples < args.block_samples {
            return Ok(());
        }
        samples = 0;
        work.run(&std::mem::take(&mut block))
    })?;
    work.run(&block)?;
    work.bar.finish_and_clear();
    work.out.finish()?;
    if let Some(out) = work.forces_out {
        out.finish()?;
    }
    if let Some(out) = plot {
        out.write(svg(&work.curves.unwrap_or_default(), &analysis)?)?;
    }
    let sentences = [
        "The block overturns under {overturned_curves} of {records} records; \
         the median PGA/(g tan alpha) at which it does is \
         {median_overturning_im}.",
        "The block overturns under {overturned_curves} of {records} records.",
    ];
    args.json.summarise(&outputs, &sentences, &work.report)
}

/// A suite that is worked off in blocks of records.
struct IdaRun<'a> {
    args: &'a IdaCommand,
    analysis: &'a Analysis,
    report: IdaReport<'a>,
    /// Earthquakes of the records; empty if the index names none.
    events: BTreeMap<&'a str, &'a str>,
    bar: indicatif::ProgressBar,
    out: Output,
    forces_out: Option<Output>,
    /// The curves, if they are drawn.
    curves: Option<Vec<ResponseCurve>>,
}

impl IdaRun<'_> {
    /// Runs the next records and writes their rows.
    fn run(&mut self, records: &[NormalisedRecord]) -> Result<(), Failure> {
        let Self { args, analysis, bar, .. } = self;
        let way = args.way.way()?;
        let only = std::slice::from_ref(*analysis);
        let curves = logged(bar, || way.curves(records, only, &|| bar.inc(1)))
            .map_err(curve_refused)?;
        let table: Vec<IdaCurve> = curves.into_iter().flatten().collect();
        let pivot = args
            .forces
            .pivot(records, &table, analysis)
            .map_err(curve_refused)?;
        let known = |record: &str| {
            let event = self.events.get(record).copied().unwrap_or_default();
            (self.report.remarks.codes(record), event.to_owned())
        };
        let processing = self.report.processing.unwrap_or("none");
        let about = (processing, SOFTWARE);
        let gravity_m_s2 = args.model.gravity_m_s2;
        let rows = IdaTable::of(&table, analysis, gravity_m_s2, about, known);
        let is_first = self.report.summary.records == 0;
        // The header is written once.
        let part = |text: String| match is_first {
            true => text,
            false => body(&text).to_owned(),
        };
        self.out.add(part(rows.csv()))?;
        if let Some(pivot) = pivot {
            if let Some(out) = &mut self.forces_out {
                out.add(part(forces::csv(&pivot, &table)))?;
            }
            match &mut self.report.pivot {
                None => self.report.pivot = Some(pivot),
                Some(all) => all.add(pivot),
            }
            if let Some(all) = &mut self.report.pivot {
                all.curves.clear();
            }
        }
        if let Some(drawn) = &mut self.curves {
            for curve in &table {
                drawn.push(curve.response(BracketEnd::Refined)?);
            }
        }
        self.report.summary.add(&table);
        Ok(())
    }
}

/// The curves with their quantiles.
fn svg(
    curves: &[ResponseCurve],
    analysis: &Analysis,
) -> Result<String, Failure> {
    let stripes = StripeResponses::over(curves, STEPS)?;
    let block = format!(
        "{}, {}, *g* tan *α* = {:.3} *g*",
        common::slenderness(analysis.block.slenderness_rad()),
        common::frequency(rounded(analysis.block.frequency_rad_s(), 4)),
        uplift_threshold(&analysis.block, analysis.model)
    );
    let axis = Intensity::Pga.row().label;
    Ok(ida_svg(curves, &stripes, (axis, &block)))
}

/// The result of a table.
#[derive(Serialize)]
struct IdaReport<'a> {
    suite: &'a str,
    /// Earthquakes of the records; `None` if the index names none.
    earthquakes: Option<usize>,
    study_components: String,
    processing: Option<&'a str>,
    remarks: &'a Remarks,
    set_aside: &'a SetAside,
    highest_im: f64,
    order: Option<Order>,
    #[serde(flatten)]
    summary: IdaSummary,
    pivot: Option<PivotForces>,
}

impl IdaCommand {
    fn analysis(&self, block: Block) -> Result<Analysis, Failure> {
        let grid = match (self.step_im, self.step_g) {
            (Some(step), _) => Grid::Im { step },
            (None, step_g) => Grid::Pga { step_g: step_g.unwrap_or(0.01) },
        };
        let resurrections = self.resurrections_to.map(|to| match to {
            Some(im) => Resurrections::To(im),
            None => Resurrections::Multiple(3.0),
        });
        let model = self.model.model;
        ensure!(
            self.order.is_none() || model == Model::Nonlinear,
            "--order is for Eq. 1, not for --model linearized"
        );
        Ok(Analysis {
            block,
            restitution: self.model.eta.restitution(&block)?,
            model,
            overturning: self.model.overturn,
            grid,
            adjust: self.by,
            refine: self.refine.unwrap_or(Some(REFINEMENT)),
            highest_im: HIGHEST_IM,
            resurrections,
            order: self.order,
            certify: self.certify,
            extent: Extent::Peak,
            work_limit: self.limit.limit(WorkLimit::IDA),
        })
    }

    /// The records of the chosen component, in the suite's order.
    fn chosen<'s>(
        &self,
        suite: &'s Suite<Profile>,
    ) -> Result<Vec<&'s SuiteMember<Profile>>, Failure> {
        let first = self.component == ComponentChoice::First;
        let of_pair = suite.both().into_iter().map(|(a, b)| {
            let in_order = a.file <= b.file;
            if in_order == first { &a.accelerogram } else { &b.accelerogram }
        });
        let of_pairs: BTreeSet<&str> = of_pair.map(Profile::name).collect();
        let is_chosen = |member: &&SuiteMember<Profile>| match self.component {
            ComponentChoice::Study => member.study_component,
            ComponentChoice::Both => true,
            _ => of_pairs.contains(member.accelerogram.name()),
        };
        let chosen: Vec<_> =
            suite.members().iter().filter(is_chosen).collect();
        ensure!(
            !chosen.is_empty(),
            "{}: no record of this component",
            self.suite.display()
        );
        Ok(chosen)
    }
}

/// Width to which the first overturning is bisected, if it is.
type Refine = Option<f64>;

fn refine(text: &str) -> Result<Refine, String> {
    match positive(text) {
        _ if text == "none" => Ok(None),
        Ok(width) => Ok(Some(width)),
        Err(expected) => Err(format!("{expected}, or none")),
    }
}
