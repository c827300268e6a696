//! Results of one object under the records of an assessment.

use libm::{hypot, log};
use statrs::statistics::Statistics as _;

use super::answers::Unknowns;
use super::ground::{
    AssessmentSuite, COARSE_G, LAST, ObjectResult, RockingObject, power,
    response,
};
use super::{
    Alternative, Answer, AssessError, Assumption, Object, ObjectAssessment,
    ObjectRemark, RecordCapacity,
};
use crate::ranking::CandidateMeasure;
use crate::{
    ModelError, ProcedureError, Ranking, StripeResponses, law_fragility, rank,
};
use rocking::accelerogram::Accelerogram;
use rocking::ida::{Analysis, IdaCurve, ResolutionCounts};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::lognormal::{Stripe, fit_counts_alone};
use rocking_statistics::{Clusters, Estimate, Lognormal};

/// Intensities at which a curve is drawn.
const POINTS: usize = 40;

impl AssessmentSuite<'_> {
    /// Results of one object under the records.
    pub(super) fn object(
        &self,
        one: RockingObject,
        analyses: &[Analysis],
        made: &[Vec<IdaCurve>],
    ) -> Result<ObjectResult, AssessError> {
        let RockingObject { mut facts, analysis: _, curves, slides_first } =
            one;
        let object = facts.object.clone();
        let refused = |source: ProcedureError| facts.refused(source);
        let threshold = facts.uplift_pga_g;
        let moved = self.under(&object);
        let own_onset = self.onset(&facts, &curves)?;
        let intervals = self.intervals(&facts, moved, &curves)?;
        let shift = self.shift(&facts);
        let fragility = self.fit(&intervals, shift).map_err(refused)?;
        // Coefficients of restitution: their fits, and the range of factors.
        let mut restitutions = Vec::new();
        for (curves, analysis) in made.iter().zip(analyses) {
            if analysis.resurrections.is_none() {
                let values = self.intervals(&facts, moved, curves)?;
                let fit = self.fit(&values, shift).map_err(refused)?.fitted;
                let eta = analysis.restitution.velocity_ratio();
                restitutions.push((Assumption::Restitution(eta), fit));
            }
        }
        let median = fragility.fitted.median();
        let factors =
            restitutions.iter().map(|(_, fit)| fit.median() / median);
        let unknowns = self.unknowns(&object, factors);
        let drawn = |clusters: &Clusters, unknowns: &Unknowns| {
            self.drawn(&object.id, &intervals, shift, clusters, unknowns)
        };
        let own = drawn(self.clusters, &unknowns).map_err(refused)?;
        let answer = self.answer(&own);
        let (key, keys) = (self.key(&own.fitted), self.keys(&own, &answer));
        let mut alternatives = Vec::new();
        let mut beside = |assumption, answer: Result<Answer, _>| {
            let id = object.id.clone();
            let answer = answer.map_err(|source| {
                AssessError::Alternative { id, assumption, source }
            })?;
            alternatives.push(Alternative { assumption, answer });
            Ok::<_, AssessError>(())
        };
        let alone =
            drawn(self.clusters, &Unknowns::none()).map_err(refused)?;
        let alone = self.answer(&alone);
        let parts = self.parts(&own.fitted, &alone, &unknowns);
        if !unknowns.is_none() {
            beside(Assumption::RecordsAlone, Ok(alone))?;
        }
        let point = |fitted| self.point(fitted, &unknowns);
        if unknowns.motions.value() != 1.0 {
            let uncorrected =
                Unknowns { motions: Estimate::exact(1.0), ..unknowns };
            let as_they_are = self.point(fragility.fitted, &uncorrected);
            beside(Assumption::Uncorrected, as_they_are)?;
        }
        for (assumption, fitted) in restitutions {
            beside(assumption, point(fitted))?;
        }
        if shift > 0.0 {
            let fit = self.fit(&intervals, 0.0);
            beside(Assumption::NoShift, fit.and_then(|f| point(f.fitted)))?;
        }
        if !self.clusters.is_singletons() {
            let single = Clusters::singletons(self.records.len());
            let answer = drawn(&single, &unknowns);
            let answer = answer.map(|own| self.answer(&own));
            beside(Assumption::RecordsAsUnit, answer)?;
        }
        if let Some(above) = made.get(restitution_count(analyses)) {
            let last = fragility.fitted.quantile(LAST);
            let stripes = resurrected(above, threshold, last);
            // Too few stripes between 0 and 1 determine no dispersion: no row.
            if let Ok(fitted) = fit_counts_alone(&stripes, shift) {
                beside(Assumption::Resurrections, point(fitted))?;
            }
        }
        if let Some(law) = self.by_law(&object) {
            beside(Assumption::Law, point(law))?;
        }
        let mut resolution = ResolutionCounts::default();
        for curve in &curves {
            resolution.add(&curve.resolution);
        }
        let years = answer.return_period_years();
        let target = years.and_then(|own| self.verdict(own));
        let remedies =
            self.remedies(&facts, &intervals, shift, &answer, &unknowns)?;
        let hazard = self.options.hazard;
        let band = self.band(&own);
        let ida = self.ida(&curves, threshold).map_err(refused)?;
        let ranking = self.ranking(&object, &own_onset, threshold);
        let ranking = ranking.map_err(refused)?;
        let contributions =
            hazard.map_or(Vec::new(), |h| h.curve.contributions(own.fitted));
        let last = hazard.map(|h| h.curve.ends().1.1.recip());
        let years = years.map(|own| own.value());
        if let Some((last, years)) = last.zip(years)
            && !(years <= last)
        {
            facts.remarks.push(ObjectRemark::BeyondHazard(last));
        }
        Ok(ObjectResult {
            assessed: ObjectAssessment {
                facts,
                contributions,
                band,
                ida,
                by_record: self.by_record(&intervals),
                ranking,
                fragility,
                answer,
                parts,
                target,
                remedies,
                alternatives,
                slides_first,
                resolution,
                first_in_draws: f64::NAN,
            },
            unknowns,
            intervals,
            key,
            keys,
        })
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
        let named = self.records.iter().zip(values);
        let of = |(own, (low, high)): (&Accelerogram, &(f64, f64))| {
            RecordCapacity {
                record: own.name().to_owned(),
                im: *low,
                damages: high.is_finite(),
            }
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

    /// Whether an object is analysed above its first overturning: only if
    /// overturning is counted in the PGA of the ground.
    pub(super) fn resurrects(&self, object: &Object) -> bool {
        object.limit_ratio.is_none()
            && object.floor.is_none()
            && self.im == IntensityMeasure::PGA
    }
}

/// How many of the first analyses have another coefficient of restitution.
fn restitution_count(analyses: &[Analysis]) -> usize {
    analyses.iter().filter(|own| own.resurrections.is_none()).count()
}

/// How many of the records overturn the object at each level of the grid up to
/// `last` in g: each level by itself, as far as it was examined.
fn resurrected(curves: &[IdaCurve], threshold: f64, last: f64) -> Vec<Stripe> {
    let level = |im: f64| (im * threshold / COARSE_G).round() as usize;
    let stands = |curve: &IdaCurve, k: usize| {
        let first = curve.overturning.map(|first| level(first.scanned_im));
        let above = curve.above.iter().find(|point| level(point.im) == k);
        match above {
            Some(point) => !point.outcome.is_overturned(),
            None => first.is_none_or(|first| k < first),
        }
    };
    let levels = level(1.0) + 1..(last / COARSE_G) as usize;
    let stripe = |k: usize| {
        let standing = curves.iter().filter(|c| stands(c, k)).count();
        let (n, exceeded) = (curves.len(), curves.len() - standing);
        let (n, exceeded) = (n as u64, exceeded as u64);
        Stripe { im: COARSE_G * k as f64, exceeded, n }
    };
    levels.map(stripe).collect()
}
