//! The records of an assessment, and the results of each object under them.

use rayon::prelude::*;
use statrs::statistics::Statistics as _;

use super::answers::Unknowns;
use super::{
    AssessError, AssessOptions, JointDamage, LEAST_RECORDS, NamedFloor,
    Object, ObjectAssessment, ObjectFacts, RESTITUTIONS, RecordedMotions,
    SlidingObject,
};
use crate::capacities;
use crate::fragility::hazard::{Hazard, HazardMeasure};
use crate::pivot::largest_friction;
use rocking::accelerogram::Accelerogram;
use rocking::block::{BlockError, Restitution};
use rocking::capacity::{CapacityError, InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{
    Analysis, Batch, BracketEnd, Grid, IdaCurve, IdaError, REFINEMENT,
    Resurrections, curves,
};
use rocking::integrator::Extent;
use rocking_records::floor::Floor;
use rocking_records::intensity::{IntensityMeasure, Measures, Settings};
use rocking_statistics::{Clusters, Estimate, Interval, Range};

/// Probability of damage up to which curves go.
pub(super) const LAST: f64 = 0.98;

/// Resurrections are sought up to this multiple of the first-overturning
/// intensity.
const REACH: f64 = 2.0;

/// Periods in s of a hazard curve in AvgSA, which does not state its own.
const AVERAGE_S: [f64; 5] = [0.5, 1.0, 1.5, 2.0, 3.0];

/// Spacing in g of the levels of resurrections.
pub(super) const COARSE_G: f64 = 0.05;

/// Widths in IM to which overturning is bisected under other assumptions, and
/// in searches: it leaves 0.1 % and 1 % of a capacity.
const OTHERS: f64 = 1e-3;
pub(super) const SEARCH: f64 = 1e-2;

/// The motions of the ground, or of one floor, under all records.
pub(super) struct ObjectMotion {
    floor: Option<Floor>,
    pub(super) normalised: Vec<NormalisedRecord>,
    pga_g: Vec<f64>,
}

impl ObjectMotion {
    /// The motions of the last of the `floors`, each of which stands on the
    /// one before.
    pub(super) fn new(
        records: &[Accelerogram],
        floors: &[&NamedFloor],
    ) -> Result<Self, AssessError> {
        let moved = records.par_iter().panic_fuse().map(|record| {
            let mut motion = record.clone();
            for on in floors {
                let refused = |source| AssessError::Floor {
                    record: record.name().to_owned(),
                    floor: on.name.clone(),
                    source,
                };
                motion = on.floor.motion(&motion).map_err(refused)?;
            }
            Ok((NormalisedRecord::new(&motion), motion.pga_g()))
        });
        let moved = moved.collect::<Result<Vec<_>, AssessError>>()?;
        let (normalised, pga_g) = moved.into_iter().unzip();
        let floor = floors.last().map(|on| on.floor);
        Ok(Self { floor, normalised, pga_g })
    }
}

/// The records of one assessment, measured.
pub(super) struct AssessmentSuite<'a> {
    pub(super) records: &'a [Accelerogram],
    moved: Vec<ObjectMotion>,
    measures: Vec<Measures>,
    settings: Settings,
    pub(super) clusters: &'a Clusters,
    pub(super) im: IntensityMeasure,
    /// Units of the hazard curve in one of the measure.
    pub(super) unit: f64,
    pub(super) options: AssessOptions<'a>,
    pub(super) recorded: Option<RecordedMotions>,
}

/// An object that rocks, with its analyses.
pub(super) struct RockingObject {
    pub(super) facts: ObjectFacts,
    pub(super) analysis: Analysis,
    pub(super) curves: Vec<IdaCurve>,
    pub(super) slides_first: Option<f64>,
}

/// Results of one object, with the numbers that compare it with the others.
pub(super) struct ObjectResult {
    pub(super) assessed: ObjectAssessment,
    /// What its answer leaves open beside the records.
    pub(super) unknowns: Unknowns,
    /// Its intensities of damage by record: (value, value), or (limit,
    /// infinity).
    pub(super) intervals: Vec<(f64, f64)>,
    /// What objects are sorted by.
    pub(super) key: f64,
    /// What objects are sorted by, of each draw.
    pub(super) keys: Vec<f64>,
}

impl Object {
    /// The floor under it; `None` on the ground.
    fn ground(&self) -> Option<Floor> {
        self.floor.as_ref().map(|on| on.floor)
    }
}

impl ObjectResult {
    /// Sorts objects, and counts in how many draws each comes first.
    pub(super) fn sorted(mut all: Vec<Self>) -> Vec<ObjectAssessment> {
        all.sort_by(|a, b| a.key.total_cmp(&b.key));
        let draws = all.first().map_or(0, |one| one.keys.len());
        let mut first = vec![0usize; all.len()];
        for draw in 0..draws {
            let keys = all.iter().enumerate();
            let keys = keys.map(|(k, one)| (one.keys[draw], k));
            if let Some((_, k)) = keys.min_by(|a, b| a.0.total_cmp(&b.0)) {
                first[k] += 1;
            }
        }
        let counted = all.into_iter().zip(first).map(|(one, count)| {
            let first_in_draws = count as f64 / draws as f64;
            ObjectAssessment { first_in_draws, ..one.assessed }
        });
        counted.collect()
    }
}

impl<'a> AssessmentSuite<'a> {
    pub(super) fn new(
        objects: &[Object],
        records: &'a [Accelerogram],
        clusters: &'a Clusters,
        options: &AssessOptions<'a>,
    ) -> Result<Self, AssessError> {
        if records.len() < LEAST_RECORDS {
            return Err(AssessError::Records(records.len()));
        }
        let (im, unit) = match options.hazard {
            None => (IntensityMeasure::PGA, 1.0),
            Some(Hazard {
                im: HazardMeasure::Of(im),
                units_per_im_unit,
                ..
            }) if !matches!(im, IntensityMeasure::Column(_)) => {
                (im.clone(), *units_per_im_unit)
            }
            Some(Hazard { im: HazardMeasure::AverageSa, .. }) => {
                (IntensityMeasure::AverageSa(AVERAGE_S.to_vec()), 1.0)
            }
            Some(hazard) => return Err(AssessError::Measure(hazard.name())),
        };
        let of_object = |object: &Object| {
            let p_rad_s = object.block.frequency_rad_s();
            let usual = IntensityMeasure::usual().into_iter();
            usual.map(move |im| im.of_block(p_rad_s))
        };
        let usual: Vec<_> = objects.iter().flat_map(of_object).collect();
        let settings =
            Settings::of(options.gravity_m_s2, usual.iter().chain([&im]));
        let settings = settings.map_err(|source| AssessError::Record {
            record: "settings".to_owned(),
            source,
        })?;
        let measures = records.par_iter().panic_fuse().map(|record| {
            Measures::of(record, &settings).map_err(|source| {
                AssessError::Record { record: record.name().into(), source }
            })
        });
        let mut moved: Vec<ObjectMotion> = Vec::new();
        for object in objects {
            if moved.iter().all(|moved| moved.floor != object.ground()) {
                let floors: Vec<_> = object.floor.iter().collect();
                moved.push(ObjectMotion::new(records, &floors)?);
            }
        }
        let recorded = range(options.recorded_ratios.to_vec());
        let blocks = options.recorded_ratios.len();
        Ok(Self {
            records,
            moved,
            recorded: recorded
                .map(|median_ratio| RecordedMotions { blocks, median_ratio }),
            measures: measures.collect::<Result<_, _>>()?,
            settings,
            clusters,
            im,
            unit,
            options: *options,
        })
    }

    pub(super) fn analysis(
        &self,
        object: &Object,
        restitution: Restitution,
    ) -> Analysis {
        Analysis {
            refine: Some(REFINEMENT),
            certify: self.options.certify,
            ..Analysis::paper(object.block, restitution)
        }
    }

    /// As [`Self::analysis`], for curves that give only the damage.
    pub(super) fn of_damage(
        &self,
        object: &Object,
        restitution: Restitution,
    ) -> Analysis {
        let extent = match object.limit_ratio {
            None => Extent::Outcome,
            Some(_) => Extent::Peak,
        };
        Analysis { extent, ..self.analysis(object, restitution) }
    }

    /// The objects that rock, and those that slide first.
    pub(super) fn parted(
        &self,
        objects: &[Object],
    ) -> Result<(Vec<RockingObject>, Vec<SlidingObject>), AssessError> {
        let analyses = objects.iter();
        let analyses = analyses.map(|o| vec![self.analysis(o, o.restitution)]);
        let analyses: Vec<Vec<Analysis>> = analyses.collect();
        let all: Vec<&Object> = objects.iter().collect();
        let made = self.curves(&all, &analyses)?;
        let (mut rocking, mut sliding) = (Vec::new(), Vec::new());
        for ((object, analyses), made) in all.iter().zip(analyses).zip(made) {
            let gravity = self.options.gravity_m_s2;
            let facts = ObjectFacts::of(object, objects, gravity)?;
            let curves = made.into_iter().flatten().collect();
            let analysis = analyses[0];
            let mut one =
                RockingObject { facts, analysis, curves, slides_first: None };
            let Some(friction) = object.friction else {
                rocking.push(one);
                continue;
            };
            let mut needed = self.frictions(&one)?;
            needed.sort_by(|a, b| b.total_cmp(a));
            let more = needed.iter().filter(|need| !(**need <= friction));
            let share = more.count() as f64 / needed.len() as f64;
            let permitted = self.options.sliding_share;
            if share <= permitted {
                one.slides_first = Some(share);
                rocking.push(one);
            } else {
                let most = (permitted * needed.len() as f64) as usize;
                let needed_friction = needed[most];
                let facts = one.facts;
                sliding.push(SlidingObject { facts, share, needed_friction });
            }
        }
        Ok((rocking, sliding))
    }

    /// The friction that each record needs before it damages an object.
    fn frictions(&self, one: &RockingObject) -> Result<Vec<f64>, AssessError> {
        let object = &one.facts.object;
        let refused = |source: IdaError| AssessError::Ida {
            id: object.id.clone(),
            source,
        };
        let onset = self.onset(&one.facts, &one.curves)?;
        let moved = self.under(object).normalised.par_iter();
        let each = moved.zip(&one.curves).zip(&onset);
        let each = each.map(|((record, curve), (low, high))| {
            let below = if high.is_finite() { *low } else { f64::INFINITY };
            largest_friction(record, curve, &one.analysis, below)
        });
        each.panic_fuse().collect::<Result<_, _>>().map_err(refused)
    }

    /// The analyses of an object under other assumptions: coefficients of
    /// restitution, and all levels up to [`REACH`].
    pub(super) fn others(
        &self,
        facts: &ObjectFacts,
    ) -> Result<Vec<Analysis>, BlockError> {
        let object = &facts.object;
        let mut etas = Vec::new();
        for eta in RESTITUTIONS {
            etas.push(Restitution::constant(eta)?);
        }
        // Housner's, if the others do not enclose it.
        let [low, high] = RESTITUTIONS;
        let housner = Restitution::housner(&object.block).into_iter();
        let within = |eta: f64| (low..=high).contains(&eta);
        etas.extend(housner.filter(|own| !within(own.velocity_ratio())));
        let refine = Some(OTHERS);
        let of = |eta| Analysis { refine, ..self.of_damage(object, eta) };
        let mut all: Vec<Analysis> = etas.into_iter().map(of).collect();
        if self.resurrects(object) {
            let resurrections = Some(Resurrections::Multiple(REACH));
            let own = of(object.restitution);
            let grid = Grid::Pga { step_g: COARSE_G };
            all.push(Analysis { grid, resurrections, ..own });
        }
        Ok(all)
    }

    /// The motions of the ground or floor under an object.
    pub(super) fn under(&self, object: &Object) -> &ObjectMotion {
        let mut moved = self.moved.iter();
        let own = moved.find(|moved| moved.floor == object.ground());
        own.unwrap_or(&self.moved[0])
    }

    /// The curves of all analyses, object by object.
    pub(super) fn curves(
        &self,
        objects: &[&Object],
        analyses: &[Vec<Analysis>],
    ) -> Result<Vec<Vec<Vec<IdaCurve>>>, AssessError> {
        let mut made = vec![Vec::new(); objects.len()];
        for moved in &self.moved {
            let on = |k: &usize| objects[*k].ground() == moved.floor;
            let here: Vec<usize> = (0..objects.len()).filter(on).collect();
            let all = here.iter().flat_map(|k| analyses[*k].iter().copied());
            let all: Vec<Analysis> = all.collect();
            let found = curves(&moved.normalised, &all, &Batch::default())?;
            let mut found = found.into_iter();
            for k in here {
                made[k] = found.by_ref().take(analyses[k].len()).collect();
            }
        }
        Ok(made)
    }

    /// The measure of each ground motion, scaled so that the PGA under the
    /// object is 1 g.
    pub(super) fn per_pga(
        &self,
        moved: &ObjectMotion,
        im: &IntensityMeasure,
    ) -> Vec<f64> {
        let periods_s = self.settings.periods_s();
        let of = |(measures, pga_g): (&Measures, &f64)| {
            let scale = power(im, pga_g.recip());
            im.value(measures, periods_s).map_or(f64::NAN, |v| scale * v)
        };
        self.measures.iter().zip(&moved.pga_g).map(of).collect()
    }

    /// Dimensionless intensities of damage by record.
    pub(super) fn onset(
        &self,
        facts: &ObjectFacts,
        curves: &[IdaCurve],
    ) -> Result<Vec<(f64, f64)>, AssessError> {
        let edp = facts.damage.edp();
        let own = response(curves)?;
        let all = capacities::intervals(&own, edp, InversionRule::Median);
        all.map_err(|source| facts.refused(source))
    }

    /// Intensities of damage by record, in the unit of the hazard curve.
    pub(super) fn intervals(
        &self,
        facts: &ObjectFacts,
        moved: &ObjectMotion,
        curves: &[IdaCurve],
    ) -> Result<Vec<(f64, f64)>, AssessError> {
        let per_pga = self.per_pga(moved, &self.im);
        let scale = |((low, high), per): (&(f64, f64), &f64)| {
            let scale = |im: f64| self.scaled(im * facts.uplift_pga_g, *per);
            (scale(*low), scale(*high))
        };
        let onset = self.onset(facts, curves)?;
        Ok(onset.iter().zip(&per_pga).map(scale).collect())
    }

    /// Intensities at which each record lifts an object, in the unit of the
    /// hazard curve.
    pub(super) fn uplifts(&self, facts: &ObjectFacts) -> Vec<f64> {
        let per_pga = self.per_pga(self.under(&facts.object), &self.im);
        let scale = |per: f64| self.scaled(facts.uplift_pga_g, per);
        per_pga.into_iter().map(scale).collect()
    }

    /// The shift of a fragility.
    pub(super) fn shift(&self, facts: &ObjectFacts) -> f64 {
        match self.im {
            IntensityMeasure::PGA if facts.object.floor.is_none() => {
                facts.uplift_pga_g
            }
            _ => 0.0,
        }
    }

    /// The measure at a PGA in g of a record that has `per` at 1 g.
    pub(super) fn scaled(&self, pga_g: f64, per: f64) -> f64 {
        power(&self.im, pga_g) * per * self.unit
    }

    /// Joint damage of at least one, two, .. objects by the same record.
    pub(super) fn together(
        &self,
        found: &[ObjectResult],
    ) -> Result<Vec<JointDamage>, AssessError> {
        let facts = found.iter().map(|one| &one.assessed.facts);
        let own = facts.clone().map(|one| one.uplift_pga_g);
        let mut uplifts: Vec<f64> = own.collect();
        uplifts.sort_by(f64::total_cmp);
        let on_ground = facts.clone().all(|one| one.object.floor.is_none());
        // What is unknown of the object whose rank is the number of objects.
        let mut ranked: Vec<&ObjectResult> = found.iter().collect();
        ranked.sort_by(|a, b| a.key.total_cmp(&b.key));
        let several = (1..=found.len()).filter(|_| found.len() > 1);
        let mut all = Vec::new();
        for at_least in several {
            let of_record = |r: usize| {
                let least = |end: fn(&(f64, f64)) -> f64| {
                    let ends = found.iter().map(|one| end(&one.intervals[r]));
                    let mut ends: Vec<f64> = ends.collect();
                    ends.sort_by(f64::total_cmp);
                    ends[at_least - 1]
                };
                let (low, high) = (least(|v| v.0), least(|v| v.1));
                if low == high { (low, high) } else { (low, f64::INFINITY) }
            };
            let values: Vec<(f64, f64)> =
                (0..self.records.len()).map(of_record).collect();
            let shift = match self.im {
                IntensityMeasure::PGA if on_ground => uplifts[at_least - 1],
                _ => 0.0,
            };
            let id = format!("{at_least} objects or more");
            let unknowns = &ranked[at_least - 1].unknowns;
            let own = self.drawn(&id, &values, shift, self.clusters, unknowns);
            let own = own.map_err(|source| AssessError::Fit { id, source })?;
            all.push(JointDamage { at_least, answer: self.answer(&own) });
        }
        Ok(all)
    }
}

/// The factor on a measure of a factor on the motion.
pub(super) fn power(im: &IntensityMeasure, factor: f64) -> f64 {
    if im.is_squared() { factor * factor } else { factor }
}

pub(super) fn response(
    curves: &[IdaCurve],
) -> Result<Vec<ResponseCurve>, CapacityError> {
    curves.iter().map(|curve| curve.response(BracketEnd::Refined)).collect()
}

/// The correlation of the logarithms of the intensities of damage of two
/// objects: the least, the median and the largest of all pairs.
pub(super) fn correlation(found: &[ObjectResult]) -> Option<Estimate> {
    let pair = |a: &ObjectResult, b: &ObjectResult| {
        let both = a.intervals.iter().zip(&b.intervals);
        let both = both.filter(|(a, b)| a.1.is_finite() && b.1.is_finite());
        let (x, y): (Vec<f64>, Vec<f64>) =
            both.map(|(a, b)| (libm::log(a.0), libm::log(b.0))).unzip();
        let spread = || (&x).std_dev() * (&y).std_dev();
        (x.len() > 2).then(|| (&x).covariance(&y) / spread())
    };
    let pairs = found.iter().enumerate();
    let pairs =
        pairs.flat_map(|(k, a)| found[..k].iter().map(move |b| (a, b)));
    range(pairs.filter_map(|(a, b)| pair(a, b)).collect())
}

/// The least, the median and the largest of numbers.
pub(super) fn range(mut all: Vec<f64>) -> Option<Estimate> {
    all.sort_by(f64::total_cmp);
    let interval = Interval::try_new(*all.first()?, *all.last()?).ok()?;
    // Rounding may put a correlation beyond 1.
    Estimate::try_new(all[all.len() / 2], interval, Range::Real).ok()
}
