//! The answers in the README: those of the page.

use anyhow::Context as _;

use crate::answers;
use crate::evidence::Proof;
use crate::page::AnswerRow;
use crate::recorded::recorded;
use crate::scored::codes_table;
use crate::timings::Timings;
use rocking_common::findings::Findings;
use rocking_common::table::PlainTable;

/// Marks around the table.
const MARKS: [&str; 2] = ["<!-- results -->\n", "<!-- end of results -->"];

/// `readme` with the table of these findings and these results of the
/// declared cases.
///
/// # Errors
/// For a README without marks, and for kept files that
/// cannot be read.
pub fn renewed(
    readme: &str,
    findings: &Findings,
    proof: &Proof,
) -> anyhow::Result<String> {
    let around = || {
        let (before, rest) = readme.split_once(MARKS[0])?;
        Some((before, rest.split_once(MARKS[1])?.1))
    };
    let (before, after) = around().with_context(|| {
        format!(
            "README.md: expected a table between {:?} and {:?}",
            MARKS[0], MARKS[1]
        )
    })?;
    let table = table(findings, proof)?;
    Ok([before, MARKS[0], &table, MARKS[1], after].concat())
}

fn table(findings: &Findings, proof: &Proof) -> anyhow::Result<String> {
    let recorded = recorded()?;
    let timings = Timings::kept()?;
    let rows = answers::rows(
        true,
        findings,
        Some(&recorded),
        &timings,
        Some(proof),
        &[],
    )?;
    let line = |row: &AnswerRow| {
        let AnswerRow { question, answer, effect, .. } = row;
        let effect = effect.replace('|', "\\|");
        format!("| {question} | {answer} | {effect} |\n")
    };
    let lines: Vec<String> = rows.iter().map(line).collect();
    let other = answers::otherwise(findings, Some(&recorded))?;
    let codes = codes_table(&["best"]);
    Ok(format!(
        "| question | answer | numbers (90 % interval) |\n|---|---|---|\n{}\n{}\n\n\
         **{}** {}\n\n{}",
        lines.concat(),
        other.unwrap_or_default(),
        codes.title,
        codes.reading,
        markdown(&codes)
    ))
}

fn markdown(table: &PlainTable) -> String {
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = vec!["---".into(); table.header.len()];
    let lines = [&table.header, &rule].into_iter().chain(&table.rows);
    lines.map(line).collect()
}
