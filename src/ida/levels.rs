//! Levels of a curve: their intensities, their scenes, what a response
//! makes of them.

use crate::block::Block;
use crate::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use crate::ida::resolution::{Resolution, WORTH_ASSESSING};
use crate::ida::{Adjust, Analysis, Grid, IdaError, IdaPoint, Resurrections};
use crate::integrator::{
    self, Certify, DOUBTFUL, Forces, Model, Observe, Order, Outcome, Response,
    Scene, SceneError, Solver, WorkLimit, certify, uplift_threshold,
};
use crate::number::dispatch::Isa;

/// One record under one analysis.
#[derive(Clone, Copy)]
pub(super) struct ImLevels<'a> {
    pub record: &'a NormalisedRecord,
    pub analysis: &'a Analysis,
    threshold: f64,
}

/// An analysis about to be made.
#[derive(Clone, Copy)]
pub(super) struct ImLevel<'a> {
    pub im: f64,
    /// PGA applied, multiples of gravity.
    pga_g: f64,
    pub scene: Scene<'a>,
    pub work_limit: WorkLimit,
    order: Option<Order>,
    certify: bool,
    record: &'a str,
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
                let parts = (1.0 / step_g).round();
                if (parts * step_g - 1.0).abs() < 1e-12 {
                    k / parts
                } else {
                    k * step_g
                }
            }
            Grid::Im { .. } => self.im(level) * self.threshold,
        }
    }

    /// Intensity of a level.
    pub fn im(&self, level: u64) -> f64 {
        match self.analysis.grid {
            Grid::Pga { .. } => self.pga_g(level) / self.threshold,
            Grid::Im { step } => {
                let parts = (1.0 / step).round();
                if (parts * step - 1.0).abs() < 1e-12 {
                    1.0 + level as f64 / parts
                } else {
                    (level as f64).mul_add(step, 1.0)
                }
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
        Ok(ImLevel {
            im,
            pga_g: amplitude,
            scene,
            work_limit: analysis.work_limit,
            order: analysis.order,
            certify: analysis.certify && analysis.order.is_none(),
            record: self.record.name(),
        })
    }
}

impl ImLevel<'_> {
    /// The analysis, made alone.
    pub fn run(&self, isa: Isa) -> Result<IdaPoint, IdaError> {
        let Self { scene, work_limit, order, .. } = *self;
        let observe = Observe { work_limit, ..Observe::default() };
        let solver = Solver { order, isa, peak_only: true };
        let response = solver.respond(&scene, &observe);
        self.point(&response.map_err(|error| self.refused(error))?)
    }

    /// What the motion asks of the pivot, by a whole run at a free order.
    pub fn forces(&self) -> Result<Forces, IdaError> {
        let Self { scene, work_limit, .. } = *self;
        let observe =
            Observe { forces: true, work_limit, ..Observe::default() };
        let response = Solver::default().respond_once(&scene, &observe);
        let response = response.map_err(|error| self.refused(error))?;
        Ok(response.forces.unwrap_or_else(|| Forces::at_rest(&scene)))
    }

    /// Which level a scene that is refused belongs to.
    fn refused(&self, error: SceneError) -> IdaError {
        match error {
            SceneError::Work { .. } | SceneError::NotANumber { .. } => {
                IdaError::Work {
                    record: self.record.to_owned(),
                    im: self.im,
                    source: error,
                }
            }
            other => other.into(),
        }
    }

    /// The point that the level's response makes.
    pub fn point(&self, response: &Response) -> Result<IdaPoint, IdaError> {
        let most = if self.certify { WORTH_ASSESSING } else { DOUBTFUL };
        // Not a number is doubtful.
        let clear = response.doubt.is_some_and(|doubt| doubt < most);
        let (outcome, fate_margin) = (response.outcome, response.fate_margin);
        if clear || !self.certify {
            return Ok(self.made(
                outcome,
                fate_margin,
                Resolution::roughly(clear),
            ));
        }
        let work_limit = self.work_limit;
        let ask = Certify { work_limit, ..Certify::default() };
        let fate =
            certify(&self.scene, &ask).map_err(|error| self.refused(error))?;
        let resolution = Resolution {
            by: Some(fate.by),
            resolved: fate.resolved,
            wrong_in_double: fate.wrong_in_double(),
            for_inputs: fate.resolved_for_inputs,
        };
        Ok(self.made(fate.outcome, fate.margin, resolution))
    }

    fn made(
        &self,
        outcome: Outcome,
        fate_margin: f64,
        resolution: Resolution,
    ) -> IdaPoint {
        IdaPoint {
            im: self.im,
            pga_g: self.pga_g,
            slenderness_rad: self.scene.block.slenderness_rad(),
            outcome,
            fate_margin,
            resolution,
        }
    }
}

/// Levels of a curve up to its highest intensity, at most.
const MOST_LEVELS: f64 = 1e7;

fn check(
    record: &NormalisedRecord,
    analysis: &Analysis,
) -> Result<(), IdaError> {
    let positive = |what, found: f64| {
        if found > 0.0 && found.is_finite() {
            Ok(())
        } else {
            Err(IdaError::NotPositive { what, found })
        }
    };
    match analysis.grid {
        Grid::Pga { step_g } => positive("step in g", step_g)?,
        Grid::Im { step } => positive("step in IM", step)?,
    }
    positive("highest IM", analysis.highest_im)?;
    let step_im = match analysis.grid {
        Grid::Pga { step_g } => {
            step_g / uplift_threshold(&analysis.block, analysis.model)
        }
        Grid::Im { step } => step,
    };
    let levels = analysis.highest_im / step_im;
    if !(levels <= MOST_LEVELS) {
        return Err(IdaError::Levels { found: levels, most: MOST_LEVELS });
    }
    if let Some(tolerance) = analysis.refine {
        positive("refinement", tolerance)?;
    }
    match analysis.resurrections {
        Some(Resurrections::Multiple(x)) => positive("resurrections", x)?,
        Some(Resurrections::To(x)) => positive("resurrections", x)?,
        None => {}
    }
    if record.pga_g() > 0.0 {
        Ok(())
    } else {
        Err(IdaError::Silent { record: record.name().to_owned() })
    }
}
