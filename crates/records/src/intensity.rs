//! Intensity measures of ground motions: peaks, integrals, durations, mean
//! period and response spectrum, of a component and of a pair.
//!
//! A record is linear between its samples and zero outside, as everywhere in
//! this crate. The measures are exact for this function, integrals and
//! responses of oscillators included. Nothing is corrected: if the baseline
//! drifts, PGV and PGD drift with it.
//!
//! A measure of two components has three forms: either component, the
//! geometric mean of both, and RotDnn, a percentile over all directions.

mod band;
mod energy;
mod fourier;
mod measure;
pub(crate) mod oscillator;
mod rotation;
mod settings;
pub mod velocity_pulse;

pub use band::RockingBand;
pub use measure::{
    AtUplift, Intensity, IntensityMeasure, IntensityRow, ScalarMeasure,
    ScalarRow,
};
pub(crate) use settings::LEAST_PERIOD_S;
pub use settings::{DEFAULT_PERIODS_S, Settings};

use thiserror::Error;

use fourier::Spectrum;
use oscillator::Oscillator;
use rocking::accelerogram::Accelerogram;
use rocking::stop;

/// Why intensity measures are refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum IntensityError {
    /// Gravity must be positive and finite.
    #[error("gravity {0} m/s2: expected a positive number")]
    Gravity(f64),
    /// A period is finite and at least 0.001 s: an oscillator takes steps in
    /// proportion to its period.
    #[error("period {0} s: expected at least 0.001 s")]
    Period(f64),
    /// The damping ratio must be at least 0 and below 1.
    #[error("damping ratio {0}: expected a number from 0 to below 1")]
    Damping(f64),
    /// A percentile lies from 0 to 100.
    #[error("percentile {0}: expected a number from 0 to 100")]
    Percentile(f64),
    /// Samples too far apart for the shortest pulse.
    #[error("sampling interval {0} s: expected at most 0.17 s")]
    Coarse(f64),
    /// Nothing moves, so that durations and periods do not exist.
    #[error("every sample is zero: expected a motion")]
    Silent,
    /// The components of a pair have different sampling intervals.
    #[error(
        "sampling intervals {first_s} s and {second_s} s: expected the same for both components"
    )]
    Intervals {
        /// Of the first component.
        first_s: f64,
        /// Of the second component.
        second_s: f64,
    },
}

/// Makes [`Measures`] of a table of scalars: the factor of each under a
/// gravity, and its value in g and s by one pass over the samples, `None` if
/// nothing moves.
macro_rules! measures {
    ($(
        $(#[$about:meta])+ $scalar:ident: $factor:expr, $direct:expr;
    )+) => {
        /// The measures of one component, or one number for each from a pair.
        #[derive(Clone, Debug, PartialEq)]
        #[non_exhaustive]
        #[cfg_attr(feature = "serde", derive(serde::Serialize))]
        pub struct Measures {
            $($(#[$about])+ pub $scalar: f64,)+
            /// Mean period T_m = sum(C^2/f)/sum(C^2) over the Fourier
            /// amplitudes C at 0.25 Hz <= f <= 20 Hz (Rathje, Abrahamson and
            /// Bray 1998), of the samples followed by zeros to a power of two
            /// and at least 20 s, so that frequencies are at most 0.05 Hz
            /// apart (Rathje, Faraj, Russell and Bray 2004). `None` if no
            /// frequency lies in the band.
            pub mean_period_s: Option<f64>,
            /// Pseudo-spectral acceleration (2 pi/T)^2 max|x| in multiples of
            /// gravity at the periods of the [`Settings`], in their order: the
            /// oscillator answers exactly, its peak is sought between samples
            /// and after the record's end.
            pub spectral_acceleration_g: Vec<f64>,
        }

        impl Measures {
            /// The measures whose scalars `number` computes from one or more
            /// directions.
            fn of_direct(
                gravity_m_s2: f64,
                number: impl Fn(fn(&Direct) -> Option<f64>) -> Option<f64>,
                mean_period_s: Option<f64>,
                spectral_acceleration_g: Vec<f64>,
            ) -> Result<Self, IntensityError> {
                $(
                    let factor: fn(f64) -> f64 = $factor;
                    let $scalar =
                        number($direct).ok_or(IntensityError::Silent)?;
                    let $scalar = factor(gravity_m_s2) * $scalar;
                )+
                Ok(Self {
                    $($scalar,)+
                    mean_period_s,
                    spectral_acceleration_g,
                })
            }

            /// Each measure of two components by `mean`.
            fn with(&self, other: &Self, mean: fn(f64, f64) -> f64) -> Self {
                let periods_s = self.mean_period_s.zip(other.mean_period_s);
                let own = self.spectral_acceleration_g.iter();
                let spectra = own.zip(&other.spectral_acceleration_g);
                Self {
                    $($scalar: mean(self.$scalar, other.$scalar),)+
                    mean_period_s: periods_s.map(|(a, b)| mean(a, b)),
                    spectral_acceleration_g: spectra
                        .map(|(a, b)| mean(*a, *b))
                        .collect(),
                }
            }

            /// The value of the measure of this name.
            pub fn scalar(&self, name: &str) -> Option<f64> {
                match name {
                    $(stringify!($scalar) => Some(self.$scalar),)+
                    _ => None,
                }
            }
        }
    };
}

measures! {
    /// Peak ground acceleration in multiples of gravity.
    pga_g: |_| 1.0, |d| Some(d.pga);
    /// Peak ground velocity: largest |v| at a sample, v(0) = 0.
    pgv_m_s: |g| g, |d| Some(d.pgv);
    /// Peak ground displacement: largest |d| at a sample, d(0) = v(0) = 0,
    /// exact for the acceleration between samples.
    pgd_m: |g| g, |d| Some(d.pgd);
    /// Arias intensity, pi/(2 g) times the integral of a^2 (Arias 1970).
    arias_intensity_m_s: |g| g, |d| Some(d.arias);
    /// Cumulative absolute velocity, the integral of |a| (EPRI 1988).
    cav_m_s: |g| g, |d| Some(d.cav);
    /// Time from 5 to 75 % of the Arias intensity (Trifunac and Brady 1975).
    significant_duration_5_75_s: |_| 1.0, |d| d.durations_s.map(|s| s[0]);
    /// Time from 5 to 95 % of the Arias intensity.
    significant_duration_5_95_s: |_| 1.0, |d| d.durations_s.map(|s| s[1]);
}

/// Limit of PGD (m): processed records of earthquakes, without permanent
/// offsets, have at most about 4 m.
const LARGEST_PGD_M: f64 = 5.0;

impl Measures {
    /// Whether the displacement comes from a drifting baseline: PGD above 5 m,
    /// which no processed record of an earthquake has.
    pub fn drifts(&self) -> bool {
        !(self.pgd_m <= LARGEST_PGD_M)
    }

    /// The measures of one component.
    ///
    /// # Errors
    /// [`IntensityError::Silent`] if every sample is zero.
    ///
    /// ```
    /// use rocking_records::intensity::{Measures, Settings};
    /// use rocking::accelerogram::Accelerogram;
    /// // 0.1 g for two seconds.
    /// let record = Accelerogram::try_new("step", 0.5, vec![0.1; 5])?;
    /// let m = Measures::of(&record, &Settings::default())?;
    /// assert!((m.cav_m_s - 0.2 * 9.80665).abs() < 1e-12);
    /// assert!((m.significant_duration_5_75_s - 1.4).abs() < 1e-12);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(
        record: &Accelerogram,
        settings: &Settings,
    ) -> Result<Self, IntensityError> {
        let (samples, dt_s) = (record.samples_g(), record.dt_s());
        let direct = Direct::of(samples, dt_s);
        let period = Spectrum::of(samples, dt_s).mean_period_s(None);
        let oscillators = settings.oscillators(dt_s);
        let spectrum = oscillators.iter().map(|o| o.peak(samples)).collect();
        let number = |scalar: fn(&Direct) -> Option<f64>| scalar(&direct);
        Self::of_direct(settings.gravity_m_s2(), number, period, spectrum)
    }

    /// The geometric mean of each measure of two components.
    pub fn geometric_mean(&self, other: &Self) -> Self {
        self.with(other, |a, b| (a * b).sqrt())
    }
}

/// The measures of two horizontal components at right angles.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct PairMeasures {
    /// Of each component as recorded.
    pub components: [Measures; 2],
    /// The geometric mean of both.
    pub geometric_mean: Measures,
    /// The given percentiles, over directions 0, 1, ... 179 degrees, of the
    /// measure of the rotated motion (RotDnn, Boore 2010), linear between the
    /// measures in order: RotD50 is the mean of the 90th and the 91st, RotD100
    /// the largest.
    pub rotd: Vec<Measures>,
}

impl PairMeasures {
    /// The measures of a pair, with these percentiles over its directions; the
    /// shorter component is followed by zeros.
    ///
    /// # Errors
    /// [`IntensityError`] for sampling intervals that differ, a percentile
    /// outside 0 to 100, or a silent component.
    ///
    /// ```
    /// use rocking_records::intensity::{PairMeasures, Settings};
    /// use rocking::accelerogram::Accelerogram;
    /// let a = Accelerogram::try_new("a", 0.5, vec![0.0, 0.2, 0.0])?;
    /// let pair = PairMeasures::of(&a, &a, &Settings::default(), &[50.0])?;
    /// // Both the same: 0.2 sqrt(2) |cos| about 45 degrees, median 0.2.
    /// assert!((pair.rotd[0].pga_g - 0.2).abs() < 1e-15);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn of(
        first: &Accelerogram,
        second: &Accelerogram,
        settings: &Settings,
        percentiles: &[f64],
    ) -> Result<Self, IntensityError> {
        let (first_s, second_s) = (first.dt_s(), second.dt_s());
        if first_s != second_s {
            return Err(IntensityError::Intervals { first_s, second_s });
        }
        let components =
            [Measures::of(first, settings)?, Measures::of(second, settings)?];
        let geometric_mean = components[0].geometric_mean(&components[1]);
        let rotd = rotation::rotd(first, second, settings, percentiles)?;
        Ok(Self { components, geometric_mean, rotd })
    }
}

/// The results of one pass over the samples, in g and s.
struct Direct {
    pga: f64,
    pgv: f64,
    pgd: f64,
    arias: f64,
    cav: f64,
    /// From 5 to 75 % and from 5 to 95 %; `None` if nothing moves.
    durations_s: Option<[f64; 2]>,
}

impl Direct {
    fn of(samples: &[f64], dt_s: f64) -> Self {
        stop::point();
        let (mut pgv, mut pgd, mut cav) = (0.0_f64, 0.0_f64, 0.0);
        // Velocity in dt/2, displacement in dt^2/6: then PGV has the bits of
        // the accelerogram's own.
        let (mut velocity, mut displacement) = (0.0, 0.0);
        for pair in samples.windows(2) {
            let (a, b) = (pair[0], pair[1]);
            displacement += 3.0 * velocity + (2.0 * a + b);
            velocity += a + b;
            pgv = pgv.max(f64::abs(velocity));
            pgd = pgd.max(f64::abs(displacement));
            cav += energy::absolute(a, b);
        }
        let (squares, durations_s) = energy::husid(samples, dt_s);
        Self {
            pga: samples.iter().fold(0.0, |p: f64, a| p.max(a.abs())),
            pgv: pgv * (0.5 * dt_s),
            pgd: pgd * (dt_s * dt_s / 6.0),
            arias: std::f64::consts::FRAC_PI_2 * squares,
            cav: cav * dt_s,
            durations_s,
        }
    }
}

#[cfg(test)]
mod tests;
