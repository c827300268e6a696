//! Reading all that a folder or an index lists.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{StudyRule, Suite, SuiteError, SuiteMember, SuiteOptions};
use super::{index, pairing};
use crate::record::{
    Direction, Fault, Record, RecordError, Remark, file_bytes, is_record,
    name_of, read_all, stem,
};

/// The index in a folder or archive as PEER's site delivers it.
const PEER_RESULTS: &str = "_SearchResults.csv";

/// What a folder or index holds, refused records included.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey {
    /// The folder, index, archive or record, in messages.
    path: String,
    /// Name of the suite.
    name: String,
    members: Vec<Result<SuiteMember, SuiteError>>,
    ignored: Vec<RecordError>,
    study_rule: StudyRule,
    paired: bool,
}

impl Survey {
    /// Reads every record of the folder or index at `path`, or the record
    /// file there.
    ///
    /// # Errors
    /// [`SuiteError`] where the folder or index itself cannot be read.
    pub fn read(
        path: &Path,
        options: &SuiteOptions,
    ) -> Result<Self, SuiteError> {
        let shown = path.display().to_string();
        if path.is_dir() {
            // A name that is no UTF-8 is shown otherwise than it is written.
            let files = folder_files(path)?;
            let names: Vec<String> =
                files.iter().map(|file| name_of(file)).collect();
            let by_name: BTreeMap<&str, &PathBuf> =
                names.iter().map(String::as_str).zip(&files).collect();
            return Self::of_files(
                &shown,
                &names,
                options,
                |name| match by_name.get(name) {
                    Some(file) => file_bytes(file),
                    None => file_bytes(&path.join(name)),
                },
            );
        }
        let bytes = file_bytes(path)?;
        let base = path.parent().unwrap_or(Path::new(""));
        if !index::is_index(&bytes) && is_record(&bytes) {
            let base = base.display().to_string();
            let names = [name_of(path)];
            let read = |_: &str| Ok(bytes.clone());
            let survey = Self::of_files(&base, &names, options, read)?;
            let name = stem(&shown).to_owned();
            return Ok(Self { path: shown, name, ..survey });
        }
        Self::of_index(&shown, &bytes, options, |file| {
            file_bytes(&base.join(file))
        })
    }

    /// Reads every record among the files of a folder or archive, given by
    /// its path, the files' names and a function that gives the bytes of
    /// each. If one of them is PEER's `_SearchResults.csv`, that is the
    /// index.
    ///
    /// # Errors
    /// [`SuiteError`] where an index cannot be read.
    pub fn of_files(
        path: &str,
        names: &[String],
        options: &SuiteOptions,
        mut file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
    ) -> Result<Self, SuiteError> {
        if let Some(results) = names.iter().find(|n| *n == PEER_RESULTS) {
            let bytes = file_bytes(results)?;
            let shown = format!("{path}/{results}");
            let survey = Self::of_index(&shown, &bytes, options, file_bytes)?;
            return Ok(Self { name: container(path).to_owned(), ..survey });
        }
        let mut members = Vec::new();
        let mut ignored = Vec::new();
        for name in names {
            let shown = Path::new(path).join(name).display().to_string();
            let records = file_bytes(name)
                .and_then(|bytes| read_all(&shown, &bytes, &options.read));
            match records {
                Ok(records) => {
                    for record in records {
                        match horizontal(&shown, name, record) {
                            Ok(member) => members.push(Ok(member)),
                            Err(error) => ignored.push(error),
                        }
                    }
                }
                Err(error) if is_no_record(&error) => ignored.push(error),
                Err(error) => members.push(Err(error.into())),
            }
        }
        Ok(Self {
            path: path.to_owned(),
            name: container(path).to_owned(),
            members,
            ignored,
            study_rule: StudyRule::FirstName,
            paired: false,
        })
    }

    pub(super) fn of_index(
        path: &str,
        bytes: &[u8],
        options: &SuiteOptions,
        mut file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
    ) -> Result<Self, SuiteError> {
        let index = index::Index::parse(path, bytes)?;
        let paired = index.is_paired();
        let study_rule = if index.has("study_component") {
            StudyRule::Index
        } else {
            StudyRule::FirstName
        };
        let member =
            |row: index::Row| row.member(&file_bytes(row.file())?, options);
        let members = index.into_rows().into_iter().map(member).collect();
        // An index as PEER names it has its folder's name.
        let folder = path.strip_suffix(PEER_RESULTS).map(container);
        let name = folder.filter(|folder| !folder.is_empty());
        Ok(Self {
            path: path.to_owned(),
            name: name.unwrap_or(stem(path)).to_owned(),
            members,
            ignored: Vec::new(),
            study_rule,
            paired,
        })
    }

    /// Every record that was looked for, in the index's order or by file
    /// name; pairs found by name are known to the suite only.
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
        let Self { path, name, members, ignored, study_rule, paired } = self;
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
        Ok(Suite { name, members, study_rule, ignored })
    }
}

/// Name of a folder, whole, or of a zip without its ending.
fn container(path: &str) -> &str {
    let path = path.trim_end_matches('/');
    let name = path.rsplit('/').next().unwrap_or(path);
    name.strip_suffix(".zip").unwrap_or(name)
}

/// A record of a folder as a member of the suite, unless it is vertical or
/// from a borehole.
fn horizontal(
    shown: &str,
    file: &str,
    record: Record,
) -> Result<SuiteMember, RecordError> {
    let name = || record.accelerogram.name().to_owned();
    if record.direction == Direction::Vertical {
        return Err(Fault::Vertical(name()).whole(shown));
    }
    if record.borehole {
        return Err(Fault::Borehole(name()).whole(shown));
    }
    let mut remarks = record.remarks;
    if record.direction == Direction::Unknown {
        remarks.push(Remark::Direction);
    }
    Ok(SuiteMember {
        accelerogram: record.accelerogram,
        file: file.to_owned(),
        format: record.format,
        unit: record.unit,
        site: record.site,
        remarks,
        pair: None,
        study_component: false,
        attributes: BTreeMap::new(),
    })
}

/// Whether a file is no acceleration record at all, against one with a
/// fault.
fn is_no_record(error: &RecordError) -> bool {
    matches!(
        error.fault(),
        Fault::UnknownFormat { .. }
            | Fault::NotText { .. }
            | Fault::Utf16(_)
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
