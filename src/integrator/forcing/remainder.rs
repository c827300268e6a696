//! What is left of a record, in units of 1/p.

use crate::excitation::{RUN, RecordIndex, Remaining, Window};
use crate::number::Real;

/// What is left of a record from each of its pieces on.
#[derive(Clone, Copy)]
pub(crate) struct Remainder<'a, N> {
    index: &'a RecordIndex,
    /// Length of a piece.
    length: N,
    /// Units of velocity and of places.
    speed: N,
    way: N,
}

impl<'a, N: Real> Remainder<'a, N> {
    /// Of a record with pieces of `length`, scaled by a factor.
    #[inline(always)]
    pub fn new(index: &'a RecordIndex, length: N, factor: N) -> Self {
        let speed = factor.abs() * length;
        Self { index, length, speed, way: speed * length }
    }

    /// What is left from a piece on.
    #[inline(always)]
    pub fn left(&self, piece: usize) -> Remaining<N> {
        let Remaining { speed, travel } = self.index.left(piece);
        Remaining {
            speed: N::from_f64(speed) * self.speed,
            travel: N::from_f64(travel) * self.way,
        }
    }

    /// Shortest tabulated window at least `time` (in 1/p) long.
    #[inline(always)]
    pub fn window(&self, time: N) -> Option<Window> {
        RecordIndex::window((time / self.length).to_f64())
    }

    /// How far apart the ground's places within a window are at most, from a
    /// piece on.
    #[inline(always)]
    pub fn sway(&self, piece: usize, window: Window) -> N {
        N::from_f64(self.index.sway(piece, window)) * self.way
    }

    /// First piece of the first run from which on something holds, for what
    /// holds from the end on, and if from one run on, then from later ones;
    /// looked for about the piece `guess`.
    #[inline(always)]
    pub fn first(&self, guess: usize, holds: impl Fn(usize) -> bool) -> usize {
        let end = self.index.runs();
        let holds = |run| run == end || holds(RUN * run);
        // It holds from `high` on, and not from the run before `low` on.
        let guess = (guess / RUN).min(end);
        let (mut low, mut high) = (0, end);
        let mut stride = 1;
        if holds(guess) {
            high = guess;
            while high > 0 {
                let run = high.saturating_sub(stride);
                if !holds(run) {
                    low = run + 1;
                    break;
                }
                high = run;
                stride *= 2;
            }
        } else {
            low = guess + 1;
            while low < end {
                let run = (low + stride - 1).min(end);
                if holds(run) {
                    high = run;
                    break;
                }
                low = run + 1;
                stride *= 2;
            }
        }
        while low < high {
            let middle = low.midpoint(high);
            if holds(middle) {
                high = middle;
            } else {
                low = middle + 1;
            }
        }
        RUN * high
    }
}
