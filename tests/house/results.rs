//! The results in the README are those of the committed report.

use rocking_common::findings::Findings;
use rocking_report::evidence::Proof;
use rocking_report::readme::renewed;

use super::{read, root};

#[test]
fn the_readme_shows_the_committed_results() {
    let readme = read("README.md");
    let proof = Proof::read(&root().join("reports/data")).unwrap();
    let text = read("reports/data/findings.json");
    let mut findings = Findings::parse(&text).unwrap();
    let expected = renewed(&readme, &findings, &proof).unwrap();
    assert!(
        readme == expected,
        "README.md: other results than those of reports/, expected as \
         `rocking accept` writes it:\n{expected}"
    );
    // The table changes with the findings.
    findings.claims.retain(|claim| claim.results.is_empty());
    assert_ne!(renewed(&readme, &findings, &proof).unwrap(), expected);
    assert!(renewed("no marks", &findings, &proof).is_err());
    let figure = "reports/figures/figure-08-c-recorded.svg";
    assert!(readme.contains(figure) && read(figure).starts_with("<svg"));
}
