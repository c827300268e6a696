//! Capacity samples of all blocks, and what Lilliefors' test says of them.

use rayon::prelude::*;
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking_statistics::acceptance::NullBand;
use rocking_statistics::lilliefors::LillieforsTest;

use crate::facts::Facts;
use crate::normality::{accepted_share, along, null_band};
use crate::runs::{ArmCurves, capacities};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, SuiteKind, demands,
};

/// Capacities of one block, and the test along the demand.
#[derive(Clone, Debug)]
pub struct BlockSamples {
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Slenderness.
    pub alpha_rad: f64,
    /// The shift IM_R.
    pub shift: f64,
    /// Capacities by level of [`demands`], then by record.
    pub samples: Vec<Vec<f64>>,
    /// The test of ln x by level.
    pub original: Vec<LillieforsTest>,
    /// The test of ln(x - shift) by level.
    pub shifted: Vec<LillieforsTest>,
    /// Null bands of the two accepted shares, in the plan's common arm.
    pub bands: [Option<NullBand>; 2],
}

impl BlockSamples {
    /// Capacities at overturning, the last of the demand levels.
    #[must_use]
    pub fn overturning(&self) -> &[f64] {
        self.samples.last().map_or(&[], Vec::as_slice)
    }

    /// Accepted share of the levels: original, shifted.
    #[must_use]
    pub fn shares(&self) -> (f64, f64) {
        (accepted_share(&self.original), accepted_share(&self.shifted))
    }
}

/// All 15 blocks of a suite in one arm and one measure.
#[derive(Clone, Debug)]
pub struct Distributions {
    /// Arm of the grid.
    pub arm: Arm,
    /// Intensity measure.
    pub intensity: Intensity,
    /// By frequency parameter, then by slenderness.
    pub blocks: Vec<BlockSamples>,
}

/// The distributions of a suite: by arm, PGA then PGV; null bands for the
/// arm `banded`.
///
/// # Errors
/// None in practice: the levels are positive.
pub fn suite_distributions(
    kind: SuiteKind,
    records: &[Facts],
    arms: &[ArmCurves],
    banded: Arm,
) -> anyhow::Result<Vec<Distributions>> {
    let levels = demands();
    let mut out = Vec::new();
    for arm in arms {
        let by_block: Vec<Vec<Vec<f64>>> = arm
            .curves
            .iter()
            .map(|curves| samples(curves, &levels))
            .collect::<Result<_, _>>()?;
        for intensity in [Intensity::Pga, Intensity::Pgv] {
            let banded = (arm.arm == banded).then_some(kind);
            let blocks = by_block
                .iter()
                .enumerate()
                .map(|(i, s)| block(records, intensity, i, s, banded))
                .collect::<Result<_, _>>()?;
            let arm = arm.arm;
            out.push(Distributions { arm, intensity, blocks });
        }
    }
    Ok(out)
}

/// One block of the paper; with null bands where `banded` names the suite.
fn block(
    records: &[Facts],
    intensity: Intensity,
    position: usize,
    pga: &[Vec<f64>],
    banded: Option<SuiteKind>,
) -> anyhow::Result<BlockSamples> {
    let slendernesses = SLENDERNESSES_RAD.len();
    let p_rad_s = FREQUENCIES_RAD_S[position / slendernesses];
    let alpha_rad = SLENDERNESSES_RAD[position % slendernesses];
    let factors = factors(records, intensity, p_rad_s);
    let samples: Vec<Vec<f64>> =
        pga.iter().map(|sample| scaled(sample, &factors)).collect();
    let shift = least(&factors);
    let band = |shift: f64| {
        let sample = if shift > 0.0 { "shifted" } else { "original" };
        let (suite, im) = (banded?, intensity.name());
        let name =
            format!("study/band/{suite}/{im}/{p_rad_s}/{alpha_rad}/{sample}");
        null_band(&samples, shift, &name)
    };
    Ok(BlockSamples {
        bands: [band(0.0), band(shift)],
        p_rad_s,
        alpha_rad,
        shift,
        original: along(&samples, 0.0)?,
        shifted: along(&samples, shift)?,
        samples,
    })
}

/// Samples by level: capacities of all records of a block.
///
/// # Errors
/// For a level that is not positive.
fn samples(
    curves: &[ResponseCurve],
    levels: &[f64],
) -> anyhow::Result<Vec<Vec<f64>>> {
    let by_record: Vec<Vec<f64>> = curves
        .par_iter()
        .map(|curve| capacities(curve, levels, InversionRule::Median))
        .collect::<Result<_, _>>()?;
    let of = |k: usize| by_record.iter().map(|r| r[k]).collect();
    Ok((0..levels.len()).map(of).collect())
}

/// A sample in another measure: each capacity times its record's
/// factor.
#[must_use]
pub fn scaled(sample: &[f64], factors: &[f64]) -> Vec<f64> {
    sample.iter().zip(factors).map(|(x, f)| x * f).collect()
}

/// Factors from PGA/(g tan alpha) to the measure, record by record: 1, or
/// p PGV/PGA. The least of them is IM_R: at uplift PGA/(g tan alpha) is 1.
#[must_use]
pub fn factors(
    records: &[Facts],
    intensity: Intensity,
    p_rad_s: f64,
) -> Vec<f64> {
    let ratios_s = records.iter().map(|r| r.velocity_ratio_s);
    ratios_s.map(|ratio_s| intensity.of(1.0, p_rad_s * ratio_s)).collect()
}

/// Factors from PGA/(g tan alpha) to AvgSA/(g tan alpha), record by record.
#[must_use]
pub fn average_factors(records: &[Facts], frequency: usize) -> Vec<f64> {
    records.iter().map(|r| r.average_ratios[frequency]).collect()
}

/// The least of some numbers; infinite without any.
#[must_use]
pub fn least(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |m, x| if *x < m { *x } else { m })
}
