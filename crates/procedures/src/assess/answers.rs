//! Answers from intensities of damage: fits, intervals and risk.

use super::ground::{AssessmentSuite, LAST, range};
use super::{Answer, IntervalPart, IntervalSource, Object, TargetVerdict};
use crate::fit::{Band, BootstrapFits};
use crate::fragility::total::TotalFragility;
use crate::risk::FragilityRisk;
use crate::{
    FitOptions, FragilityFit, FragilityInput, ModelError, ProcedureError,
    Shift, fit_sample, risk,
};
use rocking_statistics::lognormal::{FitError, LognormalError};
use rocking_statistics::{
    CensoredSample, Clusters, Estimate, Lognormal, Range,
};

/// Small probability of damage whose intensity is reported.
const SMALL: f64 = 0.05;

/// Intensities at which a fragility is drawn.
const POINTS: usize = 40;

/// What an answer leaves open beside the scatter of the records: the error of
/// the model, and factors of the capacity.
#[derive(Clone, Copy)]
pub(super) struct Unknowns {
    pub(super) error: ModelError,
    pub(super) restitution: Estimate,
    pub(super) motions: Estimate,
}

impl Unknowns {
    pub(super) fn none() -> Self {
        let known = Estimate::exact(1.0);
        let error = ModelError::none();
        Self { error, restitution: known, motions: known }
    }

    pub(super) fn is_none(&self) -> bool {
        self.error.is_none() && self.factors().is_empty()
    }

    fn factors(&self) -> Vec<Estimate> {
        let all = [self.restitution, self.motions].into_iter();
        let known = |own: &Estimate| *own == Estimate::exact(1.0);
        all.filter(|own| !known(own)).collect()
    }

    fn bias(&self) -> f64 {
        let factors = self.restitution.value() * self.motions.value();
        self.error.bias().value() * factors
    }

    pub(super) fn total(
        &self,
        own: Lognormal,
    ) -> Result<TotalFragility, LognormalError> {
        let dispersion = self.error.dispersion().value();
        TotalFragility::try_new(own, self.bias(), dispersion)
    }
}

impl AssessmentSuite<'_> {
    /// What is unknown of an object: `factors` are those of other coefficients
    /// of restitution.
    pub(super) fn unknowns(
        &self,
        object: &Object,
        factors: impl Iterator<Item = f64>,
    ) -> Unknowns {
        let recorded = self.recorded.filter(|_| object.floor.is_none());
        let known = Estimate::exact(1.0);
        Unknowns {
            error: self.options.model_error,
            restitution: around(1.0, factors),
            motions: recorded.map_or(known, |own| own.median_ratio),
        }
    }

    /// The answer's interval by source: the headline's number if only this
    /// source is uncertain.
    pub(super) fn parts(
        &self,
        total: &TotalFragility,
        alone: &Answer,
        unknowns: &Unknowns,
    ) -> Vec<IntervalPart> {
        let value = self.headline(total);
        let at = |(factor, dispersion): (f64, f64)| {
            let bias = total.bias() * factor;
            let other =
                TotalFragility::try_new(*total.records(), bias, dispersion);
            other.map_or(value, |other| self.headline(&other))
        };
        let s = total.model_dispersion();
        let scaled = |own: &Estimate| {
            let (low, high) = own.interval()?.ends();
            let ends = [low, high].map(|end| end / own.value());
            Some(ends.map(|factor| at((factor, s))))
        };
        let records = || {
            let own = match self.options.hazard {
                Some(_) => alone.return_period_years()?,
                None => alone.small_im,
            };
            let (low, high) = own.interval()?.ends();
            Some([low, high].map(|end| value * end / own.value()))
        };
        let model = || {
            let bias = unknowns.error.bias();
            let ratio =
                |end: Option<f64>| end.map_or(1.0, |end| end / bias.value());
            let dispersion = unknowns.error.dispersion();
            let (least, most) = (
                dispersion.low().unwrap_or(s),
                dispersion.high().unwrap_or(s),
            );
            Some([
                at((ratio(bias.low()), most)),
                at((ratio(bias.high()), least)),
            ])
        };
        let all = [
            (IntervalSource::Records, records()),
            (IntervalSource::Restitution, scaled(&unknowns.restitution)),
            (IntervalSource::Model, model()),
            (IntervalSource::Motions, scaled(&unknowns.motions)),
        ];
        let part = |(source, ends): (IntervalSource, Option<[f64; 2]>)| {
            let [low, high] = ends?;
            (low < high).then_some(IntervalPart { source, low, high })
        };
        all.into_iter().filter_map(part).collect()
    }

    /// The number that the headline shows: return period in years, or the
    /// intensity of 5 % damage.
    fn headline(&self, total: &TotalFragility) -> f64 {
        match self.options.hazard {
            Some(_) => self.years(total),
            None => total.quantile(SMALL),
        }
    }

    /// Return period of damage in years; infinite without a hazard curve.
    pub(super) fn years(&self, total: &TotalFragility) -> f64 {
        self.options.hazard.map_or(f64::INFINITY, |h| {
            h.curve.annual_frequency(*total).truncation_lower.recip()
        })
    }

    /// Whether a return period reaches the target.
    pub(super) fn verdict(&self, years: Estimate) -> Option<TargetVerdict> {
        let target = self.options.target_years?;
        let own = years.value();
        let (low, high) = years.interval().map_or((own, own), |i| i.ends());
        Some(if low >= target {
            TargetVerdict::Meets
        } else if high < target {
            TargetVerdict::Misses
        } else {
            TargetVerdict::Undecided
        })
    }

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
        records: Lognormal,
        unknowns: &Unknowns,
    ) -> Result<Answer, ProcedureError> {
        let fitted = unknowns.total(records).map_err(FitError::from)?;
        let fragility = String::new();
        Ok(self.answer(&FragilityInput { fragility, fitted, sampled: None }))
    }

    /// The intensities of damage of an object, or of several, drawn with what
    /// is unknown beside the records.
    pub(super) fn drawn(
        &self,
        name: &str,
        values: &[(f64, f64)],
        shift: f64,
        clusters: &Clusters,
        unknowns: &Unknowns,
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
        let fitted = unknowns.total(fitted).map_err(FitError::from)?;
        let Unknowns { error, .. } = unknowns;
        let factors = unknowns.factors();
        let with =
            |all: BootstrapFits| all.with_factors(error, &factors, name);
        let sampled = sampled.map(with);
        Ok(FragilityInput { fragility: name.to_owned(), fitted, sampled })
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
        Answer {
            fitted: own.fitted,
            median_im: at(0.5),
            small_im: at(SMALL),
            risk: self.exposed(own),
        }
    }

    /// Frequency and probability of damage; none without a hazard curve.
    pub(super) fn exposed(
        &self,
        own: &FragilityInput,
    ) -> Option<FragilityRisk> {
        let own = std::slice::from_ref(own);
        let found =
            risk(self.options.hazard?, own, self.options.years).ok()?;
        found.fragilities.into_iter().next()
    }

    /// The sorting key of objects: the annual frequency, falling, or the
    /// intensity of 5 % damage.
    pub(super) fn key(&self, law: &TotalFragility) -> f64 {
        match self.options.hazard {
            Some(h) => -h.curve.annual_frequency(*law).truncation_lower,
            None => law.quantile(SMALL),
        }
    }
}

/// A value with the range that it and further numbers have.
fn around(value: f64, others: impl Iterator<Item = f64>) -> Estimate {
    let all = others.chain([value]).filter(|x| x.is_finite()).collect();
    let ends = range(all).and_then(|own| own.interval());
    let own = ends.filter(|own| own.low() < own.high());
    let own = own.and_then(|own| {
        Estimate::try_new(value, own, Range::NotNegative).ok()
    });
    own.unwrap_or(Estimate::exact(value))
}
