//! The hazard curve of an average spectral acceleration from curves of
//! spectral acceleration.

use std::fmt;
use std::str::FromStr;

use libm::{exp, log};
use thiserror::Error;

use super::{Hazard, HazardMeasure, HazardRemark};
use crate::fragility::risk::{HazardCurve, HazardError};
use rocking_records::intensity::IntensityMeasure;

/// Points of the curve.
const POINTS: u32 = 60;

/// How spectral accelerations at the periods of an average scatter together
/// about their medians, given the earthquake.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralCorrelation {
    mean: f64,
    dispersion: f64,
}

/// Why the curve of the average cannot be computed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AverageHazardError {
    /// A curve of another measure.
    #[error("hazard curve of {0}: expected one of SA(T), 5 % damping, in g")]
    Measure(String),
    /// Two curves of one period.
    #[error("two hazard curves of SA({0} s): expected one for each period")]
    Twice(f64),
    /// Curves that do not span the periods of the average.
    #[error(
        "hazard curves of SA from {first} to {last} s: expected periods that \
         span {low} to {high} s, those of the fragility"
    )]
    Periods {
        /// Shortest period of the curves.
        first: f64,
        /// Longest period.
        last: f64,
        /// Shortest period of the average.
        low: f64,
        /// Longest period.
        high: f64,
    },
    /// A fragility in another measure.
    #[error("a fragility in {0}: expected one in AvgSA, such as --law")]
    Fragility(String),
    /// Curves without a frequency in common, or with one that stays the same.
    #[error(transparent)]
    Curve(#[from] HazardError),
}

/// A text that is no correlation.
#[derive(Clone, Debug, PartialEq, Eq, Error)]
#[error(
    "found `{0}`: expected R,S: the mean correlation of ln SA over all pairs \
     of periods, from 0 to 1, and the dispersion of SA given the earthquake, \
     0 or more; or 1, perfect correlation"
)]
pub struct CorrelationFault(String);

impl FromStr for SpectralCorrelation {
    type Err = CorrelationFault;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        let numbers: Option<Vec<f64>> =
            text.split(',').map(|word| word.trim().parse().ok()).collect();
        match numbers.as_deref() {
            Some([mean]) if *mean == 1.0 => {
                Ok(Self { mean: 1.0, dispersion: 0.0 })
            }
            Some([mean, dispersion])
                if (0.0..=1.0).contains(mean)
                    && (0.0..=3.0).contains(dispersion) =>
            {
                Ok(Self { mean: *mean, dispersion: *dispersion })
            }
            _ => Err(CorrelationFault(text.to_owned())),
        }
    }
}

impl fmt::Display for SpectralCorrelation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{},{}", self.mean, self.dispersion)
    }
}

/// ln of the intensity at an annual frequency.
fn ln_im(curve: &HazardCurve, frequency: f64) -> f64 {
    let points = curve.points();
    let to = points.partition_point(|(_, h)| *h > frequency);
    let to = to.clamp(1, points.len() - 1);
    let [(x0, h0), (x1, h1)] = [points[to - 1], points[to]];
    let share = log(h0 / frequency) / log(h0 / h1);
    let share = if share.is_finite() { share } else { 0.0 };
    log(x0) + share * log(x1 / x0)
}

/// The hazard curve of the average spectral acceleration `im` from those of
/// spectral acceleration.
///
/// At an annual frequency H the curves, interpolated in ln T, give SA_i at the
/// periods of the average. With SA lognormal given the earthquake, of
/// dispersion sigma at every period, with a mean correlation R over all pairs
/// of periods (each with itself included), and with medians that rise and fall
/// together, H = C x^-k of each SA gives
///
/// ```text
/// ln AvgSA = mean of ln SA_i - k sigma^2 (1 - R)/2
/// ```
///
/// k is the slope of the curve at H. R = 1 needs no sigma and is the upper
/// bound: uniform hazard at all periods at once.
///
/// # Errors
/// [`AverageHazardError`] for curves of other measures, periods that do not
/// span those of `im`, and curves that share no frequency.
pub fn average_hazard<'a>(
    curves: &'a [Hazard],
    im: &IntensityMeasure,
    correlation: SpectralCorrelation,
) -> Result<Hazard, AverageHazardError> {
    let (Some(&low), Some(&high)) =
        (im.periods_s().first(), im.periods_s().last())
    else {
        return Err(AverageHazardError::Fragility(im.words()));
    };
    let of_period = |hazard: &'a Hazard| match hazard.im {
        HazardMeasure::Of(IntensityMeasure::Sa(t)) => Ok((t, &hazard.curve)),
        _ => Err(AverageHazardError::Measure(hazard.name())),
    };
    let own = curves.iter().map(of_period);
    let mut own = own.collect::<Result<Vec<_>, _>>()?;
    own.sort_by(|a, b| a.0.total_cmp(&b.0));
    if let Some(pair) = own.windows(2).find(|pair| pair[0].0 == pair[1].0) {
        return Err(AverageHazardError::Twice(pair[0].0));
    }
    let ends = own.first().zip(own.last());
    let (first, last) = ends.map_or((f64::NAN, f64::NAN), |(a, b)| (a.0, b.0));
    if !(first <= low && last >= high) {
        return Err(AverageHazardError::Periods { first, last, low, high });
    }
    let (mut most, mut least) = (f64::INFINITY, 0.0_f64);
    for (_, curve) in &own {
        let (first, last) = curve.ends();
        (most, least) = (most.min(first.1), least.max(last.1));
    }
    if !(least < most) {
        return Err(HazardError::Points(0).into());
    }
    let ln_sa = |frequency: f64, period_s: f64| {
        let to = own.partition_point(|(t, _)| *t < period_s);
        let to = to.clamp(1, own.len().max(2) - 1);
        let Some([a, b]) = own.get(to - 1..=to) else {
            return ln_im(own[0].1, frequency);
        };
        let share = log(period_s / a.0) / log(b.0 / a.0);
        let [from, to] = [a.1, b.1].map(|curve| ln_im(curve, frequency));
        from + share * (to - from)
    };
    let mean = |frequency: f64| {
        let all = im.periods_s();
        let sum = all.iter().fold(0.0, |sum, t| sum + ln_sa(frequency, *t));
        sum / all.len() as f64
    };
    let step = log(most / least) / f64::from(POINTS - 1);
    let frequencies: Vec<f64> = (0..POINTS)
        .map(|k| (most * exp(-step * f64::from(k))).clamp(least, most))
        .collect();
    let middle: Vec<f64> = frequencies.iter().map(|h| mean(*h)).collect();
    let SpectralCorrelation { mean: r, dispersion } = correlation;
    let lost = 0.5 * dispersion * dispersion * (1.0 - r);
    let point = |k: usize| {
        let (from, to) = (k.saturating_sub(1), (k + 1).min(middle.len() - 1));
        let slope = step * (to - from) as f64 / (middle[to] - middle[from]);
        let less = if lost > 0.0 { slope * lost } else { 0.0 };
        (exp(middle[k] - less), frequencies[k])
    };
    let points: Vec<(f64, f64)> = (0..middle.len()).map(point).collect();
    Ok(Hazard {
        curve: HazardCurve::try_new(&points)?,
        im: HazardMeasure::Of(im.clone()),
        units_per_im_unit: 1.0,
        remarks: vec![HazardRemark::Averaged],
    })
}

#[cfg(test)]
mod tests {
    use libm::pow;

    use super::*;

    /// H = c x^-k with c = T^-2, so that SA is T^(-2/k) at H = 1.
    fn power(period_s: f64, k: f64) -> Hazard {
        let c = period_s.recip() * period_s.recip();
        let points = [(1e-3, c * pow(1e-3, -k)), (1e3, c * pow(1e3, -k))];
        Hazard {
            curve: HazardCurve::try_new(&points).unwrap(),
            im: HazardMeasure::Of(IntensityMeasure::Sa(period_s)),
            units_per_im_unit: 1.0,
            remarks: Vec::new(),
        }
    }

    fn average() -> IntensityMeasure {
        IntensityMeasure::RockingSa(None).of_block(3.0)
    }

    #[test]
    fn powers_give_the_closed_form_which_a_wrong_one_misses() {
        let k = 2.5;
        let curves = [power(0.2, k), power(0.7, k), power(3.0, k)];
        let im = average();
        let of = |text: &str| {
            average_hazard(&curves, &im, text.parse().unwrap()).unwrap()
        };
        // ln SA is linear in ln T: the mean is at the geometric mean of T.
        let n = im.periods_s().len() as f64;
        let ln_t = im.periods_s().iter().map(|t| log(*t)).sum::<f64>() / n;
        for (text, lost) in [("1", 0.0), ("0.6,0.7", 0.49 * 0.4 / 2.0)] {
            let found = of(text);
            assert_eq!(found.im, HazardMeasure::Of(im.clone()));
            for (x, h) in found.curve.points() {
                let ln = (-2.0 * ln_t - log(*h)) / k - k * lost;
                assert!((log(*x) - ln).abs() < 1e-9, "{text}: {x} {h}");
            }
        }
        let (upper, own) = (of("1"), of("0.6,0.7"));
        let [a, b] = [&upper, &own].map(|h| h.curve.frequency(0.3).unwrap());
        // Perfect correlation is the upper bound, and far from the other.
        assert!((a / b / exp(k * k * 0.49 * 0.2) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn what_does_not_span_the_periods_is_refused() {
        let im = average();
        let one: SpectralCorrelation = "1".parse().unwrap();
        let refused = |curves: &[Hazard], im| {
            average_hazard(curves, im, one).unwrap_err().to_string()
        };
        let short = [power(0.2, 2.0), power(1.0, 2.0)];
        assert!(refused(&short, &im).contains("from 0.2 to 1 s: expected"));
        let twice = [power(0.2, 2.0), power(0.2, 2.0)];
        assert!(refused(&twice, &im).contains("two hazard curves"));
        assert!(refused(&[], &im).contains("span 0.3142 to 2.094 s"));
        let pga = IntensityMeasure::PGA;
        assert!(refused(&short, &pga).contains("expected one in AvgSA"));
        let mut other = power(0.2, 2.0);
        other.im = HazardMeasure::Of(IntensityMeasure::PGA);
        assert!(refused(&[other], &im).contains("of pga: expected one of SA"));
        for text in ["", "0.5", "1.1,0.6", "0.5,-1", "NaN,0.5", "0.5,0.6,1"] {
            assert!(text.parse::<SpectralCorrelation>().is_err(), "{text}");
        }
    }
}
