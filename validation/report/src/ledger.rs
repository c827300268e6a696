//! The ledger of evidence: what was required, and what proves it.

use std::collections::BTreeSet;

use anyhow::{Context as _, bail};
use serde::Deserialize;

use rocking_common::findings::{Claim, Seen};
use rocking_common::table::PlainTable;
use rocking_draw::figures::Figure;
use rocking_proof::verdict::snapshot;

/// The requirements, embedded.
const REQUIREMENTS: &str = include_str!("../requirements.toml");

/// Their file.
const PLACE: &str = "requirements.toml";

/// Who requires something.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// Who asked for the implementation.
    User,
    /// The paper.
    Paper,
    /// This project.
    Ours,
}

/// One requirement and where its evidence is.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Unique name.
    pub id: String,
    /// Who requires it.
    pub source: Origin,
    /// Where it stands.
    pub place: String,
    /// What is required.
    pub text: String,
    /// Ids of declared cases; one `*` stands for anything.
    #[serde(default)]
    pub cases: Vec<String>,
    /// Names of claims.
    #[serde(default)]
    pub findings: Vec<String>,
    /// Functions of the gate: `file::function`.
    #[serde(default)]
    pub tests: Vec<String>,
    /// Numbers of the first and the last of the figures that the run draws
    /// and writes with their numbers.
    pub figures: Option<(u32, u32)>,
    /// What the evidence leaves open; may be empty.
    #[serde(default)]
    pub gap: String,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RequirementFile {
    requirement: Vec<Requirement>,
}

/// The requirements, in the order of the file.
///
/// # Errors
/// For unknown keys, missing fields and duplicate names.
pub fn requirements() -> anyhow::Result<Vec<Requirement>> {
    parse(REQUIREMENTS)
}

fn parse(text: &str) -> anyhow::Result<Vec<Requirement>> {
    let file: RequirementFile = toml::from_str(text).context(PLACE)?;
    let mut ids = BTreeSet::new();
    for requirement in &file.requirement {
        if !ids.insert(requirement.id.as_str()) {
            let id = &requirement.id;
            bail!("{PLACE}: two requirements are named `{id}`");
        }
    }
    Ok(file.requirement)
}

/// How a requirement stands.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Standing {
    /// Number of cases that passed.
    pub passed: usize,
    /// Cases that did not.
    pub failed: Vec<String>,
    /// Whether cases are named whose results are not there.
    pub not_run: bool,
    /// Patterns and names that no executed evidence fits.
    pub missing: Vec<String>,
    /// Whether anything at all is named as evidence.
    pub named: bool,
}

impl Standing {
    /// Whether all evidence named was executed, and the cases passed.
    pub fn is_met(&self) -> bool {
        self.named
            && !self.not_run
            && self.failed.is_empty()
            && self.missing.is_empty()
    }
}

impl Requirement {
    /// Whether only tests prove it, whose results are in no file.
    pub fn is_tests_alone(&self) -> bool {
        self.cases.is_empty()
            && self.findings.is_empty()
            && self.figures.is_none()
            && !self.tests.is_empty()
    }

    /// How it stands, given the results of the declared cases, if there are
    /// any, and whether a claim was measured, a test is part of the gate, a
    /// figure was drawn.
    pub fn standing(
        &self,
        results: Option<&snapshot::Results>,
        measured: &dyn Fn(&str) -> bool,
        is_test: &dyn Fn(&str) -> bool,
        drawn: &dyn Fn(u32) -> bool,
    ) -> Standing {
        let named = [&self.cases, &self.findings, &self.tests];
        let mut out = Standing {
            named: named.iter().any(|list| !list.is_empty())
                || self.figures.is_some(),
            not_run: results.is_none() && !self.cases.is_empty(),
            ..Standing::default()
        };
        let mut met = BTreeSet::new();
        for pattern in &self.cases {
            let Some(results) = results else { break };
            let mut fits = false;
            for (id, result) in results.iter().filter(|r| fit(pattern, r.0)) {
                fits = true;
                if !met.insert(id) {
                    continue;
                }
                if result.passed() {
                    out.passed += 1;
                } else {
                    out.failed.push(id.clone());
                }
            }
            if !fits {
                out.missing.push(pattern.clone());
            }
        }
        let missing = |list: &[String], there: &dyn Fn(&str) -> bool| {
            let gone = list.iter().filter(|name| !there(name));
            gone.cloned().collect::<Vec<String>>()
        };
        out.missing.extend(missing(&self.findings, measured));
        out.missing.extend(missing(&self.tests, is_test));
        let figures = self.figures.into_iter().flat_map(|(a, b)| a..=b);
        let gone = figures.filter(|number| !drawn(*number));
        out.missing.extend(gone.map(|number| format!("Figure {number}")));
        out
    }
}

/// Whether an id fits a pattern with at most one `*`.
fn fit(pattern: &str, id: &str) -> bool {
    match pattern.split_once('*') {
        None => pattern == id,
        Some((before, after)) => {
            id.len() >= before.len() + after.len()
                && id.starts_with(before)
                && id.ends_with(after)
        }
    }
}

/// The ledger for the page: what was required, and what proves it; `figures`
/// are those that the run drew.
///
/// # Errors
/// Where the requirements cannot be read.
pub fn table(
    results: Option<&snapshot::Results>,
    claims: &[Claim],
    figures: &[Figure],
) -> anyhow::Result<PlainTable> {
    let measured = |name: &str| claims.iter().any(|c| c.id == name);
    let drawn = |number: u32| {
        let is = |f: &Figure| f.heading.number == Some(number);
        figures.iter().any(|f| is(f) && !f.csv().is_empty())
    };
    let requirements = requirements()?;
    let mut rows = Vec::with_capacity(requirements.len());
    let (mut met, mut by_tests) = (0, 0);
    for r in &requirements {
        let standing = r.standing(results, &measured, &|_| true, &drawn);
        let tests_alone = r.is_tests_alone();
        met += usize::from(standing.is_met() && !tests_alone);
        by_tests += usize::from(tests_alone);
        let source = match r.source {
            Origin::User => "asked for",
            Origin::Paper => "paper",
            Origin::Ours => "our own",
        };
        rows.push(vec![
            r.text.clone(),
            format!("{source}, {}", r.place),
            evidence(r, &standing, claims),
            state(r, &standing, claims),
            r.gap.clone(),
        ]);
    }
    let header =
        ["requirement", "source", "evidence", "state", "what it leaves open"];
    Ok(PlainTable::new(
        "ledger",
        "What was required, and what proves it",
        format!(
            "{met} of {} requirements have executed evidence and no failed \
             case; {by_tests} more rest on tests of the gate alone, whose \
             results are not in these files. A finding is evidence that the \
             claim was measured, seen or not.",
            rows.len()
        ),
        &header,
        rows,
    ))
}

fn evidence(r: &Requirement, standing: &Standing, claims: &[Claim]) -> String {
    let mut parts = Vec::new();
    if standing.not_run {
        parts.push(format!("cases, not run here ({})", r.cases.join(", ")));
    } else if !r.cases.is_empty() {
        let n = standing.passed;
        let cases = if n == 1 { "case" } else { "cases" };
        parts.push(format!("{n} {cases} passed ({})", r.cases.join(", ")));
    }
    let found: Vec<String> = claims
        .iter()
        .filter(|claim| r.findings.contains(&claim.id))
        .flat_map(|claim| {
            claim.results.iter().map(|result| {
                let (id, place) = (&claim.id, result.place());
                format!("{id} ({place}) seen: {}", result.seen)
            })
        })
        .collect();
    if !found.is_empty() {
        parts.push(format!("findings: {}", found.join(", ")));
    }
    if let Some((first, last)) = r.figures {
        parts.push(format!(
            "figures {first} to {last}, drawn in this run from its numbers, \
             which stand beside each"
        ));
    }
    if !r.tests.is_empty() {
        // Names of tests are sentences; words wrap, paths don't.
        let words = |test: &String| {
            let (file, name) = test.split_once("::").unwrap_or(("", test));
            format!("{} ({file})", name.replace('_', " "))
        };
        let tests: Vec<String> = r.tests.iter().map(words).collect();
        parts.push(format!("tests: {}", tests.join(", ")));
    }
    parts.join("; ")
}

/// How a requirement stands, in words. A claim that was measured is not one
/// that is seen: its words are counted.
fn state(r: &Requirement, standing: &Standing, claims: &[Claim]) -> String {
    if !standing.failed.is_empty() {
        return format!("✗ failed: {}", standing.failed.join(", "));
    }
    if !standing.missing.is_empty() {
        return format!("✗ no evidence: {}", standing.missing.join(", "));
    }
    if standing.not_run {
        return "not run here".into();
    }
    if !standing.named {
        return "✗ no evidence named".into();
    }
    if r.is_tests_alone() {
        return "in the gate alone".into();
    }
    let mut parts = Vec::new();
    if standing.passed > 0 {
        parts.push("✓ cases passed".to_owned());
    }
    if r.figures.is_some() {
        parts.push("✓ drawn".into());
    }
    if !r.findings.is_empty() {
        let own = claims.iter().filter(|c| r.findings.contains(&c.id));
        let words: Vec<Seen> = own
            .flat_map(|claim| &claim.results)
            .map(|result| result.seen)
            .collect();
        let counted = Seen::ALL.into_iter().filter_map(|word| {
            let n = words.iter().filter(|own| **own == word).count();
            (n > 0).then(|| format!("{n} {word}"))
        });
        let counted: Vec<String> = counted.collect();
        parts.push(match counted.as_slice() {
            [] => "stated, not measured".into(),
            some => format!("measured, seen: {}", some.join(", ")),
        });
    }
    parts.join("; ")
}

#[cfg(test)]
mod tests;
