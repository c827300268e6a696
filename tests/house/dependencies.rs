//! Every dependency is used and explained, and the core has few.

use std::collections::BTreeSet;

use toml::Table;

use super::{files, pass, read, sources, table};

/// The crates that the user of this project named.
const NAMED: &str =
    "insta nalgebra plotters proptest rand rand_distr rayon statrs";

/// Crates that the command names for their features alone.
const ALIGNED: &str = "getrandom once_cell rand";

/// Names in the tables of dependencies of a manifest.
fn dependencies(manifest: &Table) -> BTreeSet<String> {
    let mut found = BTreeSet::new();
    for (key, value) in manifest {
        let Some(inner) = value.as_table() else { continue };
        if key.ends_with("dependencies") {
            found.extend(inner.keys().cloned());
        } else if key == "target" || key.starts_with("cfg") {
            found.extend(dependencies(inner));
        }
    }
    found
}

#[test]
fn every_dependency_is_used_and_explained() {
    let core: Table = read("Cargo.toml").parse().unwrap();
    let few = ["libm", "rayon", "serde", "thiserror"];
    let own = core["dependencies"].as_table().unwrap();
    assert!(own.keys().eq(few), "{own:?}");
    let (mut problems, mut direct) = (Vec::new(), dependencies(&core));
    let all = ["crates", "validation", "fixtures", "tests/unit"].into_iter();
    for path in all.flat_map(files) {
        let Some(folder) = path.strip_suffix("/Cargo.toml") else { continue };
        let manifest: Table = read(&path).parse().unwrap();
        if !manifest.contains_key("lints") {
            problems.push(format!("{folder}: no lints"));
        }
        // Sources that lie in other folders.
        let others: &[&str] = match folder {
            "tests/unit" => &["src", "crates", "tests"],
            "validation/command" => &["tests"],
            _ => &[],
        };
        let folders = [&[folder], others].concat();
        let text: String =
            sources(&folders).iter().map(|path| read(path)).collect();
        for name in dependencies(&manifest) {
            let is_used = text.contains(&name.replace('-', "_"));
            if !is_used && !ALIGNED.split(' ').any(|own| own == name) {
                problems.push(format!("{folder}: {name} is not used"));
            }
            direct.insert(name);
        }
    }
    let rows = table(&read("docs/repository.md"), "## Dependencies");
    // Behind the head and the rule below it.
    let whole = |row: &&Vec<String>| !row[1].is_empty() && row[2].len() > 1;
    let rows = rows.iter().skip(2).filter(whole);
    let explained: BTreeSet<String> = rows.map(|r| r[0].clone()).collect();
    for name in direct.symmetric_difference(&explained) {
        problems.push(format!("{name}: a dependency, or a row alone"));
    }
    pass(&problems);
    assert!(NAMED.split(' ').all(|name| direct.contains(name)), "{direct:?}");
}
