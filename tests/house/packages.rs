//! What a registry gets of each crate.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use super::{LIBRARIES, Manifest, manifest, pass, read, root};

/// Files of a crate's package.
fn package(name: &str) -> BTreeSet<PathBuf> {
    let list = ["package", "--list", "--allow-dirty", "--offline", "--quiet"];
    let output = Command::new(env!("CARGO"))
        .args(list)
        .args(["--package", name])
        .current_dir(root())
        .output()
        .unwrap();
    let words = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{name}: {words}");
    let files = String::from_utf8(output.stdout).unwrap();
    files.lines().map(PathBuf::from).collect()
}

/// Paths that a source compiles in.
fn compiled_in(text: &str) -> impl Iterator<Item = &str> {
    let calls = text.split("include_").skip(1);
    calls.filter_map(|call| {
        let (kind, rest) = call.split_once("!(")?;
        let literal = rest.trim_start().strip_prefix('"')?;
        let path = literal.split('"').next()?;
        ["str", "bytes"].contains(&kind).then_some(path)
    })
}

/// A path without `..`; none where it leads out of the package.
fn plain(path: &Path) -> Option<PathBuf> {
    let mut plain = PathBuf::new();
    for part in path.components() {
        match part {
            Component::ParentDir => plain.pop().then_some(())?,
            part => plain.push(part),
        }
    }
    Some(plain)
}

/// Manifests of the crates that a registry gets, with what they say.
fn published() -> Vec<(&'static str, Manifest)> {
    let libraries = LIBRARIES.map(|(path, _)| path).into_iter();
    let all = libraries.chain(["Cargo.toml", "validation/command/Cargo.toml"]);
    let all = all.map(|path| (path, manifest(path)));
    all.filter(|(_, own)| own.package.publish != Some(false)).collect()
}

#[test]
fn a_published_crate_has_a_licence_and_published_dependencies() {
    let all = published();
    let names: Vec<&String> =
        all.iter().map(|(_, m)| &m.package.name).collect();
    let mut problems = Vec::new();
    for (path, own) in &all {
        if own.package.license.is_none() {
            problems.push(format!("{path}: no licence"));
        }
        let uses = own.dependencies.keys().chain(own.dev_dependencies.keys());
        for name in uses.filter(|name| name.starts_with("rocking")) {
            if !names.contains(&name) {
                problems.push(format!("{path}: {name} is not published"));
            }
        }
    }
    let core = package("rocking");
    for text in ["LICENSE-APACHE", "LICENSE-MIT"] {
        assert!(core.contains(Path::new(text)), "the core has no {text}");
    }
    pass(&problems);
}

#[test]
fn a_package_has_what_it_compiles_in() {
    let (mut problems, mut seen) = (Vec::new(), 0);
    for (manifest, own) in published() {
        let folder = manifest.trim_end_matches("Cargo.toml");
        let files = package(&own.package.name);
        let sources =
            files.iter().filter(|f| f.extension().is_some_and(|e| e == "rs"));
        for source in sources {
            for path in
                compiled_in(&read(&format!("{folder}{}", source.display())))
            {
                seen += 1;
                let full = source.parent().unwrap().join(path);
                if !plain(&full).is_some_and(|full| files.contains(&full)) {
                    let source = source.display();
                    problems.push(format!("{folder}{source}: {path}"));
                }
            }
        }
    }
    assert!(seen > 5, "{seen} files compiled in");
    pass(&problems);
}
