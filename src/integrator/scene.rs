//! A scene and its response.

use crate::block::{Block, Restitution};
use crate::excitation::Excitation;
use crate::integrator::screen::DOUBTFUL;
use crate::integrator::{Certificate, Forces, Model, Overturning, WorkLimit};
use crate::names::named;

/// Input of an integration.
#[derive(Clone, Copy, Debug)]
pub struct Scene<'a> {
    /// The block.
    pub block: Block,
    /// Share of the angular velocity that an impact leaves.
    pub restitution: Restitution,
    /// Equation of motion.
    pub model: Model,
    /// When the block counts as overturned.
    pub overturning: Overturning,
    /// Ground motion.
    pub excitation: Excitation<'a>,
    /// Initial rotation over the slenderness angle, released at rest; in
    /// [0, 1).
    pub initial_ratio: f64,
}

impl<'a> Scene<'a> {
    /// A block at rest under an excitation, as in the paper: Eq. 1,
    /// overturning when |theta| exceeds alpha. Set the fields for other
    /// choices.
    ///
    /// ```
    /// use rocking::{Block, Excitation, Restitution, Scene};
    /// use rocking::integrator::Model;
    /// let block = Block::try_new(0.1, 3.0)?;
    /// let restitution = Restitution::constant(0.92)?;
    /// let free = Scene {
    ///     model: Model::Linearized,
    ///     initial_ratio: 0.5,
    ///     ..Scene::new(block, restitution, Excitation::Free)
    /// };
    /// assert_eq!(free.initial_ratio, 0.5);
    /// # Ok::<(), rocking::block::BlockError>(())
    /// ```
    pub fn new(
        block: Block,
        restitution: Restitution,
        excitation: Excitation<'a>,
    ) -> Self {
        Self {
            block,
            restitution,
            model: Model::Nonlinear,
            overturning: Overturning::Alpha,
            excitation,
            initial_ratio: 0.0,
        }
    }
}

/// Results to record beside outcome and peak. Each costs time.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Observe {
    /// Impacts and the time of coming to rest.
    pub events: bool,
    /// Error estimate and condition number.
    pub accuracy: bool,
    /// Interval of a history of the rotation, s.
    pub history_interval_s: Option<f64>,
    /// Forces at the pivot; every impact is followed for them.
    pub forces: bool,
    /// Stop at this time (s) instead of at the last possible event. Whether an
    /// event lies before it is a decision, [`Decision::End`].
    ///
    /// [`Decision::End`]: crate::integrator::Decision::End
    pub until_s: Option<f64>,
    /// Work limit of the run.
    pub work_limit: WorkLimit,
}

/// Outcome of a run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Outcome<N = f64> {
    /// The ground acceleration never exceeded the uplift threshold.
    NoUplift,
    /// The block rocked and stands.
    Rocked {
        /// Peak |theta|/alpha.
        peak_ratio: N,
    },
    /// The block overturned.
    Overturned {
        /// Time at which the criterion was met, s.
        time_s: N,
        /// Sign of the rotation.
        side: Side,
    },
}

impl Outcome {
    /// Engineering demand parameter: peak |theta|/alpha, infinite when
    /// overturned, zero without uplift.
    pub fn edp(&self) -> f64 {
        match self {
            Self::NoUplift => 0.0,
            Self::Rocked { peak_ratio } => *peak_ratio,
            Self::Overturned { .. } => f64::INFINITY,
        }
    }
}

impl<N> Outcome<N> {
    /// Its name: `no-uplift`, `rocked` or `overturned`.
    pub fn name(&self) -> &'static str {
        match self {
            Self::NoUplift => "no-uplift",
            Self::Rocked { .. } => "rocked",
            Self::Overturned { .. } => "overturned",
        }
    }

    /// True when the block overturned.
    pub fn is_overturned(&self) -> bool {
        matches!(self, Self::Overturned { .. })
    }
}

/// The outcome by its name as `counts_as` (its class in statistics, whether or
/// not its decisions are clear), the EDP, time and side.
#[cfg(feature = "serde")]
impl<N: serde::Serialize> serde::Serialize for Outcome<N> {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct as _;
        let mut fields = to.serialize_struct("Outcome", 4)?;
        fields.serialize_field("counts_as", self.name())?;
        match self {
            Self::Rocked { peak_ratio } => {
                fields.serialize_field("edp", peak_ratio)?;
            }
            Self::NoUplift => fields.serialize_field("edp", &0.0)?,
            Self::Overturned { .. } => {
                fields.serialize_field("edp", &f64::INFINITY)?;
            }
        }
        let end = match self {
            Self::Overturned { time_s, side } => Some((time_s, side)),
            Self::NoUplift | Self::Rocked { .. } => None,
        };
        fields.serialize_field("overturning_time_s", &end.map(|end| end.0))?;
        fields.serialize_field("overturning_side", &end.map(|end| end.1))?;
        fields.end()
    }
}

named! {
    /// Side of the rotation: the sign of theta.
    pub enum Side: "side" {
        /// theta > 0.
        Positive = "positive",
        /// theta < 0, the side to which a positive ground acceleration drives.
        Negative = "negative",
    }
}

impl Side {
    /// +1 or -1.
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
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Impact<N = f64> {
    /// Time in s.
    pub time_s: N,
    /// Absolute angular velocity just before it, rad/s.
    pub speed_before_rad_s: N,
    /// Bounds on the errors of both; recorded with accuracy, `None` if an
    /// earlier decision is not clear.
    pub error: Option<ImpactError>,
}

/// Bounds on the errors of an impact.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ImpactError {
    /// Error of the time, s.
    pub time_s: f64,
    /// Error of the angular velocity before the impact, rad/s.
    pub speed_rad_s: f64,
}

/// A point of a history.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct HistoryPoint<N = f64> {
    /// Time in s.
    pub time_s: N,
    /// Rotation theta in rad, signed.
    pub rotation_rad: N,
    /// Angular velocity in rad/s, signed.
    pub velocity_rad_s: N,
}

/// Work counters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Work {
    /// Taylor polynomials expanded.
    pub steps: u64,
    /// Impacts solved.
    pub impacts: u64,
    /// Turning points above all before.
    pub turning_points: u64,
    /// Uplifts from rest.
    pub uplifts: u64,
    /// Intervals (or blocks of intervals) scanned at rest.
    pub rest_scans: u64,
}

/// The response to a scene, in the numbers of the run.
#[derive(Clone, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Response<N = f64> {
    /// Outcome of this run.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub outcome: Outcome<N>,
    /// Largest |theta|/alpha reached before overturning, before the end of
    /// observation, or at all.
    pub peak_ratio: N,
    /// Time of the peak, s.
    pub peak_time_s: Option<N>,
    /// First uplift, s.
    pub uplift_time_s: Option<N>,
    /// Final coming to rest before the end of observation, s; recorded with
    /// events.
    pub rest_time_s: Option<N>,
    /// Impacts in order; recorded with events.
    pub impacts: Vec<Impact<N>>,
    /// Distance of the run from the other outcome, in units of the slenderness
    /// angle (see the criterion in [`Overturning`]).
    pub fate_margin: f64,
    /// Bound on the error of the peak ratio; recorded with accuracy, `None` if
    /// a decision is not clear.
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
    #[cfg_attr(
        feature = "serde",
        serde(skip_serializing_if = "Option::is_none")
    )]
    pub input_certificate: Option<Certificate>,
    /// Estimated worst ratio of error to margin over all decisions. Only runs
    /// that observe nothing but the peak compute it; a large value means that
    /// the full certificate should be computed.
    #[cfg_attr(
        feature = "serde",
        serde(skip_serializing_if = "Option::is_none")
    )]
    pub doubt: Option<f64>,
    /// Work counters.
    pub work: Work,
    /// History of the signed rotation; recorded with an interval.
    #[cfg_attr(
        feature = "serde",
        serde(skip_serializing_if = "Vec::is_empty")
    )]
    pub history: Vec<HistoryPoint<N>>,
    /// Friction and normal force that the motion needs at the pivot; recorded
    /// with forces.
    pub forces: Option<Forces>,
}

impl<N> Response<N> {
    /// The name of the outcome; `unresolved` if the error of the run may have
    /// turned a decision or was not assessed.
    pub fn outcome_name(&self) -> &'static str {
        match self.assessment() {
            Assessment::Clear => self.outcome.name(),
            Assessment::Unresolved | Assessment::NotAssessed => "unresolved",
        }
    }

    /// True if the rough estimate is not small or not known.
    pub(crate) fn is_doubtful(&self) -> bool {
        // NaN is doubtful.
        !self.doubt.is_some_and(|doubt| doubt < DOUBTFUL)
    }

    /// Whether outcome and peak are resolved in this precision.
    pub fn assessment(&self) -> Assessment {
        match self.certificate {
            None => Assessment::NotAssessed,
            Some(certificate) if certificate.is_clear() => Assessment::Clear,
            Some(_) => Assessment::Unresolved,
        }
    }
}

/// Whether outcome and peak of a run are resolved in its precision.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Assessment {
    /// No error of the run can turn any of its decisions.
    Clear,
    /// The error of the run may have turned one of its decisions.
    Unresolved,
    /// No error was assessed.
    NotAssessed,
}
