//! Finds and reads what is to be compared; refuses what it does not know.

use std::path::{Path, PathBuf};

use anyhow::{anyhow, bail};
use serde_json::{Map, Value};

use rocking_common::files::is_interrupted;
use rocking_common::findings::Findings;

use super::flaw::{flaw, kind};
use super::item::Item;
use super::strict::Strict;
use super::{cases, findings};

/// Names of the files that can be compared.
const NAMES: [&str; 2] = ["findings.json", "validation.json"];

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
    /// For what is missing, no JSON, or JSON of another form.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        let mut results = Self::none(path);
        let shown = path.display();
        if !std::fs::metadata(path).map_err(|e| unread(path, &e))?.is_dir() {
            results.add(path)?;
            return Ok(results);
        }
        if is_interrupted(path) {
            bail!(
                "{shown}: files of two runs: expected a folder that was \
                 written to its end"
            );
        }
        for name in NAMES {
            let places = [path.join(name), path.join("data").join(name)];
            let mut there = places.iter().filter(|place| place.exists());
            let Some(place) = there.next() else { continue };
            if there.next().is_some() {
                bail!(
                    "{shown}: {name}: found it in the folder and in its \
                     folder data, expected one of them"
                );
            }
            results.add(place)?;
        }
        if results.findings.is_none() && results.cases.is_none() {
            bail!(
                "{shown}: no results there, expected findings.json or \
                 validation.json in it or in its folder data"
            );
        }
        Ok(results)
    }

    fn none(path: &Path) -> Self {
        Self { path: path.to_owned(), findings: None, cases: None }
    }

    fn add(&mut self, path: &Path) -> anyhow::Result<()> {
        let text =
            std::fs::read_to_string(path).map_err(|e| unread(path, &e))?;
        self.parse(&text).map_err(|e| anyhow!("{}: {e}", path.display()))
    }

    /// Results from the text of a file; `path` only appears in messages.
    ///
    /// # Errors
    /// For what is no JSON, or JSON of another form.
    pub fn from_text(path: &Path, text: &str) -> anyhow::Result<Self> {
        let mut results = Self::none(path);
        let parsed = results.parse(text);
        parsed.map_err(|e| anyhow!("{}: {e}", path.display()))?;
        Ok(results)
    }

    fn parse(&mut self, text: &str) -> anyhow::Result<()> {
        let parsed: Result<Strict, _> = serde_json::from_str(text);
        let Strict(value) =
            parsed.map_err(|e| anyhow!("{e}, expected JSON"))?;
        let expected = "findings of a study or results of declared cases";
        let Value::Object(map) = &value else {
            return Err(flaw("top", kind(&value), expected));
        };
        if map.contains_key("claims") {
            let findings =
                Findings::parse(text).map_err(anyhow::Error::msg)?;
            self.findings = Some(findings::items(&findings)?);
        } else if looks_like_cases(map) {
            self.cases = Some(cases::items(map)?);
        } else {
            let keys: Vec<&str> =
                map.keys().take(3).map(String::as_str).collect();
            let found = format!("the keys `{}`", keys.join("`, `"));
            return Err(flaw("top", &found, expected));
        }
        Ok(())
    }
}

/// What the system said, and what was expected.
fn unread(path: &Path, error: &std::io::Error) -> anyhow::Error {
    anyhow!(
        "{}: {error}; expected findings.json, validation.json, or a folder \
         with one of them",
        path.display()
    )
}

fn looks_like_cases(map: &Map<String, Value>) -> bool {
    !map.is_empty() && map.values().all(|v| v.get("verdict").is_some())
}
