//! One run of a scene: its driver, by the kind of excitation and the class.

use std::borrow::Cow;

use crate::excitation::{Excitation, RecordIndex, ScaledRecord};
use crate::integrator::class::{Class, LONGEST};
use crate::integrator::driver::{Again, Driver, tolerance};
use crate::integrator::dynamics::Dynamics;
use crate::integrator::forcing::{Forcing, RecordForcing, Shaking};
use crate::integrator::{Observe, Order, Response, Scene, SceneError, Solver};
use crate::number::dispatch::Kernel;

pub(super) fn run(
    scene: &Scene<'_>,
    observe: &Observe,
    solver: Solver,
    again: Again,
) -> Result<Response, SceneError> {
    solver.isa.run(RunKernel { scene, observe, solver, again })
}

/// Index of a record: its own, or a new one if it has none.
pub(super) fn index_of<'a>(record: &ScaledRecord<'a>) -> Cow<'a, RecordIndex> {
    let new = || Cow::Owned(RecordIndex::new(record.samples()));
    record.index().map_or_else(new, Cow::Borrowed)
}

/// One run, compiled for each instruction-set level.
struct RunKernel<'a> {
    scene: &'a Scene<'a>,
    observe: &'a Observe,
    solver: Solver,
    again: Again,
}

impl Kernel for RunKernel<'_> {
    type Output = Result<Response, SceneError>;

    #[inline(always)]
    fn run(self) -> Self::Output {
        let Excitation::Record(record) = self.scene.excitation else {
            let ground = Shaking::of(self.scene, self.solver.isa);
            return self.at::<_, LONGEST, LONGEST>(tolerance::<f64>(), ground);
        };
        let index = index_of(&record);
        let p = self.scene.block.frequency_rad_s();
        let forcing = RecordForcing::new(record, &index, p);
        let order = self.solver.order;
        let class = Class::of(self.scene.model, forcing.step(), order);
        let share = class.tolerance();
        match class {
            Class::Fixed(Order::Four) => self.at::<_, 2, 5>(share, forcing),
            Class::Fixed(Order::Six) => self.at::<_, 2, 7>(share, forcing),
            Class::Eight | Class::Fixed(Order::Eight) => {
                self.at::<_, 2, 9>(share, forcing)
            }
            Class::Nine => self.at::<_, 2, 10>(share, forcing),
            Class::Ten | Class::Fixed(Order::Ten) => {
                self.at::<_, 2, 11>(share, forcing)
            }
            Class::Longest | Class::Linearized => {
                self.at::<_, 2, LONGEST>(share, forcing)
            }
        }
    }
}

impl RunKernel<'_> {
    /// The run by series of `LEN` coefficients, or longer ones if the
    /// truncation error is larger than `tolerance`, as a share of the
    /// velocity.
    #[inline(always)]
    fn at<G: Forcing<f64, F>, const F: usize, const LEN: usize>(
        &self,
        tolerance: f64,
        forcing: G,
    ) -> Result<Response, SceneError> {
        let Scene { block, restitution, model, overturning, .. } = *self.scene;
        let dynamics = Dynamics::new(&block, restitution, model, overturning);
        let isa = self.solver.isa;
        let mut driver =
            Driver::<_, _, F, LONGEST>::new(dynamics, forcing, isa)
                .within(tolerance);
        driver.again = self.again;
        driver = driver.for_extent(self.solver.extent);
        driver.run::<LEN>(self.scene, self.observe, |_, _| {})
    }
}
