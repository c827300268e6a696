//! Finds and reads what is to be compared; refuses what it does not know.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde::Deserialize;
use serde_json::Value;

use rocking_common::files::{SUMS, is_whole};
use rocking_common::findings::Findings;
use rocking_proof::verdict::snapshot;

use super::item::Item;
use super::{cases, findings};
use crate::output::{FINDINGS, PAGE};

/// Names of the files that can be compared.
pub(super) const NAMES: [&str; 2] = ["findings.json", "validation.json"];

/// What must stand in a file of results.
const EXPECTED: &str =
    "expected findings of a study or results of declared cases";

/// The results of one side.
#[derive(Debug, Default)]
pub struct Results {
    /// Where they were read.
    pub path: PathBuf,
    /// Findings of a study.
    pub findings: Option<Findings>,
    /// First overturning intensities of the block of Figure 11 by record,
    /// where the data of a study lie beside its findings.
    pub overturnings: BTreeMap<String, f64>,
    /// Items and normal text of each of the files that can be compared.
    pub(super) sheets: [Option<(Vec<Item>, String)>; 2],
}

impl Results {
    /// Reads a file, or what lies in a folder or in its folder `data`.
    ///
    /// # Errors
    /// For what is missing, no JSON, or JSON of another form.
    pub fn read(path: &Path) -> anyhow::Result<Self> {
        let mut results = Self { path: path.into(), ..Self::default() };
        let shown = path.display();
        let meta = std::fs::metadata(path).with_context(|| unread(path))?;
        if !meta.is_dir() {
            results.add(path)?;
            return Ok(results);
        }
        let is_known = is_whole(path).with_context(|| shown.to_string())?;
        let is_report =
            path.join(PAGE).exists() && path.join(FINDINGS).exists();
        if is_report && !is_known {
            bail!(
                "{shown}: no {SUMS}, so that its files may be of two runs: \
                 expected the one that `rocking study` writes beside its page"
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
        if results.sheets.iter().all(Option::is_none) {
            bail!(
                "{shown}: no results there, expected findings.json or \
                 validation.json in it or in its folder data"
            );
        }
        Ok(results)
    }

    fn add(&mut self, path: &Path) -> anyhow::Result<()> {
        let text =
            std::fs::read_to_string(path).with_context(|| unread(path))?;
        self.parse(&text).with_context(|| path.display().to_string())?;
        if self.findings.is_some() {
            let beside = path.with_file_name("figure-11.csv");
            self.overturnings = overturnings(&beside);
        }
        Ok(())
    }

    /// Results from the text of a file; `path` only appears in messages.
    ///
    /// # Errors
    /// For what is no JSON, or JSON of another form.
    pub fn from_text(path: &Path, text: &str) -> anyhow::Result<Self> {
        let mut results = Self { path: path.into(), ..Self::default() };
        let parsed = results.parse(text);
        parsed.with_context(|| path.display().to_string())?;
        Ok(results)
    }

    fn parse(&mut self, text: &str) -> anyhow::Result<()> {
        let value: Value =
            serde_json::from_str(text).context("expected JSON")?;
        if value.get("claims").is_some() {
            let read = Findings::parse(text).map_err(anyhow::Error::msg)?;
            self.sheets[0] = Some((findings::items(&read)?, read.text()));
            self.findings = Some(read);
            return Ok(());
        }
        let read: snapshot::Results =
            serde_json::from_str(text).context(EXPECTED)?;
        if read.is_empty() {
            bail!("found no results, {EXPECTED}");
        }
        let normal = serde_json::to_string(&read)?;
        self.sheets[1] = Some((cases::items(&read)?, normal));
        Ok(())
    }
}

fn unread(path: &Path) -> String {
    let expected = "a folder with one of them";
    format!("{}: expected {}, or {expected}", path.display(), NAMES.join(", "))
}

/// A row of the data of Figure 11.
#[derive(Deserialize)]
struct Capacity {
    im: String,
    record: String,
    edp: f64,
    intensity: f64,
}

/// The first overturning intensities in the data of Figure 11: the
/// capacities at demand 1, in PGA.
fn overturnings(path: &Path) -> BTreeMap<String, f64> {
    let Ok(mut table) = csv::Reader::from_path(path) else {
        return BTreeMap::new();
    };
    let rows = table.deserialize::<Capacity>().filter_map(Result::ok);
    let ends = rows.filter(|row| row.im == "pga" && row.edp == 1.0);
    ends.map(|row| (row.record, row.intensity)).collect()
}
