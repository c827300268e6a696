//! Outcomes resolved in the arithmetic that they need.

use std::fmt;

use crate::integrator::precise::respond_precisely;
use crate::integrator::{
    Assessment, Certificate, Clearance, Extent, Observe, Outcome, Response,
    Scene, SceneError, Solver, WorkLimit,
};
use crate::names::named;
use crate::number::Real;
use crate::number::double::DoubleDouble;
use crate::number::octuple::Octuple;

named! {
    /// Arithmetic of a run.
    pub enum Arithmetic: "arithmetic" {
        /// Double precision.
        Double = "double",
        /// Double-double, about 30 digits.
        DoubleDouble = "double-double",
        /// Octuple precision, about 77 digits: the widest tried.
        Octuple = "octuple",
    }
}

/// Largest bound on the error of a peak ratio that counts as resolved. The
/// rough estimate flags a peak from a standard deviation of a quarter of it.
const PEAK_ERROR: f64 = 1e-6;

/// Options of [`certify`]. Default: the whole run, the default work limit, no
/// progress callback.
///
/// ```
/// use rocking::{Block, Excitation, Restitution, Scene};
/// use rocking::integrator::{Certify, Outcome, certify};
/// let free = Scene {
///     initial_ratio: 0.5,
///     ..Scene::new(
///         Block::try_new(0.1, 3.0)?,
///         Restitution::constant(0.92)?,
///         Excitation::Free,
///     )
/// };
/// // The block stands after 2 s, and its peak is the release.
/// let ask = Certify { until_s: Some(2.0), ..Certify::default() };
/// let fate = certify(&free, &ask)?;
/// assert!(fate.resolved);
/// assert_eq!(fate.outcome, Outcome::Rocked { peak_ratio: 0.5 });
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy)]
pub struct Certify<'a> {
    /// Stop at this time (s) instead of at the last possible event.
    pub until_s: Option<f64>,
    /// Work limit of each of up to three runs.
    pub work_limit: WorkLimit,
    /// How much of the run is needed: outcome and peak, or only the outcome.
    pub extent: Extent,
    /// Called before each step of a run in wider arithmetic than double
    /// precision, with that arithmetic and the time (s) in the scene.
    pub progress: &'a dyn Fn(Arithmetic, f64),
}

impl Default for Certify<'_> {
    fn default() -> Self {
        let work_limit = WorkLimit::default();
        let extent = Extent::Peak;
        Self { until_s: None, work_limit, extent, progress: &|_, _| {} }
    }
}

impl fmt::Debug for Certify<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Certify")
            .field("until_s", &self.until_s)
            .field("work_limit", &self.work_limit)
            .field("extent", &self.extent)
            .finish_non_exhaustive()
    }
}

/// An outcome and the evidence for it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct CertifiedFate {
    /// Outcome in the arithmetic `by`.
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub outcome: Outcome,
    /// Distance from the other outcome, in units of the slenderness angle.
    pub margin: f64,
    /// Bound on the error of the peak ratio; `None` if it is unresolved.
    pub error: Option<f64>,
    /// The least clear decision of the run.
    pub least: Clearance,
    /// False if a decision is not clear in the widest arithmetic, or if the
    /// error of the peak ratio of a block that stands may be above 1e-6.
    pub resolved: bool,
    /// False if other inputs that round to the same doubles may have another
    /// outcome. The outcome then holds only for these doubles.
    pub resolved_for_inputs: bool,
    /// The arithmetic that resolved the outcome, or the widest one.
    pub by: Arithmetic,
    /// Outcome in double precision.
    pub double: Outcome,
}

impl CertifiedFate {
    fn of<N: Real>(
        response: &Response<N>,
        extent: Extent,
        by: Arithmetic,
    ) -> Self {
        let outcome = match response.outcome {
            Outcome::NoUplift => Outcome::NoUplift,
            Outcome::Rocked { peak_ratio } => {
                Outcome::Rocked { peak_ratio: peak_ratio.to_f64() }
            }
            Outcome::Overturned { time_s, side } => {
                Outcome::Overturned { time_s: time_s.to_f64(), side }
            }
        };
        let of = |c: Option<Certificate>| c.unwrap_or_default();
        let certificate = of(response.certificate);
        let clear = response.assessment() == Assessment::Clear;
        let error = response.error_estimate;
        let close = extent == Extent::Outcome
            || error.is_some_and(|error| error <= PEAK_ERROR);
        let of_inputs = of(response.input_certificate);
        Self {
            outcome,
            margin: response.fate_margin,
            error,
            least: certificate.least(),
            resolved: clear && (close || outcome.is_overturned()),
            resolved_for_inputs: of_inputs.is_clear(),
            by,
            double: outcome,
        }
    }

    /// True if overturning in double precision differs from `outcome`.
    pub fn wrong_in_double(&self) -> bool {
        self.outcome.is_overturned() != self.double.is_overturned()
    }
}

/// Resolves outcome and peak of a run in the least of double, double-double
/// and octuple precision that is enough. An arithmetic is enough if every
/// decision is clear of its error and the error of the peak ratio of a block
/// that stands is at most 1e-6. If none is enough, the run is unresolved.
///
/// The result holds for the given doubles. `resolved_for_inputs` says whether
/// it holds for all inputs that round to them. An end of observation is one
/// of the decisions.
///
/// # Errors
/// As [`respond`](crate::integrator::respond).
///
/// ```
/// use rocking::{Block, Excitation, Restitution, Scene};
/// use rocking::excitation::{Pulse, PulseKind};
/// use rocking::integrator::{Arithmetic, Certify, Overturning, certify};
/// // One unit in the last place above the critical amplitude.
/// let kind = PulseKind::HalfSine {
///     amplitude: 4.072395807424461,
///     omega_rad_s: 5.0,
/// };
/// let pulse = Pulse::try_new_si(kind, 9.81)?;
/// let block = Block::try_new(0.2, 2.0)?;
/// let restitution = Restitution::constant(0.92)?;
/// let scene = Scene {
///     overturning: Overturning::HalfPi,
///     ..Scene::new(block, restitution, Excitation::Pulse(&pulse))
/// };
/// let fate = certify(&scene, &Certify::default())?;
/// assert_eq!(fate.by, Arithmetic::DoubleDouble);
/// assert!(fate.resolved && fate.outcome.is_overturned());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn certify(
    scene: &Scene<'_>,
    ask: &Certify<'_>,
) -> Result<CertifiedFate, SceneError> {
    let Certify { until_s, work_limit, .. } = *ask;
    let accuracy = true;
    let observe =
        Observe { accuracy, until_s, work_limit, ..Observe::default() };
    let solver = Solver { extent: ask.extent, ..Solver::default() };
    let quick = solver.respond_once(scene, &observe)?;
    let quick = CertifiedFate::of(&quick, ask.extent, Arithmetic::Double);
    if quick.resolved {
        return Ok(quick);
    }
    let double = quick.outcome;
    let by = Arithmetic::DoubleDouble;
    let wide = fate_in::<DoubleDouble>(scene, &observe, ask, by)?;
    if wide.resolved {
        return Ok(CertifiedFate { double, ..wide });
    }
    let by = Arithmetic::Octuple;
    let widest = fate_in::<Octuple>(scene, &observe, ask, by)?;
    Ok(CertifiedFate { double, ..widest })
}

/// The fate in a wider arithmetic than double precision.
fn fate_in<N: Real>(
    scene: &Scene<'_>,
    observe: &Observe,
    ask: &Certify<'_>,
    by: Arithmetic,
) -> Result<CertifiedFate, SceneError> {
    let report = |time_s| (ask.progress)(by, time_s);
    let response =
        respond_precisely::<N>(scene, observe, ask.extent, &report)?;
    Ok(CertifiedFate::of(&response, ask.extent, by))
}

#[cfg(test)]
mod tests {
    use super::{Arithmetic, Certify, certify};
    use crate::accelerogram::Accelerogram;
    use crate::block::{Block, Restitution};
    use crate::excitation::{
        Excitation, NormalisedRecord, Pulse, PulseKind, ScaledRecord,
    };
    use crate::integrator::{
        Assessment, Observe, Outcome, Overturning, Scene, Side, Solver,
    };

    /// Fate of the reference `hs-near-ulp-above` at another amplitude.
    fn fate(amplitude_m_s2: f64) -> super::CertifiedFate {
        let kind = PulseKind::HalfSine {
            amplitude: amplitude_m_s2,
            omega_rad_s: 5.0,
        };
        let pulse = Pulse::try_new_si(kind, 9.81).unwrap();
        let block = Block::try_new(0.2, 2.0).unwrap();
        let restitution = Restitution::constant(0.92).unwrap();
        let scene = Scene {
            overturning: Overturning::HalfPi,
            ..Scene::new(block, restitution, Excitation::Pulse(&pulse))
        };
        certify(&scene, &Certify::default()).unwrap()
    }

    #[test]
    fn the_doubles_around_a_critical_amplitude_are_resolved() {
        // The reference names the first double above the critical amplitude.
        let first = 4.072_395_807_424_461_f64;
        let mut below = first;
        let mut above = first;
        for _ in 0..4 {
            below = below.next_down();
            for (amplitude, overturns) in [(below, false), (above, true)] {
                let fate = fate(amplitude);
                assert!(fate.resolved, "{amplitude}: {fate:?}");
                assert_eq!(
                    fate.outcome.is_overturned(),
                    overturns,
                    "{fate:?}"
                );
            }
            above = above.next_up();
        }
        assert_eq!(fate(first).by, Arithmetic::DoubleDouble);
    }

    #[test]
    fn a_clear_fate_is_resolved_in_double_precision() {
        for amplitude in [3.0, 5.0] {
            let fate = fate(amplitude);
            assert!(
                fate.resolved
                    && fate.by == Arithmetic::Double
                    && !fate.wrong_in_double()
            );
        }
    }

    /// Every decision of ten seconds of rocking is clear in double precision,
    /// but not the sixth digit of the peak.
    #[test]
    fn a_clear_run_whose_peak_has_too_large_an_error_is_run_again() {
        let wave = |rate: f64, k: i32| libm::sin(rate * f64::from(k));
        let samples = (0..1000).map(|k| wave(0.27, k) + wave(0.618 * 0.27, k));
        let record = Accelerogram::try_new("waves", 0.01, samples.collect());
        let record = NormalisedRecord::new(&record.unwrap());
        let record = ScaledRecord::to_pga(&record, 0.11);
        let block = Block::try_new(0.1, 6.0).unwrap();
        let restitution = Restitution::constant(0.99).unwrap();
        let excitation = Excitation::Record(record);
        let scene = Scene::new(block, restitution, excitation);
        let observe = Observe { accuracy: true, ..Observe::default() };
        let double = Solver::default().respond(&scene, &observe).unwrap();
        assert_eq!(double.assessment(), Assessment::Clear);
        let error = double.error_estimate.unwrap();
        assert!(error > super::PEAK_ERROR && error < 1e-4, "{error:e}");
        let fate = certify(&scene, &Certify::default()).unwrap();
        assert!(fate.resolved && fate.by == Arithmetic::DoubleDouble);
        assert!(fate.error.unwrap() < 1e-15, "{fate:?}");
    }

    #[test]
    fn engines_disagree_about_a_fate_or_they_do_not() {
        let over = Outcome::Overturned { time_s: 1.0, side: Side::Negative };
        let stands = Outcome::Rocked { peak_ratio: 0.99 };
        for (outcome, double, wrong) in [
            (over, stands, true),
            (stands, over, true),
            (over, over, false),
            (stands, stands, false),
            (stands, Outcome::NoUplift, false),
        ] {
            let fate = super::CertifiedFate { outcome, double, ..fate(3.0) };
            assert_eq!(fate.wrong_in_double(), wrong);
        }
    }
}
