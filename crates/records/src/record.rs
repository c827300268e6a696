//! A record as it was read, and what the caller knows about its file.

use std::fmt;

use rocking::accelerogram::Accelerogram;
use rocking::units::{self, AccelerationUnit};
use sha2::{Digest as _, Sha256};

use crate::direction::Direction;
use crate::error::RecordError;
use crate::given::Given;
use crate::quality::Remark;

/// How a record file is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Format {
    /// PEER's AT2, every generation.
    At2,
    /// BRI (Japan), `.ac`.
    Bri,
    /// One value a line, without a header.
    Column,
    /// A name, number of samples and interval, samples: eqsig, EMOD3D,
    /// RspMatch.
    Counted,
    /// Two columns, time and acceleration.
    Csv,
    /// RESORCE, 5E14.7.
    Resorce,
    /// COSMOS V1 and V2, and CSMIP V2.
    Cosmos,
    /// ESM and ITACA ASCII (DYNA), and AFAD's today.
    Esm,
    /// AFAD's text of three columns, until 2018.
    Afad,
    /// GeoNet (New Zealand), V1A and V2A.
    Geonet,
    /// K-NET and KiK-net ASCII.
    Knet,
    /// USGS SMC.
    Smc,
}

/// Least and largest sampling interval (s) of a record: a recorder's lies far
/// inside, and what lies outside is no interval or not in s.
pub(crate) const INTERVALS_S: (f64, f64) = (1e-6, 10.0);

/// Formats by name, for messages.
pub(crate) const FORMATS: &str = "afad, at2, bri, cosmos, esm, geonet, knet, resorce, smc, counted (count and interval, samples), csv (time, acceleration), column";

impl fmt::Display for Format {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::At2 => "at2",
            Self::Bri => "bri",
            Self::Column => "column",
            Self::Counted => "counted",
            Self::Csv => "csv",
            Self::Resorce => "resorce",
            Self::Cosmos => "cosmos",
            Self::Esm => "esm",
            Self::Afad => "afad",
            Self::Geonet => "geonet",
            Self::Knet => "knet",
            Self::Smc => "smc",
        })
    }
}

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

/// One component as it was read.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Record {
    /// The component.
    pub accelerogram: Accelerogram,
    /// Format of the file.
    pub format: Format,
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
    pub given: Given,
}

/// A record, and whether the caller contradicts its file, which is a fault in
/// a file that belongs to no suite.
pub(crate) struct Settled {
    pub(crate) record: Record,
    pub(crate) dt: Result<(), RecordError>,
    pub(crate) unit: Result<(), RecordError>,
}

impl Settled {
    /// The record, if nothing given contradicts its file.
    pub(crate) fn agreed(self) -> Result<Record, RecordError> {
        self.dt.and(self.unit).map(|()| self.record)
    }
}

/// What a format's reader finds: one component in the file's own unit.
#[derive(Default)]
pub(crate) struct Channel {
    pub(crate) dt: Option<f64>,
    pub(crate) unit: Option<AccelerationUnit>,
    pub(crate) samples: Vec<f64>,
    /// What the file calls the channel.
    pub(crate) label: Option<String>,
    /// Event and station, where the file names both.
    pub(crate) site: Option<String>,
    /// Where the sensor points, by the header alone.
    pub(crate) direction: Direction,
    /// Whether the sensor is in a borehole.
    pub(crate) borehole: bool,
    /// What is suspicious about the text.
    pub(crate) remarks: Vec<Remark>,
}
