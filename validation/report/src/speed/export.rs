//! Cases and chains as files that any tool can read.

use std::fmt::Write as _;
use std::path::Path;

use rocking::excitation::NormalisedRecord;
use rocking::ida::{Analysis, IdaCurve};

use super::cases::SpeedCase;
use super::throughput::CurveWork;
use rocking_common::files::{WriteError, write_atomically};

/// Writes each case to the folder `singles`, and each chain with all its
/// levels to a folder of its block in `chains`.
///
/// # Errors
/// [`WriteError`] naming the file or folder.
pub fn cases_and_chains(
    folder: &Path,
    cases: &[SpeedCase],
    work: &CurveWork<'_>,
    found: &[Vec<IdaCurve>],
) -> Result<(), WriteError> {
    let singles = folder.join("singles");
    for SpeedCase { name, analysis, record, pga_g } in cases {
        write(&singles, name, (analysis, record), &[*pga_g])?;
    }
    for (analysis, found) in work.analyses.iter().zip(found) {
        let block = &analysis.block;
        let (p, alpha) = (block.frequency_rad_s(), block.slenderness_rad());
        let folder = folder.join(format!("chains/p{p}-a{alpha:.2}"));
        for (record, curve) in work.records.iter().zip(found) {
            let levels = curve.points.iter().map(|point| point.pga_g);
            let levels: Vec<f64> = levels.collect();
            write(&folder, record.name(), (analysis, record), &levels)?;
        }
    }
    Ok(())
}

/// Writes a block under a record at some levels (in g) to `NAME.txt`: lines
/// `key value`, then one sample a line, which a level multiplies. Numbers read
/// back to the same doubles.
fn write(
    folder: &Path,
    name: &str,
    (analysis, record): (&Analysis, &NormalisedRecord),
    levels_g: &[f64],
) -> Result<(), WriteError> {
    std::fs::create_dir_all(folder)
        .map_err(|source| WriteError { path: folder.to_owned(), source })?;
    let levels: Vec<String> = levels_g.iter().map(f64::to_string).collect();
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
