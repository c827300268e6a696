//! Runs in other arithmetic than double precision, from the same source.

use crate::excitation::Excitation;
use crate::integrator::driver::Driver;
use crate::integrator::dynamics::Dynamics;
use crate::integrator::forcing::{PulseForcing, RecordForcing, Silence};
use crate::integrator::run::{index_of, own_index};
use crate::integrator::{Observe, Response, Scene, SceneError, check};
use crate::number::Real;
use crate::number::dispatch::Isa;
use crate::number::double::DoubleDouble;

/// Coefficients of every series: at steps of a tenth of 1/p the next one is
/// below the roundoff of a double-double; longer motion than that, in strong
/// forcing, is stepped in parts.
const SIZE: usize = 28;

/// Integrates a scene in double-double arithmetic: about 30 digits, at some
/// hundred times the cost of [`respond`](crate::integrator::respond).
///
/// # Errors
/// As [`respond`](crate::integrator::respond).
///
/// ```
/// use rocking::block::{Block, Restitution};
/// use rocking::excitation::{Excitation, Pulse, PulseKind};
/// use rocking::integrator::{
///     Model, Observe, Overturning, Scene, respond_precise,
/// };
/// // Amplitude in m/s2: its quotient by g is rounded to 32 digits.
/// let kind = PulseKind::OneSine { amplitude_g: 1.5, omega_rad_s: 12.0 };
/// let pulse = Pulse::try_new_si(kind, 9.81)?;
/// let scene = Scene {
///     block: Block::try_new(0.1, 3.0)?,
///     restitution: Restitution::constant(0.92)?,
///     model: Model::Nonlinear,
///     overturning: Overturning::Alpha,
///     excitation: Excitation::Pulse(&pulse),
///     initial_ratio: 0.0,
/// };
/// let answer = respond_precise(&scene, &Observe::default())?;
/// // A 36-digit reference: 0.493881599743772889432469876681278552.
/// assert_eq!(answer.peak_ratio.hi(), 0.4938815997437729);
/// assert!((answer.peak_ratio.lo() - 8.348755566601465e-18).abs() < 1e-30);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn respond_precise(
    scene: &Scene<'_>,
    observe: &Observe,
) -> Result<Response<DoubleDouble>, SceneError> {
    respond_in(scene, observe)
}

/// Integrates a scene in the arithmetic of `N`, at order 27.
///
/// # Errors
/// As [`respond`](crate::integrator::respond).
pub fn respond_in<N: Real>(
    scene: &Scene<'_>,
    observe: &Observe,
) -> Result<Response<N>, SceneError> {
    check(scene, observe)?;
    let Scene { block, restitution, model, overturning, .. } = *scene;
    let p = block.frequency_rad_s();
    let dynamics = Dynamics::new(&block, restitution, model, overturning);
    let own = own_index(scene);
    let isa = Isa::best();
    match (scene.excitation, index_of(scene, own.as_ref())) {
        (Excitation::Record(record), Some(index)) => {
            let forcing = RecordForcing::new(record, index, p);
            Driver::<N, _, SIZE, 2, SIZE>::new(dynamics, forcing, isa)
                .run(scene, observe)
        }
        (Excitation::Pulse(pulse), _) => {
            let forcing = PulseForcing::new(pulse, p);
            Driver::<N, _, SIZE, SIZE, SIZE>::new(dynamics, forcing, isa)
                .run(scene, observe)
        }
        (Excitation::Record(_) | Excitation::Free, _) => {
            let silence = Silence::nothing();
            Driver::<N, _, SIZE, 1, SIZE>::new(dynamics, silence, isa)
                .run(scene, observe)
        }
    }
}
