//! The lognormal distribution, with or without a shift, and its fits.

mod band;
pub(crate) mod censored;
mod counts;
mod fit;
mod profile;
mod within;

use libm::{exp, expm1, log, sqrt};
use thiserror::Error;

pub use counts::{CountsFit, Stripe, fit_counts, fit_counts_alone};
pub use fit::{
    FitError, FitMethod, LognormalFit, fit, fit_intervals,
    fit_intervals_together, shifted_finite,
};
pub use profile::{ShiftProfile, profile_shift};
pub use within::dispersion_within;

use super::{ExtendedSample, normal};

/// Why the parameters of a lognormal distribution were rejected.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum LognormalError {
    /// A dispersion that is not positive and finite.
    #[error("dispersion {0}: expected a positive finite number")]
    Dispersion(f64),
    /// A logarithmic mean that is not finite.
    #[error("logarithmic mean {0}: expected a finite number")]
    LogMean(f64),
    /// A shift that is negative or not finite.
    #[error("shift {0}: expected a finite, non-negative number")]
    Shift(f64),
}

/// Checks a shift.
///
/// # Errors
/// [`LognormalError::Shift`] for a shift that is negative or not finite.
pub fn check_shift(shift: f64) -> Result<(), LognormalError> {
    let known = shift >= 0.0 && shift.is_finite();
    known.then_some(()).ok_or(LognormalError::Shift(shift))
}

/// ln(X - r) normal with mean mu and standard deviation beta.
///
/// r >= 0 is the shift (IM_R, below which nothing rocks; 0 for the ordinary
/// lognormal), mu the logarithmic mean, beta > 0 the dispersion.
/// F(x) = Phi((ln(x - r) - mu)/beta) above the shift, 0 up to it.
///
/// ```
/// use rocking_statistics::Lognormal;
/// let fragility = Lognormal::try_new(1.0, 0.0, 0.5)?;
/// assert_eq!(fragility.median(), 2.0);
/// assert_eq!(fragility.cdf(2.0), 0.5);
/// assert_eq!(fragility.cdf(1.0), 0.0);
/// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Lognormal {
    shift: f64,
    log_mean: f64,
    dispersion: f64,
}

/// Written with its median beside its parameters.
impl serde::Serialize for Lognormal {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        to.collect_map([
            ("shift", self.shift),
            ("log_mean", self.log_mean),
            ("dispersion", self.dispersion),
            ("median", self.median()),
        ])
    }
}

impl Lognormal {
    /// A lognormal distribution above `shift`.
    ///
    /// # Errors
    /// [`LognormalError`] unless shift >= 0, mu is finite and beta > 0.
    pub fn try_new(
        shift: f64,
        log_mean: f64,
        dispersion: f64,
    ) -> Result<Self, LognormalError> {
        check_shift(shift)?;
        if !log_mean.is_finite() {
            return Err(LognormalError::LogMean(log_mean));
        }
        if !(dispersion > 0.0 && dispersion.is_finite()) {
            return Err(LognormalError::Dispersion(dispersion));
        }
        Ok(Self { shift, log_mean, dispersion })
    }

    /// The shift r.
    pub fn shift(&self) -> f64 {
        self.shift
    }

    /// The logarithmic mean mu, of x - r.
    pub fn log_mean(&self) -> f64 {
        self.log_mean
    }

    /// The dispersion beta, of ln(x - r).
    pub fn dispersion(&self) -> f64 {
        self.dispersion
    }

    /// The median r + exp(mu).
    pub fn median(&self) -> f64 {
        self.shift + exp(self.log_mean)
    }

    /// The mean r + exp(mu + beta^2/2), of x itself, not of its logarithm.
    ///
    /// In the unit of x.
    ///
    /// ```
    /// use rocking_statistics::Lognormal;
    /// let x = Lognormal::try_new(1.0, 0.0, 0.5)?;
    /// assert!((x.mean() - 2.133_148_453_066_826).abs() < 1e-15);
    /// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
    /// ```
    ///
    /// Johnson, Kotz and Balakrishnan, Continuous Univariate Distributions,
    /// volume 1, Eq. 14.8a.
    pub fn mean(&self) -> f64 {
        self.shift + self.mean_above_shift()
    }

    /// exp(mu + beta^2/2), the mean of x - r.
    fn mean_above_shift(&self) -> f64 {
        let half_square = 0.5 * self.dispersion * self.dispersion;
        exp(self.log_mean + half_square)
    }

    /// The standard deviation exp(mu + beta^2/2) sqrt(exp(beta^2) - 1), of x
    /// itself, not of its logarithm.
    ///
    /// In the unit of x; the shift does not enter.
    ///
    /// ```
    /// use rocking_statistics::Lognormal;
    /// let x = Lognormal::try_new(1.0, 0.0, 0.5)?;
    /// let expected = 0.603_900_533_210_881_2;
    /// assert!((x.standard_deviation() - expected).abs() < 1e-15);
    /// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
    /// ```
    ///
    /// Johnson, Kotz and Balakrishnan, Continuous Univariate Distributions,
    /// volume 1, Eq. 14.8b.
    pub fn standard_deviation(&self) -> f64 {
        let square = self.dispersion * self.dispersion;
        exp(0.5f64.mul_add(square, self.log_mean)) * expm1(square).sqrt()
    }

    /// The distribution of c x: shift c r, logarithmic mean mu + ln c, the
    /// same dispersion.
    ///
    /// `factor` c > 0, such as the intensity in g that makes one unit of a
    /// dimensionless intensity.
    ///
    /// ```
    /// use rocking_statistics::Lognormal;
    /// let x = Lognormal::try_new(1.0, 0.0, 0.5)?;
    /// let half = x.scaled(0.5)?;
    /// assert_eq!((half.shift(), half.median()), (0.5, 1.0));
    /// assert_eq!(half.dispersion(), 0.5);
    /// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
    /// ```
    ///
    /// # Errors
    /// [`LognormalError`] unless c is positive and finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, LognormalError> {
        let log_mean = self.log_mean + log(factor);
        Self::try_new(factor * self.shift, log_mean, self.dispersion)
    }

    /// The standardised logarithm (ln(x - r) - mu)/beta; minus infinity up
    /// to the shift.
    pub fn score(&self, x: f64) -> f64 {
        if x <= self.shift {
            return f64::NEG_INFINITY;
        }
        (log(x - self.shift) - self.log_mean) / self.dispersion
    }

    /// The distribution function, a fragility's value at intensity x.
    pub fn cdf(&self, x: f64) -> f64 {
        normal::cdf(self.score(x))
    }

    /// The survival function 1 - F(x), without cancellation.
    pub fn survival(&self, x: f64) -> f64 {
        normal::survival(self.score(x))
    }

    /// The quantile at probability p in [0, 1]; NaN outside.
    pub fn quantile(&self, p: f64) -> f64 {
        self.at_score(normal::quantile(p))
    }

    /// The x of a normal score, r + exp(mu + beta z).
    pub fn at_score(&self, z: f64) -> f64 {
        self.shift + exp(f64::mul_add(self.dispersion, z, self.log_mean))
    }

    /// The logarithm of the density in x, so of 1/((x - r) beta) phi(score).
    pub fn ln_pdf(&self, x: f64) -> f64 {
        let z = self.score(x);
        if z == f64::NEG_INFINITY {
            return z;
        }
        -0.5 * z * z
            - normal::LN_SQRT_TWO_PI
            - log(self.dispersion)
            - log(x - self.shift)
    }

    /// Log-likelihood of finite data in x (the Jacobian -ln(x - r)
    /// included), so that models on different scales can be compared.
    pub fn log_likelihood(&self, values: &[f64]) -> f64 {
        values.iter().fold(0.0, |sum, &x| sum + self.ln_pdf(x))
    }

    /// Mean of min(x, limit) subtracted from the limit: the integral of F
    /// from 0 to the limit.
    fn integral(&self, limit: f64) -> f64 {
        if limit <= self.shift {
            return 0.0;
        }
        let z = self.score(limit);
        let partial =
            self.mean_above_shift() * normal::cdf(z - self.dispersion);
        (limit - self.shift) * normal::cdf(z) - partial
    }

    /// Integral of 1 - F from the limit on.
    fn upper_integral(&self, limit: f64) -> f64 {
        let z = self.score(limit);
        let partial =
            self.mean_above_shift() * normal::survival(z - self.dispersion);
        partial - (limit - self.shift) * normal::survival(z)
    }

    /// Kolmogorov distance sup |F - G| to another lognormal with the same
    /// shift: none if the shifts differ.
    ///
    /// The largest difference lies where the densities are equal. With z the
    /// score in F, r = `beta_F/beta_G` and d = `(mu_F - mu_G)/beta_G`, the
    /// score in G is r z + d, and the densities are equal where
    /// `z^2 - (r z + d)^2 = -2 ln r`.
    ///
    /// ```
    /// use rocking_statistics::Lognormal;
    /// let one = Lognormal::try_new(1.0, 0.0, 0.5)?;
    /// let other = Lognormal::try_new(1.0, 0.5, 0.5)?;
    /// // Phi(1/2) - Phi(-1/2)
    /// let distance = one.distance(&other).unwrap();
    /// assert!((distance - 0.382_924_922_548).abs() < 1e-12);
    /// # Ok::<(), rocking_statistics::lognormal::LognormalError>(())
    /// ```
    pub fn distance(&self, other: &Self) -> Option<f64> {
        if self.shift != other.shift {
            return None;
        }
        let ratio = self.dispersion / other.dispersion;
        let off = (self.log_mean - other.log_mean) / other.dispersion;
        let at =
            |z: f64| (normal::cdf(z) - normal::cdf(ratio * z + off)).abs();
        // (1 - r^2) z^2 - 2 r d z - (d^2 - 2 ln r) = 0.
        let (a, b) = (1.0 - ratio * ratio, -ratio * off);
        let c = -(off * off - 2.0 * log(ratio));
        let root = sqrt((b * b - a * c).max(0.0));
        // The numerically stable form of one root; the other root from the
        // product.
        let q = if b > 0.0 { -b - root } else { -b + root };
        let places = [q / a, c / q].into_iter().filter(|z| z.is_finite());
        Some(places.map(at).fold(0.0, f64::max))
    }

    /// Kolmogorov distance sup |F - F_n| to the empirical distribution of a
    /// sample (steps of 1/n); censored values count in n.
    pub fn kolmogorov_distance(&self, sample: &ExtendedSample) -> f64 {
        let n = sample.len() as f64;
        let finite = sample.finite();
        // Beyond the last finite value F goes to 1 and F_n stays.
        let start = sample.censored() as f64 / n;
        finite.iter().enumerate().fold(start, |distance, (i, &x)| {
            let f = self.cdf(x);
            let (below, above) = (i as f64 / n, (i + 1) as f64 / n);
            distance.max(f - below).max(above - f)
        })
    }

    /// Area between F and the empirical distribution, in units of x (the
    /// Wasserstein-1 distance): none for a sample with censored values.
    pub fn area_distance(&self, sample: &ExtendedSample) -> Option<f64> {
        if sample.censored() > 0 {
            return None;
        }
        let data = sample.sorted();
        let n = data.len() as f64;
        let mut area = self.integral(data[0]);
        for (i, pair) in data.windows(2).enumerate() {
            let (a, b) = (pair[0], pair[1]);
            let level = (i + 1) as f64 / n;
            // F - level changes sign once at most: at the quantile.
            let turn = self.quantile(level).clamp(a, b);
            let between = |a: f64, b: f64| {
                let rise = self.integral(b) - self.integral(a);
                (rise - level * (b - a)).abs()
            };
            area += between(a, turn) + between(turn, b);
        }
        Some(area + self.upper_integral(data[data.len() - 1]))
    }
}

#[cfg(test)]
mod tests;
