use std::path::Path;

use serde_json::json;

use super::*;
use crate::evidence::Proof;

/// Whether `file::function` is a test of the gate.
fn in_the_gate(name: &str) -> bool {
    let Some((file, function)) = name.split_once("::") else {
        return false;
    };
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let Ok(text) = std::fs::read_to_string(root.join(file)) else {
        return false;
    };
    let lines: Vec<&str> = text.lines().map(str::trim).collect();
    let head = format!("fn {function}()");
    lines.windows(2).any(|w| w[0] == "#[test]" && w[1].starts_with(&head))
}

#[test]
fn every_requirement_has_executed_evidence() {
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/data");
    let proof = Proof::read(data.as_ref()).unwrap();
    let mut problems = Vec::new();
    for r in requirements().unwrap() {
        // A study that is run holds the names of claims: study::tests.
        let results = Some(proof.results());
        let standing = r.standing(results, &|_| true, &in_the_gate, &|_| true);
        if !standing.is_met() || !r.is_named() {
            problems.push(format!("{}: {}", r.id, state(&r, &standing, &[])));
        }
        for text in [&r.id, &r.text, &r.place] {
            assert!(!text.trim().is_empty(), "{}", r.id);
        }
    }
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
}

#[test]
fn the_whole_paper_is_required() {
    let requirements = requirements().unwrap();
    let paper: Vec<&Requirement> =
        requirements.iter().filter(|r| r.source == Origin::Paper).collect();
    let mut wanted: Vec<String> =
        (1..=7).map(|k| format!("Eq. {k}")).collect();
    wanted.push("Table 1".into());
    for place in wanted {
        assert!(paper.iter().any(|r| r.place == place), "{place}");
    }
    for figure in 2..=18 {
        let digits = |place: &str| -> Vec<u32> {
            place
                .split(|c: char| !c.is_ascii_digit())
                .filter_map(|n| n.parse().ok())
                .collect()
        };
        let named = paper.iter().any(|r| {
            let figures = r.place.split("Figure").nth(1);
            figures.is_some_and(|f| digits(f).contains(&figure))
        });
        assert!(named, "Figure {figure}");
    }
    for origin in [Origin::User, Origin::Ours] {
        assert!(requirements.iter().any(|r| r.source == origin));
    }
}

/// A requirement with this evidence.
fn one(evidence: &str) -> Requirement {
    let own = "id = \"r\"\nsource = \"ours\"\nplace = \"p\"\ntext = \"t\"";
    let text = format!("[[requirement]]\n{own}\n{evidence}\n");
    parse(&text).unwrap().remove(0)
}

#[test]
fn a_failed_or_missing_case_is_red() {
    let requirement =
        one("cases = [\"a/*\", \"b/one\", \"a/x*z\"]\nfindings = [\"f\"]\n\
         tests = [\"tests/x.rs::y\"]\nfigures = [1, 2]");
    let results = |b: &str| -> snapshot::Results {
        let of = |verdict: &str| {
            json!({
                "kind": "regression",
                "method": "m",
                "oracle": "own-output",
                "verdict": verdict,
                "quantities": {},
                "rejected": {},
            })
        };
        let all = [("a/one", "pass"), ("a/xyz", "pass"), ("b/one", b)];
        all.map(|(id, verdict)| {
            (id.into(), serde_json::from_value(of(verdict)).unwrap())
        })
        .into()
    };
    let yes = |_: &str| true;
    let no = |_: &str| false;
    let drawn = |_: u32| true;
    let standing =
        |b| requirement.standing(Some(&results(b)), &yes, &yes, &drawn);
    assert_eq!(standing("pass").passed, 3);
    assert!(standing("pass").is_met());
    for verdict in ["fail", "error"] {
        assert_eq!(standing(verdict).failed, ["b/one"]);
        assert!(!standing(verdict).is_met());
    }
    let all = results("pass");
    let all = Some(&all);
    assert!(!requirement.standing(all, &no, &yes, &drawn).is_met());
    assert!(!requirement.standing(all, &yes, &no, &drawn).is_met());
    let first = |number: u32| number == 1;
    let lacking = requirement.standing(all, &yes, &yes, &first);
    assert_eq!(lacking.missing, ["Figure 2"]);
    let empty = requirement.standing(
        Some(&snapshot::Results::new()),
        &yes,
        &yes,
        &drawn,
    );
    assert_eq!(empty.missing.len(), 3);
    let not_run = requirement.standing(None, &yes, &yes, &drawn);
    assert!(!not_run.is_met() && not_run.missing.is_empty());
    assert_eq!(state(&requirement, &not_run, &[]), "not run here");
    let nothing = one("");
    assert!(!nothing.is_named());
    let none = nothing.standing(all, &yes, &yes, &drawn);
    assert_eq!(state(&nothing, &none, &[]), "✗ no evidence named");
}

#[test]
fn a_claim_that_is_not_seen_is_not_shown_as_passed() {
    let recorded = crate::basis::recorded();
    let id = "shift-gains-little-pgv";
    let mut claim =
        recorded.claims.iter().find(|c| c.id == id).unwrap().clone();
    let requirement = one(&format!("findings = [\"{id}\"]"));
    let yes = |_: &str| true;
    let standing = requirement.standing(None, &yes, &yes, &|_| true);
    assert!(standing.is_met());
    claim.results.truncate(1);
    for (seen, words) in [
        (Seen::No, "measured, seen: 1 no"),
        (Seen::Yes, "measured, seen: 1 yes"),
    ] {
        claim.results[0].seen = seen;
        let said = state(&requirement, &standing, &[claim.clone()]);
        assert_eq!(said, words);
    }
}

#[test]
fn unknown_keys_and_duplicates_are_refused() {
    let one = "[[requirement]]\nid = \"a\"\nsource = \"ours\"\n\
               place = \"p\"\ntext = \"t\"\n";
    assert_eq!(parse(one).unwrap().len(), 1);
    let twice = parse(&format!("{one}{one}")).unwrap_err().to_string();
    assert!(twice.contains("two requirements are named `a`"), "{twice}");
    assert!(parse(&format!("{one}proof = 1\n")).is_err());
    assert!(parse(&one.replace("ours", "theirs")).is_err());
}
