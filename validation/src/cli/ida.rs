//! `rocking ida`: incremental dynamic analysis of a suite.

mod refine;

use std::fmt::Write as _;
use std::path::PathBuf;

use clap::ValueEnum;
use rocking::block::Block;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{
    Adjust, Analysis, Certification, Grid, HIGHEST_IM, IdaCurve, IdaPoint,
    REFINEMENT, Resurrections,
};
use rocking::integrator::WorkLimit;
use rocking::record::{ReadOptions, Suite};
use serde_json::json;

use refine::Refine;

use super::limit::{LimitArgs, curve_refused};
use super::order::OrderName;
use super::processing::{ProcessingArgs, words};
use super::respond::outcome_name;
use super::scene::{BlockArgs, ModelArgs};
use super::way::WayArgs;
use super::{Failure, csv_text, print, progress, with_threads};
use crate::files::write_atomically;
use crate::inputs::read_suite;
use crate::json::{number, optional};

/// Incremental dynamic analysis of every record of a suite.
#[derive(clap::Args)]
pub struct Args {
    #[command(flatten)]
    block: BlockArgs,
    #[command(flatten)]
    model: ModelArgs,
    /// Folder of records, or index CSV.
    #[arg(long, value_name = "PATH")]
    suite: PathBuf,
    #[command(flatten)]
    processing: ProcessingArgs,
    /// Step of the levels in PGA, g [default: 0.01].
    #[arg(
        long,
        value_name = "G",
        conflicts_with = "step_im",
        allow_negative_numbers = true
    )]
    step_g: Option<f64>,
    /// Step of the levels in PGA/(g tan alpha), from 1.
    #[arg(long, value_name = "X", allow_negative_numbers = true)]
    step_im: Option<f64>,
    /// Width in IM to which the first overturning is bisected, or `none`
    /// [default: 1e-4].
    #[arg(long, value_name = "TOL|none", allow_negative_numbers = true)]
    refine: Option<Refine>,
    /// How intensity is reached.
    #[arg(long, value_enum, default_value_t = By::RecordScaling)]
    by: By,
    /// Go on above the first overturning and look where the block stands
    /// again: to this IM, or, without a number, to 3 times the first
    /// overturning.
    #[arg(
        long,
        value_name = "IM",
        num_args = 0..=1,
        allow_negative_numbers = true
    )]
    resurrections_to: Option<Option<f64>>,
    /// Which components of the pairs.
    #[arg(long, value_enum, default_value_t = Component::Study)]
    component: Component,
    /// Tell outcome and peak of each analysis in the precision that they
    /// need: double-double where double precision cannot, octuple precision
    /// beyond; without it such analyses are flagged `unresolved`.
    #[arg(long)]
    certify: bool,
    /// Step Eq. 1 at this order of the Taylor polynomial, whatever it leaves
    /// [default: as high as each step needs for double precision].
    #[arg(long, value_enum, conflicts_with = "certify")]
    order: Option<OrderName>,
    /// Threads [default: all].
    #[arg(long, value_name = "N")]
    threads: Option<usize>,
    #[command(flatten)]
    way: WayArgs,
    #[command(flatten)]
    limit: LimitArgs,
    /// Where the table goes.
    #[arg(long, value_name = "FILE.csv")]
    out: PathBuf,
    /// JSON summary for machines.
    #[arg(long)]
    json: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum By {
    /// Scale the record.
    RecordScaling,
    /// Keep the record and adjust alpha.
    SlendernessAdjustment,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
enum Component {
    /// The component that the suite marks for the study.
    Study,
    /// The component of each pair whose file name sorts first.
    First,
    /// The other one.
    Second,
    /// All.
    Both,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for bad input; no file is written then.
pub fn run(args: &Args) -> Result<(), Failure> {
    let gravity_m_s2 = args.model.gravity_m_s2()?;
    let block = args.block.block(gravity_m_s2)?;
    let analysis = args.analysis(block)?;
    let way = args.way.way()?;
    let read = ReadOptions { gravity_m_s2, ..ReadOptions::default() };
    let processing = args.processing.processing()?;
    let suite = read_suite(&args.suite, read)?.processed(&processing)?;
    let records = args.records(&suite)?;
    let bar = progress(records.len() as u64);
    let curves = with_threads(args.threads, || {
        let only = std::slice::from_ref(&analysis);
        way.curves(&records, only, &|| bar.inc(1))
    })?
    .map_err(curve_refused)?;
    let table: Vec<IdaCurve> = curves.into_iter().flatten().collect();
    bar.finish_and_clear();
    write_atomically(&args.out, csv(&table, &analysis, gravity_m_s2))?;
    let text = if args.json {
        summary_json(args, &table, &suite, words(&processing))
    } else {
        summary(args, &table, &suite, words(&processing))
    };
    print(&text)
}

impl Args {
    fn analysis(&self, block: Block) -> Result<Analysis, Failure> {
        let grid = match (self.step_im, self.step_g) {
            (Some(step), _) => Grid::Im { step },
            (None, step_g) => Grid::Pga { step_g: step_g.unwrap_or(0.01) },
        };
        let resurrections = self.resurrections_to.map(|to| match to {
            Some(im) => Resurrections::To(im),
            None => Resurrections::Multiple(3.0),
        });
        let model = self.model.model();
        Ok(Analysis {
            block,
            restitution: self.model.restitution(&block)?,
            model,
            overturning: self.model.overturning(),
            grid,
            adjust: match self.by {
                By::RecordScaling => Adjust::RecordScaling,
                By::SlendernessAdjustment => Adjust::SlendernessAdjustment,
            },
            refine: self.refine.map_or(Some(REFINEMENT), Refine::width),
            highest_im: HIGHEST_IM,
            resurrections,
            order: self.order.map(|name| name.order(model)).transpose()?,
            certify: self.certify,
            work_limit: self.limit.limit(WorkLimit::IDA),
        })
    }

    fn records(
        &self,
        suite: &Suite,
    ) -> Result<Vec<NormalisedRecord>, Failure> {
        let mut chosen: Vec<_> = match self.component {
            Component::Study => suite.study_components().collect(),
            Component::Both => suite.members().iter().collect(),
            Component::First | Component::Second => suite
                .both()
                .into_iter()
                .map(|(a, b)| {
                    let in_order = a.file <= b.file;
                    let first = self.component == Component::First;
                    if in_order == first { a } else { b }
                })
                .collect(),
        };
        if chosen.is_empty() {
            return Err(Failure::input(format!(
                "{}: no record of the component asked for",
                self.suite.display()
            )));
        }
        chosen.dedup_by(|a, b| a.file == b.file);
        Ok(chosen
            .iter()
            .map(|member| NormalisedRecord::new(&member.accelerogram))
            .collect())
    }
}

/// The table: one row an analysis, by record, then level.
fn csv(table: &[IdaCurve], analysis: &Analysis, gravity_m_s2: f64) -> String {
    let mut text = String::from(
        "record,alpha_rad,p_rad_s,pga_g,pgv_m_s,im_pga,im_pgv,edp,outcome,\
         margin\n",
    );
    let p = analysis.block.frequency_rad_s();
    for curve in table {
        let mut row = |point: &IdaPoint, outcome: &str| {
            let pgv_m_s = point.pga_g * curve.velocity_ratio_s * gravity_m_s2;
            // Writing to a string cannot fail.
            let _ = writeln!(
                text,
                "{},{},{},{},{},{},{},{},{},{}",
                csv_text(&curve.record),
                point.slenderness_rad,
                p,
                point.pga_g,
                pgv_m_s,
                point.im,
                point.im * curve.velocity_factor(p),
                point.edp(),
                outcome,
                point.fate_margin
            );
        };
        row(&curve.onset, "no-uplift");
        for point in curve.points.iter().chain(&curve.above) {
            row(point, outcome_name(&point.outcome, point.told.resolved));
        }
        let refined = curve.overturning.and_then(|first| first.refined);
        if let Some(point) = refined {
            row(&point, "overturned-refined");
        }
    }
    text
}

/// Median first overturning intensity, counting the curves that stand as
/// infinite.
fn median_overturning(table: &[IdaCurve]) -> Option<f64> {
    let mut all: Vec<f64> = table
        .iter()
        .map(|c| c.overturning.map_or(f64::INFINITY, |first| first.im()))
        .collect();
    all.sort_by(f64::total_cmp);
    let n = all.len();
    match n {
        0 => None,
        n if n % 2 == 1 => Some(all[n / 2]),
        _ => Some(0.5 * (all[n / 2 - 1] + all[n / 2])),
    }
}

struct Counts {
    analyses: u64,
    overturned: usize,
    certification: Certification,
    resurrections: usize,
}

fn counts(table: &[IdaCurve]) -> Counts {
    let mut certification = Certification::default();
    for curve in table {
        certification.add(&curve.certification);
    }
    Counts {
        analyses: table.iter().map(|c| c.analyses).sum(),
        overturned: table.iter().filter(|c| c.overturning.is_some()).count(),
        certification,
        resurrections: table.iter().map(IdaCurve::resurrections).sum(),
    }
}

fn summary_json(
    args: &Args,
    table: &[IdaCurve],
    suite: &Suite,
    processing: Option<String>,
) -> String {
    let counts = counts(table);
    let told = counts.certification;
    let sought = args.resurrections_to.is_some();
    let all = json!({
        "suite": suite.name(),
        "processing": processing,
        "records": table.len(),
        "study_components": suite.study_rule().to_string(),
        "order": args.order.map(OrderName::name),
        "analyses": counts.analyses,
        "overturned_curves": counts.overturned,
        "median_overturning_im": optional(median_overturning(table)),
        "unresolved": told.unresolved,
        "certified": args.certify.then(|| json!({
            "assessed": told.assessed,
            "by_double": told.double,
            "by_double_double": told.double_double,
            "by_octuple": told.octuple,
            "unresolved": told.unresolved,
            "fates_moved": told.moved,
            "for_these_doubles_only": told.only_these_doubles,
        })),
        "resurrections": sought.then_some(counts.resurrections),
        "curves": table.iter().map(|c| json!({
            "record": c.record,
            "levels": c.points.len(),
            "overturning_im":
                c.overturning.map(|first| number(first.im())),
        })).collect::<Vec<_>>(),
    });
    format!("{all}\n")
}

fn summary(
    args: &Args,
    table: &[IdaCurve],
    suite: &Suite,
    processing: Option<String>,
) -> String {
    let counts = counts(table);
    let mut text = String::new();
    let mut row = |name: &str, value: String| {
        let _ = writeln!(text, "{name:<24}{value}");
    };
    row("suite", suite.name().to_owned());
    if let Some(words) = processing {
        row("processing", words);
    }
    row("records", table.len().to_string());
    row("study components", suite.study_rule().to_string());
    if let Some(order) = args.order {
        row("order", format!("{}, whatever it leaves", order.name()));
    }
    row("analyses", counts.analyses.to_string());
    row("overturned", format!("{} of {}", counts.overturned, table.len()));
    if let Some(median) = median_overturning(table) {
        row("median overturning IM", format!("{median:.4}"));
    }
    let told = counts.certification;
    if args.certify {
        row("assessed", format!("{} of {}", told.assessed, told.analyses));
        row("told by double", told.double.to_string());
        row("told by double-double", told.double_double.to_string());
        row("told by octuple", told.octuple.to_string());
        row("fates moved", told.moved.to_string());
        row("for these doubles only", told.only_these_doubles.to_string());
    }
    let unresolved = told.unresolved;
    row("unresolved", format!("{unresolved} of {}", told.analyses));
    if args.resurrections_to.is_some() {
        row("resurrections", counts.resurrections.to_string());
    }
    row("table", args.out.display().to_string());
    text
}
