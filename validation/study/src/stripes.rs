//! Demands on stripes of equal intensity, and their pairs.

use rocking_statistics::paired::Pairs;

use crate::analyses::{StripeDemands, SuiteResults};
use crate::facts::Facts;
use rocking_common::paper::{REFERENCE, SLENDERNESSES_RAD, STRIPES, position};

impl StripeDemands {
    /// Level of each stripe, with the demands by record on two blocks: one of
    /// a slenderness, or (none) of the adjusted slendernesses, and the
    /// reference.
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

    /// Pairs on each stripe of two such blocks.
    pub(crate) fn pairs(
        &self,
        frequency: usize,
        slenderness: Option<usize>,
    ) -> anyhow::Result<Vec<(f64, Pairs)>> {
        self.compared(frequency, slenderness)
            .map(|(im, a, b)| Ok((im, Pairs::try_new(a, b)?)))
            .collect()
    }
}

/// The slenderness on which a record as it is has an intensity PGA/(g tan
/// alpha).
pub(crate) fn adjusted_slenderness(record: &Facts, im: f64) -> f64 {
    libm::atan(record.pga_g / im)
}

/// Whether that slenderness is at most the paper's largest.
pub(crate) fn is_within(record: &Facts, im: f64) -> bool {
    let steepest = libm::tan(SLENDERNESSES_RAD[SLENDERNESSES_RAD.len() - 1]);
    record.pga_g <= im * steepest
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

/// Ratios of Figure 9 of a frequency parameter, apart by slenderness.
pub(crate) fn adjusted_split(
    suite: &SuiteResults,
    stripes: &StripeDemands,
    frequency: usize,
) -> anyhow::Result<Vec<Split>> {
    stripes
        .compared(frequency, None)
        .map(|(im, adjusted, scaled)| {
            let ratios = |wanted: bool| {
                let both = adjusted.iter().zip(scaled).zip(&suite.records);
                let own = both.filter(|(_, r)| is_within(r, im) == wanted);
                let (a, b): (Vec<f64>, Vec<f64>) =
                    own.map(|((a, b), _)| (*a, *b)).unzip();
                anyhow::Ok(Pairs::try_new(&a, &b)?.ratios)
            };
            Ok(Split { im, within: ratios(true)?, above: ratios(false)? })
        })
        .collect()
}
