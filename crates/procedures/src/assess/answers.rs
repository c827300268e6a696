//! Answers from intensities of damage: fits, intervals and risk.

use super::ground::{AssessmentSuite, LAST, ObjectResult, range};
use super::{Answer, Damage, RecordedMotions};
use crate::fit::Band;
use crate::fragility::hazard::Hazard;
use crate::fragility::total::TotalFragility;
use crate::{
    FitOptions, FragilityFit, FragilityInput, ModelError, ProcedureError,
    Shift, fit_sample, risk,
};
use rocking_statistics::lognormal::FitError;
use rocking_statistics::{CensoredSample, Clusters, Estimate, Lognormal};

/// Small probability of damage whose intensity is reported.
const SMALL: f64 = 0.05;

/// Intensities at which a fragility is drawn.
const POINTS: usize = 40;

impl AssessmentSuite<'_> {
    /// The fit to intensities of damage, without an interval.
    pub(super) fn fit(
        &self,
        values: &[(f64, f64)],
        shift: f64,
    ) -> Result<FragilityFit, ProcedureError> {
        let options = FitOptions {
            shift: Shift::Given(shift),
            clusters: Some(self.clusters.clone()),
            ..FitOptions::default()
        };
        fit_sample(&CensoredSample::from_intervals(values)?, &options)
    }

    /// The answer of a fit to intensities of damage, without an interval,
    /// with the error of the model.
    pub(super) fn point(
        &self,
        fitted: Lognormal,
    ) -> Result<Answer, ProcedureError> {
        let error = &self.options.model_error;
        let own = FragilityInput::with(String::new(), (fitted, None), error);
        Ok(self.answer(&own.map_err(FitError::from)?))
    }

    /// The intensities of damage of an object, or of several, drawn with the
    /// error of the model.
    pub(super) fn drawn(
        &self,
        name: &str,
        values: &[(f64, f64)],
        shift: f64,
        clusters: &Clusters,
        error: &ModelError,
    ) -> Result<FragilityInput, ProcedureError> {
        let sample = CensoredSample::from_intervals(values)?;
        let options = FitOptions {
            shift: Shift::Given(shift),
            draws: Some(self.options.draws),
            clusters: Some(clusters.clone()),
            ..FitOptions::default()
        };
        let sampled = options.sampled(&sample)?;
        let fitted = sample.fit(shift, options.method)?.distribution;
        let own = (fitted, sampled);
        let own = FragilityInput::with(name.to_owned(), own, error);
        Ok(own.map_err(FitError::from)?)
    }

    /// The sorting key of objects in each draw.
    pub(super) fn keys(&self, own: &FragilityInput, of: &Answer) -> Vec<f64> {
        if self.options.hazard.is_none() {
            let fits = own.sampled.iter().flat_map(|all| &all.fitted);
            let small = |fit: &Option<TotalFragility>| {
                fit.as_ref().map_or(f64::NAN, |fit| fit.quantile(SMALL))
            };
            return fits.map(small).collect();
        }
        let risk = of.risk.as_ref().and_then(|risk| risk.sampling.as_ref());
        let drawn = risk.iter().flat_map(|r| &r.drawn_annual_frequencies);
        drawn.map(|x| -x).collect()
    }

    /// The band of a fragility at the intensities at which it is drawn, and
    /// at those of the hazard curve.
    pub(super) fn band(&self, own: &FragilityInput) -> Option<Band> {
        let first = own.fitted.closed().map_or(0.0, |law| law.shift());
        let step = (own.fitted.quantile(LAST) - first) / POINTS as f64;
        let grid = (0..=POINTS).map(|k| first + step * k as f64);
        let hazard = self.options.hazard.into_iter();
        let hazard = hazard.flat_map(|h| h.curve.points().iter().map(|p| p.0));
        let mut at: Vec<f64> =
            grid.chain(hazard).filter(|x| *x > 0.0).collect();
        at.sort_by(f64::total_cmp);
        at.dedup();
        Some(own.sampled.as_ref()?.band(&own.fitted, &at))
    }

    pub(super) fn answer(&self, own: &FragilityInput) -> Answer {
        let at = |p: f64| match &own.sampled {
            Some(all) => all.quantile(&own.fitted, p),
            None => Estimate::exact(own.fitted.quantile(p)),
        };
        let exposed = |hazard: &Hazard| {
            let own = std::slice::from_ref(own);
            let found = risk(hazard, own, self.options.years).ok()?;
            found.fragilities.into_iter().next()
        };
        Answer {
            fitted: own.fitted,
            median_im: at(0.5),
            small_im: at(SMALL),
            risk: self.options.hazard.and_then(exposed),
        }
    }

    /// The sorting key of objects: the annual frequency, falling, or the
    /// intensity of 5 % damage.
    pub(super) fn key(&self, law: &TotalFragility) -> f64 {
        match self.options.hazard {
            Some(h) => -h.curve.annual_frequency(*law).truncation_lower,
            None => law.quantile(SMALL),
        }
    }

    /// Effect of recorded motions on the objects on the ground.
    pub(super) fn recorded(
        &self,
        found: &[ObjectResult],
    ) -> Option<RecordedMotions> {
        let median_ratio = range(self.options.recorded_ratios.to_vec())?;
        let (low, high) = median_ratio.ends();
        let mut ratios = Vec::new();
        for one in found.iter().map(|one| &one.assessed) {
            if one.damage == Damage::Overturning && one.floor.is_none() {
                for bias in [low, median_ratio.value(), high] {
                    let other = one.answer.fitted.scaled(bias).ok()?;
                    let key = self.key(&one.answer.fitted);
                    ratios.push(key / self.key(&other));
                }
            }
        }
        let periods = range(ratios)?;
        Some(RecordedMotions {
            blocks: self.options.recorded_ratios.len(),
            median_ratio,
            return_period_ratio: self.options.hazard.and(Some(periods)),
        })
    }
}
