//! The differences between two sets of results, in engineering terms.
//!
//! [`compare`] walks over both as trees of JSON. A [`Difference`] lists the
//! changes, with each number against the smallest effect of interest.

mod change;
mod effect;
mod input;
mod number;
mod print;
#[cfg(test)]
mod tests;
mod walk;

use std::cmp::Reverse;

use anyhow::bail;

use input::NAMES;
use number::NumberChange;
use walk::Walk;

pub use change::{Change, Difference, Subject};
pub use input::ResultFiles;

/// Compares two sets of results.
///
/// # Errors
/// If no kind of file is on both sides.
pub fn compare(
    old: &ResultFiles,
    new: &ResultFiles,
) -> anyhow::Result<Difference> {
    let mut out = Difference::default();
    let mut common = false;
    for (name, trees) in NAMES.iter().zip(old.trees.iter().zip(&new.trees)) {
        match trees {
            (Some(a), Some(b)) => {
                common = true;
                let mut walk = Walk { roots: [a, b], out: &mut out };
                walk.compare(&[], [Some(a), Some(b)]);
            }
            (None, None) => {}
            (old, _) => {
                let side = if old.is_some() { "old" } else { "new" };
                out.notes.push(format!(
                    "Not compared: {name}, which only the {side} results have."
                ));
            }
        }
    }
    if !common {
        bail!(
            "{} and {} have nothing in common: expected findings on both \
             sides, or results of cases on both",
            old.path.display(),
            new.path.display()
        );
    }
    let other = out.records.values().filter(|r| !r.are_same()).count();
    out.identical = out.changes.is_empty() && other == 0;
    let relevant = out.changes.iter().filter(|change| change.relevant);
    out.relevant = relevant.count() + other;
    out.changes.sort_by_key(|change| {
        let weight = change.moved.as_ref().map(NumberChange::weight);
        Reverse((change.relevant, change.opposite, weight))
    });
    Ok(out)
}
