//! The findings of a study for the page: by theme, recorded suites first.

use crate::basis::Basis;
use crate::page::{Column, Shown};
use crate::quantity::rule_text;
use crate::verdicts;
use rocking_common::findings::{Claim, Findings, Kind, Theme};
use rocking_common::table::PlainTable;
use rocking_draw::figures::{Figure, Place};

/// Where the numbers of the recorded suites come from: name and words.
pub fn kept(recorded: &Findings) -> Vec<(String, String)> {
    let row = |suite: &rocking_common::findings::Suite| {
        let words = format!(
            "{} records, sha256 {}; kept results, not run here",
            suite.records, suite.sha256
        );
        (format!("Recorded, {}", suite.kind), words)
    };
    recorded.suites.iter().map(row).collect()
}

/// Columns of the page: those that answer first.
pub(crate) fn columns(basis: &Basis<'_>) -> Vec<Column> {
    let first = verdicts::first_arm(basis.here);
    let one = |(name, findings): (&'static str, &Findings)| Column {
        name,
        findings: findings.clone(),
        first,
        score: verdicts::score(findings),
    };
    basis.all().into_iter().map(one).collect()
}

/// The themes with what came out about each, and those of the figures that
/// belong to it.
pub(crate) fn themes<'a>(
    basis: &Basis<'_>,
    figures: &[&'a Figure],
) -> Vec<Shown<'a>> {
    let order = [
        Theme::SingleRecords,
        Theme::Statistics,
        Theme::Lognormality,
        Theme::Fragilities,
        Theme::Choices,
        Theme::Beyond,
    ];
    let shown = |theme| Shown {
        theme,
        paragraph: verdicts::by_theme(theme, basis),
        figures: placed(figures, Place::Opens(theme)),
        more: placed(figures, Place::Folded(theme)),
    };
    order.map(shown).into()
}

/// Those of the figures that belong there.
pub fn placed<'a>(figures: &[&'a Figure], place: Place) -> Vec<&'a Figure> {
    let there = |f: &&&Figure| f.heading.place == place;
    figures.iter().filter(there).copied().collect()
}

/// The limits of the findings and their reasons, each with what it is for.
pub fn criteria(here: &Findings) -> PlainTable {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for claim in here.claims.iter().filter(|c| c.kind == Kind::Finding) {
        let limit = [rule_text(claim), claim.reason.clone()];
        match rows.iter_mut().find(|row| row[..2] == limit) {
            Some(row) => row[2] += &format!("; {}", claim.plain),
            None => rows.push(
                [&limit[..], std::slice::from_ref(&claim.plain)].concat(),
            ),
        }
    }
    let header = ["limit", "why there", "what has to lie within it"];
    PlainTable::new(
        "criteria-by-limit",
        "Acceptance criteria",
        "Limits of the findings. The tolerance of each declared case stands \
         with the case in the annex.",
        &header,
        rows,
    )
}

/// What is true by definition or arithmetic, and what describes.
pub fn identities(here: &Findings) -> PlainTable {
    let row = |claim: &Claim| {
        let is = match claim.kind {
            Kind::Identity => format!("identity, case {}", claim.case),
            Kind::Description => "description, not judged".into(),
            Kind::Finding => return None,
        };
        let quote = format!("\u{201c}{}\u{201d}", claim.quote);
        Some(vec![quote, claim.section.to_string(), is])
    };
    let count = |kind| here.claims.iter().filter(|c| c.kind == kind).count();
    let header = ["the paper's words", "section", "what it is"];
    PlainTable::new(
        "identities",
        "Identities and descriptions",
        format!(
            "{} of these statements are true by definition or arithmetic: \
             they cannot come out either way. {} describe what could come \
             out either way, but name no measure: they are quoted and not \
             judged. None is counted among the results.",
            count(Kind::Identity),
            count(Kind::Description),
        ),
        &header,
        here.claims.iter().filter_map(row).collect(),
    )
}
