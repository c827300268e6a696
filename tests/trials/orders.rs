//! What a fixed order leaves, and whether the estimate sees it.

use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, IdaCurve, IdaPoint, curves};
use rocking::integrator::Order;

/// Difference of a peak, in units of the slenderness angle, that a row
/// without a flag may not have.
const MOST: f64 = 1e-6;

/// Analyses at a fixed order, held against those at a free one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Held {
    pub analyses: usize,
    pub flagged: usize,
    /// Those with another fate, or a peak that differs by more than [`MOST`].
    pub off: usize,
    pub off_without_flag: usize,
    /// Largest difference of a peak without a flag.
    pub worst: f64,
}

impl Held {
    /// All levels of the blocks up to the first overturning of the free
    /// order, at each fixed one.
    pub fn of(
        blocks: &[Block],
        records: &[NormalisedRecord],
    ) -> Vec<(Order, Self)> {
        let eta = Restitution::constant(0.92).unwrap();
        let run = |order| {
            let of = |block: &Block| Analysis {
                order,
                ..Analysis::paper(*block, eta)
            };
            let analyses: Vec<_> = blocks.iter().map(of).collect();
            let found = curves(records, &analyses, &Batch::default());
            found.unwrap().into_iter().flatten().collect::<Vec<_>>()
        };
        let free = run(None);
        let at = |order: Order| {
            let mut held = Self::default();
            for (fixed, free) in run(Some(order)).iter().zip(&free) {
                held.take(fixed, free);
            }
            (order, held)
        };
        Order::ALL.into_iter().map(at).collect()
    }

    fn take(&mut self, fixed: &IdaCurve, free: &IdaCurve) {
        for (point, other) in fixed.points.iter().zip(&free.points) {
            let difference = difference(point, other);
            let (flagged, off) =
                (!point.resolution.resolved, !(difference <= MOST));
            self.analyses += 1;
            self.flagged += usize::from(flagged);
            self.off += usize::from(off);
            self.off_without_flag += usize::from(off && !flagged);
            if !flagged {
                self.worst = self.worst.max(difference);
            }
        }
    }
}

/// Of two peaks at one level; infinite where the fates differ.
fn difference(point: &IdaPoint, other: &IdaPoint) -> f64 {
    assert_eq!(point.im, other.im);
    match (point.edp(), other.edp()) {
        (a, b) if a == b => 0.0,
        (a, b) => (a - b).abs(),
    }
}
