//! No part has more code lines than CONTRIBUTING allows it.

use std::collections::BTreeMap;
use std::process::Command;

use super::{read, root};

/// The rows `| name | lines | ...` of a table.
fn rows(table: &str) -> BTreeMap<String, u32> {
    let row = |line: &str| {
        let mut cells = line.split('|').map(|cell| cell.trim());
        let name = cells.nth(1)?.trim_matches('`').to_owned();
        let lines = cells.next()?.replace(',', "");
        Some((name, lines.parse().ok()?))
    };
    table.lines().filter_map(row).collect()
}

#[test]
#[cfg(unix)]
fn no_part_is_above_its_ceiling() {
    let count = root().join(".ci/count");
    let output = Command::new("sh").arg(&count).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let found = rows(&String::from_utf8(output.stdout).unwrap());
    let page = read("CONTRIBUTING.md");
    let section = page.split("## Ceilings").nth(1).unwrap();
    let ceilings = rows(section.split("\n## ").next().unwrap());
    assert!(found.keys().eq(ceilings.keys()), "{found:?}\n{ceilings:?}");
    for (part, lines) in found {
        let most = ceilings[&part];
        assert!(lines <= most, "{part}: {lines} code lines, at most {most}");
    }
}
