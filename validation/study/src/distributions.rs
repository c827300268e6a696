//! Capacity samples of all blocks, and Lilliefors' test of them.

use rayon::prelude::*;
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking_statistics::acceptance::NullBand;
use rocking_statistics::lilliefors::LillieforsTest;

use crate::facts::Facts;
use crate::normality::{accepted_share, along, null_band};
use crate::runs::{ArmCurves, capacities};
use rocking_common::paper::{Arm, BLOCKS, Intensity, SuiteKind, demands};

/// The samples of a block, in the order of [`BlockSamples::tests`].
pub const SAMPLES: [&str; 2] = ["original", "shifted"];

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
    /// Tests by level of ln x, and of ln(x - shift).
    pub tests: [Vec<LillieforsTest>; 2],
    /// Null bands of the two accepted shares, on the plan's common grid.
    pub bands: [Option<NullBand>; 2],
}

impl BlockSamples {
    /// Capacities at overturning, the last of the demand levels.
    pub fn overturning(&self) -> &[f64] {
        self.samples.last().map_or(&[], Vec::as_slice)
    }

    /// Accepted shares of the levels, by [`SAMPLES`].
    pub fn shares(&self) -> [f64; 2] {
        self.tests.each_ref().map(|tests| accepted_share(tests))
    }
}

/// All 15 blocks of a suite on one grid, in one intensity measure.
#[derive(Clone, Debug)]
pub struct Distributions {
    /// The grid.
    pub arm: Arm,
    /// Intensity measure.
    pub intensity: Intensity,
    /// By frequency parameter, then by slenderness.
    pub blocks: Vec<BlockSamples>,
}

/// The distributions of a suite: by grid, PGA then PGV. The grid `banded`
/// gets null bands.
///
/// # Errors
/// Never in practice: the levels are positive.
pub fn suite_distributions(
    kind: SuiteKind,
    records: &[Facts],
    arms: &[ArmCurves],
    banded: Arm,
) -> anyhow::Result<Vec<Distributions>> {
    let mut out = Vec::new();
    for ArmCurves { arm, curves } in arms {
        let by_block: Vec<Vec<Vec<f64>>> = curves
            .iter()
            .map(|curves| samples(curves))
            .collect::<Result<_, _>>()?;
        let banded = (*arm == banded).then_some(kind);
        for intensity in [Intensity::Pga, Intensity::Pgv] {
            let blocks = by_block.iter().enumerate();
            let blocks = blocks
                .map(|(i, pga)| block(records, intensity, i, pga, banded))
                .collect::<Result<_, _>>()?;
            out.push(Distributions { arm: *arm, intensity, blocks });
        }
    }
    Ok(out)
}

/// One block of the paper, with null bands if `banded` names the suite.
fn block(
    records: &[Facts],
    intensity: Intensity,
    position: usize,
    pga: &[Vec<f64>],
    banded: Option<SuiteKind>,
) -> anyhow::Result<BlockSamples> {
    let p_rad_s = BLOCKS[position].frequency_rad_s();
    let alpha_rad = BLOCKS[position].slenderness_rad();
    let factors = factors(records, intensity, p_rad_s);
    let samples: Vec<Vec<f64>> =
        pga.iter().map(|sample| scaled(sample, &factors)).collect();
    let shift = least(&factors);
    let band = |k: usize| {
        let (suite, im, sample) = (banded?, intensity.name(), SAMPLES[k]);
        let name =
            format!("study/band/{suite}/{im}/{p_rad_s}/{alpha_rad}/{sample}");
        null_band(&samples, [0.0, shift][k], &name)
    };
    Ok(BlockSamples {
        bands: [band(0), band(1)],
        p_rad_s,
        alpha_rad,
        shift,
        tests: [along(&samples, 0.0)?, along(&samples, shift)?],
        samples,
    })
}

/// Capacities of all records of a block, by level.
fn samples(curves: &[ResponseCurve]) -> anyhow::Result<Vec<Vec<f64>>> {
    let levels = demands();
    let by_record: Vec<Vec<f64>> = curves
        .par_iter()
        .map(|curve| capacities(curve, &levels, InversionRule::Median))
        .collect::<Result<_, _>>()?;
    let of = |k: usize| by_record.iter().map(|r| r[k]).collect();
    Ok((0..levels.len()).map(of).collect())
}

/// A sample in another measure: each capacity times the factor of its record.
pub fn scaled(sample: &[f64], factors: &[f64]) -> Vec<f64> {
    sample.iter().zip(factors).map(|(x, f)| x * f).collect()
}

/// Factors from PGA/(g tan alpha) to the measure, record by record: 1, or
/// p PGV/PGA. The least factor is IM_R: at uplift PGA/(g tan alpha) is 1.
pub fn factors(
    records: &[Facts],
    intensity: Intensity,
    p_rad_s: f64,
) -> Vec<f64> {
    let ratios_s = records.iter().map(|r| r.velocity_ratio_s);
    ratios_s.map(|ratio_s| intensity.of(1.0, p_rad_s * ratio_s)).collect()
}

/// Factors from PGA/(g tan alpha) to AvgSA/(g tan alpha), record by record.
pub fn average_factors(records: &[Facts], frequency: usize) -> Vec<f64> {
    records.iter().map(|r| r.average_ratios[frequency]).collect()
}

/// The least of some numbers; infinite for an empty slice.
pub fn least(values: &[f64]) -> f64 {
    values.iter().fold(f64::INFINITY, |m, x| if *x < m { *x } else { m })
}
