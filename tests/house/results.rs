//! The results in README, docs and paper are those of the committed report.

use std::fs;

use rocking_common::findings::Findings;
use rocking_report::evidence::Proof;
use rocking_report::marked::{PAGES, PageResults};

use super::super::compare::{accepting, committed};
use super::{read, root};

#[test]
fn pages_show_the_committed_results() {
    let data = accepting().unwrap_or_else(root).join("reports/data");
    let proof = Proof::read(&data).unwrap();
    let findings = fs::read_to_string(data.join("findings.json")).unwrap();
    let findings = Findings::parse(&findings).unwrap();
    // Without its claims it is another report.
    let mut other = findings.clone();
    other.claims.retain(|claim| claim.results.is_empty());
    let renewed = |findings, page, text: &str| {
        PageResults { findings, proof: &proof }.renewed(page, text)
    };
    for page in PAGES {
        let text = read(page);
        let expected = renewed(&findings, page, &text).unwrap();
        let kept = committed(page, &expected).unwrap_or(expected.clone());
        assert!(
            kept == expected,
            "{page}: other results than those of reports/, expected as \
             `.ci/accept` writes it:\n{expected}"
        );
        let cut = text.replace("<!-- end of results -->", "");
        assert!(renewed(&findings, page, &cut).is_err(), "{page}");
    }
    let readme = read("README.md");
    assert_ne!(renewed(&other, "README.md", &readme).unwrap(), readme);
}
