//! Bounds on the rest of a record, in units of 1/p.

use crate::excitation::{RUN, RecordIndex, Remaining, Window};
use crate::number::Real;

/// Bounds on the rest of a record from each of its pieces on.
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
    /// Bounds for a record with pieces of `length`, scaled by a factor.
    #[inline(always)]
    pub fn new(index: &'a RecordIndex, length: N, factor: N) -> Self {
        let speed = factor.abs() * length;
        Self { index, length, speed, way: speed * length }
    }

    /// Bounds on the motion of the ground from a piece on.
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

    /// Largest range of ground displacement in a window from a piece on.
    #[inline(always)]
    pub fn sway(&self, piece: usize, window: Window) -> N {
        N::from_f64(self.index.sway(piece, window)) * self.way
    }

    /// First piece of the first run from which on a condition holds. The
    /// search starts at the piece `guess`. The condition must hold at the end,
    /// and from every run after one from which it holds.
    #[inline(always)]
    pub fn first(&self, guess: usize, holds: impl Fn(usize) -> bool) -> usize {
        let end = self.index.runs();
        let holds = |run| run == end || holds(RUN * run);
        let guess = (guess / RUN).min(end);
        // From the guess on, by growing strides, to the other answer.
        let down = holds(guess);
        let (mut edge, mut stride) = (guess, 1);
        let other = loop {
            let run = match down {
                true => edge.saturating_sub(stride),
                false => (edge + stride).min(end),
            };
            if run == edge {
                return 0;
            }
            if holds(run) != down {
                break run;
            }
            edge = run;
            stride *= 2;
        };
        // It holds from `high` on, and not from the run before `low` on.
        let (mut low, mut high) =
            if down { (other + 1, edge) } else { (edge + 1, other) };
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
