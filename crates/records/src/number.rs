//! Numbers as programs write them, with or without separators.

/// A number in a line: its end, and its form.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Token {
    /// Byte after the last.
    pub(super) end: usize,
    /// Its form.
    pub(super) form: Form,
}

/// Form of a written number. A format statement fixes both counts, so that a
/// missing digit shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Form {
    /// Number of digits after the decimal point; `None` without a point.
    pub(super) decimals: Option<usize>,
    /// Number of characters of the exponent, with its letter and sign.
    pub(super) exponent: usize,
}

/// The number that begins at byte `start`, as long as it can be.
///
/// Fortran writes a three-digit exponent without its letter (`.1234567-100`)
/// if the field is too narrow for both.
pub(super) fn token_at(bytes: &[u8], start: usize) -> Option<Token> {
    let byte = |i: usize| bytes.get(i).copied().unwrap_or(b' ');
    let digits = |from: usize| {
        let rest = bytes.get(from..).unwrap_or_default();
        rest.iter().take_while(|b| b.is_ascii_digit()).count()
    };
    let sign = |i: usize| usize::from(matches!(byte(i), b'+' | b'-'));
    let mut end = start + sign(start);
    let whole = digits(end);
    end += whole;
    let mut decimals = None;
    if byte(end) == b'.' {
        let count = digits(end + 1);
        decimals = Some(count);
        end += 1 + count;
    }
    if whole + decimals.unwrap_or(0) == 0 {
        return None;
    }
    let mut exponent = 0;
    if matches!(byte(end), b'e' | b'E' | b'd' | b'D') {
        let from = end + 1 + sign(end + 1);
        if digits(from) > 0 {
            exponent = from + digits(from) - end;
        }
    } else if decimals.is_some()
        && sign(end) == 1
        && digits(end + 1) == 3
        && byte(end + 4) != b'.'
    {
        exponent = 4;
    }
    end += exponent;
    Some(Token { end, form: Form { decimals, exponent } })
}

/// All numbers of a line, also without separators. `None` ends them at the
/// first text that is neither a number nor a separator.
pub(super) fn tokens(line: &[u8]) -> impl Iterator<Item = Option<Token>> {
    let mut at = 0;
    std::iter::from_fn(move || {
        while matches!(line.get(at), Some(b' ' | b'\t' | b',')) {
            at += 1;
        }
        if at >= line.len() {
            return None;
        }
        let token = token_at(line, at);
        at = token.map_or(line.len(), |token| token.end);
        Some(token)
    })
}

/// Whether a line consists only of numbers.
pub(super) fn is_data(line: &str) -> bool {
    let mut numbers = tokens(line.as_bytes()).peekable();
    numbers.peek().is_some() && numbers.all(|token| token.is_some())
}

/// The number of a text that is a number from end to end, and its form. It is
/// not finite for NaN, infinities, and numbers too large for a double.
pub(super) fn read(text: &str) -> Option<(f64, Form)> {
    let bytes = text.as_bytes();
    let Some(token) = token_at(bytes, 0).filter(|t| t.end == bytes.len())
    else {
        let word = text.trim_start_matches(['+', '-']).to_ascii_lowercase();
        let named = ["nan", "inf", "infinity"].contains(&word.as_str());
        return named.then_some((f64::NAN, Form::default()));
    };
    let (mantissa, exponent) = text.split_at(token.end - token.form.exponent);
    let digits = exponent.trim_start_matches(['d', 'D']);
    // Only Fortran's exponents are written anew.
    let parsed = match exponent.as_bytes() {
        [] | [b'e' | b'E', ..] => text.parse::<f64>(),
        _ => format!("{mantissa}e{digits}").parse(),
    };
    Some((parsed.ok()?, token.form))
}

/// The number of a text that is a finite number from end to end.
pub(super) fn finite(text: &str) -> Option<f64> {
    read(text).map(|(value, _)| value).filter(|value| value.is_finite())
}

/// Whether a text is a number, finite or not.
pub(super) fn is_number(text: &str) -> bool {
    read(text).is_some()
}
