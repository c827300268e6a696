//! The records of an assessment, and the results of each object under them.

use rayon::prelude::*;
use statrs::statistics::Statistics as _;

use super::{
    Alternative, Answer, AssessError, AssessOptions, Assumption, Damage,
    JointDamage, LEAST_RECORDS, NamedFloor, Object, ObjectAssessment,
    RecordCapacity,
};
use crate::fragility::hazard::{Hazard, HazardMeasure};
use crate::pivot::needs_more;
use crate::ranking::CandidateMeasure;
use crate::{
    ModelError, ProcedureError, Ranking, StripeResponses, capacities,
    law_fragility, rank,
};
use libm::{hypot, log};
use rocking::accelerogram::Accelerogram;
use rocking::block::Restitution;
use rocking::capacity::{CapacityError, InversionRule, ResponseCurve};
use rocking::excitation::NormalisedRecord;
use rocking::ida::{
    Analysis, Batch, BracketEnd, IdaCurve, IdaError, REFINEMENT,
    ResolutionCounts, Resurrections, curves,
};
use rocking::integrator::uplift_threshold;
use rocking_records::floor::Floor;
use rocking_records::intensity::{IntensityMeasure, Measures, Settings};
use rocking_statistics::lognormal::{Stripe, fit_counts_alone};
use rocking_statistics::{Clusters, Estimate, Interval, Lognormal, Range};

/// Intensities at which a curve is drawn.
const POINTS: usize = 40;

/// Probability of damage up to which curves go.
pub(super) const LAST: f64 = 0.98;

/// Resurrections are sought up to this multiple of the first-overturning
/// intensity.
const REACH: f64 = 2.0;

/// Spacing of the levels in g.
const STEP_G: f64 = 0.01;

/// The motions of the ground, or of one floor, under all records.
struct ObjectMotion {
    floor: Option<Floor>,
    normalised: Vec<NormalisedRecord>,
    pga_g: Vec<f64>,
}

impl ObjectMotion {
    fn new(
        records: &[Accelerogram],
        floor: Option<&NamedFloor>,
    ) -> Result<Self, AssessError> {
        let moved = records.par_iter().panic_fuse().map(|record| {
            let Some(on) = floor else {
                return Ok((NormalisedRecord::new(record), record.pga_g()));
            };
            let refused = |source| AssessError::Floor {
                record: record.name().to_owned(),
                floor: on.name.clone(),
                source,
            };
            let motion = on.floor.motion(record).map_err(refused)?;
            Ok((NormalisedRecord::new(&motion), motion.pga_g()))
        });
        let moved = moved.collect::<Result<Vec<_>, AssessError>>()?;
        let (normalised, pga_g) = moved.into_iter().unzip();
        Ok(Self { floor: floor.map(|on| on.floor), normalised, pga_g })
    }
}

/// The records of one assessment, measured.
pub(super) struct AssessmentSuite<'a> {
    names: Vec<&'a str>,
    moved: Vec<ObjectMotion>,
    measures: Vec<Measures>,
    settings: Settings,
    pub(super) clusters: &'a Clusters,
    pub(super) im: IntensityMeasure,
    /// Units of the hazard curve in one of the measure.
    pub(super) unit: f64,
    pub(super) options: AssessOptions<'a>,
}

/// Results of one object, with the numbers that compare it with the others.
pub(super) struct ObjectResult {
    pub(super) assessed: ObjectAssessment,
    /// Its intensities of damage by record: (value, value), or (limit,
    /// infinity).
    pub(super) intervals: Vec<(f64, f64)>,
    /// What objects are sorted by.
    pub(super) key: f64,
    /// What objects are sorted by, of each draw.
    keys: Vec<f64>,
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
                moved.push(ObjectMotion::new(records, object.floor.as_ref())?);
            }
        }
        Ok(Self {
            names: records.iter().map(Accelerogram::name).collect(),
            moved,
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

    /// The motions of the ground or floor under an object.
    fn under(&self, object: &Object) -> &ObjectMotion {
        let mut moved = self.moved.iter();
        let own = moved.find(|moved| moved.floor == object.ground());
        own.unwrap_or(&self.moved[0])
    }

    /// The curves of all analyses, object by object.
    pub(super) fn curves(
        &self,
        objects: &[Object],
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
    fn per_pga(
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

    /// Results of one object under the records.
    pub(super) fn object(
        &self,
        object: &Object,
        analyses: &[Analysis],
        made: &[Vec<IdaCurve>],
    ) -> Result<ObjectResult, AssessError> {
        let id = &object.id;
        let refused = |source: ProcedureError| {
            let id = id.clone();
            AssessError::Fit { id, source }
        };
        let damage =
            object.limit_ratio.map_or(Damage::Overturning, Damage::Rotation);
        let threshold = uplift_threshold(&object.block, analyses[0].model);
        let moved = self.under(object);
        let per_pga = self.per_pga(moved, &self.im);
        let onset = |curves: &[IdaCurve]| {
            let own = response(curves)?;
            let edp = damage.edp();
            let all = capacities::intervals(&own, edp, InversionRule::Median);
            all.map_err(refused)
        };
        let scaled = |onset: &[(f64, f64)]| -> Vec<(f64, f64)> {
            let scale = |((low, high), per): (&(f64, f64), &f64)| {
                let scale = |im: f64| self.scaled(im * threshold, *per);
                (scale(*low), scale(*high))
            };
            onset.iter().zip(&per_pga).map(scale).collect()
        };
        let own_onset = onset(&made[0])?;
        let intervals = scaled(&own_onset);
        let shift = match self.im {
            IntensityMeasure::PGA if object.floor.is_none() => threshold,
            _ => 0.0,
        };
        let error = &self.options.model_error;
        let drawn = |clusters: &Clusters, error: &ModelError| {
            self.drawn(id, &intervals, shift, clusters, error)
        };
        let own = drawn(self.clusters, error).map_err(refused)?;
        let answer = self.answer(&own);
        let (key, keys) = (self.key(&own.fitted), self.keys(&own, &answer));
        let mut alternatives = Vec::new();
        let mut beside = |assumption, answer: Result<Answer, _>| {
            let answer = answer.map_err(|source| {
                AssessError::Alternative { id: id.clone(), assumption, source }
            })?;
            alternatives.push(Alternative { assumption, answer });
            Ok::<_, AssessError>(())
        };
        if !error.is_none() {
            let alone = drawn(self.clusters, &ModelError::none());
            let alone = alone.map(|own| self.answer(&own));
            beside(Assumption::RecordsAlone, alone)?;
        }
        let fit = |values: &[(f64, f64)], shift| {
            self.point(self.fit(values, shift)?.fitted)
        };
        for (curves, analysis) in made.iter().zip(analyses).skip(1) {
            let eta = analysis.restitution.velocity_ratio();
            let answer = fit(&scaled(&onset(curves)?), shift);
            beside(Assumption::Restitution(eta), answer)?;
        }
        if shift > 0.0 {
            beside(Assumption::NoShift, fit(&intervals, 0.0))?;
        }
        if !self.clusters.is_singletons() {
            let single = Clusters::singletons(self.names.len());
            let answer = drawn(&single, error).map(|own| self.answer(&own));
            beside(Assumption::RecordsAsUnit, answer)?;
        }
        let fragility = self.fit(&intervals, shift).map_err(refused)?;
        if analyses[0].resurrections.is_some() {
            let last = fragility.fitted.quantile(LAST);
            let stripes = resurrected(&made[0], threshold, last);
            let fitted = fit_counts_alone(&stripes, shift);
            let answer = fitted.map_err(ProcedureError::from);
            let answer = answer.and_then(|fitted| self.point(fitted));
            beside(Assumption::Resurrections, answer)?;
        }
        if let Some(law) = self.by_law(object) {
            beside(Assumption::Law, self.point(law))?;
        }
        let slides_first = object.friction.map(|mu| {
            self.slides(object, &made[0], &analyses[0], mu, &own_onset)
        });
        let slides_first = slides_first.transpose()?;
        let mut resolution = ResolutionCounts::default();
        for curve in &made[0] {
            resolution.add(&curve.resolution);
        }
        let size = object.block.dimensions(self.options.gravity_m_s2)?;
        Ok(ObjectResult {
            assessed: ObjectAssessment {
                id: id.clone(),
                block: object.block,
                floor: object.floor.as_ref().map(|on| on.name.clone()),
                width_m: size.width_m,
                height_m: size.height_m,
                alpha_rad: object.block.slenderness_rad(),
                p_rad_s: object.block.frequency_rad_s(),
                eta: object.restitution.velocity_ratio(),
                damage,
                uplift_pga_g: threshold,
                contributions: self
                    .options
                    .hazard
                    .map_or(Vec::new(), |h| h.curve.contributions(own.fitted)),
                band: self.band(&own),
                ida: self.ida(&made[0], threshold).map_err(refused)?,
                by_record: self.by_record(&intervals),
                ranking: self
                    .ranking(object, &own_onset, threshold)
                    .map_err(refused)?,
                fragility,
                answer,
                alternatives,
                slides_first,
                resolution,
                first_in_draws: f64::NAN,
            },
            intervals,
            key,
            keys,
        })
    }

    /// The measure at a PGA in g of a record that has `per` at 1 g.
    fn scaled(&self, pga_g: f64, per: f64) -> f64 {
        power(&self.im, pga_g) * per * self.unit
    }

    fn ida(
        &self,
        curves: &[IdaCurve],
        threshold: f64,
    ) -> Result<Vec<StripeResponses>, ProcedureError> {
        let mut found = StripeResponses::over(&response(curves)?, POINTS)?;
        for stripe in &mut found {
            stripe.intensity *= threshold;
        }
        Ok(found)
    }

    fn by_record(&self, values: &[(f64, f64)]) -> Vec<RecordCapacity> {
        let named = self.names.iter().zip(values);
        let of = |(name, (low, high)): (&&str, &(f64, f64))| RecordCapacity {
            record: (*name).to_owned(),
            im: *low,
            damages: high.is_finite(),
        };
        let mut all: Vec<RecordCapacity> = named.map(of).collect();
        all.sort_by(|a, b| {
            let falls = b.damages.cmp(&a.damages);
            falls.then(a.im.total_cmp(&b.im))
        });
        all
    }

    /// Intensity measures by the dispersion of the capacities `onset`.
    fn ranking(
        &self,
        object: &Object,
        onset: &[(f64, f64)],
        threshold: f64,
    ) -> Result<Ranking, ProcedureError> {
        let candidate = |im: IntensityMeasure| {
            let own = im.of_block(object.block.frequency_rad_s());
            let per = self.per_pga(self.under(object), &own).into_iter();
            let scale = power(&im, threshold);
            let at_uplift = per.map(|per| per * scale).collect();
            let squared = im.is_squared();
            CandidateMeasure { im: im.to_string(), at_uplift, squared }
        };
        let candidates = IntensityMeasure::usual().into_iter().map(candidate);
        let candidates: Vec<_> = candidates.collect();
        rank(onset, &candidates, &[], self.clusters, self.options.draws)
    }

    /// The fragility by the law of AvgSA and the spectra of the records, in
    /// the measure and unit of the hazard curve; none outside its range, and on
    /// a floor.
    ///
    /// With IM/AvgSA lognormal over the records, and independent of AvgSA at
    /// damage, the product of both is lognormal.
    fn by_law(&self, object: &Object) -> Option<Lognormal> {
        let (block, eta) =
            (&object.block, object.restitution.velocity_ratio());
        let edp = object.limit_ratio.unwrap_or(f64::INFINITY);
        let law = law_fragility(block, eta, edp, ModelError::none()).ok()?;
        if object.floor.is_some() {
            return None;
        }
        let moved = self.under(object);
        let [own, average] =
            [&self.im, &law.im].map(|im| self.per_pga(moved, im));
        let ratios = own.iter().zip(&average);
        let ratios: Vec<f64> =
            ratios.map(|(own, average)| log(own / average)).collect();
        let log_mean = law.fitted.log_mean() + (&ratios).mean();
        let both = hypot(law.fitted.dispersion(), (&ratios).std_dev());
        let found = Lognormal::try_new(0.0, log_mean, both).ok()?;
        found.scaled(self.unit).ok()
    }

    /// How far above the first overturning an object is analysed; none
    /// unless overturning is counted in the PGA of the ground.
    pub(super) fn resurrections(
        &self,
        object: &Object,
    ) -> Option<Resurrections> {
        let counts = object.limit_ratio.is_none()
            && object.floor.is_none()
            && self.im == IntensityMeasure::PGA;
        counts.then_some(Resurrections::Multiple(REACH))
    }

    /// Share of records that need more friction than `friction` before they
    /// damage the object; `onset` are the intensities of damage of the curves.
    fn slides(
        &self,
        object: &Object,
        curves: &[IdaCurve],
        analysis: &Analysis,
        friction: f64,
        onset: &[(f64, f64)],
    ) -> Result<f64, AssessError> {
        let each =
            self.under(object).normalised.par_iter().zip(curves).zip(onset);
        let each = each.map(|((record, curve), (low, high))| {
            let below = if high.is_finite() { *low } else { f64::INFINITY };
            needs_more(record, curve, analysis, friction, below)
        });
        let found: Result<Vec<bool>, IdaError> = each.panic_fuse().collect();
        let refused =
            |source| AssessError::Ida { id: object.id.clone(), source };
        let found = found.map_err(refused)?;
        let count = found.iter().filter(|more| **more).count();
        Ok(count as f64 / curves.len() as f64)
    }

    /// Joint damage of at least one, two, .. objects by the same record.
    pub(super) fn together(
        &self,
        found: &[ObjectResult],
    ) -> Result<Vec<JointDamage>, AssessError> {
        let own = found.iter().map(|one| one.assessed.uplift_pga_g);
        let mut uplifts: Vec<f64> = own.collect();
        uplifts.sort_by(f64::total_cmp);
        let on_ground = found.iter().all(|one| one.assessed.floor.is_none());
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
                (0..self.names.len()).map(of_record).collect();
            let shift = match self.im {
                IntensityMeasure::PGA if on_ground => uplifts[at_least - 1],
                _ => 0.0,
            };
            let id = format!("{at_least} objects or more");
            let error = &self.options.model_error;
            let own = self.drawn(&id, &values, shift, self.clusters, error);
            let own = own.map_err(|source| AssessError::Fit { id, source })?;
            all.push(JointDamage { at_least, answer: self.answer(&own) });
        }
        Ok(all)
    }
}

/// The factor on a measure of a factor on the motion.
fn power(im: &IntensityMeasure, factor: f64) -> f64 {
    if im.is_squared() { factor * factor } else { factor }
}

fn response(curves: &[IdaCurve]) -> Result<Vec<ResponseCurve>, CapacityError> {
    curves.iter().map(|curve| curve.response(BracketEnd::Refined)).collect()
}

/// How many of the records overturn the object at each level of the grid up to
/// `last` in g: each level by itself, as far as it was examined.
fn resurrected(curves: &[IdaCurve], threshold: f64, last: f64) -> Vec<Stripe> {
    let level = |im: f64| (im * threshold / STEP_G).round() as usize;
    let stands = |curve: &IdaCurve, k: usize| {
        let first = curve.overturning.map(|first| level(first.scanned_im));
        let above = curve.above.iter().find(|point| level(point.im) == k);
        match above {
            Some(point) => !point.outcome.is_overturned(),
            None => first.is_none_or(|first| k < first),
        }
    };
    let levels = level(1.0) + 1..(last / STEP_G) as usize;
    let stripe = |k: usize| {
        let standing = curves.iter().filter(|c| stands(c, k)).count();
        let (n, exceeded) = (curves.len(), curves.len() - standing);
        let (n, exceeded) = (n as u64, exceeded as u64);
        Stripe { im: STEP_G * k as f64, exceeded, n }
    };
    levels.map(stripe).collect()
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
