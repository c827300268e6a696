//! Two runs of the same records: how these moved.

use super::input::Results;
use super::moved::percent;
use crate::verdicts::first_arm;
use rocking_common::findings::{Measured, RecordName, Suite};
use rocking_common::paper::SuiteKind;
use rocking_study::estimates::median;

/// How many records both runs have, and how the same records moved.
pub fn notes(old: &Results, new: &Results) -> Vec<String> {
    let (Some(before), Some(after)) = (&old.findings, &new.findings) else {
        return Vec::new();
    };
    let mut notes = Vec::new();
    let mut same = Vec::new();
    for suite in &before.suites {
        let own = |s: &&Suite| s.kind == suite.kind;
        let Some(other) = after.suites.iter().find(own) else { continue };
        let (both, lost) = parted(suite, other);
        let (_, gained) = parted(other, suite);
        let kind = suite.kind;
        if lost.is_empty() && gained.is_empty() {
            same.push(format!("{} {kind}", both.len()));
        } else {
            notes.push(format!(
                "{} {kind} records are in both runs, {} only in the old one, \
                 {} only in the new one.",
                both.len(),
                named(&lost),
                named(&gained),
            ));
        }
        if kind == SuiteKind::Ordinary && first_arm(before) == first_arm(after)
        {
            notes.extend(paired(&both, old, new));
        }
    }
    if !same.is_empty() {
        notes.push(format!(
            "Both runs have the same records ({}): the sampling error of a \
             run is not the error of the difference.",
            same.join(", ")
        ));
    }
    notes
}

/// Records of a suite that the other has too, and those that it lacks; the
/// same name with other samples is another record.
fn parted<'a>(
    suite: &'a Suite,
    other: &Suite,
) -> (Vec<&'a str>, Vec<&'a str>) {
    let there = |r: &&RecordName| other.list.contains(r);
    let (both, rest): (Vec<_>, Vec<_>) = suite.list.iter().partition(there);
    let names = |list: Vec<&'a RecordName>| {
        list.into_iter().map(|r| r.name.as_str()).collect()
    };
    (names(both), names(rest))
}

/// A number of records, with their names where there are few.
fn named(records: &[&str]) -> String {
    match records.len() {
        n @ 1..=3 => format!("{n} ({})", records.join(", ")),
        n => n.to_string(),
    }
}

/// By how much the first overturning of the block of Figure 11 moved, record
/// by record: the median of the paired ratio with its exact interval.
fn paired(records: &[&str], old: &Results, new: &Results) -> Option<String> {
    let ratio = |name: &&str| {
        Some(new.overturnings.get(*name)? / old.overturnings.get(*name)?)
    };
    let ratios: Vec<f64> = records.iter().filter_map(ratio).collect();
    let Measured { value, interval } = median(&ratios);
    let (low, high) = interval?;
    let text = |ratio: f64| percent(ratio - 1.0);
    Some(format!(
        "Record by record, the first overturning of the block of Figure 11 \
         moves by {} in the median ({} to {}, exact 95 % interval, {} \
         ordinary records).",
        text(value),
        text(low),
        text(high),
        ratios.len()
    ))
}
