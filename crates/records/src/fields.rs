//! Samples in lines of several numbers, in fields of one width or with
//! separators.

use std::collections::BTreeMap;

use super::number::{self, Form};
use super::text::{Text, excerpt};
use crate::error::{Fault, Result};
use crate::quality::Remark;

/// Width of a field and number of fields in a full line.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct FieldLayout {
    /// Characters of one number, blanks before it included.
    pub(super) width: usize,
    /// Numbers in a full line.
    pub(super) per_line: usize,
    /// Characters by which the first field of a line is narrower.
    pub(super) missing: usize,
    /// Whether each number is written in its own form.
    varied: bool,
}

impl FieldLayout {
    /// Fields of one width.
    pub(super) const fn even(per_line: usize, width: usize) -> Self {
        Self { width, per_line, missing: 0, varied: false }
    }

    /// The same fields, for numbers each written in its own form.
    pub(super) const fn varied(self) -> Self {
        Self { varied: true, ..self }
    }

    /// Bytes of field `k` in a line.
    fn field(self, k: usize) -> std::ops::Range<usize> {
        let end = (k + 1) * self.width - self.missing;
        let start = if k == 0 { 0 } else { end - self.width };
        start..end
    }
}

/// The layout of at least half of the lines `first..end`, if the numbers end
/// one width apart and the first field is `missing` characters narrower;
/// `None` for free text.
///
/// The last line may be short. A file of one number a line is free text,
/// because its width says nothing.
pub(super) fn infer(
    text: &Text<'_>,
    first: usize,
    end: usize,
    missing: usize,
) -> Option<FieldLayout> {
    let count = end.saturating_sub(first);
    let full = if count > 1 { count - 1 } else { count };
    let mut votes: BTreeMap<FieldLayout, usize> = BTreeMap::new();
    let lines = text.lines_from(first).take(full);
    for layout in lines.filter_map(|line| layout_of(line, missing)) {
        let votes = votes.entry(layout).or_default();
        *votes += 1;
        // The other lines cannot outvote it.
        if 2 * *votes > full {
            return Some(layout);
        }
    }
    let (layout, votes) = votes.into_iter().max_by_key(|(_, n)| *n)?;
    (2 * votes >= full).then_some(layout)
}

/// The layout of one line of two numbers or more.
pub(super) fn layout_of(line: &str, missing: usize) -> Option<FieldLayout> {
    let mut tokens = number::tokens(line.as_bytes());
    let (first, second) = (tokens.next()??, tokens.next()??);
    let width = second.end - first.end;
    if first.end + missing != width {
        return None;
    }
    let mut layout = FieldLayout { missing, ..FieldLayout::even(2, width) };
    for token in tokens {
        if token?.end != layout.field(layout.per_line).end {
            return None;
        }
        layout.per_line += 1;
    }
    Some(layout)
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
    layout: Option<FieldLayout>,
) -> Result<Vec<f64>> {
    // Counted first: a growing vector takes three times the memory.
    let count = match layout {
        Some(layout) => text.bytes(first, end) / layout.width + 1,
        None => text
            .lines_from(first)
            .map(|line| number::tokens(line.as_bytes()).count())
            .sum(),
    };
    let samples = Vec::with_capacity(count);
    let varied = layout.is_some_and(|layout| layout.varied);
    let mut lines =
        LineReader { text, index: first, form: None, varied, samples };
    for index in first..end {
        lines.index = index;
        match layout {
            Some(layout) => lines.fixed(layout, index + 1 == end)?,
            None => lines.free()?,
        }
    }
    Ok(lines.samples)
}

/// Reads `count` numbers in full lines of a layout from the line of index
/// `first` on; also gives the index of the next line.
///
/// # Errors
/// As [`read`], and for fewer lines or numbers.
pub(super) fn block(
    text: &Text<'_>,
    first: usize,
    count: usize,
    layout: FieldLayout,
) -> Result<(Vec<f64>, usize)> {
    let end = first.saturating_add(count.div_ceil(layout.per_line));
    if end > text.len() {
        let lines = text.len().saturating_sub(first);
        let found = lines.saturating_mul(layout.per_line);
        return Err(text.at_end(Fault::Count { found, expected: count }));
    }
    let values = read(text, first, end, Some(layout))?;
    text.check_count(end.max(1) - 1, values.len(), count)?;
    Ok((values, end))
}

struct LineReader<'t, 'a> {
    text: &'t Text<'a>,
    index: usize,
    /// Form of the first number, and of the others unless they are `varied`.
    form: Option<Form>,
    varied: bool,
    samples: Vec<f64>,
}

impl LineReader<'_, '_> {
    fn refuse<T>(&self, byte: usize, fault: Fault) -> Result<T> {
        Err(self.text.at(self.index, byte, fault))
    }

    fn number(
        &mut self,
        byte: usize,
        found: &str,
        expected: impl Fn() -> String,
    ) -> Result<()> {
        match number::read(found) {
            Some((value, form)) if value.is_finite() => {
                let first = *self.form.get_or_insert(form);
                if form != first && !self.varied {
                    let fault = Fault::number(found, describe(first));
                    return self.refuse(byte, fault);
                }
                self.samples.push(value);
                Ok(())
            }
            Some(_) => self.refuse(byte, Fault::NotFinite(excerpt(found))),
            None => self.refuse(byte, Fault::number(found, expected())),
        }
    }

    fn fixed(&mut self, layout: FieldLayout, last: bool) -> Result<()> {
        let FieldLayout { width, per_line, missing, .. } = layout;
        let line = self.text.line(self.index).unwrap_or("").trim_end();
        let full = width * per_line - missing;
        if line.len() > full {
            // The text may have a character of several bytes there.
            let rest = line.get(full..).unwrap_or(line);
            let expected =
                format!("{per_line} numbers of {width} characters a line");
            return self.refuse(full, Fault::number(rest, expected));
        }
        let written = (line.len() + missing).div_ceil(width);
        let count = if last { written } else { per_line };
        for place in (0..count).map(|k| layout.field(k)) {
            let end = line.len().min(place.end);
            let field = line.get(place.start..end).unwrap_or("");
            let found = field.trim_start_matches(' ');
            let expected = || format!("a number of {width} characters");
            let byte = place.start + field.len() - found.len();
            if field.len() < place.len() {
                return self.refuse(byte, Fault::number(found, expected()));
            }
            self.number(byte, found, expected)?;
        }
        Ok(())
    }

    fn free(&mut self) -> Result<()> {
        let line = self.text.line(self.index).unwrap_or("");
        let mut at = 0;
        for part in line.split([' ', '\t', ',']) {
            let mut start = 0;
            while start < part.len() {
                let rest = &part[start..];
                let end = number::token_at(part.as_bytes(), start)
                    .map_or(part.len(), |token| token.end);
                let found = part.get(start..end).unwrap_or(rest);
                let expected = || "a number".to_owned();
                self.number(at + start, found, expected)?;
                start = end;
            }
            at += part.len() + 1;
        }
        Ok(())
    }
}

/// The forms of numbers that are read one a line.
#[derive(Default)]
pub(super) struct Forms {
    first: Option<Form>,
    /// Number of numbers before the last with each form.
    before: BTreeMap<Form, usize>,
    last: Option<(f64, Form)>,
}

impl Forms {
    /// Adds the next number and its form.
    pub fn push(&mut self, value: f64, form: Form) {
        self.first.get_or_insert(form);
        if let Some((_, form)) = self.last.replace((value, form)) {
            *self.before.entry(form).or_default() += 1;
        }
    }

    /// Whether all numbers but the first have one form, and the first another.
    pub fn first_differs(&self) -> bool {
        let (Some(first), Some((_, last))) = (self.first, self.last) else {
            return false;
        };
        self.before.get(&first) == Some(&1)
            && self.before.len() == 2
            && self.before.contains_key(&last)
            && first != last
    }

    /// The remark on a text that ends within a line; none if the form of the
    /// numbers shows that the last number is whole.
    ///
    /// # Errors
    /// A last number that was visibly cut: it has fewer digits than all
    /// numbers before, a shorter exponent, or no exponent although its size
    /// suggests one. A cut in a number without an exponent leaves a number
    /// nearer to zero.
    pub fn check_ended(&self, text: &Text<'_>) -> Result<Vec<Remark>> {
        let (Some(first), Some((value, last)), false, false) =
            (self.first, self.last, self.before.is_empty(), text.is_ended)
        else {
            return Ok(Vec::new());
        };
        let exponents = self.before.keys().map(|form| form.exponent);
        let expected = if self.before.len() == 1 && self.before[&first] > 2 {
            let shorter = last.decimals < first.decimals
                || last.exponent < first.exponent;
            if !shorter {
                return Ok(Vec::new());
            }
            describe(first)
        } else if let Some(least) = exponents.filter(|n| *n > 0).min()
            && last.exponent < least
            && (last.exponent > 0 || value.abs() >= LEAST_MANTISSA)
        {
            format!(
                "an exponent of {least} characters, as in other numbers, or \
                 the end of the line"
            )
        } else {
            return Ok(vec![Remark::LastLine]);
        };
        let line = text.line(text.len() - 1).unwrap_or("");
        Err(text.no_number(text.len() - 1, line, &expected))
    }
}

/// The number before an exponent is no smaller than this (`0.1e-3`), unless it
/// is zero.
const LEAST_MANTISSA: f64 = 0.1;

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

/// Reads one number a line, and the forms of the numbers.
pub(super) fn column<'a>(
    text: &Text<'_>,
    lines: impl Iterator<Item = (usize, &'a str)>,
) -> Result<(Vec<f64>, Forms)> {
    let mut samples = Vec::with_capacity(text.len());
    let mut forms = Forms::default();
    for (index, line) in lines {
        let (sample, form) = one_number(text, index, line)?;
        forms.push(sample, form);
        samples.push(sample);
    }
    Ok((samples, forms))
}

/// The number in a line or in one of its fields, and its form.
pub(super) fn one_number(
    text: &Text<'_>,
    index: usize,
    found: &str,
) -> Result<(f64, Form)> {
    let found = found.trim();
    match number::read(found) {
        Some(known) if known.0.is_finite() => Ok(known),
        Some(_) => Err(text.on_line(index, Fault::NotFinite(excerpt(found)))),
        None => Err(text.no_number(index, found, "a number")),
    }
}
