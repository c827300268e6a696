//! Where the files of a study's folder lie.

use std::collections::BTreeMap;

/// Files of a report by name; folders in a name are parted by `/`.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The page: where it is, all other files are.
pub const PAGE: &str = "index.html";

/// Where a report's findings lie.
pub const FINDINGS: &str = "data/findings.json";

/// Puts what a person compares into `data/`, drawings into `figures/`; the
/// page stays on top.
#[must_use]
pub fn laid_out(files: Files) -> Files {
    let place = |name: String| match name.rsplit_once('.') {
        Some((_, "csv" | "json")) => format!("data/{name}"),
        Some((_, "svg")) => format!("figures/{name}"),
        _ => name,
    };
    files.into_iter().map(|(name, text)| (place(name), text)).collect()
}
