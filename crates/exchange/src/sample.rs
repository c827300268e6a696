//! Sample files: one value a line, `>3.2` for a value censored at 3.2, `inf`
//! for a value censored at an unknown limit, comments after `#`. The comment
//! behind a value is the name of its record, and a second comment the
//! earthquake: `1.8 # RSN6-180 # Imperial Valley-02`.

use std::fmt::{self, Display, Write as _};
use std::path::{Path, PathBuf};

use rocking::block::Block;
use rocking::capacity::{Capacity, CapacityError, InversionRule};
use rocking::integrator::Model;
use rocking_records::intensity::{Intensity, IntensityMeasure};
use rocking_statistics::{
    CensoredSample, Clusters, ExtendedSample, SampleError,
};

use crate::ida::{Curves, IdaTable};
use crate::read::FileError;

/// Largest relative difference between a parameter of a block and the
/// parameter of a sample: the median changes by about as much.
const MOST_DIFFERENT: f64 = 0.01;

/// Beginning of the line that describes the values.
const SAMPLE_OF: &str = "# Sample of ";

/// The block and model that a sample file names.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SampleSetting {
    /// Slenderness angle in rad; `None` for adjusted blocks.
    pub alpha_rad: Option<f64>,
    /// Frequency parameter in rad/s.
    pub p_rad_s: Option<f64>,
    /// Coefficient of restitution.
    pub eta: Option<f64>,
    /// Equation of motion.
    pub model: Option<Model>,
}

impl SampleSetting {
    /// The setting on the second comment line of `rocking capacities`.
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

    /// Checks that capacities of this setting apply to a block. Capacities in
    /// a dimensionless measure apply to any slenderness.
    ///
    /// # Errors
    /// The parameter that differs, in words.
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
                     {found}: expected the {name} of the block, within 1 %"
                ));
            }
        }
        Ok(())
    }
}

/// The stated parameters, to be put behind other words.
impl Display for SampleSetting {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (name, value, unit) in [
            ("alpha", self.alpha_rad, " rad"),
            ("p", self.p_rad_s, " rad/s"),
            ("eta", self.eta, ""),
        ] {
            if let Some(value) = value {
                write!(f, ", {name} {value}{unit}")?;
            }
        }
        Ok(())
    }
}

/// The values of a sample file in the order of its lines, with their line
/// numbers.
#[derive(Default)]
pub struct SampleFile {
    path: PathBuf,
    values: Vec<f64>,
    /// Limits of the censored values, if the file states them.
    limits: Vec<Option<f64>>,
    lines: Vec<u64>,
    /// Names behind the values.
    names: Vec<Option<String>>,
    /// Earthquakes behind the names.
    events: Vec<Option<String>>,
    /// Description of the values, if the file has one.
    of: Option<String>,
    /// The block and model that the file states.
    pub setting: SampleSetting,
}

impl SampleFile {
    /// Reads the text of a file; `path` is its name in messages.
    ///
    /// # Errors
    /// [`FileError`] for a line that is not one number.
    pub fn parse(text: &str, path: &Path) -> Result<Self, FileError> {
        let mut file = Self { path: path.to_owned(), ..Self::default() };
        for (line, text) in (1..).zip(text.lines()) {
            if let Some(words) = text.strip_prefix(SAMPLE_OF) {
                file.of = Some(words.trim().to_owned());
            }
            if let Some(found) = SampleSetting::of(text) {
                file.setting = found;
            }
            let mut parts = text.splitn(3, '#').map(str::trim);
            let [content, name, event] =
                [(); 3].map(|()| parts.next().unwrap_or(""));
            if content.is_empty() {
                continue;
            }
            let refuse = |found: &str, expected: &str| {
                let message = format!("found `{found}`: expected {expected}");
                FileError::new(path, line, message)
            };
            let (value, limit) = parse(content).ok_or_else(|| {
                let found: String = content.chars().take(40).collect();
                refuse(&found, "one number, >LIMIT or inf on the line")
            })?;
            file.values.push(value);
            file.limits.push(limit);
            file.lines.push(line);
            let known =
                |text: &str| (!text.is_empty()).then(|| text.to_owned());
            if let Some(first) = file.events.first()
                && first.is_none() != event.is_empty()
            {
                let expected = "VALUE # RECORD # EARTHQUAKE on every line \
                                with a value, or on none";
                return Err(refuse(text, expected));
            }
            file.names.push(known(name));
            file.events.push(known(event));
        }
        Ok(file)
    }

    /// The text of the file with the capacities of an analysis at an EDP
    /// level.
    ///
    /// # Errors
    /// [`CapacityError`] for an invalid level.
    pub fn text(
        table: &IdaTable,
        suite: &Curves,
        measure: &IntensityMeasure,
        level: f64,
        rule: InversionRule,
    ) -> Result<String, CapacityError> {
        let setting = &table.setting;
        let alpha_rad = table.alpha_rad();
        let alpha_rad = alpha_rad.map_or("adjusted".into(), |a| a.to_string());
        let mut text = format!(
            "{SAMPLE_OF}{} at EDP {level}, {rule} crossing\n\
             # alpha {} rad, p {} rad/s, eta {}, {}, overturned at {}, \
             {}, g {} m/s2, processing: {}, {}\n",
            measure.words(),
            alpha_rad,
            setting.p_rad_s,
            setting.eta,
            setting.model,
            setting.overturn,
            setting.by,
            setting.gravity_m_s2,
            setting.processing,
            setting.software,
        );
        let events = table.events();
        for (place, (record, curve)) in suite.curves.iter().enumerate() {
            let (before, im) = match curve.capacity(level, rule)? {
                Capacity::Reached(im) => ("", im),
                Capacity::Censored { above } => (">", above),
            };
            let im = suite.measured(im);
            // Writing to a string cannot fail.
            let _ = write!(text, "{before}{im} # {record}");
            if let Some(events) = &events {
                let _ = write!(text, " # {}", events[place]);
            }
            text.push('\n');
        }
        Ok(text)
    }

    /// Refuses another file that states another description of its values.
    ///
    /// # Errors
    /// [`FileError`] of the other file.
    pub fn same_kind(&self, other: &Self) -> Result<(), FileError> {
        if let (Some(expected), Some(found)) = (&self.of, &other.of)
            && expected != found
        {
            let message = format_args!(
                "a sample of {found}: expected one of {expected}, as the \
                 other file"
            );
            return Err(other.error(None, message));
        }
        Ok(())
    }

    /// Names of the records of the values; empty if a value has no name.
    pub fn records(&self) -> Vec<&str> {
        let names = self.names.iter().map(Option::as_deref);
        names.collect::<Option<_>>().unwrap_or_default()
    }

    /// Earthquakes of the values; empty if the file does not state them.
    pub fn events(&self) -> Vec<&str> {
        let events = self.events.iter().map(Option::as_deref);
        events.collect::<Option<_>>().unwrap_or_default()
    }

    /// A refusal of the file, or of the value at a place, from 0.
    pub fn error(
        &self,
        place: Option<usize>,
        message: impl Display,
    ) -> FileError {
        let line = place.and_then(|place| self.lines.get(place).copied());
        FileError::new(&self.path, line, message)
    }

    /// Description of the values in the file.
    pub fn of(&self) -> Option<&str> {
        self.of.as_deref()
    }

    /// The measure of the values, in the words of the file.
    pub fn unit(&self) -> Option<&str> {
        self.of().and_then(|of| of.split(" at EDP ").next())
    }

    /// The intensity measure of the file, or else the given one; `None`
    /// without either.
    ///
    /// # Errors
    /// [`FileError`] if they differ.
    pub fn im(
        &self,
        given: Option<&IntensityMeasure>,
    ) -> Result<Option<IntensityMeasure>, FileError> {
        let found = self.unit().and_then(IntensityMeasure::of_words);
        match (self.of(), given) {
            (Some(of), Some(given)) if found.as_ref() != Some(given) => {
                let message = format_args!(
                    "a sample of {of}, --im {given}: expected its own measure"
                );
                Err(self.error(None, message))
            }
            _ => Ok(found.or(given.cloned())),
        }
    }

    /// The values in the order of the lines, infinite if censored.
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The values by earthquake, if the file states it.
    pub fn clusters(&self) -> Clusters {
        match self.events().as_slice() {
            [] => Clusters::singletons(self.values.len()),
            events => Clusters::from_labels(events),
        }
    }

    /// The values as a sample with censored values.
    ///
    /// # Errors
    /// [`FileError`] if a value is minus infinity, or without values.
    pub fn extended(&self) -> Result<ExtendedSample, FileError> {
        ExtendedSample::try_new(&self.values).map_err(|e| self.refuse(e))
    }

    /// The values with the limits of the censored ones.
    ///
    /// # Errors
    /// [`FileError`] if a value is minus infinity, or without values.
    pub fn censored(&self) -> Result<CensoredSample, FileError> {
        CensoredSample::try_new(&self.values, &self.limits)
            .map_err(|e| self.refuse(e))
    }

    fn refuse(&self, error: SampleError) -> FileError {
        let place = match error {
            SampleError::NotFinite { number, .. }
            | SampleError::NotExtended { number, .. } => Some(number - 1),
            _ => None,
        };
        self.error(place, error)
    }
}

/// A value, infinite if it is censored, and the limit behind `>`.
fn parse(text: &str) -> Option<(f64, Option<f64>)> {
    let Some(limit) = text.strip_prefix('>') else {
        return number(text).map(|value| (value, None));
    };
    let limit = number(limit.trim()).filter(|x| x.is_finite())?;
    Some((f64::INFINITY, Some(limit)))
}

/// A number, or infinity if the text says `inf`: a number too large for a
/// double is not silently infinite.
fn number(text: &str) -> Option<f64> {
    let value = text.parse::<f64>().ok().filter(|x| !x.is_nan())?;
    let says_so = text.to_ascii_lowercase().contains("inf");
    (value.is_finite() || says_so).then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn earthquakes_stand_on_every_line_or_on_none() {
        let read = |text| SampleFile::parse(text, Path::new("s.txt"));
        let file = read("# c\n1.5 # a # X\n>2 # b # Y\n1 # c # X\n").unwrap();
        let clusters = file.clusters();
        assert_eq!((clusters.records(), clusters.count()), (3, 2));
        assert_eq!(file.records(), ["a", "b", "c"]);
        let plain = read("1.5 # a\n2\n").unwrap();
        assert!(plain.clusters().is_singletons());
        assert!(plain.records().is_empty());
        let Err(error) = read("1.5 # a # X\n2 # b\n") else { panic!() };
        let error = error.to_string();
        assert!(error.starts_with("s.txt:2: found `2 # b`"), "{error}");
    }
}
