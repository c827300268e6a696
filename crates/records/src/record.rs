//! A record as it was read, and what the caller knows about its file.

use rocking::accelerogram::Accelerogram;
use rocking::units::{self, AccelerationUnit};
use sha2::{Digest as _, Sha256};

use crate::direction::Direction;
use crate::error::Result;
use crate::format::Format;
use crate::quality::Remark;

/// Least and largest sampling interval (s) of a record: a recorder's lies far
/// inside, and what lies outside is no interval or not in s.
pub(crate) const INTERVALS_S: (f64, f64) = (1e-6, 10.0);

/// SHA-256 of `bytes` in hexadecimal (FIPS 180-4), as an index states it of
/// each file.
///
/// ```
/// let sum = rocking_records::sha256_hex(b"abc");
/// assert!(sum.starts_with("ba7816bf8f01cfea414140de5dae2223"));
/// ```
#[must_use]
pub fn sha256_hex(bytes: &[u8]) -> String {
    let sum = Sha256::digest(bytes);
    sum.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// What the caller knows about a file.
///
/// What a file states may be repeated, but not contradicted. In a suite, what
/// is given holds for the files that state nothing; if no file takes it, all
/// files must agree with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ReadOptions {
    /// Sampling interval in s, for files that state none.
    pub dt_s: Option<f64>,
    /// Unit of the samples, for files that state none.
    pub unit: Option<AccelerationUnit>,
    /// Gravity in m/s2 by which an SI record is divided.
    pub gravity_m_s2: f64,
    /// Whether the folders within a suite's folder are read.
    pub recursive: bool,
}

impl Default for ReadOptions {
    /// Nothing but standard gravity.
    fn default() -> Self {
        let gravity_m_s2 = units::STANDARD_GRAVITY_M_S2;
        Self { dt_s: None, unit: None, gravity_m_s2, recursive: false }
    }
}

/// What the caller gave because the file states none.
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
    /// Where the sensor points.
    pub direction: Direction,
    /// Whether the sensor is in a borehole (KiK-net), not at the surface.
    pub borehole: bool,
    /// What reading found suspicious about the file;
    /// [`remarks`](crate::remarks) judges the samples.
    pub remarks: Vec<Remark>,
    /// Name of the channel, where the file gives one: its number, its
    /// direction or both.
    pub channel: Option<String>,
    /// Event and station, where the file names both: components of one
    /// motion share them.
    pub site: Option<String>,
    /// What the caller gave because the file states none.
    pub given: Fallback,
}

/// A record, and whether the caller contradicts its file, which is a fault in
/// a file that belongs to no suite.
pub(crate) struct Agreement {
    pub(crate) record: Record,
    pub(crate) dt: Result<()>,
    pub(crate) unit: Result<()>,
}

impl Agreement {
    /// The record, if nothing given contradicts its file.
    pub(crate) fn agreed(self) -> Result<Record> {
        self.dt.and(self.unit).map(|()| self.record)
    }
}
