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
                let class =
                    Class::of(model, forcing.step(), self.solver.order);
                match class {
                    Class::Eight | Class::Fixed(Order::Eight) => {
                        self.at::<9>(class, dynamics, forcing)
                    }
                    Class::Nine => self.at::<10>(class, dynamics, forcing),
                    Class::Ten | Class::Fixed(Order::Ten) => {
                        self.at::<11>(class, dynamics, forcing)
                    }
                    Class::Longest | Class::Linearized => {
                        self.at::<LONGEST>(class, dynamics, forcing)
                    }
                    Class::Fixed(Order::Four) => {
                        self.at::<5>(class, dynamics, forcing)
                    }
                    Class::Fixed(Order::Six) => {
                        self.at::<7>(class, dynamics, forcing)
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
    /// By series of `LEN` coefficients, longer where they leave more than the
    /// class allows.
    #[inline(always)]
    fn at<const LEN: usize>(
        &self,
        class: Class,
        dynamics: Dynamics<f64>,
        forcing: RecordForcing<'_, f64>,
    ) -> Result<Response, SceneError> {
        Driver::<_, _, 2, LONGEST>::new(dynamics, forcing, self.solver.isa)
            .for_peak_if(self.solver.peak_only)
            .again(self.again)
            .within(class.tolerance())
            .run::<LEN>(self.scene, self.observe)
    }
}
