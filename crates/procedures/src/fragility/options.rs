//! The paper's three options side by side, for one sample.

use std::fmt;

use super::{FragilityError, eq5, eq6, eq7};
use rocking_statistics::lognormal::{FitError, FitMethod, fit};
use rocking_statistics::{ExtendedSample, Lognormal, QuantileType};

/// Constants c of Eq. 7 that the paper uses.
pub const CONSTANTS: [f64; 4] = [0.25, 0.5, 0.75, 1.0];

/// Which median Eq. 5 takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Centre {
    /// The sample's 50 % quantile.
    SampleMedian,
    /// exp(mu) of the unshifted fit.
    FittedMedian,
}

/// A recipe for a fragility, with the statistics of the sample that it needs.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Recipe {
    /// USFL: the lognormal as if nothing were shifted, as FEMA P-58 takes it.
    Unshifted(FitMethod),
    /// Option 1, SSFL: the fit to the shifted sample, which must be known.
    Shifted(FitMethod),
    /// Option 2: Eqs. 5 and 6 from the 16, 50 and 84 % quantiles.
    Quantiles(QuantileType),
    /// Option 3, USFL7: Eqs. 5 and 7 from an unshifted median and
    /// dispersion.
    Transformed {
        /// The unshifted fit.
        method: FitMethod,
        /// The median of Eq. 5 and of Eq. 7.
        centre: Centre,
        /// The constant of Eq. 7.
        c: f64,
    },
}

/// An unshifted fit.
type Fitted = Result<Lognormal, FitError>;

impl Recipe {
    /// Every recipe of the comparison: USFL and SSFL by each method, the
    /// quantiles, and Eq. 7 with each method, centre and constant.
    pub fn all(quantile_type: QuantileType) -> Vec<Self> {
        let methods = FitMethod::all(quantile_type);
        let mut all = methods.map(Self::Unshifted).to_vec();
        all.extend(methods.map(Self::Shifted));
        all.push(Self::Quantiles(quantile_type));
        for method in methods {
            for centre in [Centre::SampleMedian, Centre::FittedMedian] {
                let with = |c| Self::Transformed { method, centre, c };
                all.extend(CONSTANTS.map(with));
            }
        }
        all
    }

    /// The paper's option: 1, 2 or 3; 0 for the unshifted fragility.
    pub fn option(&self) -> u8 {
        match self {
            Self::Unshifted(_) => 0,
            Self::Shifted(_) => 1,
            Self::Quantiles(_) => 2,
            Self::Transformed { .. } => 3,
        }
    }

    /// Number of statistics that must be reported of the unshifted sample,
    /// besides the shift; `None` if the whole sample must be known.
    pub fn parameters(&self) -> Option<u8> {
        match self {
            Self::Shifted(_) => None,
            Self::Quantiles(_) => Some(3),
            Self::Unshifted(_) | Self::Transformed { .. } => Some(2),
        }
    }

    /// The fragilities of several recipes for one sample, each fit made
    /// once.
    pub fn fragilities(
        recipes: &[Self],
        sample: &ExtendedSample,
        shift: f64,
    ) -> Vec<Result<Lognormal, FragilityError>> {
        let mut fits: Vec<(FitMethod, Fitted)> = Vec::new();
        let mut unshifted = |method| {
            if let Some((_, fit)) = fits.iter().find(|(m, _)| *m == method) {
                return *fit;
            }
            let fit = fit(sample, 0.0, method).map(|fit| fit.distribution);
            fits.push((method, fit));
            fit
        };
        let made = |own: &Self| own.made(sample, shift, &mut unshifted);
        recipes.iter().map(made).collect()
    }

    /// The fragility by this recipe of a sample above a shift.
    ///
    /// ```
    /// use rocking_procedures::fragility::options::Recipe;
    /// use rocking_statistics::{ExtendedSample, QuantileType};
    /// let sample = ExtendedSample::try_new(&[1.3, 1.8, 2.0, 2.4, 4.0])?;
    /// let option_2 = Recipe::Quantiles(QuantileType::default());
    /// let fragility = option_2.fragility(&sample, 1.0)?;
    /// assert_eq!(fragility.median(), 2.0);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// [`FragilityError`] if the fit or the equation has no value.
    pub fn fragility(
        &self,
        sample: &ExtendedSample,
        shift: f64,
    ) -> Result<Lognormal, FragilityError> {
        self.made(sample, shift, &mut |method| {
            Ok(fit(sample, 0.0, method)?.distribution)
        })
    }

    fn made(
        &self,
        sample: &ExtendedSample,
        shift: f64,
        unshifted: &mut impl FnMut(FitMethod) -> Fitted,
    ) -> Result<Lognormal, FragilityError> {
        let (log_mean, dispersion) = match *self {
            Self::Unshifted(method) => return Ok(unshifted(method)?),
            Self::Shifted(method) => {
                return Ok(fit(sample, shift, method)?.distribution);
            }
            Self::Quantiles(quantile_type) => {
                let [low, median, high] = [0.16, 0.5, 0.84].map(|p| {
                    let value = quantile_type.extended_quantile(sample, p);
                    value.unwrap_or(f64::NAN)
                });
                (eq5(median, shift)?, eq6(low, high, shift)?)
            }
            Self::Transformed { method, centre, c } => {
                let usfl = unshifted(method)?;
                let median = match centre {
                    Centre::FittedMedian => usfl.median(),
                    Centre::SampleMedian => sample.quantile(0.5),
                };
                let beta = eq7(median, usfl.dispersion(), shift, c)?;
                (eq5(median, shift)?, beta)
            }
        };
        Ok(Lognormal::try_new(shift, log_mean, dispersion)?)
    }
}

impl fmt::Display for Recipe {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Unshifted(method) => write!(f, "USFL, {method}"),
            Self::Shifted(method) => write!(f, "SSFL, {method}"),
            Self::Quantiles(t) => write!(f, "quantiles (type {t})"),
            Self::Transformed { method, centre, c } => {
                let centre = match centre {
                    Centre::SampleMedian => "sample median",
                    Centre::FittedMedian => "fitted median",
                };
                write!(f, "USFL7, {method}, {centre}, c = {c}")
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use libm::exp;

    use super::*;
    use rocking_statistics::normal;

    /// 1 + m exp(beta z) at n mid-points of probability.
    fn shifted_lognormal(m: f64, beta: f64, n: u32) -> ExtendedSample {
        let values: Vec<f64> = (0..n)
            .map(|i| (f64::from(i) + 0.5) / f64::from(n))
            .map(|p| 1.0 + m * exp(beta * normal::quantile(p)))
            .collect();
        ExtendedSample::try_new(&values).unwrap()
    }

    #[test]
    fn a_shifted_lognormal_gives_the_population_values() {
        // Published to three digits from quadrature of the population:
        // exp(Eq. 5), then beta_s at c = 0.25, 0.5 and 1.
        let trimmed = FitMethod::Trimmed(QuantileType::default());
        let quantile = FitMethod::Quantile(QuantileType::default());
        let mle = FitMethod::MaximumLikelihood;
        for (m, beta, method, expected) in [
            (1.0, 0.6, mle, [1.088, 0.588, 0.593, 0.613]),
            (1.0, 0.6, trimmed, [1.006, 0.508, 0.511, 0.525]),
            (1.0, 0.6, quantile, [1.0, 0.598, 0.604, 0.627]),
            (0.5, 0.8, mle, [0.605, 0.792, 0.808, 0.896]),
            (2.0, 0.8, quantile, [2.0, 0.789, 0.796, 0.829]),
        ] {
            let sample = shifted_lognormal(m, beta, 40_001);
            let centre = Centre::FittedMedian;
            let by = |c| {
                let recipe = Recipe::Transformed { method, centre, c };
                recipe.fragility(&sample, 1.0).unwrap()
            };
            let ours = [
                by(1.0).median() - 1.0,
                by(0.25).dispersion(),
                by(0.5).dispersion(),
                by(1.0).dispersion(),
            ];
            for (a, b) in ours.iter().zip(expected) {
                assert!((a - b).abs() < 1e-3, "{method}: {ours:?}");
            }
        }
    }

    #[test]
    fn options_1_and_2_recover_the_truth() {
        let sample = shifted_lognormal(0.9, 0.6, 40_001);
        let mle = Recipe::Shifted(FitMethod::MaximumLikelihood);
        let ssfl = mle.fragility(&sample, 1.0).unwrap();
        assert!((ssfl.median() - 1.9).abs() < 1e-6);
        assert!((ssfl.dispersion() - 0.6).abs() < 1e-3);
        let option_2 = Recipe::Quantiles(QuantileType::default());
        let quantiles = option_2.fragility(&sample, 1.0).unwrap();
        assert!((quantiles.median() - 1.9).abs() < 1e-12);
        // z(0.84) = 0.994458.
        let beta = 0.994_457_883 * 0.6;
        assert!((quantiles.dispersion() - beta).abs() < 1e-4);
    }

    #[test]
    fn recipes_are_distinct_and_say_what_is_wrong() {
        let all = Recipe::all(QuantileType::default());
        assert_eq!(all.len(), 5 + 5 + 1 + 40);
        let names: std::collections::BTreeSet<String> =
            all.iter().map(Recipe::to_string).collect();
        assert_eq!(names.len(), all.len());
        let wide = shifted_lognormal(0.1, 1.5, 101);
        let method = FitMethod::MaximumLikelihood;
        let centre = Centre::SampleMedian;
        let recipe = Recipe::Transformed { method, centre, c: 1.0 };
        let error = recipe.fragility(&wide, 1.0).unwrap_err();
        assert!(matches!(error, FragilityError::Scale { .. }));
    }
}
