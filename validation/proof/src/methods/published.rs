//! Published laws on the embedded suites, beside what was kept of them on the
//! recorded ones.

use anyhow::Result;
use rocking::accelerogram::Accelerogram;

use super::memo::Memo;
use super::method::{Context, Reply};
use crate::published::{PublishedLaw, PublishedResponses, recorded};

/// The responses to each embedded suite, which all cases read.
static RESPONSES: Memo<&str, PublishedResponses> = Memo::new();

const SUITES: [&str; 2] = ["ordinary", "pulse"];

fn respond(suite: &&str) -> Result<Vec<PublishedResponses>> {
    let pairs = match *suite {
        "pulse" => rocking_synthesis::pulse()?,
        _ => rocking_synthesis::ordinary()?,
    };
    let first = pairs.into_iter().map(|pair| pair.components[0].clone());
    let motions: Vec<Accelerogram> = first.collect();
    Ok(vec![PublishedResponses::of(&motions)?])
}

/// The statistics of a law that the case bounds: of the embedded suites,
/// ordinary and pulse-type, then of the recorded ones.
pub fn laws(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context; law: PublishedLaw }
    let mut found = Vec::new();
    for suite in SUITES {
        for responses in RESPONSES.get(suite, respond)?.iter() {
            found.extend(responses.statistics(law, context.wrong)?);
        }
    }
    for suite in SUITES {
        found.extend(recorded(law, suite)?);
    }
    for value in found {
        let name = value.quantity.as_str();
        if context.case.tolerance.bounds.contains_key(name) {
            // What a law says of its ratio, where it says a number.
            answer.put(name, [value.value], [1.0]);
        }
    }
    Ok(())
}
