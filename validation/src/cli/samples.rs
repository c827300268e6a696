//! Sample files: one value a line, `>3.2` for one censored at 3.2, `inf` for
//! one censored at a limit that is not told, `#` comments.
//! The comment behind a value is the name of its record.

use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, Read, Stdin};
use std::path::{Path, PathBuf};

use rocking::block::Block;
use rocking::integrator::Model;
use rocking::intensity::IntensityMeasure;
use rocking::statistics::{
    CensoredSample, ExtendedSample, Sample, SampleError,
};
use thiserror::Error;

use rocking_common::paper::Intensity;

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
        "{}:{line}: found `{found}`: expected one number, >LIMIT or inf on the line",
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
    /// A measure that is not the one given.
    #[error("{}: a sample of {found}, --im {given}: expected its own measure", path.display())]
    Measure {
        /// The file.
        path: PathBuf,
        /// What it says of itself.
        found: String,
        /// The measure given.
        given: String,
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
    /// A record that cannot be paired.
    #[error("{}:{line}: record {name} is {what}: expected each record once in both", path.display())]
    Name {
        /// The file.
        path: PathBuf,
        /// Line number from 1.
        line: usize,
        /// The record.
        name: String,
        /// What is wrong with it.
        what: &'static str,
    },
    /// Two samples of different things.
    #[error("{}: a sample of {found}: expected one of {expected}, as the other file", path.display())]
    Different {
        /// The file.
        path: PathBuf,
        /// What it says of itself.
        found: String,
        /// What the other file says.
        expected: String,
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

/// Largest relative difference between a parameter of a block and that of a
/// sample: the median moves by about as much.
const MOST_DIFFERENT: f64 = 0.01;

/// How the line begins that says what the values are.
pub const SAMPLE_OF: &str = "# Sample of ";

/// The block and model of which a sample file says that it is.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleSetting {
    /// Slenderness angle in rad; none for adjusted blocks.
    pub alpha_rad: Option<f64>,
    /// Frequency parameter in rad/s.
    pub p_rad_s: Option<f64>,
    /// Coefficient of restitution.
    pub eta: Option<f64>,
    /// Equation of motion.
    pub model: Option<Model>,
}

impl SampleSetting {
    /// Of the comment line that `rocking capacities` writes second.
    fn of(line: &str) -> Option<Self> {
        let mut words = line.strip_prefix("# alpha ")?.split(", ");
        let number = |text: &str| text.parse().ok();
        let alpha = words.next()?.strip_suffix(" rad");
        let p = words.next()?.strip_prefix("p ")?.strip_suffix(" rad/s");
        let eta = words.next()?.strip_prefix("eta ");
        let model = words.next()?;
        Some(Self {
            alpha_rad: alpha.and_then(number),
            p_rad_s: p.and_then(number),
            eta: eta.and_then(number),
            model: model.parse().ok(),
        })
    }

    /// Whether capacities of this setting in a measure are those of a block.
    /// Those in a dimensionless measure hold for another slenderness, which
    /// is why it is used.
    ///
    /// # Errors
    /// Words, where the setting has a parameter that differs.
    pub fn holds_for(
        &self,
        block: &Block,
        dimensionless: Option<Intensity>,
    ) -> Result<(), String> {
        let alpha = self.alpha_rad.filter(|_| dimensionless.is_none());
        for (name, own, found, unit) in [
            ("p", self.p_rad_s, block.frequency_rad_s(), "rad/s"),
            ("alpha", alpha, block.slenderness_rad(), "rad"),
        ] {
            if let Some(own) = own
                && !((found / own - 1.0).abs() <= MOST_DIFFERENT)
            {
                return Err(format!(
                    "capacities at {name} {own} {unit}, the block has \
                     {found}: expected those of its own {name}, to 1 %"
                ));
            }
        }
        Ok(())
    }

    /// What it states, to stand behind other words.
    #[must_use]
    pub fn words(&self) -> String {
        let stated = [
            ("alpha", self.alpha_rad, " rad"),
            ("p", self.p_rad_s, " rad/s"),
            ("eta", self.eta, ""),
        ];
        let stated = stated.into_iter().filter_map(|(name, value, unit)| {
            value.map(|value| format!(", {name} {value}{unit}"))
        });
        stated.collect()
    }
}

/// A file to read from, or standard input where `-` is given.
pub enum Opened {
    /// A file.
    File(File),
    /// Standard input.
    Standard(Stdin),
}

impl Opened {
    /// Opens `path`.
    ///
    /// # Errors
    /// What the system says; a device that may never end.
    pub fn open(path: &Path) -> io::Result<Self> {
        if path == Path::new("-") {
            return Ok(Self::Standard(io::stdin()));
        }
        let found = fs::metadata(path)?;
        let given = path.starts_with("/dev/fd") || path.starts_with("/proc");
        if !(found.is_file() || given) {
            return Err(io::Error::other(
                "it is no file: expected one, or - for standard input",
            ));
        }
        Ok(Self::File(File::open(path)?))
    }
}

impl Read for Opened {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        match self {
            Self::File(file) => file.read(buffer),
            Self::Standard(input) => input.read(buffer),
        }
    }
}

/// The values of a sample file in the order of its lines, with their line
/// numbers.
pub struct SampleFile {
    path: PathBuf,
    values: Vec<f64>,
    /// Limits of the censored values, where the file tells them.
    limits: Vec<Option<f64>>,
    lines: Vec<usize>,
    /// Names behind the values.
    names: Vec<Option<String>>,
    /// What the values are, where the file says it.
    of: Option<String>,
    setting: SampleSetting,
}

impl SampleFile {
    /// Reads a file of one value a line.
    ///
    /// # Errors
    /// [`SampleFileError`] with file and line.
    pub fn read(path: &Path) -> Result<Self, SampleFileError> {
        let mut text = String::new();
        Opened::open(path)
            .and_then(|mut file| file.read_to_string(&mut text))
            .map_err(|source| {
                let path = path.to_owned();
                SampleFileError::Read { path, source }
            })?;
        let (mut values, mut lines) = (Vec::new(), Vec::new());
        let mut limits = Vec::new();
        let (mut names, mut of) = (Vec::new(), None);
        let mut setting = SampleSetting::default();
        for (i, line) in text.lines().enumerate() {
            if let Some(words) = line.strip_prefix(SAMPLE_OF) {
                of = Some(words.trim().to_owned());
            }
            if let Some(found) = SampleSetting::of(line) {
                setting = found;
            }
            let (content, comment) =
                line.split_once('#').unwrap_or((line, ""));
            let content = content.trim();
            if content.is_empty() {
                continue;
            }
            let (value, limit) =
                parse(content).ok_or_else(|| SampleFileError::Line {
                    path: path.to_owned(),
                    line: i + 1,
                    found: content.chars().take(40).collect(),
                })?;
            values.push(value);
            limits.push(limit);
            lines.push(i + 1);
            let name = comment.trim();
            names.push((!name.is_empty()).then(|| name.to_owned()));
        }
        let path = path.to_owned();
        Ok(Self { path, values, limits, lines, names, of, setting })
    }

    /// The values of two files as pairs: by the names of their records where
    /// both files name them all, otherwise by their lines. Tells whether it
    /// was by name.
    ///
    /// # Errors
    /// [`SampleFileError`] for a negative value, a name on one side only or
    /// twice, and for files that say of themselves that they are samples of
    /// different things.
    pub fn pairs(
        &self,
        other: &Self,
    ) -> Result<(Vec<f64>, Vec<f64>, bool), SampleFileError> {
        let (a, b) =
            (self.values_not_negative()?, other.values_not_negative()?);
        if let (Some(first), Some(second)) = (&self.of, &other.of)
            && first != second
        {
            return Err(SampleFileError::Different {
                path: other.path.clone(),
                found: second.clone(),
                expected: first.clone(),
            });
        }
        let (Some(named), Some(others)) = (self.by_name()?, other.by_name()?)
        else {
            return Ok((a.to_vec(), b.to_vec(), false));
        };
        self.refuse_lone(&named, &others)?;
        other.refuse_lone(&others, &named)?;
        let names = self.names.iter().flatten();
        let second = names.map(|name| b[others[name.as_str()]]).collect();
        Ok((a.to_vec(), second, true))
    }

    /// Places of the values by the names behind them; `None` where a value
    /// has no name.
    fn by_name(
        &self,
    ) -> Result<Option<BTreeMap<&str, usize>>, SampleFileError> {
        let mut places = BTreeMap::new();
        for (place, name) in self.names.iter().enumerate() {
            let Some(name) = name else { return Ok(None) };
            if places.insert(name.as_str(), place).is_some() {
                return Err(self.name_error(place, "twice in the file"));
            }
        }
        Ok(Some(places))
    }

    /// Refuses a record that the other file has not.
    fn refuse_lone(
        &self,
        own: &BTreeMap<&str, usize>,
        others: &BTreeMap<&str, usize>,
    ) -> Result<(), SampleFileError> {
        match own.iter().find(|(name, _)| !others.contains_key(*name)) {
            None => Ok(()),
            Some((_, place)) => {
                Err(self.name_error(*place, "not in the other file"))
            }
        }
    }

    fn name_error(&self, place: usize, what: &'static str) -> SampleFileError {
        SampleFileError::Name {
            path: self.path.clone(),
            line: self.lines[place],
            name: self.names[place].clone().unwrap_or_default(),
            what,
        }
    }

    /// The limits of the values that are censored at one of their own, in
    /// the order of the lines.
    #[must_use]
    pub fn limits(&self) -> &[Option<f64>] {
        &self.limits
    }

    /// What the file says that its values are, in words.
    #[must_use]
    pub fn of(&self) -> Option<&str> {
        self.of.as_deref()
    }

    /// The intensity measure, that of the file or the one given; `None`
    /// where neither says one.
    ///
    /// # Errors
    /// [`SampleFileError::Measure`] where they differ.
    pub fn im(
        &self,
        given: Option<&IntensityMeasure>,
    ) -> Result<Option<IntensityMeasure>, SampleFileError> {
        let words = self.of().and_then(|of| of.split(" at EDP ").next());
        let found = words.and_then(IntensityMeasure::of_words);
        match (self.of(), given) {
            (Some(of), Some(given)) if found.as_ref() != Some(given) => {
                Err(SampleFileError::Measure {
                    path: self.path.clone(),
                    found: of.to_owned(),
                    given: given.to_string(),
                })
            }
            _ => Ok(found.or(given.cloned())),
        }
    }

    /// The dimensionless intensity measure.
    ///
    /// # Errors
    /// As [`im`](Self::im).
    pub fn measure(
        &self,
        given: Option<Intensity>,
    ) -> Result<Option<Intensity>, SampleFileError> {
        let given = given.map(IntensityMeasure::from);
        let found = self.im(given.as_ref())?;
        Ok(found.and_then(|im| im.dimensionless()))
    }

    /// The block and model that the file says.
    #[must_use]
    pub fn setting(&self) -> SampleSetting {
        self.setting
    }

    /// The values in the order of the lines, infinite where censored.
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

    /// The values with the limits of the censored ones.
    ///
    /// # Errors
    /// [`SampleFileError::Sample`] if one is minus infinity or there is none.
    pub fn censored(&self) -> Result<CensoredSample, SampleFileError> {
        CensoredSample::try_new(&self.values, &self.limits)
            .map_err(|e| self.refuse(e))
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

/// A value, infinite where it is censored, and the limit behind `>`.
fn parse(text: &str) -> Option<(f64, Option<f64>)> {
    let Some(limit) = text.strip_prefix('>') else {
        return number(text).map(|value| (value, None));
    };
    let limit = number(limit.trim()).filter(|x| x.is_finite())?;
    Some((f64::INFINITY, Some(limit)))
}

/// A number, or infinity where the text says so: a number too large for a
/// double is not silently infinite.
fn number(text: &str) -> Option<f64> {
    let value = text.parse::<f64>().ok().filter(|x| !x.is_nan())?;
    let says_so = text.to_ascii_lowercase().contains("inf");
    (value.is_finite() || says_so).then_some(value)
}
