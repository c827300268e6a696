//! What the curves of a suite come to.

use crate::ida::{Certification, IdaCurve};
use crate::statistics::{ExtendedSample, QuantileType};

/// The curves of a suite, counted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct IdaSummary {
    /// Number of curves.
    pub records: usize,
    /// Analyses made, bisection included.
    pub analyses: u64,
    /// Curves that end in an overturning.
    pub overturned_curves: usize,
    /// Median first overturning intensity PGA/(g tan alpha), infinite where
    /// half of the curves stand; none for no curve.
    pub median_overturning_im: Option<f64>,
    /// In which arithmetic the analyses were resolved.
    pub certification: Certification,
    /// Levels above a first overturning at which the block stands again,
    /// where they were sought.
    pub resurrections: usize,
    /// The curves, in order.
    pub curves: Vec<CurveSummary>,
}

/// One curve, counted.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CurveSummary {
    /// The record.
    pub record: String,
    /// Levels that were run.
    pub levels: usize,
    /// First overturning intensity PGA/(g tan alpha); none where the block
    /// stands at every level.
    pub overturning_im: Option<f64>,
}

/// Counts the curves of a suite, and takes the median of their first
/// overturning intensities, the curves that stand as infinite.
#[must_use]
pub fn summarise_ida(curves: &[IdaCurve]) -> IdaSummary {
    let mut certification = Certification::default();
    for curve in curves {
        certification.add(&curve.certification);
    }
    let one = |curve: &IdaCurve| CurveSummary {
        record: curve.record.clone(),
        levels: curve.points.len(),
        overturning_im: curve.overturning.map(|first| first.im()),
    };
    let all: Vec<CurveSummary> = curves.iter().map(one).collect();
    let ims = all.iter().map(|c| c.overturning_im.unwrap_or(f64::INFINITY));
    let ims = ExtendedSample::try_new(&ims.collect::<Vec<_>>()).ok();
    let median = |ims| QuantileType::default().of_extended(&ims, 0.5).ok();
    IdaSummary {
        records: curves.len(),
        analyses: curves.iter().map(|curve| curve.analyses).sum(),
        overturned_curves: curves
            .iter()
            .filter(|curve| curve.overturning.is_some())
            .count(),
        median_overturning_im: ims.and_then(median),
        certification,
        resurrections: curves.iter().map(IdaCurve::resurrections).sum(),
        curves: all,
    }
}
