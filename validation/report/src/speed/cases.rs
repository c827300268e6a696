//! Thirty single analyses: every block once under a record of either
//! embedded suite.

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, curve};
use rocking::integrator::{Model, Overturning, Scene};

use rocking_common::paper::BLOCKS;
use rocking_common::suites::StudySuite;

/// Coefficient of restitution of all of them.
pub const ETA: f64 = 0.92;

/// Levels as shares of the first overturning PGA, one after the other; at 1
/// the block overturns.
const SHARES: [f64; 5] = [0.80, 0.85, 0.90, 0.95, 1.0];

/// One analysis.
pub struct SpeedCase {
    /// `ordinary-01-a-p1-a0.05`.
    pub name: String,
    /// The block.
    pub block: Block,
    /// Its restitution.
    pub restitution: Restitution,
    /// The record.
    pub record: NormalisedRecord,
    /// Peak ground acceleration applied, multiples of gravity.
    pub pga_g: f64,
}

impl SpeedCase {
    /// What is integrated.
    pub fn scene(&self) -> Scene<'_> {
        let record = ScaledRecord::to_pga(&self.record, self.pga_g);
        Scene {
            block: self.block,
            restitution: self.restitution,
            model: Model::Nonlinear,
            overturning: Overturning::Alpha,
            excitation: Excitation::Record(record),
            initial_ratio: 0.0,
        }
    }

    /// Samples as applied, multiples of gravity.
    pub fn samples_g(&self) -> Vec<f64> {
        self.record.samples().iter().map(|a| a * self.pga_g).collect()
    }
}

/// The thirty analyses, always the same: block k takes the record at k/15 of
/// the suite, at the multiple of 0.01 g next below a share of its first
/// overturning.
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
    let restitution = Restitution::constant(ETA)?;
    let curve = curve(&record, &Analysis::paper(block, restitution))?;
    let pgas = || curve.points.iter().map(|point| point.pga_g);
    let last = pgas().next_back().unwrap_or(1.0);
    // The lowest level that moves the block, where the share lies below it.
    let least = pgas().next().unwrap_or(last);
    // A sliver above: 0.9 of 0.50 is 0.45, not 0.44.
    let wanted = share * last * (1.0 + 1e-12);
    let pga_g = pgas().rfind(|pga| *pga <= wanted).unwrap_or(least);
    Ok(SpeedCase {
        name: format!(
            "{}-p{}-a{:.2}",
            record.name(),
            block.frequency_rad_s(),
            block.slenderness_rad()
        ),
        block,
        restitution,
        record,
        pga_g,
    })
}
