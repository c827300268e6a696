//! Fitting a lognormal distribution, with a given shift, in named ways.

use std::fmt;
use std::str::FromStr;

use libm::log;
use thiserror::Error;

use super::censored::Observation::{self, Exact, Interval};
use super::censored::{maximise, maximise_together};
use super::{Lognormal, LognormalError, check_shift};
use crate::sample::{mean, sum_of_squares};
use crate::{ExtendedSample, QuantileType};
use rocking::names::{UnknownName, as_text, find};

/// How a lognormal distribution is fitted to y = ln(x - r).
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FitMethod {
    /// Maximum likelihood: mean of y, and standard deviation with divisor n.
    MaximumLikelihood,
    /// Moments: mean of y, and standard deviation with divisor n - 1.
    Moment,
    /// Quantiles of x: mu = ln(x50 - r), beta = half of
    /// ln((x84 - r)/(x16 - r)). The latter is 0.55 % low for a lognormal
    /// (z(0.84) = 0.99446), as Eq. 6 is.
    Quantile(QuantileType),
    /// Moments of the values up to the 95 % quantile of x (closed), as if
    /// they were all: biased low, as a published practice is.
    Trimmed(QuantileType),
    /// Maximum likelihood with the values above the 95 % quantile of x
    /// right-censored at the largest value kept.
    Censored(QuantileType),
}

impl FitMethod {
    /// All of them, their quantiles of this type.
    pub fn all(quantile_type: QuantileType) -> [Self; 5] {
        [
            Self::MaximumLikelihood,
            Self::Moment,
            Self::Trimmed(quantile_type),
            Self::Quantile(quantile_type),
            Self::Censored(quantile_type),
        ]
    }

    /// The name, without the type of quantiles.
    pub fn name(self) -> &'static str {
        match self {
            Self::MaximumLikelihood => "mle",
            Self::Moment => "moment",
            Self::Quantile(_) => "quantile",
            Self::Trimmed(_) => "trimmed",
            Self::Censored(_) => "censored",
        }
    }

    /// The same method, its quantiles of this type.
    pub fn with_quantile_type(self, quantile_type: QuantileType) -> Self {
        let mut all = Self::all(quantile_type).into_iter();
        all.find(|own| own.name() == self.name()).unwrap_or(self)
    }
}

impl fmt::Display for FitMethod {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MaximumLikelihood | Self::Moment => f.write_str(self.name()),
            Self::Quantile(t) | Self::Trimmed(t) | Self::Censored(t) => {
                write!(f, "{} (type {t})", self.name())
            }
        }
    }
}

/// Reads the text of `Display`; a name without a type has the default type of
/// quantiles.
impl FromStr for FitMethod {
    type Err = UnknownName;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let types = (1..=9).filter_map(|n| QuantileType::try_new(n).ok());
        let mut written = types.flat_map(Self::all);
        if let Some(method) = written.find(|m| m.to_string() == text) {
            return Ok(method);
        }
        let all = Self::all(QuantileType::default());
        find("fit method", text, &all, Self::name)
    }
}

as_text!(FitMethod);

/// Why a sample has no fit.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum FitError {
    /// Fewer than two values.
    #[error("{0} values kept: expected at least 2")]
    TooFew(usize),
    /// A value that is not above the shift.
    #[error(
        "value {value} with shift {shift}: expected a value above the shift"
    )]
    NotAboveShift {
        /// The smallest value.
        value: f64,
        /// The shift.
        shift: f64,
    },
    /// Infinite values with a method that needs finite ones.
    #[error(
        "{censored} of {n} values are infinite: this fit needs finite values (the censored one does not)"
    )]
    Infinite {
        /// Number of infinite values.
        censored: usize,
        /// Size of the sample.
        n: usize,
    },
    /// A quantile that the method needs falls on an infinite value.
    #[error(
        "the {percent} % quantile is infinite: {censored} of {n} values are"
    )]
    InfiniteQuantile {
        /// The quantile, in percent.
        percent: f64,
        /// Number of infinite values.
        censored: usize,
        /// Size of the sample.
        n: usize,
    },
    /// Each value is only known to be above a limit.
    #[error("all {0} values are censored: expected at least one that is not")]
    AllCensored(usize),
    /// All values are equal, to rounding.
    #[error("the logarithms do not vary: expected distinct values")]
    Degenerate,
    /// A single number is compatible with every value.
    #[error(
        "all {n} values, censored ones included, may be {value}: expected values that determine a dispersion"
    )]
    OneValue {
        /// The number.
        value: f64,
        /// Number of values.
        n: usize,
    },
    /// An interval that is empty, or not above the shift.
    #[error(
        "interval {number}, from {low} to {high}: expected low <= high, above the shift"
    )]
    Interval {
        /// Place of the interval, from 1.
        number: usize,
        /// Its lower end.
        low: f64,
        /// Its upper end.
        high: f64,
    },
    /// A stripe counts records above no intensity, or more than it has.
    #[error(
        "stripe {number}, {exceeded} of {n} at {im}: expected at most all of at least one record, at a finite intensity above the shift"
    )]
    Stripe {
        /// Place of the stripe, from 1.
        number: usize,
        /// Its intensity.
        im: f64,
        /// Records that exceeded the level.
        exceeded: u64,
        /// Records run.
        n: u64,
    },
    /// No stripe has an exceedance.
    #[error(
        "no record exceeded the level at any intensity: expected a stripe in which some did"
    )]
    NoneExceeded,
    /// No stripe has a record without exceedance.
    #[error(
        "every record exceeded the level at every intensity: expected a stripe in which some did not"
    )]
    AllExceeded,
    /// One stripe has records of both kinds, and parts the others.
    #[error(
        "only the stripe at {im} has both records that exceeded the level and records that did not: expected another such stripe, without which the counts determine no dispersion"
    )]
    OneMixedStripe {
        /// Its intensity.
        im: f64,
    },
    /// One intensity parts all stripes without from all with exceedance.
    #[error(
        "every stripe up to {below} has no exceedance and every one from {above} on only exceedances: expected stripes with both, without which the counts determine no dispersion"
    )]
    Parted {
        /// The highest intensity without exceedance.
        below: f64,
        /// The lowest intensity with exceedances.
        above: f64,
    },
    /// The shares of exceedance do not rise.
    #[error(
        "the shares of records that exceeded the level do not rise with the intensity: expected more exceedances at higher intensities"
    )]
    NotRising,
    /// The likelihood rises up to the sample's smallest value.
    #[error(
        "the likelihood has no maximum over the shift below the smallest value"
    )]
    NoInteriorMaximum,
    /// The likelihood's maximum was not found.
    #[error("censored likelihood: no maximum found in {0} steps")]
    NotConverged(usize),
    /// The fitted parameters make no distribution.
    #[error(transparent)]
    Parameters(#[from] LognormalError),
}

/// A fitted lognormal distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct LognormalFit {
    /// The distribution.
    pub distribution: Lognormal,
    /// Size of the sample, censored values included.
    pub n: usize,
    /// Number of values that entered as such.
    pub n_kept: usize,
    /// Log-likelihood in x: of the censored sample for that method, else of
    /// the whole sample; none if that has infinite values.
    pub log_likelihood: Option<f64>,
}

/// Fits a lognormal distribution above the given shift to a sample.
///
/// ```
/// use rocking_statistics::lognormal::{FitMethod, fit};
/// use rocking_statistics::ExtendedSample;
/// let sample = ExtendedSample::try_new(&[1.5, 2.0, 3.0])?;
/// let ssfl = fit(&sample, 1.0, FitMethod::MaximumLikelihood)?;
/// assert!((ssfl.distribution.median() - 2.0).abs() < 1e-15);
/// let beta = std::f64::consts::LN_2 * (2.0_f64 / 3.0).sqrt();
/// assert!((ssfl.distribution.dispersion() - beta).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FitError`] if a value is not above the shift, the values do not vary,
/// or infinite values meet a method that cannot take them.
pub fn fit(
    sample: &ExtendedSample,
    shift: f64,
    method: FitMethod,
) -> Result<LognormalFit, FitError> {
    let y = shifted_finite(sample, shift)?;
    let (n, censored) = (sample.len(), sample.censored());
    if y.is_empty() {
        return Err(FitError::AllCensored(n));
    }
    let complete = || match censored {
        0 => Ok(y.as_slice()),
        _ => Err(FitError::Infinite { censored, n }),
    };
    let finite_quantile = |quantile_type: QuantileType, p| {
        let percent = 100.0 * p;
        let infinite = FitError::InfiniteQuantile { percent, censored, n };
        quantile_type.finite_quantile(sample, p).ok_or(infinite)
    };
    let mut censored_likelihood = None;
    let (log_mean, dispersion, n_kept) = match method {
        FitMethod::MaximumLikelihood => {
            let (mu, squares) = moments(complete()?)?;
            (mu, (squares / n as f64).sqrt(), n)
        }
        FitMethod::Moment => {
            let (mu, squares) = moments(complete()?)?;
            (mu, (squares / (n as f64 - 1.0)).sqrt(), n)
        }
        FitMethod::Quantile(quantile_type) => {
            let at = |p| finite_quantile(quantile_type, p);
            let (x16, x50, x84) = (at(0.16)?, at(0.5)?, at(0.84)?);
            let beta = 0.5 * log((x84 - shift) / (x16 - shift));
            if beta.is_nan() || beta <= 0.0 {
                return Err(FitError::Degenerate);
            }
            (log(x50 - shift), beta, y.len())
        }
        FitMethod::Trimmed(quantile_type) => {
            let limit = finite_quantile(quantile_type, 0.95)?;
            let kept = sample.finite().partition_point(|&x| x <= limit);
            let (mu, squares) = moments(&y[..kept])?;
            (mu, (squares / (kept as f64 - 1.0)).sqrt(), kept)
        }
        FitMethod::Censored(quantile_type) => {
            let limit = quantile_type
                .extended_quantile(sample, 0.95)
                .unwrap_or(f64::INFINITY);
            let kept = sample.finite().partition_point(|&x| x <= limit);
            let (centre, squares) = moments(&y[..kept])?;
            let spread = (squares / kept as f64).sqrt();
            let limit = Interval(y[kept - 1], f64::INFINITY, 1.0);
            let mut known: Vec<_> =
                y[..kept].iter().map(|&y| Exact(y)).collect();
            known.resize(n, limit);
            let (mu, beta, value) = maximise(&known, centre, spread)?;
            // In x: the Jacobian of the values known exactly.
            let jacobian = y[..kept].iter().fold(0.0, |sum, y| sum + y);
            censored_likelihood = Some(value - jacobian);
            (mu, beta, kept)
        }
    };
    let distribution = Lognormal::try_new(shift, log_mean, dispersion)?;
    let log_likelihood = match method {
        FitMethod::Censored(_) => censored_likelihood,
        _ => (censored == 0)
            .then(|| distribution.log_likelihood(sample.sorted())),
    };
    Ok(LognormalFit { distribution, n, n_kept, log_likelihood })
}

/// Fits a lognormal distribution above the shift by maximum likelihood to
/// values known by intervals (low, high]: sum of ln[F(high) - F(low)], with
/// ln f(x) for a value known exactly, whose interval is (x, x).
///
/// Such intervals come from a scan of a grid for an overturning intensity,
/// without taking an end or the middle for it, and from records that were run
/// only up to a limit, (limit, infinity). `low` up to the shift means "below
/// high". An interval from the shift or below it to infinity gives no
/// information: it is left out, and `n - n_kept` counts those. The
/// log-likelihood is of the intervals, in x (R: `survival::survreg(Surv(low,
/// high, type = "interval2") ~ 1, dist = "lognormal")`).
///
/// ```
/// use rocking_statistics::lognormal::fit_intervals;
/// let intervals: Vec<(f64, f64)> = [(1.0, 1.2), (1.2, 1.4), (1.4, 1.6)]
///     .repeat(5);
/// let fit = fit_intervals(&intervals, 1.0)?;
/// assert!((fit.distribution.median() - 1.28).abs() < 0.02);
/// # Ok::<(), rocking_statistics::lognormal::FitError>(())
/// ```
///
/// # Errors
/// [`FitError`] for an interval that is empty or not above the shift, fewer
/// than two that give information, or if all of those have a point in common.
pub fn fit_intervals(
    intervals: &[(f64, f64)],
    shift: f64,
) -> Result<LognormalFit, FitError> {
    Ok(fit_intervals_together(&[intervals], shift)?[0])
}

/// Fits lognormal distributions of one dispersion above one shift to samples
/// by maximum likelihood, each sample with its own median; its log-likelihood
/// is of its own intervals, as in [`fit_intervals`].
///
/// ```
/// use rocking_statistics::lognormal::fit_intervals_together;
/// // Twice the values of the first: ln 2 between the means.
/// let [first, other] = [[1.0, 2.0, 4.0], [2.0, 4.0, 8.0]]
///     .map(|all| all.map(|x| (x, x)));
/// let fits = fit_intervals_together(&[&first, &other], 0.0)?;
/// let ratio = fits[1].distribution.median() / fits[0].distribution.median();
/// assert!((ratio - 2.0).abs() < 1e-12);
/// # Ok::<(), rocking_statistics::lognormal::FitError>(())
/// ```
///
/// # Errors
/// [`FitError`] as of [`fit_intervals`], for any of the samples.
pub fn fit_intervals_together(
    samples: &[&[(f64, f64)]],
    shift: f64,
) -> Result<Vec<LognormalFit>, FitError> {
    let known = samples.iter().map(|own| known_logarithms(own, shift));
    let known = known.collect::<Result<Vec<_>, _>>()?;
    let count: usize = known.iter().map(|own| own.1.len()).sum();
    let squares: f64 = known.iter().map(|own| sum_of_squares(&own.1)).sum();
    let spread = (squares / count as f64).sqrt().max(1e-3);
    let groups = known.iter().map(|(all, y, _)| (all.as_slice(), mean(y)));
    let groups: Vec<_> = groups.collect();
    let (found, dispersion) = maximise_together(&groups, spread)?;
    let fit = |(k, (log_mean, value)): (usize, (f64, f64))| {
        let (all, _, jacobian) = &known[k];
        Ok(LognormalFit {
            distribution: Lognormal::try_new(shift, log_mean, dispersion)?,
            n: samples[k].len(),
            n_kept: all.len(),
            log_likelihood: Some(value - jacobian),
        })
    };
    found.into_iter().enumerate().map(fit).collect()
}

/// Observations of the logarithms above the shift; their middles, or one end
/// of those open to a side; and the sum of those known exactly.
type KnownLogarithms = (Vec<Observation>, Vec<f64>, f64);

fn known_logarithms(
    intervals: &[(f64, f64)],
    shift: f64,
) -> Result<KnownLogarithms, FitError> {
    check_shift(shift)?;
    let logarithm = |x: f64| {
        if x <= shift { f64::NEG_INFINITY } else { log(x - shift) }
    };
    let (mut known, mut middles) = (Vec::new(), Vec::new());
    let (mut highest_low, mut lowest_high) = (0.0_f64, f64::INFINITY);
    let mut jacobian = 0.0;
    for (i, &(low, high)) in intervals.iter().enumerate() {
        let exact = low == high && high.is_finite();
        if !((low < high || exact) && high > shift) {
            return Err(FitError::Interval { number: i + 1, low, high });
        }
        if low <= shift && high == f64::INFINITY {
            continue;
        }
        (highest_low, lowest_high) =
            (highest_low.max(low), lowest_high.min(high));
        let (low, high) = (logarithm(low), logarithm(high));
        if exact {
            jacobian += low;
            known.push(Exact(low));
        } else {
            known.push(Interval(low, high, 1.0));
        }
        middles.push(match (low.is_finite(), high.is_finite()) {
            (true, true) => 0.5 * (low + high),
            (true, false) => low,
            _ => high,
        });
    }
    let n_kept = known.len();
    if n_kept < 2 {
        return Err(FitError::TooFew(n_kept));
    }
    if lowest_high == f64::INFINITY {
        return Err(FitError::AllCensored(n_kept));
    }
    // A point in or at the end of all of them would be a maximum with no
    // dispersion.
    if highest_low <= lowest_high {
        let value = lowest_high;
        return Err(FitError::OneValue { value, n: n_kept });
    }
    Ok((known, middles, jacobian))
}

/// ln(x - shift) of the finite values, ascending.
///
/// # Errors
/// [`FitError::NotAboveShift`] if one is not above the shift, or
/// [`LognormalError::Shift`] inside [`FitError::Parameters`].
pub fn shifted_finite(
    sample: &ExtendedSample,
    shift: f64,
) -> Result<Vec<f64>, FitError> {
    check_shift(shift)?;
    let finite = sample.finite();
    match finite.first() {
        Some(&value) if value <= shift => {
            Err(FitError::NotAboveShift { value, shift })
        }
        _ => Ok(finite.iter().map(|x| log(x - shift)).collect()),
    }
}

/// Mean and sum of squared deviations of values that vary.
fn moments(y: &[f64]) -> Result<(f64, f64), FitError> {
    if y.len() < 2 {
        return Err(FitError::TooFew(y.len()));
    }
    let (mu, squares) = (mean(y), sum_of_squares(y));
    let deviation = (squares / (y.len() as f64 - 1.0)).sqrt();
    if !(deviation > 1e-12 * mu.abs() && y[0] < y[y.len() - 1]) {
        return Err(FitError::Degenerate);
    }
    Ok((mu, squares))
}
