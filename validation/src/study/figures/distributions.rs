//! Figures 11 to 14: capacities and their tests.

use rocking::statistics::lilliefors::Assessment;
use rocking::statistics::{QuantileType, Sample};

use super::{Figure, Results, name};
use crate::draw::figures::{
    AcceptedShares, BlockShare, Capacities, CapacityCurve, CapacityPanel,
    Heading, Histogram, SharePanel, TestedBlock, TestsAlongDemand,
};
use crate::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, SuiteKind,
    demand_index, demands, position,
};
use crate::study::StudyError;
use crate::study::distributions::{BlockSamples, Distributions};
use crate::study::normality::{LEVEL, accepted_share, ends, over_critical};
use crate::words::{percent, range};

impl Results {
    /// The capacity samples of a suite in an arm and a measure.
    #[must_use]
    pub fn distributions(
        &self,
        kind: SuiteKind,
        arm: Arm,
        intensity: Intensity,
    ) -> Option<&Distributions> {
        self.distributions.iter().find(|d| {
            d.kind == kind && d.arm == arm && d.intensity == intensity
        })
    }

    /// One block of the ordinary suite.
    ///
    /// # Errors
    /// [`StudyError::NoArm`] if the arm was not run.
    pub(crate) fn ordinary_block(
        &self,
        arm: Arm,
        intensity: Intensity,
        frequency: usize,
        slenderness: usize,
    ) -> Result<&BlockSamples, StudyError> {
        let kind = self.ordinary.kind;
        let found = self.distributions(kind, arm, intensity);
        let found = found.ok_or(StudyError::NoArm)?;
        Ok(&found.blocks[position(frequency, slenderness)])
    }
}

/// Figure 11: p = 1, alpha = 0.20.
pub(super) fn inverted(
    results: &Results,
    arm: Arm,
) -> Result<Figure, StudyError> {
    let levels = demands();
    // Every fourth level is enough to draw.
    let kept: Vec<usize> =
        (0..levels.len()).filter(|i| *i == 0 || (i + 1) % 4 == 0).collect();
    let mut panels = Vec::new();
    let mut onsets = Vec::new();
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        let block = results.ordinary_block(arm, intensity, 0, 3)?;
        onsets.push(range(block.samples[0].iter().copied()));
        let records = results.ordinary.records.iter().enumerate();
        panels.push(CapacityPanel {
            intensity,
            shift: block.shift,
            curves: records
                .map(|(record, facts)| CapacityCurve {
                    record: facts.name.clone(),
                    edp: kept.iter().map(|i| levels[*i]).collect(),
                    im: kept
                        .iter()
                        .map(|i| block.samples[*i][record])
                        .collect(),
                })
                .collect(),
        });
    }
    let (pga, pgv) = (onsets[0], onsets[1]);
    Ok(Capacities {
        heading: Heading::new(
            name(11, None),
            "Intensity given demand, original and shifted",
            "A curve for each record of the intensity that \
                              reaches a demand, by median point; PGA and \
                              PGV, as inverted and above IM_R.",
            Some(arm),
        ),
        alpha_rad: SLENDERNESSES_RAD[3],
        p_rad_s: FREQUENCIES_RAD_S[0],
        panels,
    }
    .thinned()
    .figure(format!(
        "At the lowest demand all capacities lie between {:.3} and \
             {:.3} for PGA, but between {:.3} and {:.3} for PGV: the onset \
             is sharp in the former alone.",
        pga.0, pga.1, pgv.0, pgv.1
    )))
}

/// Figure 12 (PGA) or 14 (PGV).
pub(super) fn shares(
    results: &Results,
    number: u32,
) -> Result<Figure, StudyError> {
    let intensity = if number == 12 { Intensity::Pga } else { Intensity::Pgv };
    let drawn = results.plan.drawn();
    let mut panels = Vec::new();
    let mut words = Vec::new();
    for suite in [&results.ordinary, &results.pulse] {
        for shifted in [false, true] {
            let mut shares = Vec::new();
            for arm in &drawn {
                let found = results.distributions(suite.kind, *arm, intensity);
                for block in &found.ok_or(StudyError::NoArm)?.blocks {
                    let (original, above) = block.shares();
                    shares.push(BlockShare {
                        p_rad_s: block.p_rad_s,
                        alpha_rad: block.alpha_rad,
                        arm: *arm,
                        share: if shifted { above } else { original },
                        null_band: block.bands[usize::from(shifted)]
                            .as_ref()
                            .and_then(ends),
                    });
                }
            }
            // Of the arm that the findings show first.
            let common = results.plan.common();
            let own = || shares.iter().filter(|b| b.arm == common);
            let mean =
                own().fold(0.0, |s, b| s + b.share) / own().count() as f64;
            let sample = if shifted { "shifted" } else { "original" };
            words.push(format!(
                "{} for {sample} {} samples",
                percent(mean, 1),
                suite.kind
            ));
            panels.push(SharePanel {
                suite: suite.kind.name().into(),
                records: suite.records.len(),
                shifted,
                shares,
            });
        }
    }
    let measure = if number == 12 { "PGA" } else { "PGV" };
    Ok(AcceptedShares {
        heading: Heading::new(
            name(number, None),
            format!(
                "Share of demand levels at which lognormality is \
                     accepted, {measure}"
            ),
            "Percent of 200 demand levels accepted by \
                              Lilliefors' test at 5 %, for 15 blocks; \
                              original and shifted samples, ordinary and \
                              pulse-type.",
            None,
        ),
        intensity,
        expected: 1.0 - LEVEL,
        panels,
        columns: 2,
    }
    .figure(format!(
        "Mean over blocks of the accepted share, arm {}: {}. A band belongs \
         to the mark in front of it.",
        results.plan.common().letter(),
        words.join(", ")
    )))
}

/// Figure 13: p = 3, alpha = 0.05 and 0.20, PGA.
pub(super) fn along(
    results: &Results,
    arm: Arm,
) -> Result<Figure, StudyError> {
    let edp = 0.5;
    let mut blocks = Vec::new();
    let mut words = Vec::new();
    for slenderness in [0, 3] {
        let block =
            results.ordinary_block(arm, Intensity::Pga, 1, slenderness)?;
        words.push(format!(
            "{} original and {} shifted at alpha = {:.2}",
            percent(accepted_share(&block.original), 1),
            percent(accepted_share(&block.shifted), 1),
            block.alpha_rad
        ));
        blocks.push(TestedBlock {
            p_rad_s: block.p_rad_s,
            alpha_rad: block.alpha_rad,
            edp: demands(),
            original: block.original.iter().map(over_critical).collect(),
            shifted: block.shifted.iter().map(over_critical).collect(),
            original_histogram: histogram(&block.original[demand_index(edp)]),
            shifted_histogram: histogram(&block.shifted[demand_index(edp)]),
        });
    }
    Ok(TestsAlongDemand {
        heading: Heading::new(
            name(13, Some(arm)),
            "Lilliefors' test along the demand, p = 3",
            "Test statistic over its critical value along \
                              the demand, and histograms of the logarithm \
                              of the capacity at demand 0.50, original and \
                              shifted; alpha = 0.05 and 0.20.",
            Some(arm),
        ),
        intensity: Intensity::Pga,
        edp,
        blocks,
    }
    .figure(format!("Accepted levels: {}.", words.join("; "))))
}

/// Of the logarithms tested.
fn histogram(test: &Assessment) -> Histogram {
    let none = || Histogram::freedman_diaconis(&[], (0.0, 0.0), 0.0, 0.0);
    let Some(logs) = &test.tested else { return none() };
    let n = logs.len() as f64;
    let deviation = (logs.sum_of_squares() / (n - 1.0)).sqrt();
    let quartile = |p| quartile(logs, p);
    let quartiles = (quartile(0.25), quartile(0.75));
    Histogram::freedman_diaconis(
        logs.sorted(),
        quartiles,
        logs.mean(),
        deviation,
    )
}

fn quartile(sample: &Sample, p: f64) -> f64 {
    QuantileType::default().of(sample, p).unwrap_or(f64::NAN)
}
