//! The generator of `fixtures/lilliefors/table.csv`.

use std::fmt::Write as _;
use std::path::Path;

use rocking::statistics::lilliefors::{NullDistribution, Table};

use crate::cli::{Failure, progress};
use crate::files::Output;

/// Simulates every size of the table and writes it: 3.4e8 samples, some
/// minutes of one core.
///
/// # Errors
/// [`Failure`] if the file cannot be written.
pub(super) fn write(path: &Path) -> Result<(), Failure> {
    let out = Output::open(path, &[])?;
    let sizes = Table::sizes();
    let progress = progress(sizes.len() as u64);
    let mut csv =
        String::from("n,replicates,level,critical_value,standard_error\n");
    for (n, replicates) in sizes {
        let null = NullDistribution::simulate(n, replicates, 0)?;
        for level in Table::LEVELS {
            let critical = null.critical_value(level)?;
            writeln!(
                csv,
                "{n},{replicates},{level},{:.8},{:.1e}",
                critical.value, critical.standard_error
            )?;
        }
        progress.inc(1);
    }
    progress.finish_and_clear();
    Ok(out.write(csv)?)
}
