//! RotDnn: percentiles over directions.

use super::oscillator::OscillatorState;
use super::{Direct, IntensityError, Measures, Settings, Spectrum};
use rocking::accelerogram::Accelerogram;

/// Number of directions, from 0 degrees in steps of 1 degree: the other half
/// turn repeats them.
const DIRECTIONS: u32 = 180;

/// Percentiles over directions of the measures of the rotated motion.
pub(super) fn rotd(
    first: &Accelerogram,
    second: &Accelerogram,
    settings: &Settings,
    percentiles: &[f64],
) -> Result<Vec<Measures>, IntensityError> {
    let within = |p: &&f64| (0.0..=100.0).contains(*p);
    if let Some(wrong) = percentiles.iter().find(|p| !within(p)) {
        return Err(IntensityError::Percentile(*wrong));
    }
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
    let spectra = (Spectrum::of(&a, dt_s), Spectrum::of(&b, dt_s));
    let mean_periods = turned.iter().filter_map(|(cos, sin)| {
        spectra.0.mean_period_s(Some((&spectra.1, *cos, *sin)))
    });
    let mean_periods: Vec<f64> = mean_periods.collect();
    let mut spectrum: Vec<Vec<f64>> = Vec::new();
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
        spectrum.push(peaks.collect());
    }
    let at = |p: &f64| {
        // A direction in which nothing moves has no durations.
        let number = |scalar: fn(&Direct) -> Option<f64>| {
            percentile(direct.iter().filter_map(scalar).collect(), *p)
        };
        let peaks = spectrum.iter().map(|all| percentile(all.clone(), *p));
        let peaks: Option<Vec<f64>> = peaks.collect();
        Measures::of_direct(
            settings.gravity_m_s2(),
            number,
            percentile(mean_periods.clone(), *p),
            peaks.ok_or(IntensityError::Silent)?,
        )
    };
    percentiles.iter().map(at).collect()
}

/// A percentile, linear between the values in order; `None` without values.
fn percentile(mut values: Vec<f64>, percentile: f64) -> Option<f64> {
    values.sort_by(f64::total_cmp);
    let last = values.len().checked_sub(1)?;
    let place = percentile / 100.0 * last as f64;
    let (low, share) = (place as usize, place.fract());
    let next = values[last.min(low + 1)];
    Some((1.0 - share) * values[low] + share * next)
}
