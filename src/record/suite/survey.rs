//! Reading all that a folder or an index lists.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{StudyRule, Suite, SuiteError, SuiteMember, SuiteOptions};
use super::{index, pairing};
use crate::record::{Fault, RecordError, bytes_of, name_of, read, stem};

/// What a folder or index holds, refused records included.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    path: String,
    members: Vec<Result<SuiteMember, SuiteError>>,
    ignored: Vec<RecordError>,
    study_rule: StudyRule,
    paired: bool,
}

impl Survey {
    /// Reads every record of the folder or index at `path`.
    ///
    /// # Errors
    /// [`SuiteError`] where the folder or index itself cannot be read.
    pub fn read(
        path: &Path,
        options: &SuiteOptions,
    ) -> Result<Self, SuiteError> {
        if path.is_dir() {
            return Self::of_folder(path, options);
        }
        let bytes = bytes_of(path)?;
        let shown = path.display().to_string();
        let base = path.parent().unwrap_or(Path::new(""));
        Self::of_index(&shown, &bytes, options, |file| {
            bytes_of(&base.join(file))
        })
    }

    pub(super) fn of_index(
        path: &str,
        bytes: &[u8],
        options: &SuiteOptions,
        mut file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
    ) -> Result<Self, SuiteError> {
        let index = index::Index::parse(path, bytes)?;
        let member =
            |row: &index::Row| row.member(&file_bytes(row.file())?, options);
        let members = index.rows().iter().map(member).collect();
        let study_rule = if index.has("study_component") {
            StudyRule::Index
        } else {
            StudyRule::FirstName
        };
        Ok(Self {
            path: path.to_owned(),
            members,
            ignored: Vec::new(),
            study_rule,
            paired: index.has("pair"),
        })
    }

    fn of_folder(
        path: &Path,
        options: &SuiteOptions,
    ) -> Result<Self, SuiteError> {
        let mut members = Vec::new();
        let mut ignored = Vec::new();
        for file in folder_files(path)? {
            let bytes = bytes_of(&file)?;
            let shown = file.display().to_string();
            match read(&shown, &bytes, &options.read) {
                Ok(record) => members.push(Ok(SuiteMember {
                    accelerogram: record.accelerogram,
                    file: name_of(&file),
                    format: record.format,
                    unit: record.unit,
                    pair: None,
                    study_component: false,
                    attributes: BTreeMap::new(),
                })),
                Err(error) if is_no_record(&error) => ignored.push(error),
                Err(error) => members.push(Err(error.into())),
            }
        }
        Ok(Self {
            path: path.display().to_string(),
            members,
            ignored,
            study_rule: StudyRule::FirstName,
            paired: false,
        })
    }

    /// Every record that was looked for, in the index's order or by file
    /// name; pairs found by name are known to the suite only.
    #[must_use]
    pub fn members(&self) -> &[Result<SuiteMember, SuiteError>] {
        &self.members
    }

    /// Files of a folder that hold no record, and why.
    #[must_use]
    pub fn ignored(&self) -> &[RecordError] {
        &self.ignored
    }

    /// The suite, if no record was refused.
    ///
    /// # Errors
    /// The first refused record; [`SuiteError::Empty`] without any; a name
    /// that two records share; a pair that is none.
    pub fn into_suite(self) -> Result<Suite, SuiteError> {
        let Self { path, members, ignored, study_rule, paired } = self;
        let mut members =
            members.into_iter().collect::<Result<Vec<_>, _>>()?;
        if members.is_empty() {
            return Err(SuiteError::Empty { path, files: ignored.len() });
        }
        pairing::check_names(&path, &members)?;
        if !paired {
            pairing::pair_by_name(&mut members);
        }
        if study_rule == StudyRule::FirstName {
            pairing::mark_first(&mut members);
        }
        pairing::check_pairs(&path, &members)?;
        let name = stem(path.trim_end_matches('/')).to_owned();
        Ok(Suite { name, members, study_rule, ignored })
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
        if file.is_file() && !name_of(&file).starts_with('.') {
            files.push(file);
        }
    }
    files.sort();
    Ok(files)
}
