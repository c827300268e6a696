//! Suites from files, checksums included.

use std::fmt::Write as _;
use std::path::Path;

use rocking::record::{ReadOptions, Suite, SuiteError, SuiteOptions};
use sha2::{Digest, Sha256};

/// SHA-256 of `bytes` in hexadecimal.
///
/// ```
/// let sum = rocking_validation::inputs::sha256_hex(b"abc");
/// assert!(sum.starts_with("ba7816bf8f01cfea414140de5dae2223"));
/// ```
#[must_use]
pub fn sha256_hex(bytes: &[u8]) -> String {
    let mut text = String::with_capacity(64);
    for byte in Sha256::digest(bytes) {
        // Writing to a string cannot fail.
        let _ = write!(text, "{byte:02x}");
    }
    text
}

/// Options by which an index's checksums are checked.
#[must_use]
pub fn suite_options(read: ReadOptions) -> SuiteOptions {
    SuiteOptions { read, sha256_hex: Some(sha256_hex) }
}

/// Reads the suite at `path`, a folder or an index, checksums included.
///
/// # Errors
/// As [`Suite::read`].
pub fn read_suite(
    path: &Path,
    read: ReadOptions,
) -> Result<Suite, SuiteError> {
    Suite::read(path, &suite_options(read))
}
