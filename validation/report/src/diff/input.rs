//! Finds and reads the results to compare.

use std::path::{Path, PathBuf};

use anyhow::{Context as _, bail};
use serde::Deserialize;
use serde_json::{Map, Value, json};

use rocking_common::files::{SUMS, is_whole};
use rocking_common::findings::{Effect, Findings, Seen};
use rocking_common::json::{Extended, extended};
use rocking_proof::verdict::snapshot::{self, QuantityResult};

use super::number::LAST_DIGIT;
use crate::answers::answers;
use crate::output::{FINDINGS, PAGE};
use crate::sentences::first_arm;

/// Names of the files that can be compared.
pub(super) const NAMES: [&str; 2] = ["findings.json", "verification.json"];

/// The expected content of a file of results.
const EXPECTED: &str =
    "expected findings of a study or results of reference cases";

/// The results of one side.
#[derive(Debug, Default)]
pub struct ResultFiles {
    /// The file or folder that was read.
    pub path: PathBuf,
    /// The tree of each of the files that can be compared.
    pub(super) trees: [Option<Value>; 2],
}

impl ResultFiles {
    /// Reads a file, or the results in a folder or in its folder `data`.
    ///
    /// # Errors
    /// For a missing file, and for text that is not JSON or has another form.
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
            match places.map(|place| (place.exists(), place)) {
                [(true, _), (true, _)] => bail!(
                    "{shown}: {name}: found it in the folder and in its \
                     folder data, expected one of them"
                ),
                [(true, place), _] | [_, (true, place)] => {
                    results.add(&place)?;
                }
                _ => {}
            }
        }
        if results.trees.iter().all(Option::is_none) {
            bail!(
                "{shown}: no results there, expected findings.json or \
                 verification.json in it or in its folder data"
            );
        }
        Ok(results)
    }

    fn add(&mut self, path: &Path) -> anyhow::Result<()> {
        let read = std::fs::read_to_string(path);
        let read = read.with_context(|| unread(path))?;
        self.parse(&read).with_context(|| path.display().to_string())?;
        if let Some(tree) = &mut self.trees[0] {
            let beside = path.with_file_name("figure-11.csv");
            // Only those of one grid are compared.
            let arm = text(tree.get("arm"));
            tree["overturnings"] = json!({ arm: overturnings(&beside) });
        }
        Ok(())
    }

    /// Results from the text of a file; `path` only appears in messages.
    ///
    /// # Errors
    /// For text that is not JSON or has another form.
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
            self.trees[0] = Some(tree(&read)?);
            return Ok(());
        }
        let read: snapshot::Results =
            serde_json::from_str(text).context(EXPECTED)?;
        if read.is_empty() {
            bail!("found no results, {EXPECTED}");
        }
        for (id, case) in &read {
            for (name, q) in &case.quantities {
                bounded(q, 0.0).with_context(|| format!("{id}: {name}"))?;
            }
        }
        self.trees[1] = Some(json!({ "cases": read }));
        Ok(())
    }
}

/// The findings of a study, and the answers based on them.
fn tree(findings: &Findings) -> anyhow::Result<Value> {
    let mut tree = serde_json::to_value(findings)?;
    named("findings", &mut tree)?;
    let answers = answers(findings)?.into_iter().map(|own| {
        let answer = json!({ "lead": own.lead.map(Seen::name), "sentence": own.answer });
        (own.question, answer)
    });
    tree["answers"] = Value::Object(answers.collect());
    tree["arm"] = json!(first_arm(findings));
    Ok(tree)
}

/// Lists whose elements have names, and the fields of the names.
const NAMED: [(&str, &[&str]); 7] = [
    ("suites", &["kind"]),
    ("list", &["name", "sha256"]),
    ("claims", &["id"]),
    ("results", &["suite", "arm"]),
    ("tables", &["topic"]),
    ("rows", &["at"]),
    ("questions", &["id"]),
];

/// Turns lists whose elements have names into maps.
fn named(name: &str, tree: &mut Value) -> anyhow::Result<()> {
    let own = NAMED.iter().find(|(list, _)| *list == name);
    if let (Value::Array(list), Some((_, fields))) = (&mut *tree, own) {
        let mut branches = Map::new();
        for element in list.drain(..) {
            let names = fields.iter().map(|field| text(element.get(field)));
            let key = names.collect::<Vec<_>>().join(", ");
            if branches.insert(key.clone(), element).is_some() {
                bail!("{name}: found {key} twice, expected it once");
            }
        }
        *tree = Value::Object(branches);
    }
    if let Value::Object(branches) = tree {
        branches.iter_mut().try_for_each(|(name, tree)| named(name, tree))?;
    }
    Ok(())
}

/// A value in words.
pub fn text(value: Option<&Value>) -> String {
    match value {
        None | Some(Value::Null) => "none".into(),
        Some(Value::String(text)) => text.clone(),
        Some(Value::Array(list)) => {
            let all = list.iter().map(|element| text(Some(element)));
            all.collect::<Vec<_>>().join(", ")
        }
        Some(other) => other.to_string(),
    }
}

/// The limit for a move of a value of a reference case: its tolerance, and the
/// last digit printed.
pub fn bounded(
    q: &QuantityResult,
    value: f64,
) -> anyhow::Result<Option<Effect>> {
    let bound = || Extended::deserialize(&q.bound).map(|bound| bound.0);
    let digit = LAST_DIGIT * value.abs();
    let tolerance = match q.kind.as_str() {
        "exact" => 0.0,
        "absolute" => bound()? + digit,
        "relative" => bound()? * value.abs() + digit,
        "order" | "interval" | "waived" => return Ok(None),
        other => bail!(
            "found bound {other}, expected exact, absolute, relative, order, \
             interval or waived"
        ),
    };
    Ok(Some(Effect::Absolute(tolerance)))
}

fn unread(path: &Path) -> String {
    let expected = "a folder with one of them";
    format!("{}: expected {}, or {expected}", path.display(), NAMES.join(", "))
}

/// A row of the data of Figure 11.
#[derive(Deserialize)]
struct CapacityRow {
    im: String,
    record: String,
    edp: f64,
    intensity: f64,
}

/// The first overturning intensities in the data of Figure 11: the
/// capacities at demand 1, in PGA.
fn overturnings(path: &Path) -> Map<String, Value> {
    let Ok(mut table) = csv::Reader::from_path(path) else {
        return Map::new();
    };
    let rows = table.deserialize::<CapacityRow>().filter_map(Result::ok);
    let ends = rows.filter(|row| row.im == "pga" && row.edp == 1.0);
    ends.map(|row| (row.record, extended(row.intensity))).collect()
}
