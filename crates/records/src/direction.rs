//! Direction of a sensor: by the header of a format, or else by the end of the
//! file's name.
//!
//! The row of a format says if a bare number is an azimuth; in other formats
//! it is a code (KiK-net) or the number of a channel or a file. A reader may
//! give the direction directly.

use super::text;

/// Where a sensor points.
///
/// ```
/// use rocking_records::{Direction, ReadOptions};
/// use rocking::units::AccelerationUnit;
/// let options = ReadOptions {
///     dt_s: Some(0.01),
///     unit: Some(AccelerationUnit::Gravity),
///     ..ReadOptions::default()
/// };
/// let direction = |file: &str| {
///     rocking_records::read(file, b"0.0\n0.1\n-0.3\n", &options)
///         .map(|record| record.direction)
/// };
/// assert_eq!(direction("hall-NS.txt")?, Direction::Horizontal);
/// assert_eq!(direction("hall-UD.txt")?, Direction::Vertical);
/// assert_eq!(direction("hall.txt")?, Direction::Unknown);
/// # Ok::<(), rocking_records::RecordError>(())
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// A horizontal component.
    Horizontal,
    /// A vertical component.
    Vertical,
    /// Neither the header nor the file's name states it.
    #[default]
    Unknown,
}

/// Words for a horizontal component, hyphens left out.
const HORIZONTAL: [&str; 23] = [
    "LN", "TR", "NS", "SN", "EW", "WE", "H1", "H2", "HN", "HE", "N", "S", "E",
    "W", "L", "T", "FN", "FP", "NORTH", "EAST", "RADIAL", "LONG", "TRAN",
];

/// Words for a vertical component, hyphens left out.
const VERTICAL: [&str; 10] =
    ["UP", "DWN", "DN", "DOWN", "UD", "V", "VER", "VERT", "Z", "U"];

const SEPARATORS: [char; 3] = ['-', '_', '.'];

impl Direction {
    /// This direction or, if it is unknown, the other.
    pub(super) fn or(self, other: impl FnOnce() -> Self) -> Self {
        if self == Self::Unknown { other() } else { self }
    }

    /// The direction by one word; unknown for a number.
    pub(super) fn of_word(word: &str) -> Self {
        let plain = word.replace('-', "");
        let is = |name: &&str| plain.eq_ignore_ascii_case(name);
        let code = is_code(word);
        if VERTICAL.iter().any(is) || (code && word.ends_with('Z')) {
            Self::Vertical
        } else if code || HORIZONTAL.iter().any(is) || is_bearing(word) {
            Self::Horizontal
        } else {
            Self::Unknown
        }
    }

    /// The direction by the last word of a header's text that names one;
    /// numbers from 0 to 360 are azimuths (degrees) in some formats.
    pub(super) fn of_label(label: &str, azimuths: bool) -> Self {
        if text::contains(label, "vert") {
            return Self::Vertical;
        }
        let words = label.split([' ', ',', ':']).rev();
        let of = |word: &str| match word.trim_end_matches("deg") {
            number if azimuths && is_azimuth(number) => Self::Horizontal,
            _ => Self::of_word(word),
        };
        words.map(of).find(|d| *d != Self::Unknown).unwrap_or_default()
    }

    /// The direction by the name of a file without its ending. PEER names AT2
    /// files by azimuth (`azimuths`); in other names the numbers only count.
    pub(super) fn of_name(name: &str, azimuths: bool) -> Self {
        let end = name.rsplit_once(SEPARATORS).map(|(_, end)| end);
        let by_end = |end: &str| match end.trim_end_matches(['1', '2']) {
            // KiK-net's two sensors.
            axis @ ("NS" | "EW" | "UD") => Self::of_word(axis),
            _ => Self::of_word(end),
        };
        let by_azimuth = |number: &str| match azimuths && is_azimuth(number) {
            true => Self::Horizontal,
            false => Self::Unknown,
        };
        let code = || name.split('.').find(|part| is_code(part));
        end.map_or(Self::Unknown, by_end)
            .or(|| code().map_or(Self::Unknown, Self::of_word))
            .or(|| match glued(name) {
                Some((_, end)) => Self::of_word(end).or(|| by_azimuth(end)),
                None => Self::Unknown,
            })
            .or(|| end.map_or(Self::Unknown, by_azimuth))
    }
}

/// Whether a text is a code of band, instrument and component, as FDSN
/// networks write it.
pub(super) fn is_code(part: &str) -> bool {
    matches!(
        part.as_bytes(),
        [
            b'B' | b'C' | b'E' | b'H' | b'S',
            b'G' | b'H' | b'L' | b'N',
            b'E' | b'N' | b'Z' | b'1' | b'2' | b'3'
        ]
    )
}

/// A quadrant bearing such as `N08W`.
fn is_bearing(word: &str) -> bool {
    matches!(
        word.as_bytes(),
        [b'N' | b'S', degrees @ .., b'E' | b'W']
            if (1..=2).contains(&degrees.len())
                && degrees.iter().all(u8::is_ascii_digit)
    )
}

/// One to three digits from 0 to 360.
pub(super) fn is_azimuth(word: &str) -> bool {
    (1..=3).contains(&word.len())
        && word.bytes().all(|b| b.is_ascii_digit())
        && word.parse::<u16>().is_ok_and(|degrees| degrees <= 360)
}

/// A name without its orientation, and the orientation, if no separator is
/// between them: three digits, or two letters after a digit.
pub(super) fn glued(name: &str) -> Option<(&str, &str)> {
    let split = |n: usize| {
        let at = name.len().checked_sub(n)?;
        Some((name.get(..at)?, name.get(at..)?))
    };
    let (key, end) = split(3)?;
    if is_azimuth(end) {
        return Some((key, end));
    }
    let (key, end) = split(2)?;
    let known = end.bytes().all(|b| b.is_ascii_alphabetic())
        && Direction::of_word(end) != Direction::Unknown;
    let after_digit = key.ends_with(|c: char| c.is_ascii_digit());
    (known && after_digit).then_some((key, end))
}

#[cfg(test)]
mod tests;
