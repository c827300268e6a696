//! Corrections of a record at the user's request. Nothing else changes
//! samples.
//!
//! The filter is Butterworth's high-pass of order 4, from the analogue one by
//! the bilinear transform with the corner prewarped. It runs forwards and then
//! backwards and has no delay: its gain is 1/(1 + (corner/f)^8), one half (in
//! amplitude) at the corner. For its transients 1.5 x 4 / corner seconds of
//! zeros are first added before and after the record (Converse and Brady 1992,
//! USGS Open-File Report 92-296A). They stay, because velocity and
//! displacement are consistent only with them (Boore, Sisi and Akkar 2012,
//! BSSA 102).

use std::fmt;

use thiserror::Error;

use rocking::accelerogram::{Accelerogram, AccelerogramError, mean};

/// Order of the filter, in each direction.
const ORDER: f64 = 4.0;

/// Duration of zeros at each end in periods of the corner, over the order.
const PADDING: f64 = 1.5;

/// The most samples of a padded record.
const MOST_SAMPLES: f64 = 1e7;

/// Why a record cannot be processed.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ProcessingError {
    /// The corner must be positive and finite.
    #[error("corner {0} Hz: expected a positive number")]
    Corner(f64),
    /// The corner must lie below half the sampling rate.
    #[error(
        "{name}: corner {corner_hz} Hz: expected less than {nyquist_hz} Hz, half the sampling rate"
    )]
    Nyquist {
        /// The record.
        name: String,
        /// The corner.
        corner_hz: f64,
        /// Half the sampling rate.
        nyquist_hz: f64,
    },
    /// The zeros at the ends would need too much memory.
    #[error(
        "{name}: corner {corner_hz} Hz: expected one high enough for at most {MOST_SAMPLES} samples with the zeros at both ends"
    )]
    Long {
        /// The record.
        name: String,
        /// The corner.
        corner_hz: f64,
    },
    /// Samples so large that sums of them overflow.
    #[error(transparent)]
    Samples(#[from] AccelerogramError),
}

/// Processing of every record before its use: the mean is removed, then the
/// high-pass filter is applied. Displays as the words for results.
///
/// ```
/// use rocking::accelerogram::Accelerogram;
/// use rocking_records::Processing;
/// let raw = Accelerogram::try_new("x", 0.01, vec![0.1, 0.3, -0.1, 0.1])?;
/// let processing = Processing::try_new(true, None)?;
/// let record = processing.apply(&raw)?;
/// assert!((record.samples_g()[1] - 0.2).abs() < 1e-15);
/// assert_eq!(processing.to_string(), "mean removed");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Processing {
    demean: bool,
    high_pass_hz: Option<f64>,
}

impl Processing {
    /// Processing that removes the mean if `demean` is true, and then applies
    /// a high-pass filter with the corner `high_pass_hz` in Hz, if there is
    /// one.
    ///
    /// # Errors
    /// [`ProcessingError::Corner`] for a corner that is not positive.
    pub fn try_new(
        demean: bool,
        high_pass_hz: Option<f64>,
    ) -> Result<Self, ProcessingError> {
        match high_pass_hz.filter(|hz| !(*hz > 0.0 && hz.is_finite())) {
            Some(hz) => Err(ProcessingError::Corner(hz)),
            None => Ok(Self { demean, high_pass_hz }),
        }
    }

    /// Whether the record stays as it is.
    pub fn is_none(&self) -> bool {
        !self.demean && self.high_pass_hz.is_none()
    }

    /// Duration of zeros at each end, in s.
    pub fn padding_s(&self) -> f64 {
        self.high_pass_hz.map_or(0.0, |hz| PADDING * ORDER / hz)
    }

    /// The processed record, under the same name.
    ///
    /// # Errors
    /// [`ProcessingError`] for a corner at or above half the sampling rate,
    /// or so low that the padding would be too long.
    pub fn apply(
        &self,
        record: &Accelerogram,
    ) -> Result<Accelerogram, ProcessingError> {
        let dt_s = record.dt_s();
        let mut samples = record.samples_g().to_vec();
        if self.demean {
            let mean = mean(&samples);
            samples.iter_mut().for_each(|a| *a -= mean);
        }
        let name = record.name().to_owned();
        if let Some(corner_hz) = self.high_pass_hz {
            let nyquist_hz = 0.5 / dt_s;
            if !(corner_hz < nyquist_hz) {
                return Err(ProcessingError::Nyquist {
                    name,
                    corner_hz,
                    nyquist_hz,
                });
            }
            let zeros = (self.padding_s() / dt_s).ceil();
            if !(2.0 * zeros + samples.len() as f64 <= MOST_SAMPLES) {
                return Err(ProcessingError::Long { name, corner_hz });
            }
            let pad = vec![0.0; zeros as usize];
            samples = [pad.clone(), samples, pad].concat();
            let sections = butterworth(corner_hz * dt_s);
            for _ in 0..2 {
                for section in sections {
                    section.run(&mut samples);
                }
                samples.reverse();
            }
        }
        Ok(Accelerogram::try_new(name, dt_s, samples)?)
    }
}

impl fmt::Display for Processing {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let mean = self.demean.then(|| "mean removed".to_owned());
        let filter = self.high_pass_hz.map(|hz| format!(
            "Butterworth high-pass of order {ORDER} at {hz} Hz, forwards and backwards, {} s of zeros added at both ends",
            self.padding_s()
        ));
        let all: Vec<String> = mean.into_iter().chain(filter).collect();
        f.write_str(&all.join("; "))
    }
}

/// One section of order 2: y = b x - a y over the last three samples.
#[derive(Clone, Copy)]
struct Section {
    b: [f64; 3],
    a: [f64; 2],
}

/// The two sections of the high-pass; `corner` in cycles per sample.
fn butterworth(corner: f64) -> [Section; 2] {
    let k = libm::tan(std::f64::consts::PI * corner);
    // Poles at pi/8 and 3 pi/8 from the negative real axis.
    [1.0, 3.0].map(|odd| {
        let damping = 2.0 * libm::cos(odd * std::f64::consts::PI / 8.0);
        let scale = 1.0 / k.mul_add(k, damping.mul_add(k, 1.0));
        let a1 = 2.0 * k.mul_add(k, -1.0) * scale;
        let a2 = k.mul_add(k, (-damping).mul_add(k, 1.0)) * scale;
        Section { b: [scale, -2.0 * scale, scale], a: [a1, a2] }
    })
}

impl Section {
    /// Filters from rest, in place (transposed direct form II).
    fn run(self, samples: &mut [f64]) {
        let Self { b, a } = self;
        let (mut first, mut second) = (0.0, 0.0);
        for sample in samples {
            let x = *sample;
            let y = f64::mul_add(b[0], x, first);
            first = f64::mul_add(b[1], x, (-a[0]).mul_add(y, second));
            second = f64::mul_add(b[2], x, -a[1] * y);
            *sample = y;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn waves(hz: f64, n: usize) -> Accelerogram {
        let turn = 2.0 * std::f64::consts::PI * hz * 0.01;
        let samples = (0..n).map(|i| libm::sin(turn * i as f64)).collect();
        Accelerogram::try_new("x", 0.01, samples).unwrap()
    }

    /// The gain of the formula, in the middle of a long sine.
    #[test]
    fn the_gain_is_butterworths_squared() {
        let processing = Processing::try_new(false, Some(0.5)).unwrap();
        let pad = (processing.padding_s() / 0.01).ceil() as usize;
        assert_eq!(pad, 1200);
        let warped = |hz: f64| libm::tan(std::f64::consts::PI * hz * 0.01);
        for hz in [0.25, 0.5, 0.75, 1.0, 5.0] {
            let raw = waves(hz, 12_000);
            let found = processing.apply(&raw).unwrap();
            assert_eq!(found.samples_g().len(), 12_000 + 2 * pad);
            let middle = &found.samples_g()[pad + 4000..pad + 8000];
            let peak = middle.iter().fold(0.0, |p: f64, a| p.max(a.abs()));
            let ratio = warped(0.5) / warped(hz);
            let expected = 1.0 / (1.0 + libm::pow(ratio, 8.0));
            assert!((peak - expected).abs() < 1e-3, "{hz}: {peak}");
            // Nothing is delayed: a positive multiple of the same wave.
            let same = &raw.samples_g()[4000..8000];
            let mut product = 0.0;
            for (a, b) in middle.iter().zip(same) {
                product += a * b;
            }
            assert!(product > 0.49 * expected * 4000.0, "{hz}");
        }
    }

    #[test]
    fn reversed_in_time_gives_the_reverse() {
        let raw = waves(0.7, 900);
        let processing = Processing::try_new(true, Some(0.3)).unwrap();
        let mut backwards = raw.samples_g().to_vec();
        backwards.reverse();
        let backwards = Accelerogram::try_new("x", 0.01, backwards).unwrap();
        let found = processing.apply(&raw).unwrap();
        let other = processing.apply(&backwards).unwrap();
        let pairs =
            found.samples_g().iter().zip(other.samples_g().iter().rev());
        let off = pairs.fold(0.0, |o: f64, (a, b)| o.max((a - b).abs()));
        // The transients are cut where the zeros end.
        assert!(off < 1e-6, "{off}");
        assert!(found.pgv_g_s() < 1.0);
    }

    #[test]
    fn an_offset_is_gone_and_nonsense_refused() {
        let raw = Accelerogram::try_new("x", 0.01, vec![0.1, 0.4, 0.2, 0.3])
            .unwrap();
        let found =
            Processing::try_new(true, None).unwrap().apply(&raw).unwrap();
        let expected = [-0.15, 0.15, -0.05, 0.05];
        for (a, b) in found.samples_g().iter().zip(expected) {
            assert!((a - b).abs() < 1e-15);
        }
        let same = Processing::default();
        assert!(same.is_none() && same.apply(&raw).unwrap() == raw);
        for hz in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            assert!(Processing::try_new(false, Some(hz)).is_err());
        }
        let refused = |hz| {
            let processing = Processing::try_new(false, Some(hz)).unwrap();
            processing.apply(&raw).unwrap_err().to_string()
        };
        assert!(refused(50.0).contains("expected less than 50 Hz"));
        assert!(refused(1e-5).contains("at most 10000000 samples"));
        assert_eq!(
            Processing::try_new(true, Some(0.1)).unwrap().to_string(),
            "mean removed; Butterworth high-pass of order 4 at 0.1 Hz, forwards and backwards, 60 s of zeros added at both ends"
        );
    }
}
