//! Samples in lines of several numbers: by the file's field width, or with
//! room between.

use std::collections::BTreeMap;

use super::number::{self, Form, Reading};
use super::text::{Text, excerpt};
use super::{Fault, RecordError};

/// Width of a field and number of fields in a full line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Layout {
    /// Characters of one number, blanks before it included.
    pub(super) width: usize,
    /// Numbers in a full line.
    pub(super) per_line: usize,
}

/// The layout that at least half of the lines have, if the numbers end at
/// the multiples of one width; `None` for free text.
///
/// The last line may be short. A file of one number a line is free text:
/// its width says nothing.
pub(super) fn infer(lines: &[&str]) -> Option<Layout> {
    let full = if lines.len() > 1 { &lines[..lines.len() - 1] } else { lines };
    let mut votes: BTreeMap<Layout, usize> = BTreeMap::new();
    for line in full {
        let Ok(tokens) = number::tokens(line.as_bytes()) else { continue };
        let Some(first) = tokens.first() else { continue };
        let layout = Layout { width: first.end, per_line: tokens.len() };
        let in_step =
            tokens.iter().zip(1..).all(|(t, k)| t.end == k * layout.width);
        if in_step && layout.per_line > 1 {
            *votes.entry(layout).or_default() += 1;
        }
    }
    let (layout, count) = votes.into_iter().max_by_key(|(_, n)| *n)?;
    (2 * count >= full.len()).then_some(layout)
}

/// Reads the numbers of `text`'s lines `first..end` by `layout`, or as free
/// text without one. All numbers must be written in one form.
///
/// # Errors
/// A fault with line and column: a number cut, widened, missing or replaced,
/// a line that is not full before the last, anything after the last.
pub(super) fn read(
    text: &Text<'_>,
    first: usize,
    end: usize,
    layout: Option<Layout>,
) -> Result<Vec<f64>, RecordError> {
    let mut samples = Vec::new();
    let mut form = None;
    for index in first..end {
        let mut line = Line { text, index, form: &mut form };
        match layout {
            Some(layout) => {
                line.fixed(layout, index + 1 == end, &mut samples)?;
            }
            None => line.free(&mut samples)?,
        }
    }
    Ok(samples)
}

struct Line<'t, 'a> {
    text: &'t Text<'a>,
    index: usize,
    form: &'t mut Option<Form>,
}

impl Line<'_, '_> {
    fn refuse(
        &self,
        byte: usize,
        found: &str,
        expected: String,
    ) -> RecordError {
        let fault = Fault::Number { found: excerpt(found), expected };
        self.text.at(self.index, byte, fault)
    }

    fn number(
        &mut self,
        byte: usize,
        found: &str,
        expected: impl Fn() -> String,
    ) -> Result<f64, RecordError> {
        match number::read(found) {
            Reading::Finite(value, form) => {
                let first = *self.form.get_or_insert(form);
                if form == first {
                    return Ok(value);
                }
                Err(self.refuse(byte, found, describe(first)))
            }
            Reading::NotFinite => {
                let fault = Fault::NotFinite(excerpt(found));
                Err(self.text.at(self.index, byte, fault))
            }
            Reading::Other => Err(self.refuse(byte, found, expected())),
        }
    }

    fn fixed(
        &mut self,
        layout: Layout,
        last: bool,
        samples: &mut Vec<f64>,
    ) -> Result<(), RecordError> {
        let Layout { width, per_line } = layout;
        let line = self.text.lines()[self.index].trim_end();
        let full = width * per_line;
        if line.len() > full {
            // The text may hold a character of several bytes there.
            let rest = line.get(full..).unwrap_or(line);
            let expected =
                format!("{per_line} numbers of {width} characters a line");
            return Err(self.refuse(full, rest, expected));
        }
        let count = if last { line.len().div_ceil(width) } else { per_line };
        for start in (0..count).map(|k| k * width) {
            let field = line.get(start..line.len().min(start + width));
            let field = field.unwrap_or("");
            let found = field.trim_start_matches(' ');
            let expected = || format!("a number of {width} characters");
            let byte = start + field.len() - found.len();
            if field.len() < width {
                return Err(self.refuse(byte, found, expected()));
            }
            samples.push(self.number(byte, found, expected)?);
        }
        Ok(())
    }

    fn free(&mut self, samples: &mut Vec<f64>) -> Result<(), RecordError> {
        let line = self.text.lines()[self.index];
        let mut at = 0;
        for part in line.split([' ', '\t', ',']) {
            let mut start = 0;
            while start < part.len() {
                let rest = &part[start..];
                let end = number::token_at(part.as_bytes(), start)
                    .map_or(part.len(), |token| token.end);
                let found = part.get(start..end).unwrap_or(rest);
                let expected = || "a number".to_owned();
                samples.push(self.number(at + start, found, expected)?);
                start = end;
            }
            at += part.len() + 1;
        }
        Ok(())
    }
}

fn describe(form: Form) -> String {
    let exponent = match form.exponent {
        0 => "no exponent".to_owned(),
        n => format!("an exponent of {n} characters"),
    };
    match form.decimals {
        Some(n) => {
            format!("{n} decimals and {exponent}, as the file's first number")
        }
        None => format!("no decimal point and {exponent}, as the first"),
    }
}
