//! Pairs of records that are the components of one motion.

use std::collections::BTreeMap;

use super::error::Result;
use super::{SuiteError, SuiteMember};
use crate::direction::{Direction, glued, is_azimuth, is_code};
use crate::quality::MemberMotion;
use rocking::accelerogram::suite_names;

const SEPARATORS: [char; 4] = ['-', '_', '.', ':'];

/// A record's name without its orientation.
///
/// The orientation after a separator is a word for a horizontal component, or
/// one to three digits (`A_E`, `A-90`, `A--L`). Without a separator it is
/// three digits, or two letters after a digit (`HEC090`, `65006EW`). KiK-net's
/// `.EW2` keeps its digit, an instrument code (`HNE`) between dots keeps its
/// first two letters, and channels of one file share the file's name.
pub(super) fn pair_key(name: &str) -> Option<String> {
    if let Some((file, _)) = name.split_once(':') {
        return Some(file.to_owned());
    }
    if let Some(code) = name.split('.').find(|part| is_code(part)) {
        return Some(name.replacen(code, &code[..2], 1));
    }
    let end = name.rsplit('.').next().unwrap_or("");
    if let Some(depth) = end.strip_prefix("EW").or(end.strip_prefix("NS"))
        && matches!(depth, "1" | "2")
    {
        return Some(format!("{}{depth}", &name[..name.len() - 3]));
    }
    let key = match name.rsplit_once(SEPARATORS) {
        Some((key, end)) if is_orientation(end) => key,
        _ => glued(name).filter(|(_, end)| is_orientation(end))?.0,
    };
    let key = key.trim_end_matches(SEPARATORS);
    (!key.is_empty()).then(|| key.to_owned())
}

/// Whether the end of a name is an orientation: a word for a horizontal
/// component, or a number.
fn is_orientation(end: &str) -> bool {
    is_azimuth(end) || Direction::of_word(end) == Direction::Horizontal
}

/// Pairs two records that share event and station or, without these, their
/// name except for the orientation. Any other number of records stays
/// unpaired.
pub(super) fn pair_by_name<M: MemberMotion>(members: &mut [SuiteMember<M>]) {
    let key = |m: &SuiteMember<M>| {
        m.site.clone().or_else(|| pair_key(m.accelerogram.name()))
    };
    let keys: Vec<_> = members.iter().map(key).collect();
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    for name in keys.iter().flatten() {
        *counts.entry(name).or_default() += 1;
    }
    for (member, key) in members.iter_mut().zip(&keys) {
        let pair = key.as_ref().filter(|name| counts[name.as_str()] == 2);
        member.pair = pair.cloned();
    }
}

/// Marks the component of each pair whose name sorts first, and every record
/// without a partner.
pub(super) fn mark_first<M: MemberMotion>(members: &mut [SuiteMember<M>]) {
    let mut first: BTreeMap<Option<String>, String> = BTreeMap::new();
    for member in members.iter() {
        let name = member.accelerogram.name();
        let least = first.entry(member.pair.clone()).or_insert(name.into());
        if name < least.as_str() {
            name.clone_into(least);
        }
    }
    for member in members {
        let is_first = first[&member.pair] == member.accelerogram.name();
        member.study_component = member.pair.is_none() || is_first;
    }
}

/// Refuses a pair of more than two components, or without exactly one study
/// component.
pub(super) fn check_pairs<M>(
    path: &str,
    members: &[SuiteMember<M>],
) -> Result<()> {
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

/// Refuses records with names that results could not distinguish.
pub(super) fn check_names<M: MemberMotion>(
    path: &str,
    members: &[SuiteMember<M>],
) -> Result<()> {
    let names: Vec<&str> =
        members.iter().map(|m| m.accelerogram.name()).collect();
    let path = path.to_owned();
    let refuse = |source| SuiteError::Names { path, source };
    suite_names(&names).map(|_| ()).map_err(refuse)
}
