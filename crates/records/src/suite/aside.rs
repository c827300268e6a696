//! Contents of a folder or an archive beside the records of its suite.

use std::fmt;

use crate::codes::coded;
use crate::error::{Fault, RecordError};
use rocking::accelerogram::EscapedName;

coded! {
    /// Why something in a folder or an archive is not a record of the suite,
    /// yet no fault of the suite.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
    #[cfg_attr(feature = "serde", derive(serde::Serialize))]
    #[cfg_attr(feature = "serde", serde(rename_all = "lowercase"))]
    #[non_exhaustive]
    pub enum AsideReason {
        /// A vertical component.
        Vertical = "vertical",
        /// A record of a sensor in a borehole.
        Borehole = "borehole",
        /// A text in no known format, or no text.
        Format = "format",
        /// A history of velocity or displacement, or a spectrum.
        Quantity = "quantity",
        /// A file that is not in the index of the folder.
        Unlisted = "unlisted",
        /// A file of an archive whose name occurs again.
        Doubled = "doubled",
        /// A file of an archive whose name leads out of it.
        Outside = "outside",
        /// A folder, which is not entered.
        Folder = "folder",
        /// A link to nothing.
        Link = "link",
        /// A device, a named pipe or a socket.
        Device = "device",
    }
}

impl AsideReason {
    fn of(fault: &Fault) -> Option<Self> {
        Some(match fault {
            Fault::Vertical(_) => Self::Vertical,
            Fault::Borehole(_) => Self::Borehole,
            Fault::UnknownFormat { .. }
            | Fault::NotText { .. }
            | Fault::Utf16(_) => Self::Format,
            Fault::Quantity(_) => Self::Quantity,
            Fault::Unlisted => Self::Unlisted,
            Fault::Doubled => Self::Doubled,
            Fault::Outside => Self::Outside,
            Fault::Folder => Self::Folder,
            Fault::DeadLink => Self::Link,
            Fault::Device => Self::Device,
            _ => return None,
        })
    }

    /// The words after the number `count`.
    fn words(self, count: usize) -> &'static str {
        let one = count == 1;
        match self {
            Self::Vertical => "vertical",
            Self::Borehole => "from a borehole",
            Self::Format => "in no known format",
            Self::Quantity => "of another quantity than acceleration",
            Self::Unlisted => "not in the index",
            Self::Doubled => "under a repeated name",
            Self::Outside => "with a path outside the archive",
            Self::Folder if one => "folder that is not entered",
            Self::Folder => "folders that are not entered",
            Self::Link if one => "link to nothing",
            Self::Link => "links to nothing",
            Self::Device if one => "device or pipe",
            Self::Device => "devices or pipes",
        }
    }
}

/// One thing that was set aside.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct Aside {
    /// File, relative to the folder or archive.
    pub file: String,
    /// Why it is not a record of the suite.
    pub reason: AsideReason,
    /// The error of the file.
    pub error: RecordError,
}

impl Aside {
    /// A refused `file` of a folder or an archive.
    ///
    /// # Errors
    /// `error` itself if it is a fault of the suite.
    pub(super) fn of(
        file: &str,
        error: RecordError,
    ) -> Result<Self, RecordError> {
        match AsideReason::of(&error.fault) {
            Some(reason) => Ok(Self { file: file.to_owned(), reason, error }),
            None => Err(error),
        }
    }
}

/// Number of files that were set aside for one reason.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct AsideCount<'a> {
    /// The reason.
    #[cfg_attr(feature = "serde", serde(rename = "code"))]
    pub reason: AsideReason,
    /// Number of files; of files with several channels, number of channels.
    pub files: usize,
    /// The first of them.
    pub first: &'a str,
}

/// Everything that was set aside when a suite was read. Displays as the number
/// of files for each reason, with the first file.
///
/// ```
/// use rocking_records::{Suite, ReadOptions};
/// let folder = std::env::temp_dir().join("rocking-doc-set-aside");
/// std::fs::create_dir_all(folder.join("more"))?;
/// let motion = "ACCELERATION TIME SERIES IN UNITS OF G\n\
///     NPTS=      2, DT=   .0100 SEC\n\
///     \x20  .1000000E-02   .2000000E-02\n";
/// let head = "PEER NGA STRONG MOTION DATABASE RECORD\nNowhere\n";
/// std::fs::write(folder.join("a.AT2"), format!("{head}{motion}"))?;
/// std::fs::write(folder.join("notes.txt"), "read me\n")?;
/// let suite = Suite::read(&folder, &ReadOptions::default())?;
/// # std::fs::remove_dir_all(&folder)?;
/// assert_eq!(
///     suite.set_aside().to_string(),
///     "1 in no known format (first: notes.txt), \
///      1 folder that is not entered (first: more)"
/// );
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SetAside(Vec<Aside>);

impl SetAside {
    /// Whether nothing was set aside.
    pub fn is_empty(&self) -> bool {
        self.0.is_empty()
    }

    /// Everything, in the order of reading.
    pub fn all(&self) -> &[Aside] {
        &self.0
    }

    /// The number for each reason, and its first file.
    pub fn counts(&self) -> Vec<AsideCount<'_>> {
        let mut counts: Vec<AsideCount<'_>> = Vec::new();
        for Aside { file, reason, .. } in &self.0 {
            match counts.iter_mut().find(|count| count.reason == *reason) {
                Some(count) => count.files += 1,
                None => counts.push(AsideCount {
                    reason: *reason,
                    files: 1,
                    first: file,
                }),
            }
        }
        counts.sort_by_key(|count| count.reason);
        counts
    }
}

impl Extend<Aside> for SetAside {
    fn extend<T: IntoIterator<Item = Aside>>(&mut self, more: T) {
        self.0.extend(more);
    }
}

/// The number of files, and for each reason its number and first file.
#[cfg(feature = "serde")]
impl serde::Serialize for SetAside {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct as _;
        let mut fields = to.serialize_struct("SetAside", 2)?;
        fields.serialize_field("files", &self.0.len())?;
        fields.serialize_field("codes", &self.counts())?;
        fields.end()
    }
}

impl fmt::Display for SetAside {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let counts = self.counts().into_iter();
        let counts = counts.map(|AsideCount { reason, files, first }| {
            let (words, first) = (reason.words(files), EscapedName(first));
            format!("{files} {words} (first: {first})")
        });
        f.write_str(&counts.collect::<Vec<_>>().join(", "))
    }
}

#[cfg(test)]
mod tests;
