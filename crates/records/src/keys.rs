//! Headers of lines `key value` or `key : value`.

use super::number;
use super::text::Text;
use crate::error::{Fault, Result};
use rocking::units::AccelerationUnit;

/// Number of lines that are searched for a key.
const HEADER_LINES: usize = 80;

impl<'a> Text<'a> {
    /// Index of the first header line that begins with `key`, and the text
    /// after the key and a colon.
    pub fn find(&self, key: &str) -> Option<(usize, &'a str)> {
        let lines = self.lines().take(HEADER_LINES);
        lines.enumerate().find_map(|(index, line)| {
            let rest = line.trim_start().strip_prefix(key)?;
            let rest = rest.trim_start();
            Some((index, rest.strip_prefix(':').unwrap_or(rest).trim()))
        })
    }

    /// Whether the header has lines that begin with each of these keys.
    pub fn has(&self, keys: [&str; 2]) -> bool {
        keys.iter().all(|key| self.find(key).is_some())
    }

    /// The value of `key`, copied, if the header has it.
    pub fn label(&self, key: &str) -> Option<String> {
        self.find(key).map(|(_, value)| value.to_owned())
    }

    /// Index of the line of `key`, and its value.
    pub fn value(&self, key: &'static str) -> Result<(usize, &'a str)> {
        self.find(key).ok_or_else(|| self.at_end(Fault::Ends(key)))
    }

    /// Index of the line of `key`, and the finite number there, without
    /// `suffix`.
    pub fn number(
        &self,
        key: &'static str,
        suffix: &str,
    ) -> Result<(usize, f64)> {
        let (index, found) = self.value(key)?;
        let digits = found.strip_suffix(suffix).unwrap_or(found).trim_end();
        let number = number::finite(digits).map(|x| (index, x));
        number.ok_or_else(|| self.header(index, "a number"))
    }

    /// The positive number of `key`, without `suffix`.
    pub fn positive(&self, key: &'static str, suffix: &str) -> Result<f64> {
        match self.number(key, suffix)? {
            (_, x) if x > 0.0 => Ok(x),
            (index, _) => Err(self.header(index, "a positive number")),
        }
    }

    /// The number of samples at `key`.
    pub fn count(&self, key: &'static str) -> Result<usize> {
        let (index, found) = self.value(key)?;
        let count = found.parse().ok().filter(|n: &usize| *n > 0);
        count.ok_or_else(|| self.header(index, "a number of samples"))
    }

    /// Compares the peak of `samples` with the peak that the header states.
    pub fn check_peak(
        &self,
        samples: &[f64],
        expected: f64,
        allowed: f64,
        unit: AccelerationUnit,
    ) -> Result<()> {
        let checked = check_peak(samples, expected, allowed, unit);
        checked.map_err(|fault| self.at_end(fault))
    }
}

/// Compares the peak of `samples` with an expected one.
pub(super) fn check_peak(
    samples: &[f64],
    expected: f64,
    allowed: f64,
    unit: AccelerationUnit,
) -> Result<(), Fault> {
    let found = samples.iter().fold(0.0, |peak: f64, a| peak.max(a.abs()));
    let expected = expected.abs();
    if (found - expected).abs() <= allowed {
        return Ok(());
    }
    Err(Fault::Peak { found, expected, unit })
}
