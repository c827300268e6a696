//! Reading every record that a folder or an index lists.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use super::index::{self, Index, IndexRow};
use super::pairing;
use super::reading::{OneThread, Reading, Spread};
use super::{Aside, SetAside, StudyRule, Suite, SuiteError, SuiteMember};
use crate::direction::Direction;
use crate::error::{Fault, RecordError};
use crate::quality::{MemberMotion, Remark};
use crate::read::{file_bytes, is_record, name_of, settle, stem};
use crate::record::{Agreement, Fallback, ReadOptions, Record};
use rocking::accelerogram::result_name;

/// The index in a folder or archive as PEER's site delivers it.
const PEER_RESULTS: &str = "_SearchResults.csv";

/// The contents of a folder or an index, refused records included.
///
/// For each record that was read it contains what the caller kept: the whole
/// [`SuiteMember`], its profile, or nothing.
#[derive(Clone, Debug, PartialEq)]
pub struct Survey<K = SuiteMember> {
    /// The folder, index, archive or record, in messages.
    path: String,
    /// Name of the suite.
    name: String,
    /// Every record that was sought, in the index's order or by file name.
    /// Only a [`Suite`] has the pairs that are found by name.
    pub members: Vec<Result<K, SuiteError>>,
    /// Other contents of the folder or archive.
    pub set_aside: SetAside,
    study_rule: StudyRule,
    paired: bool,
}

impl Survey {
    /// Reads every record of the folder or index at `path`, or the record
    /// file there.
    ///
    /// # Errors
    /// [`SuiteError`] if the folder or index itself cannot be read.
    pub fn read(
        path: &Path,
        options: &ReadOptions,
    ) -> Result<Self, SuiteError> {
        Self::visit(path, &Reading::all(options, OneThread), Ok)
    }
}

impl<K> Survey<K> {
    /// Reads every record of the folder or index at `path`, or the record file
    /// there, and keeps the result of `keep` for each, in their order.
    ///
    /// ```
    /// use std::path::Path;
    /// use rocking_records::{OneThread, ReadOptions, Reading, SuiteError, Survey};
    /// let folder = Path::new("no such folder");
    /// let options = ReadOptions::default();
    /// let mut samples = 0;
    /// let found = Survey::visit(folder, &Reading::all(&options, OneThread), |member| {
    ///     samples += member.accelerogram.samples_g().len();
    ///     Ok::<(), SuiteError>(())
    /// });
    /// assert!(found.is_err());
    /// ```
    ///
    /// # Errors
    /// [`SuiteError`] if the folder or index itself cannot be read, and
    /// the first error of `keep`.
    pub fn visit<S: Spread, T: Send, E: From<SuiteError>>(
        path: &Path,
        reading: &Reading<'_, S, impl Fn(SuiteMember) -> T + Sync>,
        keep: impl FnMut(T) -> Result<K, E>,
    ) -> Result<Self, E> {
        let shown = path.display().to_string();
        if path.is_dir() {
            let (mut files, mut others) = Default::default();
            let recursive = reading.options.recursive;
            contents(path, "", recursive, &mut files, &mut others)?;
            others.sort_by(|a, b| a.file.cmp(&b.file));
            let names: Vec<String> = files.keys().cloned().collect();
            let bytes = |name: &str| match files.get(name) {
                Some(file) => file_bytes(file),
                None => file_bytes(&path.join(name)),
            };
            let mut survey =
                Self::of_files(&shown, &names, reading, bytes, keep)?;
            survey.set_aside.extend(others);
            return Ok(survey);
        }
        let mut bytes = file_bytes(path).map_err(SuiteError::from)?;
        let base = path.parent().unwrap_or(Path::new(""));
        if !index::is_index(&bytes) && is_record(&bytes) {
            let base = base.display().to_string();
            let names = [name_of(path)];
            let read = |_: &str| Ok(std::mem::take(&mut bytes));
            let survey = Self::of_files(&base, &names, reading, read, keep)?;
            let name = stem(&shown).to_owned();
            return Ok(Self { path: shown, name, ..survey });
        }
        let read = |file: &str| file_bytes(&base.join(file));
        Self::of_index(&shown, &bytes, reading, read, keep)
    }

    /// Reads every record among the files of a folder or archive, and keeps
    /// the result of `keep` for each. The arguments are the path, the names of
    /// the files, and a function that gives the bytes of a file. If one of the
    /// files is PEER's `_SearchResults.csv`, it is the index. A file whose
    /// name occurs twice is read once.
    ///
    /// # Errors
    /// [`SuiteError`] if an index cannot be read, and the first error of
    /// `keep`.
    pub fn of_files<S: Spread, T: Send, E: From<SuiteError>>(
        path: &str,
        names: &[String],
        reading: &Reading<'_, S, impl Fn(SuiteMember) -> T + Sync>,
        mut file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
        mut keep: impl FnMut(T) -> Result<K, E>,
    ) -> Result<Self, E> {
        let mut known = BTreeSet::new();
        let (names, doubled): (Vec<&String>, Vec<&String>) =
            names.iter().partition(|name| known.insert(*name));
        let mut survey;
        if let Some(results) = names.iter().find(|n| **n == PEER_RESULTS) {
            let bytes = file_bytes(results).map_err(SuiteError::from)?;
            let shown = format!("{path}/{results}");
            let mut listed = BTreeSet::from([(*results).clone()]);
            let read = |name: &str| {
                listed.insert(name.to_owned());
                file_bytes(name)
            };
            survey = Self::of_index(&shown, &bytes, reading, read, keep)?;
            container(path).clone_into(&mut survey.name);
            for name in names.iter().filter(|name| !listed.contains(**name)) {
                let shown = format!("{path}/{name}");
                survey.refuse(name, Fault::Unlisted.whole(&shown));
            }
        } else {
            survey = Self::empty(path, container(path));
            let mut given = FallbackUse::default();
            let read = |name: &&String, bytes: Result<Vec<u8>, _>| {
                let mut given = FallbackUse::default();
                let shown = Path::new(path).join(name).display().to_string();
                let shown = shown.replace(MAIN_SEPARATOR, "/");
                let within = name.rsplit_once('/').map(|(within, _)| within);
                let within = within.filter(|_| reading.options.recursive);
                let one = |settled| {
                    let record = given.see(settled);
                    let member = horizontal(&shown, name, within, record);
                    member.map(&reading.work)
                };
                let found: Result<Vec<_>, _> = bytes
                    .and_then(|b| settle(&shown, &b, reading.options, None))
                    .map(|settled| settled.into_iter().map(one).collect());
                (given, found.unwrap_or_else(|error| vec![Err(error)]))
            };
            let add = |name: &String, (seen, found)| {
                given.add(seen);
                for member in found {
                    match member {
                        Ok(member) => survey.members.push(Ok(keep(member)?)),
                        Err(error) => survey.refuse(name, error),
                    }
                }
                Ok::<(), E>(())
            };
            reading.each(names, |name| name, file_bytes, read, add)?;
            survey.members.extend(given.unused());
        }
        for name in doubled {
            let shown = format!("{path}/{name}");
            survey.refuse(name, Fault::Doubled.whole(&shown));
        }
        Ok(survey)
    }

    /// A survey without records, whose pairs are found by name.
    fn empty(path: &str, name: &str) -> Self {
        Self {
            path: path.to_owned(),
            name: name.to_owned(),
            members: Vec::new(),
            set_aside: SetAside::default(),
            study_rule: StudyRule::FirstName,
            paired: false,
        }
    }

    /// Sets a refused file aside, or adds its error as a fault of the suite.
    fn refuse(&mut self, name: &str, error: RecordError) {
        match Aside::of(name, error) {
            Ok(aside) => self.set_aside.extend([aside]),
            Err(error) => self.members.push(Err(error.into())),
        }
    }

    pub(super) fn of_index<S: Spread, T: Send, E: From<SuiteError>>(
        path: &str,
        bytes: &[u8],
        reading: &Reading<'_, S, impl Fn(SuiteMember) -> T + Sync>,
        file_bytes: impl FnMut(&str) -> Result<Vec<u8>, RecordError>,
        mut keep: impl FnMut(T) -> Result<K, E>,
    ) -> Result<Self, E> {
        let Index { rows, paired, study_rule } = Index::parse(path, bytes)?;
        // PEER's index has the name of its folder.
        let folder = path.strip_suffix(PEER_RESULTS).map(container);
        let name = folder.filter(|folder| !folder.is_empty());
        let empty = Self::empty(path, name.unwrap_or(stem(path)));
        let mut survey = Self { paired, study_rule, ..empty };
        let mut given = FallbackUse::default();
        let read = |row: &IndexRow, bytes: Result<Vec<u8>, _>| {
            let mut given = FallbackUse::default();
            let member = bytes.map_err(SuiteError::from).and_then(|bytes| {
                let see = |settled| given.see(settled);
                row.member(&bytes, reading.options, see)
            });
            (given, member.map(&reading.work))
        };
        let add = |_, (seen, member): (_, Result<T, SuiteError>)| {
            given.add(seen);
            survey.members.push(match member {
                Ok(member) => Ok(keep(member)?),
                Err(error) => Err(error),
            });
            Ok::<(), E>(())
        };
        reading.each(rows, |row| &*row.file, file_bytes, read, add)?;
        survey.members.extend(given.unused());
        Ok(survey)
    }
}

impl<M: MemberMotion> Survey<SuiteMember<M>> {
    /// The suite, if no record was refused.
    ///
    /// # Errors
    /// The first refused record; [`SuiteError::Empty`] without records; a name
    /// that two records share; an invalid pair.
    pub fn into_suite(self) -> Result<Suite<M>, SuiteError> {
        let Self { path, name, members, set_aside, study_rule, paired } = self;
        let mut members =
            members.into_iter().collect::<Result<Vec<_>, _>>()?;
        if members.is_empty() {
            return Err(SuiteError::Empty { path, set_aside });
        }
        pairing::check_names(&path, &members)?;
        if !paired {
            pairing::pair_by_name(&mut members);
        }
        if study_rule == StudyRule::FirstName {
            pairing::mark_first(&mut members);
        }
        pairing::check_pairs(&path, &members)?;
        Ok(Suite { name, members, study_rule, set_aside })
    }
}

/// Use of the caller's values in a suite: the values that any file took, and
/// the first file that contradicts each.
#[derive(Default)]
struct FallbackUse {
    taken: Fallback,
    dt: Option<RecordError>,
    unit: Option<RecordError>,
}

impl FallbackUse {
    fn see(&mut self, settled: Agreement) -> Record {
        let Agreement { record, dt, unit } = settled;
        self.add(Self { taken: record.given, dt: dt.err(), unit: unit.err() });
        record
    }

    /// Adds the use in later files.
    fn add(&mut self, later: Self) {
        self.taken.dt |= later.taken.dt;
        self.taken.unit |= later.taken.unit;
        self.dt = self.dt.take().or(later.dt);
        self.unit = self.unit.take().or(later.unit);
    }

    /// The first contradiction of each value that no file took.
    fn unused<K>(self) -> impl Iterator<Item = Result<K, SuiteError>> {
        let dt = self.dt.filter(|_| !self.taken.dt);
        let unit = self.unit.filter(|_| !self.taken.unit);
        dt.into_iter().chain(unit).map(|error| Err(error.into()))
    }
}

/// Name of a folder, or of a zip file without its ending.
fn container(path: &str) -> &str {
    let path = path.trim_end_matches(['/', '\\']);
    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
    name.strip_suffix(".zip").unwrap_or(name)
}

/// A record of a folder as a member of the suite. Refuses a vertical record, a
/// record from a borehole, and a file name that results cannot contain. The
/// name of the folder `within` the suite's folder precedes the name of the
/// record.
fn horizontal(
    shown: &str,
    file: &str,
    within: Option<&str>,
    record: Record,
) -> Result<SuiteMember, RecordError> {
    let name = || record.accelerogram.name().to_owned();
    if record.direction == Direction::Vertical {
        return Err(Fault::Vertical(name()).whole(shown));
    }
    if record.borehole {
        return Err(Fault::Borehole(name()).whole(shown));
    }
    result_name(file).map_err(|error| Fault::Name(error).whole(shown))?;
    let direction = record.direction;
    let mut member = SuiteMember::of(record, file.to_owned());
    if direction == Direction::Unknown {
        member.remarks.push(Remark::Direction);
    }
    if let Some(within) = within {
        let name = format!("{within}/{}", member.accelerogram.name());
        let named = member.accelerogram.named(name);
        member.accelerogram =
            named.map_err(|error| Fault::from(error).whole(shown))?;
    }
    Ok(member)
}

/// Adds the files of the folder `within` of `root` by their names relative to
/// `root`, and the other contents except hidden ones. Links to folders are not
/// followed: they may lead back.
fn contents(
    root: &Path,
    within: &str,
    recursive: bool,
    files: &mut BTreeMap<String, PathBuf>,
    others: &mut Vec<Aside>,
) -> Result<(), SuiteError> {
    let joined = root.join(within);
    // Joined to an empty name, the path would end in a separator.
    let path = if within.is_empty() { root } else { &joined };
    let fail = |error: std::io::Error| SuiteError::Unreadable {
        path: path.display().to_string(),
        reason: error.to_string(),
    };
    for entry in std::fs::read_dir(path).map_err(fail)? {
        let file = entry.map_err(fail)?.path();
        let name = name_of(&file);
        if name.starts_with('.') {
            continue;
        }
        let name = format!("{within}{name}");
        let own = std::fs::symlink_metadata(&file);
        if recursive && own.as_ref().is_ok_and(|found| found.is_dir()) {
            contents(root, &format!("{name}/"), recursive, files, others)?;
            continue;
        }
        let is_link = own.is_ok_and(|found| found.is_symlink());
        let closed = std::io::ErrorKind::PermissionDenied;
        let fault = match std::fs::metadata(&file) {
            Ok(found) if found.is_dir() => Fault::Folder,
            Ok(found) if !found.is_file() => Fault::Device,
            Err(error) if is_link && error.kind() != closed => Fault::DeadLink,
            // A file that cannot be read is refused when it is read.
            Ok(_) | Err(_) => {
                files.insert(name, file);
                continue;
            }
        };
        let error = fault.whole(&format!("{}/{name}", root.display()));
        others.push(Aside::of(&name, error)?);
    }
    Ok(())
}
