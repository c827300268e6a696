//! Outcome and peak of many analyses under records at once.
//!
//! Slots hold runs, eight to a group. Whole samples in free flight are
//! stepped in all lanes of a group together. A lane that may meet an event
//! within the sample waits until eight lanes wait for the same kind of step;
//! their steps are then solved together. Rare steps are left to the scalar
//! driver. Both ways have the same operations in the same order, and so the
//! same bits.
//!
//! # Proof P7
//!
//! Lanes repeat the driver operation by operation. `chatter` repeats
//! `accumulation` and `prove`; `roots` repeats `surely_positive`,
//! `ends_below` and `refine`; `batch` repeats `attempt`,
//! `first_event`, `turning_points`, `screen_turning` and `impact`. A change of
//! one side is a change of both; otherwise the golden hash of
//! `tests/reproducibility.rs` fails.

pub(crate) mod bare;
mod batch;
mod chatter;
mod group;
mod roots;
mod slot;
mod waiting;

use crate::excitation::Excitation;
use crate::integrator::class::{Class, LONGEST};
use crate::integrator::driver::{Driver, Flight, Stage};
use crate::integrator::dynamics::{Dynamics, Model};
use crate::integrator::forcing::{Moment, RecordForcing, steps_of};
use crate::integrator::{Extent, Observe, Order, Response, Scene, WorkLimit};
use crate::number::dispatch::{Isa, WithSimd};
use crate::number::lanes::{Simd, WIDTH};
use crate::stop;
use batch::{BatchSolution, LaneBatch};
use group::LaneGroup;
use slot::Slot;
use waiting::{Lane, LaneQueue, WaitKind, Waiting, park};

/// All lanes.
type Groups<'a> = [LaneGroup<'a>; GROUPS];

/// Groups of lanes: enough that a lane seldom waits for others, few enough
/// that all stay in the nearest cache.
const GROUPS: usize = 16;

/// Rotation to which the short sine and cosine are used.
const SMALL: f64 = 0.785;

/// Safety factor of the screens of the lanes: a step that they pass is also
/// passed by the scalar screens or the scalar root finder.
const SAFETY: f64 = 1.001;

/// Source of analyses and receiver of their responses.
pub(crate) trait SceneSource<'a> {
    /// Identifies an analysis.
    type Task;

    /// The next analysis; `None` if there is none now.
    fn take(&mut self) -> Option<(Self::Task, Scene<'a>, Extent, WorkLimit)>;

    /// Takes the response of an analysis; `None` if its work passed its limit.
    fn settle(&mut self, task: Self::Task, response: Option<&Response>);
}

/// The class of scenes in a pool at steps of `length` (in 1/p), at a fixed
/// order if one is given; `None` if a sample takes more than one step.
pub(crate) fn class_of(
    model: Model,
    length: f64,
    order: Option<Order>,
) -> Option<Class> {
    (steps_of(length) == 1).then(|| Class::of(model, length, order))
}

/// Counters of the lane engine. A screen that is too cautious only costs
/// time; these counters show it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Tally {
    /// Steps of all groups together.
    pub sweeps: u64,
    /// Batches solved of each [`WaitKind`].
    pub batches: [u64; 3],
    /// Lanes solved in them, those passed on to longer series, and those
    /// left to the scalar driver.
    pub solved: u64,
    pub passed: u64,
    pub left: u64,
}

/// Makes the analyses of one class until the source has none left. Needs a
/// [wide](Isa::is_wide) level.
pub(crate) fn run<'a>(
    class: Class,
    isa: Isa,
    source: &mut impl SceneSource<'a>,
) -> Tally {
    match class {
        Class::Eight => go::<_, 9, LONGEST>(class, isa, source),
        Class::Nine => go::<_, 10, LONGEST>(class, isa, source),
        Class::Ten => go::<_, 11, LONGEST>(class, isa, source),
        Class::Longest | Class::Linearized => {
            go::<_, LONGEST, LONGEST>(class, isa, source)
        }
        Class::Fixed(Order::Four) => go::<_, 5, 5>(class, isa, source),
        Class::Fixed(Order::Six) => go::<_, 7, 7>(class, isa, source),
        Class::Fixed(Order::Eight) => go::<_, 9, 9>(class, isa, source),
        Class::Fixed(Order::Ten) => go::<_, 11, 11>(class, isa, source),
    }
}

fn go<'a, S: SceneSource<'a>, const LEN: usize, const HARD: usize>(
    class: Class,
    isa: Isa,
    source: &mut S,
) -> Tally {
    let slots = (0..GROUPS * WIDTH).map(|_| None).collect();
    let tally = Tally::default();
    Pool::<S, LEN, HARD> { class, isa, source, slots, busy: 0, tally }.run()
}

/// Runs in their slots, by series of `LEN` coefficients, and of `HARD` if the
/// truncation error of those is too large.
struct Pool<'s, 'a, S: SceneSource<'a>, const LEN: usize, const HARD: usize> {
    class: Class,
    isa: Isa,
    source: &'s mut S,
    slots: Vec<Option<Slot<'a, S::Task>>>,
    /// Slots in use.
    busy: usize,
    tally: Tally,
}

impl<'a, S: SceneSource<'a>, const LEN: usize, const HARD: usize>
    Pool<'_, 'a, S, LEN, HARD>
{
    fn run(mut self) -> Tally {
        let (model, isa) = (self.class.model(), self.isa);
        let mut groups = Groups::default();
        let mut waiting = [LaneQueue::EMPTY; 3];
        let mut batch = LaneBatch::default();
        let mut solved = BatchSolution::default();
        // A response may give the source something to do.
        let mut fresh = true;
        loop {
            stop::point();
            if fresh {
                fresh = self.fill(&mut groups);
            }
            if self.busy == 0 {
                return self.tally;
            }
            let sweep = Sweep::<LEN, HARD> {
                model,
                groups: &mut groups,
                waiting: &mut waiting,
            };
            let Some(moved) = isa.run_wide(sweep) else { return self.tally };
            self.tally.sweeps += 1;
            // Few runs do not wait for many of a kind.
            let most = if moved { (self.busy / 4).max(1) } else { 1 };
            for kind in [
                WaitKind::LongSeries,
                WaitKind::Roots,
                WaitKind::LongSeriesAndRoots,
            ] {
                let enough = kind.worth().min(most);
                while waiting[kind as usize].count >= enough {
                    let line = &mut waiting[kind as usize];
                    batch.gather(line, &mut groups, &mut self.slots);
                    isa.run_wide(Solve::<LEN, HARD> {
                        model,
                        kind,
                        tolerance: self.class.tolerance(),
                        batch: &batch,
                        solved: &mut solved,
                    });
                    self.tally.batches[kind as usize] += 1;
                    fresh |= self.scatter(&mut groups, &mut waiting, &solved);
                }
            }
        }
    }

    /// Starts runs in empty slots; true if a run was settled.
    fn fill(&mut self, groups: &mut Groups<'a>) -> bool {
        let mut settled = false;
        for slot in 0..self.slots.len() {
            if self.slots[slot].is_some() {
                continue;
            }
            self.slots[slot] = self.begin();
            if self.slots[slot].is_none() {
                break;
            }
            self.busy += 1;
            settled |= self.proceed(Lane::of(slot), groups);
        }
        settled
    }

    /// A run at its first step.
    fn begin(&mut self) -> Option<Slot<'a, S::Task>> {
        let (task, scene, extent, work_limit) = self.source.take()?;
        let Excitation::Record(record) = scene.excitation else { return None };
        let index = record.index()?;
        let Scene { block, restitution, model, overturning, .. } = scene;
        let dynamics = Dynamics::new(&block, restitution, model, overturning);
        let forcing =
            RecordForcing::new(record, index, block.frequency_rad_s());
        let mut driver = Driver::new(dynamics, forcing, self.isa)
            .for_extent(extent)
            .within(self.class.tolerance());
        let observe = Observe { work_limit, ..Observe::default() };
        let stage = driver.begin(&scene, &observe);
        Some(Slot::new(task, driver, stage))
    }

    /// Continues by the scalar driver until the run in a slot is in free
    /// flight or no run is left for the slot; true if a run was settled.
    fn proceed(&mut self, lane: Lane, groups: &mut Groups<'a>) -> bool {
        let mut settled = false;
        let k = lane.slot();
        while let Some(slot) = &mut self.slots[k] {
            let refused = slot.driver.refusal(&slot.stage).is_some();
            match slot.stage {
                Stage::Flying(_) if refused => {
                    settled = true;
                    self.settle(k, None);
                }
                Stage::Flying(step)
                    if !step.at_threshold
                        && step.place.offset < slot.driver.forcing.step() =>
                {
                    groups[lane.group()].load(lane.lane(), slot);
                    break;
                }
                Stage::Flying(step) => slot.advance::<LEN>(step, self.isa),
                Stage::Landed(ref flight) => {
                    let response = slot.driver.within_limit(flight).ok();
                    settled = true;
                    self.settle(k, response.as_ref());
                }
            }
        }
        settled
    }

    /// Hands the response of the run in a slot to the source and starts
    /// another run there.
    fn settle(&mut self, k: usize, response: Option<&Response>) {
        if let Some(slot) = self.slots[k].take() {
            self.source.settle(slot.task, response);
        }
        self.slots[k] = self.begin();
        if self.slots[k].is_none() {
            self.busy -= 1;
        }
    }

    /// Returns the lanes of a batch to their groups; true if a run was
    /// settled.
    #[inline(always)]
    fn scatter(
        &mut self,
        groups: &mut Groups<'a>,
        waiting: &mut Waiting,
        solved: &BatchSolution,
    ) -> bool {
        let mut settled = false;
        for i in 0..solved.count {
            let (id, bit) = (solved.lanes[i], 1 << i);
            let (group, lane) = (&mut groups[id.group()], id.lane());
            if solved.left & bit != 0 {
                self.tally.left += 1;
                let Some(slot) = &mut self.slots[id.slot()] else { continue };
                group.release(lane, slot);
                if let Stage::Flying(step) = slot.stage {
                    slot.advance::<LEN>(step, self.isa);
                }
                settled |= self.proceed(id, groups);
                continue;
            }
            if solved.hard & bit != 0 {
                self.tally.passed += 1;
                waiting[WaitKind::LongSeriesAndRoots as usize].push(id);
                continue;
            }
            self.tally.solved += 1;
            if solved.turned & bit != 0 {
                let Some(slot) = &mut self.slots[id.slot()] else { continue };
                let place = Moment {
                    piece: group.next[lane] as usize - 1,
                    offset: group.motion.offset[lane],
                };
                let (u, tau) = (solved.top[i], solved.turn[i]);
                group.hand_screen(lane, slot);
                slot.driver.raise_peak(u, place, tau);
                group.fixed.peak[lane] = slot.driver.record.peak;
                group.exit_from[lane] = slot.driver.exit_from as u64;
            }
            group.motion.copy(lane, &solved.motion, i);
            group.extra[lane] += u64::from(solved.again >> i & 1);
            if solved.impact & bit != 0 {
                group.extra[lane] += 1;
                group.impacts[lane] += 1;
                let endless = group.impacts[lane] > group.most[lane];
                if (solved.rested | solved.settled) & bit != 0 || endless {
                    let Some(slot) = &mut self.slots[id.slot()] else {
                        continue;
                    };
                    group.release(lane, slot);
                    if solved.settled & bit != 0 {
                        slot.stage = Stage::Landed(Flight::Settled);
                    } else if solved.rested & bit != 0 {
                        slot.rest(solved.rest[i]);
                    }
                    settled |= self.proceed(id, groups);
                    continue;
                }
                group.turned ^= 1 << lane;
            } else {
                group.next[lane] += 1;
            }
            group.active |= 1 << lane;
        }
        settled
    }
}

/// One step of the groups in which a lane flies; true if there is one.
struct Sweep<'g, 'a, const LEN: usize, const HARD: usize> {
    model: Model,
    groups: &'g mut [LaneGroup<'a>],
    waiting: &'g mut Waiting,
}

impl<const LEN: usize, const HARD: usize> WithSimd
    for Sweep<'_, '_, LEN, HARD>
{
    type Output = bool;

    #[inline(always)]
    fn run<V: Simd>(self) -> bool {
        // The model is a constant here, so the loop does not test it.
        match self.model {
            Model::Linearized if LEN == LONGEST => {
                self.step::<V>(Model::Linearized)
            }
            _ => self.step::<V>(Model::Nonlinear),
        }
    }
}

impl<const LEN: usize, const HARD: usize> Sweep<'_, '_, LEN, HARD> {
    #[inline(always)]
    fn step<V: Simd>(self, model: Model) -> bool {
        let mut moved = false;
        let (mut stopped, mut hard) = ([0; GROUPS], [0; GROUPS]);
        for (k, group) in self.groups.iter_mut().enumerate() {
            if group.active != 0 {
                moved = true;
                (stopped[k], hard[k]) = group.step::<V, LEN, HARD>(model);
            }
        }
        // All groups together: one unpredictable branch.
        park(self.waiting, stopped, hard);
        moved
    }
}

/// The steps of a batch, and the rough certificates after its impacts.
struct Solve<'b, const LEN: usize, const HARD: usize> {
    model: Model,
    kind: WaitKind,
    tolerance: f64,
    batch: &'b LaneBatch,
    solved: &'b mut BatchSolution,
}

impl<const LEN: usize, const HARD: usize> WithSimd for Solve<'_, LEN, HARD> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd>(self) {
        let Self { kind, tolerance, batch, solved, .. } = self;
        // Shorter series are only for Eq. 1.
        let model = if LEN == LONGEST { self.model } else { Model::Nonlinear };
        match kind {
            WaitKind::LongSeries => {
                batch.solve::<V, LEN, HARD, HARD, true>(
                    model, tolerance, solved,
                );
            }
            WaitKind::LongSeriesAndRoots if HARD > LEN => {
                batch.solve::<V, LEN, HARD, HARD, false>(
                    model, tolerance, solved,
                );
            }
            // No lane waits for both if there is no longer series.
            WaitKind::Roots | WaitKind::LongSeriesAndRoots => {
                batch.solve::<V, LEN, HARD, LEN, false>(
                    model, tolerance, solved,
                );
            }
        }
        if solved.impact != 0 {
            batch.land::<V>(model, solved);
        }
    }
}
