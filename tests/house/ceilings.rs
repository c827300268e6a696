//! No part has more code lines than CONTRIBUTING allows it.

use std::collections::BTreeMap;
use std::process::Command;

use super::{read, root, table};

/// Lines by part, of the rows `| part | lines |` of a section.
fn lines(page: &str, heading: &str) -> BTreeMap<String, u32> {
    let rows = table(page, heading).into_iter();
    let rows = rows.map(|row| (row[0].clone(), row[1].replace(',', "")));
    rows.filter_map(|(part, n)| Some((part, n.parse().ok()?))).collect()
}

#[test]
#[cfg(unix)]
fn no_part_is_above_its_ceiling() {
    let count = root().join(".ci/count");
    let output = Command::new("sh").arg(&count).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    let found = String::from_utf8(output.stdout).unwrap();
    let found = lines(&format!("# Found\n{found}"), "# Found");
    let ceilings = lines(&read("CONTRIBUTING.md"), "## Ceilings");
    assert!(found.keys().eq(ceilings.keys()), "{found:?}\n{ceilings:?}");
    for (part, lines) in found {
        let most = ceilings[&part];
        assert!(lines <= most, "{part}: {lines} code lines, at most {most}");
    }
}
