//! Finds and reads what is to be compared; refuses what it does not know.

use std::io;
use std::path::{Path, PathBuf};

use serde_json::{Map, Value};
use thiserror::Error;

use rocking_common::files::is_interrupted;
use rocking_common::findings::Findings;

use super::flaw::{Flaw, kind};
use super::item::Item;
use super::strict::Strict;
use super::{cases, findings};

/// Names of the files that can be compared.
const NAMES: [&str; 2] = ["findings.json", "validation.json"];

/// Why results cannot be compared.
#[derive(Debug, Error)]
#[non_exhaustive]
pub enum DiffError {
    /// A file or folder is not there or cannot be read.
    #[error(
        "{}: {source}; expected findings.json, validation.json, or a folder \
         with one of them",
        path.display()
    )]
    Read {
        /// The path.
        path: PathBuf,
        /// What the system said.
        #[source]
        source: io::Error,
    },
    /// A run was killed while it put its files into place.
    #[error(
        "{}: files of two runs: expected a folder that was written to its end",
        path.display()
    )]
    Interrupted {
        /// The folder.
        path: PathBuf,
    },
    /// A folder has no results.
    #[error(
        "{}: no results there, expected findings.json or validation.json in \
         it or in its folder data",
        path.display()
    )]
    NoResults {
        /// The folder.
        path: PathBuf,
    },
    /// A file is no JSON.
    #[error("{}: {message}, expected JSON", path.display())]
    Json {
        /// The file.
        path: PathBuf,
        /// What is wrong, with line and column.
        message: String,
    },
    /// A file of findings is not what it should be, or of another schema.
    #[error("{}: {message}", path.display())]
    Findings {
        /// The file.
        path: PathBuf,
        /// What was found, with line and column where there are such.
        message: String,
    },
    /// A file of JSON is not what it should be.
    #[error("{}: {place}: found {found}, expected {expected}", path.display())]
    Shape {
        /// The file.
        path: PathBuf,
        /// Where in the file.
        place: String,
        /// What stands there.
        found: String,
        /// What should.
        expected: String,
    },
    /// One side has findings, the other results of cases.
    #[error(
        "{} and {} have nothing in common: expected findings on both sides, \
         or results of cases on both",
        old.display(),
        new.display()
    )]
    NothingInCommon {
        /// One side.
        old: PathBuf,
        /// The other.
        new: PathBuf,
    },
}

/// The results of one side.
#[derive(Debug)]
pub struct Results {
    /// Where they were read.
    pub path: PathBuf,
    /// Findings of a study.
    pub findings: Option<Vec<Item>>,
    /// Results of declared cases.
    pub cases: Option<Vec<Item>>,
}

impl Results {
    /// Reads a file, or what lies in a folder or in its folder `data`.
    ///
    /// # Errors
    /// [`DiffError`] for what is missing, no JSON, or JSON of another form.
    pub fn read(path: &Path) -> Result<Self, DiffError> {
        let mut results =
            Self { path: path.to_owned(), findings: None, cases: None };
        let failed =
            |source| DiffError::Read { path: path.to_owned(), source };
        if !std::fs::metadata(path).map_err(failed)?.is_dir() {
            results.add(path)?;
            return Ok(results);
        }
        if is_interrupted(path) {
            return Err(DiffError::Interrupted { path: path.to_owned() });
        }
        for name in NAMES {
            let places = [path.join(name), path.join("data").join(name)];
            let mut there = places.iter().filter(|place| place.exists());
            let Some(place) = there.next() else { continue };
            if there.next().is_some() {
                return Err(DiffError::Shape {
                    path: path.to_owned(),
                    place: name.into(),
                    found: "it in the folder and in its folder data".into(),
                    expected: "one of them".into(),
                });
            }
            results.add(place)?;
        }
        if results.findings.is_none() && results.cases.is_none() {
            return Err(DiffError::NoResults { path: path.to_owned() });
        }
        Ok(results)
    }

    fn add(&mut self, path: &Path) -> Result<(), DiffError> {
        let failed =
            |source| DiffError::Read { path: path.to_owned(), source };
        let text = std::fs::read_to_string(path).map_err(failed)?;
        self.parse(path, &text)
    }

    /// Results from the text of a file; `path` is only told in messages.
    ///
    /// # Errors
    /// [`DiffError`] for what is no JSON, or JSON of another form.
    pub fn from_text(path: &Path, text: &str) -> Result<Self, DiffError> {
        let mut results =
            Self { path: path.to_owned(), findings: None, cases: None };
        results.parse(path, text)?;
        Ok(results)
    }

    fn parse(&mut self, path: &Path, text: &str) -> Result<(), DiffError> {
        let parsed: Result<Strict, _> = serde_json::from_str(text);
        let Strict(value) = parsed.map_err(|e| DiffError::Json {
            path: path.to_owned(),
            message: e.to_string(),
        })?;
        let shape = |flaw: Flaw| DiffError::Shape {
            path: path.to_owned(),
            place: flaw.place,
            found: flaw.found,
            expected: flaw.expected,
        };
        let expected = "findings of a study or results of declared cases";
        let Value::Object(map) = &value else {
            return Err(shape(Flaw::new("top", kind(&value), expected)));
        };
        if map.contains_key("claims") {
            let findings = Findings::parse(text).map_err(|message| {
                DiffError::Findings { path: path.to_owned(), message }
            })?;
            self.findings = Some(findings::items(&findings).map_err(shape)?);
        } else if looks_like_cases(map) {
            self.cases = Some(cases::items(map).map_err(shape)?);
        } else {
            let keys: Vec<&str> =
                map.keys().take(3).map(String::as_str).collect();
            let found = format!("the keys `{}`", keys.join("`, `"));
            return Err(shape(Flaw::new("top", found, expected)));
        }
        Ok(())
    }
}

fn looks_like_cases(map: &Map<String, Value>) -> bool {
    !map.is_empty() && map.values().all(|v| v.get("verdict").is_some())
}
