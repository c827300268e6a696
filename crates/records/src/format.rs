//! Formats of record files, a module for each. The row of a format in
//! [`Format::ALL`] has everything that readers, documentation and tests need.

mod afad;
mod at2;
mod bri;
mod column;
mod cosmos;
mod counted;
mod csv;
mod esm;
mod geonet;
mod knet;
mod resorce;
mod smc;

use rocking::units::AccelerationUnit;

use crate::direction::Direction;
use crate::error::Result;
use crate::quality::Remark;
use crate::text::Text;

/// The unit of many networks.
const GAL: AccelerationUnit = AccelerationUnit::CentimetrePerSecondSquared;

/// Statements of a format about its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Header {
    /// Number of samples, sampling interval and, in most files, unit.
    Full,
    /// Number of samples and sampling interval.
    NoUnit,
    /// Sampling interval, by the times, and the unit in some files.
    NoCount,
    /// Only the unit, and only in some files.
    Missing,
}

/// A format of record files.
#[derive(Debug)]
#[non_exhaustive]
pub struct Format {
    /// Name, as in results and in the column `format` of an index.
    pub name: &'static str,
    /// Its files, in the words of the documentation.
    pub files: &'static str,
    /// Who writes such files.
    pub source: &'static str,
    /// Contents of a file without a distinctive header, for messages; empty
    /// for other files.
    pub content: &'static str,
    /// Statements of a file about its samples.
    pub header: Header,
    /// Whether a number is refused if its width or form differs from the
    /// others.
    pub is_fixed: bool,
    /// Whether a number that names a channel is an azimuth in degrees.
    pub azimuths: bool,
    /// Whether a number at the end of a file's name is an azimuth.
    pub(crate) azimuth_in_name: bool,
    /// Whether the content is of this format.
    pub(crate) recognises: fn(&Text<'_>) -> bool,
    /// Reads all acceleration channels.
    pub(crate) read: fn(&Text<'_>) -> Result<Vec<Channel>>,
}

impl Format {
    /// All formats, in the order in which they are tried: those with a
    /// distinctive header first.
    pub const ALL: &[&Self] = &[
        &smc::FORMAT,
        &knet::FORMAT,
        &esm::FORMAT,
        &afad::FORMAT,
        &geonet::FORMAT,
        &resorce::FORMAT,
        &at2::FORMAT,
        &cosmos::FORMAT,
        &bri::FORMAT,
        &counted::FORMAT,
        &column::FORMAT,
        &csv::FORMAT,
    ];

    /// Common values of most formats.
    const BASE: Self = Self {
        name: "",
        files: "",
        source: "",
        content: "",
        header: Header::Full,
        is_fixed: true,
        azimuths: false,
        azimuth_in_name: false,
        recognises: |_| false,
        read: |_| Ok(Vec::new()),
    };

    /// The format of this name.
    ///
    /// ```
    /// use rocking_records::Format;
    /// let at2 = Format::named("at2").expect("a format");
    /// assert_eq!((at2.files, at2.source), ("AT2", "PEER"));
    /// ```
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().copied().find(|format| format.name == name)
    }

    /// All formats, those with the most complete header first, then by name.
    pub fn by_name() -> Vec<&'static Self> {
        let mut all = Self::ALL.to_vec();
        all.sort_by_key(|format| (format.header, format.name));
        all
    }

    /// The format of a file with this content.
    pub(crate) fn of(text: &Text<'_>) -> Option<&'static Self> {
        let mut all = Self::ALL.iter().copied();
        all.find(|format| (format.recognises)(text))
    }
}

impl PartialEq for Format {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

/// One component as the reader of a format finds it, in the unit of the file.
#[derive(Default)]
pub(crate) struct Channel {
    pub(crate) dt: Option<f64>,
    pub(crate) unit: Option<AccelerationUnit>,
    pub(crate) samples: Vec<f64>,
    /// Name of the channel in the file.
    pub(crate) label: Option<String>,
    /// Event and station, if the file names both.
    pub(crate) site: Option<String>,
    /// Direction of the sensor by the header; if `None`, the label gives it.
    pub(crate) direction: Option<Direction>,
    /// Whether the sensor is in a borehole.
    pub(crate) borehole: bool,
    /// Remarks on the text.
    pub(crate) remarks: Vec<Remark>,
}

impl Channel {
    /// A channel by its sampling interval (s), unit and samples.
    fn of(
        dt: impl Into<Option<f64>>,
        unit: impl Into<Option<AccelerationUnit>>,
        samples: Vec<f64>,
    ) -> Self {
        let (dt, unit) = (dt.into(), unit.into());
        Self { dt, unit, samples, ..Self::default() }
    }
}
