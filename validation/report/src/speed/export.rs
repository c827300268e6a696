//! Cases and chains as files that any tool can read.

use std::fmt::Write as _;
use std::path::Path;

use rocking::excitation::NormalisedRecord;
use rocking::ida::Analysis;

use rocking_common::files::{WriteError, write_atomically};

/// Writes a block under a record at some levels (in g) to `NAME.txt` in a
/// folder: lines `key value`, then one sample a line, which a level
/// multiplies. Numbers read back to the same doubles.
///
/// # Errors
/// [`WriteError`] naming the file or folder.
pub fn write(
    folder: &Path,
    name: &str,
    (analysis, record): (&Analysis, &NormalisedRecord),
    levels_g: impl Iterator<Item = f64>,
) -> Result<(), WriteError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| WriteError { path: folder.to_owned(), source })?;
    let levels: Vec<String> =
        levels_g.map(|level| level.to_string()).collect();
    let mut text = format!(
        "name {name}\nalpha_rad {}\np_rad_s {}\neta {}\ndt_s {}\n\
         levels_g {}\nsamples {}\n",
        analysis.block.slenderness_rad(),
        analysis.block.frequency_rad_s(),
        analysis.restitution.velocity_ratio(),
        record.dt_s(),
        levels.join(","),
        record.samples().len()
    );
    for sample in record.samples() {
        // Writing to a string cannot fail.
        let _ = writeln!(text, "{sample}");
    }
    write_atomically(&folder.join(format!("{name}.txt")), text)
}
