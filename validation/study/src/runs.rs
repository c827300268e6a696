//! Analyses of the study: chains of rising intensity, stripes and histories.

use anyhow::anyhow;
use indicatif::ProgressBar;
use rocking::block::{Block, Restitution};
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{self, Adjust, Analysis, BracketEnd, Grid};
use rocking::integrator::{
    Model, Observe, Overturning, Scene, respond, uplift_threshold,
};

use crate::certainty::{Certainty, certainty};
use rocking_common::curves::Execution;
use rocking_common::paper::Arm;

/// Demands at which intensities are compared.
pub const DEMANDS: [f64; 10] =
    [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Settings of every analysis of a study.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Restitution: constant in the paper's study.
    pub restitution: Restitution,
    /// When a block counts as overturned.
    pub overturning: Overturning,
    /// Width to which grids B and C bisect the first overturning, in
    /// dimensionless intensity.
    pub tolerance: f64,
    /// Execution of the curves.
    pub way: Execution,
}

/// Work of the chains of a suite.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ChainWork {
    /// Analyses, bisection included.
    pub analyses: u64,
    /// Levels whose outcome double precision cannot resolve.
    pub certainty: Certainty,
}

/// All curves on one grid.
#[derive(Clone, Debug)]
pub struct ArmCurves {
    /// The grid.
    pub arm: Arm,
    /// Curves by block, then by record.
    pub curves: Vec<Vec<ResponseCurve>>,
}

/// The curves on a grid, by block, then by record.
///
/// # Errors
/// If the grid was not run.
pub fn curves_of(
    arms: &[ArmCurves],
    arm: Arm,
) -> anyhow::Result<&[Vec<ResponseCurve>]> {
    let found = arms.iter().find(|own| own.arm == arm);
    found.map(|own| own.curves.as_slice()).ok_or_else(|| not_run(arm))
}

/// The error if results of a grid are read that was not run.
pub(crate) fn not_run(arm: Arm) -> anyhow::Error {
    anyhow!("grid {} was not run", arm.name())
}

impl Setup {
    /// The analysis of a block on a grid.
    fn analysis(&self, block: Block, arm: Arm, adjust: Adjust) -> Analysis {
        let hundredths = Grid::Pga { step_g: 0.01 };
        let (grid, refine) = match arm {
            Arm::A => (hundredths, None),
            Arm::B => (hundredths, Some(self.tolerance)),
            Arm::C => (Grid::Im { step: 0.02 }, Some(self.tolerance)),
        };
        let overturning = self.overturning;
        let paper = Analysis::paper(block, self.restitution);
        Analysis { overturning, grid, adjust, refine, ..paper }
    }

    /// The curves of every block and record on each grid, and their work. Grids A
    /// and B are one scan. `progress` counts the chains.
    ///
    /// # Errors
    /// If a record cannot be scaled, or an adjusted block is invalid.
    pub fn chains(
        &self,
        blocks: &[Block],
        records: &[NormalisedRecord],
        arms: &[Arm],
        adjust: Adjust,
        progress: &ProgressBar,
    ) -> anyhow::Result<(Vec<ArmCurves>, ChainWork)> {
        let scans = Self::scans(arms);
        let of_scan = |arm: &Arm| {
            let arm = *arm;
            blocks.iter().map(move |b| self.analysis(*b, arm, adjust))
        };
        let analyses: Vec<Analysis> = scans.iter().flat_map(of_scan).collect();
        progress.inc_length((analyses.len() * records.len()) as u64);
        let runs = self.way.curves(records, &analyses, &|| progress.inc(1))?;
        let of_arm = |arm: &Arm| -> anyhow::Result<ArmCurves> {
            let own = |scan: &Arm| (*scan == Arm::C) == (*arm == Arm::C);
            let scan = scans.iter().position(own).unwrap_or(0);
            let overturned = match arm {
                Arm::A => BracketEnd::Scanned,
                Arm::B | Arm::C => BracketEnd::Refined,
            };
            let curves = runs[scan * blocks.len()..][..blocks.len()]
                .iter()
                .map(|runs| runs.iter().map(|r| r.response(overturned)))
                .map(|curves| curves.collect::<Result<_, _>>())
                .collect::<Result<_, _>>()?;
            Ok(ArmCurves { arm: *arm, curves })
        };
        let work = ChainWork {
            analyses: runs.iter().flatten().map(|run| run.analyses).sum(),
            certainty: certainty(&analyses, records, &runs)?,
        };
        let curves = arms.iter().map(of_arm).collect::<Result<_, _>>()?;
        Ok((curves, work))
    }

    /// The scans of these grids: one for A and B, bisected if B is among them.
    fn scans(arms: &[Arm]) -> Vec<Arm> {
        let hundredths = if arms.contains(&Arm::B) { Arm::B } else { Arm::A };
        let mut scans: Vec<Arm> = arms
            .iter()
            .map(|arm| if *arm == Arm::C { Arm::C } else { hundredths })
            .collect();
        scans.dedup();
        scans
    }

    /// Demand of `block` at dimensionless intensity `im`: by scaling the
    /// record, or by adjusting the slenderness.
    ///
    /// # Errors
    /// If the block or the scale is invalid.
    pub fn demand(
        &self,
        block: Block,
        record: &NormalisedRecord,
        im: f64,
        adjust: Adjust,
    ) -> anyhow::Result<f64> {
        let analysis = self.analysis(block, Arm::A, adjust);
        Ok(ida::demand_at(record, &analysis, im)?.edp())
    }

    /// History of theta/alpha every `interval_s`, and the peak (infinite if the
    /// block overturned).
    ///
    /// # Errors
    /// If the record cannot be scaled to this intensity.
    pub fn history(
        &self,
        block: Block,
        record: &NormalisedRecord,
        im: f64,
        interval_s: f64,
    ) -> anyhow::Result<(Vec<f64>, f64)> {
        let pga_g = im * uplift_threshold(&block, Model::Nonlinear);
        let excitation =
            Excitation::Record(ScaledRecord::to_pga(record, pga_g));
        let scene = Scene {
            overturning: self.overturning,
            ..Scene::new(block, self.restitution, excitation)
        };
        let observe = Observe {
            history_interval_s: Some(interval_s),
            ..Observe::default()
        };
        let response = respond(&scene, &observe)?;
        let ratio = |rotation_rad: f64| rotation_rad / block.slenderness_rad();
        let history = response.history.iter();
        let history = history.map(|point| ratio(point.rotation_rad));
        Ok((history.collect(), response.outcome.edp()))
    }
}

/// Capacities of one curve at demand levels by a rule; infinite for a level
/// that was never reached.
///
/// # Errors
/// For a level that is not positive.
pub fn capacities(
    curve: &ResponseCurve,
    levels: &[f64],
    rule: InversionRule,
) -> anyhow::Result<Vec<f64>> {
    levels.iter().map(|e| Ok(curve.capacity(*e, rule)?.im())).collect()
}

#[cfg(test)]
mod tests;
