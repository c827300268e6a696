//! The analyses of the study: chains of rising intensity, stripes,
//! histories.

use rocking::block::{Block, Restitution};
use rocking::capacity::{InversionRule, ResponseCurve};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{self, Adjust, Analysis, Grid, Overturned};
use rocking::integrator::{
    Model, Observe, Overturning, Response, Scene, respond, uplift_threshold,
};

use crate::certainty::{Certainty, certainty};
use rocking_common::curves::Execution;
use rocking_common::paper::Arm;

/// What holds for every analysis of a study.
#[derive(Clone, Debug)]
pub struct Setup {
    /// Restitution: constant for the paper's study.
    pub restitution: Restitution,
    /// When a block counts as overturned.
    pub overturning: Overturning,
    /// Width to which arms B and C bisect the first overturning, in
    /// dimensionless intensity.
    pub tolerance: f64,
    /// How curves are made.
    pub way: Execution,
}

/// The curves of blocks under records, and what they took.
#[derive(Clone, Debug)]
pub struct Chains {
    /// Curves by arm (in the order asked for), by block, by record.
    pub curves: Vec<Vec<Vec<ResponseCurve>>>,
    /// Analyses made.
    pub analyses: u64,
    /// Levels whose fate double precision cannot tell.
    pub certainty: Certainty,
}

impl Setup {
    /// What an arm asks of a block.
    fn analysis(&self, block: Block, arm: Arm, adjust: Adjust) -> Analysis {
        Analysis {
            overturning: self.overturning,
            grid: match arm {
                Arm::A | Arm::B => Grid::Pga { step_g: 0.01 },
                Arm::C => Grid::Im { step: 0.02 },
            },
            adjust,
            refine: match arm {
                Arm::A => None,
                Arm::B | Arm::C => Some(self.tolerance),
            },
            ..Analysis::paper(block, self.restitution)
        }
    }

    /// The curves of every block and record in the arms asked for; A and B
    /// are one scan. `done` is called after each chain.
    ///
    /// # Errors
    /// Where a record cannot be scaled, or there is no such
    /// block.
    pub fn chains(
        &self,
        blocks: &[Block],
        records: &[NormalisedRecord],
        arms: &[Arm],
        adjust: Adjust,
        done: impl Fn() + Sync,
    ) -> anyhow::Result<Chains> {
        let scans = Self::scans(arms);
        let analyses: Vec<Analysis> = scans
            .iter()
            .flat_map(|arm| blocks.iter().map(move |b| (*b, *arm)))
            .map(|(block, arm)| self.analysis(block, arm, adjust))
            .collect();
        let runs = self.way.curves(records, &analyses, &done)?;
        let all = || runs.iter().flatten();
        let curves = arms
            .iter()
            .map(|arm| {
                let own = |scan: &Arm| (*scan == Arm::C) == (*arm == Arm::C);
                let first = scans.iter().position(own).unwrap_or(0);
                let first = first * blocks.len();
                runs[first..first + blocks.len()]
                    .iter()
                    .map(|runs| {
                        runs.iter()
                            .map(|run| Ok(run.response(overturned(*arm))?))
                            .collect()
                    })
                    .collect()
            })
            .collect::<anyhow::Result<_>>()?;
        Ok(Chains {
            curves,
            analyses: all().map(|run| run.analyses).sum(),
            certainty: certainty(&analyses, records, &runs)?,
        })
    }

    /// Arms as they are scanned: A and B once, bisected if B is asked for.
    pub(super) fn scans(arms: &[Arm]) -> Vec<Arm> {
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
    /// Where there is no such block or scale.
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

    /// The response of `block` to the record scaled to `pga_g`.
    fn respond(
        &self,
        block: Block,
        record: &NormalisedRecord,
        pga_g: f64,
        observe: &Observe,
    ) -> anyhow::Result<Response> {
        let scaled = ScaledRecord::to_pga(record, pga_g);
        let scene = Scene {
            block,
            restitution: self.restitution,
            model: Model::Nonlinear,
            overturning: self.overturning,
            excitation: Excitation::Record(scaled),
            initial_ratio: 0.0,
        };
        Ok(respond(&scene, observe)?)
    }

    /// History of theta/alpha every `interval_s`, and the peak (infinite
    /// when overturned).
    ///
    /// # Errors
    /// Where the record cannot be scaled so.
    pub fn history(
        &self,
        block: Block,
        record: &NormalisedRecord,
        im: f64,
        interval_s: f64,
    ) -> anyhow::Result<(Vec<f64>, f64)> {
        let pga_g = im * uplift_threshold(&block, Model::Nonlinear);
        let observe = Observe {
            history_interval_s: Some(interval_s),
            ..Observe::default()
        };
        let response = self.respond(block, record, pga_g, &observe)?;
        let ratio = response
            .history
            .iter()
            .map(|point| point.rotation_rad / block.slenderness_rad())
            .collect();
        Ok((ratio, response.outcome.edp()))
    }
}

/// Capacities of one curve at demand levels by a rule; infinite where a level
/// was never reached.
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

/// What is known of a curve's first overturning: the intensity twice, or the
/// last one that was run and infinity.
#[must_use]
pub fn overturning(curve: &ResponseCurve) -> (f64, f64) {
    let last = (curve.last_im(), f64::INFINITY);
    curve.overturning_im().map_or(last, |im| (im, im))
}

/// What an arm counts as the first overturning.
fn overturned(arm: Arm) -> Overturned {
    match arm {
        Arm::A => Overturned::Scanned,
        Arm::B | Arm::C => Overturned::Refined,
    }
}

#[cfg(test)]
mod tests;
