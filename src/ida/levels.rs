//! Levels of a curve: their intensities, their scenes, and the points of their
//! responses.

use crate::block::Block;
use crate::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use crate::ida::resolution::{Resolution, WORTH_ASSESSING};
use crate::ida::{Adjust, Analysis, Grid, IdaError, IdaPoint, Resurrections};
use crate::integrator::{
    self, Certify, DOUBTFUL, Forces, Model, Observe, Outcome, Response, Scene,
    SceneError, Solver, uplift_threshold,
};
use crate::number::dispatch::Isa;

/// One record under one analysis.
#[derive(Clone, Copy)]
pub(super) struct ImLevels<'a> {
    pub record: &'a NormalisedRecord,
    pub analysis: &'a Analysis,
    threshold: f64,
}

/// One level of an analysis.
#[derive(Clone, Copy)]
pub(super) struct ImLevel<'a> {
    pub of: ImLevels<'a>,
    im: f64,
    /// PGA applied, multiples of gravity.
    pga_g: f64,
    pub scene: Scene<'a>,
}

impl<'a> ImLevels<'a> {
    pub fn new(
        record: &'a NormalisedRecord,
        analysis: &'a Analysis,
    ) -> Result<Self, IdaError> {
        check(record, analysis)?;
        let threshold = uplift_threshold(&analysis.block, analysis.model);
        Ok(Self { record, analysis, threshold })
    }

    /// PGA of a level in multiples of gravity.
    fn pga_g(&self, level: u64) -> f64 {
        let k = level as f64;
        match self.analysis.grid {
            Grid::Pga { step_g } => {
                // k/100 is the nearest double to the level, k 0.01 is not.
                parts_of(step_g).map_or(k * step_g, |parts| k / parts)
            }
            Grid::Im { .. } => self.im(level) * self.threshold,
        }
    }

    /// Intensity of a level.
    pub fn im(&self, level: u64) -> f64 {
        match self.analysis.grid {
            Grid::Pga { .. } => self.pga_g(level) / self.threshold,
            Grid::Im { step } => {
                let k = level as f64;
                let by_step = || k.mul_add(step, 1.0);
                parts_of(step).map_or_else(by_step, |parts| 1.0 + k / parts)
            }
        }
    }

    /// Onset of rocking: the uplift threshold itself, IM = 1, at which no
    /// block has moved.
    pub fn onset(&self) -> IdaPoint {
        let (slenderness_rad, pga_g) = self.reached(1.0, self.threshold);
        IdaPoint {
            im: 1.0,
            pga_g,
            slenderness_rad,
            outcome: Outcome::NoUplift,
            fate_margin: 0.0,
            resolution: Resolution::roughly(true),
        }
    }

    /// Slenderness and PGA of the analysis at an intensity, which is `pga_g`
    /// for the block of the grid.
    fn reached(&self, im: f64, pga_g: f64) -> (f64, f64) {
        let analysis = self.analysis;
        match analysis.adjust {
            Adjust::RecordScaling => (analysis.block.slenderness_rad(), pga_g),
            Adjust::SlendernessAdjustment => {
                let own = self.record.pga_g();
                let slenderness_rad = match analysis.model {
                    Model::Nonlinear => libm::atan(own / im),
                    Model::Linearized => own / im,
                };
                (slenderness_rad, own)
            }
        }
    }

    /// First level above the uplift threshold.
    pub fn first(&self) -> u64 {
        match self.analysis.grid {
            Grid::Im { .. } => 1,
            Grid::Pga { step_g } => {
                let mut level = (self.threshold / step_g) as u64;
                while !(self.pga_g(level) > self.threshold) {
                    level += 1;
                }
                level
            }
        }
    }

    /// The analysis of a level.
    pub fn level(&self, level: u64) -> Result<ImLevel<'a>, IdaError> {
        self.scaled(self.im(level), self.pga_g(level))
    }

    /// The analysis at an intensity.
    pub fn at(&self, im: f64) -> Result<ImLevel<'a>, IdaError> {
        self.scaled(im, im * self.threshold)
    }

    /// The analysis at an intensity, which is `pga_g` for the block of the
    /// grid.
    fn scaled(&self, im: f64, pga_g: f64) -> Result<ImLevel<'a>, IdaError> {
        let analysis = self.analysis;
        let (slenderness_rad, amplitude) = self.reached(im, pga_g);
        let p = analysis.block.frequency_rad_s();
        let block = Block::try_new(slenderness_rad, p).map_err(|source| {
            let record = self.record.name().to_owned();
            IdaError::Slenderness { record, im, source }
        })?;
        let record = ScaledRecord::to_pga(self.record, amplitude);
        let scene = Scene {
            block,
            restitution: analysis.restitution,
            model: analysis.model,
            overturning: analysis.overturning,
            excitation: Excitation::Record(record),
            initial_ratio: 0.0,
        };
        integrator::check(&scene, &Observe::default())?;
        Ok(ImLevel { of: *self, im, pga_g: amplitude, scene })
    }
}

impl ImLevel<'_> {
    /// Runs the level alone.
    pub fn run(&self, isa: Isa) -> Result<IdaPoint, IdaError> {
        let Analysis { work_limit, order, extent, .. } = *self.of.analysis;
        let observe = Observe { work_limit, ..Observe::default() };
        let solver = Solver { order, isa, extent };
        let response = solver.respond(&self.scene, &observe);
        self.point(&response.map_err(|error| self.refused(error))?)
    }

    /// Friction and normal force that the motion needs at the pivot, by a
    /// whole run at a free order.
    pub fn forces(&self) -> Result<Forces, IdaError> {
        let (scene, work_limit) = (&self.scene, self.of.analysis.work_limit);
        let observe =
            Observe { forces: true, work_limit, ..Observe::default() };
        let response = Solver::default().respond_once(scene, &observe);
        let response = response.map_err(|error| self.refused(error))?;
        Ok(response.forces.unwrap_or_else(|| Forces::at_rest(scene)))
    }

    /// Adds record and intensity to an error of the run.
    fn refused(&self, source: SceneError) -> IdaError {
        match source {
            SceneError::Work { .. } | SceneError::NotANumber { .. } => {
                let record = self.of.record.name().to_owned();
                IdaError::Work { record, im: self.im, source }
            }
            other => other.into(),
        }
    }

    /// True if the curve takes the response as it is.
    pub fn is_clear(&self, response: &Response) -> bool {
        !self.is_certified() || is_below(response, WORTH_ASSESSING)
    }

    fn is_certified(&self) -> bool {
        self.of.analysis.certify && self.of.analysis.order.is_none()
    }

    /// The point of the level, from its response.
    pub fn point(&self, response: &Response) -> Result<IdaPoint, IdaError> {
        let (outcome, fate_margin, resolution) = if self.is_clear(response) {
            let is_resolved = is_below(response, DOUBTFUL);
            let resolution = Resolution::roughly(is_resolved);
            (response.outcome, response.fate_margin, resolution)
        } else {
            let Analysis { work_limit, extent, .. } = *self.of.analysis;
            let ask = Certify { work_limit, extent, ..Certify::default() };
            let fate = integrator::certify(&self.scene, &ask);
            let fate = fate.map_err(|error| self.refused(error))?;
            let resolution = Resolution {
                by: Some(fate.by),
                resolved: fate.resolved,
                wrong_in_double: fate.wrong_in_double(),
                for_inputs: fate.resolved_for_inputs,
            };
            (fate.outcome, fate.margin, resolution)
        };
        Ok(IdaPoint {
            im: self.im,
            pga_g: self.pga_g,
            slenderness_rad: self.scene.block.slenderness_rad(),
            outcome,
            fate_margin,
            resolution,
        })
    }
}

/// True if the rough estimate of a run is below a limit. NaN is not.
fn is_below(response: &Response, limit: f64) -> bool {
    response.doubt.is_some_and(|doubt| doubt < limit)
}

/// Number of steps in 1, if it is a whole number.
fn parts_of(step: f64) -> Option<f64> {
    let parts = (1.0 / step).round();
    ((parts * step - 1.0).abs() < 1e-12).then_some(parts)
}

/// Most levels of a curve up to its highest intensity.
const MOST_LEVELS: f64 = 1e7;

fn check(
    record: &NormalisedRecord,
    analysis: &Analysis,
) -> Result<(), IdaError> {
    match analysis.grid {
        Grid::Pga { step_g } => positive("step in g", step_g)?,
        Grid::Im { step } => positive("step in IM", step)?,
    }
    positive("highest IM", analysis.highest_im)?;
    let threshold = uplift_threshold(&analysis.block, analysis.model);
    let levels = analysis.highest_im / analysis.grid.step_im(threshold);
    if !(levels <= MOST_LEVELS) {
        return Err(IdaError::Levels { found: levels, most: MOST_LEVELS });
    }
    if let Some(tolerance) = analysis.refine {
        positive("refinement", tolerance)?;
    }
    if let Some(Resurrections::Multiple(x) | Resurrections::To(x)) =
        analysis.resurrections
    {
        positive("resurrections", x)?;
    }
    if record.pga_g() > 0.0 {
        Ok(())
    } else {
        Err(IdaError::Silent { record: record.name().to_owned() })
    }
}

/// Refuses a number that is not positive and finite.
pub(super) fn positive(
    what: &'static str,
    found: f64,
) -> Result<(), IdaError> {
    if found > 0.0 && found.is_finite() {
        Ok(())
    } else {
        Err(IdaError::NotPositive { what, found })
    }
}
