//! What a registry gets of each crate.

use std::collections::BTreeSet;
use std::path::{Component, Path, PathBuf};
use std::process::Command;

use super::{LIBRARIES, pass, read, root};

/// Files of the package that has this manifest.
fn package(manifest: &str) -> BTreeSet<PathBuf> {
    let text = read(manifest);
    let name = text.lines().find_map(|line| line.strip_prefix("name = "));
    let name = name.unwrap().trim_matches('"');
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

#[test]
fn a_package_has_its_licences_and_what_it_compiles_in() {
    let libraries = LIBRARIES.map(|(manifest, _)| manifest);
    let others = ["Cargo.toml", "validation/Cargo.toml"];
    let (mut problems, mut seen) = (Vec::new(), 0);
    for manifest in libraries.into_iter().chain(others) {
        let folder = manifest.trim_end_matches("Cargo.toml");
        let files = package(manifest);
        for licence in ["LICENSE-APACHE", "LICENSE-MIT"] {
            if !files.contains(Path::new(licence)) {
                problems.push(format!("{manifest}: no {licence}"));
            }
        }
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
    assert!(seen > 15, "{seen} files compiled in");
    pass(&problems);
}
