//! One component of ground acceleration, checked once, and the names that
//! results can contain.

mod name;

use thiserror::Error;

pub use name::{EXPECTED, EscapedName, are_places};
pub use name::{NameError, SuiteNameError, result_name, suite_names};

/// Mean of samples, summed in their order.
pub fn mean(samples: &[f64]) -> f64 {
    samples.iter().fold(0.0, |sum, x| sum + x) / samples.len() as f64
}

/// Why a sequence of samples is no accelerogram.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum AccelerogramError {
    /// Results contain the name.
    #[error(transparent)]
    Name(#[from] NameError),
    /// At least two samples are needed for a duration.
    #[error("{found} samples: expected at least 2")]
    TooFewSamples {
        /// Number of samples given.
        found: usize,
    },
    /// The sampling interval must be positive and finite.
    #[error("sampling interval {0} s: expected a positive number")]
    SamplingInterval(f64),
    /// Every sample must be finite.
    #[error("sample {index} is {value}: expected a finite number")]
    NotFinite {
        /// Zero-based index of the sample.
        index: usize,
        /// The sample.
        value: f64,
    },
    /// Gravity must be positive and finite.
    #[error("gravity {0} m/s2: expected a positive number")]
    Gravity(f64),
}

/// Ground acceleration at equal intervals, in multiples of gravity.
///
/// Sample i is at t = i dt; between samples the acceleration is linear;
/// before the first and after the last it is zero (a jump, if they are not).
///
/// ```
/// use rocking::accelerogram::Accelerogram;
/// let record = Accelerogram::try_new("hand", 0.5, vec![0.0, 0.2, -0.4, 0.0])?;
/// assert_eq!(record.pga_g(), 0.4);
/// assert_eq!(record.duration_s(), 1.5);
/// // Cumulative trapezoid with v(0) = 0: 0.05, 0.0, -0.1 (in g s).
/// assert!((record.pgv_g_s() - 0.1).abs() < 1e-15);
/// # Ok::<(), rocking::accelerogram::AccelerogramError>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Accelerogram {
    name: String,
    dt_s: f64,
    samples_g: Vec<f64>,
}

impl Accelerogram {
    /// Accelerogram named `name` with samples `samples_g` (multiples of
    /// gravity) every `dt_s` seconds.
    ///
    /// # Errors
    /// [`AccelerogramError`] for fewer than two samples, an interval that is
    /// not positive and finite, a sample that is not finite, or a name that
    /// results cannot contain ([`result_name`]).
    pub fn try_new(
        name: impl Into<String>,
        dt_s: f64,
        samples_g: Vec<f64>,
    ) -> Result<Self, AccelerogramError> {
        Self::check(dt_s, &samples_g)?;
        Self { name: String::new(), dt_s, samples_g }.named(name)
    }

    /// Checks samples of any unit.
    pub fn check(dt_s: f64, samples: &[f64]) -> Result<(), AccelerogramError> {
        if !(dt_s > 0.0 && dt_s.is_finite()) {
            return Err(AccelerogramError::SamplingInterval(dt_s));
        }
        if samples.len() < 2 {
            let found = samples.len();
            return Err(AccelerogramError::TooFewSamples { found });
        }
        if let Some(index) = samples.iter().position(|a| !a.is_finite()) {
            let value = samples[index];
            return Err(AccelerogramError::NotFinite { index, value });
        }
        Ok(())
    }

    /// Name by which results refer to the record.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The same motion under another name.
    ///
    /// # Errors
    /// [`AccelerogramError::Name`] for a name that results cannot contain.
    pub fn named(
        self,
        name: impl Into<String>,
    ) -> Result<Self, AccelerogramError> {
        let name = name.into();
        result_name(&name)?;
        Ok(Self { name, ..self })
    }

    /// Sampling interval in s.
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Samples in multiples of gravity.
    pub fn samples_g(&self) -> &[f64] {
        &self.samples_g
    }

    /// Time from the first to the last sample in s.
    pub fn duration_s(&self) -> f64 {
        (self.samples_g.len() - 1) as f64 * self.dt_s
    }

    /// Peak ground acceleration: largest absolute sample, as given, in
    /// multiples of gravity.
    pub fn pga_g(&self) -> f64 {
        self.samples_g.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()))
    }

    /// Peak ground velocity divided by gravity, in s: largest absolute value
    /// at a sample of the cumulative trapezoid with v(0) = 0 and no baseline
    /// correction.
    pub fn pgv_g_s(&self) -> f64 {
        let mut sum = 0.0;
        let mut peak: f64 = 0.0;
        for pair in self.samples_g.windows(2) {
            sum += pair[0] + pair[1];
            peak = peak.max(f64::abs(sum));
        }
        0.5 * self.dt_s * peak
    }

    /// Velocity (m/s) and displacement (m) at the samples, from rest under
    /// gravity `gravity_m_s2`, exact for an acceleration that is linear
    /// between them.
    ///
    /// ```
    /// use rocking::accelerogram::Accelerogram;
    /// let record = Accelerogram::try_new("step", 0.5, vec![0.1; 3])?;
    /// let (velocity, displacement) = record.integrals(10.0);
    /// // a t and a t^2/2 of 1 m/s2 after 1 s.
    /// assert_eq!((velocity[2], displacement[2]), (1.0, 0.5));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn integrals(&self, gravity_m_s2: f64) -> (Vec<f64>, Vec<f64>) {
        let dt_s = self.dt_s;
        let (mut v, mut d) = (0.0, 0.0);
        let (mut velocity, mut displacement) = (vec![v], vec![d]);
        for pair in self.samples_g.windows(2) {
            let (a, b) = (gravity_m_s2 * pair[0], gravity_m_s2 * pair[1]);
            d += dt_s * (v + dt_s * (2.0 * a + b) / 6.0);
            v += 0.5 * dt_s * (a + b);
            velocity.push(v);
            displacement.push(d);
        }
        (velocity, displacement)
    }

    /// Peak ground velocity in m/s under gravity `gravity_m_s2`.
    pub fn pgv_m_s(&self, gravity_m_s2: f64) -> f64 {
        self.pgv_g_s() * gravity_m_s2
    }
}
