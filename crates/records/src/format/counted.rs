//! A name, number of samples and interval, samples: many programs exchange
//! records in this form.
//!
//! eqsig: a name, `910 0.0100`, one sample a line. EMOD3D: station and
//! component, count and interval with six numbers more, six samples a line.
//! RspMatch: a title, count, interval and another number, five samples a
//! line. El Centro as used in teaching: `1559 points at equal spacing of 0.02
//! sec`, `The units are (g)`, `*** Begin data ***`, 8F10.5, `*** End Data
//! ***`. Two lines, a count and an interval, may precede one column.
//! Only the El Centro form states a unit.

use super::csv::bracketed;
use super::{Channel, Format, Header};
use crate::error::Result;
use crate::fields;
use crate::number::{self, is_data};
use crate::text::{self, Text};
use rocking::units::AccelerationUnit;

/// Lines before the count, at most.
const NAME_LINES: usize = 3;

/// Lines between the count and the samples, at most.
const WORDS_LINES: usize = 6;

/// Numbers of EMOD3D's second line.
const EMOD3D: usize = 8;

/// The contents of the head.
struct CountLine {
    count: usize,
    dt_s: f64,
    /// Numbers on the line of the count.
    numbers: usize,
    /// Index of the first line of samples.
    first: usize,
}

/// The format.
pub(super) static FORMAT: Format = Format {
    name: "counted",
    files: "name, count and interval, samples",
    source: "eqsig, EMOD3D, RspMatch",
    content: "count and interval, samples",
    azimuths: true,
    header: Header::NoUnit,
    is_fixed: false,
    recognises: |text| head(text).is_some(),
    read,
    ..Format::BASE
};

fn head(text: &Text<'_>) -> Option<CountLine> {
    two_lines(text).or_else(|| {
        let named =
            text.lines().take(NAME_LINES).take_while(|line| !is_data(line));
        one_line(text, named.count()).or_else(|| in_words(text))
    })
}

/// `910 0.0100`, and more numbers in some programs, above samples. If the next
/// line has two numbers, they are a time and a sample, not two samples.
fn one_line(text: &Text<'_>, index: usize) -> Option<CountLine> {
    let words = text.line(index)?.split_ascii_whitespace();
    let words: Vec<&str> = words.take(EMOD3D + 1).collect();
    let (count, dt_s) = (count(words.first()?)?, interval(words.get(1)?)?);
    let first = index + 1;
    let next = text.line(first).filter(|line| is_data(line))?;
    let pairs = number::tokens(next.as_bytes()).count() == 2;
    let numbers = words.len();
    let known = numbers == EMOD3D || ([2, 3].contains(&numbers) && !pairs);
    let known = known && is_data(text.line(index)?);
    known.then_some(CountLine { count, dt_s, numbers, first })
}

/// `1559 points at equal spacing of 0.02 sec`, and more lines of words.
fn in_words(text: &Text<'_>) -> Option<CountLine> {
    let stated = |line: &str| {
        let (count, rest) = line.trim().split_once(" points at equal ")?;
        let rest = rest.strip_prefix("spacing of ")?;
        let (dt, unit) = rest.split_once(' ')?;
        let seconds = unit.starts_with("sec");
        Some((self::count(count)?, interval(dt)?)).filter(|_| seconds)
    };
    let mut lines = text.lines().take(NAME_LINES).enumerate();
    let (index, (count, dt_s)) =
        lines.find_map(|(index, line)| Some((index, stated(line)?)))?;
    let words = text.lines_from(index).take(WORDS_LINES);
    let first = index + words.take_while(|line| !is_data(line)).count();
    Some(CountLine { count, dt_s, numbers: 2, first })
}

/// A count and an interval on a line each, before this number of samples.
fn two_lines(text: &Text<'_>) -> Option<CountLine> {
    let (count, dt_s) = (count(text.line(0)?)?, interval(text.line(1)?)?);
    let (numbers, first) = (2, 2);
    let known = text.len() - first == count;
    known.then_some(CountLine { count, dt_s, numbers, first })
}

/// A number of samples.
fn count(text: &str) -> Option<usize> {
    let text = text.trim();
    let digits = text.bytes().all(|b| b.is_ascii_digit());
    text.parse().ok().filter(|count| digits && *count >= 2)
}

/// A sampling interval in a usual form: a whole number of samples per second,
/// or at most four decimals.
pub(super) fn interval(text: &str) -> Option<f64> {
    let (dt_s, form) = number::read(text.trim())?;
    if form.decimals.is_none() || !(1e-4..=0.2).contains(&dt_s) {
        return None;
    }
    let whole = |x: f64, within: f64| (x - x.round()).abs() <= within * x;
    let plain = whole(1.0 / dt_s, 1e-4) || whole(dt_s * 1e4, 1e-9);
    plain.then_some(dt_s)
}

/// Reads the file's one channel.
fn read(text: &Text<'_>) -> Result<Vec<Channel>> {
    let CountLine { count, dt_s, numbers, first } =
        head(text).ok_or_else(|| {
            text.header(0, "a count and an interval, such as `910 0.0100`")
        })?;
    let mut unit = None;
    for (index, line) in text.lines().take(first).enumerate() {
        let named = bracketed(line).find_map(AccelerationUnit::parse);
        unit = unit.or(named);
        let other = ["velocity", "displacement"];
        if other.iter().any(|name| text::contains(line, name)) {
            return Err(text.quantity(index));
        }
    }
    let end = text.end_of_numbers(first);
    let mut remarks = Vec::new();
    let several = text
        .line(first)
        .map_or(0, |line| number::tokens(line.as_bytes()).take(2).count());
    let samples = if several > 1 {
        let layout = fields::infer(text, first, end, 0);
        fields::read(text, first, end, layout)?
    } else {
        let lines = text.lines().enumerate().take(end).skip(first);
        let (samples, forms) = fields::column(text, lines)?;
        if end == text.len() {
            remarks = forms.check_ended(text)?;
        }
        samples
    };
    text.check_count(end - 1, samples.len(), count)?;
    // EMOD3D: station, component, and additions of the writer.
    let component = text.line(0).filter(|_| numbers == EMOD3D);
    let component = component.and_then(|l| l.split_ascii_whitespace().nth(1));
    let label = component.map(str::to_owned);
    Ok(vec![Channel { label, remarks, ..Channel::of(dt_s, unit, samples) }])
}
