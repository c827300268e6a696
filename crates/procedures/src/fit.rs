//! Fragilities fitted to samples of capacities.

mod draws;
mod intervals;
mod levels;
mod precision;
mod remark;

use std::fmt;
use std::str::FromStr;

use thiserror::Error;

pub use draws::Draws;
pub(crate) use draws::check_length;
pub use intervals::{Band, BandPoint, FitIntervals, IntervalBasis};
pub use levels::{DispersionRule, LevelFit, fit_levels};
pub use precision::SampleSize;
pub use remark::FitRemark;

use self::intervals::refitted;
use self::levels::{law, resampled};
use crate::fragility::total::TotalFragility;
use crate::fragility::{FragilityError, c_max, eq5, eq6, eq7};
use rocking::capacity::CapacityError;
use rocking::stop;
use rocking_statistics::lilliefors::LillieforsError;
use rocking_statistics::lognormal::{
    FitError, FitMethod, LognormalError, LognormalFit, profile_shift,
};
use rocking_statistics::regression::RegressionError;
use rocking_statistics::{
    CensoredSample, Clusters, Estimate, Interval, Lognormal, QuantileType,
    Range, SampleError, normal,
};

/// The shift IM_R of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shift {
    /// This non-negative number.
    Given(f64),
    /// The smallest value of the sample; it is left out of the fit.
    Smallest,
    /// The shift of the highest profile likelihood.
    Free,
}

/// A text that gives no valid shift.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error("found `{0}`: expected a non-negative number, `min` or `free`")]
pub struct ShiftError(String);

impl FromStr for Shift {
    type Err = ShiftError;

    fn from_str(text: &str) -> Result<Self, ShiftError> {
        match text {
            "min" => Ok(Self::Smallest),
            "free" => Ok(Self::Free),
            number => {
                let shift = number.parse().ok();
                let shift = shift.filter(|x: &f64| *x >= 0.0 && x.is_finite());
                shift
                    .map(Self::Given)
                    .ok_or_else(|| ShiftError(number.to_owned()))
            }
        }
    }
}

impl fmt::Display for Shift {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Given(shift) => write!(f, "{shift}"),
            Self::Smallest => f.write_str("min"),
            Self::Free => f.write_str("free"),
        }
    }
}

impl Shift {
    /// The shift for a sample, and the values that are fitted above it: all
    /// but the smallest for [`Shift::Smallest`].
    ///
    /// # Errors
    /// [`FitError`] if the likelihood has no maximum over a free shift.
    pub fn split(
        self,
        sample: &CensoredSample,
    ) -> Result<(f64, CensoredSample), FitError> {
        Ok(match self {
            Self::Given(shift) => (shift, sample.clone()),
            Self::Smallest => sample.above_smallest(),
            Self::Free => {
                let found = profile_shift(&sample.extended())?;
                (found.fit.distribution.shift(), sample.clone())
            }
        })
    }
}

/// Options of a fit: method, shift, quantile type, bootstrap and band.
#[derive(Clone, Debug, PartialEq)]
pub struct FitOptions {
    /// How the lognormal distribution is fitted.
    pub method: FitMethod,
    /// The shift IM_R.
    pub shift: Shift,
    /// Samples of the same records that share one dispersion, including the
    /// fitted one; empty if each sample has its own dispersion.
    pub family: Vec<CensoredSample>,
    /// Type of the sample's quantiles.
    pub quantile_type: QuantileType,
    /// Constant c of Eq. 7.
    pub c: f64,
    /// Bootstrap for the intervals; `None` for no intervals.
    pub draws: Option<Draws>,
    /// Earthquakes of the sample's values, which the bootstrap then draws;
    /// `None` draws records.
    pub clusters: Option<Clusters>,
    /// Intensities of the probability band, in the unit of the sample; needs
    /// `draws`.
    pub band: Vec<f64>,
}

impl Default for FitOptions {
    /// Maximum likelihood without a shift, quantiles of type 5, c = 1, no
    /// intervals.
    fn default() -> Self {
        Self {
            method: FitMethod::MaximumLikelihood,
            shift: Shift::Given(0.0),
            family: Vec::new(),
            quantile_type: QuantileType::default(),
            c: 1.0,
            draws: None,
            clusters: None,
            band: Vec::new(),
        }
    }
}

/// Reasons for which a procedure rejects a sample or its options.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProcedureError {
    /// The sample has no fit.
    #[error(transparent)]
    Fit(#[from] FitError),
    /// The values are no valid sample.
    #[error(transparent)]
    Sample(#[from] SampleError),
    /// A curve that has no capacity at a level.
    #[error(transparent)]
    Capacity(#[from] CapacityError),
    /// The points determine no line.
    #[error(transparent)]
    Line(#[from] RegressionError),
    /// Capacities in one measure that have no fit.
    #[error("{im}: {source}")]
    Measure {
        /// The intensity measure.
        im: String,
        /// Why there is no fit.
        source: FitError,
    },
    /// The number of values differs from the number of records.
    #[error("{name}: {found} values: expected {expected}, one a record")]
    Length {
        /// The quantity with the wrong length.
        name: String,
        /// Its length.
        found: usize,
        /// Number of records.
        expected: usize,
    },
    /// No record was run up to this intensity.
    #[error("intensity {0}: no record was run up to it")]
    NotRun(f64),
    /// An EDP level that is not positive.
    #[error("EDP level {0}: expected a positive number, or inf")]
    EdpLevel(f64),
    /// The test rejects its input.
    #[error(transparent)]
    Test(#[from] LillieforsError),
    /// A level of a test.
    #[error("level {0}: expected a number between 0 and 1")]
    Level(f64),
    /// A free shift with a normality test: a third fitted parameter changes
    /// the null distribution.
    #[error("a free shift: expected a non-negative number, or min")]
    FreeShiftTested,
    /// A free shift with another method than maximum likelihood.
    #[error("shift free with method {0}: expected the method mle")]
    FreeShift(FitMethod),
    /// A common dispersion with an unsuitable method or shift.
    #[error(
        "dispersion common with method {0} and shift {1}: expected the method \
         mle and a number"
    )]
    Common(FitMethod, Shift),
    /// A family without the fitted sample.
    #[error("dispersion common: expected the samples of one IDA")]
    OtherFamily,
    /// A bootstrap with the smallest value as the shift.
    #[error(
        "a bootstrap with shift min: a bootstrap of the smallest value gives \
         no valid interval, its 95 % interval contains the dispersion in only \
         one sample of five; expected a known shift, such as 1"
    )]
    SmallestDrawn,
    /// A bootstrap with a free shift, which has a likelihood interval.
    #[error(
        "a bootstrap with shift free: expected no bootstrap, since the \
         likelihood gives the interval of the shift"
    )]
    FreeDrawn,
    /// Censored values with individual limits, which leave the smallest value
    /// unknown.
    #[error(
        "{0} values censored at individual limits with shift min: expected a \
         known shift, such as 1"
    )]
    SmallestLimited(usize),
    /// A number of draws out of range.
    #[error("a bootstrap of {0} samples: expected 2 to 1000000")]
    Replicates(usize),
    /// A band without a bootstrap.
    #[error(
        "a band without a bootstrap: expected a number of samples to draw"
    )]
    BandWithoutDraws,
}

/// A lognormal fragility fitted to a sample, and the result of the unshifted
/// statistics beside it.
///
/// All intensities are in the unit of the sample.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct FragilityFit {
    /// Size of the sample, censored values included.
    pub n: usize,
    /// Uncensored values in the fit.
    pub n_kept: usize,
    /// Censored values.
    pub n_censored: usize,
    /// Censored values whose limit is known.
    pub n_limited: usize,
    /// Values left out of the fit because they equal the shift `min`.
    pub n_left_out: usize,
    /// Weaknesses of the fit.
    pub remarks: Vec<FitRemark>,
    /// Method of the fit.
    pub method: FitMethod,
    /// The fitted distribution (SSFL with a shift, USFL without).
    pub fitted: Lognormal,
    /// 95 % likelihood interval of a free shift.
    pub shift_interval: Option<ShiftInterval>,
    /// Log-likelihood of the fit; none if the method has none.
    pub log_likelihood: Option<f64>,
    /// Kolmogorov distance to the sample; none for values with limits.
    pub ks_distance: Option<f64>,
    /// Mean distance in probability to the sample.
    pub area_distance: Option<f64>,
    /// Type of the sample's quantiles.
    pub quantile_type: u8,
    /// 16 % quantile of the sample; none if censoring leaves it open.
    pub im16: Option<f64>,
    /// Median of the sample.
    pub im50: Option<f64>,
    /// 84 % quantile of the sample.
    pub im84: Option<f64>,
    /// The fit by the same method without a shift (USFL).
    pub unshifted: Option<Lognormal>,
    /// Eqs. 5 to 7 applied to the unshifted statistics.
    pub transformed: Transformation,
    /// Number of records needed for a precision; none if censored values of
    /// shared earthquakes leave the design effect open.
    pub needed: Option<SampleSize>,
    /// Bootstrap intervals, if draws were requested.
    pub bootstrap: Option<FitIntervals>,
    /// Probabilities with their band, if requested.
    pub band: Option<Band>,
}

/// The likelihood interval of a shift.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct ShiftInterval {
    /// Its high end is open if the likelihood rises towards the smallest
    /// value.
    #[serde(flatten)]
    pub interval: Interval,
    /// Level of the interval.
    pub level: f64,
}

/// Eqs. 5 to 7 of unshifted statistics; none if a number is not known.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Transformation {
    /// The shift IM_R.
    pub shift: f64,
    /// The constant c of Eq. 7.
    pub c: f64,
    /// Upper limit of c in Eq. 7.
    pub c_max: Option<f64>,
    /// Eq. 5 of the median.
    #[serde(serialize_with = "super::if_known")]
    pub eq5: Option<Result<f64, FragilityError>>,
    /// Eq. 6 of the 16 and 84 % quantiles.
    #[serde(serialize_with = "super::if_known")]
    pub eq6: Option<Result<f64, FragilityError>>,
    /// Eq. 7 of the median and the dispersion.
    #[serde(serialize_with = "super::if_known")]
    pub eq7: Option<Result<f64, FragilityError>>,
}

impl Transformation {
    /// Eqs. 5 to 7 of an unshifted median and dispersion, and of unshifted
    /// 16 and 84 % quantiles, above `shift`, all intensities in one unit.
    pub fn new(
        (median, dispersion): (Option<f64>, Option<f64>),
        (im16, im84): (Option<f64>, Option<f64>),
        shift: f64,
        c: f64,
    ) -> Self {
        let both = median.zip(dispersion);
        Self {
            shift,
            c,
            c_max: both.and_then(|(m, beta)| c_max(m, beta, shift).ok()),
            eq5: median.map(|median| eq5(median, shift)),
            eq6: im16.zip(im84).map(|(low, high)| eq6(low, high, shift)),
            eq7: both.map(|(median, beta)| eq7(median, beta, shift, c)),
        }
    }
}

/// The distributions fitted to the draws of a sample.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct BootstrapFits {
    /// Basis of their intervals.
    pub basis: IntervalBasis,
    /// One per draw; `None` if the draw has no fit.
    pub fitted: Vec<Option<TotalFragility>>,
}

impl BootstrapFits {
    /// A number of a fit, `value` for the sample itself, with the 95 %
    /// interval of these draws if they give one.
    pub(crate) fn estimate(
        &self,
        value: f64,
        range: Range,
        number: impl Fn(&TotalFragility) -> f64,
    ) -> Estimate {
        let of = |fit: &Option<TotalFragility>| {
            stop::point();
            fit.as_ref().map_or(f64::NAN, &number)
        };
        let drawn: Vec<f64> = self.fitted.iter().map(of).collect();
        self.basis.value(value, &drawn, range).estimate
    }

    /// The quantile of a fit at probability p with the 95 % interval of these
    /// draws, symmetric in its logarithm above the common shift.
    pub(crate) fn quantile(
        &self,
        fitted: &TotalFragility,
        p: f64,
    ) -> Estimate {
        let z = normal::quantile(p);
        let shift = |fit: &TotalFragility| fit.closed().map(|law| law.shift());
        let own = shift(fitted);
        let same = self.fitted.iter().flatten().all(|fit| shift(fit) == own);
        let above = own.filter(|_| same);
        let of = |fit: &TotalFragility| match (above, fit.closed()) {
            (Some(_), Some(law)) => {
                f64::mul_add(law.dispersion(), z, law.log_mean())
            }
            _ => libm::log(fit.quantile(p)),
        };
        let found = self.estimate(of(fitted), Range::Real, of);
        found.map(|y| above.unwrap_or(0.0) + libm::exp(y))
    }

    /// Rescales every fit; one old unit is `factor` new units.
    ///
    /// # Errors
    /// [`LognormalError`] for a factor that is no positive number.
    pub fn scaled(mut self, factor: f64) -> Result<Self, LognormalError> {
        for fitted in self.fitted.iter_mut().flatten() {
            *fitted = fitted.scaled(factor)?;
        }
        Ok(self)
    }
}

/// One fit of one sample; each replicate of a bootstrap repeats it.
struct SampleFit {
    fit: LognormalFit,
    unshifted: Option<Lognormal>,
    transformed: Transformation,
    left_out: usize,
}

impl FitOptions {
    fn check(&self, sample: &CensoredSample) -> Result<(), ProcedureError> {
        let mle = FitMethod::MaximumLikelihood;
        let is_given = matches!(self.shift, Shift::Given(_));
        if !self.family.is_empty() {
            if self.method != mle || !is_given {
                return Err(ProcedureError::Common(self.method, self.shift));
            }
            let same = |own: &CensoredSample| own.len() == sample.len();
            if !(self.family.contains(sample) && self.family.iter().all(same))
            {
                return Err(ProcedureError::OtherFamily);
            }
        }
        if self.shift == Shift::Free && self.method != mle {
            return Err(ProcedureError::FreeShift(self.method));
        }
        if self.shift == Shift::Smallest && sample.limited() > 0 {
            let limited = sample.limited();
            return Err(ProcedureError::SmallestLimited(limited));
        }
        if let Some(clusters) = &self.clusters {
            check_length("earthquakes", clusters.records(), sample.len())?;
        }
        match (self.draws, self.shift) {
            (None, _) if !self.band.is_empty() => {
                Err(ProcedureError::BandWithoutDraws)
            }
            (None, _) => Ok(()),
            (Some(_), Shift::Smallest) => Err(ProcedureError::SmallestDrawn),
            (Some(_), Shift::Free) => Err(ProcedureError::FreeDrawn),
            (Some(draws), _) => draws.check(),
        }
    }

    /// The distributions fitted to the draws of a sample; `None` if the
    /// options have no draws.
    ///
    /// # Errors
    /// As of [`fit_sample`].
    pub fn sampled(
        &self,
        sample: &CensoredSample,
    ) -> Result<Option<BootstrapFits>, ProcedureError> {
        self.check(sample)?;
        let Some(draws) = self.draws else { return Ok(None) };
        let clusters = self.clusters(sample);
        let fitted = draws.of("fragility", &clusters).map(|places| {
            let (shift, above) =
                self.shift.split(&sample.resample(places)).ok()?;
            let family = resampled(&self.family, places);
            let fit = law(&above, &family, shift, self.method).ok()?;
            Some(fit.distribution.into())
        });
        let basis = IntervalBasis::new(draws, &clusters);
        Ok(Some(BootstrapFits { basis, fitted }))
    }

    /// The records of a sample, by earthquake if these are known.
    fn clusters(&self, sample: &CensoredSample) -> Clusters {
        let records = || Clusters::singletons(sample.len());
        self.clusters.clone().unwrap_or_else(records)
    }

    fn once(
        &self,
        sample: &CensoredSample,
        family: &[CensoredSample],
    ) -> Result<SampleFit, FitError> {
        let (shift, above) = self.shift.split(sample)?;
        let fit = law(&above, family, shift, self.method)?;
        let unshifted = law(sample, family, 0.0, self.method).ok();
        let unshifted = unshifted.map(|fit| fit.distribution);
        let own =
            unshifted.map(|own| (own.median(), own.dispersion())).unzip();
        let at = |p| sample.quantile(self.quantile_type, p);
        let quantiles = (at(0.16), at(0.84));
        let transformed = Transformation::new(own, quantiles, shift, self.c);
        let left_out = sample.len() - above.len();
        Ok(SampleFit { fit, unshifted, transformed, left_out })
    }
}

/// Fits a lognormal fragility to a sample of capacities.
///
/// With a shift IM_R, the logarithmic mean and the dispersion are those of the
/// intensities above it (SSFL). The result also has Eqs. 5 to 7 of the
/// unshifted statistics: Eq. 5 and Eq. 7 of the unshifted fit by the same
/// method, Eq. 6 of the sample's 16 and 84 % quantiles.
///
/// ```
/// use rocking_procedures::{FitOptions, Shift, fit_sample};
/// use rocking_statistics::CensoredSample;
/// let sample = CensoredSample::try_new(&[1.5, 2.0, 3.0], &[])?;
/// let shift = Shift::Given(1.0);
/// let options = FitOptions { shift, ..FitOptions::default() };
/// let found = fit_sample(&sample, &options)?;
/// assert!((found.fitted.median() - 2.0).abs() < 1e-15);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`ProcedureError`] for options that exclude each other, or a sample that
/// has no fit.
pub fn fit_sample(
    sample: &CensoredSample,
    options: &FitOptions,
) -> Result<FragilityFit, ProcedureError> {
    options.check(sample)?;
    let found = options.once(sample, &options.family)?;
    let fitted = found.fit.distribution;
    let whole = sample.extended();
    let shift_interval = match options.shift {
        Shift::Free => {
            let interval = profile_shift(&whole)?.interval;
            Some(ShiftInterval { interval, level: 0.95 })
        }
        _ => None,
    };
    let at = |p| sample.quantile(options.quantile_type, p);
    let clusters = options.clusters(sample);
    let (mut bootstrap, mut band) = (None, None);
    if let Some(draws) = options.draws {
        let basis = IntervalBasis::new(draws, &clusters);
        let drawn = draws.of("fragility", &clusters);
        let drawn = drawn.map(|places| refitted(sample, options, places));
        bootstrap = Some(FitIntervals::new(basis.clone(), &found, &drawn));
        let fitted = drawn.iter().map(|row| row.1.map(Into::into)).collect();
        let sampled = BootstrapFits { basis, fitted };
        band = (!options.band.is_empty()).then(|| {
            Band::new(sample, options, &found.fit.distribution, &sampled)
        });
    }
    // With individual limits there is no empirical distribution.
    let ks_distance =
        (sample.limited() == 0).then(|| fitted.kolmogorov_distance(&whole));
    Ok(FragilityFit {
        n: sample.len(),
        n_kept: found.fit.n_kept,
        n_censored: sample.censored(),
        n_limited: sample.limited(),
        n_left_out: found.left_out,
        remarks: FitRemark::remarks(sample, found.left_out),
        method: options.method,
        fitted,
        shift_interval,
        log_likelihood: found.fit.log_likelihood,
        ks_distance,
        area_distance: fitted.area_distance(&whole),
        quantile_type: options.quantile_type.number(),
        im16: at(0.16),
        im50: at(0.5),
        im84: at(0.84),
        unshifted: found.unshifted,
        transformed: found.transformed,
        needed: SampleSize::for_fit(sample, &fitted, &clusters),
        bootstrap,
        band,
    })
}
