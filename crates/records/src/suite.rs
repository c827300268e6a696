//! Suites of records: a folder of self-describing files, or an index.

use std::collections::BTreeMap;
use std::path::Path;
use std::sync::Arc;

mod aside;
mod cells;
mod error;
mod index;
mod pairing;
mod survey;

pub use aside::{Aside, AsideCount, AsideReason, SetAside};
pub use error::SuiteError;
pub use index::is_index;
pub use survey::{Reading, Survey};

use crate::error::RecordError;
use crate::format::Format;
use crate::processing::{Processing, ProcessingError};
use crate::quality::{MemberMotion, Profile, Remark, RemarkInput};
use crate::record::{Fallback, ReadOptions, Record};
use rocking::accelerogram::Accelerogram;
use rocking::names::named;
use rocking::units::AccelerationUnit;

/// Relative difference allowed between an index's PGA or PGV and the
/// record's.
pub const PEAK_TOLERANCE: f64 = 1e-4;

named! {
    /// The rule that chose the component of each pair for a study.
    pub enum StudyRule: "rule" {
        /// The index's column `study_component`.
        Index = "the index's study_component",
        /// The component whose file name sorts first in its pair.
        FirstName = "the component whose file name sorts first in its pair",
    }
}

/// One record of a suite.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SuiteMember<M = Accelerogram> {
    /// The component, or its profile.
    pub accelerogram: M,
    /// File, relative to the folder or index.
    pub file: String,
    /// Format of the file.
    pub format: &'static Format,
    /// Unit in which the file is written.
    pub unit: AccelerationUnit,
    /// Event and station, if the file names both.
    pub site: Option<String>,
    /// Remarks on the file from its reading.
    pub remarks: Vec<Remark>,
    /// Name shared by the two components of a pair.
    pub pair: Option<String>,
    /// Whether the study uses this component of the pair.
    pub study_component: bool,
    /// Earthquake of the record, by the index; records of one earthquake are
    /// not independent.
    pub event: Option<String>,
    /// Values of the caller that neither file nor index states.
    pub given: Fallback,
    /// Line of the index that lists the record, counted from 1.
    pub line: Option<usize>,
    /// Other columns of the index (magnitude, distance, ...): name and cell,
    /// in the index's order.
    pub attributes: Vec<(Arc<str>, String)>,
}

impl<M> SuiteMember<M> {
    /// The cells of the index's other columns, by name.
    pub fn attributes_by_name(&self) -> BTreeMap<String, String> {
        let cells = self.attributes.iter();
        cells.map(|(name, cell)| (name.to_string(), cell.clone())).collect()
    }
}

impl SuiteMember {
    /// A record of `file`, without a pair.
    pub fn of(record: Record, file: String) -> Self {
        Self {
            accelerogram: record.accelerogram,
            file,
            format: record.format,
            unit: record.unit,
            site: record.site,
            remarks: record.remarks,
            pair: None,
            study_component: false,
            event: None,
            given: record.given,
            line: None,
            attributes: Vec::new(),
        }
    }

    /// The member without its samples, and these.
    pub fn into_profile(self) -> (SuiteMember<Profile>, Accelerogram) {
        let member = SuiteMember {
            accelerogram: Profile::of(&self.accelerogram),
            file: self.file,
            format: self.format,
            unit: self.unit,
            site: self.site,
            remarks: self.remarks,
            pair: self.pair,
            study_component: self.study_component,
            event: self.event,
            given: self.given,
            line: self.line,
            attributes: self.attributes,
        };
        (member, self.accelerogram)
    }
}

/// Records read together, in the index's order or by file name.
#[derive(Clone, Debug, PartialEq)]
pub struct Suite<M = Accelerogram> {
    name: String,
    members: Vec<SuiteMember<M>>,
    study_rule: StudyRule,
    set_aside: SetAside,
}

impl Suite {
    /// Reads the suite at `path`: a folder of self-describing files, or an
    /// index.
    ///
    /// An index is a CSV file with a column `file` (relative to the index),
    /// separated by commas or semicolons. Optional columns: `name` (of the
    /// record; by default the stem of the file), `format`, `units`, `dt_s`,
    /// `npts`, `pga_g`, `pgv_m_s`, `sha256` (checked), `pair`,
    /// `study_component` (1 or 0), `event` (the earthquake, of every record or
    /// of none). Other columns are kept as attributes. PEER's
    /// `_SearchResults.csv` is an index, too, with its `Earthquake Name` as
    /// event; it is also the index of its folder.
    ///
    /// In another folder, files in unknown formats, histories of velocity or
    /// displacement, vertical components, records from a borehole (KiK-net),
    /// folders and dead links are set aside ([`Suite::set_aside`]), and hidden
    /// files are ignored. Any other fault refuses the suite. If
    /// [`ReadOptions::recursive`] is set, folders are read, too, and their
    /// names precede the names of their records. A name of a file or a record,
    /// or a cell of an index, is refused if results cannot contain it
    /// ([`result_name`](rocking::accelerogram::result_name)). An index may
    /// list vertical and borehole records, which get a remark. Records are
    /// paired by event and station if the files name both, or else by the file
    /// name without the orientation at its end.
    ///
    /// # Errors
    /// [`SuiteError`] with the folder, index or record, and the line.
    pub fn read(
        path: &Path,
        options: &ReadOptions,
    ) -> Result<Self, SuiteError> {
        Survey::read(path, options)?.into_suite()
    }

    /// Reads a suite from the bytes of an index and a function that gives
    /// the bytes of each file it lists.
    ///
    /// # Errors
    /// As [`Suite::read`].
    ///
    /// ```
    /// use rocking_records::{ReadOptions, Suite};
    /// let index = b"file,units,dt_s,pair,event\n\
    ///     a-000.txt,g,0.01,a,\"Nowhere, 1900\"\n\
    ///     a-090.txt,g,0.01,a,\"Nowhere, 1900\"\n";
    /// let options = ReadOptions::default();
    /// let suite = Suite::from_index("index.csv", index, &options, |_| {
    ///     Ok(b"0\n0.2\n-0.1\n".to_vec())
    /// })?;
    /// assert_eq!(suite.members().len(), 2);
    /// let study: Vec<_> = suite.study_components().collect();
    /// assert_eq!(study[0].file, "a-000.txt");
    /// assert_eq!(study[0].event.as_deref(), Some("Nowhere, 1900"));
    /// # Ok::<(), rocking_records::SuiteError>(())
    /// ```
    pub fn from_index(
        path: &str,
        bytes: &[u8],
        options: &ReadOptions,
        file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
    ) -> Result<Self, SuiteError> {
        Survey::of_index(path, bytes, &Reading::all(options), file_bytes, Ok)
            .and_then(Survey::into_suite)
    }

    /// The suite with every record processed.
    ///
    /// # Errors
    /// [`ProcessingError`] for the first record that cannot be processed.
    pub fn processed(
        mut self,
        processing: &Processing,
    ) -> Result<Self, ProcessingError> {
        for member in &mut self.members {
            member.accelerogram = processing.apply(&member.accelerogram)?;
        }
        Ok(self)
    }
}

impl<M: MemberMotion> Suite<M> {
    /// Name of the folder or index, without its ending.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All records.
    pub fn members(&self) -> &[SuiteMember<M>] {
        &self.members
    }

    /// The rule that chose the study components.
    pub fn study_rule(&self) -> StudyRule {
        self.study_rule
    }

    /// Other contents of the folder or archive; empty for an index that is
    /// read by its own path.
    pub fn set_aside(&self) -> &SetAside {
        &self.set_aside
    }

    /// The component of each pair that the study uses; a record without a
    /// partner is one.
    pub fn study_components(&self) -> impl Iterator<Item = &SuiteMember<M>> {
        self.members.iter().filter(|m| m.study_component)
    }

    /// The components that the study does not use.
    pub fn other_components(&self) -> impl Iterator<Item = &SuiteMember<M>> {
        self.members.iter().filter(|m| !m.study_component)
    }

    /// The pairs with both components, the study's component first.
    pub fn both(&self) -> Vec<(&SuiteMember<M>, &SuiteMember<M>)> {
        let others: BTreeMap<&str, &SuiteMember<M>> = self
            .other_components()
            .filter_map(|other| Some((other.pair.as_deref()?, other)))
            .collect();
        self.study_components()
            .filter_map(|study| {
                let other = others.get(study.pair.as_deref()?)?;
                Some((study, *other))
            })
            .collect()
    }
}

impl<'a, M: MemberMotion> From<&'a SuiteMember<M>> for RemarkInput<'a> {
    fn from(member: &'a SuiteMember<M>) -> Self {
        Self {
            profile: member.accelerogram.profile(),
            pair: member.pair.as_deref(),
            read: &member.remarks,
            given: member.given,
        }
    }
}

#[cfg(test)]
mod tests;
