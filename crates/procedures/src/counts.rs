//! Fragilities fitted to counts of stripes.

use std::collections::BTreeMap;
use std::fmt;

use super::fit::BootstrapFits;
use super::{Draws, LEVEL, ProcedureError};
use rocking::capacity::ResponseCurve;
use rocking_statistics::bootstrap::{Bootstrap, BootstrapEstimate};
use rocking_statistics::lognormal::{Stripe, fit_counts, fit_counts_alone};
use rocking_statistics::resampling::multiplicities;
use rocking_statistics::{Clusters, Estimate, Lognormal};

/// A lognormal fragility fitted to counts, with intervals.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct CountsFragility {
    /// Records run, over all stripes.
    pub n: usize,
    /// The fitted distribution, in the unit of the stripes.
    pub fitted: Lognormal,
    /// Level of the intervals.
    pub level: f64,
    /// What the intervals rest on.
    #[cfg_attr(feature = "serde", serde(serialize_with = "super::name"))]
    pub intervals: Basis,
    /// Median with its interval; an end is open where the likelihood does not
    /// fall so far. No interval where a draw in twenty has no fit.
    pub median: Estimate,
    /// Dispersion with its interval.
    pub dispersion: Estimate,
    /// Log-likelihood of the binomial counts.
    pub log_likelihood: Option<f64>,
    /// Pearson's chi-squared.
    pub chi_squared: f64,
    /// Stripes less two.
    pub degrees_of_freedom: usize,
}

/// What the intervals of a fit to counts rest on.
#[derive(Clone, Debug, PartialEq)]
pub enum Basis {
    /// The likelihood of independent stripes: counts alone do not tell
    /// whether stripes share records.
    IndependentStripes,
    /// A bootstrap: each draw holds its records in all stripes.
    Drawn(Draws, Clusters),
}

impl fmt::Display for Basis {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::IndependentStripes => {
                f.write_str("likelihood, stripes as independent")
            }
            Self::Drawn(draws, clusters) => write!(
                f,
                "bootstrap, {} draws of seed {}, {clusters}",
                draws.replicates, draws.seed
            ),
        }
    }
}

/// What became of a record at an intensity.
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
        n: found.fit.n,
        fitted: found.fit.distribution,
        level: LEVEL,
        intervals: Basis::IndependentStripes,
        median: found.median,
        dispersion: found.dispersion,
        log_likelihood: found.fit.log_likelihood,
        chi_squared: found.chi_squared,
        degrees_of_freedom: found.degrees_of_freedom,
    })
}

/// Fits a lognormal fragility above `shift` to stripes of the same records,
/// as [`fit_stripes`] does. The intervals are those of a bootstrap that draws
/// the earthquakes of the records, and keeps each record in all its stripes;
/// a record without an outcome is left out.
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
/// let found = fit_outcomes(&outcomes, &records, 0.0, draws)?;
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
    draws: Draws,
) -> Result<CountsFragility, ProcedureError> {
    let found = fit_stripes(&RecordOutcome::stripes(outcomes, |_| 1), shift)?;
    let drawn = sample_outcomes(outcomes, clusters, shift, draws)?;
    let estimate = |of: fn(&Lognormal) -> f64, point| {
        let enough = |e: &BootstrapEstimate| 20 * e.used >= 19 * e.replicates;
        let found = drawn.estimate(point, of).filter(enough);
        found.map_or(Estimate::exact(point), |found| found.estimate)
    };
    Ok(CountsFragility {
        median: estimate(Lognormal::median, found.median.value()),
        dispersion: estimate(Lognormal::dispersion, found.dispersion.value()),
        intervals: Basis::Drawn(draws, drawn.clusters),
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
    let mut known: Vec<usize> = outcomes.iter().map(|o| o.record).collect();
    known.sort_unstable();
    known.dedup();
    let clusters = clusters.part(&known);
    let place = |record| known.partition_point(|other| *other < record);
    let Draws { replicates, seed } = draws;
    let all = Bootstrap::of_clusters("counts", seed, &clusters, replicates);
    let fitted = all.map(|places| {
        let counts = multiplicities(places, clusters.records());
        let of = |record| u64::from(counts[place(record)]);
        fit_counts_alone(&RecordOutcome::stripes(outcomes, of), shift).ok()
    });
    Ok(BootstrapFits { draws, clusters, fitted })
}

impl RecordOutcome {
    /// Whether each record responds at `edp` (peak |theta|/alpha) or above,
    /// at each intensity up to which it was run; by record.
    #[must_use]
    pub fn from_curves(
        curves: &[ResponseCurve],
        intensities: &[f64],
        edp: f64,
    ) -> Vec<Self> {
        let of = |(record, curve): (usize, &ResponseCurve)| {
            let at = |&im: &f64| {
                let exceeded = curve.edp_at(im)? >= edp;
                Some(Self { im, record, exceeded })
            };
            intensities.iter().filter_map(at).collect::<Vec<_>>()
        };
        curves.iter().enumerate().flat_map(of).collect()
    }

    /// The counts of outcomes, each as often as `of` says of its record;
    /// stripes in the order in which they come.
    #[must_use]
    pub fn stripes(
        outcomes: &[Self],
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
}
