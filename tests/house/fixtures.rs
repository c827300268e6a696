//! What lies in `fixtures`, and where it comes from.

use std::collections::BTreeSet;
use std::fs;

use serde::Deserialize;
use sha2::{Digest as _, Sha256};

use super::{files, pass, read, root};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fixtures {
    file: Vec<Fixture>,
}

/// One file of `fixtures`.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Fixture {
    path: String,
    origin: String,
    licence: String,
    units: String,
    sha256: String,
    used_by: Vec<String>,
}

#[test]
fn every_fixture_has_its_origin_licence_hash_and_user() {
    let list: Fixtures =
        toml::from_str(&read("fixtures/MANIFEST.toml")).unwrap();
    let mut problems = Vec::new();
    let mut listed = BTreeSet::new();
    for entry in &list.file {
        let path = format!("fixtures/{}", entry.path);
        if !listed.insert(path.clone()) {
            problems.push(format!("{path}: twice"));
        }
        let texts = [&entry.origin, &entry.licence, &entry.units];
        if texts.iter().any(|text| text.trim().is_empty()) {
            problems.push(format!("{path}: origin, licence or units empty"));
        }
        let Ok(bytes) = fs::read(root().join(&path)) else {
            problems.push(format!("{path}: no such file"));
            continue;
        };
        let found = format!("{:x}", Sha256::digest(&bytes));
        if found != entry.sha256 {
            problems.push(format!("{path}: sha256 is {found}"));
        }
        let name = path.rsplit('/').next().unwrap_or_default();
        // A generator is used by being the origin of another file.
        let generates = list.file.iter().any(|e| e.origin.contains(&path));
        if entry.used_by.is_empty() && !generates {
            problems.push(format!("{path}: nobody uses it"));
        }
        for user in &entry.used_by {
            let text =
                fs::read_to_string(root().join(user)).unwrap_or_default();
            if !text.contains(name) {
                problems.push(format!("{path}: {user} doesn't name it"));
            }
        }
    }
    for path in files("fixtures") {
        // A page about a folder is not a fixture, nor is what makes a crate
        // of the folder.
        let about = ["MANIFEST.toml", "/README.md", "/Cargo.toml"]
            .iter()
            .any(|end| path.ends_with(end))
            || path.starts_with("fixtures/src/");
        if !about && !listed.contains(&path) {
            problems.push(format!("{path}: not in fixtures/MANIFEST.toml"));
        }
    }
    pass(&problems);
}
