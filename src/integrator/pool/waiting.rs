//! Lanes that wait until eight of a kind can be solved together.

use crate::integrator::pool::GROUPS;
use crate::integrator::pool::group::WIDTH;

/// What lanes wait for.
#[derive(Clone, Copy)]
pub(super) enum Kind {
    /// The longest series, clear of events.
    Hard,
    /// The roots of the class' own series.
    Events,
    /// The roots of the longest series.
    Both,
}

/// Lanes that wait for others of their [`Kind`], in the order of kinds.
pub(super) struct Waiting {
    pub lines: [Line; 3],
}

impl Waiting {
    pub fn line(&mut self, kind: Kind) -> &mut Line {
        &mut self.lines[kind as usize]
    }
}

/// Lanes in a line: there is room for all of them.
pub(super) struct Line {
    lanes: [Lane; GROUPS * WIDTH],
    pub count: usize,
}

impl Line {
    pub const EMPTY: Self =
        Self { lanes: [Lane { group: 0, lane: 0 }; GROUPS * WIDTH], count: 0 };

    #[inline(always)]
    pub fn push(&mut self, lane: Lane) {
        self.lanes[self.count % (GROUPS * WIDTH)] = lane;
        self.count += 1;
    }

    /// Takes up to eight out, those that wait longest first.
    #[inline(always)]
    pub fn take(&mut self) -> ([Lane; WIDTH], usize) {
        let taken = self.count.min(WIDTH);
        let mut lanes = [Lane { group: 0, lane: 0 }; WIDTH];
        lanes[..taken].copy_from_slice(&self.lanes[..taken]);
        self.lanes.copy_within(taken..self.count, 0);
        self.count -= taken;
        (lanes, taken)
    }
}

/// A lane of a group.
#[derive(Clone, Copy)]
pub(super) struct Lane {
    pub group: usize,
    pub lane: usize,
}

impl Lane {
    pub fn slot(self) -> usize {
        self.group * WIDTH + self.lane
    }
}
