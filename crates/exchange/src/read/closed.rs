//! CSV whose last quoted cell has its closing quote.

use std::io::{self, Read};

/// Place of a byte in a line of CSV.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum CsvPlace {
    /// At the start of a line.
    Line,
    /// At the start of a cell.
    Cell,
    /// In a cell without quotes, or after a closing quote.
    Plain,
    /// In a quoted cell.
    Quoted,
    /// After a quote in a quoted cell, which closes the cell or is doubled.
    Quote,
    /// In a comment.
    Comment,
}

/// The byte order mark, which the crate `csv` skips.
const MARK: [u8; 3] = *b"\xef\xbb\xbf";

/// Bytes of CSV, with an error at their end if a quoted cell is still open:
/// the reader of the crate `csv` accepts such a cell.
pub struct Closed<R> {
    from: R,
    comment: Option<u8>,
    separator: u8,
    place: CsvPlace,
    /// Number of bytes of a byte order mark that were read.
    mark: usize,
    /// Line from 1.
    line: u64,
    /// Line on which the last quoted cell begins.
    opened: u64,
}

impl<R> Closed<R> {
    /// The bytes of `from`, with `separator` between cells. Lines that begin
    /// with `comment` are not part of the table.
    pub fn new(from: R, comment: Option<u8>, separator: u8) -> Self {
        let place = CsvPlace::Line;
        Self { from, comment, separator, place, mark: 0, line: 1, opened: 1 }
    }

    fn pass(&mut self, byte: u8) {
        use CsvPlace::{Cell, Comment, Line, Plain, Quote, Quoted};
        if MARK.get(self.mark) == Some(&byte) {
            self.mark += 1;
            return;
        }
        self.mark = MARK.len();
        self.place = match (self.place, byte) {
            (Quoted, b'"') => Quote,
            (Quoted, _) | (Quote, b'"') => Quoted,
            (Line, byte) if Some(byte) == self.comment => Comment,
            (Comment, byte) if byte != b'\n' => Comment,
            (_, b'\n' | b'\r') => Line,
            (_, byte) if byte == self.separator => Cell,
            (Line | Cell, b'"') => {
                self.opened = self.line;
                Quoted
            }
            _ => Plain,
        };
        self.line += u64::from(byte == b'\n');
    }
}

impl<R: Read> Read for Closed<R> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let count = self.from.read(into)?;
        if count == 0 && !into.is_empty() && self.place == CsvPlace::Quoted {
            let message = format!(
                "a cell that begins with a quote on line {} has no closing \
                 quote",
                self.opened
            );
            return Err(io::Error::new(io::ErrorKind::InvalidData, message));
        }
        into[..count].iter().for_each(|byte| self.pass(*byte));
        Ok(count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether a file ends within a quoted cell, as the crate `csv` has it:
    /// a line behind it is then part of that cell.
    fn swallows(text: &str, separator: u8) -> bool {
        let probe = format!("{text}\nprobe\n");
        let mut reader = csv::ReaderBuilder::new();
        reader.has_headers(false).flexible(true).comment(Some(b'#'));
        reader.delimiter(separator);
        let mut reader = reader.from_reader(probe.as_bytes());
        let last = reader.records().last().unwrap().unwrap();
        last.iter().collect::<Vec<_>>() != ["probe"]
    }

    #[test]
    fn an_open_quote_is_known_as_the_crate_csv_knows_it() {
        // All texts of these bytes up to a length.
        let mut all = vec![String::new()];
        let mut longest = all.clone();
        for _ in 0..4 {
            let longer = |text: &String| {
                ['"', ',', '\n', '\r', '#', 'a'].map(|c| format!("{text}{c}"))
            };
            longest = longest.iter().flat_map(longer).collect();
            all.extend(longest.iter().cloned());
        }
        let marked = all.iter().map(|text| format!("\u{feff}{text}"));
        let marked: Vec<String> = marked.collect();
        for text in all.into_iter().chain(marked) {
            for separator in [b',', b';'] {
                let text =
                    text.replace(',', &char::from(separator).to_string());
                let mut closed =
                    Closed::new(text.as_bytes(), Some(b'#'), separator);
                let read = io::read_to_string(&mut closed);
                assert_eq!(
                    read.is_err(),
                    swallows(&text, separator),
                    "{text:?}"
                );
            }
        }
    }
}
