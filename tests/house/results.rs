//! The results in README, docs and paper are those of the committed report.

use rocking_common::findings::Findings;
use rocking_report::evidence::Proof;
use rocking_report::marked::{PAGES, Results};

use super::{read, root};

#[test]
fn pages_show_the_committed_results() {
    let proof = Proof::read(&root().join("reports/data")).unwrap();
    let findings =
        Findings::parse(&read("reports/data/findings.json")).unwrap();
    // Without its claims it is another report.
    let mut other = findings.clone();
    other.claims.retain(|claim| claim.results.is_empty());
    let renewed = |findings, page, text: &str| {
        Results { findings, proof: &proof, assessed: None }.renewed(page, text)
    };
    for page in PAGES {
        let text = read(page);
        let expected = renewed(&findings, page, &text).unwrap();
        assert!(
            text == expected,
            "{page}: other results than those of reports/, expected as \
             `rocking accept` writes it:\n{expected}"
        );
        let cut = text.replace("<!-- end of results -->", "");
        assert!(renewed(&findings, page, &cut).is_err(), "{page}");
    }
    let readme = read("README.md");
    assert_ne!(renewed(&other, "README.md", &readme).unwrap(), readme);
}
