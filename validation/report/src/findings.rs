//! Tables of claims: the paper's own criteria, and what is not judged.

use crate::quantity::rule_text;
use rocking_common::findings::{Claim, Findings, Kind};
use rocking_common::table::PlainTable;

/// The paper's rules for its own sample, each with the statements that it
/// decides.
pub fn criteria(here: &Findings) -> PlainTable {
    let mut rows: Vec<Vec<String>> = Vec::new();
    for claim in &here.claims {
        for one in &claim.yardsticks {
            let rule = [one.words.clone(), rule_text(one)];
            match rows.iter_mut().find(|row| row[..2] == rule) {
                Some(row) => row[2] += &format!("; {}", claim.plain),
                None => {
                    let plain = std::slice::from_ref(&claim.plain);
                    rows.push([&rule, plain].concat());
                }
            }
        }
    }
    let header = ["number of the sample", "seen where it is", "statements"];
    PlainTable::new(
        "criteria-by-rule",
        "Acceptance criteria",
        "The paper's own criteria, in numbers. Most, and a sentence without a \
         quantifier: more than half; almost all, the vast majority: at least \
         90 %; few: below 10 %; curves coincide: within 10 %. The tolerance of each declared case stands \
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
