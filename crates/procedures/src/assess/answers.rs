//! What intensities of damage say of an object: fits, intervals and risk.

use super::Answer;
use super::ground::AssessmentSuite;
use crate::fit::BootstrapFits;
use crate::fragility::hazard::Hazard;
use crate::{
    FitOptions, FragilityFit, FragilityInput, ProcedureError, Shift,
    fit_sample, risk,
};
use rocking_statistics::{CensoredSample, Clusters, Estimate, Lognormal};

/// The small probability of damage whose intensity is stated.
const SMALL: f64 = 0.05;

/// Intensities at which a fragility is drawn.
const POINTS: usize = 40;

impl AssessmentSuite<'_> {
    fn options(&self, shift: f64, clusters: &Clusters) -> FitOptions {
        FitOptions {
            shift: Shift::Given(shift),
            draws: Some(self.options.draws),
            clusters: Some(clusters.clone()),
            ..FitOptions::default()
        }
    }

    pub(super) fn fit(
        &self,
        values: &[(f64, f64)],
        shift: f64,
        last: f64,
    ) -> Result<FragilityFit, ProcedureError> {
        let sample = CensoredSample::from_intervals(values)?;
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

    pub(super) fn fitted(
        values: &[(f64, f64)],
        shift: f64,
    ) -> Result<Lognormal, ProcedureError> {
        let shift = Shift::Given(shift);
        let options = FitOptions { shift, ..FitOptions::default() };
        Ok(fit_sample(&CensoredSample::from_intervals(values)?, &options)?
            .fitted)
    }

    /// What a fragility says, without an interval.
    pub(super) fn point(&self, fitted: Lognormal) -> Answer {
        self.answer(fitted, None)
    }

    /// What the fit to intensities of damage says, with the intervals of its
    /// draws; and what objects are sorted by, of each draw.
    pub(super) fn drawn(
        &self,
        values: &[(f64, f64)],
        shift: f64,
        clusters: &Clusters,
    ) -> Result<(Answer, Vec<f64>), ProcedureError> {
        let fitted = Self::fitted(values, shift)?;
        let options = self.options(shift, clusters);
        let sampled =
            options.sampled(&CensoredSample::from_intervals(values)?)?;
        let small = |law: &Option<Lognormal>| {
            law.as_ref().map_or(f64::NAN, |law| law.quantile(SMALL))
        };
        let small =
            sampled.iter().flat_map(|all| &all.fitted).map(small).collect();
        let answer = self.answer(fitted, sampled);
        let risk = answer.risk.as_ref().and_then(|r| r.sampling.as_ref());
        let keys = match (self.options.hazard, risk) {
            (None, _) => small,
            (Some(_), None) => Vec::new(),
            (Some(_), Some(drawn)) => {
                drawn.drawn_annual_frequencies.iter().map(|x| -x).collect()
            }
        };
        Ok((answer, keys))
    }

    fn answer(
        &self,
        fitted: Lognormal,
        sampled: Option<BootstrapFits>,
    ) -> Answer {
        let at = |p: f64| {
            let own = sampled.as_ref().map(|all| all.quantile(&fitted, p));
            own.unwrap_or_else(|| Estimate::exact(fitted.quantile(p)))
        };
        let (median_im, small_im) = (at(0.5), at(SMALL));
        let exposed = |hazard: &Hazard| {
            let fragility = String::new();
            let one =
                FragilityInput { fragility, fitted, sampled: sampled.clone() };
            let found = risk(hazard, &[one], self.options.years).ok()?;
            found.fragilities.into_iter().next()
        };
        let risk = self.options.hazard.and_then(exposed);
        Answer { fitted, median_im, small_im, risk }
    }

    /// What objects are sorted by: the annual frequency, falling, or the
    /// intensity of 5 % damage.
    pub(super) fn key(&self, law: &Lognormal) -> f64 {
        match self.options.hazard {
            Some(h) => -h.curve.annual_frequency(law).truncation_lower,
            None => law.quantile(SMALL),
        }
    }
}
