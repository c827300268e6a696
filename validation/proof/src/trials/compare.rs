//! A run in double precision against the truth.

use rocking::integrator::{
    Assessment, CLEARANCE, Certificate, Decision, Observe, Response, Scene,
    SceneError, WorkLimit, respond_precise,
};
use rocking::number::double::DoubleDouble;
use rocking::number::octuple::Octuple;
use rocking::number::{Number as _, Real};

use crate::arithmetic::wide;
use crate::cases::WrongModel;
use crate::engine::{Quotient, on_core, respond};
use crate::scene::{CaseScene, EngineResult};

/// A scene with its address.
#[derive(Clone, Debug, PartialEq)]
pub struct Trial {
    /// Stratum, index and kind of the excitation.
    pub name: String,
    /// The scene.
    pub scene: CaseScene,
}

/// Result of a run in double precision, and its own claims about it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DoubleRun {
    /// True if the block overturned.
    pub overturned: bool,
    /// Largest |theta|/alpha.
    pub peak_ratio: f64,
    /// Bound on the error of the peak, at least one unit in the last place of
    /// 1, which is the limit for a run without motion.
    pub estimate: f64,
    /// Certificate of outcome and peak.
    pub certificate: Certificate,
}

impl DoubleRun {
    /// The result and claims of a response.
    pub fn of(response: &Response) -> Self {
        let estimate = response.error_estimate.unwrap_or(f64::INFINITY);
        Self {
            overturned: response.outcome.is_overturned(),
            peak_ratio: response.peak_ratio,
            estimate: estimate.max(f64::EPSILON),
            certificate: response.certificate.unwrap_or_default(),
        }
    }
}

/// Reading of a certificate: correctly, or as a wrong model reads it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CertificateReading(pub Option<WrongModel>);

impl CertificateReading {
    /// The correct reading.
    pub const WHOLE: Self = Self(None);

    /// Factor on every error.
    fn factor(self) -> f64 {
        match self.0 {
            Some(WrongModel::TenthOfTheError) => 0.1,
            Some(WrongModel::HundredthOfTheError) => 0.01,
            _ => 1.0,
        }
    }

    /// True if the run can be relied on.
    pub fn is_clear(self, seen: &DoubleRun) -> bool {
        use Decision::{Contact, End, Overturning, Rest, Uplift};
        Decision::ALL.into_iter().all(|decision| {
            let left_out = match self.0 {
                Some(WrongModel::WithoutBranches) => {
                    matches!(decision, Uplift | Contact | Rest)
                }
                Some(WrongModel::MarginInfinity) => {
                    decision == Overturning && seen.overturned
                }
                Some(WrongModel::WithoutEnd) => decision == End,
                _ => false,
            };
            let ratio = seen.certificate.of(decision).ratio / self.factor();
            left_out || ratio >= CLEARANCE
        })
    }

    /// Bound on the error of the peak.
    pub fn estimate(self, seen: &DoubleRun) -> f64 {
        seen.estimate * self.factor()
    }
}

/// Result of wider arithmetic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WideTruth {
    /// The block survives.
    Stands {
        /// Largest |theta|/alpha.
        peak_ratio: DoubleDouble,
        /// Bound on the error of the peak.
        error: f64,
    },
    /// The block overturned.
    Overturned,
    /// No available arithmetic decides.
    Undecided,
}

/// A trial, its run in double precision and the truth.
#[derive(Clone, Debug, PartialEq)]
pub struct Finding {
    /// Address and kind of the trial.
    pub name: String,
    /// The run in double precision.
    pub seen: DoubleRun,
    /// The truth.
    pub truth: WideTruth,
}

impl Finding {
    /// Error of the peak beyond the uncertainty of the truth; none if either
    /// has no peak.
    pub fn error(&self) -> Option<f64> {
        let (WideTruth::Stands { peak_ratio, error }, false) =
            (self.truth, self.seen.overturned)
        else {
            return None;
        };
        let difference = (wide(self.seen.peak_ratio) - peak_ratio).abs();
        let beyond = difference.to_f64() - error;
        // Not a number stays one.
        Some(if beyond < 0.0 { 0.0 } else { beyond })
    }
}

/// Outcome and peak of a scene by wider arithmetic, until `until_s` (s):
/// octuple precision if double-double leaves them open.
pub(crate) fn truth(
    scene: &Scene<'_>,
    until_s: Option<f64>,
) -> Result<WideTruth, SceneError> {
    match by::<DoubleDouble>(scene, until_s)? {
        WideTruth::Undecided => by::<Octuple>(scene, until_s),
        truth => Ok(truth),
    }
}

/// Work of a run in wider arithmetic: a step there takes up to a millisecond.
pub(crate) const WORK: WorkLimit =
    WorkLimit { impacts: 100_000, steps: 400_000 };

/// The truth by one arithmetic.
fn by<N: Real>(
    scene: &Scene<'_>,
    until_s: Option<f64>,
) -> Result<WideTruth, SceneError> {
    let (accuracy, work_limit) = (true, WORK);
    let observe =
        Observe { accuracy, until_s, work_limit, ..Observe::default() };
    let response = respond_precise::<N>(scene, &observe)?;
    let error = response.error_estimate.unwrap_or(f64::INFINITY);
    Ok(if response.assessment() != Assessment::Clear {
        WideTruth::Undecided
    } else if response.outcome.is_overturned() {
        WideTruth::Overturned
    } else {
        let peak_ratio = wide(response.peak_ratio);
        WideTruth::Stands { peak_ratio, error }
    })
}

/// Runs a trial in double precision and in wider arithmetic.
///
/// # Errors
/// If the scene is refused.
///
/// ```
/// use rocking_proof::trials::{
///     CertificateReading, Judgement, Stratum, compare, trial,
/// };
/// let trial = trial(Stratum::Ordinary, 0)?.unwrap();
/// let finding = compare(&trial)?;
/// let judgement = Judgement::of(&finding, CertificateReading::WHOLE);
/// assert!(matches!(judgement, Judgement::Right | Judgement::Within(_)));
/// # Ok::<(), rocking_proof::scene::EngineError>(())
/// ```
pub fn compare(trial: &Trial) -> EngineResult<Finding> {
    let observe = Observe { accuracy: true, ..Observe::default() };
    let response = respond(&trial.scene, &observe)?;
    Ok(Finding {
        name: trial.name.clone(),
        seen: DoubleRun::of(&response),
        truth: on_core(&trial.scene, Quotient::Rounded, |scene| {
            truth(scene, trial.scene.until_s)
        })?,
    })
}
