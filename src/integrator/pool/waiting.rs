//! Lanes that wait until eight of a kind can be solved together.

use crate::integrator::pool::GROUPS;
use crate::number::lanes::WIDTH;

/// Kind of step for which a lane waits.
#[derive(Clone, Copy)]
pub(super) enum WaitKind {
    /// The longest series, clear of events.
    LongSeries,
    /// The roots of the class' own series.
    Roots,
    /// The roots of the longest series.
    LongSeriesAndRoots,
}

impl WaitKind {
    /// Number of waiting lanes that starts a batch. For rare kinds a partly
    /// filled batch is cheaper than waiting.
    pub fn worth(self) -> usize {
        match self {
            Self::LongSeries => 5,
            Self::Roots => WIDTH,
            Self::LongSeriesAndRoots => 2,
        }
    }
}

/// Lanes that wait for others of their [`WaitKind`], in the order of kinds.
pub(super) type Waiting = [LaneQueue; 3];

/// Queues the lanes that stopped, one bit each, one byte a group: hard ones
/// for the longest series, the others for roots.
#[inline(always)]
pub(super) fn park(
    waiting: &mut Waiting,
    stopped: [u8; GROUPS],
    hard: [u8; GROUPS],
) {
    const { assert!(GROUPS * WIDTH == u128::BITS as usize) };
    let mut left = u128::from_le_bytes(stopped);
    let hard = u128::from_le_bytes(hard);
    while left != 0 {
        let slot = left.trailing_zeros() as usize;
        left &= left - 1;
        // An index, not a branch, which no processor could predict.
        let kind = 1 - (hard >> slot & 1) as usize;
        waiting[kind].push(Lane::of(slot));
    }
}

/// A queue of lanes: a ring with room for all of them.
pub(super) struct LaneQueue {
    lanes: [Lane; GROUPS * WIDTH],
    first: usize,
    pub count: usize,
}

impl LaneQueue {
    pub const EMPTY: Self =
        Self { lanes: [Lane(0); GROUPS * WIDTH], first: 0, count: 0 };

    #[inline(always)]
    pub fn push(&mut self, lane: Lane) {
        self.lanes[(self.first + self.count) % (GROUPS * WIDTH)] = lane;
        self.count += 1;
    }

    /// Takes up to eight, oldest first; unused entries repeat the first.
    #[inline(always)]
    pub fn take(&mut self) -> ([Lane; WIDTH], usize) {
        let taken = self.count.min(WIDTH);
        let lanes = std::array::from_fn(|i| {
            let i = if i < taken { i } else { 0 };
            self.lanes[(self.first + i) % (GROUPS * WIDTH)]
        });
        self.first = (self.first + taken) % (GROUPS * WIDTH);
        self.count -= taken;
        (lanes, taken)
    }
}

/// A lane of a group.
#[derive(Clone, Copy, Default)]
pub(super) struct Lane(u8);

impl Lane {
    #[inline(always)]
    pub fn of(slot: usize) -> Self {
        const { assert!(GROUPS * WIDTH <= 1 << u8::BITS) };
        Self(slot as u8)
    }

    #[inline(always)]
    pub fn slot(self) -> usize {
        usize::from(self.0) % (GROUPS * WIDTH)
    }

    #[inline(always)]
    pub fn group(self) -> usize {
        self.slot() / WIDTH
    }

    #[inline(always)]
    pub fn lane(self) -> usize {
        self.slot() % WIDTH
    }
}
