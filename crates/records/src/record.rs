//! A record as it was read, and the values of the caller for its file.

use rocking::accelerogram::Accelerogram;
use rocking::units::{self, AccelerationUnit};
use sha2::{Digest as _, Sha256};

use crate::direction::Direction;
use crate::error::Result;
use crate::format::Format;
use crate::quality::Remark;

/// Least and largest sampling interval (s) of a record. Intervals of recorders
/// are far inside; a number outside is not an interval, or not in s.
pub(crate) const INTERVALS_S: (f64, f64) = (1e-6, 10.0);

/// SHA-256 of `bytes` in hexadecimal (FIPS 180-4), as in an index.
///
/// ```
/// let sum = rocking_records::sha256_hex(b"abc");
/// assert!(sum.starts_with("ba7816bf8f01cfea414140de5dae2223"));
/// ```
pub fn sha256_hex(bytes: &[u8]) -> String {
    let sum = Sha256::digest(bytes);
    sum.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// Values of the caller for a file.
///
/// They may repeat the statements of a file, but not contradict them. In a
/// suite they apply to the files without such a statement; if no file takes a
/// value, all files must agree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadOptions {
    /// Sampling interval in s, for files without it.
    pub dt_s: Option<f64>,
    /// Unit of the samples, for files without it.
    pub unit: Option<AccelerationUnit>,
    /// Gravity in m/s2 by which an SI record is divided.
    pub gravity_m_s2: f64,
    /// Whether folders inside the folder of a suite are read.
    pub recursive: bool,
}

impl Default for ReadOptions {
    /// Nothing but standard gravity.
    fn default() -> Self {
        let gravity_m_s2 = units::STANDARD_GRAVITY_M_S2;
        Self { dt_s: None, unit: None, gravity_m_s2, recursive: false }
    }
}

/// Which values of the caller were taken because the file lacks them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Fallback {
    /// Sampling interval.
    pub dt: bool,
    /// Unit of the samples.
    pub unit: bool,
}

/// One component as it was read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Record {
    /// The component.
    pub accelerogram: Accelerogram,
    /// Format of the file.
    pub format: &'static Format,
    /// Unit in which the file is written (cm/s2 for the counts of K-NET and
    /// for GeoNet's mm/s2).
    pub unit: AccelerationUnit,
    /// Direction of the sensor.
    pub direction: Direction,
    /// Whether the sensor is in a borehole (KiK-net), not at the surface.
    pub borehole: bool,
    /// Remarks on the file from its reading; [`remarks`](crate::remarks)
    /// judges the samples.
    pub remarks: Vec<Remark>,
    /// Name of the channel, if the file has one: its number, its direction or
    /// both.
    pub channel: Option<String>,
    /// Event and station, if the file names both: the components of one motion
    /// share them.
    pub site: Option<String>,
    /// Values of the caller that the file does not state.
    pub given: Fallback,
}

/// A record, and whether the caller contradicts its file. In a file outside of
/// a suite a contradiction is a fault.
pub(crate) struct Agreement {
    pub(crate) record: Record,
    pub(crate) dt: Result<()>,
    pub(crate) unit: Result<()>,
}

impl Agreement {
    /// The record, if the caller does not contradict its file.
    pub(crate) fn agreed(self) -> Result<Record> {
        self.dt.and(self.unit).map(|()| self.record)
    }
}
