//! Which two records are the components of one motion.

use std::collections::BTreeMap;

use super::{SuiteError, SuiteMember};
use crate::record::text;

/// Orientations that end a file name, horizontal ones.
const NAMED: [&str; 16] = [
    "LN", "TR", "NS", "SN", "EW", "WE", "H1", "H2", "HN", "HE", "N", "S", "E",
    "W", "L", "T",
];

/// Names of vertical components.
const VERTICAL: [&str; 11] =
    ["UP", "DWN", "DN", "DOWN", "UD", "U-D", "UD1", "UD2", "V", "VER", "Z"];

const SEPARATORS: [char; 4] = ['-', '_', '.', ':'];

/// A record's name without its orientation.
///
/// After a separator any of the names or one to three digits is one
/// (`A_E`, `A-90`, `A--L`); without a separator three digits or two letters
/// after a digit (`HEC090`, `65006EW`). KiK-net's `.EW2` keeps its digit, an
/// instrument code (`HNE`) between dots its first two letters, and channels
/// of one file share the file's name.
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
        _ => glued(name)?,
    };
    let key = key.trim_end_matches(SEPARATORS);
    (!key.is_empty()).then(|| key.to_owned())
}

/// A code of band, instrument and component, as FDSN networks write it.
fn is_code(part: &str) -> bool {
    matches!(
        part.as_bytes(),
        [
            b'B' | b'E' | b'H' | b'S',
            b'G' | b'L' | b'N',
            b'E' | b'N' | b'Z' | b'1' | b'2' | b'3'
        ]
    )
}

/// Where a component points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Direction {
    Horizontal,
    Vertical,
    Unknown,
}

/// The direction that a word names, or a letter.
fn direction(word: &str) -> Direction {
    if VERTICAL.iter().any(|v| word.eq_ignore_ascii_case(v)) {
        return Direction::Vertical;
    }
    if is_code(word) {
        return match word.ends_with('Z') {
            true => Direction::Vertical,
            false => Direction::Horizontal,
        };
    }
    let word = word.trim_end_matches("deg").replace('-', "");
    match is_orientation(&word) || is_bearing(&word) {
        true => Direction::Horizontal,
        false => Direction::Unknown,
    }
}

/// A quadrant bearing such as `N08W`.
fn is_bearing(word: &str) -> bool {
    let bytes = word.as_bytes();
    let (Some((first, rest)), true) =
        (bytes.split_first(), (3..=4).contains(&bytes.len()))
    else {
        return false;
    };
    let (degrees, last) = rest.split_at(rest.len() - 1);
    b"NS".contains(first)
        && b"EW".contains(&last[0])
        && degrees.iter().all(u8::is_ascii_digit)
}

/// The direction by what the header calls the channel: its last word that
/// names one.
fn labelled(label: &str) -> Direction {
    if text::contains(label, "vert") {
        return Direction::Vertical;
    }
    let words = label.split([' ', ',', ':']).rev();
    let mut known = words.map(direction).filter(|d| *d != Direction::Unknown);
    known.next().unwrap_or(Direction::Unknown)
}

/// Whether a component is vertical by its header, or, where the header does
/// not tell, by the end of the record's name.
pub(super) fn is_vertical(label: Option<&str>, name: &str) -> bool {
    match labelled(label.unwrap_or("")) {
        Direction::Vertical => return true,
        Direction::Horizontal => return false,
        Direction::Unknown => {}
    }
    let vertical = |word: &str| direction(word) == Direction::Vertical;
    let end = name.rsplit(['-', '_', '.']).next().unwrap_or("");
    (end.len() < name.len() && vertical(end))
        || name.split('.').any(|part| is_code(part) && vertical(part))
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

/// Gives the two records that share event and station, or else a name but
/// for its orientation, that as their pair; any other number of records stays
/// unpaired.
pub(super) fn pair_by_name(members: &mut [SuiteMember]) {
    let key = |m: &SuiteMember| {
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

/// Marks, in each pair, the component whose name sorts first; a record
/// without a partner is marked too.
pub(super) fn mark_first(members: &mut [SuiteMember]) {
    let mut first: BTreeMap<String, String> = BTreeMap::new();
    for member in members.iter() {
        let Some(pair) = &member.pair else { continue };
        let name = member.accelerogram.name();
        let least = first.entry(pair.clone()).or_insert(name.to_owned());
        if name < least.as_str() {
            name.clone_into(least);
        }
    }
    for member in members {
        let name = member.accelerogram.name();
        member.study_component = member
            .pair
            .as_ref()
            .is_none_or(|pair| first.get(pair).is_some_and(|f| f == name));
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
