//! Ground motions: a scaled record or an analytic pulse.
//!
//! A further kind of excitation is a variant of [`Excitation`], an `impl` of
//! `Forcing`, and an arm in each method of `integrator::forcing::ground`.
//! Without a `remainder` no run under it ends early (proof P1 of the
//! integrator); with one, P9 must hold. The pool takes only records.

mod pulse;
mod record_index;

pub(crate) use pulse::PulseShape;

pub use pulse::{Pulse, PulseError, PulseKind, PulseName, PulseParameter};
pub(crate) use record_index::{RUN, RecordIndex, Remaining, Window};

use crate::accelerogram::{Accelerogram, AccelerogramError};
use crate::number::Number;

/// Ground acceleration as the block feels it.
#[derive(Clone, Copy, Debug)]
pub enum Excitation<'a> {
    /// A record, linear between samples and zero outside.
    Record(ScaledRecord<'a>),
    /// An analytic pulse from t = 0.
    Pulse(&'a Pulse),
    /// None: free motion from an initial rotation.
    Free,
}

/// A record scaled to an amplitude.
///
/// Sample i acts as `amplitude * samples[i]` in multiples of gravity. If the
/// samples are normalised by their peak, the amplitude *is* the peak ground
/// acceleration, to the last bit: a block whose uplift threshold equals it
/// does not move.
#[derive(Clone, Copy, Debug)]
pub struct ScaledRecord<'a> {
    samples: &'a [f64],
    dt_s: f64,
    amplitude: f64,
    /// Divisor of every sample: 1, or gravity in m/s2. It is separate because
    /// the quotient is rounded in the precision of the run.
    divisor: f64,
    index: Option<&'a RecordIndex>,
}

impl<'a> ScaledRecord<'a> {
    fn of(samples: &'a [f64], dt_s: f64, amplitude: f64) -> Self {
        Self { samples, dt_s, amplitude, divisor: 1.0, index: None }
    }

    /// The record as it is, times `factor`.
    pub fn by_factor(record: &'a Accelerogram, factor: f64) -> Self {
        Self::of(record.samples_g(), record.dt_s(), factor)
    }

    /// Samples in m/s2, each `dt_s` after the other, under gravity in m/s2.
    ///
    /// # Errors
    /// [`AccelerogramError`] for fewer than two samples, a sample that is
    /// not finite, or an interval or gravity that is not positive.
    ///
    /// ```
    /// use rocking::excitation::ScaledRecord;
    /// let samples_m_s2 = [0.0, 2.5, -3.0, 0.0];
    /// let record = ScaledRecord::try_new_si(&samples_m_s2, 0.1, 9.81)?;
    /// assert_eq!(record.factor::<f64>(), 1.0 / 9.81);
    /// # Ok::<(), rocking::accelerogram::AccelerogramError>(())
    /// ```
    pub fn try_new_si(
        samples_m_s2: &'a [f64],
        dt_s: f64,
        gravity_m_s2: f64,
    ) -> Result<Self, AccelerogramError> {
        Accelerogram::check(dt_s, samples_m_s2)?;
        if !(gravity_m_s2 > 0.0 && gravity_m_s2.is_finite()) {
            return Err(AccelerogramError::Gravity(gravity_m_s2));
        }
        let divisor = gravity_m_s2;
        Ok(Self { divisor, ..Self::of(samples_m_s2, dt_s, 1.0) })
    }

    /// The record scaled to a peak ground acceleration in multiples of
    /// gravity.
    pub fn to_pga(record: &'a NormalisedRecord, pga_g: f64) -> Self {
        let index = Some(&record.index);
        Self { index, ..Self::of(&record.samples, record.dt_s, pga_g) }
    }

    /// Samples before scaling.
    pub fn samples(&self) -> &'a [f64] {
        self.samples
    }

    /// Sampling interval in s.
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Index of the samples, if there is one.
    pub(crate) fn index(&self) -> Option<&'a RecordIndex> {
        self.index
    }

    /// Factor on every sample.
    pub fn amplitude(&self) -> f64 {
        self.factor()
    }

    /// Factor on every sample, in the precision of the type.
    pub fn factor<N: Number>(&self) -> N {
        N::from_f64(self.amplitude) / N::from_f64(self.divisor)
    }
}

/// A record divided by its peak, made once and shared by all levels and
/// blocks of an IDA.
///
/// ```
/// use rocking::excitation::NormalisedRecord;
/// use rocking::accelerogram::Accelerogram;
/// let record = Accelerogram::try_new("hand", 0.1, vec![0.1, -0.3, 0.2])?;
/// let unit = NormalisedRecord::new(&record);
/// assert_eq!(unit.samples()[1], -1.0);
/// assert_eq!(unit.pga_g(), 0.3);
/// # Ok::<(), rocking::accelerogram::AccelerogramError>(())
/// ```
#[derive(Clone, Debug)]
pub struct NormalisedRecord {
    name: String,
    samples: Vec<f64>,
    dt_s: f64,
    pga_g: f64,
    pgv_g_s: f64,
    index: RecordIndex,
}

impl NormalisedRecord {
    /// Divides the record by its peak; a record of zeros stays as it is.
    pub fn new(record: &Accelerogram) -> Self {
        let pga_g = record.pga_g();
        let unit = if pga_g > 0.0 { pga_g } else { 1.0 };
        let samples: Vec<f64> =
            record.samples_g().iter().map(|a| a / unit).collect();
        Self {
            index: RecordIndex::new(&samples),
            name: record.name().to_owned(),
            samples,
            dt_s: record.dt_s(),
            pga_g,
            pgv_g_s: record.pgv_g_s(),
        }
    }

    /// The record's name.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Samples divided by the peak, in [-1, 1].
    pub fn samples(&self) -> &[f64] {
        &self.samples
    }

    /// Sampling interval in s.
    pub fn dt_s(&self) -> f64 {
        self.dt_s
    }

    /// Peak ground acceleration of the record as given, multiples of
    /// gravity.
    pub fn pga_g(&self) -> f64 {
        self.pga_g
    }

    /// Peak ground velocity of the record as given over gravity, in s.
    pub fn pgv_g_s(&self) -> f64 {
        self.pgv_g_s
    }

    /// PGV over PGA in s: the factor, times p, from PGA/(g tan alpha) to
    /// p PGV/(g tan alpha). Not a number for a record of zeros.
    pub fn velocity_ratio_s(&self) -> f64 {
        self.pgv_g_s / self.pga_g
    }
}
