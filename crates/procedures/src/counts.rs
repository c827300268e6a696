//! Fragilities fitted to counts of stripes.

use std::collections::BTreeMap;
use std::fmt;

use super::fit::{BootstrapFits, IntervalBasis};
use super::{Draws, LEVEL, ProcedureError};
use crate::fragility::total::TotalFragility;
use rocking::capacity::{CapacityError, InversionRule, ResponseCurve};
use rocking::names::as_text;
use rocking_statistics::lognormal::{
    LognormalFit, Stripe, fit_counts, fit_counts_alone, fit_intervals,
};
use rocking_statistics::resampling::multiplicities;
use rocking_statistics::{Clusters, Estimate, Lognormal, Range};

/// A lognormal fragility fitted to counts, with intervals.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct CountsFragility {
    /// Records run, over all stripes.
    pub n: usize,
    /// Records of a fit to brackets ([`RecordOutcome::brackets`]) that do not
    /// exceed the level up to where their run ends.
    pub open: usize,
    /// The fitted distribution, in the unit of the stripes.
    pub fitted: Lognormal,
    /// Level of the intervals.
    pub level: f64,
    /// Basis of the intervals.
    pub intervals: Basis,
    /// Median with its interval; an end is open if the likelihood does not
    /// fall so far. No interval if a draw in ten has no fit.
    pub median: Estimate,
    /// Dispersion with its interval.
    pub dispersion: Estimate,
    /// Log-likelihood of the binomial counts, or of the brackets.
    pub log_likelihood: Option<f64>,
    /// Pearson's chi-squared of the counts; none of brackets.
    pub chi_squared: Option<f64>,
    /// Stripes less two; none of brackets.
    pub degrees_of_freedom: Option<usize>,
}

/// Basis of the intervals of a fit to counts.
#[derive(Clone, Debug, PartialEq)]
pub enum Basis {
    /// No intervals.
    None,
    /// The likelihood of independent stripes: counts do not show whether
    /// stripes share records.
    IndependentStripes,
    /// A bootstrap in which each draw has its records in all stripes.
    Drawn(IntervalBasis),
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::None => f.write_str("none"),
            Self::IndependentStripes => {
                f.write_str("likelihood, stripes as independent")
            }
            Self::Drawn(basis) => basis.fmt(f),
        }
    }
}

as_text!(write Basis);

/// Outcome of a record at an intensity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RecordOutcome {
    /// The intensity.
    pub im: f64,
    /// Place of the record.
    pub record: usize,
    /// Whether it exceeded the level.
    pub exceeded: bool,
}

/// Fits a lognormal fragility above `shift` to counts of exceedances, by
/// maximum likelihood; see [`fit_counts`]. The intervals take the stripes as
/// independent; of stripes that share records they are too narrow, and
/// [`fit_outcomes`] has the right ones.
///
/// # Errors
/// [`ProcedureError::Fit`] for counts that make no fit.
pub fn fit_stripes(
    stripes: &[Stripe],
    shift: f64,
) -> Result<CountsFragility, ProcedureError> {
    let found = fit_counts(stripes, shift)?;
    Ok(CountsFragility {
        intervals: Basis::IndependentStripes,
        median: found.median,
        dispersion: found.dispersion,
        chi_squared: Some(found.chi_squared),
        degrees_of_freedom: Some(found.degrees_of_freedom),
        ..CountsFragility::of(&found.fit)
    })
}

impl CountsFragility {
    /// A fit without intervals.
    fn of(fit: &LognormalFit) -> Self {
        let fitted = fit.distribution;
        Self {
            n: fit.n,
            open: 0,
            fitted,
            level: LEVEL,
            intervals: Basis::None,
            median: Estimate::exact(fitted.median()),
            dispersion: Estimate::exact(fitted.dispersion()),
            log_likelihood: fit.log_likelihood,
            chi_squared: None,
            degrees_of_freedom: None,
        }
    }
}

/// Fits a lognormal fragility above `shift` to stripes of the same records.
///
/// If every record has an outcome at every intensity, the fit is as by
/// [`fit_stripes`]. Else it uses the likelihood of
/// [`RecordOutcome::brackets`]: a record that stands where its run ends has no
/// outcome beyond, while one that exceeded the level before counts at every
/// intensity, so that the counts of those run so far exceed too often. The
/// intervals are those of a bootstrap that draws the earthquakes of the
/// records, and keeps each record in all its stripes; a record without an
/// outcome is left out. Without draws they are those of [`fit_stripes`], of
/// brackets none.
///
/// ```
/// use rocking_procedures::{Draws, fit_outcomes};
/// use rocking_procedures::counts::RecordOutcome;
/// use rocking_statistics::Clusters;
/// let capacities = [1.2, 1.7, 2.2, 2.4, 3.1, 3.6];
/// let stripe = |im: f64| {
///     let of = |(record, capacity): (usize, &f64)| {
///         RecordOutcome { im, record, exceeded: *capacity <= im }
///     };
///     capacities.iter().enumerate().map(of).collect::<Vec<_>>()
/// };
/// let outcomes = [stripe(1.5), stripe(2.3), stripe(3.3)].concat();
/// let draws = Draws { replicates: 100, seed: 0 };
/// let records = Clusters::singletons(6);
/// let found = fit_outcomes(&outcomes, &records, 0.0, Some(draws))?;
/// assert!((found.median.value() - 2.2).abs() < 0.2);
/// # Ok::<(), rocking_procedures::ProcedureError>(())
/// ```
///
/// # Errors
/// [`ProcedureError::Fit`] for outcomes that make no fit.
pub fn fit_outcomes(
    outcomes: &[RecordOutcome],
    clusters: &Clusters,
    shift: f64,
    draws: Option<Draws>,
) -> Result<CountsFragility, ProcedureError> {
    let found = match RecordOutcome::stripes(outcomes) {
        Some(stripes) => fit_stripes(&stripes, shift)?,
        None => {
            let all = RecordOutcome::brackets(outcomes);
            let open = all.iter().filter(|own| own.1.is_infinite()).count();
            let of = CountsFragility::of(&fit_intervals(&all, shift)?);
            CountsFragility { n: outcomes.len(), open, ..of }
        }
    };
    let Some(draws) = draws else { return Ok(found) };
    let drawn = sample_outcomes(outcomes, clusters, shift, draws)?;
    let (own, range) = (found.dispersion.value(), Range::NotNegative);
    let of = |fit: &TotalFragility| fit.records().dispersion();
    Ok(CountsFragility {
        median: drawn.quantile(&found.fitted.into(), 0.5),
        dispersion: drawn.estimate(own, range, of),
        intervals: Basis::Drawn(drawn.basis),
        ..found
    })
}

/// The fits to the draws of [`fit_outcomes`]: what [`risk`](super::risk())
/// makes an interval of.
///
/// # Errors
/// [`ProcedureError`] for no draws.
pub fn sample_outcomes(
    outcomes: &[RecordOutcome],
    clusters: &Clusters,
    shift: f64,
    draws: Draws,
) -> Result<BootstrapFits, ProcedureError> {
    draws.check()?;
    let known: Vec<usize> = by_record(outcomes).into_keys().collect();
    let clusters = clusters.part(&known);
    let place = |record| known.partition_point(|other| *other < record);
    let is_open = RecordOutcome::stripes(outcomes).is_none();
    let brackets = is_open.then(|| RecordOutcome::brackets(outcomes));
    let fitted = draws.of("counts", &clusters).map(|places| {
        if let Some(brackets) = &brackets {
            let drawn: Vec<_> = places.iter().map(|k| brackets[*k]).collect();
            let law = fit_intervals(&drawn, shift).ok()?.distribution;
            return Some(law.into());
        }
        let counts = multiplicities(places, clusters.records());
        let of = |record| u64::from(counts[place(record)]);
        let law = fit_counts_alone(&counted(outcomes, of), shift).ok()?;
        Some(law.into())
    });
    let basis = IntervalBasis::new(draws, &clusters);
    Ok(BootstrapFits { basis, fitted })
}

impl RecordOutcome {
    /// Whether each record responds at `edp` (peak |theta|/alpha) or above,
    /// at each intensity; by record.
    ///
    /// If some record was not run up to one of them, each record has instead
    /// its own two outcomes: that it does not exceed the level at its last
    /// analysis below its capacity ([`InversionRule::Monotone`]), and does at
    /// the next; or that it does not where its run ends.
    ///
    /// # Errors
    /// [`CapacityError::Level`] for a level that is not positive.
    pub fn from_curves(
        curves: &[ResponseCurve],
        intensities: &[f64],
        edp: f64,
    ) -> Result<Vec<Self>, CapacityError> {
        let mut all = Vec::new();
        let is_run = |curve: &ResponseCurve| {
            intensities.iter().all(|im| curve.edp_at(*im).is_some())
        };
        let all_run = curves.iter().all(is_run);
        for (record, curve) in curves.iter().enumerate() {
            let capacity = curve.capacity(edp, InversionRule::Monotone)?.im();
            let mut put = |im: &f64, exceeded| {
                all.push(Self { im: *im, record, exceeded });
            };
            if all_run {
                let exceeds = |im| curve.edp_at(im) >= Some(edp);
                intensities.iter().for_each(|im| put(im, exceeds(*im)));
                continue;
            }
            let own = curve.vertices().map(|(im, _)| im);
            let own = own.chain(curve.overturning_im());
            let (below, above): (Vec<f64>, Vec<f64>) =
                own.partition(|im| *im < capacity);
            below.last().into_iter().for_each(|im| put(im, false));
            above.first().into_iter().for_each(|im| put(im, true));
        }
        Ok(all)
    }

    /// The counts at each intensity; none if some record has no outcome at
    /// one, since the other outcomes say nothing about it.
    pub fn stripes(outcomes: &[Self]) -> Option<Vec<Stripe>> {
        let stripes = counted(outcomes, |_| 1);
        let each = stripes.len() * by_record(outcomes).len();
        (each == outcomes.len()).then_some(stripes)
    }

    /// What each record, in ascending order, says of its capacity: between the
    /// last intensity at which it did not exceed the level, 0 if there is
    /// none, and the first at which it did, infinite if there is none. If a
    /// record exceeds the level below an intensity at which it does not, its
    /// outcomes are put in order: as many exceed, at the highest intensities.
    ///
    /// ```
    /// use rocking_procedures::counts::RecordOutcome;
    /// let of = |im, exceeded| RecordOutcome { im, record: 0, exceeded };
    /// let known = [of(1.0, false), of(2.0, true), of(3.0, true)];
    /// assert_eq!(RecordOutcome::brackets(&known), [(1.0, 2.0)]);
    /// assert_eq!(RecordOutcome::brackets(&known[..1])[0].0, 1.0);
    /// let back = [of(1.0, true), of(2.0, false), of(3.0, true)];
    /// assert_eq!(RecordOutcome::brackets(&back), [(1.0, 2.0)]);
    /// ```
    pub fn brackets(outcomes: &[Self]) -> Vec<(f64, f64)> {
        let bracket = |own: Vec<&Self>| {
            let mut ims: Vec<f64> = own.iter().map(|one| one.im).collect();
            ims.sort_by(f64::total_cmp);
            let stood = own.iter().filter(|one| !one.exceeded).count();
            let low = if stood > 0 { ims[stood - 1] } else { 0.0 };
            (low, ims.get(stood).copied().unwrap_or(f64::INFINITY))
        };
        by_record(outcomes).into_values().map(bracket).collect()
    }
}

/// The outcomes of each record.
fn by_record(
    outcomes: &[RecordOutcome],
) -> BTreeMap<usize, Vec<&RecordOutcome>> {
    let mut all: BTreeMap<usize, Vec<&RecordOutcome>> = BTreeMap::new();
    for outcome in outcomes {
        all.entry(outcome.record).or_default().push(outcome);
    }
    all
}

/// The counts of outcomes, each as often as `of` says of its record; stripes
/// in the order in which they come.
fn counted(
    outcomes: &[RecordOutcome],
    of: impl Fn(usize) -> u64,
) -> Vec<Stripe> {
    let mut stripes: Vec<Stripe> = Vec::new();
    let mut places: BTreeMap<u64, usize> = BTreeMap::new();
    for outcome in outcomes {
        // Of 0 and -0 the same.
        let key = (outcome.im + 0.0).to_bits();
        let place = *places.entry(key).or_insert_with(|| {
            stripes.push(Stripe { im: outcome.im, exceeded: 0, n: 0 });
            stripes.len() - 1
        });
        stripes[place].n += of(outcome.record);
        if outcome.exceeded {
            stripes[place].exceeded += of(outcome.record);
        }
    }
    stripes.retain(|stripe| stripe.n > 0);
    stripes
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{FitOptions, fit_sample};
    use libm::exp;
    use rocking_statistics::normal;

    /// Of 2000 records whose capacities are the quantiles of a lognormal with
    /// median 2 and dispersion 0.8, every other one is run to 1.8 only.
    #[test]
    fn records_that_stand_where_their_run_ends_do_not_bias_the_fit() {
        let curve = |k: u32| {
            let p = (f64::from(k / 2) + 0.5) / 1000.0;
            let capacity = 2.0 * exp(0.8 * normal::quantile(p));
            let falls = k.is_multiple_of(2) || capacity <= 1.8;
            let last = if falls { 0.999 * capacity } else { 1.8 };
            let vertices = [(0.01, 0.0), (last, 0.5)];
            ResponseCurve::try_new(&vertices, falls.then_some(capacity))
        };
        let curves: Vec<ResponseCurve> =
            (0..2000).map(|k| curve(k).unwrap()).collect();
        let inf = f64::INFINITY;
        let sample =
            crate::capacities::sample(&curves, inf, InversionRule::Median);
        let exact =
            fit_sample(&sample.unwrap(), &FitOptions::default()).unwrap();
        let records = Clusters::singletons(2000);
        // With and without an intensity up to which each record was run.
        for first in [1, 9] {
            let levels: Vec<f64> =
                (first..25).map(|k| 0.25 * f64::from(k)).collect();
            let outcomes =
                RecordOutcome::from_curves(&curves, &levels, inf).unwrap();
            let found = fit_outcomes(&outcomes, &records, 0.0, None).unwrap();
            assert_eq!((found.n, found.open), (outcomes.len(), 552));
            assert_eq!(RecordOutcome::stripes(&outcomes), None);
            for fitted in [found.fitted, exact.fitted] {
                let (median, beta) = (fitted.median(), fitted.dispersion());
                let near = (median / 2.0 - 1.0).abs() < 0.01
                    && (beta / 0.8 - 1.0).abs() < 0.02;
                assert!(near, "{first}: median {median}, dispersion {beta}");
            }
        }
    }
}
