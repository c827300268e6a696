//! The analyses of the study: chains of rising intensity, stripes,
//! histories.

use rocking::block::{Block, Restitution};
use rocking::capacity::ResponseCurve;
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{self, Analysis, Grid, IdaCurve, Method};
use rocking::integrator::{
    Model, Observe, Outcome, Overturning, Response, Scene, respond,
    uplift_threshold,
};

use super::StudyError;
use crate::figures::data::Arm;

/// What holds for every analysis of a study.
#[derive(Clone, Copy, Debug)]
pub struct Setup {
    /// Restitution: constant for the paper's study.
    pub restitution: Restitution,
    /// When a block counts as overturned.
    pub overturning: Overturning,
    /// Width to which arms B and C bisect the first overturning, in
    /// dimensionless intensity.
    pub tolerance: f64,
}

/// The curves of one block and record, arm by arm, and what they took.
#[derive(Clone, Debug)]
pub struct Chain {
    /// Curves in the order of the arms asked for.
    pub curves: Vec<ResponseCurve>,
    /// Analyses made.
    pub analyses: u64,
    /// Analyses whose fate double precision cannot tell.
    pub unresolved: usize,
}

impl Setup {
    /// What an arm asks of a block.
    fn analysis(&self, block: Block, arm: Arm, method: Method) -> Analysis {
        Analysis {
            overturning: self.overturning,
            grid: match arm {
                Arm::A | Arm::B => Grid::Pga { step_g: 0.01 },
                Arm::C => Grid::Im { step: 0.02 },
            },
            method,
            refine: match arm {
                Arm::A => None,
                Arm::B | Arm::C => Some(self.tolerance),
            },
            ..Analysis::paper(block, self.restitution)
        }
    }

    /// The curves of one chain in the arms asked for; A and B are one scan.
    ///
    /// # Errors
    /// [`StudyError`] where the record cannot be scaled.
    pub fn chain(
        &self,
        block: Block,
        record: &NormalisedRecord,
        arms: &[Arm],
    ) -> Result<Chain, StudyError> {
        let mut scan: Option<IdaCurve> = None;
        let mut chain =
            Chain { curves: Vec::new(), analyses: 0, unresolved: 0 };
        let refined = arms.contains(&Arm::B);
        for arm in arms {
            let run = match (arm, &scan) {
                (Arm::B, Some(scan)) => scan.clone(),
                (Arm::A, _) if refined => {
                    self.scan(block, record, Arm::B, &mut chain)?
                }
                _ => self.scan(block, record, *arm, &mut chain)?,
            };
            chain.curves.push(response_curve(&run, *arm)?);
            scan = Some(run).filter(|_| *arm == Arm::A);
        }
        Ok(chain)
    }

    fn scan(
        &self,
        block: Block,
        record: &NormalisedRecord,
        arm: Arm,
        chain: &mut Chain,
    ) -> Result<IdaCurve, StudyError> {
        let analysis = self.analysis(block, arm, Method::RecordScaling);
        let run = ida::curve(record, &analysis)?;
        chain.analyses += run.analyses;
        chain.unresolved += run.points.iter().filter(|p| !p.resolved).count();
        Ok(run)
    }

    /// The curve of one record by slenderness adjustment, on the levels of
    /// the reference block.
    ///
    /// # Errors
    /// [`StudyError`] where there is no such block.
    pub fn chain_adjusted(
        &self,
        reference: Block,
        record: &NormalisedRecord,
        arm: Arm,
    ) -> Result<ResponseCurve, StudyError> {
        let method = Method::SlendernessAdjustment;
        let analysis = self.analysis(reference, arm, method);
        response_curve(&ida::curve(record, &analysis)?, arm)
    }

    /// Demand of `block` at dimensionless intensity `im`: by scaling the
    /// record, or by adjusting the slenderness.
    ///
    /// # Errors
    /// [`StudyError`] where there is no such block or scale.
    pub fn demand(
        &self,
        block: Block,
        record: &NormalisedRecord,
        im: f64,
        method: Method,
    ) -> Result<f64, StudyError> {
        let analysis = self.analysis(block, Arm::A, method);
        Ok(ida::at(record, &analysis, im)?.edp())
    }

    /// The response of `block` to the record scaled to `pga_g`.
    fn respond(
        &self,
        block: Block,
        record: &NormalisedRecord,
        pga_g: f64,
        observe: &Observe,
    ) -> Result<Response, StudyError> {
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

    /// Whether the onset of rocking is not exactly at intensity 1: a motion
    /// there, or none at 1 + 1e-9.
    ///
    /// # Errors
    /// [`StudyError`] where the record cannot be scaled so.
    pub fn violates_onset(
        &self,
        block: Block,
        record: &NormalisedRecord,
    ) -> Result<bool, StudyError> {
        let threshold = uplift_threshold(&block, Model::Nonlinear);
        let moves = |pga_g| -> Result<bool, StudyError> {
            let observe = Observe::default();
            let response = self.respond(block, record, pga_g, &observe)?;
            Ok(response.outcome != Outcome::NoUplift)
        };
        Ok(moves(threshold)? || !moves(threshold * (1.0 + 1e-9))?)
    }

    /// History of theta/alpha every `interval_s`, and the peak (infinite
    /// when overturned).
    ///
    /// # Errors
    /// [`StudyError`] where the record cannot be scaled so.
    pub fn history(
        &self,
        block: Block,
        record: &NormalisedRecord,
        im: f64,
        interval_s: f64,
    ) -> Result<(Vec<f64>, f64), StudyError> {
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

/// The standing points above the onset (1, 0), and the first overturning:
/// the level of the grid in arm A, the bracket's upper end in B and C.
fn response_curve(
    run: &IdaCurve,
    arm: Arm,
) -> Result<ResponseCurve, StudyError> {
    let standing = run.standing().map(|point| (point.im, point.edp()));
    let vertices: Vec<(f64, f64)> =
        std::iter::once((1.0, 0.0)).chain(standing).collect();
    let overturning = run.overturning.map(|first| match arm {
        Arm::A => first.scanned_im,
        Arm::B | Arm::C => first.im(),
    });
    Ok(ResponseCurve::try_new(&vertices, overturning)?)
}

#[cfg(test)]
mod tests;
