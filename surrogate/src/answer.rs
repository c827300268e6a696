//! A block's fragility by the surface, with its errors.

use rocking::block::Block;
use rocking::integrator::{self, uplift_threshold};
use rocking::intensity::Intensity;
use serde::{Serialize, Serializer};

use super::{
    Errors, RESTITUTION, Recorded, SHIFT, Sampling, Surrogate, SurrogateError,
    ToRecorded,
};
use rocking_synthesis::SuiteKind;

/// Where every fragility of the surface comes from, in words.
pub const ORIGIN: &str = "overturning under the embedded suites, by a fitted \
                          surface, without an analysis";

/// Overturning fragilities of one block by the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SurfaceFragility {
    /// [`ORIGIN`].
    pub origin: &'static str,
    /// Unit of the shift and the medians.
    pub im_unit: &'static str,
    /// Slenderness angle.
    pub alpha_rad: f64,
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// Shift of the lognormals.
    pub shift: f64,
    /// One fragility a suite; in JSON an object whose keys are the suites.
    #[serde(serialize_with = "by_suite")]
    pub suites: Vec<SuiteFragility>,
}

/// The overturning fragility of one block under one suite.
///
/// Its three errors stand apart: none of them holds another.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SuiteFragility {
    /// The suite.
    #[serde(skip)]
    pub suite: SuiteKind,
    /// Median in PGA/(g tan alpha).
    pub median: f64,
    /// Dispersion of ln(x - shift).
    pub beta: f64,
    /// Median in PGA.
    pub median_pga_g: f64,
    /// From the surface to analyses under the same suite, at blocks that it
    /// was not fitted to.
    pub surface_to_analyses: Errors,
    /// What the choice of the suite's records leaves open.
    pub half_95_of_records: Sampling,
    /// From the surface to recorded motions at the study's blocks; the
    /// sampling error of those motions is in it.
    pub surface_to_recorded: ToRecorded,
}

fn by_suite<S: Serializer>(
    suites: &[SuiteFragility],
    to: S,
) -> Result<S::Ok, S::Error> {
    to.collect_map(suites.iter().map(|own| (own.suite.name(), own)))
}

impl Surrogate {
    /// The overturning fragilities of a block of the nonlinear model.
    ///
    /// ```
    /// use rocking::Block;
    /// use rocking_surrogate::Surrogate;
    /// let block = Block::try_new(0.15, 3.0)?;
    /// let found = Surrogate::embedded()?.fragility(&block)?;
    /// let ordinary = &found.suites[0];
    /// // 1.99 g tan(0.15).
    /// assert!((ordinary.median_pga_g - 0.301).abs() < 1e-3);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`SurrogateError::Range`] for a block outside the range.
    pub fn fragility(
        &self,
        block: &Block,
    ) -> Result<SurfaceFragility, SurrogateError> {
        let (alpha_rad, p_rad_s) =
            (block.slenderness_rad(), block.frequency_rad_s());
        let onset_g = uplift_threshold(block, integrator::Model::Nonlinear);
        let recorded = Recorded::kept()?;
        let mut suites = Vec::new();
        for (model, errors) in &self.models {
            let found = model.at(alpha_rad, p_rad_s)?;
            suites.push(SuiteFragility {
                suite: model.suite,
                median: found.median(),
                beta: found.dispersion(),
                median_pga_g: found.median() * onset_g,
                surface_to_analyses: *errors,
                half_95_of_records: self.sampling(model.suite)?,
                surface_to_recorded: model.to_recorded(&recorded)?,
            });
        }
        Ok(SurfaceFragility {
            origin: ORIGIN,
            im_unit: Intensity::Pga.words(),
            alpha_rad,
            p_rad_s,
            eta: RESTITUTION,
            shift: SHIFT,
            suites,
        })
    }
}
