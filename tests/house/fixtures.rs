//! What lies in `fixtures`, and where it comes from.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;

use serde::Deserialize;
use sha2::{Digest as _, Sha256};

use super::{files, pass, read, root};

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
    let text = read("fixtures/MANIFEST.toml");
    let list: BTreeMap<String, Vec<Fixture>> = toml::from_str(&text).unwrap();
    let list = &list["file"];
    let (mut problems, mut listed) = (Vec::new(), BTreeSet::new());
    for entry in list {
        let path = format!("fixtures/{}", entry.path);
        let bytes = fs::read(root().join(&path)).unwrap_or_default();
        let found = format!("{:x}", Sha256::digest(&bytes));
        let texts = [&entry.origin, &entry.licence, &entry.units];
        if found != entry.sha256 || texts.iter().any(|t| t.trim().is_empty()) {
            problems.push(format!("{path}: a gap, or sha256 is {found}"));
        }
        // A generator is used by being the origin of another file.
        let generates = list.iter().any(|e| e.origin.contains(&path));
        if entry.used_by.is_empty() && !generates {
            problems.push(format!("{path}: nobody uses it"));
        }
        let name = path.rsplit('/').next().unwrap_or_default();
        for user in &entry.used_by {
            if !read(user).contains(name) {
                problems.push(format!("{path}: {user} doesn't name it"));
            }
        }
        if !listed.insert(path) {
            problems.push(format!("{}: twice", entry.path));
        }
    }
    // A page about a folder is not a fixture, nor is what makes it a crate.
    let about = ["MANIFEST.toml", "/README.md", "/Cargo.toml", "/src/lib.rs"];
    for path in files("fixtures") {
        if !about.iter().any(|end| path.ends_with(end))
            && !listed.contains(&path)
        {
            problems.push(format!("{path}: not in fixtures/MANIFEST.toml"));
        }
    }
    pass(&problems);
}
