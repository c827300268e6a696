//! Formats of record files: a module each, whose row in [`Format::ALL`] says
//! all that readers, documentation and tests know of it.

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
use crate::error::RecordError;
use crate::quality::Remark;
use crate::text::Text;

/// What a format states about its samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Header {
    /// Number of samples, sampling interval and unit, as a rule.
    Full,
    /// Number of samples and sampling interval.
    NoUnit,
    /// Sampling interval, by the times, and in some files the unit.
    NoCount,
    /// Nothing but in some files the unit.
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
    /// What a file without a distinctive header consists of, for messages;
    /// empty for other files.
    pub content: &'static str,
    /// What a file states about its samples.
    pub header: Header,
    /// Whether a number of another width or form than the others is refused.
    pub is_fixed: bool,
    /// Whether a number that names a channel is an azimuth in degrees.
    pub azimuths: bool,
    /// Whether a number at the end of a file's name is one, too.
    pub(crate) azimuth_in_name: bool,
    /// Whether the content is of this format.
    pub(crate) recognises: fn(&Text<'_>) -> bool,
    /// Reads all acceleration channels.
    pub(crate) read: fn(&Text<'_>) -> Result<Vec<Channel>, RecordError>,
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

    /// What most formats have in common.
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
    #[must_use]
    pub fn named(name: &str) -> Option<&'static Self> {
        Self::ALL.iter().copied().find(|format| format.name == name)
    }

    /// All formats by name, those that state all of their samples first.
    #[must_use]
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

/// One component as a format's reader finds it, in the file's own unit.
#[derive(Default)]
pub(crate) struct Channel {
    pub(crate) dt: Option<f64>,
    pub(crate) unit: Option<AccelerationUnit>,
    pub(crate) samples: Vec<f64>,
    /// What the file calls the channel.
    pub(crate) label: Option<String>,
    /// Event and station, where the file names both.
    pub(crate) site: Option<String>,
    /// Where the sensor points, by the header alone; the label says it where
    /// this is `None`.
    pub(crate) direction: Option<Direction>,
    /// Whether the sensor is in a borehole.
    pub(crate) borehole: bool,
    /// What is suspicious about the text.
    pub(crate) remarks: Vec<Remark>,
}
