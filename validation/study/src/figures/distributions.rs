//! Figures 11 to 14: capacities and their tests.

use rocking::statistics::lilliefors::Assessment;
use rocking::statistics::{QuantileType, Sample};

use crate::analyses::no_arm;
use crate::estimates::three_quantiles;
use crate::normality::{
    BAND_REPLICATES, LEVEL, accepted_share, ends, over_critical,
};
use crate::results::Results;
use crate::ties::critical_on_grid;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, demand_index,
    demands,
};
use rocking_common::words::percent;
use rocking_draw::figures::Figure;
use rocking_draw::figures::{
    AcceptedShares, BlockShare, Capacities, CapacityCurve, CapacityPanel,
    Heading, Histogram, SharePanel, TestedBlock, TestsAlongDemand,
};

/// Figure 11: p = 1, alpha = 0.20.
pub(super) fn inverted(results: &Results, arm: Arm) -> anyhow::Result<Figure> {
    let levels = demands();
    let mut panels = Vec::new();
    let mut onsets = Vec::new();
    let mut ends = 0;
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        let block = results.ordinary_block(arm, intensity, 0, 3)?;
        onsets.push(three_quantiles(&block.samples[0])?);
        let last = block.samples.last().ok_or_else(no_arm)?;
        ends = last.iter().filter(|x| !x.is_finite()).count();
        let records = results.ordinary.records.iter().enumerate();
        panels.push(CapacityPanel {
            intensity,
            shift: block.shift,
            curves: records
                .map(|(record, facts)| CapacityCurve {
                    record: facts.name.clone(),
                    edp: levels.clone(),
                    im: block.samples.iter().map(|s| s[record]).collect(),
                })
                .collect(),
            quantiles: levels
                .iter()
                .zip(&block.samples)
                .map(|(edp, sample)| Ok((*edp, three_quantiles(sample)?)))
                .collect::<anyhow::Result<_>>()?,
        });
    }
    let times = |of: [f64; 3], less: f64| (of[2] - less) / (of[0] - less);
    let shifts: Vec<f64> = panels.iter().map(|p| p.shift).collect();
    let cut = match ends {
        0 => String::new(),
        n => format!(" {n} records never overturn: their curves end early."),
    };
    Ok(Capacities {
        heading: Heading::numbered(
            11,
            false,
            "Intensity given demand, original and shifted",
            "A pale curve for each record of the intensity that reaches a \
             demand, by median point, with median and band of 16 to 84 % of \
             the records; rows PGA and PGV, columns as inverted and above \
             IM_R; logarithmic intensity.",
            Some(arm),
        ),
        alpha_rad: SLENDERNESSES_RAD[3],
        p_rad_s: FREQUENCIES_RAD_S[0],
        panels,
    }
    .thinned()
    .figure(format!(
        "At the lowest demand the 84 % capacity is {:.2} times the 16 % \
         one for PGA, and {:.2} times for PGV. Less IM_R it is {:.2} and \
         {:.2} times.{cut}",
        times(onsets[0], 0.0),
        times(onsets[1], 0.0),
        times(onsets[0], shifts[0]),
        times(onsets[1], shifts[1]),
    )))
}

/// Figure 12 (PGA) or 14 (PGV).
pub(super) fn shares(
    results: &Results,
    number: u32,
) -> anyhow::Result<Figure> {
    let intensity = if number == 12 { Intensity::Pga } else { Intensity::Pgv };
    let drawn = results.plan.drawn();
    let mut panels = Vec::new();
    let mut means = Vec::new();
    for suite in [&results.ordinary, &results.pulse] {
        for shifted in [false, true] {
            let mut shares = Vec::new();
            for arm in &drawn {
                let found = results.distributions(suite.kind, *arm, intensity);
                for block in &found.ok_or_else(no_arm)?.blocks {
                    let (original, above) = block.shares();
                    shares.push(BlockShare {
                        p_rad_s: block.p_rad_s,
                        alpha_rad: block.alpha_rad,
                        arm: *arm,
                        share: if shifted { above } else { original },
                        null_band: block.bands[usize::from(shifted)]
                            .as_ref()
                            .and_then(ends),
                        levels: tested(if shifted {
                            &block.shifted
                        } else {
                            &block.original
                        }),
                    });
                }
            }
            // Of the arm that the findings show first.
            let common = results.plan.common();
            let own = || shares.iter().filter(|b| b.arm == common);
            let mean =
                own().fold(0.0, |s, b| s + b.share) / own().count() as f64;
            means.push(percent(mean, 1));
            panels.push(SharePanel {
                suite: suite.kind.name().into(),
                records: suite.records.len(),
                shifted,
                shares,
            });
        }
    }
    let measure = if number == 12 { "PGA" } else { "PGV" };
    let all = || panels.iter().flat_map(|p| &p.shares);
    let fewest = all().map(|s| s.levels).min().unwrap_or(0);
    let levels = demands().len();
    let rests = if fewest < levels {
        format!(
            "Where a record never overturns, fewer levels can be tested: \
             {fewest} at least; the panels count them."
        )
    } else {
        format!("All {levels} levels were tested for every block.")
    };
    Ok(AcceptedShares {
        heading: Heading::numbered(
            number,
            false,
            format!(
                "Share of demand levels at which lognormality is \
                     accepted, {measure}"
            ),
            "Percent of the demand levels accepted by Lilliefors' test at \
             5 %, for 15 blocks and the arms drawn, with a band for each \
             mark of one arm; original and shifted samples, ordinary and \
             pulse-type.",
            None,
        ),
        intensity,
        expected: 1.0 - LEVEL,
        levels,
        panels,
        columns: 2,
    }
    .figure(format!(
        "On arm {0} the mean accepted share is {1} (original) and {2} \
         (shifted) for ordinary records, {3} and {4} for pulse-type ones. \
         {rests} The bands are of arm {0} too: they hold 95 % of \
         {BAND_REPLICATES} lognormal suites with the same dependence between \
         levels.",
        results.plan.common().letter(),
        means[0],
        means[1],
        means[2],
        means[3],
    )))
}

/// How many levels could be tested.
fn tested(levels: &[Assessment]) -> usize {
    levels.iter().filter(|a| over_critical(a).is_finite()).count()
}

/// Figure 13: p = 3, alpha = 0.05 and 0.20, PGA.
pub(super) fn along(results: &Results, arm: Arm) -> anyhow::Result<Figure> {
    let edp = 0.5;
    let mut blocks = Vec::new();
    let mut words = Vec::new();
    for slenderness in [0, 3] {
        let block =
            results.ordinary_block(arm, Intensity::Pga, 1, slenderness)?;
        words.push(format!(
            "{} and {} at alpha = {:.2}",
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
            grid_critical: (arm == Arm::A)
                .then(|| critical_on_grid(block))
                .flatten(),
            original_histogram: histogram(&block.original[demand_index(edp)]),
            shifted_histogram: histogram(&block.shifted[demand_index(edp)]),
        });
    }
    Ok(TestsAlongDemand {
        heading: Heading::numbered(
            13,
            true,
            "Lilliefors' test along the demand, p = 3",
            "Test statistic over its critical value along the demand, and \
             histograms of the logarithm of the capacity at demand 0.50, \
             original and shifted; alpha = 0.05 and 0.20.",
            Some(arm),
        ),
        edp,
        blocks,
    }
    .figure(format!(
        "Of the original and of the shifted levels the test accepts {}.{}",
        words.join(", "),
        if arm == Arm::A {
            " The diamond is the 5 % critical value of a shifted lognormal \
             whose overturnings lie on the 0.01 g grid."
        } else {
            ""
        }
    )))
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
