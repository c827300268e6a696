//! RotD50: the median over directions.

use super::oscillator::OscillatorState;
use super::{Direct, IntensityError, Measures, Settings, Spectrum};
use rocking::accelerogram::Accelerogram;

/// Directions from 0 degrees by 1 degree: the other half turn repeats them.
const DIRECTIONS: u32 = 180;

/// Median over directions of the measures of the rotated motion.
pub(super) fn rotd50(
    first: &Accelerogram,
    second: &Accelerogram,
    settings: &Settings,
) -> Result<Measures, IntensityError> {
    let dt_s = first.dt_s();
    let n = first.samples_g().len().max(second.samples_g().len());
    let padded = |record: &Accelerogram| {
        let mut samples = record.samples_g().to_vec();
        samples.resize(n, 0.0);
        samples
    };
    let (a, b) = (padded(first), padded(second));
    let turned: Vec<(f64, f64)> = (0..DIRECTIONS)
        .map(|degree| {
            let (sin, cos) = libm::sincos(f64::from(degree).to_radians());
            (cos, sin)
        })
        .collect();
    let mix = |a: &[f64], b: &[f64], (cos, sin): (f64, f64)| -> Vec<f64> {
        a.iter().zip(b).map(|(x, y)| cos * x + sin * y).collect()
    };
    let direct: Vec<Direct> = turned
        .iter()
        .map(|turn| Direct::of(&mix(&a, &b, *turn), dt_s))
        .collect();
    // A direction in which nothing moves has no durations.
    let number = |scalar: fn(&Direct) -> Option<f64>| {
        median(direct.iter().filter_map(scalar).collect())
    };
    let spectra = (Spectrum::of(&a, dt_s), Spectrum::of(&b, dt_s));
    let periods = turned.iter().filter_map(|(cos, sin)| {
        spectra.0.mean_period_s(Some((&spectra.1, *cos, *sin)))
    });
    let mut spectrum = Vec::new();
    for oscillator in settings.oscillators(dt_s) {
        let rest = [0.0; 2];
        let (x, y) =
            (oscillator.states(rest, &a), oscillator.states(rest, &b));
        let peaks = turned.iter().map(|(cos, sin)| {
            let states: Vec<OscillatorState> = x
                .iter()
                .zip(&y)
                .map(|(x, y)| [0, 1].map(|k: usize| cos * x[k] + sin * y[k]))
                .collect();
            oscillator.peak_of(&states, &mix(&a, &b, (*cos, *sin)))
        });
        spectrum.push(median(peaks.collect()).ok_or(IntensityError::Silent)?);
    }
    let period = median(periods.collect());
    let gravity_m_s2 = settings.gravity_m_s2();
    Measures::of_direct(gravity_m_s2, number, period, spectrum)
}

/// Median, of an even count the mean of the middle two; none of nothing.
fn median(mut values: Vec<f64>) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let (low, high) = ((values.len().max(1) - 1) / 2, values.len() / 2);
    Some(0.5 * (values.get(low)? + values.get(high)?))
}
