//! Demands on stripes of equal intensity.

use crate::analyses::StripeDemands;
use crate::facts::Facts;
use rocking_common::paper::{REFERENCE, SLENDERNESSES_RAD, STRIPES, position};

impl StripeDemands {
    /// Level of each stripe, with the demands by record on two blocks: the block
    /// of a slenderness (adjusted to each record if `None`), and the reference.
    pub(crate) fn compared(
        &self,
        frequency: usize,
        slenderness: Option<usize>,
    ) -> impl Iterator<Item = (f64, &[f64], &[f64])> {
        let reference = &self.demands[position(frequency, REFERENCE)];
        let own = match slenderness {
            Some(s) => &self.demands[position(frequency, s)],
            None => &self.adjusted[frequency],
        };
        let both = own.iter().zip(reference);
        STRIPES.into_iter().zip(both).map(|(im, (a, b))| (im, &a[..], &b[..]))
    }
}

/// The slenderness at which an unscaled record has the intensity
/// PGA/(g tan alpha) = `im`.
pub(crate) fn adjusted_slenderness(record: &Facts, im: f64) -> f64 {
    libm::atan(record.pga_g / im)
}

/// Whether the adjusted slenderness is at most the paper's largest.
pub(crate) fn is_within(record: &Facts, im: f64) -> bool {
    let steepest = libm::tan(SLENDERNESSES_RAD[SLENDERNESSES_RAD.len() - 1]);
    record.pga_g <= im * steepest
}
