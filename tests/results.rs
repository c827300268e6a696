//! The results in README, docs and paper are those of the committed report:
//! they stand between marks.

use std::fs;

use anyhow::{Context as _, bail};
use rocking_common::findings::Findings;
use rocking_common::table::PlainTable;
use rocking_report::evidence::Proof;
use rocking_report::law::LawCells;
use rocking_report::output::{AnswerRow, first_table};
use rocking_report::timings::Timings;

use super::compare::{accepting, committed};
use super::house::{read, root};

/// The pages.
const PAGES: [&str; 3] = ["README.md", "docs/theory.md", "paper.md"];

/// What opens a mark, before its name, and what closes it, behind it.
const OPENS: [&str; 2] = ["<!-- results: ", " -->"];
/// What ends the results.
const END: &str = "<!-- end of results -->";

/// The text of a page with these results between its marks.
fn renewed(
    findings: &Findings,
    proof: &Proof,
    page: &str,
    text: &str,
) -> anyhow::Result<String> {
    let mut parts = text.split(OPENS[0]);
    let mut out = parts.next().unwrap_or_default().to_owned();
    let mut marks = 0;
    for part in parts {
        let split = || {
            let (name, rest) = part.split_once(OPENS[1])?;
            let (old, after) = rest.split_once(END)?;
            Some((name, old, after))
        };
        let (name, old, after) =
            split().with_context(|| format!("{page}: no {END:?}"))?;
        let new = match name {
            "answers" => answers(findings, proof)?,
            "accuracy" => Timings::kept()?.error(),
            "law" => law()?,
            "law-parts" => {
                let table = LawCells::kept()?.parts();
                format!("\n{}\n{}\n", markdown(&table), table.reading)
            }
            // `.ci/accept` runs `rocking assess` for it.
            "assessment" => old.to_owned(),
            _ => bail!("{page}: results {name:?}"),
        };
        out += &[OPENS[0], name, OPENS[1], &new, END, after].concat();
        marks += 1;
    }
    anyhow::ensure!(marks > 0, "{page}: no mark");
    Ok(out)
}

fn answers(findings: &Findings, proof: &Proof) -> anyhow::Result<String> {
    let (rows, _) = first_table(true, findings, Some(proof))?;
    let line = |row: &AnswerRow| {
        let AnswerRow { question, answer, .. } = row;
        format!("| {question} | {} |\n", answer.replace('|', "\\|"))
    };
    let lines: String = rows.iter().map(line).collect();
    Ok(format!("\n| Question | Answer |\n|---|---|\n{lines}"))
}

/// The law of AvgSA: its answer, and its table.
fn law() -> anyhow::Result<String> {
    let kept = LawCells::kept()?;
    let (answer, numbers) = kept.answer()?;
    let table = kept.table()?;
    Ok(format!(
        "\n{answer} Numbers: {numbers}.\n\n{}\n{}\n",
        markdown(&table),
        table.reading
    ))
}

fn markdown(table: &PlainTable) -> String {
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = vec!["---".into(); table.header.len()];
    let lines = [&table.header, &rule].into_iter().chain(&table.rows);
    lines.map(line).collect()
}

#[test]
fn pages_show_the_committed_results() {
    let data = accepting().unwrap_or_else(root).join("reports/data");
    let proof = Proof::read(&data).unwrap();
    let findings = fs::read_to_string(data.join("findings.json")).unwrap();
    let findings = Findings::parse(&findings).unwrap();
    // With other settings, and without its claims, it is another report.
    let mut other = findings.clone();
    other.settings.eta = 0.9;
    other.claims.retain(|claim| claim.results.is_empty());
    for page in PAGES {
        let text = read(page);
        let expected = renewed(&findings, &proof, page, &text).unwrap();
        let kept = committed(page, &expected).unwrap_or(expected.clone());
        assert!(
            kept == expected,
            "{page}: other results than those of reports/, expected as \
             `.ci/accept` writes it:\n{expected}"
        );
        let cut = text.replace(END, "");
        assert!(renewed(&findings, &proof, page, &cut).is_err(), "{page}");
    }
    let readme = read("README.md");
    let other = renewed(&other, &proof, "README.md", &readme).unwrap();
    assert_ne!(other, readme);
}

/// JOSS: these sections and at most 1750 words; where each reference is found.
#[test]
fn the_paper_has_what_its_journal_requires() {
    let paper = read("paper.md");
    let sections = "Summary, Statement of need, State of the field, \
                    Software design, Research impact statement, AI usage \
                    disclosure, Acknowledgements, References";
    for section in sections.split(", ") {
        assert!(paper.contains(&format!("\n# {section}\n")), "{section}");
    }
    assert!((750..=1750).contains(&paper.split_whitespace().count()));
    for entry in read("paper.bib").split("\n@") {
        assert!(entry.contains("doi = {") || entry.contains("url = {"));
    }
}
