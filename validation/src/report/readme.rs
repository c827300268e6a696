//! The table of results in the README.

use serde_json::Value;
use thiserror::Error;

use super::evidence::Proof;

/// Marks around the table.
const MARKS: [&str; 2] = ["<!-- results -->\n", "<!-- end of results -->"];

/// Why the table could not be made.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum ReadmeError {
    /// The README has no place for the table.
    #[error("README.md: expected a table between {:?} and {:?}", MARKS[0], MARKS[1])]
    Marks,
    /// The findings lack what the table shows.
    #[error("findings: no {0}")]
    Finding(&'static str),
    /// The findings are no JSON.
    #[error("findings: {0}")]
    Json(#[from] serde_json::Error),
}

/// `readme` with the table of these findings (the text of `findings.json`)
/// and these results of the declared cases.
///
/// # Errors
/// [`ReadmeError`] for a README without marks, and for findings that lack
/// what the table shows.
pub fn renewed(
    readme: &str,
    findings: &str,
    proof: &Proof,
) -> Result<String, ReadmeError> {
    let around = || {
        let (before, rest) = readme.split_once(MARKS[0])?;
        Some((before, rest.split_once(MARKS[1])?.1))
    };
    let (before, after) = around().ok_or(ReadmeError::Marks)?;
    let table = table(&serde_json::from_str(findings)?, proof)?;
    Ok([before, MARKS[0], &table, MARKS[1], after].concat())
}

fn table(findings: &Value, proof: &Proof) -> Result<String, ReadmeError> {
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
        ("claims of the paper, embedded suites", claims(findings)?),
        (
            "analyses up to overturning; flagged: rounding may have \
             changed their peak or fate",
            format!(
                "{}; {}",
                sum(findings, "analyses")?,
                sum(findings, "not_told_by_double_precision")?
            ),
        ),
        (
            "median overturning PGA/(g tan alpha), p = 3 rad/s, alpha = \
             0.20, ordinary (95 % interval)",
            overturning(findings, "ordinary")?,
        ),
        ("the same, pulse-type", overturning(findings, "pulse-type")?),
    ];
    let lines: Vec<String> = rows
        .iter()
        .map(|(what, result)| format!("| {what} | {result} |\n"))
        .collect();
    Ok(format!("| what | result |\n|---|---|\n{}", lines.concat()))
}

fn list<'a>(
    findings: &'a Value,
    name: &'static str,
) -> Result<&'a [Value], ReadmeError> {
    let list = findings[name].as_array().ok_or(ReadmeError::Finding(name))?;
    Ok(list)
}

/// Number of claims with each verdict.
fn claims(findings: &Value) -> Result<String, ReadmeError> {
    let claims = list(findings, "claims")?;
    let count = |verdict: &str| {
        claims.iter().filter(|c| c["verdict"] == verdict).count()
    };
    Ok(format!(
        "{} of {} confirmed, {} not confirmed, {} inconclusive",
        count("confirmed"),
        claims.len(),
        count("not confirmed"),
        count("inconclusive")
    ))
}

/// A count, over both suites.
fn sum(findings: &Value, name: &'static str) -> Result<u64, ReadmeError> {
    let suites = list(findings, "suites")?.iter();
    let counts = suites.map(|suite| suite[name].as_u64());
    counts.sum::<Option<u64>>().ok_or(ReadmeError::Finding(name))
}

/// Median overturning intensity of one block, with its interval.
fn overturning(findings: &Value, suite: &str) -> Result<String, ReadmeError> {
    let row = list(findings, "overturning")?.iter().find(|row| {
        row["suite"] == suite
            && row["im_kind"] == "pga"
            && row["p_rad_s"] == 3.0
            && row["alpha_rad"] == 0.2
    });
    let text = |row: &Value| {
        let interval = &row["interval"];
        let (low, high) = (interval[0].as_f64()?, interval[1].as_f64()?);
        let median = row["median"].as_f64()?;
        Some(format!("{median:.2} ({low:.2} to {high:.2})"))
    };
    row.and_then(text).ok_or(ReadmeError::Finding("overturning"))
}
