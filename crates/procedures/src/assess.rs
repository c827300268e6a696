//! Assessment of objects under records: which object is damaged first, and how
//! often.

mod answers;
mod error;
mod facts;
mod ground;
mod json;
mod object;
mod remedies;

use std::fmt;

use libm::{log, log1p};
use rayon::prelude::*;

use self::ground::{AssessmentSuite, ObjectResult};
pub use error::AssessError;
pub use facts::{ObjectFacts, ObjectRemark, ObjectState, SlidingObject};
pub use remedies::{Remedy, RemedyKind};

use super::fit::{Band, IntervalBasis};
use super::risk::FragilityRisk;
use super::{Draws, FragilityFit, ModelError, Ranking, StripeResponses};
use crate::fragility::hazard::{Hazard, HazardRemark};
use crate::fragility::risk::Contribution;
use crate::fragility::total::TotalFragility;
use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, BlockError, Restitution};
use rocking::ida::ResolutionCounts;
use rocking::names::{as_text, named};
use rocking_records::floor::Floor;
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::{Clusters, Estimate};

/// Coefficients of restitution beside the object's own and Housner's.
const RESTITUTIONS: [f64; 2] = [0.85, 0.97];

/// Minimum number of records of an assessment.
const LEAST_RECORDS: usize = 3;

/// A free-standing object.
#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    /// Its name in files of other programs.
    pub id: String,
    /// Its name for people.
    pub label: String,
    /// Further columns of the inventory with their cells.
    pub notes: Vec<(String, String)>,
    /// Its centre in the room in m, if known.
    pub position_m: Option<(f64, f64)>,
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

impl Object {
    /// An object on the ground of which no more is known than its block.
    pub fn new(name: &str, block: Block, restitution: Restitution) -> Self {
        Self {
            id: name.to_owned(),
            label: name.to_owned(),
            notes: Vec::new(),
            position_m: None,
            block,
            restitution,
            friction: None,
            limit_ratio: None,
            floor: None,
        }
    }
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
    /// The model error, in every answer except the alternative without it. It
    /// leaves out the coefficient of restitution, which is varied here.
    pub model_error: ModelError,
    /// Median intensities of overturning under recorded motions over those
    /// under the records here, of blocks for which both are known; empty if
    /// none is known. Capacities on the ground are multiplied by their
    /// median.
    pub recorded_ratios: &'a [f64],
    /// Return period in years that each object is to reach.
    pub target_years: Option<f64>,
    /// Share of the records, in [0, 1), up to which an object that slides
    /// before its damage is still taken to rock.
    pub sliding_share: f64,
}

impl AssessOptions<'_> {
    /// The return period in years of a target: of a probability of damage
    /// P < 1 in `years` T, -T/ln(1 - P); a number from 1 on is the return
    /// period itself. None for a number that is not positive.
    ///
    /// ```
    /// use rocking_procedures::AssessOptions;
    /// let usual = AssessOptions::target(0.1, 50.0).unwrap();
    /// assert!((usual - 474.56).abs() < 0.01);
    /// assert_eq!(AssessOptions::target(2500.0, 50.0), Some(2500.0));
    /// assert_eq!(AssessOptions::target(-1.0, 50.0), None);
    /// ```
    pub fn target(target: f64, years: f64) -> Option<f64> {
        match target {
            p if p > 0.0 && p < 1.0 => Some(-years / log1p(-p)),
            _ => Some(target).filter(|own| *own >= 1.0 && own.is_finite()),
        }
    }
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
    /// Remarks on the hazard curve.
    pub remarks: Vec<HazardRemark>,
    /// Return period in years of the last point of the hazard curve: longer
    /// ones are not known.
    pub longest_years: Option<f64>,
    /// Return period in years that each object is to reach.
    pub target_years: Option<f64>,
    /// Share of the records from which on an object counts as sliding.
    pub sliding_share: f64,
    /// Correlation of the logarithms of the intensities of damage of two
    /// objects over the records: the least, the median and the largest of all
    /// pairs; none if no pair has three records that damage both.
    pub correlation: Option<Estimate>,
    /// By falling annual frequency of damage, or by rising intensity of 5 %
    /// damage if there is no hazard curve.
    pub objects: Vec<ObjectAssessment>,
    /// The objects that slide before they rock. They have no rank.
    pub not_rocking: Vec<SlidingObject>,
    /// Joint damage of at least one, two, .. objects in the same earthquake.
    pub together: Vec<JointDamage>,
    /// Difference of recorded motions, if it is known. It enters the answer of
    /// each object on the ground.
    pub recorded_motions: Option<RecordedMotions>,
}

/// Difference of recorded motions from the motions of an assessment.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct RecordedMotions {
    /// Number of blocks whose medians are compared.
    pub blocks: usize,
    /// Median intensity of overturning under recorded motions over that
    /// under the records here: the least, the median and the largest of the
    /// blocks.
    pub median_ratio: Estimate,
}

named! {
    /// Whether the return period of an object reaches the target.
    pub enum TargetVerdict: "verdict on a target" {
        /// The whole interval does.
        Meets = "meets",
        /// Nothing of the interval does.
        Misses = "does not meet",
        /// A part of the interval does.
        Undecided = "undecided",
    }
}

named! {
    /// A source of an answer's interval.
    pub enum IntervalSource: "source of an interval" {
        /// The choice of the records.
        Records = "choice of the records",
        /// The coefficient of restitution.
        Restitution = "coefficient of restitution",
        /// The error of the model.
        Model = "error of the model",
        /// The difference of recorded motions.
        Motions = "difference of recorded motions",
    }
}

/// The answer if only one source is uncertain.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct IntervalPart {
    /// The source.
    pub source: IntervalSource,
    /// Return period in years, or intensity of 5 % damage without a hazard
    /// curve, at the unfavourable end of the source.
    pub low: f64,
    /// The same at its favourable end.
    pub high: f64,
}

/// An object that rocks.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ObjectAssessment {
    /// What is known without its answer.
    pub facts: ObjectFacts,
    /// The intensities at which the records damage it, and their lognormal
    /// fit.
    pub fragility: FragilityFit,
    /// Answer of the fit with the uncertainty of restitution, model and
    /// motions.
    pub answer: Answer,
    /// The answer's interval by source, those that have a part in it.
    pub parts: Vec<IntervalPart>,
    /// Whether the return period reaches the target, if there is one.
    pub target: Option<TargetVerdict>,
    /// Measures that would help an object that does not meet the target.
    pub remedies: Vec<Remedy>,
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
    /// Ranked, or ranked with a remark.
    pub fn state(&self) -> ObjectState {
        match self.facts.remarks.is_empty() {
            true => ObjectState::Ranked,
            false => ObjectState::Remarked,
        }
    }

    /// The source with the largest part in the interval.
    pub fn largest_part(&self) -> Option<&IntervalPart> {
        let width = |part: &&IntervalPart| log(part.high / part.low);
        self.parts.iter().max_by(|a, b| width(a).total_cmp(&width(b)))
    }

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
        Some(self.risk.as_ref()?.annual_frequency())
    }

    /// Mean return period of damage in years, the reciprocal of the annual
    /// frequency; none without a hazard curve.
    pub fn return_period_years(&self) -> Option<Estimate> {
        Some(self.risk.as_ref()?.return_period_years())
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
    /// Motions as they are, not multiplied by the ratio of recorded ones.
    Uncorrected,
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
                let eta = (1e3 * eta).round() / 1e3;
                write!(f, "coefficient of restitution {eta}")
            }
            Self::Uncorrected => {
                f.write_str("motions as they are, no factor of recorded ones")
            }
            Self::RecordsAlone => {
                f.write_str("records alone: no error of the model, no factors")
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

/// Assesses objects under the records of one suite, whose earthquakes are
/// `clusters`.
///
/// Each object is a rigid block that rocks (Eq. 1) under each record, scaled
/// up until it overturns ([`curves`](rocking::ida::curves), levels 0.01 g
/// apart, the first overturning bisected). The intensities of damage are
/// fitted by a lognormal distribution: in PGA above the intensity g tan(alpha)
/// at which the object begins to rock, in other measures, and on a floor, from
/// 0. On a [floor](Floor) the object rocks under the floor's motion;
/// intensities stay those of the ground. Intervals are of the bootstrap, which
/// draws earthquakes, and for each draw and object an error of the model and a
/// factor of the capacity. The factor lies in the range that coefficients of
/// restitution of 0.85, 0.97 and Housner's give; on the ground it includes the
/// ratio of recorded motions. The objects damaged together are counted record
/// by record, since one earthquake shakes all of them; for k of them, the
/// factors are those of the object of rank k.
///
/// An object that slides before its damage under more than the given share of
/// the records has no answer. Each object that does not meet the target gets
/// [remedies](Remedy).
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
/// let block = Block::from_dimensions(0.5, 1.8, 9.81)?;
/// let eta = Restitution::constant(0.92)?;
/// let cabinet = Object::new("cabinet", block, eta);
/// let options = AssessOptions {
///     gravity_m_s2: 9.81,
///     hazard: None,
///     years: 50.0,
///     draws: Draws { replicates: 100, seed: 0 },
///     certify: true,
///     model_error: ModelError::fitted(),
///     recorded_ratios: &[],
///     target_years: None,
///     sliding_share: 0.05,
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
/// (0, 1), a target beyond the hazard curve, a hazard curve in another unit,
/// and an object without a fit, such as one that fewer than two records
/// damage.
pub fn assess(
    objects: &[Object],
    records: &[Accelerogram],
    clusters: &Clusters,
    options: &AssessOptions<'_>,
) -> Result<Assessment, AssessError> {
    if objects.is_empty() {
        return Err(AssessError::NoObject);
    }
    let longest = options.hazard.map(|h| h.curve.ends().1.1.recip());
    match (options.target_years, longest) {
        (Some(_), None) => return Err(AssessError::TargetAlone),
        (Some(found), Some(longest)) if !(found > 0.0 && found <= longest) => {
            return Err(AssessError::Target { found, longest });
        }
        _ => {}
    }
    if !(0.0..1.0).contains(&options.sliding_share) {
        return Err(AssessError::SlidingShare(options.sliding_share));
    }
    let limits = objects.iter().filter_map(|o| Some((o, o.limit_ratio?)));
    for (Object { id, .. }, found) in limits {
        if !(found > 0.0 && found < 1.0) {
            return Err(AssessError::Limit { id: id.clone(), found });
        }
    }
    let ground = AssessmentSuite::new(objects, records, clusters, options)?;
    let (rocking, not_rocking) = ground.parted(objects)?;
    let analyses = rocking.iter().map(|one| ground.others(&one.facts));
    let analyses = analyses.collect::<Result<Vec<_>, BlockError>>()?;
    let those: Vec<&Object> =
        rocking.iter().map(|one| &one.facts.object).collect();
    let made = ground.curves(&those, &analyses)?;
    let each = rocking.into_par_iter().zip(&analyses).zip(&made).panic_fuse();
    let found = each
        .map(|((one, analyses), made)| ground.object(one, analyses, made))
        .collect::<Result<Vec<_>, AssessError>>()?;
    Ok(Assessment {
        unit: options.hazard.map_or(ground.im.unit(), Hazard::unit),
        units_per_im_unit: ground.unit,
        recorded_motions: ground.recorded,
        records: records.len(),
        basis: IntervalBasis::new(options.draws, clusters),
        model_error: options.model_error,
        years: options.years,
        remarks: options.hazard.map_or(Vec::new(), |h| h.remarks.clone()),
        longest_years: longest,
        target_years: options.target_years,
        sliding_share: options.sliding_share,
        correlation: ground::correlation(&found),
        together: ground.together(&found)?,
        objects: ObjectResult::sorted(found),
        not_rocking,
        im: ground.im,
    })
}
