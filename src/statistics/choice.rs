//! The choice of a distribution: likelihood, information criteria and
//! goodness of fit of several families, side by side.

use libm::{exp, log, pow};
use rayon::prelude::*;

use super::lognormal::{self, FitError, FitMethod, profile_shift};
use super::rivals::{self, ExtremeValue, Family, RivalFit, fit_extreme_value};
use super::{ExtendedSample, Lognormal, monte_carlo};
use crate::names::named;
use crate::stop;
use crate::streams::{Stream, Streams, standard_normal};

/// A family of distributions.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Model {
    /// Lognormal above the given shift.
    Lognormal,
    /// Lognormal above a shift that is fitted too.
    ShiftedLognormal,
    /// Weibull above the given shift.
    Weibull,
    /// Gamma above the given shift.
    Gamma,
    /// Generalized extreme value, wherever its ends are.
    ExtremeValue,
}

named!(Model, "distribution", {
    Lognormal = "lognormal",
    ShiftedLognormal = "shifted lognormal",
    Weibull = "Weibull",
    Gamma = "gamma",
    ExtremeValue = "generalized extreme value",
});

impl Model {
    /// Number of fitted parameters k.
    #[must_use]
    pub fn parameters(self) -> usize {
        match self {
            Self::Lognormal | Self::Weibull | Self::Gamma => 2,
            Self::ShiftedLognormal | Self::ExtremeValue => 3,
        }
    }
}

/// A fitted distribution.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Distribution {
    /// With its shift.
    Lognormal(Lognormal),
    /// Above a shift.
    Rival {
        /// Shape and scale of x - shift.
        fit: RivalFit,
        /// The shift.
        shift: f64,
    },
    /// Without a shift.
    ExtremeValue(ExtremeValue),
}

impl Distribution {
    /// F(x) and 1 - F(x).
    #[must_use]
    pub fn both(&self, x: f64) -> (f64, f64) {
        match self {
            Self::Lognormal(own) => (own.cdf(x), own.survival(x)),
            Self::Rival { fit, shift } => fit.both(x - shift),
            Self::ExtremeValue(own) => (own.cdf(x), own.survival(x)),
        }
    }

    /// A random value.
    fn draw(&self, stream: &mut Stream) -> f64 {
        match self {
            Self::Lognormal(own) => {
                let z = standard_normal(stream);
                let y = f64::mul_add(own.dispersion(), z, own.log_mean());
                own.shift() + exp(y)
            }
            Self::Rival { fit, shift } if fit.family == Family::Gamma => {
                shift + fit.scale * gamma(stream, fit.shape)
            }
            Self::Rival { fit, shift } => {
                // Weibull and Frechet: powers of an exponential.
                let power = match fit.family {
                    Family::Frechet => -1.0 / fit.shape,
                    _ => 1.0 / fit.shape,
                };
                shift + fit.scale * pow(-log(uniform(stream)), power)
            }
            Self::ExtremeValue(own) => own.quantile(uniform(stream)),
        }
    }
}

/// A model fitted to a sample, and how well it fits.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Candidate {
    /// The family.
    pub model: Model,
    /// The fitted distribution.
    pub distribution: Distribution,
    /// Log-likelihood in x, the same scale for all.
    pub log_likelihood: f64,
    /// Akaike's criterion 2 k - 2 ln L (Akaike, IEEE Transactions on
    /// Automatic Control 19 (1974) 716).
    pub aic: f64,
    /// Schwarz's criterion k ln n - 2 ln L (Annals of Statistics 6 (1978)
    /// 461).
    pub bic: f64,
    /// Kolmogorov's D = sup |F - F_n|.
    pub kolmogorov: f64,
    /// Anderson and Darling's A2.
    pub anderson_darling: f64,
}

/// P-values of a fit, parameters fitted: shares of samples drawn from the
/// fit, and fitted anew, that lie at least as far off.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct Goodness {
    /// p-value of D: (b + 1)/(N + 1), with b of N samples at least as large.
    pub kolmogorov_p: f64,
    /// p-value of A2, likewise.
    pub anderson_darling_p: f64,
    /// Samples that could be fitted.
    pub used: usize,
}

/// Fits a model to a sample without censored values; all but
/// [`Model::ShiftedLognormal`] and [`Model::ExtremeValue`] above the given
/// shift.
///
/// ```
/// use rocking::statistics::ExtendedSample;
/// use rocking::statistics::choice::{Model, candidate};
/// let sample = ExtendedSample::try_new(&[1.2, 1.5, 1.9, 2.4, 3.8, 5.0])?;
/// let lognormal = candidate(&sample, 0.0, Model::Lognormal)?;
/// let weibull = candidate(&sample, 0.0, Model::Weibull)?;
/// assert!(lognormal.aic < weibull.aic);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`FitError`] where the model cannot be fitted.
pub fn candidate(
    sample: &ExtendedSample,
    shift: f64,
    model: Model,
) -> Result<Candidate, FitError> {
    let rival = |family| -> Result<(Distribution, f64), FitError> {
        let fit = rivals::fit(sample, shift, family)?;
        Ok((Distribution::Rival { fit, shift }, fit.log_likelihood))
    };
    let (distribution, log_likelihood) = match model {
        Model::Lognormal => {
            let mle = FitMethod::MaximumLikelihood;
            let fit = lognormal::fit(sample, shift, mle)?;
            let value = fit.log_likelihood.unwrap_or(f64::NAN);
            (Distribution::Lognormal(fit.distribution), value)
        }
        Model::ShiftedLognormal => {
            let fit = profile_shift(sample)?.fit;
            let value = fit.log_likelihood.unwrap_or(f64::NAN);
            (Distribution::Lognormal(fit.distribution), value)
        }
        Model::Weibull => rival(Family::Weibull)?,
        Model::Gamma => rival(Family::Gamma)?,
        Model::ExtremeValue => {
            let (fitted, value) = fit_extreme_value(sample)?;
            (Distribution::ExtremeValue(fitted), value)
        }
    };
    let (k, n) = (model.parameters() as f64, sample.len() as f64);
    let (kolmogorov, anderson_darling) = distances(&distribution, sample);
    Ok(Candidate {
        model,
        distribution,
        log_likelihood,
        aic: 2.0 * k - 2.0 * log_likelihood,
        bic: k * log(n) - 2.0 * log_likelihood,
        kolmogorov,
        anderson_darling,
    })
}

/// P-values of a candidate that was fitted to `n` values above `shift`, by
/// the parametric bootstrap (Stute, Gonzalez Manteiga and Presedo Quindimil,
/// Metrika 40 (1993) 243): every sample is drawn from the fit and fitted
/// anew, the shift too where it is a parameter. Sample i comes from stream i
/// of the model's family of this seed.
///
/// Where a fit's likelihood has no maximum the sample is left out; the
/// p-values are then those among samples that can be fitted.
#[must_use]
pub fn goodness(
    found: &Candidate,
    n: usize,
    shift: f64,
    replicates: u64,
    seed: u64,
) -> Goodness {
    let streams = Streams::new(&format!("goodness/{}", found.model), seed);
    let far = |index: u64| {
        stop::point();
        let mut stream = streams.stream(index);
        let drawn = (0..n).map(|_| found.distribution.draw(&mut stream));
        let drawn: Vec<f64> = drawn.collect();
        let sample = ExtendedSample::try_new(&drawn).ok()?;
        let again = candidate(&sample, shift, found.model).ok()?;
        Some([
            again.kolmogorov >= found.kolmogorov,
            again.anderson_darling >= found.anderson_darling,
        ])
    };
    let all: Vec<Option<[bool; 2]>> =
        (0..replicates).into_par_iter().panic_fuse().map(far).collect();
    let used = all.iter().flatten().count();
    let p = |which: usize| {
        let far = all.iter().flatten().filter(|far| far[which]).count();
        monte_carlo::p_value(far, used)
    };
    Goodness { kolmogorov_p: p(0), anderson_darling_p: p(1), used }
}

/// D and A2 = -n - sum (2 i - 1)(ln F(x_i) + ln(1 - F(x_(n+1-i))))/n.
fn distances(
    distribution: &Distribution,
    sample: &ExtendedSample,
) -> (f64, f64) {
    let n = sample.len();
    let both: Vec<(f64, f64)> =
        sample.sorted().iter().map(|x| distribution.both(*x)).collect();
    let size = n as f64;
    let (mut d, mut sum) = (0.0_f64, 0.0);
    for (i, (below, _)) in both.iter().enumerate() {
        let (before, after) = (i as f64 / size, (i + 1) as f64 / size);
        d = d.max(below - before).max(after - below);
        let weight = (2 * i + 1) as f64;
        sum += weight * (log(*below) + log(both[n - 1 - i].1));
    }
    (d, -size - sum / size)
}

/// A number between 0 and 1, neither of them.
fn uniform(stream: &mut Stream) -> f64 {
    const ULP: f64 = 1.0 / (1_u64 << 53) as f64;
    ((stream.next_u64() >> 11) as f64 + 0.5) * ULP
}

/// A gamma variate of scale 1 (Marsaglia and Tsang, ACM Transactions on
/// Mathematical Software 26 (2000) 363); below shape 1 by U^(1/shape).
fn gamma(stream: &mut Stream, shape: f64) -> f64 {
    if shape < 1.0 {
        let power = pow(uniform(stream), 1.0 / shape);
        return power * gamma(stream, shape + 1.0);
    }
    let d = shape - 1.0 / 3.0;
    let c = 1.0 / (9.0 * d).sqrt();
    loop {
        let z = standard_normal(stream);
        let v = 1.0 + c * z;
        if v <= 0.0 {
            continue;
        }
        let v = v * v * v;
        let bound = 0.5 * z * z + d * (1.0 - v + log(v));
        if log(uniform(stream)) < bound {
            return d * v;
        }
    }
}

#[cfg(test)]
mod tests;
