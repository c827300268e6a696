//! Tables of claims: the limits of findings, and what is not judged.

use crate::quantity::rule_text;
use rocking_common::findings::{Claim, Findings, Kind};
use rocking_common::table::PlainTable;

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
