//! Results of this program in pages that are written by hand: the program
//! writes them between marks.

use anyhow::{Context as _, bail};

use crate::answers::{self, AnswerRow};
use crate::basis::FindingSets;
use crate::evidence::Proof;
use crate::scored::codes_table;
use crate::timings::Timings;
use rocking_common::findings::Findings;
use rocking_common::table::PlainTable;

/// The pages.
pub const PAGES: [&str; 3] = ["README.md", "docs/tour.md", "paper.md"];

/// What opens a mark, before its name, and what closes it, behind it.
const OPENS: [&str; 2] = ["<!-- results: ", " -->"];
/// What ends the results.
const END: &str = "<!-- end of results -->";

/// What the marks show.
pub struct PageResults<'a> {
    /// Findings of the committed report.
    pub findings: &'a Findings,
    /// Results of the declared cases.
    pub proof: &'a Proof,
}

impl PageResults<'_> {
    /// The text of a page with these results between its marks.
    ///
    /// # Errors
    /// For a page without marks, a mark of another name or without its end,
    /// and for kept files that cannot be read.
    pub fn renewed(&self, page: &str, text: &str) -> anyhow::Result<String> {
        let mut parts = text.split(OPENS[0]);
        let mut out = parts.next().unwrap_or_default().to_owned();
        let mut marks = 0;
        for part in parts {
            let split = || {
                let (name, rest) = part.split_once(OPENS[1])?;
                let (old, after) = rest.split_once(END)?;
                Some((name, old, after))
            };
            let (name, old, after) = split().with_context(|| {
                format!(
                    "{page}: mark {}: expected {END:?} behind it",
                    marks + 1
                )
            })?;
            let new = match name {
                // `.ci/accept` runs `rocking assess` for it.
                "assessment" => old.to_owned(),
                _ => self.shown(name).with_context(|| page.to_owned())?,
            };
            out += &[OPENS[0], name, OPENS[1], &new, END, after].concat();
            marks += 1;
        }
        if marks == 0 {
            bail!("{page}: expected results between marks {:?}", OPENS[0]);
        }
        Ok(out)
    }

    fn shown(&self, name: &str) -> anyhow::Result<String> {
        let basis = FindingSets::of(true, self.findings)?;
        Ok(match name {
            "answers" => self.answers(&basis)?,
            "accuracy" => Timings::kept()?.error(),
            "contents" => {
                let recorded = basis.recorded().context("other settings")?;
                format!(
                    "\nRecorded motions:\n{}\nEmbedded motions:\n{}",
                    listed(answer(recorded, name)?),
                    listed(answer(self.findings, name)?)
                )
            }
            _ => bail!("results {name:?}: expected a name that is known"),
        })
    }

    fn answers(&self, basis: &FindingSets<'_>) -> anyhow::Result<String> {
        let timings = Timings::kept()?;
        let rows = answers::rows(basis, &timings, Some(self.proof), &[])?;
        let line = |row: &AnswerRow| {
            let AnswerRow { question, answer, effect, .. } = row;
            let effect = effect.replace('|', "\\|");
            format!("| {question} | {answer} | {effect} |\n")
        };
        let lines: Vec<String> = rows.iter().map(line).collect();
        let other = answers::otherwise(basis)?;
        let codes = codes_table(&["best"])?;
        Ok(format!(
            "\n| question | answer | numbers (90 % interval) |\n\
             |---|---|---|\n{}\n{}\n\n**{}** {}\n\n{}",
            lines.concat(),
            other.unwrap_or_default(),
            codes.title,
            codes.reading,
            markdown(&codes)
        ))
    }
}

/// The answer to a question beyond the paper.
fn answer<'a>(findings: &'a Findings, id: &str) -> anyhow::Result<&'a str> {
    let own = findings.questions.iter().find(|question| question.id == id);
    let own = own.with_context(|| format!("findings without {id}"))?;
    Ok(&own.answer)
}

/// A list of the sentences.
fn listed(answer: &str) -> String {
    format!("\n- {}\n", answer.replace(". ", ".\n- "))
}

fn markdown(table: &PlainTable) -> String {
    let line = |cells: &Vec<String>| format!("| {} |\n", cells.join(" | "));
    let rule = vec!["---".into(); table.header.len()];
    let lines = [&table.header, &rule].into_iter().chain(&table.rows);
    lines.map(line).collect()
}
