//! What a case inherits: the defaults of its method and of its family, and
//! those of every case.

use std::collections::{BTreeMap, BTreeSet};

use serde::Deserialize;
use toml::{Table, Value};

use super::attainable::{entry_of, resolve};
use super::case::Family;
use super::error::CaseFault;

/// Tables that are merged key by key. Every other value, a bound or a list
/// too, replaces the inherited one as a whole.
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

/// Values by path, down to where they are merged.
type Flat = BTreeMap<Path, Value>;

/// Defaults, the later ones over the earlier ones.
pub(super) struct Defaults {
    method: Option<String>,
    layers: Vec<Layer>,
}

struct Layer {
    /// As it stands in the file.
    name: String,
    values: Flat,
    /// What at least one case has inherited.
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

impl Defaults {
    /// The defaults of a family.
    pub fn new(family: Family) -> Self {
        let all = toml::toml! {
            cost = "quick"
            status.expect = "pass"
        };
        let method = family.default.get("method").and_then(Value::as_str);
        let method = method.map(str::to_owned);
        let mut layers = vec![
            Layer::new(String::new(), all),
            Layer::new("[family.default]".to_owned(), family.default),
        ];
        for (method, table) in family.method {
            layers.push(Layer::new(of_method(&method), table));
        }
        Self { method, layers }
    }

    /// The case with what it inherits.
    ///
    /// # Errors
    /// [`CaseFault`] for a value that equals the inherited one, for a
    /// quantity in `without` that is not inherited, and for bounds that
    /// cannot be computed.
    pub fn complete(&mut self, case: Table) -> Result<Table, CaseFault> {
        let named = case.get("name").and_then(Value::as_str);
        let name = format!("case `{}`", named.unwrap_or_default());
        let stated = case.get("method").and_then(Value::as_str);
        let method = stated.or(self.method.as_deref()).map(of_method);
        let entry = entry_of(&case);
        let mut found = ValueLayers::default();
        for (index, layer) in self.layers.iter().enumerate() {
            if index < 2 || Some(&layer.name) == method.as_ref() {
                let values = layer.values.clone();
                self.lay(&mut found, index, values, &layer.name, &entry)?;
            }
        }
        let (own, case) = (self.layers.len(), Layer::new(name, case));
        self.lay(&mut found, own, case.values, &case.name, &entry)?;
        let mut table = Table::new();
        for (path, (index, value)) in found {
            insert(&mut table, &path, value);
            if let Some(layer) = self.layers.get_mut(index) {
                layer.used.insert(path);
            }
        }
        Ok(table)
    }

    /// Lays the values of a layer over those found below it.
    fn lay(
        &self,
        found: &mut ValueLayers,
        index: usize,
        mut values: Flat,
        place: &str,
        entry: &Result<String, String>,
    ) -> Result<(), CaseFault> {
        for name in without(&mut values) {
            let path = path(&["tolerance", "bounds", &name]);
            if found.remove(&path).is_none() {
                let place = place.to_owned();
                return Err(CaseFault::Absent { place, name });
            }
        }
        // Another document, and another basis, bring their own words.
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
            resolve(entry, path, value).map_err(|message| {
                let key = path.join(".");
                CaseFault::Form(format!("{place}: {key}: {message}"))
            })?;
            if found.get(path).is_some_and(|(_, below)| below == value) {
                let (place, key) = (place.to_owned(), path.join("."));
                return Err(CaseFault::Repeated { place, key });
            }
        }
        found.extend(values.into_iter().map(|(p, v)| (p, (index, v))));
        Ok(())
    }

    /// Refuses a default that no case has inherited.
    ///
    /// # Errors
    /// [`CaseFault::Idle`] with the first one.
    pub fn all_used(&self) -> Result<(), CaseFault> {
        for layer in &self.layers[1..] {
            let idle = |path: &&Path| !layer.used.contains(*path);
            if let Some(path) = layer.values.keys().find(idle) {
                let (place, key) = (layer.name.clone(), path.join("."));
                return Err(CaseFault::Idle { place, key });
            }
        }
        Ok(())
    }
}

/// Values with the number of the layer that gave each.
type ValueLayers = BTreeMap<Path, (usize, Value)>;

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
    match path {
        [key] => {
            table.insert(key.clone(), value);
        }
        [key, rest @ ..] => {
            let inner = table.entry(key.clone());
            let inner = inner.or_insert_with(|| Table::new().into());
            if let Value::Table(inner) = inner {
                insert(inner, rest, value);
            }
        }
        [] => {}
    }
}

/// Takes the list of quantities whose inherited bound is not wanted; what is
/// no list of names stays, to be refused as an unknown key.
fn without(values: &mut Flat) -> Vec<String> {
    let key = path(&["tolerance", "without"]);
    let names = values.get(&key).and_then(|v| v.clone().try_into().ok());
    if names.is_some() {
        values.remove(&key);
    }
    names.unwrap_or_default()
}

/// An entry of a reference: by name, or with a claim of its own.
#[derive(Deserialize)]
#[serde(untagged, expecting = "expected names or pairs of name and claim")]
enum EntryName {
    Name(String),
    Claimed([String; 2]),
}

/// One case for each of the `entries` of a declaration, named after it in
/// lower case; the declaration itself where it has none.
///
/// # Errors
/// What is wrong, in words.
pub(super) fn expand(mut declared: Table) -> Result<Vec<Table>, String> {
    let Some(entries) = declared.remove("entries") else {
        return Ok(vec![declared]);
    };
    let entries: Vec<EntryName> = entries
        .try_into()
        .map_err(|error| format!("`entries`: {}", error.message()))?;
    if entries.is_empty() {
        return Err("`entries`: none".to_owned());
    }
    let mut cases = Vec::with_capacity(entries.len());
    for named in entries {
        let mut case = declared.clone();
        let (entry, claim) = match named {
            EntryName::Name(entry) => (entry, None),
            EntryName::Claimed([entry, claim]) => (entry, Some(claim)),
        };
        let twice = |key: &str| format!("entry `{entry}`: `{key}` twice");
        if case.insert("name".into(), entry.to_lowercase().into()).is_some() {
            return Err(twice("name"));
        }
        if let Some(claim) = claim
            && case.insert("claim".into(), claim.into()).is_some()
        {
            return Err(twice("claim"));
        }
        let input = case.entry("input").or_insert_with(|| Table::new().into());
        let input = input.as_table_mut();
        let input = input.ok_or_else(|| format!("entry `{entry}`: input"))?;
        if input.insert("entry".into(), entry.clone().into()).is_some() {
            return Err(twice("input.entry"));
        }
        cases.push(case);
    }
    Ok(cases)
}
