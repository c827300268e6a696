//! Runs in other arithmetic than double precision, from the same source.

use std::marker::PhantomData;

use crate::excitation::Excitation;
use crate::integrator::driver::{Driver, TRUNCATION_SHARE};
use crate::integrator::dynamics::Dynamics;
use crate::integrator::forcing::{Forcing, RecordForcing, Shaking};
use crate::integrator::roots::MOST;
use crate::integrator::run::index_of;
use crate::integrator::{Extent, Observe, Response, Scene, SceneError, check};
use crate::number::dispatch::Isa;
use crate::number::{Real, SeriesWork};

/// Truncation error in a step, as a share of the velocity, that suffices for
/// outcome and peak.
const ENOUGH: f64 = 1e-27;

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
    respond_precisely(scene, observe, Extent::Whole, &|_| {})
}

/// The needed part of [`respond_precise`]. Calls `progress` with the time (s) in the scene before
/// each step.
///
/// # Errors
/// As [`respond`](crate::integrator::respond).
pub(crate) fn respond_precisely<N: Real>(
    scene: &Scene<'_>,
    observe: &Observe,
    extent: Extent,
    progress: &dyn Fn(f64),
) -> Result<Response<N>, SceneError> {
    check(scene, observe)?;
    let number = PhantomData::<N>;
    let run = PreciseRun { scene, observe, extent, progress, number };
    N::with_lengths(run)
}

/// A run of a scene.
struct PreciseRun<'a, N> {
    scene: &'a Scene<'a>,
    observe: &'a Observe,
    extent: Extent,
    progress: &'a dyn Fn(f64),
    number: PhantomData<N>,
}

impl<N: Real> crate::number::sealed::Sealed for PreciseRun<'_, N> {}

impl<N: Real> SeriesWork for PreciseRun<'_, N> {
    type Output = Result<Response<N>, SceneError>;

    fn run<const SHORT: usize, const LONG: usize>(self) -> Self::Output {
        const { assert!(SHORT <= LONG && LONG <= MOST) };
        let Excitation::Record(record) = self.scene.excitation else {
            let ground = Shaking::of(self.scene, Isa::best());
            return self.under::<_, LONG, LONG, LONG>(ground, N::ROUNDOFF);
        };
        let index = index_of(&record);
        let p = self.scene.block.frequency_rad_s();
        let ground = RecordForcing::new(record, &index, p);
        let share = match self.extent {
            Extent::Whole => N::ROUNDOFF,
            Extent::Peak | Extent::Outcome => ENOUGH.max(N::ROUNDOFF),
        };
        if is_short(ground.step(), SHORT, share) {
            self.under::<_, 2, SHORT, LONG>(ground, share)
        } else {
            self.under::<_, 2, LONG, LONG>(ground, share)
        }
    }
}

impl<N: Real> PreciseRun<'_, N> {
    /// The run by series of `LEN` coefficients, or of `LONG` ones if the
    /// truncation error of a step is above half of `share` of the velocity.
    fn under<
        G: Forcing<N, F>,
        const F: usize,
        const LEN: usize,
        const LONG: usize,
    >(
        self,
        ground: G,
        share: f64,
    ) -> Result<Response<N>, SceneError> {
        let Self { scene, observe, extent, progress, .. } = self;
        let Scene { block, restitution, model, overturning, .. } = *scene;
        let dynamics = Dynamics::new(&block, restitution, model, overturning);
        let driver =
            Driver::<N, G, F, LONG>::new(dynamics, ground, Isa::best())
                .within(TRUNCATION_SHARE * share)
                .for_extent(extent);
        driver.run::<LEN>(scene, observe, |driver, step| {
            progress(driver.time_s(step.place).to_f64());
        })
    }
}

/// True if the last of `length` coefficients is surely at most `share` of the
/// first over a step (in 1/p). Strong forcing makes later coefficients larger
/// than those of free motion, by less than this factor.
fn is_short(step: f64, length: usize, share: f64) -> bool {
    const FORCED: f64 = 30.0;
    let last = (length - 1) as f64;
    let size = last * libm::log(step) - libm::lgamma(last + 1.0);
    size < libm::log(share / FORCED)
}

#[cfg(test)]
mod tests;
