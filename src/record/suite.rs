//! Suites of records: a folder of self-describing files, or an index.

use std::collections::BTreeMap;
use std::fmt;
use std::path::{Path, PathBuf};

use thiserror::Error;

mod index;
mod pairing;

use super::{Accelerogram, Fault, Format, ReadOptions, RecordError};
use super::{bytes_of, decode_name, read};

/// Relative difference allowed between an index's PGA or PGV and the
/// record's.
pub const PEAK_TOLERANCE: f64 = 1e-4;

/// A suite that was refused.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum SuiteError {
    /// The folder or index could not be read.
    #[error("{path}: cannot be read: {reason}")]
    Unreadable {
        /// Folder or index.
        path: String,
        /// What the system said.
        reason: String,
    },
    /// A record was refused.
    #[error(transparent)]
    Record(#[from] RecordError),
    /// There is no record in it.
    #[error(
        "{path}: no readable record in it: expected at least one (files: {files})"
    )]
    Empty {
        /// Folder or index.
        path: String,
        /// Number of files or rows looked at.
        files: usize,
    },
    /// An index without a column `file`, or a row that does not fit.
    #[error("{path}:{line}: {found:?}: expected {expected}")]
    Index {
        /// The index.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// A record that is not what its row in the index says.
    #[error(
        "{path}:{line}: {file} has {quantity} {found}: expected {expected}, which the index states"
    )]
    Mismatch {
        /// The index.
        path: String,
        /// Line, counted from 1.
        line: usize,
        /// The record.
        file: String,
        /// Column of the index.
        quantity: &'static str,
        /// Value of the record.
        found: String,
        /// Value of the index.
        expected: String,
    },
    /// An index with checksums, and nothing to compute them with.
    #[error(
        "{path}: the index has sha256 sums: expected a function that computes them"
    )]
    Unverifiable {
        /// The index.
        path: String,
    },
    /// Two records that results could not tell apart.
    #[error(
        "{path}: two records are named {name:?}: expected different names"
    )]
    SameName {
        /// Folder or index.
        path: String,
        /// The name.
        name: String,
    },
    /// A pair without exactly one study component, or of more than two.
    #[error(
        "{path}: pair {pair:?} has {components} components, {study} for the study: expected at most 2, and 1 for the study"
    )]
    Pair {
        /// Folder or index.
        path: String,
        /// The pair.
        pair: String,
        /// Number of components.
        components: usize,
        /// How many of them are marked for the study.
        study: usize,
    },
}

/// Who chose the component of each pair that a study uses.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum StudyRule {
    /// The index's column `study_component`.
    Index,
    /// The component whose file name sorts first in its pair.
    FirstName,
}

impl fmt::Display for StudyRule {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Index => "the index's study_component",
            Self::FirstName => {
                "the component whose file name sorts first in its pair"
            }
        })
    }
}

/// One record of a suite.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SuiteMember {
    /// The component.
    pub accelerogram: Accelerogram,
    /// File, relative to the folder or index.
    pub file: String,
    /// Format of the file.
    pub format: Format,
    /// Name shared by the two components of a pair.
    pub pair: Option<String>,
    /// Whether the study uses this component of the pair.
    pub study_component: bool,
    /// Other columns of the index, by name (event, magnitude, ...).
    pub attributes: BTreeMap<String, String>,
}

/// Records read together, in the index's order or by file name.
#[derive(Clone, Debug, PartialEq)]
pub struct Suite {
    name: String,
    members: Vec<SuiteMember>,
    study_rule: StudyRule,
    ignored: Vec<RecordError>,
}

/// How a suite is read.
#[derive(Clone, Copy, Debug)]
pub struct SuiteOptions {
    /// What the caller knows about the records; an index's `dt_s` and
    /// `units` come before it.
    pub read: ReadOptions,
    /// SHA-256 in hexadecimal of a file's bytes, for an index that states
    /// sums.
    pub sha256_hex: Option<fn(&[u8]) -> String>,
}

impl Suite {
    /// Reads the suite at `path`: a folder of self-describing files, or an
    /// index.
    ///
    /// An index is a CSV file with a column `file` (relative to the index).
    /// Optional columns: `format`, `units`, `dt_s`, `npts`, `pga_g`,
    /// `pgv_m_s`, `sha256` (checked), `pair`, `study_component` (1 or 0);
    /// others are kept as attributes. In a folder, files of no known format
    /// and histories of velocity or displacement are set aside
    /// ([`Suite::ignored`]); any other fault refuses the suite. Pairs are
    /// found by file name: what is left without the orientation at its end.
    ///
    /// # Errors
    /// [`SuiteError`] naming the folder, index or record, and the line.
    pub fn read(
        path: &Path,
        options: &SuiteOptions,
    ) -> Result<Self, SuiteError> {
        if path.is_dir() {
            return Self::from_folder(path, options);
        }
        let bytes = bytes_of(path)?;
        let shown = path.display().to_string();
        let base = path.parent().unwrap_or(Path::new(""));
        Self::from_index(&shown, &bytes, options, |file| {
            bytes_of(&base.join(file))
        })
    }

    /// Reads a suite from the bytes of an index and a function that gives
    /// the bytes of each file it lists.
    ///
    /// # Errors
    /// As [`Suite::read`].
    ///
    /// ```
    /// use rocking::record::{ReadOptions, Suite, SuiteOptions};
    /// let index = b"file,units,dt_s,pair,event\n\
    ///     a-000.txt,g,0.01,a,\"Nowhere, 1900\"\n\
    ///     a-090.txt,g,0.01,a,\"Nowhere, 1900\"\n";
    /// let options =
    ///     SuiteOptions { read: ReadOptions::default(), sha256_hex: None };
    /// let suite = Suite::from_index("index.csv", index, &options, |_| {
    ///     Ok(b"0\n0.2\n-0.1\n".to_vec())
    /// })?;
    /// assert_eq!(suite.members().len(), 2);
    /// let study: Vec<_> = suite.study_components().collect();
    /// assert_eq!(study[0].file, "a-000.txt");
    /// assert_eq!(study[0].attributes["event"], "Nowhere, 1900");
    /// # Ok::<(), rocking::record::SuiteError>(())
    /// ```
    pub fn from_index(
        path: &str,
        bytes: &[u8],
        options: &SuiteOptions,
        mut file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
    ) -> Result<Self, SuiteError> {
        let index = index::Index::parse(path, bytes)?;
        let mut members = Vec::with_capacity(index.rows().len());
        for row in index.rows() {
            let content = file_bytes(row.file())?;
            members.push(row.member(&content, options)?);
        }
        let study_rule = if index.has("study_component") {
            StudyRule::Index
        } else {
            StudyRule::FirstName
        };
        let paired = index.has("pair");
        Self::assemble(path, members, study_rule, paired, Vec::new())
    }

    fn from_folder(
        path: &Path,
        options: &SuiteOptions,
    ) -> Result<Self, SuiteError> {
        let shown = path.display().to_string();
        let mut members = Vec::new();
        let mut ignored = Vec::new();
        for file in folder_files(path)? {
            let name = decode_name(&file);
            let bytes = bytes_of(&file)?;
            let shown = file.display().to_string();
            match read(&shown, &bytes, &options.read) {
                Ok(record) => members.push(SuiteMember {
                    accelerogram: record.accelerogram,
                    file: name,
                    format: record.format,
                    pair: None,
                    study_component: false,
                    attributes: BTreeMap::new(),
                }),
                Err(error) if is_no_record(&error) => ignored.push(error),
                Err(error) => return Err(error.into()),
            }
        }
        let rule = StudyRule::FirstName;
        Self::assemble(&shown, members, rule, false, ignored)
    }

    /// Finds pairs and study components where none were given, and checks
    /// what was given.
    fn assemble(
        path: &str,
        mut members: Vec<SuiteMember>,
        study_rule: StudyRule,
        paired: bool,
        ignored: Vec<RecordError>,
    ) -> Result<Self, SuiteError> {
        let path_owned = || path.to_owned();
        if members.is_empty() {
            let files = ignored.len();
            return Err(SuiteError::Empty { path: path_owned(), files });
        }
        pairing::check_names(path, &members)?;
        if !paired {
            pairing::pair_by_name(&mut members);
        }
        if study_rule == StudyRule::FirstName {
            pairing::mark_first(&mut members);
        }
        pairing::check_pairs(path, &members)?;
        let name = super::stem(path.trim_end_matches('/')).to_owned();
        Ok(Self { name, members, study_rule, ignored })
    }

    /// Name of the folder or index, without its ending.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// All records.
    #[must_use]
    pub fn members(&self) -> &[SuiteMember] {
        &self.members
    }

    /// Who chose the study components.
    #[must_use]
    pub fn study_rule(&self) -> StudyRule {
        self.study_rule
    }

    /// Files of a folder that were set aside, and why.
    #[must_use]
    pub fn ignored(&self) -> &[RecordError] {
        &self.ignored
    }

    /// The component of each pair that the study uses; a record without a
    /// partner is one.
    pub fn study_components(&self) -> impl Iterator<Item = &SuiteMember> {
        self.members.iter().filter(|m| m.study_component)
    }

    /// The components that the study does not use.
    pub fn other_components(&self) -> impl Iterator<Item = &SuiteMember> {
        self.members.iter().filter(|m| !m.study_component)
    }

    /// The pairs that have both components, the study's first.
    #[must_use]
    pub fn both(&self) -> Vec<(&SuiteMember, &SuiteMember)> {
        self.study_components()
            .filter_map(|study| {
                let pair = study.pair.as_ref()?;
                self.other_components()
                    .find(|other| other.pair.as_ref() == Some(pair))
                    .map(|other| (study, other))
            })
            .collect()
    }
}

/// Whether a file is no acceleration record at all, against one with a
/// fault.
fn is_no_record(error: &RecordError) -> bool {
    matches!(
        error.fault(),
        Fault::UnknownFormat { .. }
            | Fault::NotText { .. }
            | Fault::Quantity(_)
    )
}

/// Files of a folder by name, hidden ones and folders left out.
///
/// # Errors
/// [`SuiteError::Unreadable`] for a folder that cannot be listed.
pub fn folder_files(path: &Path) -> Result<Vec<PathBuf>, SuiteError> {
    let fail = |error: std::io::Error| SuiteError::Unreadable {
        path: path.display().to_string(),
        reason: error.to_string(),
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(path).map_err(fail)? {
        let file = entry.map_err(fail)?.path();
        if file.is_file() && !decode_name(&file).starts_with('.') {
            files.push(file);
        }
    }
    files.sort();
    Ok(files)
}

/// Whether the content is an index: its first line has a column `file`.
#[must_use]
pub fn is_index(bytes: &[u8]) -> bool {
    index::is_index(bytes)
}
