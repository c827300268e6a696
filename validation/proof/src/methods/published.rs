//! Published laws on the embedded suites, beside what was kept of them on the
//! recorded ones.

use anyhow::Result;
use rocking::accelerogram::Accelerogram;

use super::cells::Csv;
use super::method::{Context, Reply};
use crate::published::{PublishedLaw, statistics};

/// Statistics of the recorded suites, which are not in the project.
const RECORDED: Csv = Csv::new("comparison/published.csv");

/// The statistics of a law that the case bounds: of the embedded suites,
/// ordinary and pulse-type, then of the recorded ones.
pub fn laws(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context; law: PublishedLaw }
    let mut found = Vec::new();
    for suite in [rocking_synthesis::ordinary()?, rocking_synthesis::pulse()?]
    {
        let first = suite.into_iter().map(|pair| pair.components[0].clone());
        let motions: Vec<Accelerogram> = first.collect();
        let all = statistics(law, &motions, context.wrong)?;
        found.extend(all.into_iter().map(|own| (own.quantity, own.value)));
    }
    for suite in ["ordinary", "pulse"] {
        for row in RECORDED.rows(suite)? {
            if row.text(1) == law.name() {
                found.push((row.text(2).to_owned(), row.number(5)?));
            }
        }
    }
    for (name, value) in found {
        if context.case.tolerance.bounds.contains_key(&name) {
            // What a law says of its ratio, where it says a number.
            answer.put(&name, [value], [1.0]);
        }
    }
    Ok(())
}
