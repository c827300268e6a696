//! Reading every record that a folder or an index lists.

use std::collections::{BTreeMap, BTreeSet};
use std::convert::identity;
use std::path::{MAIN_SEPARATOR, Path, PathBuf};

use rayon::prelude::*;

use super::index::{self, Index, IndexRow};
use super::pairing;
use super::{Aside, SetAside, StudyRule, Suite, SuiteError, SuiteMember};
use crate::direction::Direction;
use crate::error::{Fault, RecordError};
use crate::quality::{MemberMotion, Remark};
use crate::read::{file_bytes, is_record, name_of, settle, stem};
use crate::record::{Agreement, Fallback, ReadOptions, Record};
use rocking::accelerogram::result_name;

/// The index in a folder or archive as PEER's site delivers it.
const PEER_RESULTS: &str = "_SearchResults.csv";

/// Bytes of the files that are in memory at a time, for each thread.
const CHUNK: usize = 1 << 19;

/// Bytes that any file counts, even one that cannot be read.
const LEAST: usize = 1 << 12;

/// How the records of a suite are read: on all threads of the caller's pool.
pub struct Reading<'a, W = fn(SuiteMember) -> SuiteMember> {
    /// Values of the caller.
    pub options: &'a ReadOptions,
    /// Whether the file of a name is read.
    pub chosen: &'a (dyn Fn(&str) -> bool + Sync),
    /// Work on each record, in any order.
    pub work: W,
}

impl<'a> Reading<'a> {
    /// Reads all files, without further work.
    pub fn all(options: &'a ReadOptions) -> Self {
        Self { options, chosen: &|_| true, work: identity }
    }
}

/// The contents of a file.
type Bytes = Result<Vec<u8>, RecordError>;

/// A file that is set aside, or a fault of the suite.
type Refused = Result<Aside, SuiteError>;

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
        Self::visit(path, &Reading::all(options), Ok)
    }
}

impl<K> Survey<K> {
    /// Reads every record of the folder or index at `path`, or the record file
    /// there, and keeps the result of `keep` for each, in their order.
    ///
    /// ```
    /// use std::path::Path;
    /// use rocking_records::{ReadOptions, Reading, SuiteError, Survey};
    /// let folder = Path::new("no such folder");
    /// let options = ReadOptions::default();
    /// let mut samples = 0;
    /// let found = Survey::visit(folder, &Reading::all(&options), |member| {
    ///     samples += member.accelerogram.samples_g().len();
    ///     Ok::<(), SuiteError>(())
    /// });
    /// assert!(found.is_err());
    /// ```
    ///
    /// # Errors
    /// [`SuiteError`] if the folder or index itself cannot be read, and
    /// the first error of `keep`.
    pub fn visit<T: Send, E: From<SuiteError>>(
        path: &Path,
        reading: &Reading<'_, impl Fn(SuiteMember) -> T + Sync>,
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
    pub fn of_files<T: Send, E: From<SuiteError>>(
        path: &str,
        names: &[String],
        reading: &Reading<'_, impl Fn(SuiteMember) -> T + Sync>,
        mut file_bytes: impl FnMut(&str) -> Bytes,
        keep: impl FnMut(T) -> Result<K, E>,
    ) -> Result<Self, E> {
        let mut known = BTreeSet::new();
        let options = reading.options;
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
                let fault = Fault::Unlisted.whole(&shown);
                survey.set_aside.extend(Aside::of(name, fault));
            }
        } else {
            survey = Self::empty(path, container(path));
            let read = |name: &String,
                        text: Bytes,
                        given: &mut FallbackUse| {
                let shown = Path::new(path).join(name).display().to_string();
                let shown = shown.replace(MAIN_SEPARATOR, "/");
                let within = name.rsplit_once('/').map(|(within, _)| within);
                let within = within.filter(|_| options.recursive);
                let refuse = |e| Aside::of(name, e).map_err(SuiteError::from);
                let mut found = Vec::new();
                let records = text
                    .and_then(|b| settle(&shown, &b, options, None))
                    .unwrap_or_else(|error| {
                        found.push(Err(refuse(error)));
                        Vec::new()
                    });
                for settled in records {
                    let record = given.see(settled);
                    let member = horizontal(&shown, name, within, record);
                    found.push(member.map(&reading.work).map_err(refuse));
                }
                found
            };
            let chosen = names.into_iter().filter(|n| (reading.chosen)(n));
            survey.add(chosen, |name| file_bytes(name), read, keep)?;
        }
        for name in doubled {
            let shown = format!("{path}/{name}");
            let fault = Fault::Doubled.whole(&shown);
            survey.set_aside.extend(Aside::of(name, fault));
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

    /// Reads files on all threads, and keeps the result of `keep` for each of
    /// their records, in the order of the files.
    fn add<F: Send, T: Send, E>(
        &mut self,
        files: impl Iterator<Item = F>,
        mut file_bytes: impl FnMut(&F) -> Bytes,
        read: impl Fn(F, Bytes, &mut FallbackUse) -> Vec<Result<T, Refused>> + Sync,
        mut keep: impl FnMut(T) -> Result<K, E>,
    ) -> Result<(), E> {
        let work = |(file, bytes)| {
            let mut given = FallbackUse::default();
            (read(file, bytes, &mut given), given)
        };
        let mut given = FallbackUse::default();
        let mut files = files.peekable();
        while files.peek().is_some() {
            let (mut chunk, mut size) = (Vec::new(), 0);
            while size < CHUNK * rayon::current_num_threads()
                && let Some(file) = files.next()
            {
                let bytes = file_bytes(&file);
                size += bytes.as_ref().map_or(0, Vec::len).max(LEAST);
                chunk.push((file, bytes));
            }
            let chunk = chunk.into_par_iter().panic_fuse().map(work);
            for (found, seen) in chunk.collect::<Vec<_>>() {
                given.add(seen);
                for member in found {
                    match member {
                        Ok(member) => self.members.push(Ok(keep(member)?)),
                        Err(Ok(aside)) => self.set_aside.extend([aside]),
                        Err(Err(error)) => self.members.push(Err(error)),
                    }
                }
            }
        }
        self.members.extend(given.unused());
        Ok(())
    }

    pub(super) fn of_index<T: Send, E: From<SuiteError>>(
        path: &str,
        bytes: &[u8],
        reading: &Reading<'_, impl Fn(SuiteMember) -> T + Sync>,
        mut file_bytes: impl FnMut(&str) -> Bytes,
        keep: impl FnMut(T) -> Result<K, E>,
    ) -> Result<Self, E> {
        let Index { rows, paired, study_rule } = Index::parse(path, bytes)?;
        // PEER's index has the name of its folder.
        let folder = path.strip_suffix(PEER_RESULTS).map(container);
        let name = folder.filter(|folder| !folder.is_empty());
        let empty = Self::empty(path, name.unwrap_or(stem(path)));
        let mut survey = Self { paired, study_rule, ..empty };
        let read = |row: IndexRow, bytes: Bytes, given: &mut FallbackUse| {
            let see = |settled| given.see(settled);
            let found = bytes.map_err(SuiteError::from);
            let found =
                found.and_then(|b| row.member(&b, reading.options, see));
            vec![found.map(&reading.work).map_err(Err)]
        };
        let chosen =
            rows.into_iter().filter(|row| (reading.chosen)(&row.file));
        survey.add(chosen, |row| file_bytes(&row.file), read, keep)?;
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
