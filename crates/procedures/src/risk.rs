//! Annual frequency of damage of a fragility under a hazard curve, and
//! probability of damage in some years.

use libm::expm1;
use thiserror::Error;

use crate::ModelError;
use crate::fit::{BootstrapFits, IntervalBasis};
use crate::fragility::hazard::{Hazard, HazardMeasure, HazardRemark};
use crate::fragility::total::TotalFragility;
use rocking::stop;
use rocking_statistics::estimate::keys;
use rocking_statistics::lognormal::LognormalError;
use rocking_statistics::{Estimate, Interval, Lognormal, Range};

/// Annual frequencies and probabilities of damage under one hazard curve.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Risk {
    /// The hazard curve's intensity measure.
    pub im: HazardMeasure,
    /// Unit of the intensities here, of medians and of shifts.
    pub unit: &'static str,
    /// Number of points of the hazard curve.
    pub points: usize,
    /// Its first point.
    pub first: HazardPoint,
    /// Its last point: what lies beyond it is bounded, not known.
    pub last: HazardPoint,
    /// Parts of the hazard curve that were set aside.
    pub remarks: Vec<HazardRemark>,
    /// The time T of the probabilities in years.
    pub years: f64,
    /// One for each fragility.
    pub fragilities: Vec<FragilityRisk>,
}

/// A point of a hazard curve.
#[derive(Clone, Copy, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct HazardPoint {
    /// Intensity, in the unit of the curve.
    pub intensity: f64,
    /// Annual frequency of exceedance in 1/year.
    pub annual_frequency: f64,
}

/// A fragility in the unit of the hazard curve.
#[derive(Clone, Debug, PartialEq)]
pub struct FragilityInput {
    /// Its name.
    pub fragility: String,
    /// The fragility.
    pub fitted: TotalFragility,
    /// Its values in the draws of its sample; `None` for no interval.
    pub sampled: Option<BootstrapFits>,
}

impl FragilityInput {
    /// A fragility of records and its values in the draws of its sample, with
    /// the model error; the stream that gives the draws their errors is named
    /// after the fragility.
    ///
    /// # Errors
    /// [`LognormalError`] for an error that [`TotalFragility`] rejects.
    pub fn with(
        fragility: String,
        (records, sampled): (Lognormal, Option<BootstrapFits>),
        error: &ModelError,
    ) -> Result<Self, LognormalError> {
        let fitted = error.total(records)?;
        let sampled = sampled.map(|all| all.with(error, &fragility));
        Ok(Self { fragility, fitted, sampled })
    }
}

/// Uncertainty of a frequency by the choice of records and the model error;
/// the hazard curve is taken as known.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct SamplingInterval {
    /// Basis of the interval.
    #[serde(flatten)]
    pub basis: IntervalBasis,
    /// The model error in each draw; `None` if only the records are drawn.
    pub model_error: Option<ModelError>,
    /// Annual frequency in 1/year, of the lower bound of truncation, with an
    /// interval up to the upper end of the upper bound.
    #[serde(flatten, serialize_with = "keys::annual_frequency_ends")]
    pub annual_frequency: Estimate,
    /// Probability of damage in T years with that interval.
    #[serde(flatten, serialize_with = "keys::probability_ends")]
    pub probability: Estimate,
    /// Annual frequency of each draw in 1/year, of the lower bound of
    /// truncation; not a number if a draw makes no fit.
    #[serde(skip)]
    pub drawn_annual_frequencies: Vec<f64>,
}

/// Annual frequency and probability of damage of one fragility.
///
/// Lower and upper are bounds of the hazard curve's truncation at its last
/// point (see
/// [`AnnualFrequency`](crate::fragility::risk::AnnualFrequency)). They are no
/// confidence interval: that is `sampling`.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct FragilityRisk {
    /// Name of the fragility.
    pub fragility: String,
    /// The fragility, in the unit of the hazard curve.
    pub fitted: TotalFragility,
    /// Annual frequency in 1/year at least.
    pub annual_frequency_truncation_lower: f64,
    /// Annual frequency in 1/year at most.
    pub annual_frequency_truncation_upper: f64,
    /// Annual frequency in 1/year of what the points cover.
    pub annual_frequency_covered: f64,
    /// Probability of damage in T years at least.
    pub probability_truncation_lower: f64,
    /// Probability of damage in T years at most.
    pub probability_truncation_upper: f64,
    /// The fragility at the first point. Where it is not 0, weaker motions
    /// add to the frequency; how much, the curve does not tell.
    pub probability_at_first_point: f64,
    /// The interval that the choice of the records and the error of the model
    /// leave; none for a fragility without a sample.
    pub sampling: Option<SamplingInterval>,
}

impl FragilityRisk {
    /// Annual frequency of damage in 1/year, the lower bound of truncation.
    pub fn annual_frequency(&self) -> Estimate {
        let point = Estimate::exact(self.annual_frequency_truncation_lower);
        let drawn = self.sampling.as_ref();
        drawn.map_or(point, |drawn| drawn.annual_frequency)
    }

    /// Mean return period of damage in years, its reciprocal.
    pub fn return_period_years(&self) -> Estimate {
        self.annual_frequency().map(f64::recip)
    }
}

/// A time that is not a positive number of years.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[error("{0} years: expected a positive number")]
pub struct RiskError(f64);

/// Annual frequency of damage of fragilities F, named and in the unit of the
/// hazard curve H, and probability of damage in `years` T.
///
/// lambda is the integral of F(x) |dH(x)|, with a power law H between the
/// points (OpenQuake interpolates linearly, which gives 10 to 17 % more on a
/// usual curve of 20 points). Damage is a Poisson process of that frequency:
/// the probability of damage in T years is 1 - exp(-lambda T).
///
/// The 95 % interval is computed for ln(lambda) over the draws of the
/// fragility's sample, of earthquakes if they are known
/// ([`Clusters::estimate`](rocking_statistics::Clusters::estimate)).
///
/// ```
/// use rocking_procedures::fragility::hazard::{Hazard, HazardOptions};
/// use rocking_procedures::{FragilityInput, ModelError, risk};
/// use rocking_statistics::Lognormal;
/// let text = "pga_g,annual_frequency\n1e-6,1e8\n1e6,1e-16\n";
/// let hazard = Hazard::parse("h.csv", text, &HazardOptions::default())?;
/// let fragility = Lognormal::try_new(0.0, 0.0, 0.5)?;
/// let known = (fragility, None);
/// let own = FragilityInput::with("block".into(), known, &ModelError::none())?;
/// let found = risk(&hazard, &[own], 50.0)?;
/// // Cornell's closed form for H = 1e-4 x^-2, median 1, dispersion 0.5.
/// let cornell = 1e-4 * 0.5f64.exp();
/// let row = &found.fragilities[0];
/// let ratio = row.annual_frequency_truncation_lower / cornell;
/// assert!((ratio - 1.0).abs() < 1e-12);
/// let probability = 1.0 - (-50.0 * cornell).exp();
/// assert!((row.probability_truncation_lower - probability).abs() < 1e-12);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`RiskError`] for a time that is no positive number.
pub fn risk(
    hazard: &Hazard,
    fragilities: &[FragilityInput],
    years: f64,
) -> Result<Risk, RiskError> {
    if !(years > 0.0 && years.is_finite()) {
        return Err(RiskError(years));
    }
    let (first, last) = hazard.curve.ends();
    let point = |(intensity, annual_frequency)| HazardPoint {
        intensity,
        annual_frequency,
    };
    let within = |frequency: f64| -expm1(-frequency * years);
    let row = |one: &FragilityInput| {
        let found = hazard.curve.annual_frequency(one.fitted);
        let (lower, upper) = (found.truncation_lower, found.truncation_upper);
        FragilityRisk {
            fragility: one.fragility.clone(),
            fitted: one.fitted,
            annual_frequency_truncation_lower: lower,
            annual_frequency_truncation_upper: upper,
            annual_frequency_covered: found.covered,
            probability_truncation_lower: within(lower),
            probability_truncation_upper: within(upper),
            probability_at_first_point: found.first_probability,
            sampling: one.sampled.as_ref().and_then(|sampled| {
                interval(hazard, (lower, upper), sampled, within)
            }),
        }
    };
    Ok(Risk {
        im: hazard.im.clone(),
        unit: hazard.unit(),
        points: hazard.curve.points().len(),
        first: point(first),
        last: point(last),
        remarks: hazard.remarks.clone(),
        years,
        fragilities: fragilities.iter().map(row).collect(),
    })
}

/// The interval of an annual frequency between its bounds of truncation.
fn interval(
    hazard: &Hazard,
    (lower, upper): (f64, f64),
    sampled: &BootstrapFits,
    within: impl Fn(f64) -> f64,
) -> Option<SamplingInterval> {
    let all = sampled.fitted.iter().map(|fitted| {
        stop::point();
        fitted.map_or((f64::NAN, f64::NAN), |fitted| {
            let found = hazard.curve.annual_frequency(fitted);
            (found.truncation_lower, found.truncation_upper)
        })
    });
    let (lows, highs): (Vec<f64>, Vec<f64>) = all.unzip();
    let basis = &sampled.basis;
    let range = Range::NotNegative;
    let of = |value, drawn: &[f64]| basis.value(value, drawn, range).estimate;
    // A lower bound of 0 has no logarithm.
    let low = of(lower, &lows).low().unwrap_or(0.0);
    let interval = Interval::try_new(low, of(upper, &highs).high()?).ok()?;
    let annual_frequency = Estimate::try_new(lower, interval, range).ok()?;
    Some(SamplingInterval {
        basis: basis.clone(),
        model_error: basis.model_error,
        annual_frequency,
        probability: annual_frequency.map(within),
        drawn_annual_frequencies: lows,
    })
}

#[cfg(test)]
mod tests {
    use libm::{exp, log};

    use super::*;
    use crate::Draws;
    use crate::fragility::hazard::HazardOptions;
    use rocking_statistics::Clusters;

    /// Damage is certain in motions stronger than every point of the curve,
    /// and sure not to happen in weaker ones: the frequency lies between 0
    /// and the frequency of the last point, or what draws make of that.
    #[test]
    fn an_interval_reaches_from_bound_to_bound_of_the_truncation() {
        let text = "pga_g,annual_frequency\n0.3,0.004\n0.9,0.0003\n";
        let options = HazardOptions::default();
        let hazard = Hazard::parse("h.csv", text, &options).unwrap();
        let beyond = Lognormal::try_new(5.0, 0.0, 0.1).unwrap();
        let weaker = Lognormal::try_new(0.0, -0.7, 0.1).unwrap();
        let draws = Draws { replicates: 40, seed: 0 };
        let ends = |clusters: &Clusters| {
            let sampled = BootstrapFits {
                basis: IntervalBasis::new(draws, clusters),
                fitted: [beyond, weaker]
                    .repeat(20)
                    .into_iter()
                    .map(|law| Some(law.into()))
                    .collect(),
            };
            let one = FragilityInput {
                fragility: "block".into(),
                fitted: beyond.into(),
                sampled: Some(sampled),
            };
            let found = risk(&hazard, &[one], 50.0).unwrap();
            let found = found.fragilities[0].sampling.clone()?;
            let ends = |of: Estimate| of.interval().unwrap().ends();
            Some((ends(found.annual_frequency), ends(found.probability)))
        };
        let (frequency, probability) = ends(&Clusters::singletons(9)).unwrap();
        let upper = hazard.curve.annual_frequency(weaker).truncation_upper;
        // Half of the draws each: t of 8 is 2.3060.
        let s =
            0.5 * log(upper / 0.0003) * (40.0 / 39.0 * 9.0 / 8.0f64).sqrt();
        let expected = 0.0003 * exp(2.3060 * s);
        assert_eq!(frequency.0, 0.0);
        assert!((frequency.1 / expected - 1.0).abs() < 1e-4);
        let high = 1.0 - exp(-50.0 * frequency.1);
        assert_eq!(probability.0, 0.0);
        assert!((probability.1 / high - 1.0).abs() < 1e-12);
        assert!(ends(&Clusters::singletons(2)).is_none());
    }
}
