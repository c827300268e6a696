//! The committed findings of the recorded suites.

use anyhow::Context as _;

use rocking_common::findings::Findings;

/// Findings of the recorded suites: values, intervals, verdicts, record names
/// and hashes, and no sample of a record. The file's own words say how it is
/// made.
const RECORDED: &str =
    include_str!("../../../fixtures/recorded/findings.json");

/// The findings of the recorded suites.
///
/// # Errors
/// What the reader found instead of findings of this schema.
pub fn recorded() -> anyhow::Result<Findings> {
    Findings::parse(RECORDED)
        .map_err(anyhow::Error::msg)
        .context("fixtures/recorded/findings.json")
}
