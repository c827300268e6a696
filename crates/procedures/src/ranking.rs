//! Intensity measures side by side: efficiency and sufficiency.

use libm::log;

use super::fit::{IntervalBasis, check_length};
use super::{Draws, ProcedureError};
use rocking_statistics::bootstrap::BootstrapEstimate;
use rocking_statistics::lognormal::fit_intervals;
use rocking_statistics::regression::{Line, mixed};
use rocking_statistics::{Clusters, Range};

/// An intensity measure, and its values of the records of a suite.
#[derive(Clone, Debug, PartialEq)]
pub struct CandidateMeasure {
    /// Its name.
    pub im: String,
    /// Its value for each record, scaled to PGA/(g tan alpha) = 1.
    pub at_uplift: Vec<f64>,
    /// Whether it is proportional to the square of the acceleration, as Arias
    /// intensity is; then its root is ranked.
    pub squared: bool,
}

/// A property of the records that an intensity measure may leave out.
#[derive(Clone, Debug, PartialEq)]
pub struct Covariate {
    /// Its name, such as `magnitude` or `ln distance`.
    pub name: String,
    /// One value a record.
    pub values: Vec<f64>,
}

impl Covariate {
    /// Magnitudes.
    pub fn magnitude(values: Vec<f64>) -> Self {
        Self { name: "magnitude".into(), values }
    }

    /// The logarithms of distances.
    pub fn ln_distance(distances: Vec<f64>) -> Self {
        let values = distances.into_iter().map(log).collect();
        Self { name: "ln distance".into(), values }
    }
}

/// Intensity measures in the requested order.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Ranking {
    /// Number of records.
    pub n: usize,
    /// Records that do not reach the level; they enter by the intensity up
    /// to which they were run.
    pub censored: usize,
    /// Basis of the intervals: the same draws for all measures.
    #[serde(flatten)]
    pub basis: IntervalBasis,
    /// Why there is no slope although a covariate was given.
    pub no_slope: Option<String>,
    /// The measures.
    pub measures: Vec<MeasureRank>,
}

/// Results for one intensity measure.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct MeasureRank {
    /// Its name, after `root of` if its root is ranked.
    pub im: String,
    /// Median of the capacities, in the unit of the measure.
    pub median: f64,
    /// Dispersion of the capacities: the efficiency, small is good.
    pub dispersion: BootstrapEstimate,
    /// Dispersion over the dispersion of the first measure.
    pub ratio_to_first: BootstrapEstimate,
    /// Slopes of ln(capacity) on each covariate: the sufficiency, a small
    /// p-value is bad.
    pub slopes: Vec<Slope>,
}

/// A slope on a covariate.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Slope {
    /// The covariate.
    pub on: String,
    /// The line: with a random intercept for each earthquake, by least squares
    /// if no earthquake has two records.
    #[serde(flatten)]
    pub line: Line,
}

/// Ranks intensity measures by the capacities of a suite.
///
/// `capacities` holds one interval a record, in PGA/(g tan alpha): both ends
/// equal if the record reaches the level, (limit, infinity) if it was run up
/// to the limit and did not. The capacity in another measure is its value at
/// that scale. Efficiency is the dispersion of a lognormal fitted by maximum
/// likelihood, censored records by their limits (Luco and Cornell, Earthquake
/// Spectra 23 (2007) 357); sufficiency is the slope of ln(capacity) on a
/// covariate, if no record is censored, with a random intercept for each
/// earthquake ([`mixed`]). `clusters` are the earthquakes of the records:
/// these are drawn.
///
/// ```
/// use rocking_procedures::{Draws, ranking::{CandidateMeasure, rank}};
/// use rocking_statistics::Clusters;
/// let capacities = [(1.0, 1.0), (2.0, 2.0), (4.0, f64::INFINITY)];
/// let pga = CandidateMeasure {
///     im: "pga".into(),
///     at_uplift: vec![1.0; 3],
///     squared: false,
/// };
/// let draws = Draws { replicates: 100, seed: 0 };
/// let records = Clusters::singletons(3);
/// let found = rank(&capacities, &[pga], &[], &records, draws)?;
/// assert_eq!((found.n, found.censored), (3, 1));
/// # Ok::<(), rocking_procedures::ProcedureError>(())
/// ```
///
/// # Errors
/// [`ProcedureError`] for a measure or covariate of another length than the
/// capacities, and for capacities that make no fit.
pub fn rank(
    capacities: &[(f64, f64)],
    candidates: &[CandidateMeasure],
    covariates: &[Covariate],
    clusters: &Clusters,
    draws: Draws,
) -> Result<Ranking, ProcedureError> {
    draws.check()?;
    let n = capacities.len();
    for candidate in candidates {
        check_length(&candidate.im, candidate.at_uplift.len(), n)?;
    }
    for covariate in covariates {
        check_length(&covariate.name, covariate.values.len(), n)?;
    }
    check_length("earthquakes", clusters.records(), n)?;
    let own = |candidate: &CandidateMeasure| -> Vec<(f64, f64)> {
        let root = |x: f64| if candidate.squared { x.sqrt() } else { x };
        let all = capacities.iter().zip(&candidate.at_uplift);
        all.map(|((low, high), factor)| {
            (root(*factor) * low, root(*factor) * high)
        })
        .collect()
    };
    let all: Vec<Vec<(f64, f64)>> = candidates.iter().map(own).collect();
    let censored = capacities.iter().filter(|c| c.1.is_infinite()).count();
    let dispersion = |capacities: &[(f64, f64)]| {
        let fit = fit_intervals(capacities, 0.0);
        fit.map_or(f64::NAN, |fit| fit.distribution.dispersion())
    };
    let drawn = draws.of("rank", clusters).map(|places| {
        let pick = |capacities: &Vec<(f64, f64)>| {
            let own: Vec<_> = places.iter().map(|&i| capacities[i]).collect();
            dispersion(&own)
        };
        all.iter().map(pick).collect::<Vec<f64>>()
    });
    let basis = IntervalBasis::new(draws, clusters);
    let positive =
        |value, drawn: &[f64]| basis.value(value, drawn, Range::NotNegative);
    let first = all.first().map_or(f64::NAN, |first| dispersion(first));
    let measure = |(i, candidate): (usize, &CandidateMeasure)| {
        let root = if candidate.squared { "root of " } else { "" };
        let im = format!("{root}{}", candidate.im);
        let fit = fit_intervals(&all[i], 0.0).map_err(|source| {
            ProcedureError::Measure { im: im.clone(), source }
        })?;
        let point = fit.distribution.dispersion();
        let column: Vec<f64> = drawn.iter().map(|row| row[i]).collect();
        let ratios: Vec<f64> =
            drawn.iter().map(|row| row[i] / row[0]).collect();
        let slope = |covariate: &Covariate| {
            let y: Vec<f64> = all[i].iter().map(|c| log(c.0)).collect();
            let on = covariate.name.clone();
            Ok(Slope { on, line: mixed(&covariate.values, &y, clusters)? })
        };
        let used = covariates.iter().filter(|_| censored == 0);
        Ok(MeasureRank {
            im,
            median: fit.distribution.median(),
            dispersion: positive(point, &column),
            ratio_to_first: positive(point / first, &ratios),
            slopes: used.map(slope).collect::<Result<_, ProcedureError>>()?,
        })
    };
    let measures = candidates.iter().enumerate().map(measure);
    let measures = measures.collect::<Result<_, ProcedureError>>()?;
    let no_slope = (censored > 0 && !covariates.is_empty()).then(|| {
        format!("no slopes: {censored} censored capacities have no value")
    });
    Ok(Ranking { n, censored, basis, no_slope, measures })
}
