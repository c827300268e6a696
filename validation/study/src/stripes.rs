//! Demands on stripes of equal intensity, and their pairs.

use rocking_statistics::paired::Pairs;

use crate::analyses::{Facts, StripeDemands, SuiteResults};
use rocking_common::paper::{
    Arm, REFERENCE, SLENDERNESSES_RAD, STRIPES, position,
};

/// Demands on the stripes of an arm.
pub(crate) fn of_arm(
    suite: &SuiteResults,
    arm: Arm,
) -> Option<&StripeDemands> {
    suite.stripes.iter().find(|s| s.arm == arm)
}

/// Pairs on each stripe: a slenderness over the reference, or (none) the
/// adjusted one over scaled records.
pub(crate) fn pairs(
    stripes: &StripeDemands,
    frequency: usize,
    slenderness: Option<usize>,
) -> anyhow::Result<Vec<(f64, Pairs)>> {
    let reference = &stripes.demands[position(frequency, REFERENCE)];
    let compared = match slenderness {
        Some(s) => &stripes.demands[position(frequency, s)],
        None => &stripes.adjusted[frequency],
    };
    STRIPES
        .iter()
        .zip(compared.iter().zip(reference))
        .map(|(im, (a, b))| Ok((*im, Pairs::try_new(a, b)?)))
        .collect()
}

/// The slenderness on which a record as it is has an intensity PGA/(g tan
/// alpha).
pub(crate) fn adjusted_slenderness(record: &Facts, im: f64) -> f64 {
    libm::atan(record.pga_g / im)
}

/// Ratios of Figure 9 on a stripe, apart by the adjusted slenderness: up to
/// the paper's largest, and above.
pub(crate) struct Split {
    /// Level of the stripe.
    pub im: f64,
    /// Ratios of the records whose adjusted slenderness is at most 0.25.
    pub within: Vec<f64>,
    /// Ratios of the others.
    pub above: Vec<f64>,
}

/// Ratios of Figure 9 by frequency parameter, apart by slenderness.
pub(crate) fn adjusted_split(
    suite: &SuiteResults,
    stripes: &StripeDemands,
    frequency: usize,
) -> anyhow::Result<Vec<Split>> {
    let steepest = libm::tan(SLENDERNESSES_RAD[SLENDERNESSES_RAD.len() - 1]);
    let reference = &stripes.demands[position(frequency, REFERENCE)];
    STRIPES
        .iter()
        .zip(stripes.adjusted[frequency].iter().zip(reference))
        .map(|(im, (adjusted, scaled))| {
            let ratios = |wanted: bool| {
                let (mut a, mut b) = (Vec::new(), Vec::new());
                for ((x, y), record) in
                    adjusted.iter().zip(scaled).zip(&suite.records)
                {
                    if (record.pga_g <= im * steepest) == wanted {
                        a.push(*x);
                        b.push(*y);
                    }
                }
                anyhow::Ok(Pairs::try_new(&a, &b)?.ratios)
            };
            Ok(Split { im: *im, within: ratios(true)?, above: ratios(false)? })
        })
        .collect()
}
