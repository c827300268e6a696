//! Peaks of many blocks under many excitations at many levels.
//!
//! A record beyond the uplift threshold runs in the lanes of the core, as the
//! only level of an IDA curve. Pulses, factors and levels close to the
//! threshold run one by one. The bits are the same.

use std::sync::OnceLock;

use numpy::PyArray3;
use numpy::ndarray::Array3;
use pyo3::prelude::*;
use rayon::prelude::*;
use rocking::Scene;
use rocking::block::{Block, Restitution};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, Batch, Grid, IdaCurve, for_each_curve};
use rocking::integrator::{
    Extent, Model, Observe, Overturning, Solver, WorkLimit, uplift_threshold,
};
use rocking::stop;

use crate::given::{
    ExcitationInput, Physics, RecordOrPulse, block_of, choose,
};
use crate::mechanics::{BY, By, NormalisedMotion, Scaled};
use crate::work::{self, Done, refuse};

/// Nearer to the uplift threshold (IM = 1), a grid with this step would have
/// more levels than the core allows.
const LEAST_IM: f64 = 1.0 + 1e-6;

/// Most curves in the lanes at once, so that their list stays small.
const MOST_CURVES: usize = 1 << 17;

/// Peaks |theta|/alpha by block, excitation and level; infinite if it
/// overturned.
#[pyfunction]
pub fn peak<'py>(
    py: Python<'py>,
    blocks: Vec<(f64, f64)>,
    excitations: Vec<ExcitationInput<'py>>,
    levels: Vec<f64>,
    by: &str,
    physics: Physics,
    threads: Option<usize>,
    progress: Option<Py<PyAny>>,
) -> PyResult<Bound<'py, PyArray3<f64>>> {
    let grounds = excitations.into_iter().map(RecordOrPulse::of);
    let grounds = grounds.collect::<PyResult<Vec<_>>>()?;
    let blocks = blocks.into_iter().map(|block| {
        let block = block_of(block)?;
        Ok((block, physics.restitution(&block)?))
    });
    let asked = PeakTask {
        blocks: blocks.collect::<PyResult<_>>()?,
        levels,
        by: choose("by", by, &BY)?,
        model: physics.model()?,
        overturning: physics.overturning()?,
    };
    let shape = (asked.blocks.len(), grounds.len(), asked.levels.len());
    let total = shape.0 * shape.1 * shape.2;
    let peaks = work::run(py, threads, progress, total, |done| {
        let motion = |ground| {
            stop::point();
            NormalisedMotion::of(ground)
        };
        let motions: Vec<_> =
            grounds.par_iter().panic_fuse().map(motion).collect();
        asked.peaks(&motions, done)
    })?
    .map_err(refuse)?;
    Array3::from_shape_vec(shape, peaks)
        .map(|table| PyArray3::from_owned_array(py, table))
        .map_err(refuse)
}

/// The task, without the excitations.
struct PeakTask {
    blocks: Vec<(Block, Restitution)>,
    levels: Vec<f64>,
    by: By,
    model: Model,
    overturning: Overturning,
}

impl PeakTask {
    fn peaks(
        &self,
        motions: &[NormalisedMotion<'_>],
        done: &Done,
    ) -> Result<Vec<f64>, String> {
        let (wide, high) = (motions.len(), self.levels.len());
        let pairs = self.blocks.len() * high;
        let cells: Vec<OnceLock<Result<f64, String>>> =
            (0..pairs * wide).map(|_| OnceLock::new()).collect();
        let singles: Vec<Option<Analysis>> =
            (0..pairs).map(|k| self.single(k / high, k % high)).collect();
        (0..cells.len()).into_par_iter().panic_fuse().try_for_each(
            |index| {
                let (row, level) = (index / high, index % high);
                let (block, motion) = (row / wide, &motions[row % wide]);
                let is_record = matches!(motion, NormalisedMotion::Record(..));
                if is_record && singles[block * high + level].is_some() {
                    return Ok::<(), String>(());
                }
                done.tick();
                let peak = self.alone(block, motion, level)?;
                // Each cell is filled once.
                let _ = cells[index].set(Ok(peak));
                Ok(())
            },
        )?;
        let (rows, records): (Vec<usize>, Vec<NormalisedRecord>) = motions
            .iter()
            .enumerate()
            .filter_map(|(row, motion)| match motion {
                NormalisedMotion::Record(_, unit) => Some((row, unit.clone())),
                NormalisedMotion::Pulse(_) => None,
            })
            .unzip();
        let batch = Batch { progress: &|| done.tick(), ..Batch::default() };
        let singles = singles.into_iter().enumerate();
        let singles: Vec<(usize, Analysis)> =
            singles.filter_map(|(pair, one)| Some((pair, one?))).collect();
        for some in singles.chunks((MOST_CURVES / records.len().max(1)).max(1))
        {
            let analyses: Vec<_> =
                some.iter().map(|single| single.1).collect();
            for_each_curve(&records, &analyses, &batch, &|a, r, curve| {
                let (block, level) = (some[a].0 / high, some[a].0 % high);
                let motion = &motions[rows[r]];
                let peak = self.peak_of(&curve, level);
                let peak =
                    peak.map_or_else(|| self.alone(block, motion, level), Ok);
                let index = (block * wide + rows[r]) * high + level;
                let _ = cells[index].set(peak);
            })
            .map_err(|e| e.to_string())?;
        }
        let made = cells.into_iter().map(|cell| {
            cell.into_inner().unwrap_or_else(|| Err("not made".to_owned()))
        });
        made.collect()
    }

    /// The analysis with this single level; `None` if it does not run in
    /// lanes.
    fn single(&self, block: usize, level: usize) -> Option<Analysis> {
        let (body, restitution) = self.blocks[block];
        let asked = self.levels[level];
        let (grid, highest_im) = match self.by {
            By::Im => (Grid::Im { step: asked - 1.0 }, asked),
            By::PgaG => {
                let threshold = uplift_threshold(&body, self.model);
                (Grid::Pga { step_g: asked }, asked / threshold)
            }
            By::Scale => return None,
        };
        let runs = highest_im > LEAST_IM && highest_im.is_finite();
        runs.then_some(Analysis {
            model: self.model,
            overturning: self.overturning,
            grid,
            highest_im,
            ..Analysis::paper(body, restitution)
        })
    }

    /// The peak of a curve at its level; none if rounding made another level
    /// of it.
    fn peak_of(&self, curve: &IdaCurve, level: usize) -> Option<f64> {
        let [point] = curve.points[..] else { return None };
        let made = match self.by {
            By::Im => point.im,
            By::PgaG | By::Scale => point.pga_g,
        };
        (made == self.levels[level]).then(|| point.edp())
    }

    fn alone(
        &self,
        block: usize,
        motion: &NormalisedMotion<'_>,
        level: usize,
    ) -> Result<f64, String> {
        let (block, restitution) = self.blocks[block];
        let threshold = uplift_threshold(&block, self.model);
        let level = self.levels[level];
        let scaled = Scaled::of(motion, self.by, level, threshold)?;
        let scene = Scene {
            model: self.model,
            overturning: self.overturning,
            ..Scene::new(block, restitution, scaled.excitation())
        };
        let solver = Solver { extent: Extent::Peak, ..Solver::default() };
        let observe =
            Observe { work_limit: WorkLimit::IDA, ..Observe::default() };
        let response = solver.respond(&scene, &observe);
        Ok(response.map_err(|e| e.to_string())?.outcome.edp())
    }
}
