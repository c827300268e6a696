//! The ledger of evidence: each requirement, and what proves it.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, bail};
use serde::Deserialize;

use rocking_common::findings::{Claim, ClaimResult, Seen};
use rocking_common::table::PlainTable;
use rocking_draw::figures::Figure;
use rocking_proof::verdict::snapshot;

/// The requirements, embedded.
const REQUIREMENTS: &str = include_str!("../requirements.toml");

/// Their file.
const PLACE: &str = "requirements.toml";

/// The source of a requirement.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Origin {
    /// The customer of the implementation.
    User,
    /// The paper.
    Paper,
    /// This project.
    Ours,
}

/// A requirement and the places of its evidence.
#[derive(Clone, Debug, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Requirement {
    /// Unique name.
    pub id: String,
    /// Its source.
    pub source: Origin,
    /// The place in the source.
    pub place: String,
    /// What is required.
    pub text: String,
    /// Ids of reference cases; one `*` matches any text.
    #[serde(default)]
    pub cases: Vec<String>,
    /// Names of claims.
    #[serde(default)]
    pub findings: Vec<String>,
    /// Functions of the gate: `file::function`.
    #[serde(default)]
    pub tests: Vec<String>,
    /// Numbers of the first and the last figure that the run draws and whose
    /// data it writes.
    pub figures: Option<(u32, u32)>,
    /// What the evidence does not cover; may be empty.
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

/// The evidence for a requirement, as executed.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Standing {
    /// Number of cases that passed.
    pub passed: usize,
    /// Cases that did not pass.
    pub failed: Vec<String>,
    /// Whether cases are named but there are no results of cases.
    pub not_run: bool,
    /// Patterns and names without executed evidence.
    pub missing: Vec<String>,
}

impl Standing {
    /// Whether all evidence was executed and every case passed.
    pub fn is_met(&self) -> bool {
        !self.not_run && self.failed.is_empty() && self.missing.is_empty()
    }
}

impl Requirement {
    /// Whether any evidence is named.
    pub fn is_named(&self) -> bool {
        self.is_beyond_tests() || !self.tests.is_empty()
    }

    /// Whether evidence other than tests is named; the results of tests are in
    /// no file.
    fn is_beyond_tests(&self) -> bool {
        let lists = [&self.cases, &self.findings];
        self.figures.is_some() || lists.iter().any(|list| !list.is_empty())
    }

    /// The evidence, given the results of the reference cases, if there are
    /// any, and whether a claim was measured, a test is part of the gate, a
    /// figure was drawn.
    pub fn standing(
        &self,
        results: Option<&snapshot::Results>,
        measured: &dyn Fn(&str) -> bool,
        is_test: &dyn Fn(&str) -> bool,
        drawn: &dyn Fn(u32) -> bool,
    ) -> Standing {
        let mut missing = Vec::new();
        let mut met = BTreeMap::new();
        for pattern in results.iter().flat_map(|_| &self.cases) {
            let all = results.into_iter().flatten();
            let own: Vec<_> = all.filter(|(id, _)| fit(pattern, id)).collect();
            if own.is_empty() {
                missing.push(pattern.clone());
            }
            met.extend(own);
        }
        let findings = self.findings.iter().filter(|name| !measured(name));
        let tests = self.tests.iter().filter(|name| !is_test(name));
        missing.extend(findings.chain(tests).cloned());
        let figures = self.figures.into_iter().flat_map(|(a, b)| a..=b);
        let gone = figures.filter(|number| !drawn(*number));
        missing.extend(gone.map(|number| format!("Figure {number}")));
        let failed = met.iter().filter(|(_, result)| !result.passed());
        let failed: Vec<String> =
            failed.map(|(id, _)| (*id).clone()).collect();
        Standing {
            passed: met.len() - failed.len(),
            failed,
            not_run: results.is_none() && !self.cases.is_empty(),
            missing,
        }
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

/// The ledger for the page; `figures` are those that the run drew.
///
/// # Errors
/// If the requirements cannot be read.
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
    let (mut met, mut by_tests) = (0, 0);
    let row = |r: &Requirement| {
        let standing = r.standing(results, &measured, &|_| true, &drawn);
        match r.is_beyond_tests() {
            true => met += usize::from(standing.is_met()),
            false => by_tests += usize::from(r.is_named()),
        }
        let source = match r.source {
            Origin::User => "requested",
            Origin::Paper => "paper",
            Origin::Ours => "our own",
        };
        vec![
            r.text.clone(),
            format!("{source}, {}", r.place),
            evidence(r, &standing, claims),
            state(r, &standing, claims),
            r.gap.clone(),
        ]
    };
    let rows: Vec<_> = requirements()?.iter().map(row).collect();
    let header =
        ["requirement", "source", "evidence", "state", "what it leaves open"];
    Ok(PlainTable::new(
        "ledger",
        "What was required, and what proves it",
        format!(
            "{met} of {} requirements have executed evidence and no failed \
             case. {by_tests} more rest only on tests of the gate, whose \
             results are not in these files. A finding is evidence that the \
             claim was measured, whether or not it is seen.",
            rows.len()
        ),
        &header,
        rows,
    ))
}

/// The results on the claims of a requirement.
fn found<'a>(
    r: &'a Requirement,
    claims: &'a [Claim],
) -> impl Iterator<Item = (&'a str, &'a ClaimResult)> {
    let own = claims.iter().filter(|claim| r.findings.contains(&claim.id));
    own.flat_map(|claim| claim.results.iter().map(|one| (&*claim.id, one)))
}

fn evidence(r: &Requirement, standing: &Standing, claims: &[Claim]) -> String {
    let mut parts = Vec::new();
    let cases = r.cases.join(", ");
    if standing.not_run {
        parts.push(format!("cases, not run here ({cases})"));
    } else if !r.cases.is_empty() {
        let n = standing.passed;
        let noun = if n == 1 { "case" } else { "cases" };
        parts.push(format!("{n} {noun} passed ({cases})"));
    }
    let found: Vec<String> = found(r, claims)
        .map(|(id, one)| format!("{id} ({}) seen: {}", one.place(), one.seen))
        .collect();
    if !found.is_empty() {
        parts.push(format!("findings: {}", found.join(", ")));
    }
    parts.extend(r.figures.map(|(first, last)| {
        format!(
            "figures {first} to {last}, drawn in this run from numbers that \
             are listed beside each"
        )
    }));
    // Names of tests are sentences; words wrap, paths don't.
    let words = |test: &String| {
        let (file, name) = test.split_once("::").unwrap_or(("", test));
        format!("{} ({file})", name.replace('_', " "))
    };
    let tests: Vec<String> = r.tests.iter().map(words).collect();
    if !tests.is_empty() {
        parts.push(format!("tests: {}", tests.join(", ")));
    }
    parts.join("; ")
}

/// The state of a requirement in words. A claim that was measured need not be
/// seen: its words are counted.
fn state(r: &Requirement, standing: &Standing, claims: &[Claim]) -> String {
    for (names, words) in
        [(&standing.failed, "failed"), (&standing.missing, "no evidence")]
    {
        if !names.is_empty() {
            return format!("✗ {words}: {}", names.join(", "));
        }
    }
    match (standing.not_run, r.is_beyond_tests(), r.is_named()) {
        (true, ..) => return "not run here".into(),
        (_, true, _) => {}
        (_, _, true) => return "only in the gate".into(),
        _ => return "✗ no evidence named".into(),
    }
    let mut parts = Vec::new();
    if standing.passed > 0 {
        parts.push("✓ cases passed".to_owned());
    }
    if r.figures.is_some() {
        parts.push("✓ drawn".into());
    }
    if !r.findings.is_empty() {
        let counted = Seen::ALL.into_iter().filter_map(|word| {
            let own = found(r, claims).filter(|(_, one)| one.seen == word);
            let n = own.count();
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
