//! The table of results in the README.

use thiserror::Error;

use super::evidence::Proof;
use super::findings::recorded;
use crate::findings::{Findings, Topic};
use crate::paper::{Intensity, SuiteKind, Verdict};

/// Marks around the table.
const MARKS: [&str; 2] = ["<!-- results -->\n", "<!-- end of results -->"];

/// Why the table could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadmeError {
    /// The README has no place for the table.
    #[error("README.md: expected a table between {:?} and {:?}", MARKS[0], MARKS[1])]
    Marks,
    /// The findings of the recorded suites cannot be read.
    #[error("{0}")]
    Recorded(String),
    /// The findings lack what the table shows.
    #[error("findings: no {0}")]
    Finding(&'static str),
}

/// `readme` with the table of these findings and these results of the
/// declared cases.
///
/// # Errors
/// [`ReadmeError`] for a README without marks, and for findings that lack
/// what the table shows.
pub fn renewed(
    readme: &str,
    findings: &Findings,
    proof: &Proof,
) -> Result<String, ReadmeError> {
    let around = || {
        let (before, rest) = readme.split_once(MARKS[0])?;
        Some((before, rest.split_once(MARKS[1])?.1))
    };
    let (before, after) = around().ok_or(ReadmeError::Marks)?;
    let table = table(findings, proof)?;
    Ok([before, MARKS[0], &table, MARKS[1], after].concat())
}

fn table(findings: &Findings, proof: &Proof) -> Result<String, ReadmeError> {
    let suites = &findings.suites;
    let analyses: u64 = suites.iter().map(|suite| suite.analyses).sum();
    let open: usize =
        suites.iter().map(|suite| suite.not_told_by_double_precision).sum();
    let rows = [
        (
            "declared cases that pass",
            format!(
                "{} of {}; half of their numbers use less than {:.0e} of the \
                 tolerance; wrong models rejected: {}",
                proof.passed(),
                proof.results().len(),
                proof.middle_margin(),
                proof.rejected()
            ),
        ),
        (
            "findings on the recorded suites (86 ordinary, 44 pulse-type \
             records), each with a 95 % interval",
            claims(&recorded().map_err(ReadmeError::Recorded)?),
        ),
        ("the same on the embedded suites", claims(findings)),
        (
            "analyses up to overturning; flagged: rounding may have \
             changed their peak or fate",
            format!("{analyses}; {open}"),
        ),
        (
            "median overturning PGA/(g tan alpha), p = 3 rad/s, alpha = \
             0.20, ordinary (95 % interval)",
            overturning(findings, SuiteKind::Ordinary)?,
        ),
        ("the same, pulse-type", overturning(findings, SuiteKind::PulseType)?),
    ];
    let lines: Vec<String> = rows
        .iter()
        .map(|(what, result)| format!("| {what} | {result} |\n"))
        .collect();
    Ok(format!("| what | result |\n|---|---|\n{}", lines.concat()))
}

/// Number of results with each verdict.
fn claims(findings: &Findings) -> String {
    let [confirmed, not, open] =
        Verdict::ALL.map(|verdict| findings.count(verdict));
    format!(
        "{confirmed} of {} confirmed, {not} not confirmed, {open} \
         inconclusive",
        confirmed + not + open
    )
}

/// Median overturning intensity of one block, with its interval.
fn overturning(
    findings: &Findings,
    suite: SuiteKind,
) -> Result<String, ReadmeError> {
    let rows = findings.table(Topic::Overturning).map(|table| &table.rows);
    let row = rows.into_iter().flatten().find(|row| {
        row.at.suite == Some(suite)
            && row.at.intensity == Some(Intensity::Pga)
            && row.at.p_rad_s == Some(3.0)
            && row.at.alpha_rad == Some(0.2)
    });
    let median = row.and_then(|row| row.values.first());
    median
        .and_then(|m| Some((m.value, m.interval?)))
        .map(|(x, (low, high))| format!("{x:.2} ({low:.2} to {high:.2})"))
        .ok_or(ReadmeError::Finding("overturning intensities"))
}
