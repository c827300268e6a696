//! The analyses of the study: chains of rising intensity, stripes,
//! histories.

use rocking::block::{Block, Restitution};
use rocking::capacity::ResponseCurve;
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
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

/// Highest intensity tried: a chain that stands there is censored.
const HIGHEST_IM: f64 = 100.0;

/// An intensity and the peak ground acceleration that makes it.
#[derive(Clone, Copy, Debug)]
struct Level {
    im: f64,
    pga_g: f64,
}

/// The rising levels of an arm above the onset of rocking, for a block of
/// uplift threshold `threshold`: whole hundredths of g (A and B) or
/// intensities 1 + 0.02 k (C).
fn levels(arm: Arm, threshold: f64) -> impl Iterator<Item = Level> {
    let first = match arm {
        Arm::A | Arm::B => (100.0 * threshold).floor() as u32,
        Arm::C => 1,
    };
    (first..)
        .map(move |k| match arm {
            Arm::A | Arm::B => {
                let pga_g = f64::from(k) / 100.0;
                Level { im: pga_g / threshold, pga_g }
            }
            Arm::C => {
                let im = f64::from(50 + k) / 50.0;
                Level { im, pga_g: im * threshold }
            }
        })
        .skip_while(|level| !(level.im > 1.0))
        .take_while(|level| level.im <= HIGHEST_IM)
}

/// Scans rising levels to the first overturning; the onset is the first
/// vertex.
fn scan(
    levels: impl Iterator<Item = Level>,
    run: impl Fn(Level) -> Result<f64, StudyError>,
) -> Result<ResponseCurve, StudyError> {
    let mut vertices = vec![(1.0, 0.0)];
    let mut overturning = None;
    for level in levels {
        let demand = run(level)?;
        if !demand.is_finite() {
            overturning = Some(level.im);
            break;
        }
        vertices.push((level.im, demand));
    }
    Ok(ResponseCurve::try_new(&vertices, overturning)?)
}

/// Bisects the bracket of the first overturning to the width `tolerance`;
/// the curve then overturns at the bracket's upper end. The vertices stay.
fn refine(
    curve: &ResponseCurve,
    tolerance: f64,
    run: impl Fn(f64) -> Result<f64, StudyError>,
) -> Result<ResponseCurve, StudyError> {
    let Some(mut upper) = curve.overturning_im() else {
        return Ok(curve.clone());
    };
    let mut lower = curve.last_im();
    while upper - lower > tolerance {
        let middle = 0.5 * (lower + upper);
        if run(middle)?.is_finite() {
            lower = middle;
        } else {
            upper = middle;
        }
    }
    let vertices: Vec<(f64, f64)> = curve.vertices().collect();
    Ok(ResponseCurve::try_new(&vertices, Some(upper))?)
}

impl Setup {
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

    /// Demand of `block` at dimensionless intensity `im`.
    ///
    /// # Errors
    /// [`StudyError`] where the record cannot be scaled so.
    pub fn demand(
        &self,
        block: Block,
        record: &NormalisedRecord,
        im: f64,
    ) -> Result<f64, StudyError> {
        let pga_g = im * uplift_threshold(&block, Model::Nonlinear);
        self.demand_at(block, record, pga_g)
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

    fn demand_at(
        &self,
        block: Block,
        record: &NormalisedRecord,
        pga_g: f64,
    ) -> Result<f64, StudyError> {
        let observe = Observe::default();
        Ok(self.respond(block, record, pga_g, &observe)?.outcome.edp())
    }

    /// The curves of one chain in the three arms; arm B's scan is arm A's.
    ///
    /// # Errors
    /// [`StudyError`] where the record cannot be scaled.
    pub fn chain(
        &self,
        block: Block,
        record: &NormalisedRecord,
        arms: &[Arm],
    ) -> Result<Vec<ResponseCurve>, StudyError> {
        let threshold = uplift_threshold(&block, Model::Nonlinear);
        let at = |l: Level| self.demand_at(block, record, l.pga_g);
        let between = |im| self.demand(block, record, im);
        let mut coarse = None;
        let mut out = Vec::with_capacity(arms.len());
        for arm in arms {
            let curve = match (arm, &coarse) {
                (Arm::B, Some(curve)) => ResponseCurve::clone(curve),
                _ => scan(levels(*arm, threshold), at)?,
            };
            if *arm == Arm::A {
                coarse = Some(curve.clone());
            }
            out.push(match arm {
                Arm::A => curve,
                Arm::B | Arm::C => refine(&curve, self.tolerance, between)?,
            });
        }
        Ok(out)
    }

    /// Demand of the unscaled record on the block of frequency parameter
    /// `p_rad_s` whose slenderness makes the intensity `im`, over that
    /// slenderness; that angle is second.
    ///
    /// # Errors
    /// [`StudyError`] where there is no such block.
    pub fn demand_adjusted(
        &self,
        p_rad_s: f64,
        record: &NormalisedRecord,
        im: f64,
    ) -> Result<(f64, f64), StudyError> {
        let pga_g = record.pga_g();
        let slenderness_rad = libm::atan(pga_g / im);
        let block = Block::try_new(slenderness_rad, p_rad_s)?;
        Ok((self.demand_at(block, record, pga_g)?, slenderness_rad))
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
        let threshold = uplift_threshold(&reference, Model::Nonlinear);
        let p = reference.frequency_rad_s();
        let at = |im| Ok(self.demand_adjusted(p, record, im)?.0);
        let curve = scan(levels(arm, threshold), |l| at(l.im))?;
        match arm {
            Arm::A => Ok(curve),
            Arm::B | Arm::C => refine(&curve, self.tolerance, at),
        }
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

#[cfg(test)]
mod tests;
