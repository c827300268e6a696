//! Integration of a scene: block, excitation, model, and what to record.
//!
//! One driver (rest, flight, events, end) for both equations of motion.
//! Eq. 1 is stepped by its Taylor polynomial, order 8 to 13, one step a sample;
//! Eq. 2 by its exponential series, to rounding. Events are roots of the
//! step's own polynomial, all isolated. The block goes to rest only when the
//! series of impacts provably ends; it skips to the next exceedance of the
//! uplift threshold; after the excitation energy decides in closed form.

mod accuracy;
mod barrier;
mod certificate;
mod certify;
pub(crate) mod class;
mod coast;
mod driver;
mod dynamics;
mod forcing;
mod limits;
pub(crate) mod pool;
mod precise;
mod roots;
mod run;
mod screen;
mod taylor;

pub use certificate::{
    CLEARANCE, Certificate, Clearance, Decision, LARGEST_ERROR,
};
pub use certify::{Certified, Engine, certify, certify_within};
pub use dynamics::{Model, Overturning, uplift_threshold};
pub(crate) use limits::check;
pub use limits::{SceneError, WorkLimit};
pub use precise::{respond_in, respond_octuple, respond_precise};

use crate::block::{Block, Restitution};
use crate::excitation::Excitation;
use crate::number::dispatch::Isa;
use run::{Method, run};

/// A scene: what is integrated.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The block.
    pub block: Block,
    /// What an impact leaves of the angular velocity.
    pub restitution: Restitution,
    /// Equation of motion.
    pub model: Model,
    /// When the block counts as overturned.
    pub overturning: Overturning,
    /// What moves the ground.
    pub excitation: Excitation<'a>,
    /// Initial rotation over the slenderness angle, released at rest; in
    /// [0, 1).
    pub initial_ratio: f64,
}

/// What to record beyond outcome and peak; each costs what it needs.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observe {
    /// Impacts and the time of coming to rest.
    pub events: bool,
    /// Error estimate and condition number.
    pub accuracy: bool,
    /// Rotation every so many seconds.
    pub history_interval_s: Option<f64>,
    /// Stop at this time (s) instead of when nothing more can happen.
    pub until_s: Option<f64>,
    /// Work beyond which the run is refused.
    pub work_limit: WorkLimit,
}

/// What became of the block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome<N = f64> {
    /// The ground acceleration never exceeded the uplift threshold.
    NoUplift,
    /// It rocked and stands.
    Rocked {
        /// Peak |theta|/alpha.
        peak_ratio: N,
    },
    /// It overturned.
    Overturned {
        /// When the criterion was met, s.
        time_s: N,
        /// Sign of the rotation.
        side: Side,
    },
}

impl Outcome {
    /// Engineering demand parameter: peak |theta|/alpha, infinite when
    /// overturned, zero without uplift.
    #[must_use]
    pub fn edp(&self) -> f64 {
        match self {
            Self::NoUplift => 0.0,
            Self::Rocked { peak_ratio } => *peak_ratio,
            Self::Overturned { .. } => f64::INFINITY,
        }
    }
}

impl<N> Outcome<N> {
    /// True when the block overturned.
    #[must_use]
    pub fn is_overturned(&self) -> bool {
        matches!(self, Self::Overturned { .. })
    }
}

/// Side of the rotation: the sign of theta.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Side {
    /// theta > 0.
    Positive,
    /// theta < 0, the side to which a positive ground acceleration drives.
    Negative,
}

impl Side {
    /// +1 or -1.
    #[must_use]
    pub fn sign(self) -> f64 {
        match self {
            Self::Positive => 1.0,
            Self::Negative => -1.0,
        }
    }

    pub(crate) fn flipped(self) -> Self {
        match self {
            Self::Positive => Self::Negative,
            Self::Negative => Self::Positive,
        }
    }
}

/// An impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Impact<N = f64> {
    /// Time in s.
    pub time_s: N,
    /// Absolute angular velocity just before it, rad/s.
    pub speed_before_rad_s: N,
    /// Bounds on the errors of both; recorded with accuracy, none where a
    /// decision before it is not clear.
    pub error: Option<ImpactError>,
}

/// Bounds on the errors of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ImpactError {
    /// Of its time, s.
    pub time_s: f64,
    /// Of the angular velocity before it, rad/s.
    pub speed_rad_s: f64,
}

/// A point of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct HistoryPoint<N = f64> {
    /// Time in s.
    pub time_s: N,
    /// Rotation theta in rad, signed.
    pub rotation_rad: N,
    /// Angular velocity in rad/s, signed.
    pub velocity_rad_s: N,
}

/// How much was computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Taylor polynomials expanded.
    pub steps: u64,
    /// Impacts solved.
    pub impacts: u64,
    /// Turning points above all before.
    pub turning_points: u64,
    /// Uplifts from rest.
    pub uplifts: u64,
    /// Intervals (or blocks of intervals) looked at while at rest.
    pub rest_scans: u64,
}

/// The answer to a scene, in the numbers of the run.
#[derive(Clone, Debug, PartialEq)]
pub struct Response<N = f64> {
    /// What became of the block, by this run.
    pub outcome: Outcome<N>,
    /// Largest |theta|/alpha reached before overturning or at all.
    pub peak_ratio: N,
    /// When the peak was reached, s.
    pub peak_time_s: Option<N>,
    /// First uplift, s.
    pub uplift_time_s: Option<N>,
    /// Final coming to rest, s; recorded with events.
    pub rest_time_s: Option<N>,
    /// Impacts in order; recorded with events.
    pub impacts: Vec<Impact<N>>,
    /// Distance of the run from the other fate, in units of the slenderness
    /// angle (see the design of the criterion in [`Overturning`]).
    pub fate_margin: f64,
    /// Bound on the error of the peak ratio; recorded with accuracy, none
    /// where a decision is not clear.
    pub error_estimate: Option<f64>,
    /// Bound on the error of the final coming to rest, s; likewise.
    pub rest_error_s: Option<f64>,
    /// Bound on the error of the time of overturning, s; likewise.
    pub overturning_error_s: Option<f64>,
    /// Relative sensitivity of the peak to restitution and initial state;
    /// recorded with accuracy.
    pub condition_number: Option<f64>,
    /// How clearly outcome and peak were decided; recorded with accuracy.
    pub certificate: Option<Certificate>,
    /// The same for all inputs that round to the doubles that were given;
    /// recorded with accuracy.
    pub input_certificate: Option<Certificate>,
    /// Rough estimate of the largest ratio of error to margin among the
    /// decisions, made by runs of which outcome and peak alone are asked:
    /// whether their certificate is worth its cost.
    pub doubt: Option<f64>,
    /// Work counters.
    pub work: Work,
    /// Signed rotation in time; recorded when asked for.
    pub history: Vec<HistoryPoint<N>>,
}

impl<N> Response<N> {
    /// Whether outcome and peak can be told in this precision.
    #[must_use]
    pub fn assessment(&self) -> Assessment {
        match self.certificate {
            None => Assessment::NotAssessed,
            Some(certificate) if certificate.is_clear() => Assessment::Clear,
            Some(_) => Assessment::Unresolved,
        }
    }
}

/// Whether outcome and peak of a run can be told in its precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assessment {
    /// No error of the run can turn any of its decisions.
    Clear,
    /// The error of the run may have turned one of its decisions.
    Unresolved,
    /// Nobody looked.
    NotAssessed,
}

/// Integrates a scene.
///
/// # Errors
/// [`SceneError`] for an initial rotation outside [0, 1), an amplitude that
/// is not finite, a time that is not positive, a pulse of too many pieces, or
/// a run that passes its [`WorkLimit`].
///
/// ```
/// use rocking::block::{Block, Restitution};
/// use rocking::excitation::{Excitation, Pulse, PulseKind};
/// use rocking::integrator::{
///     Model, Observe, Overturning, Scene, respond,
/// };
/// let pulse = Pulse::try_new(PulseKind::OneSine {
///     amplitude_g: 1.5 / 9.81,
///     omega_rad_s: 12.0,
/// })?;
/// let scene = Scene {
///     block: Block::try_new(0.1, 3.0)?,
///     restitution: Restitution::constant(0.92)?,
///     model: Model::Nonlinear,
///     overturning: Overturning::Alpha,
///     excitation: Excitation::Pulse(&pulse),
///     initial_ratio: 0.0,
/// };
/// let answer = respond(&scene, &Observe::default())?;
/// // A 36-digit reference: 0.493881599743772889432469876681278552.
/// assert!((answer.peak_ratio - 0.493_881_599_743_773).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond(
    scene: &Scene<'_>,
    observe: &Observe,
) -> Result<Response, SceneError> {
    respond_with(scene, observe, Isa::best())
}

/// [`respond`] at a given instruction-set level, which changes the speed
/// alone.
///
/// # Errors
/// As [`respond`].
pub fn respond_with(
    scene: &Scene<'_>,
    observe: &Observe,
    isa: Isa,
) -> Result<Response, SceneError> {
    respond_as(scene, observe, None, isa)
}

/// What became of the block, and its peak: [`respond`] that ends as soon as
/// nothing can change either, on which the work alone depends.
///
/// Fate margin, peak and its time, and first uplift are those of [`respond`],
/// to the last bit; nothing tells when the block comes to rest. The limit is
/// [`WorkLimit::IDA`].
///
/// # Errors
/// As [`respond`].
///
/// ```
/// use rocking::block::{Block, Restitution};
/// use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
/// use rocking::integrator::{
///     Model, Observe, Overturning, Scene, respond, respond_peak,
/// };
/// use rocking::record::Accelerogram;
/// // A second of shaking, then nine that hardly move the ground.
/// let sample = |k: u32| match k {
///     0..100 => 0.15 * libm::sin(0.1 * f64::from(k)),
///     _ => 0.001 * libm::sin(f64::from(k)),
/// };
/// let samples = (0..1000).map(sample).collect();
/// let record = NormalisedRecord::new(
///     &Accelerogram::try_new("example", 0.01, samples)?,
/// );
/// let scene = Scene {
///     block: Block::try_new(0.1, 3.0)?,
///     restitution: Restitution::constant(0.92)?,
///     model: Model::Nonlinear,
///     overturning: Overturning::Alpha,
///     excitation: Excitation::Record(ScaledRecord::to_pga(&record, 0.15)),
///     initial_ratio: 0.0,
/// };
/// let peak = respond_peak(&scene)?;
/// let whole = respond(&scene, &Observe::default())?;
/// assert_eq!(peak.outcome, whole.outcome);
/// assert!(peak.work.steps < whole.work.steps);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond_peak(scene: &Scene<'_>) -> Result<Response, SceneError> {
    respond_peak_as(scene, WorkLimit::IDA, None, Isa::best())
}

/// [`respond_peak`] within a limit, at an instruction-set level, Eq. 1 at a
/// fixed order if one is given.
pub(crate) fn respond_peak_as(
    scene: &Scene<'_>,
    work_limit: WorkLimit,
    order: Option<Order>,
    isa: Isa,
) -> Result<Response, SceneError> {
    let observe = Observe { work_limit, ..Observe::default() };
    check(scene, &observe)?;
    run(scene, &observe, Method { order, isa, peak_only: true })
}

/// Order of the Taylor polynomial under a record, where it is fixed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// Order 4.
    Four,
    /// Order 6.
    Six,
    /// Order 8.
    Eight,
    /// Order 10.
    Ten,
}

/// [`respond`] with Eq. 1 under a record stepped at a fixed order, one step
/// a sample whatever it leaves; other scenes run as they always do.
///
/// # Errors
/// As [`respond`].
pub fn respond_at_order(
    scene: &Scene<'_>,
    observe: &Observe,
    order: Order,
) -> Result<Response, SceneError> {
    respond_as(scene, observe, Some(order), Isa::best())
}

/// [`respond_with`], at a fixed order if one is given.
pub(crate) fn respond_as(
    scene: &Scene<'_>,
    observe: &Observe,
    order: Option<Order>,
    isa: Isa,
) -> Result<Response, SceneError> {
    check(scene, observe)?;
    run(scene, observe, Method { order, isa, peak_only: false })
}
