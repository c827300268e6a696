//! The results in README, docs and paper are those of the committed report.

use rocking_common::findings::Findings;
use rocking_report::evidence::Proof;
use rocking_report::marked::{PAGES, Results};

use super::{read, root};

#[test]
fn pages_show_the_committed_results() {
    let proof = Proof::read(&root().join("reports/data")).unwrap();
    let text = read("reports/data/findings.json");
    let findings = Findings::parse(&text).unwrap();
    let results =
        |findings| Results { findings, proof: &proof, assessed: None };
    for page in PAGES {
        let text = read(page);
        let expected = results(&findings).renewed(page, &text).unwrap();
        assert!(
            text == expected,
            "{page}: other results than those of reports/, expected as \
             `rocking accept` writes it:\n{expected}"
        );
        let error = results(&findings).renewed(page, "no marks").unwrap_err();
        assert!(error.to_string().contains(page), "{error}");
        let cut = text.replace("<!-- end of results -->", "");
        assert!(results(&findings).renewed(page, &cut).is_err(), "{page}");
    }
    // Both change with the findings.
    let mut other = findings.clone();
    other.claims.retain(|claim| claim.results.is_empty());
    for question in &mut other.questions {
        question.answer += " More.";
    }
    for page in ["README.md", "docs/tour.md"] {
        let text = read(page);
        assert_ne!(results(&other).renewed(page, &text).unwrap(), text);
    }
    let figure = "reports/figures/figure-08-c-recorded.svg";
    let readme = read("README.md");
    assert!(readme.contains(figure) && read(figure).starts_with("<svg"));
}

#[test]
fn the_readme_runs_the_example_that_accept_runs() {
    let accept = read("validation/command/src/cli/accept.rs");
    for path in ["examples/museum/objects.csv", "examples/museum/hazard.csv"] {
        assert!(read("README.md").contains(path) && accept.contains(path));
        assert!(!read(path).is_empty());
    }
}
