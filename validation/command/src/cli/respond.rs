//! `rocking respond`: one block, one excitation.

use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use rocking::block::Block;
use rocking::excitation::Excitation;
use rocking::integrator::{
    Arithmetic, Assessment, CertifiedFate, Certify, Model, Observe,
    Overturning, Response, Scene, WorkLimit, certify, respond,
    uplift_threshold,
};
use serde::Serialize;

use super::excitation::ExcitationArgs;
use super::limit::{LimitArgs, refused};
use super::processing::words;
use super::scene::{BlockArgs, ModelArgs};
use super::shared::{JsonArg, PlotArg};
use super::show::number;
use crate::failure::Failure;
use crate::terminal::patiently;
use rocking_common::files::Outputs;
use rocking_common::suites::remarks::Remarks;
use rocking_common::table::{Table, columns::HISTORY};
use rocking_draw::figures::of_result::response_svg;

/// Integrate one block under one excitation.
#[derive(clap::Args)]
#[command(mut_arg("plot", |arg| arg.help(
    "Draw the history theta/alpha as SVG"
)))]
#[command(after_help = "Examples:\n  \
    rocking respond --alpha 0.1 --p 3 --pulse one-sine \
    --amplitude-m-s2 1.5 --omega-rad-s 12\n  \
    rocking respond --width-m 0.3 --height-m 1.5 --record FILE.AT2 \
    --im 1.5 --plot theta.svg")]
pub struct RespondCommand {
    #[command(flatten)]
    block: BlockArgs,
    #[command(flatten)]
    model: ModelArgs,
    #[command(flatten)]
    excitation: ExcitationArgs,
    /// Stop observing at this time in s.
    #[arg(long, value_name = "S")]
    until: Option<f64>,
    /// Write the history theta(t) as CSV.
    #[arg(long, value_name = "FILE.csv")]
    history: Option<PathBuf>,
    #[command(flatten)]
    plot: PlotArg,
    /// Settle outcome and peak with sufficient precision: double-double if
    /// double precision does not suffice, then octuple. With `--until` they
    /// are for the observed time.
    #[arg(long)]
    certify: bool,
    /// Largest friction |H|/N that the motion needs at the pivot, and the
    /// least normal force N/(m g) there. The model is valid if the ground
    /// provides that friction and N stays above zero.
    #[arg(long)]
    forces: bool,
    #[command(flatten)]
    limit: LimitArgs,
    #[command(flatten)]
    json: JsonArg,
}

/// Interval of a history if the excitation has none, s.
const HISTORY_INTERVAL_S: f64 = 0.005;

/// A result with the name of its outcome, `unresolved` if an error may have
/// changed a decision.
#[derive(Serialize)]
struct NamedOutcome<T> {
    outcome: &'static str,
    #[serde(flatten)]
    found: T,
}

#[derive(Serialize)]
struct RespondSummary<'a> {
    #[serde(flatten)]
    response: NamedOutcome<Response>,
    certified: Option<NamedOutcome<CertifiedFate>>,
    scene: SceneSummary<'a>,
}

/// The scene that was integrated.
#[derive(Serialize)]
struct SceneSummary<'a> {
    alpha_rad: f64,
    p_rad_s: f64,
    eta: f64,
    model: Model,
    overturn: Overturning,
    gravity_m_s2: f64,
    excitation: String,
    processing: Option<String>,
    remarks: Option<&'a Remarks>,
    pga_g: f64,
    intensity_pga: f64,
}

/// Runs `rocking respond`.
///
/// # Errors
/// [`Failure`] for bad input.
pub fn run_respond(args: &RespondCommand) -> Result<(), Failure> {
    let gravity_m_s2 = args.model.gravity_m_s2;
    let block: Block = args.block.block(gravity_m_s2)?;
    let restitution = args.model.eta.restitution(&block)?;
    let threshold = uplift_threshold(&block, args.model.model);
    let p_rad_s = block.frequency_rad_s();
    let ground = args.excitation.ground(gravity_m_s2, threshold, p_rad_s)?;
    let mut outputs = Outputs::of(args.excitation.inputs());
    let history = outputs.open_some(args.history.as_ref())?;
    let plot = args.plot.open(&mut outputs)?;
    let scene = Scene {
        model: args.model.model,
        overturning: args.model.overturn,
        initial_ratio: ground.initial_ratio,
        ..Scene::new(block, restitution, ground.excitation())
    };
    let interval_s = ground.dt_s.unwrap_or(HISTORY_INTERVAL_S);
    let work_limit = args.limit.limit(WorkLimit::default());
    let observe = Observe {
        events: true,
        accuracy: true,
        history_interval_s: (history.is_some() || plot.is_some())
            .then_some(interval_s),
        until_s: args.until,
        forces: args.forces,
        work_limit,
    };
    let mut response = respond(&scene, &observe).map_err(refused)?;
    if let Some(out) = history {
        out.write(history_csv(&scene, &response))?;
    }
    let (excitation, pga_g) = (args.excitation.name(), ground.pga_g);
    if let Some(out) = plot {
        out.write(response_svg(&scene, &response, &excitation, pga_g))?;
    }
    let certified = || certified(&scene, args.until, work_limit);
    let certified = args.certify.then(certified).transpose()?;
    // The history has its file.
    response.history.clear();
    let outcome = response.outcome_name();
    let result = RespondSummary {
        response: NamedOutcome { outcome, found: response },
        certified,
        scene: SceneSummary {
            alpha_rad: block.slenderness_rad(),
            p_rad_s,
            eta: restitution.velocity_ratio(),
            model: scene.model,
            overturn: scene.overturning,
            gravity_m_s2,
            excitation,
            processing: words(&args.excitation.input.processing()?),
            remarks: ground.remarks.as_ref(),
            pga_g,
            intensity_pga: pga_g / threshold,
        },
    };
    let run = &result.response.found;
    let doubt = match (run.assessment(), args.certify) {
        (Assessment::Clear, _) => "",
        (_, true) => " Certified: {certified.outcome}.",
        (_, false) => {
            " Rounding errors may have changed this result; --certify \
             settles it."
        }
    };
    let alpha = block.slenderness_rad();
    let error = run.error_estimate.map(|error| alpha * error);
    let rotation = number(alpha * run.peak_ratio, error);
    let sentences = [
        "The block overturns at {overturning_time_s} s.",
        &format!(
            "The block rocks and does not overturn. Its peak rotation is \
             {rotation} rad ({{edp}} of alpha), at {{peak_time_s}} s."
        ),
        "The block does not lift off.",
    ];
    let sentences = sentences.map(|sentence| sentence.to_owned() + doubt);
    let sentences = sentences.each_ref().map(String::as_str);
    args.json.summarise(&outputs, &sentences, &result)
}

/// The certified outcome, with notes on progress if it takes long.
fn certified(
    scene: &Scene<'_>,
    until_s: Option<f64>,
    work_limit: WorkLimit,
) -> Result<NamedOutcome<CertifiedFate>, Failure> {
    let place = Mutex::new((Arithmetic::Double, 0.0));
    let end_s = match scene.excitation {
        Excitation::Record(record) => {
            (record.samples().len() - 1) as f64 * record.dt_s()
        }
        Excitation::Pulse(pulse) => pulse.duration_s(),
        Excitation::Free => 0.0,
    };
    let end_s = until_s.map_or(end_s, |until_s| until_s.min(end_s));
    let words = || {
        let now = place.lock().unwrap_or_else(PoisonError::into_inner);
        let (by, time_s) = (now.0.name(), now.1);
        format!("--certify: {by} arithmetic, {time_s:.3} of {end_s:.3} s")
    };
    let progress = |by, time_s| {
        *place.lock().unwrap_or_else(PoisonError::into_inner) = (by, time_s);
    };
    let progress = &progress;
    let ask = Certify { until_s, work_limit, progress, ..Certify::default() };
    let found = patiently(&words, || certify(scene, &ask));
    let found = found.map_err(refused)?;
    let own = found.outcome.name();
    let outcome = if found.resolved { own } else { "unresolved" };
    Ok(NamedOutcome { outcome, found })
}

/// The history as a table, one row a point.
fn history_csv(scene: &Scene<'_>, response: &Response) -> String {
    let alpha = scene.block.slenderness_rad();
    let mut table = Table::of(&HISTORY);
    for point in &response.history {
        let angle = point.rotation_rad;
        let cells = [point.time_s, angle, point.velocity_rad_s, angle / alpha];
        table.row(cells.map(|x| x.to_string()));
    }
    table.finish()
}
