//! A run in its slot, and its steps by the scalar driver.

use crate::integrator::class::LONGEST;
use crate::integrator::driver::{Driver, Stage, Step};
use crate::integrator::forcing::RecordForcing;
use crate::number::dispatch::{Isa, Kernel};

/// Driver of a run.
pub(super) type Run<'a> = Driver<f64, RecordForcing<'a, f64>, 2, LONGEST>;

/// A run in its slot.
pub(super) struct Slot<'a, T> {
    pub task: T,
    pub driver: Run<'a>,
    pub stage: Stage<f64>,
    /// Cached result of [`exit_from`](Self::exit_from), and the peak for
    /// which it is valid.
    exit_from: usize,
    seen: f64,
}

impl<'a, T> Slot<'a, T> {
    pub fn new(task: T, driver: Run<'a>, stage: Stage<f64>) -> Self {
        Self { task, driver, stage, exit_from: usize::MAX, seen: 0.0 }
    }

    /// Brings the block to rest `after` an impact.
    pub fn rest(&mut self, after: f64) {
        if let Stage::Flying(step) = &self.stage {
            self.stage = self.driver.rest(step.place, step.motion.w, after);
        }
    }

    /// First piece from which the rest of the record cannot raise the peak of
    /// a block at rest.
    #[inline(always)]
    pub fn exit_from(&mut self) -> u64 {
        let peak = self.driver.record.peak;
        if self.seen < peak {
            self.seen = peak;
            self.driver.see_peak();
            self.exit_from = self.driver.first_exit(self.exit_from);
        }
        self.exit_from as u64
    }

    /// Makes a step by the scalar driver, by a series of `LEN` coefficients.
    pub fn advance<const LEN: usize>(&mut self, step: Step<f64>, isa: Isa) {
        let alone = Alone::<LEN> { driver: &mut self.driver, step };
        self.stage = isa.run(alone);
    }
}

/// A step by the scalar driver.
struct Alone<'r, 'a, const LEN: usize> {
    driver: &'r mut Run<'a>,
    step: Step<f64>,
}

impl<const LEN: usize> Kernel for Alone<'_, '_, LEN> {
    type Output = Stage<f64>;

    #[inline(always)]
    fn run(self) -> Stage<f64> {
        self.driver.proceed::<LEN>(self.step)
    }
}
