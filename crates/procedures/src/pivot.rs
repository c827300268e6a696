//! Friction and normal force that the motions of a suite need at the pivot.

use rayon::prelude::*;

use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, IdaCurve, IdaError, forces_at};
use rocking::integrator::Forces;

/// Friction and normal force that the analyses of a suite need at the pivot.
///
/// The model does not slide. Its results are not valid if many analyses need
/// more friction than the ground gives.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct PivotForces {
    /// Number of analyses.
    pub analyses: usize,
    /// The share that needs more than each coefficient of friction, in the
    /// order of the coefficients.
    pub needs: Vec<FrictionNeed>,
    /// Largest |H|/N of all analyses; infinite if N is not positive.
    pub largest_friction: f64,
    /// Least N/(m g) of all analyses.
    pub least_normal_over_weight: f64,
    /// The forces of each analysis of each curve: of `points`, in order.
    #[serde(skip)]
    pub curves: Vec<Vec<Forces>>,
}

/// How many analyses need more friction than there is.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct FrictionNeed {
    /// Coefficient of friction.
    pub friction: f64,
    /// Analyses that need more.
    pub need_more: usize,
    /// Their share of all analyses, in [0, 1].
    pub share: f64,
}

/// Finds the forces at the pivot of every analysis of `records` at the
/// intensities `ims` of each ([`IdaCurve::ims`]), and the share of the
/// analyses that need more friction |H|/N than each coefficient in
/// `friction`.
///
/// Each analysis is run once more, whole, on the threads of the caller's
/// pool.
///
/// ```
/// use rocking::{Block, Restitution};
/// use rocking::excitation::NormalisedRecord;
/// use rocking::ida::{Analysis, Batch, Grid, curves};
/// use rocking_procedures::pivot_forces;
/// use rocking::accelerogram::Accelerogram;
/// let rise = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
/// let record = Accelerogram::try_new("lobe", 0.01, rise.collect())?;
/// let records = [NormalisedRecord::new(&record)];
/// let block = Block::try_new(0.1, 3.0)?;
/// let analysis = Analysis {
///     grid: Grid::Im { step: 0.5 },
///     ..Analysis::paper(block, Restitution::constant(0.92)?)
/// };
/// let found = curves(&records, &[analysis], &Batch::default())?;
/// // Uplift needs the friction tan(alpha) at least.
/// let enough = [0.9 * libm::tan(0.1), 1.0];
/// let ims = [found[0][0].ims()];
/// let pivot = pivot_forces(&records, &ims, &analysis, &enough)?;
/// assert_eq!(pivot.needs[0].share, 1.0);
/// assert_eq!(pivot.needs[1].need_more, 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`IdaError::NotPositive`] for a coefficient that is not positive,
/// [`IdaError::Unmatched`] for levels of more or fewer records; as
/// [`forces_at`].
pub fn pivot_forces(
    records: &[NormalisedRecord],
    ims: &[Vec<f64>],
    analysis: &Analysis,
    friction: &[f64],
) -> Result<PivotForces, IdaError> {
    if let Some(&found) = friction.iter().find(|mu| !(**mu > 0.0)) {
        let what = "coefficient of friction";
        return Err(IdaError::NotPositive { what, found });
    }
    if records.len() != ims.len() {
        let (records, levels) = (records.len(), ims.len());
        return Err(IdaError::Unmatched { records, levels });
    }
    let pairs: Vec<_> = records.iter().zip(ims).collect();
    let of = |(record, ims): &(&NormalisedRecord, &Vec<f64>)| {
        ims.iter().map(|im| forces_at(record, analysis, *im)).collect()
    };
    let curves: Vec<Vec<Forces>> =
        pairs.par_iter().panic_fuse().map(of).collect::<Result<_, _>>()?;
    let need = |&friction| FrictionNeed { friction, need_more: 0, share: 0.0 };
    let mut found = PivotForces {
        analyses: 0,
        needs: friction.iter().map(need).collect(),
        largest_friction: 0.0,
        least_normal_over_weight: 1.0,
        curves: Vec::new(),
    };
    found.count(curves);
    Ok(found)
}

impl PivotForces {
    /// Counts more curves under the same analysis and coefficients, as if
    /// all had been counted together.
    pub fn add(&mut self, more: Self) {
        self.count(more.curves);
    }

    fn count(&mut self, curves: Vec<Vec<Forces>>) {
        for f in curves.iter().flatten() {
            self.analyses += 1;
            for need in &mut self.needs {
                need.need_more += usize::from(!(f.friction <= need.friction));
            }
            self.largest_friction = self.largest_friction.max(f.friction);
            self.least_normal_over_weight =
                self.least_normal_over_weight.min(f.least_normal_over_weight);
        }
        for need in &mut self.needs {
            need.share = need.need_more as f64 / self.analyses as f64;
        }
        self.curves.extend(curves);
    }
}

/// Number of levels of a curve at which friction is sought.
const LEVELS: usize = 4;

/// The largest friction |H|/N that a record needs at the levels of its curve
/// below the intensity `below_im`: at the strongest one, and at three more,
/// evenly below it. Infinite if N is not positive.
///
/// # Errors
/// As [`forces_at`].
pub(super) fn largest_friction(
    record: &NormalisedRecord,
    curve: &IdaCurve,
    analysis: &Analysis,
    below_im: f64,
) -> Result<f64, IdaError> {
    let levels = curve.points.iter().rev().map(|point| point.im);
    let levels: Vec<f64> = levels.filter(|im| *im < below_im).collect();
    let step = levels.len().div_ceil(LEVELS).max(1);
    let each = levels.into_iter().step_by(step);
    each.map(|im| Ok(forces_at(record, analysis, im)?.friction))
        .try_fold(0.0, |most: f64, found: Result<f64, IdaError>| {
            Ok(most.max(found?))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking::block::{Block, Restitution};

    #[test]
    fn a_coefficient_that_is_no_positive_number_is_refused() {
        let block = Block::try_new(0.1, 3.0).unwrap();
        let analysis =
            Analysis::paper(block, Restitution::constant(0.92).unwrap());
        for friction in [0.0, -0.3, f64::NAN] {
            let found = pivot_forces(&[], &[], &analysis, &[0.3, friction]);
            let error = found.unwrap_err().to_string();
            assert!(error.contains("coefficient of friction"), "{error}");
        }
    }

    #[test]
    fn levels_of_other_records_are_refused() {
        let block = Block::try_new(0.1, 3.0).unwrap();
        let analysis =
            Analysis::paper(block, Restitution::constant(0.92).unwrap());
        let found = pivot_forces(&[], &[vec![1.0]], &analysis, &[0.3]);
        let expected = IdaError::Unmatched { records: 0, levels: 1 };
        assert_eq!(found.unwrap_err(), expected);
    }
}
