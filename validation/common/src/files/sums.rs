//! The manifest of a folder: the SHA-256 of each file of one run, in the form of
//! `sha256sum`.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Component, Path};

use rocking_records::sha256_hex;
use thiserror::Error;

use super::unfinished::moving;

/// Name of the manifest.
pub const SUMS: &str = "SHA256SUMS";

/// The manifest of these files, by their paths below the folder.
pub fn sums(files: &BTreeMap<String, Vec<u8>>) -> Vec<u8> {
    let line = |(name, content): (&String, &Vec<u8>)| {
        format!("{}  {name}\n", sha256_hex(content))
    };
    files.iter().map(line).collect::<String>().into_bytes()
}

/// Reason why the files of a folder are not the files of one run.
#[derive(Debug, Error)]
pub enum FolderError {
    /// A run ended while it put files into place.
    #[error(
        "files of two runs: expected a folder that was written to its end; \
         the command that wrote it completes it"
    )]
    Interrupted,
    /// A file of the manifest is missing or differs.
    #[error("{name}: {found}: expected the file of the run that wrote {SUMS}")]
    File {
        /// Its path below the folder.
        name: String,
        /// Its SHA-256, or the error of the system.
        found: String,
    },
    /// A line of the manifest has another form.
    #[error(
        "{SUMS}:{line}: found {found:?}: expected a SHA-256, two spaces and \
         the path of a file in the folder"
    )]
    Line {
        /// Line, from 1.
        line: usize,
        /// Its text.
        found: String,
    },
    /// The manifest cannot be read.
    #[error("{SUMS}: {0}")]
    Unread(#[from] io::Error),
}

/// Whether a manifest confirms that the files of `folder` are of one run; false
/// without a manifest.
///
/// # Errors
/// [`FolderError`] for a folder that a run left unfinished, for a file that
/// contradicts the manifest, and for a manifest that cannot be read.
pub fn is_whole(folder: &Path) -> Result<bool, FolderError> {
    if moving(folder).next().is_some() {
        return Err(FolderError::Interrupted);
    }
    let text = match fs::read_to_string(folder.join(SUMS)) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => {
            return Ok(false);
        }
        read => read?,
    };
    for (k, line) in text.lines().enumerate() {
        let Some((expected, name)) = parsed(line) else {
            let (line, found) = (k + 1, line.to_owned());
            return Err(FolderError::Line { line, found });
        };
        let found = match fs::read(folder.join(name)) {
            Err(error) => error.to_string(),
            Ok(content) if sha256_hex(&content) == expected => continue,
            Ok(content) => format!("SHA-256 {}", sha256_hex(&content)),
        };
        return Err(FolderError::File { name: name.to_owned(), found });
    }
    Ok(true)
}

/// The sums of a text and their paths; other lines are left out.
pub(super) fn listed(text: &str) -> impl Iterator<Item = (&str, &str)> {
    text.lines().filter_map(parsed)
}

/// The sum and the path of a line: one that stays below the folder.
fn parsed(line: &str) -> Option<(&str, &str)> {
    let (sum, name) = line.split_once("  ")?;
    let is_sum = sum.len() == 64 && sum.bytes().all(|b| b.is_ascii_hexdigit());
    let mut parts = Path::new(name).components();
    let stays = parts.all(|part| matches!(part, Component::Normal(_)));
    (is_sum && stays && !name.is_empty()).then_some((sum, name))
}
