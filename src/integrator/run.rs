//! One run of a scene: its driver, by the kind of excitation and the class.

use crate::excitation::{Excitation, RecordIndex};
use crate::integrator::class::{Class, LONGEST};
use crate::integrator::driver::{Again, Driver};
use crate::integrator::dynamics::Dynamics;
use crate::integrator::forcing::{RecordForcing, Shaking};
use crate::integrator::{Observe, Order, Response, Scene, SceneError, Solver};
use crate::number::dispatch::Kernel;

pub(super) fn run(
    scene: &Scene<'_>,
    observe: &Observe,
    solver: Solver,
    again: Again,
) -> Result<Response, SceneError> {
    let own = own_index(scene);
    let index = index_of(scene, own.as_ref());
    solver.isa.run(RunKernel { scene, observe, index, solver, again })
}

/// Index of a record that brings none.
pub(super) fn own_index(scene: &Scene<'_>) -> Option<RecordIndex> {
    match scene.excitation {
        Excitation::Record(record) if record.index().is_none() => {
            Some(RecordIndex::new(record.samples()))
        }
        Excitation::Record(_) | Excitation::Pulse(_) | Excitation::Free => {
            None
        }
    }
}

/// The record's index, or its own; none without a record.
pub(super) fn index_of<'a>(
    scene: &Scene<'a>,
    own: Option<&'a RecordIndex>,
) -> Option<&'a RecordIndex> {
    match scene.excitation {
        Excitation::Record(record) => record.index().or(own),
        Excitation::Pulse(_) | Excitation::Free => None,
    }
}

/// One run, compiled for each instruction-set level.
struct RunKernel<'a> {
    scene: &'a Scene<'a>,
    observe: &'a Observe,
    index: Option<&'a RecordIndex>,
    solver: Solver,
    again: Again,
}

impl Kernel for RunKernel<'_> {
    type Output = Result<Response, SceneError>;

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Scene { block, restitution, model, overturning, .. } = *self.scene;
        let p = block.frequency_rad_s();
        let dynamics =
            Dynamics::<f64>::new(&block, restitution, model, overturning);
        match (self.scene.excitation, self.index) {
            (Excitation::Record(record), Some(index)) => {
                let forcing = RecordForcing::new(record, index, p);
                let step = forcing.step();
                match Class::of(model, step, self.solver.order) {
                    Class::Eight => self.at::<9>(dynamics, forcing),
                    Class::Nine => self.at::<10>(dynamics, forcing),
                    Class::Ten => self.at::<11>(dynamics, forcing),
                    Class::Longest | Class::Linearized => {
                        self.at::<LONGEST>(dynamics, forcing)
                    }
                    Class::Fixed(order) => {
                        self.at_order(order, dynamics, forcing)
                    }
                }
            }
            (_, index) => {
                let ground = Shaking::of(self.scene, index, self.solver.isa);
                Driver::<_, _, LONGEST, LONGEST>::new(
                    dynamics,
                    ground,
                    self.solver.isa,
                )
                .for_peak_if(self.solver.peak_only)
                .again(self.again)
                .run::<LONGEST>(self.scene, self.observe)
            }
        }
    }
}

impl RunKernel<'_> {
    /// By series of `LEN` coefficients, longer where they leave too much.
    #[inline(always)]
    fn at<const LEN: usize>(
        &self,
        dynamics: Dynamics<f64>,
        forcing: RecordForcing<'_, f64>,
    ) -> Result<Response, SceneError> {
        self.driver(dynamics, forcing).run::<LEN>(self.scene, self.observe)
    }

    #[inline(always)]
    fn at_order(
        &self,
        order: Order,
        dynamics: Dynamics<f64>,
        forcing: RecordForcing<'_, f64>,
    ) -> Result<Response, SceneError> {
        match order {
            Order::Four => self.fixed::<5>(dynamics, forcing),
            Order::Six => self.fixed::<7>(dynamics, forcing),
            Order::Eight => self.fixed::<9>(dynamics, forcing),
            Order::Ten => self.fixed::<11>(dynamics, forcing),
        }
    }

    /// By series of `LEN` coefficients, whatever they leave.
    #[inline(always)]
    fn fixed<const LEN: usize>(
        &self,
        dynamics: Dynamics<f64>,
        forcing: RecordForcing<'_, f64>,
    ) -> Result<Response, SceneError> {
        self.driver(dynamics, forcing)
            .within(f64::INFINITY)
            .run::<LEN>(self.scene, self.observe)
    }

    #[inline(always)]
    fn driver<'r>(
        &self,
        dynamics: Dynamics<f64>,
        forcing: RecordForcing<'r, f64>,
    ) -> Driver<f64, RecordForcing<'r, f64>, 2, LONGEST> {
        Driver::new(dynamics, forcing, self.solver.isa)
            .for_peak_if(self.solver.peak_only)
            .again(self.again)
    }
}
