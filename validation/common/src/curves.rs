//! Execution of many curves: in lanes at an instruction-set level, or one
//! analysis at a time. The bits of the results are equal.

use rayon::prelude::*;
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, IdaCurve, IdaError, curve, curves};
use rocking::number::dispatch::Isa;

/// Execution of curves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Execution {
    /// Chains in lanes, by instructions of this level.
    Lanes(Isa),
    /// One analysis at a time.
    OneByOne,
}

impl Default for Execution {
    fn default() -> Self {
        Self::Lanes(Isa::best())
    }
}

impl Execution {
    /// The curves of every record under every analysis, equal to those of
    /// [`rocking::ida::curves`]. `done` is called after each curve.
    ///
    /// # Errors
    /// As [`rocking::ida::curves`].
    pub fn curves(
        self,
        records: &[NormalisedRecord],
        analyses: &[Analysis],
        done: &(dyn Fn() + Sync),
    ) -> Result<Vec<Vec<IdaCurve>>, IdaError> {
        if let Self::Lanes(isa) = self {
            let batch = Batch { isa, progress: done };
            return curves(records, analyses, &batch);
        }
        let one_by_one = |analysis| {
            let records = records.par_iter().with_max_len(1);
            let curves = records.map(|record| curve(record, analysis));
            curves.inspect(|_| done()).collect()
        };
        analyses.iter().map(one_by_one).collect()
    }
}
