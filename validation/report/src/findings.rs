//! The findings of a study for the page: by theme, recorded suites first.

use crate::answers;
use crate::page::{Anchor, Column, Finding, Outcome, Theme as Shown};
use crate::quantity::{cell_text, rule_text, value_text};
use rocking_common::findings::{Claim, ClaimResult, Findings, Kind, Theme};
use rocking_common::paper::Arm;
use rocking_common::table::PlainTable;
use rocking_common::words::rounded_text;

/// Where the numbers of the recorded suites come from: name and words.
#[must_use]
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

/// Columns of the page: those of the recorded suites first, where the study
/// at hand is of the embedded ones.
#[must_use]
pub fn columns(here: &Findings, recorded: Option<&Findings>) -> Vec<Column> {
    let one = |name: &str, findings: &Findings| Column {
        name: name.into(),
        suites: findings
            .suites
            .iter()
            .map(|s| format!("{} {}", s.records, s.kind))
            .collect::<Vec<_>>()
            .join(" + "),
        counts: rocking_common::paper::Verdict::ALL
            .map(|verdict| (verdict, findings.count(verdict))),
    };
    match recorded {
        Some(recorded) => vec![
            one("recorded suites", recorded),
            one("embedded suites", here),
        ],
        None => vec![one("your suites", here)],
    }
}

/// The theme's name on the page.
#[must_use]
pub fn anchor(theme: Theme) -> &'static str {
    match theme {
        Theme::Choices => "theme-choices",
        Theme::SingleRecords => "theme-single-records",
        Theme::Statistics => "theme-statistics",
        Theme::Lognormality => "theme-lognormality",
        Theme::Fragilities => "theme-fragilities",
    }
}

/// The theme in which a figure of the paper stands.
#[must_use]
pub fn theme_of(number: u32) -> Theme {
    match number {
        2..=5 => Theme::SingleRecords,
        6..=10 => Theme::Statistics,
        11..=14 => Theme::Lognormality,
        15..=18 => Theme::Fragilities,
        _ => Theme::Choices,
    }
}

/// The findings by theme, with what came out in each column; `figures` are
/// names and numbers of those on the page.
#[must_use]
pub fn themes(
    here: &Findings,
    recorded: Option<&Findings>,
    figures: &[Anchor],
) -> Vec<Shown> {
    let sources: Vec<&Findings> = recorded.into_iter().chain([here]).collect();
    let first = answers::first_arm(here);
    let order = [
        Theme::SingleRecords,
        Theme::Statistics,
        Theme::Lognormality,
        Theme::Fragilities,
        Theme::Choices,
    ];
    order
        .into_iter()
        .map(|theme| Shown {
            id: anchor(theme),
            question: theme.question().into(),
            paragraph: answers::by_theme(theme, here, recorded),
            figures: Vec::new(),
            more: Vec::new(),
            findings: here
                .claims
                .iter()
                .filter(|c| c.theme == theme && c.kind == Kind::Finding)
                .map(|claim| finding(claim, &sources, figures, first))
                .collect(),
        })
        .collect()
}

/// What is true by definition or arithmetic, and what describes.
#[must_use]
pub fn identities(here: &Findings) -> PlainTable {
    let row = |claim: &Claim| {
        let is = match claim.kind {
            Kind::Identity => format!(
                "true by definition or arithmetic: declared case {}",
                claim.case
            ),
            Kind::Description => "a description: not judged".into(),
            Kind::Finding => return None,
        };
        let quote = format!("\u{201c}{}\u{201d}", claim.quote);
        Some(vec![quote, claim.section.to_string(), is])
    };
    let count = |kind| here.claims.iter().filter(|c| c.kind == kind).count();
    let header = ["the paper's words", "section", "what it is"];
    PlainTable {
        name: "identities".into(),
        title: "Identities and descriptions".into(),
        reading: format!(
            "{} of these statements are true by definition or arithmetic: \
             they cannot come out either way. {} describe what could come \
             out either way, but name no measure: they are quoted and not \
             judged. None is counted among the results.",
            count(Kind::Identity),
            count(Kind::Description),
        ),
        header: header.map(String::from).into(),
        rows: here.claims.iter().filter_map(row).collect(),
    }
}

fn finding(
    claim: &Claim,
    sources: &[&Findings],
    names: &[Anchor],
    first: Arm,
) -> Finding {
    let outcomes = |findings: &&Findings| -> Vec<Outcome> {
        let own = findings.claims.iter().find(|c| c.id == claim.id);
        own.map_or(Vec::new(), |own| {
            own.results.iter().map(|r| outcome(own, r, first)).collect()
        })
    };
    Finding {
        id: claim.id.clone(),
        quote: claim.quote.clone(),
        plain: claim.plain.clone(),
        source: format!("({})", claim.section),
        criterion: claim.criterion.clone(),
        rule: rule_text(claim),
        columns: sources.iter().map(outcomes).collect(),
        figures: shown_by(claim, names),
        measure: format!(
            "{} ({}). Why this limit: {}.",
            claim.measure, claim.blocks, claim.reason
        ),
        remark: claim.note.clone(),
    }
}

fn outcome(claim: &Claim, result: &ClaimResult, first: Arm) -> Outcome {
    let mut remarks = Vec::new();
    if let Some(cells) = &result.cells {
        remarks.push(format!(
            "{} of {} cells inside, {} outside{}",
            cells.inside,
            cells.deciding,
            cells.outside,
            if cells.too_few > 0 {
                format!(", {} with fewer than 30 records", cells.too_few)
            } else {
                String::new()
            }
        ));
    } else {
        remarks.push(result.at.clone());
    }
    if let Some(cell) = &result.deciding_cell {
        let value = cell_text(claim, cell.measured);
        remarks.push(format!("deciding: {}, {value}", cell.name));
    } else if result.cells.is_some() {
        remarks.push(format!("deciding: {}", result.at));
    }
    for detail in &result.details {
        let ends = detail.measured.interval.map_or(String::new(), |(a, b)| {
            format!(" ({} to {})", rounded_text(a), rounded_text(b))
        });
        let value = rounded_text(detail.measured.value);
        remarks.push(format!("{}: {value}{ends}", detail.name));
    }
    if let Some(interval) = result.interval {
        remarks.push(format!("95 % interval: {}", interval.words()));
    }
    if let Some(needed) = result.records_needed {
        remarks.push(format!("about {needed} records would decide"));
    }
    Outcome {
        suite: result.suite,
        place: result.place(),
        value: value_text(claim, result),
        by_criterion: result.by_criterion,
        by_equivalence: result.by_equivalence,
        first: result.arm.is_none_or(|arm| arm == first),
        remarks,
    }
}

/// The figures among `names` that a claim is about: those of its section.
fn shown_by(claim: &Claim, names: &[Anchor]) -> Vec<(String, String)> {
    let numbers = claim.section.figures().into_iter();
    let of = |number: u8| {
        names.iter().filter(move |name| name.0 == u32::from(number))
    };
    numbers.flat_map(of).map(|(_, name)| name.clone()).collect()
}
