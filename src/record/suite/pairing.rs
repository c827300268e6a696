//! Which two records are the components of one motion.

use std::collections::BTreeMap;

use super::{SuiteError, SuiteMember};
use crate::record::stem;

/// Orientations that end a file name, horizontal ones.
const NAMED: [&str; 16] = [
    "LN", "TR", "NS", "SN", "EW", "WE", "H1", "H2", "HN", "HE", "N", "S", "E",
    "W", "L", "T",
];

/// A file's stem without the orientation at its end.
///
/// After a separator any of the names or one to three digits is one
/// (`A_E`, `A-90`, `A--L`); without a separator three digits or two letters
/// after a digit (`HEC090`, `65006EW`).
pub(super) fn pair_key(stem: &str) -> Option<&str> {
    let separators = ['-', '_', '.'];
    let key = match stem.rsplit_once(separators) {
        Some((key, end)) if is_orientation(end) => key,
        _ => glued(stem)?,
    };
    let key = key.trim_end_matches(separators);
    (!key.is_empty()).then_some(key)
}

fn is_orientation(end: &str) -> bool {
    let digits = (1..=3).contains(&end.len())
        && end.bytes().all(|b| b.is_ascii_digit());
    let degrees = digits && end.parse::<u16>().is_ok_and(|d| d <= 360);
    degrees || NAMED.iter().any(|name| end.eq_ignore_ascii_case(name))
}

fn glued(stem: &str) -> Option<&str> {
    let split = |n: usize| {
        let at = stem.len().checked_sub(n)?;
        Some((stem.get(..at)?, stem.get(at..)?))
    };
    let (key, end) = split(3)?;
    if end.bytes().all(|b| b.is_ascii_digit()) && is_orientation(end) {
        return Some(key);
    }
    let (key, end) = split(2)?;
    let letters = end.bytes().all(|b| b.is_ascii_alphabetic());
    let after_digit = key.ends_with(|c: char| c.is_ascii_digit());
    (letters && after_digit && is_orientation(end)).then_some(key)
}

/// Gives the two records that share a name but for its orientation that
/// name as their pair; any other number of records stays unpaired.
pub(super) fn pair_by_name(members: &mut [SuiteMember]) {
    let key = |m: &SuiteMember| pair_key(stem(&m.file)).map(str::to_owned);
    let mut counts: BTreeMap<String, usize> = BTreeMap::new();
    for name in members.iter().filter_map(key) {
        *counts.entry(name).or_default() += 1;
    }
    for member in members {
        member.pair = key(member).filter(|name| counts[name] == 2);
    }
}

/// Marks, in each pair, the component whose file name sorts first; a record
/// without a partner is marked too.
pub(super) fn mark_first(members: &mut [SuiteMember]) {
    let mut first: BTreeMap<String, String> = BTreeMap::new();
    for member in members.iter() {
        let Some(pair) = &member.pair else { continue };
        let file = first.entry(pair.clone()).or_insert(member.file.clone());
        if member.file < *file {
            file.clone_from(&member.file);
        }
    }
    for member in members {
        member.study_component = member
            .pair
            .as_ref()
            .is_none_or(|pair| first.get(pair) == Some(&member.file));
    }
}

/// Refuses a pair of more than two, and one without exactly one study
/// component.
pub(super) fn check_pairs(
    path: &str,
    members: &[SuiteMember],
) -> Result<(), SuiteError> {
    let mut pairs: BTreeMap<&str, (usize, usize)> = BTreeMap::new();
    for member in members {
        let Some(pair) = &member.pair else { continue };
        let (components, study) = pairs.entry(pair).or_default();
        *components += 1;
        *study += usize::from(member.study_component);
    }
    for (pair, (components, study)) in pairs {
        if components > 2 || study != 1 {
            let (path, pair) = (path.to_owned(), pair.to_owned());
            return Err(SuiteError::Pair { path, pair, components, study });
        }
    }
    Ok(())
}

/// Refuses two records of one name.
pub(super) fn check_names(
    path: &str,
    members: &[SuiteMember],
) -> Result<(), SuiteError> {
    let mut names: Vec<&str> =
        members.iter().map(|m| m.accelerogram.name()).collect();
    names.sort_unstable();
    match names.windows(2).find(|pair| pair[0] == pair[1]) {
        None => Ok(()),
        Some(pair) => Err(SuiteError::SameName {
            path: path.to_owned(),
            name: pair[0].to_owned(),
        }),
    }
}
