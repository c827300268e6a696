//! The records of an assessment, and what they make of each object.

use rayon::prelude::*;

use super::{Alternative, Answer, Assumption};
use super::{
    AssessError, AssessOptions, Assessed, Contribution, Damage, Object,
    RecordCapacity, Together,
};
use crate::block::Restitution;
use crate::capacity::{CapacityError, InversionRule, ResponseCurve};
use crate::excitation::NormalisedRecord;
use crate::fragility::hazard::Hazard;
use crate::fragility::risk::HazardCurve;
use crate::ida::{
    Analysis, IdaCurve, Overturned, REFINEMENT, ResolutionCounts,
};
use crate::integrator::{Forces, uplift_threshold};
use crate::intensity::{IntensityMeasure, Measures, Settings};
use crate::procedures::counts::Bounds;
use crate::procedures::fit::Sampled;
use crate::procedures::ranking::Candidate;
use crate::procedures::{
    Exposed, FitOptions, FragilityFit, ProcedureError, Ranking, Shift,
    StripeResponses, capacities, fit_sample, pivot_forces, rank, risk,
    stripes,
};
use crate::record::Accelerogram;
use crate::statistics::bootstrap::Estimate;
use crate::statistics::{CensoredSample, Clusters, Lognormal};

/// Level of the intervals.
const LEVEL: f64 = 0.95;

/// The small probability of damage whose intensity is stated.
const SMALL: f64 = 0.05;

/// Intensities at which a curve is drawn.
const POINTS: usize = 40;

/// The records of one assessment, measured.
pub(super) struct Ground<'a> {
    names: Vec<&'a str>,
    pub(super) normalised: Vec<NormalisedRecord>,
    measures: Vec<Measures>,
    settings: Settings,
    clusters: &'a Clusters,
    pub(super) im: IntensityMeasure,
    /// Units of the hazard curve in one of the measure.
    unit: f64,
    options: AssessOptions<'a>,
}

/// One object, and what is needed to set it beside the others.
pub(super) struct Found {
    pub(super) assessed: Assessed,
    /// Its intensities of damage by record: (value, value), or (limit,
    /// infinity).
    pub(super) intervals: Vec<(f64, f64)>,
    /// What objects are sorted by.
    pub(super) key: f64,
    /// The same of each draw.
    keys: Vec<f64>,
}

impl Found {
    /// Sorts objects, and counts in how many draws each comes first.
    pub(super) fn sorted(mut all: Vec<Self>) -> Vec<Assessed> {
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
        let counted = all.into_iter().zip(first);
        counted
            .map(|(one, count)| Assessed {
                first_in_draws: count as f64 / draws as f64,
                ..one.assessed
            })
            .collect()
    }
}

impl<'a> Ground<'a> {
    pub(super) fn of(
        records: &'a [Accelerogram],
        clusters: &'a Clusters,
        options: &AssessOptions<'a>,
    ) -> Result<Self, AssessError> {
        if records.is_empty() {
            return Err(AssessError::Nothing("record"));
        }
        let (im, unit) = match options.hazard {
            None => (IntensityMeasure::Pga, 1.0),
            Some(Hazard { im: Some(im), units_per_im_unit, .. })
                if !matches!(im, IntensityMeasure::Column(_)) =>
            {
                (im.clone(), *units_per_im_unit)
            }
            Some(hazard) => {
                return Err(AssessError::Measure(hazard.unit().to_owned()));
            }
        };
        let mut periods: Vec<f64> = Vec::new();
        let usual = IntensityMeasure::usual();
        for period in usual.iter().chain([&im]).flat_map(|m| m.periods_s()) {
            if !periods.contains(period) {
                periods.push(*period);
            }
        }
        let measured = |source| AssessError::Record {
            record: "settings".to_owned(),
            source,
        };
        let damping = Settings::default().damping_ratio();
        let settings =
            Settings::try_new(options.gravity_m_s2, damping, periods)
                .map_err(measured)?;
        let measures = records.par_iter().panic_fuse().map(|record| {
            Measures::of(record, &settings).map_err(|source| {
                AssessError::Record { record: record.name().into(), source }
            })
        });
        Ok(Self {
            names: records.iter().map(Accelerogram::name).collect(),
            normalised: records.iter().map(NormalisedRecord::new).collect(),
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

    /// The measure of each record where its PGA is 1 g, in the unit of the
    /// hazard curve.
    fn per_pga(&self, im: &IntensityMeasure) -> Vec<f64> {
        let periods_s = self.settings.periods_s();
        let of = |measures: &Measures| {
            let value = measures.pga_g.recip();
            let scale = if im.is_squared() { value * value } else { value };
            im.value(measures, periods_s).map_or(f64::NAN, |v| scale * v)
        };
        self.measures.iter().map(of).collect()
    }

    /// What the records make of one object.
    pub(super) fn object(
        &self,
        object: &Object,
        analyses: &[Analysis],
        made: &[Vec<IdaCurve>],
    ) -> Result<Found, AssessError> {
        let id = &object.id;
        let refused = |source: ProcedureError| {
            let id = id.clone();
            AssessError::Fit { id, source }
        };
        let damage =
            object.limit_ratio.map_or(Damage::Overturning, Damage::Rotation);
        let threshold = uplift_threshold(&object.block, analyses[0].model);
        let per_pga = self.per_pga(&self.im);
        let of = |curves: &[IdaCurve]| {
            let own = response(curves)?;
            let edp = damage.edp();
            let all = capacities::intervals(&own, edp, InversionRule::Median);
            let all = all.map_err(refused)?.into_iter().zip(&per_pga);
            let scaled = all.map(|((low, high), per)| {
                let scale = |im: f64| self.scaled(im * threshold, *per);
                (scale(low), scale(high))
            });
            Ok::<Vec<(f64, f64)>, AssessError>(scaled.collect())
        };
        let intervals = of(&made[0])?;
        let shift = match self.im {
            IntensityMeasure::Pga => threshold,
            _ => 0.0,
        };
        let answer = |values: &[(f64, f64)], shift, clusters| {
            self.answer(values, shift, clusters).map_err(refused)
        };
        let (own, keys) = answer(&intervals, shift, self.clusters)?;
        let key = self.key(&own.fitted);
        let mut alternatives = Vec::new();
        for (curves, analysis) in made.iter().zip(analyses).skip(1) {
            let eta = analysis.restitution.velocity_ratio();
            let assumption = Assumption::Restitution(eta);
            let answer = answer(&of(curves)?, shift, self.clusters)?.0;
            alternatives.push(Alternative { assumption, answer });
        }
        if shift > 0.0 {
            let answer = answer(&intervals, 0.0, self.clusters)?.0;
            let assumption = Assumption::NoShift;
            alternatives.push(Alternative { assumption, answer });
        }
        if !self.clusters.is_singletons() {
            let single = Clusters::singletons(self.names.len());
            let answer = answer(&intervals, shift, &single)?.0;
            let assumption = Assumption::RecordsAsUnit;
            alternatives.push(Alternative { assumption, answer });
        }
        let fragility = self
            .fit(&intervals, shift, own.fitted.quantile(0.98))
            .map_err(refused)?;
        let slides_first = match object.friction {
            None => None,
            Some(mu) => Some(self.slides(id, &made[0], &analyses[0], mu)?),
        };
        let mut resolution = ResolutionCounts::default();
        for curve in &made[0] {
            resolution.add(&curve.resolution);
        }
        let size = object.block.dimensions(self.options.gravity_m_s2)?;
        Ok(Found {
            assessed: Assessed {
                id: id.clone(),
                width_m: size.width_m,
                height_m: size.height_m,
                alpha_rad: object.block.slenderness_rad(),
                p_rad_s: object.block.frequency_rad_s(),
                eta: object.restitution.velocity_ratio(),
                damage,
                uplift_pga_g: threshold,
                contributions: self.contributions(&own.fitted),
                ida: self.ida(&made[0], threshold).map_err(refused)?,
                by_record: self.by_record(&intervals),
                ranking: self
                    .ranking(&made[0], damage, threshold)?
                    .map_err(refused)?,
                fragility,
                answer: own,
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
        let scale = if self.im.is_squared() { pga_g * pga_g } else { pga_g };
        scale * per * self.unit
    }

    fn sample(
        values: &[(f64, f64)],
    ) -> Result<CensoredSample, ProcedureError> {
        let highs: Vec<f64> = values.iter().map(|v| v.1).collect();
        let limits: Vec<Option<f64>> = values
            .iter()
            .map(|(low, high)| high.is_infinite().then_some(*low))
            .collect();
        Ok(CensoredSample::try_new(&highs, &limits)?)
    }

    fn options(&self, shift: f64, clusters: &Clusters) -> FitOptions {
        FitOptions {
            shift: Shift::Given(shift),
            draws: Some(self.options.draws),
            clusters: Some(clusters.clone()),
            ..FitOptions::default()
        }
    }

    fn fit(
        &self,
        values: &[(f64, f64)],
        shift: f64,
        last: f64,
    ) -> Result<FragilityFit, ProcedureError> {
        let sample = Self::sample(values)?;
        let step = (last - shift) / POINTS as f64;
        let grid = (0..=POINTS).map(|k| shift + step * k as f64);
        let hazard = self.options.hazard.into_iter();
        let hazard = hazard.flat_map(|h| h.curve.points().iter().map(|p| p.0));
        let mut band: Vec<f64> =
            grid.chain(hazard).filter(|x| *x > 0.0).collect();
        band.sort_by(f64::total_cmp);
        band.dedup();
        let options = self.options(shift, self.clusters);
        fit_sample(&sample, &FitOptions { band, ..options })
    }

    fn answer(
        &self,
        values: &[(f64, f64)],
        shift: f64,
        clusters: &Clusters,
    ) -> Result<(Answer, Vec<f64>), ProcedureError> {
        let sample = Self::sample(values)?;
        let options = self.options(shift, clusters);
        let once = FitOptions { draws: None, ..options.clone() };
        let fitted = fit_sample(&sample, &once)?.fitted;
        let sampled = options.sampled(&sample)?;
        let of_draws = |of: &dyn Fn(&Lognormal) -> f64| -> Vec<f64> {
            let drawn = sampled.iter().flat_map(|all: &Sampled| &all.fitted);
            drawn.map(|law| law.as_ref().map_or(f64::NAN, of)).collect()
        };
        let at = |p: f64| {
            let point = fitted.quantile(p);
            let drawn = of_draws(&|law| law.quantile(p));
            let found = clusters.estimate(point, &drawn, LEVEL);
            let ends = |end: fn(&Estimate) -> f64| found.as_ref().map(end);
            let (low, high) = (ends(|e| e.low), ends(|e| e.high));
            Bounds { point, low, high }
        };
        let (median_im, small_im) = (at(0.5), at(SMALL));
        let exposed = |hazard: &Hazard| {
            let fragility = String::new();
            let one = Exposed { fragility, fitted, sampled: sampled.clone() };
            let found = risk(hazard, &[one], self.options.years).ok()?;
            found.fragilities.into_iter().next()
        };
        let risk = self.options.hazard.and_then(exposed);
        let keys = of_draws(&|law| self.key(law));
        Ok((Answer { fitted, median_im, small_im, risk }, keys))
    }

    /// What objects are sorted by: the annual frequency, falling, or the
    /// intensity of 5 % damage.
    fn key(&self, law: &Lognormal) -> f64 {
        match self.options.hazard {
            Some(h) => -h.curve.annual_frequency(law).truncation_lower,
            None => law.quantile(SMALL),
        }
    }

    fn contributions(&self, fitted: &Lognormal) -> Vec<Contribution> {
        let Some(hazard) = self.options.hazard else { return Vec::new() };
        let pairs = hazard.curve.points().windows(2);
        let one = |pair: &[(f64, f64)]| {
            let curve = HazardCurve::try_new(pair).ok()?;
            Some(Contribution {
                from_im: pair[0].0,
                to_im: pair[1].0,
                annual_frequency: curve.annual_frequency(fitted).covered,
            })
        };
        pairs.filter_map(one).collect()
    }

    fn ida(
        &self,
        curves: &[IdaCurve],
        threshold: f64,
    ) -> Result<Vec<StripeResponses>, ProcedureError> {
        let own = response(curves)?;
        let half = |curve: &IdaCurve| {
            let last = curve.points.last().map_or(1.0, |point| point.im);
            curve.overturning.map_or(last, |first| first.im())
        };
        let mut ends: Vec<f64> = curves.iter().map(half).collect();
        ends.sort_by(f64::total_cmp);
        let last = ends[ends.len() * 17 / 20];
        let step = (last - 1.0) / POINTS as f64;
        let levels: Vec<f64> =
            (0..=POINTS).map(|k| 1.0 + step * k as f64).collect();
        let mut found = stripes(&own, &levels, None)?;
        for stripe in &mut found {
            stripe.intensity *= threshold;
        }
        Ok(found)
    }

    fn by_record(&self, values: &[(f64, f64)]) -> Vec<RecordCapacity> {
        let named = self.names.iter().zip(values);
        let mut all: Vec<RecordCapacity> = named
            .map(|(name, (low, high))| RecordCapacity {
                record: (*name).to_owned(),
                im: *low,
                damages: high.is_finite(),
            })
            .collect();
        all.sort_by(|a, b| {
            let falls = b.damages.cmp(&a.damages);
            falls.then(a.im.total_cmp(&b.im))
        });
        all
    }

    fn ranking(
        &self,
        curves: &[IdaCurve],
        damage: Damage,
        threshold: f64,
    ) -> Result<Result<Ranking, ProcedureError>, AssessError> {
        let own = response(curves)?;
        let all =
            capacities::intervals(&own, damage.edp(), InversionRule::Median);
        let candidate = |im: &IntensityMeasure| {
            let squared = im.is_squared();
            let scale =
                if squared { threshold * threshold } else { threshold };
            let per = self.per_pga(im).into_iter();
            let at_uplift = per.map(|per| per * scale).collect();
            Candidate { im: im.to_string(), at_uplift, squared }
        };
        let measures = IntensityMeasure::usual();
        let candidates: Vec<Candidate> =
            measures.iter().map(candidate).collect();
        let draws = self.options.draws;
        Ok(all.and_then(|all| {
            rank(&all, &candidates, &[], self.clusters, draws)
        }))
    }

    /// Share of records that ask for more friction than `friction`.
    fn slides(
        &self,
        id: &str,
        curves: &[IdaCurve],
        analysis: &Analysis,
        friction: f64,
    ) -> Result<f64, AssessError> {
        let found =
            pivot_forces(&self.normalised, curves, analysis, &[friction])
                .map_err(|source| {
                    let id = id.to_owned();
                    AssessError::Ida { id, source }
                })?;
        let slides = |forces: &&Vec<Forces>| {
            forces.iter().any(|f| !(f.friction <= friction))
        };
        let count = found.curves.iter().filter(slides).count();
        Ok(count as f64 / curves.len() as f64)
    }

    /// So many objects or more damaged by the same record.
    pub(super) fn together(
        &self,
        found: &[Found],
    ) -> Result<Vec<Together>, AssessError> {
        let own = found.iter().map(|one| one.assessed.uplift_pga_g);
        let mut uplifts: Vec<f64> = own.collect();
        uplifts.sort_by(f64::total_cmp);
        let several = (1..=found.len()).filter(|_| found.len() > 1);
        let mut all = Vec::new();
        for at_least in several {
            let of_record = |r: usize| {
                let least = |end: fn(&(f64, f64)) -> f64| {
                    let mut ends: Vec<f64> = found
                        .iter()
                        .map(|one| end(&one.intervals[r]))
                        .collect();
                    ends.sort_by(f64::total_cmp);
                    ends[at_least - 1]
                };
                let (low, high) = (least(|v| v.0), least(|v| v.1));
                if low == high { (low, high) } else { (low, f64::INFINITY) }
            };
            let values: Vec<(f64, f64)> =
                (0..self.names.len()).map(of_record).collect();
            let shift = match self.im {
                IntensityMeasure::Pga => uplifts[at_least - 1],
                _ => 0.0,
            };
            let answer = self.answer(&values, shift, self.clusters);
            let answer = answer.map_err(|source| AssessError::Fit {
                id: format!("{at_least} objects or more"),
                source,
            })?;
            all.push(Together { at_least, answer: answer.0 });
        }
        Ok(all)
    }
}

fn response(curves: &[IdaCurve]) -> Result<Vec<ResponseCurve>, CapacityError> {
    curves.iter().map(|curve| curve.response(Overturned::Refined)).collect()
}
