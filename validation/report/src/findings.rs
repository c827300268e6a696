//! The table of claims that are not judged.

use rocking_common::findings::{Claim, Findings, Kind};
use rocking_common::table::PlainTable;

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
            "{} of these statements are true by definition or arithmetic. {} \
             could be true or false, but name no measure: they are quoted and \
             not judged. None is counted among the results.",
            count(Kind::Identity),
            count(Kind::Description),
        ),
        &header,
        here.claims.iter().filter_map(row).collect(),
    )
}
