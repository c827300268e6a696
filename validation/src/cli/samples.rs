//! Sample files: one value a line, `inf` for a censored one, `#` comments.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use rocking::statistics::{ExtendedSample, Sample, SampleError};
use thiserror::Error;

/// Why a sample file was refused.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum SampleFileError {
    /// The file could not be read.
    #[error("cannot read {}: {source}", path.display())]
    Read {
        /// The file asked for.
        path: PathBuf,
        /// What the system said.
        #[source]
        source: io::Error,
    },
    /// A line that does not hold one number.
    #[error(
        "{}:{line}: found `{found}`: expected one number, or inf, on the line",
        path.display()
    )]
    Line {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: usize,
        /// The line's text.
        found: String,
    },
    /// A value below zero where ratios are formed.
    #[error("{}:{line}: found {found}: expected a number, not negative", path.display())]
    Negative {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: usize,
        /// The value.
        found: f64,
    },
    /// The values make no sample of the kind needed.
    #[error("{}{}: {source}", path.display(), line.map_or(String::new(), |l| format!(":{l}")))]
    Sample {
        /// The file.
        path: PathBuf,
        /// Line of the value complained of.
        line: Option<usize>,
        /// What is wrong.
        #[source]
        source: SampleError,
    },
}

/// The values of a sample file in the order of its lines, with their line
/// numbers.
pub struct SampleFile {
    path: PathBuf,
    values: Vec<f64>,
    lines: Vec<usize>,
}

impl SampleFile {
    /// Reads a file of one value a line.
    ///
    /// # Errors
    /// [`SampleFileError`] with file and line.
    pub fn read(path: &Path) -> Result<Self, SampleFileError> {
        let text = fs::read_to_string(path).map_err(|source| {
            SampleFileError::Read { path: path.to_owned(), source }
        })?;
        let (mut values, mut lines) = (Vec::new(), Vec::new());
        for (i, line) in text.lines().enumerate() {
            let content = line.split('#').next().unwrap_or("").trim();
            if content.is_empty() {
                continue;
            }
            let value = parse(content);
            values.push(value.ok_or_else(|| SampleFileError::Line {
                path: path.to_owned(),
                line: i + 1,
                found: content.chars().take(40).collect(),
            })?);
            lines.push(i + 1);
        }
        Ok(Self { path: path.to_owned(), values, lines })
    }

    /// The values in the order of the lines.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values as a finite sample.
    ///
    /// # Errors
    /// [`SampleFileError::Sample`] if one is infinite or there is none.
    pub fn finite(&self) -> Result<Sample, SampleFileError> {
        Sample::try_new(&self.values).map_err(|e| self.refuse(e))
    }

    /// The values as a sample with censored values.
    ///
    /// # Errors
    /// [`SampleFileError::Sample`] if one is minus infinity or there is none.
    pub fn extended(&self) -> Result<ExtendedSample, SampleFileError> {
        ExtendedSample::try_new(&self.values).map_err(|e| self.refuse(e))
    }

    /// The values in the order of the lines, none negative.
    ///
    /// # Errors
    /// [`SampleFileError::Negative`] for a negative value,
    /// [`SampleFileError::Sample`] for no value.
    pub fn values_not_negative(&self) -> Result<&[f64], SampleFileError> {
        self.extended()?;
        match self.values.iter().position(|&x| x < 0.0) {
            None => Ok(&self.values),
            Some(i) => Err(SampleFileError::Negative {
                path: self.path.clone(),
                line: self.lines[i],
                found: self.values[i],
            }),
        }
    }

    fn refuse(&self, source: SampleError) -> SampleFileError {
        let number = match source {
            SampleError::NotFinite { number, .. }
            | SampleError::NotExtended { number, .. } => Some(number),
            _ => None,
        };
        let line = number.and_then(|n| self.lines.get(n - 1).copied());
        SampleFileError::Sample { path: self.path.clone(), line, source }
    }
}

/// A number, or infinity where the text says so: a number too large for a
/// double is not silently infinite.
fn parse(text: &str) -> Option<f64> {
    let value = text.parse::<f64>().ok().filter(|x| !x.is_nan())?;
    let says_so = text.to_ascii_lowercase().contains("inf");
    (value.is_finite() || says_so).then_some(value)
}

/// A shift: a number, or the sample's smallest value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shift {
    /// This number, not negative.
    Given(f64),
    /// The smallest value of the sample.
    Min,
}

impl FromStr for Shift {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, Self::Err> {
        if text == "min" {
            return Ok(Self::Min);
        }
        let number = text.parse().ok().filter(|x: &f64| x.is_finite());
        let shift = number.filter(|x| *x >= 0.0);
        shift
            .map(Self::Given)
            .ok_or_else(|| "expected a number, not negative, or `min`".into())
    }
}

impl Shift {
    /// The shift, and the values that enter above it: all of them for a
    /// given one, those above the smallest for that one.
    #[must_use]
    pub fn split(self, values: &[f64]) -> (f64, Vec<f64>) {
        match self {
            Self::Given(shift) => (shift, values.to_vec()),
            Self::Min => {
                let least =
                    values.iter().copied().fold(f64::INFINITY, f64::min);
                let above = values.iter().copied().filter(|&x| x > least);
                (least, above.collect())
            }
        }
    }
}
