//! The text of a file as numbered lines, and the faults found in them.

use std::borrow::Cow;

use super::number;
use crate::error::{Fault, RecordError, Result};
use rocking::stop;
use rocking::units::AccelerationUnit;

/// Lines of one file. Faults are built here, so that each has its place.
pub(super) struct Text<'a> {
    pub(super) file: &'a str,
    pub(super) text: &'a str,
    /// Byte offset at which each line begins, and the end of the last line.
    /// A `&str` per line would cost 16 bytes for lines as short as 2.
    starts: Vec<u32>,
    /// Whether the text ends with the end of a line.
    pub(super) is_ended: bool,
}

/// Number of lines between two checks of `stop::point`.
const STOP_LINES: usize = 64;

/// Number of bytes that are searched at a time.
const BLOCK: usize = 1 << 12;

/// Bytes as text: UTF-16 if they begin with its mark, else UTF-8, else Latin-1
/// (station names). Bytes with control characters are not text.
pub(super) fn decode<'a>(file: &str, bytes: &'a [u8]) -> Result<Cow<'a, str>> {
    if let Some(text) = utf_16(file, bytes)? {
        let control = |c: char| c.is_ascii() && is_control(c as u8);
        if let Some(at) = text.find(control) {
            let (byte, offset) = (text.as_bytes()[at], 2 + 2 * at);
            return Err(Fault::NotText { byte, offset }.whole(file));
        }
        return Ok(Cow::Owned(text));
    }
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // Old systems end a text file with one or more Ctrl-Z.
    let last = bytes.iter().rposition(|b| *b != 0x1a);
    let bytes = &bytes[..last.map_or(0, |at| at + 1)];
    if any(bytes, is_control)
        && let Some(offset) = bytes.iter().position(|&b| is_control(b))
    {
        if looks_like_utf_16(bytes) {
            return Err(Fault::Utf16("no byte order mark").whole(file));
        }
        let fault = Fault::NotText { byte: bytes[offset], offset };
        return Err(fault.whole(file));
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(latin_1(bytes)),
    })
}

/// Whether `is` is true for any byte; in blocks, which are fast.
pub(super) fn any(bytes: &[u8], is: impl Fn(u8) -> bool) -> bool {
    let in_block =
        |block: &[u8]| block.iter().fold(false, |any, b| any | is(*b));
    bytes.chunks(BLOCK).any(in_block)
}

/// A control character that no text file has.
fn is_control(byte: u8) -> bool {
    byte < 0x20 && !matches!(byte, b'\t' | b'\n' | b'\r' | 0x0c)
}

/// A text in UTF-16 with its byte order mark.
fn utf_16(file: &str, bytes: &[u8]) -> Result<Option<String>> {
    let unit: fn([u8; 2]) -> u16 = match bytes {
        [0xff, 0xfe, ..] => u16::from_le_bytes,
        [0xfe, 0xff, ..] => u16::from_be_bytes,
        _ => return Ok(None),
    };
    let (units, rest) = bytes[2..].as_chunks();
    if !rest.is_empty() {
        return Err(Fault::Utf16("half a character at the end").whole(file));
    }
    let text = char::decode_utf16(units.iter().map(|pair| unit(*pair)));
    let text: Result<String, _> = text.collect();
    let whole = |_| Fault::Utf16("half a pair of surrogates").whole(file);
    text.map(Some).map_err(whole)
}

/// Whether the first characters are plain ones of two bytes.
fn looks_like_utf_16(bytes: &[u8]) -> bool {
    let zeros = |from: usize| {
        bytes.iter().skip(from).step_by(2).take(4).all(|b| *b == 0)
    };
    bytes.len() >= 8 && zeros(0) != zeros(1)
}

fn latin_1(bytes: &[u8]) -> String {
    let wide = bytes.iter().filter(|b| !b.is_ascii()).count();
    let mut text = String::with_capacity(bytes.len() + wide);
    text.extend(bytes.iter().map(|&b| char::from(b)));
    text
}

impl Fault {
    /// A text instead of the expected number.
    pub(crate) fn number(found: &str, expected: String) -> Self {
        Self::Number { found: excerpt(found), expected }
    }

    /// The fault of a file as a whole.
    pub fn whole(self, file: &str) -> RecordError {
        let file = file.to_owned();
        RecordError { file, line: None, column: None, fault: self }
    }
}

impl<'a> Text<'a> {
    /// Text with at least one line that is not blank.
    pub fn new(file: &'a str, text: &'a str) -> Result<Self> {
        if u32::try_from(text.len()).is_err() {
            let reason = "a text of more than 4 GiB".to_owned();
            return Err(Fault::Unreadable(reason).whole(file));
        }
        let separator = if text.contains('\n') { b'\n' } else { b'\r' };
        let kept = text.trim_end();
        if kept.is_empty() {
            return Err(Fault::Empty.whole(file));
        }
        // Counted first: a vector that grows takes three times the room.
        let count = kept.bytes().filter(|b| *b == separator).count();
        let mut starts = Vec::with_capacity(count + 2);
        starts.push(0);
        for (block, part) in kept.as_bytes().chunks(BLOCK).enumerate() {
            stop::point();
            let ends = part.iter().zip(block * BLOCK + 1..);
            let ends = ends.filter(|(b, _)| **b == separator);
            starts.extend(ends.map(|(_, end)| end as u32));
        }
        // The last line's blanks belong to it.
        let rest = &text.as_bytes()[kept.len()..];
        let end = rest.iter().position(|b| *b == separator);
        let end = kept.len() + end.map_or(rest.len(), |at| at + 1);
        starts.extend(u32::try_from(end));
        let is_ended = text.ends_with(['\n', '\r']);
        Ok(Self { file, text, starts, is_ended })
    }

    /// Number of lines; blank lines at the end of the file are left out.
    pub fn len(&self) -> usize {
        self.starts.len() - 1
    }

    /// Bytes of the lines `first..end`, their ends included.
    pub fn bytes(&self, first: usize, end: usize) -> usize {
        let start = |index: usize| self.starts.get(index).copied();
        let bytes = start(first).zip(start(end)).map(|(a, b)| b - a);
        bytes.unwrap_or(0) as usize
    }

    /// The line of index `index`, line `index` + 1 of the file, without its
    /// end; `None` after the last.
    pub fn line(&self, index: usize) -> Option<&'a str> {
        if index.is_multiple_of(STOP_LINES) {
            stop::point();
        }
        let (start, end) =
            (self.starts.get(index)?, self.starts.get(index + 1)?);
        let line = &self.text[*start as usize..*end as usize];
        let mark = |b: &u8| !matches!(b, b'\r' | b'\n');
        let last = line.as_bytes().iter().rposition(mark);
        Some(&line[..last.map_or(0, |last| last + 1)])
    }

    /// Lines that do not begin with `#`, and their indices.
    pub fn data(&self) -> impl Iterator<Item = (usize, &'a str)> {
        self.lines().enumerate().filter(|(_, line)| !line.starts_with('#'))
    }

    /// Lines from index `first` on.
    pub fn lines_from(&self, first: usize) -> impl Iterator<Item = &'a str> {
        (first..).map_while(|index| self.line(index))
    }

    /// All lines.
    pub fn lines(&self) -> impl Iterator<Item = &'a str> {
        self.lines_from(0)
    }

    /// Index of the line after the last line, from index `first` on, with a
    /// digit or a word for a number: some programs write words after their
    /// numbers.
    pub fn end_of_numbers(&self, first: usize) -> usize {
        let number = |index: &usize| {
            let line = self.line(*index).unwrap_or("");
            line.bytes().any(|b| b.is_ascii_digit())
                || line.split_whitespace().any(number::is_number)
        };
        let last = (first..self.len()).rev().find(number);
        last.map_or(self.len(), |index| index + 1)
    }

    /// A fault on the line of index `index`.
    pub fn on_line(&self, index: usize, fault: Fault) -> RecordError {
        let file = self.file.to_owned();
        RecordError { file, line: Some(index + 1), column: None, fault }
    }

    /// A fault at byte `byte` of the line of index `index`.
    pub fn at(&self, index: usize, byte: usize, fault: Fault) -> RecordError {
        let column = Some(byte + 1);
        RecordError { column, ..self.on_line(index, fault) }
    }

    /// A fault at the end of the file.
    pub fn at_end(&self, fault: Fault) -> RecordError {
        self.on_line(self.len() - 1, fault)
    }

    /// A header line with another content than the expected one.
    pub fn header(&self, index: usize, expected: &'static str) -> RecordError {
        let found = excerpt(self.line(index).unwrap_or(""));
        self.differs(index, found, expected)
    }

    /// A part of a header with another content than the expected one.
    pub fn differs(
        &self,
        index: usize,
        found: String,
        expected: &'static str,
    ) -> RecordError {
        self.on_line(index, Fault::Header { found, expected })
    }

    /// A line that announces another quantity than acceleration.
    pub fn quantity(&self, index: usize) -> RecordError {
        let found = excerpt(self.line(index).unwrap_or(""));
        self.on_line(index, Fault::Quantity(found))
    }

    /// A text on a line instead of the expected numbers.
    pub fn no_number(
        &self,
        index: usize,
        found: &str,
        expected: &str,
    ) -> RecordError {
        self.on_line(index, Fault::number(found, expected.to_owned()))
    }

    /// The unit that a line names.
    pub fn unit(&self, index: usize, named: &str) -> Result<AccelerationUnit> {
        let refuse = || self.on_line(index, Fault::Unit(excerpt(named)));
        AccelerationUnit::parse(named).ok_or_else(refuse)
    }

    /// Compares the number of samples up to the line of index `index` with the
    /// stated number.
    pub fn check_count(
        &self,
        index: usize,
        found: usize,
        expected: usize,
    ) -> Result<()> {
        if found == expected {
            return Ok(());
        }
        Err(self.on_line(index, Fault::Count { found, expected }))
    }
}

/// The beginning of a text, for a message.
pub(super) fn excerpt(text: &str) -> String {
    let text = text.trim();
    if text.chars().count() <= 40 {
        return text.to_owned();
    }
    text.chars().take(37).chain("...".chars()).collect()
}

/// The text after the first `word` in `line`, in upper or lower case, if
/// neither a letter nor `_` precedes or follows it.
pub(super) fn after<'a>(line: &'a str, word: &str) -> Option<&'a str> {
    let bytes = line.as_bytes();
    let letter = |i: usize| {
        bytes.get(i).is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_')
    };
    let end = (word.len()..=bytes.len()).find(|&end| {
        let start = end - word.len();
        bytes[start..end].eq_ignore_ascii_case(word.as_bytes())
            && (start == 0 || !letter(start - 1))
            && !letter(end)
    });
    Some(&line[end?..])
}

/// The first word of a text; empty without words.
pub(super) fn first_word(text: &str) -> &str {
    text.split_ascii_whitespace().next().unwrap_or("")
}

/// A text that is not empty, as a name.
pub(super) fn named(text: &str) -> Option<String> {
    Some(text).filter(|text| !text.is_empty()).map(str::to_owned)
}

/// Whether `line` contains `part`, in upper or lower case.
pub(super) fn contains(line: &str, part: &str) -> bool {
    line.as_bytes()
        .windows(part.len())
        .any(|window| window.eq_ignore_ascii_case(part.as_bytes()))
}
