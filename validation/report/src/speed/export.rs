//! Cases and chains as files that any tool can read.

use std::fmt::Write as _;
use std::path::Path;

use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, IdaCurve};

use super::cases::SpeedCase;
use rocking_common::files::{WriteError, write_atomically};

/// One block under one record at some levels.
struct ToolFile<'a> {
    name: &'a str,
    analysis: &'a Analysis,
    record: &'a NormalisedRecord,
    levels_g: Vec<f64>,
}

/// Writes each case to `NAME.txt` in a folder: lines `key value`, then one
/// sample a line, to be multiplied by the level. Numbers read back to the
/// same doubles.
///
/// # Errors
/// [`WriteError`] naming the file or folder.
pub fn singles(folder: &Path, cases: &[SpeedCase]) -> Result<(), WriteError> {
    create(folder)?;
    cases.iter().try_for_each(|case| {
        let (name, record) = (case.name.as_str(), &case.record);
        let analysis = Analysis::paper(case.block, case.restitution);
        let levels_g = vec![case.pga_g];
        let shown = ToolFile { name, analysis: &analysis, record, levels_g };
        shown.write(folder)
    })
}

/// Writes each chain of one analysis in the same way, with all its levels.
///
/// # Errors
/// [`WriteError`] naming the file or folder.
pub fn chains(
    folder: &Path,
    analysis: &Analysis,
    records: &[NormalisedRecord],
    found: &[IdaCurve],
) -> Result<(), WriteError> {
    create(folder)?;
    records.iter().zip(found).try_for_each(|(record, curve)| {
        let levels_g = curve.points.iter().map(|p| p.pga_g).collect();
        let name = record.name();
        ToolFile { name, analysis, record, levels_g }.write(folder)
    })
}

fn create(folder: &Path) -> Result<(), WriteError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| WriteError { path: folder.to_owned(), source })
}

impl ToolFile<'_> {
    fn write(&self, folder: &Path) -> Result<(), WriteError> {
        let path = folder.join(format!("{}.txt", self.name));
        write_atomically(&path, self.text())
    }

    fn text(&self) -> String {
        let samples = self.record.samples();
        let levels: Vec<String> =
            self.levels_g.iter().map(f64::to_string).collect();
        let mut out = String::new();
        // Writing to a string cannot fail.
        let _ = writeln!(
            out,
            "name {}\nalpha_rad {}\np_rad_s {}\neta {}\ndt_s {}\n\
             levels_g {}\nsamples {}",
            self.name,
            self.analysis.block.slenderness_rad(),
            self.analysis.block.frequency_rad_s(),
            self.analysis.restitution.velocity_ratio(),
            self.record.dt_s(),
            levels.join(","),
            samples.len()
        );
        for a in samples {
            let _ = writeln!(out, "{a}");
        }
        out
    }
}
