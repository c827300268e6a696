//! Runs in other arithmetic than double precision, from the same source.

use std::marker::PhantomData;

use crate::integrator::driver::{Driver, Step};
use crate::integrator::dynamics::Dynamics;
use crate::integrator::forcing::Shaking;
use crate::integrator::roots::MOST;
use crate::integrator::run::index_of;
use crate::integrator::{Observe, Response, Scene, SceneError, check};
use crate::number::dispatch::Isa;
use crate::number::{Real, SeriesWork};

/// Integrates a scene in the arithmetic of `N`, by series as long as that
/// needs: [`DoubleDouble`](crate::number::double::DoubleDouble), about 30
/// digits at some hundred times the cost of
/// [`respond`](crate::integrator::respond), or
/// [`Octuple`](crate::number::octuple::Octuple), about 77 digits at ten times
/// the cost of that.
///
/// # Errors
/// As [`respond`](crate::integrator::respond).
///
/// ```
/// use rocking::{Block, Excitation, Observe, Restitution, Scene};
/// use rocking::excitation::{Pulse, PulseKind};
/// use rocking::integrator::respond_precise;
/// use rocking::number::{Number, Real, double::DoubleDouble};
/// use rocking::number::octuple::Octuple;
/// // Amplitude in m/s2: its quotient by g is rounded in the arithmetic.
/// let kind = PulseKind::OneSine { amplitude: 1.5, omega_rad_s: 12.0 };
/// let pulse = Pulse::try_new_si(kind, 9.81)?;
/// let scene = Scene::new(
///     Block::try_new(0.1, 3.0)?,
///     Restitution::constant(0.92)?,
///     Excitation::Pulse(&pulse),
/// );
/// let observe = Observe::default();
/// let double = respond_precise::<DoubleDouble>(&scene, &observe)?;
/// // A 36-digit reference: 0.493881599743772889432469876681278552.
/// assert_eq!(double.peak_ratio.hi(), 0.4938815997437729);
/// assert!((double.peak_ratio.lo() - 8.348755566601465e-18).abs() < 1e-30);
/// // By series of 70 terms in mpmath, to 115 digits, as a sum of doubles:
/// // 0.493881599743772889432469876681278552283020767363913170322647914506...
/// let reference = [
///     0.4938815997437729,
///     8.348755566601465e-18,
///     8.624307969642422e-35,
///     -4.698813367950177e-51,
///     8.681026477841767e-69,
/// ];
/// let octuple = respond_precise::<Octuple>(&scene, &observe)?;
/// let error = reference
///     .map(Octuple::from_f64)
///     .into_iter()
///     .fold(octuple.peak_ratio, |rest, part| rest - part);
/// assert!(error.abs().to_f64() < 1e-75);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond_precise<N: Real>(
    scene: &Scene<'_>,
    observe: &Observe,
) -> Result<Response<N>, SceneError> {
    respond_precisely(scene, observe, false, &|_| {})
}

/// [`respond_precise`]; with `peak_only` it ends as soon as outcome and peak
/// are surely known. Calls `progress` with the time (s) in the scene before
/// each step.
///
/// # Errors
/// As [`respond`](crate::integrator::respond).
pub(crate) fn respond_precisely<N: Real>(
    scene: &Scene<'_>,
    observe: &Observe,
    peak_only: bool,
    progress: &dyn Fn(f64),
) -> Result<Response<N>, SceneError> {
    check(scene, observe)?;
    let number = PhantomData::<N>;
    let run = PreciseRun { scene, observe, peak_only, progress, number };
    N::with_lengths(run)
}

/// A run of a scene.
struct PreciseRun<'a, N> {
    scene: &'a Scene<'a>,
    observe: &'a Observe,
    peak_only: bool,
    progress: &'a dyn Fn(f64),
    number: PhantomData<N>,
}

impl<N: Real> crate::number::sealed::Sealed for PreciseRun<'_, N> {}

impl<N: Real> SeriesWork for PreciseRun<'_, N> {
    type Output = Result<Response<N>, SceneError>;

    fn run<const SHORT: usize, const LONG: usize>(self) -> Self::Output {
        const { assert!(SHORT <= LONG && LONG <= MOST) };
        let Self { scene, observe, peak_only, progress, .. } = self;
        let Scene { block, restitution, model, overturning, .. } = *scene;
        let dynamics = Dynamics::new(&block, restitution, model, overturning);
        let (index, isa) = (index_of(scene), Isa::best());
        let ground = Shaking::of(scene, index.as_deref(), isa);
        let short = match &ground {
            Shaking::Record(record) => is_short::<N>(record.step(), SHORT),
            Shaking::Pulse(_) | Shaking::Silence(_) => false,
        };
        let mut driver =
            Driver::<N, _, LONG, LONG>::new(dynamics, ground, isa);
        if peak_only {
            driver = driver.for_peak();
        }
        let see = |driver: &Driver<N, _, LONG, LONG>, step: &Step<N>| {
            progress(driver.time_s(step.place).to_f64());
        };
        if short {
            driver.run::<SHORT>(scene, observe, see)
        } else {
            driver.run::<LONG>(scene, observe, see)
        }
    }
}

/// True if the truncation error of a series of `length` coefficients is at
/// most the roundoff over a step (in 1/p), for a motion whose coefficients do
/// not grow.
fn is_short<N: Real>(step: f64, length: usize) -> bool {
    libm::log(step) * (length as f64) < libm::log(N::ROUNDOFF)
}

#[cfg(test)]
mod tests;
