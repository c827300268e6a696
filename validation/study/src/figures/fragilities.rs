//! Figures 15 to 18: fitted and transformed fragilities.

mod thresholds;

pub(super) use thresholds::thresholds;

use rocking::statistics::ExtendedSample;

use crate::distributions::BlockSamples;
use crate::fits::{BLOCK, CONSTANTS, Fits, THRESHOLDS, usfl7};
use crate::results::Results;
use rocking_common::paper::{Arm, Intensity, demand_index};
use rocking_draw::figures::Figure;
use rocking_draw::figures::{ByConstant, ByConstantPanel, Heading};

fn sample_at(
    block: &BlockSamples,
    edp: f64,
) -> anyhow::Result<ExtendedSample> {
    Ok(ExtendedSample::try_new(&block.samples[demand_index(edp)])?)
}

/// Figure 18: demand 0.15, PGA.
pub(super) fn constants(
    results: &Results,
    arm: Arm,
) -> anyhow::Result<Figure> {
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
                (*c, fitted)
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
        heading: Heading::numbered(
            18,
            false,
            "The constant c of Eq. 7",
            "USFL7 for four constants against the SSFL, \
                              demand 0.15, PGA; untrimmed and trimmed.",
            Some(arm),
        ),
        edp,
        panels,
    }
    .figure(format!(
        "Largest distance of USFL7 to the empirical fragility for c = \
             0.25, 0.5, 0.75, 1: {}.",
        words.join("; ")
    )))
}
