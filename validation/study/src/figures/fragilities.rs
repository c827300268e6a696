//! Figures 15 to 18: fitted and transformed fragilities.

mod thresholds;

pub(super) use thresholds::thresholds;

use rocking::fragility::transform;
use rocking::statistics::lognormal::{FitMethod, fit};
use rocking::statistics::{ExtendedSample, Lognormal, QuantileType};

use super::{Figure, Results, name};
use crate::StudyError;
use crate::distributions::BlockSamples;
use rocking_common::paper::{Arm, Intensity, demand_index};
use rocking_draw::figures::{
    ByConstant, ByConstantPanel, ConstantCurve, Heading,
};

/// Demand thresholds of Figures 15 to 17.
pub(crate) const THRESHOLDS: [f64; 3] = [0.15, 0.35, 1.0];

/// Constants of Eq. 7 in Figure 18.
pub(crate) const CONSTANTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// The block of Figures 15 to 18: p = 3, alpha = 0.20.
pub(crate) const BLOCK: (usize, usize) = (1, 3);

/// The lognormals that the paper compares, of one sample and shift.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Fits {
    /// Fitted to the sample as it is, by maximum likelihood.
    pub usfl: Option<Lognormal>,
    /// Fitted to the shifted sample, by maximum likelihood.
    pub ssfl: Option<Lognormal>,
    /// Fitted to the trimmed sample, by moments.
    pub trimmed: Option<Lognormal>,
}

impl Fits {
    pub(crate) fn new(sample: &ExtendedSample, shift: f64) -> Self {
        let by = |shift, method| {
            fit(sample, shift, method).ok().map(|f| f.distribution)
        };
        let trim = FitMethod::Trimmed(QuantileType::default());
        Self {
            usfl: by(0.0, FitMethod::MaximumLikelihood),
            ssfl: by(shift, FitMethod::MaximumLikelihood),
            trimmed: by(0.0, trim),
        }
    }
}

/// Eqs. 5 and 7 applied to a fit; none where they are not defined.
pub(crate) fn usfl7(
    usfl: Option<Lognormal>,
    shift: f64,
    c: f64,
) -> Option<Lognormal> {
    transform(&usfl?, shift, c).ok()
}

/// Largest distance of a fitted fragility to the empirical one; NaN where
/// there is no fit.
pub(crate) fn distance(
    fitted: Option<Lognormal>,
    sample: &ExtendedSample,
) -> f64 {
    fitted.map_or(f64::NAN, |f| f.kolmogorov_distance(sample))
}

fn sample_at(
    block: &BlockSamples,
    edp: f64,
) -> Result<ExtendedSample, StudyError> {
    Ok(ExtendedSample::try_new(&block.samples[demand_index(edp)])?)
}

/// Figure 18: demand 0.15, PGA.
pub(super) fn constants(
    results: &Results,
    arm: Arm,
) -> Result<Figure, StudyError> {
    let edp = THRESHOLDS[0];
    let block =
        results.ordinary_block(arm, Intensity::Pga, BLOCK.0, BLOCK.1)?;
    let sample = sample_at(block, edp)?;
    let fits = Fits::new(&sample, block.shift);
    let mut words = Vec::new();
    let mut panels = Vec::new();
    for (title, usfl) in [("untrimmed", fits.usfl), ("trimmed", fits.trimmed)]
    {
        let mut distances = Vec::new();
        let curves = CONSTANTS
            .iter()
            .map(|c| {
                let fitted = usfl7(usfl, block.shift, *c);
                distances.push(fitted.map_or_else(
                    || "undefined".into(),
                    |f| format!("{:.3}", f.kolmogorov_distance(&sample)),
                ));
                ConstantCurve { c: *c, curve: fitted }
            })
            .collect();
        words.push(format!("{title} {}", distances.join(", ")));
        panels.push(ByConstantPanel {
            title: title.into(),
            benchmark: fits.ssfl,
            sample: block.samples[demand_index(edp)].clone(),
            curves,
        });
    }
    Ok(ByConstant {
        heading: Heading::new(
            name(18, None),
            "The constant c of Eq. 7",
            "USFL7 for four constants against the SSFL, \
                              demand 0.15, PGA; untrimmed and trimmed.",
            Some(arm),
        ),
        intensity: Intensity::Pga,
        edp,
        panels,
    }
    .figure(format!(
        "Largest distance of USFL7 to the empirical fragility for c = \
             0.25, 0.5, 0.75, 1: {}.",
        words.join("; ")
    )))
}
