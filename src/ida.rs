//! Incremental dynamic analysis: one block, one record, rising intensity.
//!
//! Levels rise until the first overturning, with no resurrection; the first
//! overturning bracket may be bisected. The intensity of a curve is
//! PGA/(g tan alpha) (g alpha for Eq. 2); p PGV/(g tan alpha) is that times
//! p PGV/PGA.

#[cfg(feature = "lanes")]
mod batch;
mod climb;
mod curve;
mod levels;
mod resolution;

use thiserror::Error;

use crate::block::{Block, BlockError, Restitution};
use crate::excitation::NormalisedRecord;
use crate::integrator::{
    Extent, Forces, Model, Order, Overturning, SceneError, WorkLimit,
};
use crate::names::named;
use crate::number::dispatch::Isa;
#[cfg(feature = "lanes")]
pub use batch::{Batch, curves, for_each_curve};
use climb::Climb;
pub use curve::{BracketEnd, FirstOverturning, IdaCurve, IdaPoint};
use levels::{ImLevels, positive};
pub use resolution::{Resolution, ResolutionCounts};

/// Intensities at which a curve is sampled.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Grid {
    /// Peak ground accelerations k `step_g`, k = 1, 2, ... (multiples of
    /// gravity); the paper's step is 0.01.
    Pga {
        /// Step in multiples of gravity.
        step_g: f64,
    },
    /// Dimensionless intensities 1 + k `step`, the same for every block.
    Im {
        /// Step in PGA/(g tan alpha).
        step: f64,
    },
}

impl Grid {
    /// Step in IM of a block with an uplift threshold, in multiples of
    /// gravity.
    fn step_im(self, threshold: f64) -> f64 {
        match self {
            Self::Pga { step_g } => step_g / threshold,
            Self::Im { step } => step,
        }
    }
}

named! {
    /// Quantity adjusted to reach the intensity of a level.
    pub enum Adjust: "adjustment" {
        /// The record is scaled; the block stays.
        RecordScaling = "record-scaling",
        /// The record stays as recorded; the slenderness is adjusted to
        /// alpha = atan(PGA/(g IM)) (PGA/(g IM) for Eq. 2) at equal p, and the
        /// rotation is normalised by the adjusted alpha.
        SlendernessAdjustment = "slenderness-adjustment",
    }
}

/// One kind of analysis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Analysis {
    /// The block; under slenderness adjustment, the block whose grid of
    /// levels is used.
    pub block: Block,
    /// Coefficient of restitution.
    pub restitution: Restitution,
    /// Equation of motion.
    pub model: Model,
    /// Overturning criterion.
    pub overturning: Overturning,
    /// Levels.
    pub grid: Grid,
    /// Quantity adjusted to reach a level.
    pub adjust: Adjust,
    /// Width in IM to which the first overturning bracket is bisected.
    pub refine: Option<f64>,
    /// Highest level (IM) if the block does not overturn.
    pub highest_im: f64,
    /// End of the levels above the first overturning; `None`: no such levels.
    pub resurrections: Option<Resurrections>,
    /// Fixed order of Eq. 1, whatever the truncation error. `None`: the order
    /// that each step needs for double precision. The estimate that flags
    /// analyses includes the truncation error of a fixed order.
    pub order: Option<Order>,
    /// True if analyses that double precision cannot resolve run again in the
    /// arithmetic that resolves them (see
    /// [`certify`](crate::integrator::certify)); the curve continues from that
    /// result. Otherwise they are flagged. Ignored at a fixed order.
    pub certify: bool,
    /// How much of each run is needed: outcome and peak, or only the outcome
    /// if the curve is used only for its first overturning.
    pub extent: Extent,
    /// Work limit of a level.
    pub work_limit: WorkLimit,
}

/// Upper end of the search for resurrections.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Resurrections {
    /// To a multiple of the first overturning level.
    Multiple(f64),
    /// To an intensity.
    To(f64),
}

/// Default highest level (IM) of curves that never overturn.
pub const HIGHEST_IM: f64 = 100.0;

/// Default width in IM to which the first overturning bracket is bisected.
pub const REFINEMENT: f64 = 1e-4;

impl Analysis {
    /// The paper's analysis: Eq. 1, overturning at alpha, 0.01 g levels, no
    /// refinement, no resurrections.
    pub fn paper(block: Block, restitution: Restitution) -> Self {
        Self {
            block,
            restitution,
            model: Model::Nonlinear,
            overturning: Overturning::Alpha,
            grid: Grid::Pga { step_g: 0.01 },
            adjust: Adjust::RecordScaling,
            refine: None,
            highest_im: HIGHEST_IM,
            resurrections: None,
            order: None,
            certify: false,
            extent: Extent::Peak,
            work_limit: WorkLimit::IDA,
        }
    }
}

/// Why an analysis was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum IdaError {
    /// Steps, tolerances and ends must be positive and finite.
    #[error("{what} {found}: expected a positive number")]
    NotPositive {
        /// The quantity.
        what: &'static str,
        /// The given number.
        found: f64,
    },
    /// Steps so small that a curve would have no end.
    #[error(
        "{found:.1e} levels up to the highest IM: expected at most {most:.0e}, by a larger step"
    )]
    Levels {
        /// Highest IM over step.
        found: f64,
        /// The limit.
        most: f64,
    },
    /// Records and their levels differ in number.
    #[error(
        "levels of {levels} records: expected those of the {records} records"
    )]
    Unmatched {
        /// Number of records.
        records: usize,
        /// Number of records whose levels are given.
        levels: usize,
    },
    /// A record of zeros has no intensity.
    #[error("record {record}: its peak ground acceleration is zero")]
    Silent {
        /// The record.
        record: String,
    },
    /// An adjusted slenderness is no slenderness.
    #[error("record {record} at IM {im}: {source}")]
    Slenderness {
        /// The record.
        record: String,
        /// The level.
        im: f64,
        /// The error of the slenderness.
        #[source]
        source: BlockError,
    },
    /// The run of a level passed its work limit or ended in NaN.
    #[error("record {record} at IM {im}: {source}")]
    Work {
        /// The record.
        record: String,
        /// The level.
        im: f64,
        /// Why it was refused.
        #[source]
        source: SceneError,
    },
    /// The scene could not be integrated.
    #[error(transparent)]
    Scene(#[from] SceneError),
}

/// IDA of one record.
///
/// # Errors
/// [`IdaError`] for steps that are not positive, a record of zeros, or a
/// level whose run passes the limit of its work.
///
/// ```
/// use rocking::block::{Block, Restitution};
/// use rocking::excitation::NormalisedRecord;
/// use rocking::ida::{Analysis, curve};
/// use rocking::accelerogram::Accelerogram;
/// // One triangular lobe of half a second, 0.2 g high.
/// let samples = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
/// let record = Accelerogram::try_new("lobe", 0.01, samples.collect())?;
/// let block = Block::try_new(0.1, 3.0)?;
/// let analysis = Analysis::paper(block, Restitution::constant(0.92)?);
/// let curve = curve(&NormalisedRecord::new(&record), &analysis)?;
/// // The first level that moves the block is 0.11 g > g tan(0.1).
/// assert_eq!(curve.points[0].pga_g, 0.11);
/// assert!(curve.overturning.is_some());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn curve(
    record: &NormalisedRecord,
    analysis: &Analysis,
) -> Result<IdaCurve, IdaError> {
    curve_at(record, analysis, Isa::best())
}

/// [`curve()`] at an instruction-set level.
fn curve_at(
    record: &NormalisedRecord,
    analysis: &Analysis,
    isa: Isa,
) -> Result<IdaCurve, IdaError> {
    let mut climb = Climb::start(record, analysis)?;
    while let Some((aim, level)) = climb.next(false)? {
        climb.accept(aim, level.run(isa)?);
    }
    Ok(climb.finish())
}

/// Engineering demand parameter at one intensity, whatever happens below it:
/// peak |theta|/alpha, infinite when overturned.
///
/// Under the no-resurrection rule a stripe is infinite from the first
/// overturning on. Only the curve shows where that is.
///
/// # Errors
/// As [`curve()`].
pub fn demand_at(
    record: &NormalisedRecord,
    analysis: &Analysis,
    im: f64,
) -> Result<IdaPoint, IdaError> {
    let levels = ImLevels::new(record, analysis)?;
    positive("intensity", im)?;
    levels.at(im)?.run(Isa::best())
}

/// Friction and normal force that the pivot needs at one intensity.
///
/// It integrates the whole record, at a free order; [`demand_at`] gives the
/// outcome.
///
/// # Errors
/// As [`demand_at`].
///
/// ```
/// use rocking::{Block, Restitution};
/// use rocking::excitation::NormalisedRecord;
/// use rocking::ida::{Analysis, forces_at};
/// use rocking::accelerogram::Accelerogram;
/// let samples = (0..=50).map(|k| 0.2 - 0.008 * f64::from((k - 25_i32).abs()));
/// let record = Accelerogram::try_new("lobe", 0.01, samples.collect())?;
/// let record = NormalisedRecord::new(&record);
/// let block = Block::try_new(0.1, 3.0)?;
/// let analysis = Analysis::paper(block, Restitution::constant(0.92)?);
/// // Uplift takes the friction tan(alpha) at least.
/// let forces = forces_at(&record, &analysis, 1.1)?;
/// assert!(forces.friction >= libm::tan(0.1) && forces.friction < 0.12);
/// assert!(forces.least_normal_over_weight <= 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn forces_at(
    record: &NormalisedRecord,
    analysis: &Analysis,
    im: f64,
) -> Result<Forces, IdaError> {
    positive("intensity", im)?;
    ImLevels::new(record, analysis)?.at(im)?.forces()
}

#[cfg(test)]
mod tests;
