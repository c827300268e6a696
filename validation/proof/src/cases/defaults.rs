//! Values that a case inherits: the defaults of its method, of its family and
//! of every case.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, Result, bail, ensure};
use serde::Deserialize;
use toml::{Table, Value};

use super::attainable::resolve;
use super::case::Family;

/// Tables that are merged key by key. Every other value, including a bound or
/// a list, replaces the inherited one as a whole.
const MERGED: &[&[&str]] = &[
    &["source"],
    &["expect"],
    &["expect", "values"],
    &["input"],
    &["tolerance"],
    &["tolerance", "bounds"],
];

/// Names of the keys that lead to a value.
type Path = Vec<String>;

/// Values by path, down to the level at which they are merged.
type Flat = BTreeMap<Path, Value>;

/// Values with the number of the layer that gave each.
type ValueLayers = BTreeMap<Path, (usize, Value)>;

/// Layers of defaults; a later one overrides an earlier one.
pub(super) struct Defaults {
    /// The default method of the family; empty if there is none.
    method: String,
    layers: Vec<Layer>,
}

struct Layer {
    /// Name of its table in the file.
    name: String,
    values: Flat,
    /// Paths that at least one case has inherited.
    used: BTreeSet<Path>,
}

impl Layer {
    fn new(name: String, table: Table) -> Self {
        let mut values = Flat::new();
        flatten(table, &mut Vec::new(), &mut values);
        Self { name, values, used: BTreeSet::new() }
    }
}

/// Name of the layer with the defaults of a method.
fn of_method(method: &str) -> String {
    format!("[family.method.{method}]")
}

/// The text of a key; empty if there is none.
pub(super) fn text<'a>(table: &'a Table, key: &str) -> &'a str {
    table.get(key).and_then(Value::as_str).unwrap_or_default()
}

impl Defaults {
    /// The defaults of a family.
    pub fn new(family: Family) -> Self {
        let method = text(&family.default, "method").to_owned();
        let all = toml::toml! { cost = "quick" };
        let mut layers = vec![
            Layer::new(String::new(), all),
            Layer::new("[family.default]".to_owned(), family.default),
        ];
        for (method, table) in family.method {
            layers.push(Layer::new(of_method(&method), table));
        }
        Self { method, layers }
    }

    /// The case with the values that it inherits.
    ///
    /// # Errors
    /// A message for a value that equals the inherited one, for a quantity in
    /// `without` that is not inherited, and for bounds that cannot be
    /// computed.
    pub fn complete(&mut self, case: Table) -> Result<Table> {
        let name = text(&case, "name").to_owned();
        let method = match text(&case, "method") {
            "" => of_method(&self.method),
            own => of_method(own),
        };
        let entry = case.get("input").and_then(|input| input.get("entry"));
        let entry = entry.and_then(Value::as_str).map(str::to_owned);
        let entry = entry.ok_or_else(|| {
            format!("the input of `{name}` names no `entry` of a reference")
        });
        let mut found = ValueLayers::default();
        for (index, layer) in self.layers.iter().enumerate() {
            if index < 2 || layer.name == method {
                lay(&mut found, index, layer, &entry)?;
            }
        }
        let own = Layer::new(format!("case `{name}`"), case);
        lay(&mut found, self.layers.len(), &own, &entry)?;
        let mut table = Table::new();
        for (path, (index, value)) in found {
            insert(&mut table, &path, value);
            if let Some(layer) = self.layers.get_mut(index) {
                layer.used.insert(path);
            }
        }
        Ok(table)
    }

    /// Refuses a default that no case has inherited.
    ///
    /// # Errors
    /// A message that names the first of these defaults.
    pub fn all_used(&self) -> Result<()> {
        for layer in &self.layers[1..] {
            let idle = |path: &&Path| !layer.used.contains(*path);
            if let Some(path) = layer.values.keys().find(idle) {
                let (place, key) = (&layer.name, path.join("."));
                bail!("{place}: no case inherits `{key}`");
            }
        }
        Ok(())
    }
}

/// Lays the values of a layer over those of the layers below it.
fn lay(
    found: &mut ValueLayers,
    index: usize,
    layer: &Layer,
    entry: &Result<String, String>,
) -> Result<()> {
    let (place, mut values) = (&layer.name, layer.values.clone());
    for name in without(&mut values) {
        ensure!(
            found.remove(&path(&["tolerance", "bounds", &name])).is_some(),
            "{place}: `tolerance.without` names `{name}`, whose bound is not \
             inherited"
        );
    }
    // Another document or another basis needs other words.
    let other = |found: &ValueLayers, keys: &[&str]| {
        let path = path(keys);
        let below = found.get(&path).map(|(_, value)| value);
        values.get(&path).is_some_and(|value| below != Some(value))
    };
    if other(found, &["source", "cite"]) {
        found.retain(|path, _| path[0] != "source");
    }
    if other(found, &["tolerance", "basis"]) {
        found.remove(&path(&["tolerance", "because"]));
    }
    for (path, value) in &mut values {
        let key = path.join(".");
        resolve(entry, path, value)
            .with_context(|| format!("{place}: {key}"))?;
        ensure!(
            found.get(path).is_none_or(|(_, below)| below != value),
            "{place}: `{key}` repeats the inherited value: leave it out"
        );
    }
    found.extend(values.into_iter().map(|(p, v)| (p, (index, v))));
    Ok(())
}

fn path(keys: &[&str]) -> Path {
    keys.iter().map(|key| (*key).to_owned()).collect()
}

fn flatten(table: Table, path: &mut Path, values: &mut Flat) {
    for (key, value) in table {
        path.push(key);
        match value {
            Value::Table(inner) if MERGED.iter().any(|m| *m == *path) => {
                flatten(inner, path, values);
            }
            value => {
                values.insert(path.clone(), value);
            }
        }
        path.pop();
    }
}

fn insert(table: &mut Table, path: &[String], value: Value) {
    let Some((key, rest)) = path.split_first() else { return };
    if rest.is_empty() {
        table.insert(key.clone(), value);
        return;
    }
    let inner = table.entry(key.clone());
    let inner = inner.or_insert_with(|| Table::new().into());
    if let Value::Table(inner) = inner {
        insert(inner, rest, value);
    }
}

/// Takes out the list of quantities whose inherited bound is dropped. A value
/// that is no list of names stays, to be refused as an unknown key.
fn without(values: &mut Flat) -> Vec<String> {
    let key = path(&["tolerance", "without"]);
    let names = values.get(&key).and_then(|v| v.clone().try_into().ok());
    if names.is_some() {
        values.remove(&key);
    }
    names.unwrap_or_default()
}

/// An entry of a reference: a name, or a name and a claim.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected names or pairs of name and claim")]
enum EntryName {
    Name(String),
    Claimed([String; 2]),
}

/// One case for each of the `entries` of a declaration, with the entry in
/// lower case as its name; the declaration itself if it has no `entries`.
///
/// # Errors
/// A message for entries that are malformed or contradict the declaration.
pub(super) fn expand(mut declared: Table) -> Result<Vec<Table>> {
    let Some(entries) = declared.remove("entries") else {
        return Ok(vec![declared]);
    };
    let entries: Vec<EntryName> = entries.try_into().context("`entries`")?;
    ensure!(!entries.is_empty(), "`entries`: none");
    let case = |named| {
        let mut case = declared.clone();
        let (entry, claim) = match named {
            EntryName::Name(entry) => (entry, None),
            EntryName::Claimed([entry, claim]) => (entry, Some(claim)),
        };
        let input = case.entry("input").or_insert_with(|| Table::new().into());
        let input = input.as_table_mut();
        let input =
            input.with_context(|| format!("entry `{entry}`: input"))?;
        let twice = input.insert("entry".into(), entry.clone().into());
        ensure!(twice.is_none(), "entry `{entry}`: `input.entry` twice");
        let name = ("name", Some(entry.to_lowercase()));
        for (key, value) in [name, ("claim", claim)] {
            let Some(value) = value else { continue };
            let twice = case.insert(key.into(), value.into());
            ensure!(twice.is_none(), "entry `{entry}`: `{key}` twice");
        }
        Ok(case)
    };
    entries.into_iter().map(case).collect()
}
