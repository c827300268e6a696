//! Curves of which every fate is certified.

use rayon::prelude::*;

use crate::excitation::NormalisedRecord;
use crate::ida::climb::Climb;
use crate::ida::{Analysis, IdaCurve, IdaError};
use crate::integrator::{Certified, Engine};

/// What certification did to a curve.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Certification {
    /// Analyses whose fate double precision could not tell.
    pub needed: u64,
    /// Those of them that double precision had told wrongly.
    pub moved: u64,
    /// Those that double-double could not tell either.
    pub unresolved: u64,
}

impl Certification {
    fn add(&mut self, fate: &Certified) {
        self.needed += u64::from(fate.by == Engine::DoubleDouble);
        self.moved += u64::from(fate.moved());
        self.unresolved += u64::from(!fate.decided);
    }
}

/// [`curve`](crate::ida::curve) with every fate certified: where the margin
/// does not clear the error in double precision, the outcome is that of a run
/// in double-double (see [`certify`]), and the chain goes on from it.
///
/// # Errors
/// As [`curve`](crate::ida::curve).
pub fn certified_curve(
    record: &NormalisedRecord,
    analysis: &Analysis,
) -> Result<(IdaCurve, Certification), IdaError> {
    let mut climb = Climb::start(record, analysis)?;
    let mut count = Certification::default();
    while let Some((aim, level)) = climb.next(false)? {
        let fate = level.certify()?;
        count.add(&fate);
        climb.accept(aim, level.certified(&fate));
    }
    Ok((climb.finish(), count))
}

/// [`curves`](crate::ida::curves) with every fate certified, as
/// [`certified_curve`].
///
/// # Errors
/// As [`curves`](crate::ida::curves).
pub fn certified_curves(
    records: &[NormalisedRecord],
    analyses: &[Analysis],
    done: impl Fn() + Sync,
) -> Result<Vec<Vec<(IdaCurve, Certification)>>, IdaError> {
    // Rayon steals single chains, so that their order matters little here.
    let chains: Vec<(usize, usize)> = (0..analyses.len())
        .flat_map(|a| (0..records.len()).map(move |r| (a, r)))
        .collect();
    let flat: Vec<Result<_, IdaError>> = chains
        .par_iter()
        .with_max_len(1)
        .map(|&(a, r)| {
            let result = certified_curve(&records[r], &analyses[a]);
            done();
            result
        })
        .collect();
    let mut flat = flat.into_iter();
    (0..analyses.len())
        .map(|_| flat.by_ref().take(records.len()).collect())
        .collect()
}
