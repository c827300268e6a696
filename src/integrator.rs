//! Integration of a scene: block, excitation, model, and results to record.
//!
//! One driver (rest, flight, events, end) for both equations of motion.
//! Eq. 1 is stepped by its Taylor polynomial, order 8 to 13, one step a sample
//! (several if p dt exceeds 0.1);
//! Eq. 2 by its exponential series, to rounding. Events are roots of the
//! step's own polynomial, all isolated. The block goes to rest only when the
//! series of impacts provably ends; it skips to the next exceedance of the
//! uplift threshold; after the excitation energy decides in closed form.
//!
//! # Proofs
//!
//! Some steps of a run are skipped because a proof shows that they cannot
//! change the answer. The compiler checks none of these proofs. The docs of
//! the module that uses a proof have it, with the physics on which it rests.
//! A change of that physics needs a new proof.
//!
//! | proof | module | claim |
//! |---|---|---|
//! | P1 | `barrier` | the rest of a record cannot raise the peak |
//! | P2 | `driver::impact` | a series of impacts ends in rest |
//! | P3 | `coast` | the outcome after the excitation |
//! | P4 | `accuracy` | the error of a run |
//! | P5 | `screen` | the rough estimate of that error |
//! | P6 | `pool::group` | a step of a lane meets no event |
//! | P7 | `pool` | lanes give the bits of the driver |
//! | P8 | `excitation::pulse::bound` | a piece of a pulse lifts no block at rest |
//! | P9 | `excitation::record_index` | a part of a record lifts no block at rest |
//! | P10 | `coast` | observation may cut free motion |
//! | P11 | `forcing` | the distance of a ground motion from the uplift threshold |
//! | P12 | `accuracy::hops` | hops of unknown order stay small |
//!
//! | change | module | proofs |
//! |---|---|---|
//! | pulse | `excitation::pulse::kind` | P8, P11 |
//! | impact law | `block`, `driver::impact` | P1 to P5, P7, P10, P12 |
//! | overturning criterion | `dynamics` | P1, P3, P7, P10 |
//! | kind of excitation | `excitation` | P2, P3, P9, P11, P12 |
//! | instruction set | `number::dispatch` | no proof; the bits stay as they are |
//!
//! # Terms
//!
//! - *Piece*: an interval on which the excitation is smooth, such as a sample
//!   interval of a record. *Stretch*: pieces of one formula of a pulse.
//!   *Crest*: a turning point of the ground acceleration. *Remainder*: bounds
//!   on the rest of a record.
//! - *Uplift threshold* of |a|/g: tan alpha in Eq. 1, alpha in Eq. 2.
//! - *Hop*: the motion from one impact to the next. *Chatter*: impacts that
//!   accumulate and end in rest.
//! - *Truncation error*: the part of a motion that a series leaves out. *Hard
//!   step*: a step whose truncation error under the short series is too large;
//!   the driver makes it again with the longest series.
//! - *Barrier*: the peak so far, as the energy that would raise it. *Calm*:
//!   the piece from which every impact takes more energy than a hop can give.
//!   *Settled*: outcome and peak can no longer change.
//! - *Saltation*: how an impact changes a small error of (u, w).
//! - *Certificate*: for each kind of decision, the least ratio of margin to
//!   error. *Clearance*: such a ratio. *Doubt*: about the largest ratio of
//!   error to margin, by the rough estimate.
//! - *Lane*: one of eight numbers of a SIMD value. *Group*: eight lanes that
//!   are stepped together. *Slot*: the place of a run, with a lane. *Class*:
//!   scenes with one equation and one series. *Sweep*: one step of all groups.
//!   *Queue*: lanes that wait for one kind of step.

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
mod motion;
#[cfg(feature = "lanes")]
pub(crate) mod pool;
mod precise;
mod roots;
mod run;
mod scene;
mod screen;
mod taylor;

pub use certificate::{
    CLEARANCE, Certificate, Clearance, Decision, LARGEST_ERROR,
};
pub use certify::{Arithmetic, CertifiedFate, Certify, certify};
pub use driver::Forces;
pub use dynamics::{Model, Overturning, uplift_threshold};
pub(crate) use limits::check;
pub use limits::{SceneError, WorkLimit};
#[cfg(feature = "lanes")]
pub use pool::bare::BareSteps;
pub use precise::respond_precise;
pub use scene::{
    Assessment, HistoryPoint, Impact, ImpactError, Observe, Outcome, Response,
    Scene, Side, Work,
};

use crate::names::named;
use crate::number::dispatch::Isa;
use driver::Again;
use run::run;
pub(crate) use screen::DOUBTFUL;

/// Integrates a scene.
///
/// Every run has a rough estimate of error over margin. If it is not small,
/// every decision of the run is assessed, even without [`Observe::accuracy`]:
/// [`Response::assessment`] then is not `NotAssessed`.
///
/// # Errors
/// [`SceneError`] for an initial rotation outside [0, 1), an amplitude that
/// is not finite, a time that is not positive, a pulse of too many pieces, or
/// a run that passes its [`WorkLimit`].
///
/// ```
/// use rocking::{Block, Excitation, Observe, Restitution, Scene, respond};
/// use rocking::excitation::{Pulse, PulseKind};
/// let pulse = Pulse::try_new(PulseKind::OneSine {
///     amplitude: 1.5 / 9.81,
///     omega_rad_s: 12.0,
/// })?;
/// let scene = Scene::new(
///     Block::try_new(0.1, 3.0)?,
///     Restitution::constant(0.92)?,
///     Excitation::Pulse(&pulse),
/// );
/// let answer = respond(&scene, &Observe::default())?;
/// // A 36-digit reference: 0.493881599743772889432469876681278552.
/// assert!((answer.peak_ratio - 0.493_881_599_743_773).abs() < 1e-13);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond(
    scene: &Scene<'_>,
    observe: &Observe,
) -> Result<Response, SceneError> {
    Solver::default().respond(scene, observe)
}

named! {
    /// Fixed order of the Taylor polynomial under a record.
    #[derive(PartialOrd, Ord)]
    pub enum Order: "order" {
        /// Order 4.
        Four = "4",
        /// Order 6.
        Six = "6",
        /// Order 8.
        Eight = "8",
        /// Order 10.
        Ten = "10",
    }
}

named! {
    /// How much of a run is needed.
    pub enum Extent: "extent of a run" {
        /// All of it.
        Whole = "whole",
        /// Outcome and peak: the run ends as soon as nothing can change them.
        /// They, the fate margin, the time of the peak and the first uplift
        /// are those of a whole run, to the last bit. Impacts, rest and
        /// history end with the run.
        Peak = "peak",
        /// The outcome: the run ends as soon as it is certain, and the peak is
        /// the largest rotation until then.
        Outcome = "outcome",
    }
}

/// Options of an integration in double precision. The default is that of
/// [`respond`].
/// ```
/// use rocking::{Block, Excitation, Observe, Restitution, Scene, respond};
/// use rocking::excitation::{NormalisedRecord, ScaledRecord};
/// use rocking::integrator::{Extent, Solver};
/// use rocking::accelerogram::Accelerogram;
/// // A second of shaking, then nine that hardly move the ground.
/// let sample = |k: u32| match k {
///     0..100 => 0.15 * libm::sin(0.1 * f64::from(k)),
///     _ => 0.001 * libm::sin(f64::from(k)),
/// };
/// let samples = (0..1000).map(sample).collect();
/// let record = NormalisedRecord::new(
///     &Accelerogram::try_new("example", 0.01, samples)?,
/// );
/// let scene = Scene::new(
///     Block::try_new(0.1, 3.0)?,
///     Restitution::constant(0.92)?,
///     Excitation::Record(ScaledRecord::to_pga(&record, 0.15)),
/// );
/// let solver = Solver { extent: Extent::Peak, ..Solver::default() };
/// let peak = solver.respond(&scene, &Observe::default())?;
/// let whole = respond(&scene, &Observe::default())?;
/// assert_eq!(peak.outcome, whole.outcome);
/// assert!(peak.work.steps < whole.work.steps);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Solver {
    /// Fixed order of Eq. 1 under a record, one step a sample, whatever the
    /// truncation error. `None`: the order that each step needs for double
    /// precision. Other scenes ignore it.
    pub order: Option<Order>,
    /// Instruction-set level. It changes only the speed.
    pub isa: Isa,
    /// How much of a run is needed.
    pub extent: Extent,
}

impl Default for Solver {
    fn default() -> Self {
        Self { order: None, isa: Isa::best(), extent: Extent::Whole }
    }
}

impl Solver {
    /// Integrates a scene.
    ///
    /// # Errors
    /// As [`respond`].
    pub fn respond(
        &self,
        scene: &Scene<'_>,
        observe: &Observe,
    ) -> Result<Response, SceneError> {
        let ends_early = self.extent != Extent::Whole;
        // The result of a fixed order is kept; the caller of a run for only
        // the peak reads its estimate.
        if observe.accuracy || self.order.is_some() || ends_early {
            return self.respond_once(scene, observe);
        }
        check(scene, observe)?;
        let response = run(scene, observe, *self, Again::IfDoubtful)?;
        if !response.is_doubtful() {
            return Ok(response);
        }
        let assessed = Observe { accuracy: true, ..*observe };
        run(scene, &assessed, *self, Again::Now)
    }

    /// The run, never repeated.
    pub(crate) fn respond_once(
        &self,
        scene: &Scene<'_>,
        observe: &Observe,
    ) -> Result<Response, SceneError> {
        check(scene, observe)?;
        run(scene, observe, *self, Again::No)
    }
}
