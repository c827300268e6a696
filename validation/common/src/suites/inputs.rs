//! Suites from files and zips, checksums included.

use std::collections::{BTreeMap, BTreeSet};
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};

use anyhow::bail;
use rocking::accelerogram::Accelerogram;
pub use rocking_records::sha256_hex;
use rocking_records::{
    Fault, MemberMotion, Processing, ProcessingError, Profile, ReadOptions,
    Reading, Suite, SuiteError, SuiteMember, Survey,
};
use zip::ZipArchive;

/// The index in an archive as PEER's site delivers it.
const SEARCH_RESULTS: &str = "_SearchResults.csv";

/// How many times its size an archive may unpack to. Real records compress
/// by 3 to 4, zero-padded ones by up to 6.
const LARGEST_RATIO: u64 = 6;

/// Bytes to which an archive of any size may unpack.
const SMALLEST_LIMIT: u64 = 1 << 20;

/// The limit of an index is this part of the limit of the archive: its cells take
/// more memory than samples.
const INDEX_PART: u64 = 12;

/// Approximate number of samples of the records of one block. A command keeps the
/// records of one block and their curves at a time, however large the suite is.
pub const BLOCK_SAMPLES: usize = 1 << 22;

/// A suite of at most this number of blocks stays in memory as it is read.
const KEPT_BLOCKS: usize = 3;

/// Reads the suite at `path`: a folder, an index, or a zip of either.
///
/// # Errors
/// As [`Suite::read`].
pub fn read_suite(
    path: &Path,
    read: ReadOptions,
) -> Result<Suite, SuiteError> {
    visit(path, &Reading::all(&read), Ok).and_then(Survey::into_suite)
}

/// A suite whose records are worked off one after the other.
pub struct SuiteInput<'a> {
    path: &'a Path,
    options: ReadOptions,
    processing: &'a Processing,
    /// The records, if the suite is small. The samples of a larger suite stay
    /// in their files.
    kept: Option<BTreeMap<String, Accelerogram>>,
}

impl<'a> SuiteInput<'a> {
    /// Reads the suite at `path`, which is worked off in blocks of about
    /// `block_samples` samples.
    ///
    /// # Errors
    /// As [`Suite::read`], and [`ProcessingError`] for a record that cannot be
    /// processed.
    pub fn read<E: From<SuiteError> + From<ProcessingError>>(
        path: &'a Path,
        options: ReadOptions,
        processing: &'a Processing,
        block_samples: usize,
    ) -> Result<(Self, Suite<Profile>), E> {
        let most = block_samples.saturating_mul(KEPT_BLOCKS);
        let (mut kept, mut samples) = (BTreeMap::new(), 0);
        let mut input = Self { path, options, processing, kept: None };
        let survey = input.visit(&|_| true, |(member, record)| {
            samples += record.samples_g().len();
            kept.insert(record.name().to_owned(), record);
            if samples > most {
                kept.clear();
            }
            Ok::<_, E>(member)
        })?;
        input.kept = (samples <= most).then_some(kept);
        Ok((input, survey.into_suite()?))
    }

    /// Passes the records of `chosen`, members of the suite, to `each`, one
    /// after the other. Their files are read again if the suite is large.
    ///
    /// # Errors
    /// As [`SuiteInput::read`]; [`SuiteError::Changed`] for a record that has
    /// changed; the first error of `each`.
    pub fn each<E: From<SuiteError> + From<ProcessingError>>(
        self,
        chosen: &[&SuiteMember<Profile>],
        mut each: impl FnMut(&Accelerogram, &SuiteMember<Profile>) -> Result<(), E>,
    ) -> Result<(), E> {
        if let Some(kept) = self.kept {
            let record =
                |m: &SuiteMember<Profile>| &kept[m.accelerogram.name()];
            return chosen.iter().try_for_each(|m| each(record(m), m));
        }
        let changed = |expected: &SuiteMember<Profile>| SuiteError::Changed {
            path: self.path.display().to_string(),
            name: expected.accelerogram.name().to_owned(),
        };
        let files: BTreeSet<&str> = chosen.iter().map(|m| &*m.file).collect();
        let mut left = chosen.iter().peekable();
        self.visit(&|file| files.contains(file), |(found, record)| {
            let found = found.accelerogram;
            match left.next_if(|m| m.accelerogram.name() == found.name()) {
                Some(m) if m.accelerogram != found => Err(changed(m).into()),
                Some(member) => each(&record, member),
                None => Ok(()),
            }
        })?;
        left.next().map_or(Ok(()), |expected| Err(changed(expected).into()))
    }

    /// Reads and processes the records of the `chosen` files, and keeps the
    /// result of `keep` for each.
    fn visit<K, E: From<SuiteError> + From<ProcessingError>>(
        &self,
        chosen: &(dyn Fn(&str) -> bool + Sync),
        mut keep: impl FnMut((SuiteMember<Profile>, Accelerogram)) -> Result<K, E>,
    ) -> Result<Survey<K>, E> {
        let work = |mut member: SuiteMember| {
            member.accelerogram =
                self.processing.apply(&member.accelerogram)?;
            Ok::<_, ProcessingError>(member.into_profile())
        };
        let reading = Reading { options: &self.options, chosen, work };
        visit(self.path, &reading, |found| keep(found?))
    }
}

/// The files of the suite that was read from `path`.
pub fn files<M: MemberMotion>(path: &Path, suite: &Suite<M>) -> Vec<PathBuf> {
    let base = match path.is_dir() {
        true => path,
        false => path.parent().unwrap_or(Path::new("")),
    };
    let members = suite.members().iter().map(|m| base.join(&m.file));
    std::iter::once(path.to_owned()).chain(members).collect()
}

/// Reads the records of the folder, index or zip at `path`, checksums included,
/// and keeps the result of `keep` for each.
///
/// # Errors
/// As [`Survey::visit`]; [`SuiteError::Unreadable`] for a damaged zip.
pub fn visit<T: Send, K, E: From<SuiteError>>(
    path: &Path,
    reading: &Reading<'_, impl Fn(SuiteMember) -> T + Sync>,
    keep: impl FnMut(T) -> Result<K, E>,
) -> Result<Survey<K>, E> {
    if path.is_dir() || !is_zip(path) {
        return Survey::visit(path, reading, keep);
    }
    let shown = path.display().to_string();
    let file = File::open(path).map_err(unreadable(&shown))?;
    visit_zip(&shown, file, reading, keep)
}

/// The error for a reason why the suite at `shown` cannot be read.
fn unreadable<E: ToString>(shown: &str) -> impl Fn(E) -> SuiteError {
    move |reason| SuiteError::Unreadable {
        path: shown.to_owned(),
        reason: reason.to_string(),
    }
}

/// Reads every record of the zip `archive`, which `shown` names in messages.
///
/// The archive may unpack to six times its size and an index to half of its size
/// (1 MiB and 85 KiB for a small archive), and no two of its files may share bytes.
/// Reading 1 MiB takes less than 64 MiB of memory, and a command that reads it less
/// than 256 MiB, even for a hostile archive (`tests/memory.rs`). `study` keeps the
/// data of all its figures and takes more if the file contains a valid record.
///
/// # Errors
/// As [`visit`].
pub fn visit_zip<T: Send, K, E: From<SuiteError>>(
    shown: &str,
    mut archive: impl Read + Seek,
    reading: &Reading<'_, impl Fn(SuiteMember) -> T + Sync>,
    keep: impl FnMut(T) -> Result<K, E>,
) -> Result<Survey<K>, E> {
    let size = archive.seek(SeekFrom::End(0)).map_err(unreadable(shown))?;
    let mut left = SMALLEST_LIMIT.max(size.saturating_mul(LARGEST_RATIO));
    let index_limit = left / INDEX_PART;
    let (mut archive, names) =
        opened(archive, size).map_err(unreadable(shown))?;
    let (base, names) = contents(names);
    let unpacked = |name: &str| {
        if name.split('/').any(|part| part == "..") {
            return Err(Fault::Outside.whole(&format!("{shown}/{name}")));
        }
        let limit = if name == SEARCH_RESULTS { index_limit } else { left };
        let mut bytes = Vec::new();
        let path = format!("{base}{name}");
        let done = unpack(&mut archive, &path, limit, &mut bytes);
        // Refused files count, too: a thousand of them take no longer.
        left = left.saturating_sub(bytes.len() as u64);
        done.map(|()| bytes).map_err(|reason| {
            Fault::Unreadable(reason).whole(&format!("{shown}/{name}"))
        })
    };
    Survey::of_files(shown, &names, reading, unpacked, keep)
}

/// An archive of `size` bytes, and the names of its files.
fn opened<R: Read + Seek>(
    mut archive: R,
    size: u64,
) -> anyhow::Result<(ZipArchive<R>, Vec<String>)> {
    if !has_end(&mut archive, size)? {
        bail!("the archive is cut: expected a list of its files at its end");
    }
    let list = ZipArchive::new(&mut archive)?;
    let doubled = match list.has_duplicate_names() {
        true => {
            let start = list.central_directory_start();
            doubled_names(&mut archive, start)?
        }
        false => Vec::new(),
    };
    let mut archive = ZipArchive::new(archive)?;
    if let Some((one, other)) = shared(&mut archive) {
        bail!(
            "files {one} and {other} of the archive share their bytes: \
             expected each file once"
        );
    }
    let mut names = Vec::new();
    for name in archive.file_names() {
        names.push(name?.into_owned());
    }
    for name in doubled {
        let found = archive.index_for_name_raw(&name);
        let name = found.and_then(|index| archive.name_for_index(index));
        names.extend(name.transpose()?.map(Into::into));
    }
    Ok((archive, names))
}

/// Two files of an archive that share bytes. By shared bytes a small archive could
/// contain any number of records.
fn shared(
    archive: &mut ZipArchive<impl Read + Seek>,
) -> Option<(String, String)> {
    let mut parts = Vec::new();
    for index in 0..archive.len() {
        // A file that cannot be found is refused when it is read.
        let Ok(file) = archive.by_index_raw(index) else { continue };
        let Some(data) = file.data_start() else { continue };
        let end = data.saturating_add(file.compressed_size());
        parts.push((file.header_start(), end, index));
    }
    parts.sort_unstable();
    let overlap = parts.windows(2).find(|pair| pair[1].0 < pair[0].1)?;
    let name = |index| {
        let name = archive.name_for_index(index).and_then(Result::ok);
        name.map_or(String::new(), |name| name.escape_debug().to_string())
    };
    Some((name(overlap[0].2), name(overlap[1].2)))
}

/// Repeated names in the central directory of an archive, which begins at `start`.
/// Of several files with one name the archive gives only the last.
fn doubled_names(
    archive: &mut (impl Read + Seek),
    start: u64,
) -> io::Result<Vec<Vec<u8>>> {
    let (mut known, mut doubled) = (BTreeSet::new(), Vec::new());
    archive.seek(SeekFrom::Start(start))?;
    loop {
        let (mut signature, mut head) = ([0; 4], [0; 42]);
        archive.read_exact(&mut signature)?;
        // A record of another signature follows the entries.
        if signature != *b"PK\x01\x02" {
            return Ok(doubled);
        }
        archive.read_exact(&mut head)?;
        // Lengths of the name, of the extra field, and of the comment.
        let length = |at: usize| u16::from_le_bytes([head[at], head[at + 1]]);
        let mut name = vec![0; usize::from(length(24))];
        archive.read_exact(&mut name)?;
        let rest = i64::from(length(26)) + i64::from(length(28));
        archive.seek(SeekFrom::Current(rest))?;
        if !known.insert(name.clone()) {
            doubled.push(name);
        }
    }
}

/// Whether an archive of `size` bytes has the record at the end of every zip: 22
/// bytes and a comment of at most 65,535 bytes.
fn has_end(archive: &mut (impl Read + Seek), size: u64) -> io::Result<bool> {
    let mut end = Vec::new();
    archive.seek(SeekFrom::Start(size.saturating_sub(22 + 65_535)))?;
    archive.read_to_end(&mut end)?;
    Ok(end.windows(4).any(|bytes| bytes == b"PK\x05\x06"))
}

/// The folder of an archive that contains PEER's search results, if any, and the
/// files in it, by name. Hidden files and folders are left out; a part `..` hides
/// nothing.
fn contents(names: Vec<String>) -> (String, Vec<String>) {
    let base = names
        .iter()
        .find_map(|name| name.strip_suffix(SEARCH_RESULTS))
        .unwrap_or("")
        .to_owned();
    let hidden = |name: &str| {
        let hides = |part: &str| part.starts_with('.') && part != "..";
        name.split('/').any(|part| hides(part) || part == "__MACOSX")
    };
    let mut inside: Vec<String> = names
        .iter()
        .filter_map(|name| name.strip_prefix(base.as_str()))
        .filter(|name| !name.ends_with('/') && !hidden(name))
        .map(str::to_owned)
        .collect();
    inside.sort();
    (base, inside)
}

/// Whether the file at `path` begins as a zip does.
pub fn is_zip(path: &Path) -> bool {
    let mut start = [0; 4];
    File::open(path)
        .and_then(|mut file| file.read_exact(&mut start))
        .is_ok_and(|()| start == *b"PK\x03\x04")
}

/// Reads one file of an archive, if it is no larger than `limit` bytes. The bytes
/// that were read of a larger file stay in `bytes`.
fn unpack(
    archive: &mut ZipArchive<impl Read + Seek>,
    name: &str,
    limit: u64,
    bytes: &mut Vec<u8>,
) -> Result<(), String> {
    let file = archive.by_name(name).map_err(|e| e.to_string())?;
    // The size in the archive is a hint and may be false.
    bytes.reserve(file.size().min(limit) as usize + 1);
    let read = file.take(limit + 1).read_to_end(bytes);
    read.map_err(|e| e.to_string())?;
    if bytes.len() as u64 > limit {
        return Err(format!(
            "unpacks to more than the {limit} bytes left to it: expected at \
             most {LARGEST_RATIO} times the archive's size for all files and \
             half of its size for an index; what is larger is read from the \
             unpacked folder",
        ));
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    #[test]
    fn files_of_a_zip_that_share_their_bytes_are_refused() {
        use std::io::{Cursor, Write as _};
        let mut zip = zip::ZipWriter::new(Cursor::new(Vec::new()));
        let stored = zip::write::SimpleFileOptions::default()
            .compression_method(zip::CompressionMethod::Stored);
        for name in ["a.txt", "b.txt"] {
            zip.start_file(name, stored).unwrap();
            zip.write_all(b"0\n0.1\n-0.2\n").unwrap();
        }
        let mut bytes = zip.finish().unwrap().into_inner();
        let unit = Some(rocking::units::AccelerationUnit::Gravity);
        let read =
            ReadOptions { dt_s: Some(0.01), unit, ..ReadOptions::default() };
        let visit = |bytes: &[u8]| {
            let read = Reading::all(&read);
            let keep = Ok::<_, SuiteError>;
            let found = visit_zip("x.zip", Cursor::new(bytes), &read, keep);
            found.map(|_| ()).map_err(|error| error.to_string())
        };
        assert_eq!(visit(&bytes), Ok(()));
        // The second file's place, 42 bytes behind its entry's signature.
        let entries = bytes.windows(4).enumerate();
        let mut entries = entries.filter(|(_, b)| *b == b"PK\x01\x02");
        let (second, _) = entries.nth(1).unwrap();
        bytes[second + 42..second + 46].fill(0);
        let error = visit(&bytes).unwrap_err();
        assert!(error.contains("files a.txt and b.txt"), "{error}");
        assert!(error.contains("share their bytes"), "{error}");
    }

    #[test]
    fn a_record_that_changed_between_two_readings_is_refused() {
        let place = tempfile::tempdir().unwrap();
        let write = |name: &str, text: &str| {
            fs::write(place.path().join(name), text).unwrap();
        };
        write("a.txt", "0\n0.1\n-0.2\n");
        write("b.txt", "0\n0.3\n-0.1\n");
        let unit = Some(rocking::units::AccelerationUnit::Gravity);
        let read =
            ReadOptions { dt_s: Some(0.01), unit, ..ReadOptions::default() };
        let none = Processing::default();
        let path = place.path();
        let open = |block_samples| {
            SuiteInput::read::<anyhow::Error>(path, read, &none, block_samples)
        };
        let suite = open(0).unwrap().1;
        let members: Vec<_> = suite.members().iter().collect();
        let again = || {
            let mut names = Vec::new();
            let large = SuiteInput {
                path,
                options: read,
                processing: &none,
                kept: None,
            };
            let done: anyhow::Result<()> =
                large.each(&members, |record, member| {
                    assert_eq!(member.file, format!("{}.txt", record.name()));
                    names.push(record.name().to_owned());
                    Ok(())
                });
            (names, done.map_err(|error| error.to_string()))
        };
        assert_eq!(again(), (vec!["a".to_owned(), "b".to_owned()], Ok(())));
        // One more record is none of the chosen.
        write("aa.txt", "0\n0.1\n-0.2\n");
        assert_eq!(again().0.len(), 2);
        write("b.txt", "0\n0.3\n-0.11\n");
        let (names, done) = again();
        assert_eq!(names, ["a"]);
        assert!(done.unwrap_err().contains("record \"b\" has changed"));
        fs::remove_file(path.join("b.txt")).unwrap();
        assert!(again().1.unwrap_err().contains("record \"b\" has changed"));
    }
}
