//! A file as numbered lines, and the faults found in them.

use std::borrow::Cow;

use super::{Fault, RecordError};

/// Lines of one file; faults are built here, so that each carries its place.
pub(super) struct Text<'a> {
    file: &'a str,
    lines: Vec<&'a str>,
    ended: bool,
}

/// Bytes as text: UTF-8, else Latin-1 (station names); control characters
/// mean that it is none.
pub(super) fn decode<'a>(
    file: &str,
    bytes: &'a [u8],
) -> Result<Cow<'a, str>, RecordError> {
    let bytes = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
    // Old systems end a text file with one or more Ctrl-Z.
    let mut end = bytes.len();
    while end > 0 && bytes[end - 1] == 0x1a {
        end -= 1;
    }
    let bytes = &bytes[..end];
    let control =
        |b: u8| b < 0x20 && !matches!(b, b'\t' | b'\n' | b'\r' | 0x0c);
    if let Some(offset) = bytes.iter().position(|&b| control(b)) {
        let fault = Fault::NotText { byte: bytes[offset], offset };
        return Err(fault.whole(file));
    }
    Ok(match std::str::from_utf8(bytes) {
        Ok(text) => Cow::Borrowed(text),
        Err(_) => Cow::Owned(bytes.iter().map(|&b| char::from(b)).collect()),
    })
}

impl Fault {
    /// The fault of a file as a whole.
    pub(super) fn whole(self, file: &str) -> RecordError {
        let file = file.to_owned();
        RecordError { file, line: None, column: None, fault: self }
    }
}

impl<'a> Text<'a> {
    /// Text with at least one line that is not blank.
    pub(super) fn new(
        file: &'a str,
        text: &'a str,
    ) -> Result<Self, RecordError> {
        let separator = if text.contains('\n') { '\n' } else { '\r' };
        // Counted first: a vector that grows takes three times the room.
        let count = text.matches(separator).count();
        let mut lines = Vec::with_capacity(count + 1);
        let split = text.split(separator);
        lines.extend(split.map(|line| line.trim_end_matches('\r')));
        while lines.last().is_some_and(|line: &&str| line.trim().is_empty()) {
            lines.pop();
        }
        if lines.is_empty() {
            return Err(Fault::Empty.whole(file));
        }
        Ok(Self { file, lines, ended: text.ends_with(['\n', '\r']) })
    }

    /// Name of the file.
    pub(super) fn file(&self) -> &'a str {
        self.file
    }

    /// Lines without their ends; blank lines at the end of the file are
    /// left out. Index i is line i + 1.
    pub(super) fn lines(&self) -> &[&'a str] {
        &self.lines
    }

    /// Whether the text ends with the end of a line.
    pub(super) fn is_ended(&self) -> bool {
        self.ended
    }

    /// Refuses a text that ends within a line, for formats in which nothing
    /// else tells a file that was cut.
    pub(super) fn check_ended(&self) -> Result<(), RecordError> {
        if self.ended {
            return Ok(());
        }
        Err(self.at_end(Fault::Ends("the end of this line: was it cut?")))
    }

    /// A fault on the line of index `index`.
    pub(super) fn on_line(&self, index: usize, fault: Fault) -> RecordError {
        let file = self.file.to_owned();
        RecordError { file, line: Some(index + 1), column: None, fault }
    }

    /// A fault at byte `byte` of the line of index `index`.
    pub(super) fn at(
        &self,
        index: usize,
        byte: usize,
        fault: Fault,
    ) -> RecordError {
        let column = Some(byte + 1);
        RecordError { column, ..self.on_line(index, fault) }
    }

    /// A fault at the end of the file.
    pub(super) fn at_end(&self, fault: Fault) -> RecordError {
        self.on_line(self.lines.len() - 1, fault)
    }

    /// The number of samples found in the file against the stated one.
    pub(super) fn check_count(
        &self,
        found: usize,
        expected: usize,
    ) -> Result<(), RecordError> {
        self.check_count_at(self.lines.len() - 1, found, expected)
    }

    /// The number of samples found up to the line of index `index` against
    /// the stated one.
    pub(super) fn check_count_at(
        &self,
        index: usize,
        found: usize,
        expected: usize,
    ) -> Result<(), RecordError> {
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

/// Byte after the end of `word` in `line`, whatever the case, where it
/// stands as a word of its own.
pub(super) fn after_word(line: &str, word: &str) -> Option<usize> {
    let bytes = line.as_bytes();
    let letter = |i: usize| {
        bytes.get(i).is_some_and(|b| b.is_ascii_alphabetic() || *b == b'_')
    };
    (0..(bytes.len() + 1).saturating_sub(word.len()))
        .find(|&start| {
            let end = start + word.len();
            bytes[start..end].eq_ignore_ascii_case(word.as_bytes())
                && (start == 0 || !letter(start - 1))
                && !letter(end)
        })
        .map(|start| start + word.len())
}

/// Whether `line` contains `part`, whatever the case.
pub(super) fn contains(line: &str, part: &str) -> bool {
    line.as_bytes()
        .windows(part.len())
        .any(|window| window.eq_ignore_ascii_case(part.as_bytes()))
}
