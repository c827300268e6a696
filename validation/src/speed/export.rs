//! The cases as files that any tool can read.

use std::fmt::Write as _;
use std::path::Path;

use super::cases::{Case, ETA};
use crate::files::{WriteError, write_atomically};

/// Writes each case to `NAME.txt` in a folder: lines `key value`, the last
/// key being `samples` with their number, then one sample a line. Numbers
/// read back to the same doubles.
///
/// # Errors
/// [`WriteError`] naming the file or folder.
pub fn write(folder: &Path, cases: &[Case]) -> Result<(), WriteError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| WriteError { path: folder.to_owned(), source })?;
    for case in cases {
        let path = folder.join(format!("{}.txt", case.name));
        write_atomically(&path, text(case))?;
    }
    Ok(())
}

fn text(case: &Case) -> String {
    let samples = case.samples_g();
    let mut out = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        out,
        "name {}\nalpha_rad {}\np_rad_s {}\neta {ETA}\ndt_s {}\nsamples {}",
        case.name,
        case.block.slenderness_rad(),
        case.block.frequency_rad_s(),
        case.record.dt_s(),
        samples.len()
    );
    for a in samples {
        let _ = writeln!(out, "{a}");
    }
    out
}
