//! Assessment of objects under records: which object is damaged first, and how
//! often.

mod answers;
mod ground;
mod json;

use std::fmt;

use rayon::prelude::*;
use thiserror::Error;

use self::ground::{AssessmentSuite, ObjectResult};
use super::fit::{Band, IntervalBasis};
use super::risk::FragilityRisk;
use super::{
    Draws, FragilityFit, ModelError, ProcedureError, Ranking, StripeResponses,
};
use crate::fragility::hazard::Hazard;
use crate::fragility::risk::Contribution;
use crate::fragility::total::TotalFragility;
use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, BlockError, Restitution};
use rocking::capacity::CapacityError;
use rocking::ida::{Analysis, IdaError, ResolutionCounts};
use rocking::names::as_text;
use rocking_records::floor::{Floor, FloorError};
use rocking_records::intensity::{IntensityError, IntensityMeasure};
use rocking_statistics::{Clusters, Estimate};

/// Coefficients of restitution beside the object's own.
const RESTITUTIONS: [f64; 2] = [0.85, 0.97];

/// Minimum number of records of an assessment.
const LEAST_RECORDS: usize = 3;

/// A free-standing object.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its name.
    pub id: String,
    /// The block that it is taken for.
    pub block: Block,
    /// Coefficient of restitution.
    pub restitution: Restitution,
    /// Coefficient of friction of the floor, if known.
    pub friction: Option<f64>,
    /// Limit of rotation over slenderness, in (0, 1); `None` if the object
    /// must not overturn.
    pub limit_ratio: Option<f64>,
    /// The floor of a building on which it stands; none on the ground.
    pub floor: Option<NamedFloor>,
}

/// A floor with its name.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedFloor {
    /// The name.
    pub name: String,
    /// The floor.
    pub floor: Floor,
}

/// Options of an assessment.
#[derive(Clone, Copy, Debug)]
pub struct AssessOptions<'a> {
    /// Gravity in m/s2.
    pub gravity_m_s2: f64,
    /// Hazard curve of the site, in an intensity measure of the ground.
    pub hazard: Option<&'a Hazard>,
    /// Years of the probabilities.
    pub years: f64,
    /// Draws of the bootstrap.
    pub draws: Draws,
    /// Whether each outcome is resolved in sufficient precision.
    pub certify: bool,
    /// The model error, in every answer except the alternative without it.
    pub model_error: ModelError,
    /// Median intensities of overturning under recorded motions over those
    /// under the records here, of blocks for which both are known; empty if
    /// none is known.
    pub recorded_ratios: &'a [f64],
}

/// What counts as damage.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Damage {
    /// The object overturns.
    Overturning,
    /// Its rotation exceeds this fraction of the slenderness.
    Rotation(f64),
}

impl fmt::Display for Damage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Overturning => f.write_str("overturning"),
            Self::Rotation(ratio) => write!(f, "rotation above {ratio} alpha"),
        }
    }
}

impl Damage {
    fn edp(self) -> f64 {
        match self {
            Self::Overturning => f64::INFINITY,
            Self::Rotation(ratio) => ratio,
        }
    }
}

/// Objects under a suite, sorted by urgency.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Assessment {
    /// Intensity measure of all intensities here.
    pub im: IntensityMeasure,
    /// Unit of all intensities here and of the hazard curve.
    pub unit: &'static str,
    /// Number of these units in one unit of the measure (g, m/s).
    #[serde(skip)]
    pub units_per_im_unit: f64,
    /// Number of records.
    pub records: usize,
    /// Basis of the intervals.
    #[serde(flatten)]
    pub basis: IntervalBasis,
    /// The model error in every answer except the alternative without it.
    pub model_error: ModelError,
    /// Years of the probabilities.
    pub years: f64,
    /// Correlation of the logarithms of the intensities of damage of two
    /// objects over the records: the least, the median and the largest of all
    /// pairs; none if no pair has three records that damage both.
    pub correlation: Option<Estimate>,
    /// By falling annual frequency of damage, or by rising intensity of 5 %
    /// damage if there is no hazard curve.
    pub objects: Vec<ObjectAssessment>,
    /// Joint damage of at least one, two, .. objects in the same earthquake.
    pub together: Vec<JointDamage>,
    /// Effect of recorded motions, if their ratios are known and an object on
    /// the ground overturns.
    pub recorded_motions: Option<RecordedMotions>,
}

/// Effect of recorded motions on answers computed with other motions.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct RecordedMotions {
    /// Number of blocks whose medians are compared.
    pub blocks: usize,
    /// Median intensity of overturning under recorded motions over that
    /// under the records here: the least, the median and the largest of the
    /// blocks.
    pub median_ratio: Estimate,
    /// Mean return period of overturning with these three ratios as a bias of
    /// the capacity over that without: the least, the median and the largest
    /// of the objects on the ground; none without a hazard curve.
    pub return_period_ratio: Option<Estimate>,
}

/// One object.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ObjectAssessment {
    /// Its name.
    pub id: String,
    /// The block that it is taken for.
    pub block: Block,
    /// Name of the floor that it stands on; none on the ground.
    pub floor: Option<String>,
    /// Width in m.
    pub width_m: f64,
    /// Height in m.
    pub height_m: f64,
    /// Slenderness in rad.
    pub alpha_rad: f64,
    /// Frequency parameter in rad/s.
    pub p_rad_s: f64,
    /// Coefficient of restitution.
    pub eta: f64,
    /// What counts as damage.
    pub damage: Damage,
    /// Peak acceleration in g, of the ground or of its floor, at which the
    /// object begins to rock.
    pub uplift_pga_g: f64,
    /// The intensities at which the records damage it, and their lognormal
    /// fit.
    pub fragility: FragilityFit,
    /// Answer of the fit with the model error.
    pub answer: Answer,
    /// Probabilities of damage with their band.
    pub band: Option<Band>,
    /// Annual frequency of damage by motions between two intensities of the
    /// hazard curve.
    pub contributions: Vec<Contribution>,
    /// Responses at rising PGA in g: 16, 50 and 84 %.
    pub ida: Vec<StripeResponses>,
    /// Intensities of damage by record, ascending; records that do not
    /// damage the object follow, by the intensity up to which they were run.
    pub by_record: Vec<RecordCapacity>,
    /// Intensity measures ranked by the dispersion that remains.
    pub ranking: Ranking,
    /// The answer under other assumptions.
    pub alternatives: Vec<Alternative>,
    /// Share of records that need more friction than there is before they
    /// damage the object; none if no friction is given.
    pub slides_first: Option<f64>,
    /// Number of analyses that each arithmetic resolved.
    pub resolution: ResolutionCounts,
    /// Share of the draws in which this object comes first.
    pub first_in_draws: f64,
}

impl ObjectAssessment {
    /// The intensity measure with the least dispersion, and its dispersion.
    pub fn best_im(&self) -> Option<(&str, f64)> {
        let measures = self.ranking.measures.iter();
        let known = measures
            .map(|m| (m.im.as_str(), m.dispersion.estimate.value()))
            .filter(|(_, dispersion)| dispersion.is_finite());
        known.min_by(|a, b| a.1.total_cmp(&b.1))
    }
}

/// Results of a fragility for an object; without intervals if it was not
/// drawn.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Answer {
    /// The fitted distribution with the error of the model.
    pub fitted: TotalFragility,
    /// Intensity that damages the object with probability 0.5.
    pub median_im: Estimate,
    /// Intensity that damages it with probability 0.05.
    pub small_im: Estimate,
    /// Annual frequency and probability in T years.
    pub risk: Option<FragilityRisk>,
}

impl Answer {
    /// Annual frequency of damage in 1/year, the lower bound of truncation;
    /// none without a hazard curve.
    pub fn annual_frequency(&self) -> Option<Estimate> {
        let risk = self.risk.as_ref()?;
        let point = Estimate::exact(risk.annual_frequency_truncation_lower);
        let drawn = risk.sampling.as_ref();
        Some(drawn.map_or(point, |drawn| drawn.annual_frequency))
    }

    /// Mean return period of damage in years, the reciprocal of the annual
    /// frequency; none without a hazard curve.
    pub fn return_period_years(&self) -> Option<Estimate> {
        Some(self.annual_frequency()?.map(f64::recip))
    }

    /// Probability of damage in the years of the assessment; none without a
    /// hazard curve.
    pub fn probability(&self) -> Option<Estimate> {
        let risk = self.risk.as_ref()?;
        let point = Estimate::exact(risk.probability_truncation_lower);
        let drawn = risk.sampling.as_ref();
        Some(drawn.map_or(point, |drawn| drawn.probability))
    }
}

/// Capacity of an object under one record.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct RecordCapacity {
    /// The record.
    pub record: String,
    /// Intensity of damage, or the highest intensity without damage.
    pub im: f64,
    /// Whether the record damages the object.
    pub damages: bool,
}

/// An alternative assumption.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Assumption {
    /// No model error, only the scatter of the records.
    RecordsAlone,
    /// Another coefficient of restitution.
    Restitution(f64),
    /// A fragility without a shift.
    NoShift,
    /// Intervals as if each record came from a different earthquake.
    RecordsAsUnit,
    /// Each intensity counted separately, up to twice the intensity of the
    /// first overturning: a stronger motion may leave the block standing.
    Resurrections,
    /// The law of AvgSA with the spectra of the records, without an analysis.
    Law,
}

impl fmt::Display for Assumption {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Restitution(eta) => {
                write!(f, "coefficient of restitution {eta}")
            }
            Self::RecordsAlone => {
                f.write_str("records alone, no error of the model")
            }
            Self::NoShift => f.write_str("fragility without a shift"),
            Self::RecordsAsUnit => f.write_str("records drawn one by one"),
            Self::Resurrections => f.write_str(
                "each intensity counted by itself (a stronger motion may \
                 leave the object standing)",
            ),
            Self::Law => f.write_str(
                "law of AvgSA with the spectra of the records, no analysis",
            ),
        }
    }
}

as_text!(write Assumption);

/// The answer under another assumption.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Alternative {
    /// The assumption.
    pub assumption: Assumption,
    /// The answer.
    #[serde(flatten)]
    pub answer: Answer,
}

/// Several objects under the same earthquake.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct JointDamage {
    /// Minimum number of damaged objects.
    pub at_least: usize,
    /// Answer of the fit to the intensities at which each record damages this
    /// many objects.
    #[serde(flatten)]
    pub answer: Answer,
}

/// Why objects cannot be assessed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AssessError {
    /// There is nothing to assess.
    #[error("no object: expected at least one")]
    NoObject,
    /// Too few records to estimate the scatter of intensities.
    #[error(
        "{0} records: expected at least {LEAST_RECORDS}, to estimate the \
         scatter of intensities of damage"
    )]
    Records(usize),
    /// A limit of rotation that is not a fraction of the slenderness.
    #[error("{id}: limit_ratio {found}: expected a number between 0 and 1")]
    Limit {
        /// The object.
        id: String,
        /// Its limit.
        found: f64,
    },
    /// The measure of the hazard curve cannot be computed from records.
    #[error(
        "hazard curve in {0}: expected pga_g, pgv_m_s, pgv_cm_s or a \
         spectral acceleration"
    )]
    Measure(String),
    /// An analysis was rejected.
    #[error(transparent)]
    Analysis(#[from] IdaError),
    /// The forces at an object's pivot cannot be computed.
    #[error("{id}: {source}")]
    Ida {
        /// The object.
        id: String,
        /// Why.
        source: IdaError,
    },
    /// An object's capacities make no fit.
    #[error("{id}: {source}")]
    Fit {
        /// The object.
        id: String,
        /// Why.
        source: ProcedureError,
    },
    /// An object's capacities have no fit under another assumption.
    #[error("{id}, {assumption}: {source}")]
    Alternative {
        /// The object.
        id: String,
        /// The assumption.
        assumption: Assumption,
        /// Why.
        source: ProcedureError,
    },
    /// A record has no measures.
    #[error("record {record}: {source}")]
    Record {
        /// The record.
        record: String,
        /// Why.
        source: IntensityError,
    },
    /// The motion of a floor under a record cannot be computed.
    #[error("record {record}, floor {floor}: {source}")]
    Floor {
        /// The record.
        record: String,
        /// The floor.
        floor: String,
        /// Why.
        source: FloorError,
    },
    /// A curve has no capacities.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// A coefficient is out of range.
    #[error(transparent)]
    Block(#[from] BlockError),
}

/// Assesses objects under the records of one suite, whose earthquakes are
/// `clusters`.
///
/// Each object is a rigid block that rocks (Eq. 1) under each record, scaled
/// up until it overturns ([`curves`](rocking::ida::curves), levels 0.01 g
/// apart, the first overturning bisected). The intensities of damage are
/// fitted by a lognormal distribution: in PGA above the intensity g tan(alpha)
/// at which the object begins to rock, in other measures, and on a floor, from
/// 0. On a [floor](Floor) the object rocks under the floor's motion;
/// intensities stay those of the ground. Each fit gets the error of the model.
/// Intervals are of the bootstrap, which draws earthquakes, and for each draw
/// and object an error of the model. The objects damaged together are counted
/// record by record, since one earthquake shakes all of them.
///
/// ```
/// use rocking_procedures::assess::{AssessOptions, Object, assess};
/// use rocking_procedures::{Draws, ModelError};
/// use rocking::accelerogram::Accelerogram;
/// use rocking_statistics::Clusters;
/// use rocking::{Block, Restitution};
/// let lobe = |name: &str, half: i32| {
///     let rise = (0..=2 * half).map(|k| 0.2 - 0.2 / f64::from(half)
///         * f64::from((k - half).abs()));
///     Accelerogram::try_new(name, 0.01, rise.collect()).unwrap()
/// };
/// let records = [lobe("a", 25), lobe("b", 30), lobe("c", 40)];
/// let cabinet = Object {
///     id: "cabinet".into(),
///     block: Block::from_dimensions(0.5, 1.8, 9.81)?,
///     restitution: Restitution::constant(0.92)?,
///     friction: None,
///     limit_ratio: None,
///     floor: None,
/// };
/// let options = AssessOptions {
///     gravity_m_s2: 9.81,
///     hazard: None,
///     years: 50.0,
///     draws: Draws { replicates: 100, seed: 0 },
///     certify: true,
///     model_error: ModelError::default(),
///     recorded_ratios: &[],
/// };
/// let clusters = Clusters::singletons(3);
/// let found = assess(&[cabinet], &records, &clusters, &options)?;
/// // No motion overturns it that does not lift it: g tan(alpha) = 0.28 g.
/// assert!(found.objects[0].answer.median_im.value() > 0.5 / 1.8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`AssessError`] for no object, fewer than three records, a limit outside
/// (0, 1), a hazard curve in another unit, and an object without a fit, such
/// as one that fewer than two records damage.
pub fn assess(
    objects: &[Object],
    records: &[Accelerogram],
    clusters: &Clusters,
    options: &AssessOptions<'_>,
) -> Result<Assessment, AssessError> {
    if objects.is_empty() {
        return Err(AssessError::NoObject);
    }
    let ground = AssessmentSuite::new(objects, records, clusters, options)?;
    let mut analyses = Vec::new();
    for object in objects {
        if let Some(found) = object.limit_ratio
            && !(found > 0.0 && found < 1.0)
        {
            return Err(AssessError::Limit { id: object.id.clone(), found });
        }
        let resurrections = ground.resurrections(object);
        let own = ground.analysis(object, object.restitution);
        let mut own = vec![Analysis { resurrections, ..own }];
        for eta in RESTITUTIONS {
            let other = Restitution::constant(eta)?;
            own.push(ground.analysis(object, other));
        }
        analyses.push(own);
    }
    let made = ground.curves(objects, &analyses)?;
    let each = objects.par_iter().zip(&analyses).zip(&made).panic_fuse();
    let found = each
        .map(|((one, analyses), made)| ground.object(one, analyses, made))
        .collect::<Result<Vec<_>, AssessError>>()?;
    let together = ground.together(&found)?;
    Ok(Assessment {
        recorded_motions: ground.recorded(&found),
        unit: options.hazard.map_or(ground.im.unit(), Hazard::unit),
        units_per_im_unit: ground.unit,
        im: ground.im,
        records: records.len(),
        basis: IntervalBasis::new(options.draws, clusters),
        model_error: options.model_error,
        years: options.years,
        correlation: ground::correlation(&found),
        objects: ObjectResult::sorted(found),
        together,
    })
}
