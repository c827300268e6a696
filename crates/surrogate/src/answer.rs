//! A block's fragility by the surface, with its errors.

use rocking::block::Block;
use rocking::integrator::{self, uplift_threshold};
use rocking_records::intensity::Intensity;
use rocking_statistics::Lognormal;
use serde::{Serialize, Serializer};

use super::{
    Errors, RESTITUTION, Recorded, Sampling, Surrogate, SurrogateError,
    ToRecorded,
};
use rocking_synthesis::SuiteKind;

/// Where the fragilities of the surface of a suite come from, in words.
///
/// ```
/// use rocking_surrogate::{Surrogate, origin};
/// let words = origin(Surrogate::embedded()?.models[0].0.suite);
/// assert!(words.ends_with("without an analysis, ordinary suite"));
/// # Ok::<(), rocking_surrogate::SurrogateError>(())
/// ```
#[must_use]
pub fn origin(suite: SuiteKind) -> String {
    format!(
        "overturning under the embedded suites, by a fitted surface, without \
         an analysis, {suite} suite"
    )
}

/// Overturning fragilities of one block by the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SurfaceFragility {
    /// Unit of the fragilities.
    pub im_unit: &'static str,
    /// Slenderness angle.
    pub alpha_rad: f64,
    /// Frequency parameter.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// One fragility a suite; in JSON an object whose keys are the suites.
    #[serde(serialize_with = "by_suite")]
    pub suites: Vec<SuiteFragility>,
}

/// The overturning fragility of one block under one suite.
///
/// Its three errors stand apart: none of them holds another.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[non_exhaustive]
pub struct SuiteFragility {
    /// The suite.
    #[serde(skip)]
    pub suite: SuiteKind,
    /// Its [`origin`].
    pub origin: String,
    /// The fragility in PGA/(g tan alpha).
    pub fitted: Lognormal,
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
    /// // 2.03 g tan(0.15).
    /// assert!((ordinary.median_pga_g - 0.306).abs() < 1e-3);
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
        let recorded = Recorded::kept("pga")?;
        let mut suites = Vec::new();
        for (model, errors) in &self.models {
            let fitted = model.at(alpha_rad, p_rad_s)?;
            suites.push(SuiteFragility {
                suite: model.suite,
                origin: origin(model.suite),
                fitted,
                median_pga_g: fitted.median() * onset_g,
                surface_to_analyses: *errors,
                half_95_of_records: self.sampling(model.suite)?,
                surface_to_recorded: model.to_recorded(&recorded)?,
            });
        }
        Ok(SurfaceFragility {
            im_unit: Intensity::Pga.row().words,
            alpha_rad,
            p_rad_s,
            eta: RESTITUTION,
            suites,
        })
    }
}
