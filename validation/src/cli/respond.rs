//! `rocking respond`: one block, one excitation.

use std::fmt::Write as _;
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};

use rocking::excitation::{Excitation, ScaledRecord};
use rocking::integrator::{
    Arithmetic, Assessment, CLEARANCE, Certificate, Certified, Certify,
    Clearance, Decision, HistoryPoint, Observe, Outcome, Response, Scene,
    Side, WorkLimit, certify, respond, uplift_threshold,
};
use serde_json::{Map, Value, json};

use super::excitation::{ExcitationArgs, Ground};
use super::limit::{LimitArgs, refused};
use super::scene::{BlockArgs, ModelArgs};
use super::{Failure, patiently, print, print_json};
use rocking_common::files::{Output, Outputs};
use rocking_common::paper::Intensity;
use rocking_common::suites::remarks::Remarks;
use rocking_common::table::{Table, columns::HISTORY};
use rocking_common::words::printable;
use rocking_draw::figures::{Heading, Histories, History, HistoryPanel};

/// Integrate one block under one excitation.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking respond --alpha 0.1 --p 3 --pulse one-sine \
    --amplitude-m-s2 1.5 --omega-rad-s 12\n  \
    rocking respond --width-m 0.3 --height-m 1.5 --record FILE.AT2 \
    --im 1.5 --plot theta.svg")]
pub struct Args {
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
    /// Draw the history theta/alpha as SVG.
    #[arg(long, value_name = "FILE.svg")]
    plot: Option<PathBuf>,
    /// Tell outcome and peak in the precision that they need: double-double
    /// where double precision cannot, octuple precision beyond. With `--until`
    /// those of the time observed.
    #[arg(long)]
    certify: bool,
    /// Largest friction |H|/N that the motion needs at the pivot, and the
    /// least normal force N/(m g) there. The model holds where the ground
    /// gives that friction and N stays above zero.
    #[arg(long)]
    forces: bool,
    #[command(flatten)]
    limit: LimitArgs,
    /// JSON for machines.
    #[arg(long)]
    json: bool,
}

/// Interval of a history where the excitation has none of its own, s.
const HISTORY_INTERVAL_S: f64 = 0.005;

/// Runs the command.
///
/// # Errors
/// [`Failure`] for bad input.
pub fn run(args: &Args) -> Result<(), Failure> {
    let gravity_m_s2 = args.model.gravity_m_s2()?;
    let block = args.block.block(gravity_m_s2)?;
    let restitution = args.model.restitution(&block)?;
    let threshold = uplift_threshold(&block, args.model.model());
    let p = block.frequency_rad_s();
    let ground = args.excitation.ground(gravity_m_s2, threshold, p)?;
    let mut outputs = Outputs::of(args.excitation.inputs());
    let history = outputs.open_some(args.history.as_ref())?;
    let plot = outputs.open_some(args.plot.as_ref())?;
    let (excitation, initial_ratio) = match &ground {
        Ground::Factor(record, factor, _) => {
            let scaled = ScaledRecord::by_factor(record, *factor);
            (Excitation::Record(scaled), 0.0)
        }
        Ground::Peak(unit, pga_g, _) => {
            let scaled = ScaledRecord::to_pga(unit, *pga_g);
            (Excitation::Record(scaled), 0.0)
        }
        Ground::Pulse(pulse) => (Excitation::Pulse(pulse), 0.0),
        Ground::Free(ratio) => (Excitation::Free, *ratio),
    };
    let scene = Scene {
        block,
        restitution,
        model: args.model.model(),
        overturning: args.model.overturning(),
        excitation,
        initial_ratio,
    };
    let interval_s = match &ground {
        Ground::Factor(record, ..) => record.dt_s(),
        Ground::Peak(unit, ..) => unit.dt_s(),
        Ground::Pulse(_) | Ground::Free(_) => HISTORY_INTERVAL_S,
    };
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
    let response = respond(&scene, &observe).map_err(refused)?;
    let prints =
        |out: &Option<Output>| out.as_ref().is_some_and(Output::is_standard);
    let is_printed = prints(&history) || prints(&plot);
    if let Some(out) = history {
        out.write(history_csv(&scene, &response))?;
    }
    let pga_g = match &ground {
        Ground::Factor(record, factor, _) => record.pga_g() * factor.abs(),
        Ground::Peak(_, pga_g, _) => *pga_g,
        Ground::Pulse(pulse) => pulse.pga_g(),
        Ground::Free(_) => 0.0,
    };
    if let Some(out) = plot {
        let name = args.excitation.name();
        out.write(drawing(&scene, &response, name, pga_g)?)?;
    }
    let certified = args
        .certify
        .then(|| certified(&scene, args.until, work_limit))
        .transpose()?;
    let (scene, done) = (&scene, args.excitation.processing()?);
    let remarks = ground.remarks();
    let setting =
        Setting { args, scene, certified, gravity_m_s2, pga_g, done, remarks };
    if is_printed {
        eprint!("{}", printable(&setting.table(&response)));
        return Ok(());
    }
    if args.json {
        print_json(setting.json(&response))
    } else {
        print(&setting.table(&response))
    }
}

/// The certified fate; where it takes long, with a word on how far it is.
fn certified(
    scene: &Scene<'_>,
    until_s: Option<f64>,
    work_limit: WorkLimit,
) -> Result<Certified, Failure> {
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
    let ask = Certify { until_s, work_limit, progress: &progress };
    patiently(&words, || certify(scene, &ask)).map_err(refused)
}

/// The history, drawn.
fn drawing(
    scene: &Scene<'_>,
    response: &Response,
    name: String,
    pga_g: f64,
) -> Result<String, Failure> {
    let alpha_rad = scene.block.slenderness_rad();
    let of = |f: fn(&HistoryPoint) -> f64| {
        response.history.iter().map(f).collect::<Vec<f64>>()
    };
    let rotation = of(|point| point.rotation_rad);
    let history = History {
        alpha_rad,
        time_s: of(|point| point.time_s),
        ratio: rotation.iter().map(|theta| theta / alpha_rad).collect(),
        overturned: response.outcome.is_overturned(),
    };
    let panel = HistoryPanel {
        p_rad_s: scene.block.frequency_rad_s(),
        record: name,
        intensity: Intensity::Pga,
        im: pga_g / uplift_threshold(&scene.block, scene.model),
        until_s: f64::NAN,
        curves: vec![history],
    };
    let heading = Heading::new(
        "history",
        "Response history",
        "Rotation over slenderness against time.",
        None,
    );
    let figure = Histories { heading, panels: vec![panel], columns: 1 };
    Ok(figure.thinned().figure(String::new()).svg())
}

/// Name of an outcome, `unresolved` where it cannot be told.
#[must_use]
pub fn outcome_name(outcome: &Outcome, resolved: bool) -> &'static str {
    match outcome {
        _ if !resolved => "unresolved",
        Outcome::NoUplift => "no-uplift",
        Outcome::Rocked { .. } => "rocked",
        Outcome::Overturned { .. } => "overturned",
    }
}

fn side_name(side: Side) -> &'static str {
    match side {
        Side::Positive => "positive",
        Side::Negative => "negative",
    }
}

/// What the answer is printed with.
struct Setting<'a> {
    args: &'a Args,
    scene: &'a Scene<'a>,
    certified: Option<Certified>,
    gravity_m_s2: f64,
    pga_g: f64,
    /// What was done to the record.
    done: Option<String>,
    /// What is suspicious about it.
    remarks: Option<&'a Remarks>,
}

/// The certified outcome, `unresolved` where no engine can tell.
fn certified_name(fate: &Certified) -> &'static str {
    outcome_name(&fate.outcome, fate.decided)
}

/// True where outcome and peak can be told.
fn is_clear(response: &Response) -> bool {
    response.assessment() == Assessment::Clear
}

fn clearance_json(least: &Clearance) -> Value {
    json!({
        "decision": least.decision.name(),
        "margin_over_error": least.ratio,
        "time_s": least.time_s,
    })
}

/// The least clear decision of all, and of every kind.
fn certificate_json(certificate: &Certificate) -> Value {
    let kinds: Vec<Value> = Decision::ALL
        .iter()
        .map(|decision| clearance_json(&certificate.of(*decision)))
        .collect();
    json!({
        "clear": certificate.is_clear(),
        "clear_from": CLEARANCE,
        "least": clearance_json(&certificate.least()),
        "decisions": kinds,
    })
}

/// A decision in words.
fn clearance_text(least: &Clearance) -> String {
    format!(
        "{}, margin {:.1e} times its error, at {:.6} s",
        least.decision.name(),
        least.ratio,
        least.time_s
    )
}

impl Setting<'_> {
    fn json(&self, response: &Response) -> Value {
        let overturning = match response.outcome {
            Outcome::Overturned { time_s, side } => Some((time_s, side)),
            Outcome::NoUplift | Outcome::Rocked { .. } => None,
        };
        let impacts: Vec<Value> = response
            .impacts
            .iter()
            .map(|impact| {
                json!({
                    "time_s": impact.time_s,
                    "speed_before_rad_s": impact.speed_before_rad_s,
                    "time_error_s": impact.error.map(|e| e.time_s),
                    "speed_error_rad_s":
                        impact.error.map(|e| e.speed_rad_s),
                })
            })
            .collect();
        let work = response.work;
        let block = self.scene.block;
        json!({
            "outcome":
                outcome_name(&response.outcome, is_clear(response)),
            "counts_as": outcome_name(&response.outcome, true),
            "peak_ratio": response.outcome.edp(),
            "peak_time_s": match overturning {
                Some(_) => None,
                None => response.peak_time_s,
            },
            "uplift_time_s": response.uplift_time_s,
            "overturning_time_s": overturning.map(|o| o.0),
            "overturning_side": overturning.map(|o| side_name(o.1)),
            "overturning_error_s": response.overturning_error_s,
            "rest_time_s": response.rest_time_s,
            "rest_error_s": response.rest_error_s,
            "impacts": impacts,
            "fate_margin": response.fate_margin,
            "certificate":
                response.certificate.as_ref().map(certificate_json),
            "certified": self.certified.map(|fate| json!({
                "outcome": certified_name(&fate),
                "peak_ratio": fate.outcome.edp(),
                "margin": fate.margin,
                "error_estimate": fate.error,
                "by": fate.by.name(),
                "least": clearance_json(&fate.least),
                "for_all_inputs_that_round_to_these":
                    fate.decided_for_inputs,
            })),
            "forces": response.forces.map(|forces| json!({
                "friction": forces.friction,
                "friction_time_s": forces.friction_time_s,
                "least_normal_over_weight": forces.normal,
                "least_normal_time_s": forces.normal_time_s,
            })),
            "error_estimate": response.error_estimate,
            "condition_number": response.condition_number,
            "reasons": self.reasons(response),
            "work": {
                "steps": work.steps,
                "impacts": work.impacts,
                "turning_points": work.turning_points,
                "uplifts": work.uplifts,
                "rest_scans": work.rest_scans,
            },
            "scene": {
                "alpha_rad": block.slenderness_rad(),
                "p_rad_s": block.frequency_rad_s(),
                "eta": self.scene.restitution.velocity_ratio(),
                "model": self.args.model.model(),
                "overturn": self.args.model.overturning(),
                "gravity_m_s2": self.gravity_m_s2,
                "processing": self.done,
                "remarks": self.remarks.map(Remarks::json),
                "pga_g": self.pga_g,
                "intensity_pga": self.im_pga(),
            },
        })
    }

    fn im_pga(&self) -> f64 {
        self.pga_g / uplift_threshold(&self.scene.block, self.scene.model)
    }

    /// Why a value is missing.
    fn reasons(&self, response: &Response) -> Map<String, Value> {
        let mut reasons = Map::new();
        let mut because = |key: &str, text: &str| {
            reasons.insert(key.to_owned(), Value::from(text));
        };
        if self.certified.is_none() {
            because("certified", "not asked for by --certify");
        }
        if response.forces.is_none() {
            because("forces", "not asked for by --forces");
        }
        if !is_clear(response) {
            let text = "an error may have turned a decision: see certificate";
            for key in
                ["error_estimate", "rest_error_s", "overturning_error_s"]
            {
                because(key, text);
            }
        }
        let overturned = response.outcome.is_overturned();
        if response.outcome == Outcome::NoUplift {
            for key in
                ["peak_time_s", "uplift_time_s", "rest_time_s", "rest_error_s"]
            {
                because(key, "the block did not move");
            }
        } else if response.uplift_time_s.is_none() {
            because("uplift_time_s", "the block was released, not lifted");
        }
        if overturned {
            because("peak_ratio", "the block overturned");
            because("peak_time_s", "the block overturned");
            because("rest_time_s", "the block overturned");
            because("rest_error_s", "the block overturned");
            if is_clear(response) && response.overturning_error_s.is_none() {
                let text = "after the excitation no bound is given";
                because("overturning_error_s", text);
            }
        } else {
            because("overturning_time_s", "the block stands");
            because("overturning_side", "the block stands");
            because("overturning_error_s", "the block stands");
            if response.rest_time_s.is_none()
                && response.outcome != Outcome::NoUplift
            {
                let never = self.scene.restitution.velocity_ratio() >= 1.0;
                let text = if never {
                    "without loss at impact the block never comes to rest"
                } else {
                    "observation ended before rest"
                };
                because("rest_time_s", text);
                because("rest_error_s", text);
            }
        }
        reasons
    }

    fn table(&self, response: &Response) -> String {
        let mut text = String::new();
        let mut row = |name: &str, value: String| {
            let _ = writeln!(text, "{name:<24}{value}");
        };
        let time = |t: Option<f64>| {
            t.map_or_else(|| "-".to_owned(), |t| format!("{t:.6} s"))
        };
        let block = self.scene.block;
        row(
            "block",
            format!(
                "alpha = {} rad, p = {} rad/s, eta = {}",
                block.slenderness_rad(),
                block.frequency_rad_s(),
                self.scene.restitution.velocity_ratio()
            ),
        );
        row(
            "model",
            format!(
                "{}, overturned at {}, g = {} m/s2",
                self.args.model.model(),
                self.args.model.overturning(),
                self.gravity_m_s2
            ),
        );
        if let Some(words) = &self.done {
            row("record", words.clone());
        }
        if let Some(words) = self.remarks.and_then(Remarks::words) {
            row("remarks", words);
        }
        row(
            "PGA",
            format!("{:.6} g, intensity {:.6}", self.pga_g, self.im_pga()),
        );
        let resolved = is_clear(response);
        row("outcome", outcome_name(&response.outcome, resolved).to_owned());
        if !resolved {
            row("counts as", outcome_name(&response.outcome, true).to_owned());
        }
        match response.outcome {
            Outcome::Overturned { time_s, side } => row(
                "overturning",
                format!("{time_s:.6} s, {} side", side_name(side)),
            ),
            Outcome::Rocked { peak_ratio } => row(
                "peak |theta|/alpha",
                format!("{peak_ratio:.9} at {}", time(response.peak_time_s)),
            ),
            Outcome::NoUplift => {}
        }
        row("uplift", time(response.uplift_time_s));
        row("rest", time(response.rest_time_s));
        row("impacts", response.work.impacts.to_string());
        row("fate margin", format!("{:.3e}", response.fate_margin));
        if let Some(fate) = self.certified {
            row(
                "certified",
                format!(
                    "{} by {}, peak {:.9}, margin {:.3e}",
                    certified_name(&fate),
                    fate.by.name(),
                    fate.outcome.edp(),
                    fate.margin,
                ),
            );
            let inputs = if fate.decided_for_inputs {
                "for all inputs that round to these doubles"
            } else {
                "for these doubles; undecided for what they are rounded from"
            };
            row("it holds", inputs.to_owned());
            row("its least clear", clearance_text(&fate.least));
        }
        if let Some(forces) = response.forces {
            let when = |t: Option<f64>| match t {
                Some(t) => format!("at {t:.6} s"),
                None => "at rest".to_owned(),
            };
            let (friction, normal) = (forces.friction, forces.normal);
            let (slides, lifts) =
                (when(forces.friction_time_s), when(forces.normal_time_s));
            row("friction needed", format!("{friction:.6} {slides}"));
            row("least N/(m g)", format!("{normal:.6} {lifts}"));
        }
        if let Some(certificate) = &response.certificate {
            row("least clear", clearance_text(&certificate.least()));
        }
        if let Some(error) = response.error_estimate {
            row("error estimate", format!("{error:.1e}"));
        }
        if let Some(condition) = response.condition_number {
            row("condition number", format!("{condition:.1e}"));
        }
        row("steps", response.work.steps.to_string());
        text
    }
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
