//! Thirty single analyses: each block once under a record of each embedded
//! suite.

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, curve};
use rocking::integrator::Scene;

use rocking_common::paper::BLOCKS;
use rocking_common::suites::StudySuite;

/// Coefficient of restitution of all of them.
pub const ETA: f64 = 0.92;

/// Levels as shares of the first overturning PGA, used in turn; at 1 the block
/// overturns.
const SHARES: [f64; 5] = [0.80, 0.85, 0.90, 0.95, 1.0];

/// One analysis.
#[derive(Clone)]
pub struct SpeedCase {
    /// `ordinary-01-a-p1-a0.05`.
    pub name: String,
    /// The block and its restitution.
    pub analysis: Analysis,
    /// The record.
    pub record: NormalisedRecord,
    /// Peak ground acceleration applied, multiples of gravity.
    pub pga_g: f64,
}

impl SpeedCase {
    /// The scene to integrate.
    pub fn scene(&self) -> Scene<'_> {
        scene(&self.analysis, &self.record, self.pga_g)
    }

    /// Samples as applied, multiples of gravity.
    pub fn samples_g(&self) -> Vec<f64> {
        self.record.samples().iter().map(|a| a * self.pga_g).collect()
    }
}

/// A block under a record scaled to `pga_g`.
pub fn scene<'a>(
    analysis: &Analysis,
    record: &'a NormalisedRecord,
    pga_g: f64,
) -> Scene<'a> {
    Scene {
        block: analysis.block,
        restitution: analysis.restitution,
        model: analysis.model,
        overturning: analysis.overturning,
        excitation: Excitation::Record(ScaledRecord::to_pga(record, pga_g)),
        initial_ratio: 0.0,
    }
}

/// The thirty analyses, always the same. Block k takes the record at k/15 of
/// the suite, at the largest multiple of 0.01 g that does not exceed a share
/// of its first overturning PGA.
///
/// # Errors
/// None in practice: records and blocks are in range.
pub fn speed_cases() -> anyhow::Result<Vec<SpeedCase>> {
    let mut cases = Vec::new();
    for suite in StudySuite::embedded()? {
        for (k, block) in BLOCKS.into_iter().enumerate() {
            let place = k * suite.motions.len() / 15;
            let record = &suite.motions[place].study;
            let share = SHARES[(k + k / 5) % SHARES.len()];
            cases.push(case(record, block, share)?);
        }
    }
    Ok(cases)
}

fn case(
    record: &Accelerogram,
    block: Block,
    share: f64,
) -> anyhow::Result<SpeedCase> {
    let record = NormalisedRecord::new(record);
    let analysis = Analysis::paper(block, Restitution::constant(ETA)?);
    let curve = curve(&record, &analysis)?;
    let pgas = || curve.points.iter().map(|point| point.pga_g);
    let last = pgas().next_back().unwrap_or(1.0);
    // The lowest level that moves the block, if the share lies below it.
    let least = pgas().next().unwrap_or(last);
    // A little more: 0.9 of 0.50 is 0.45, not 0.44.
    let wanted = share * last * (1.0 + 1e-12);
    let pga_g = pgas().rfind(|pga| *pga <= wanted).unwrap_or(least);
    Ok(SpeedCase {
        name: format!(
            "{}-p{}-a{:.2}",
            record.name(),
            block.frequency_rad_s(),
            block.slenderness_rad()
        ),
        analysis,
        record,
        pga_g,
    })
}
