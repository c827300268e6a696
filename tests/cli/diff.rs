//! `rocking diff` on small made-up results.

use std::fs;

use rocking_common::files::{SUMS, sums};

use super::support::{folder, json, refused_for, run};

const FINDINGS: &str = r#"{
  "schema": 7,
  "version": "0.1.0",
  "settings": {
    "arms": ["C"], "eta": 0.92, "overturning": "alpha", "refinement_im": 0.0001
  },
  "suites": [],
  "claims": [
    {
      "id": "quantiles-coincide", "kind": "finding", "theme": "statistics",
      "section": { "number": 4, "shown": { "figure": 7 } },
      "quote": "The same.", "plain": "the same",
      "measure": "median paired ratio",
      "blocks": "p = 3 and 4",
      "yardsticks": [
        { "words": "notches that hold 1", "unit": "share",
          "holds": { "above": 0.5 } }
      ],
      "no_effect": { "value": 1.0, "says": "differs" },
      "case": "", "note": "",
      "results": [
        {
          "suite": "ordinary", "arm": "C",
          "seen": "yes", "counts": [{ "value": 0.75, "of": 4 }],
          "exists": "yes",
          "value": 1.1, "low": 1.01, "high": 1.2, "unit": "1",
          "at": "p = 3", "details": []
        }
      ]
    },
    {
      "id": "energy-loss", "kind": "identity", "theme": "choices",
      "section": { "number": 3, "shown": "text" },
      "quote": "15.36%.", "plain": "",
      "measure": "1 - eta^2", "blocks": "all 15",
      "yardsticks": [], "no_effect": null,
      "case": "block-geometry/restitution", "note": "", "results": []
    }
  ],
  "tables": [
    {
      "topic": "overturning",
      "quantities": [
        { "name": "median", "words": "median overturning", "unit": "1" }
      ],
      "rows": [
        {
          "at": {
            "suite": "ordinary", "arm": "C", "intensity": "pga",
            "p_rad_s": 3.0, "alpha_rad": 0.2
          },
          "values": [{ "value": 2.31, "low": 2.27, "high": 2.3353 }]
        },
        {
          "at": {
            "suite": "ordinary", "arm": "C", "intensity": "pga",
            "p_rad_s": 1.0, "alpha_rad": 0.2
          },
          "values": [{ "value": 3.3, "low": 3.1, "high": 3.5 }]
        }
      ]
    }
  ],
  "questions": []
}
"#;

const CASES: &str = r#"{
  "free-rocking/one": {
    "kind": "code-verification", "method": "free", "oracle": "closed-form",
    "quantities": {
      "peak": { "bound": 1e-9, "first": [0.5], "kind": "absolute",
                "margin": 0.3, "values": 1 }
    },
    "rejected": { "wrong": { "margin": 70.0, "quantity": "peak" } },
    "verdict": "pass"
  },
  "free-rocking/two": {
    "kind": "code-verification", "method": "free", "oracle": "closed-form",
    "quantities": {
      "count": { "bound": 0, "first": [7.0], "kind": "exact",
                 "margin": 0.0, "values": 1 }
    },
    "rejected": {},
    "verdict": "pass"
  }
}
"#;

/// Two sides with results that differ by replacements in the text.
pub fn sides(
    name: &str,
    findings: &[(&str, &str)],
    cases: &[(&str, &str)],
) -> crate::support::Place {
    let changed = |text: &str, changes: &[(&str, &str)]| {
        changes.iter().fold(text.to_owned(), |text, (from, to)| {
            assert!(text.contains(from), "{from}");
            text.replacen(from, to, 1)
        })
    };
    folder(
        &format!("diff-{name}"),
        &[
            ("old/findings.json", FINDINGS),
            ("old/verification.json", CASES),
            ("new/data/findings.json", &changed(FINDINGS, findings)),
            ("new/data/verification.json", &changed(CASES, cases)),
        ],
    )
}

#[test]
fn identical_results_say_so() {
    let place = sides("identical", &[], &[]);
    for (old, new) in [
        ("old", "new"),
        ("old/findings.json", "new/data/findings.json"),
        ("old/verification.json", "new"),
    ] {
        let (status, out, error) = run(&place, &format!("diff {old} {new}"));
        assert_eq!((status, error.as_str()), (0, ""), "{old} {new}");
        assert!(out.starts_with("Identical: "), "{out}");
    }
    let answer = json(&place, "diff old new --json");
    assert_eq!(answer["identical"], true);
    assert_eq!(answer["relevant"], 0);
    // A file on one side only is named.
    fs::remove_file(place.join("old/verification.json")).unwrap();
    let (status, out, _) = run(&place, "diff old new");
    assert_eq!(status, 0);
    assert!(out.contains("verification.json, which only the new"), "{out}");
}

#[test]
fn the_consequence_comes_first() {
    let changes = [
        ("\"seen\": \"yes\"", "\"seen\": \"no\""),
        ("\"eta\": 0.92", "\"eta\": 0.919"),
        ("2.31, \"low\": 2.27, \"high\": 2.3353", "2.6"),
        ("3.3,", "3.3002,"),
    ];
    let cases =
        [("\"verdict\": \"pass\"", "\"verdict\": \"fail\""), ("0.5]", "0.6]")];
    let place = sides("verdicts", &changes, &cases);
    let (status, out, error) = run(&place, "diff old new");
    assert_eq!(status, 1);
    assert_eq!(error, "rocking: 6 relevant changes\n");
    let lines = [
        "Setting changed: coefficient of restitution 0.92 -> 0.919.\n",
        "Effect: median overturning intensities +6.3 % (PGA/(g tan alpha), \
         ordinary +6.3 %).\n",
        "Answers based on findings: 1 of 4 turned; none changed only in \
         numbers.\n",
        "Verdicts on statements (seen, exists): 1 of 2 changed, 1 to the \
         contrary.\n",
        "Reference cases: 1 of 2 verdicts changed.\n",
        "Numbers: 2 of 5 moved by more than",
        "Before: Hardly, if every impact loses the same share of energy.\n",
        "  \"the same\" (quantiles-coincide), ordinary, grid C, seen: yes -> \
         no\n",
        "  case free-rocking/one, peak, value 1 of 1: 0.5 -> 0.6, \
         +0.1\n",
        "  median overturning, PGA/(g tan alpha), ordinary, p = 3, alpha = \
         0.20, grid C: 2.31 -> 2.6, +13 %\n",
        "  case free-rocking/one: pass -> fail\n",
    ];
    let mut rest = out.as_str();
    for line in lines {
        let at = rest.find(line).unwrap_or_else(|| panic!("{line}\n{out}"));
        rest = &rest[at..];
    }
}

#[test]
fn equal_intensities_are_unchanged() {
    let place =
        sides("unchanged", &[("\"eta\": 0.92", "\"eta\": 0.919")], &[]);
    let (_, out, _) = run(&place, "diff old new");
    let words = "Effect: no overturning intensity changed.\n";
    assert!(out.contains(words), "{out}");
}

#[test]
fn what_is_on_one_side_only_is_named() {
    let renamed = [("\"quantiles-coincide\"", "\"ratio\"")];
    let place = sides("presence", &renamed, &[("king/two", "king/three")]);
    let (status, out, error) = run(&place, "diff old new");
    assert_eq!(status, 1);
    assert!(error.contains("5 relevant"), "{error}\n{out}");
    let (_, lists) = out.split_once("\nOnly in the old results\n").unwrap();
    let (vanished, appeared) =
        lists.split_once("\nOnly in the new results\n").unwrap();
    for (list, names) in [
        (appeared, ["claim ratio\n", "case free-rocking/three\n"]),
        (vanished, ["claim quantiles-coincide\n", "case free-rocking/two\n"]),
    ] {
        for name in names {
            assert!(list.contains(name), "{name}: {out}");
        }
    }
}

#[test]
fn an_effect_that_turns_to_the_opposite_says_so() {
    let turned = [
        ("\"exists\": \"yes\"", "\"exists\": \"the opposite\""),
        (
            "1.1, \"low\": 1.01, \"high\": 1.2",
            "0.9, \"low\": 0.8, \"high\": 0.95",
        ),
    ];
    let place = sides("turned", &turned, &[]);
    let (_, out, _) = run(&place, "diff old new");
    let words = "grid C, exists: yes -> the opposite; 1.1 -> 0.9, -18 %";
    assert!(out.contains(words), "{out}");
    assert!(out.contains(", 1 to the contrary."), "{out}");
}

#[test]
fn tolerances_and_exact_numbers_of_cases() {
    for (name, change, status) in [
        ("exact", ("7.0]", "8.0]"), 1),
        ("within", ("0.5]", "0.500000001]"), 0),
        ("beyond", ("0.5]", "0.50000001]"), 1),
        ("looser", ("1e-9", "1e-8"), 1),
        ("margin", ("\"margin\": 0.3", "\"margin\": 0.9"), 0),
        ("unrejected", ("\"wrong\": {", "\"other\": {"), 1),
    ] {
        let place = sides(name, &[], &[change]);
        let (found, out, _) = run(&place, "diff old new");
        assert_eq!(found, status, "{name}: {out}");
        assert!(!out.starts_with("Identical"), "{name}: {out}");
    }
}

/// Records and the first overturnings of each, as a study keeps them.
#[test]
fn runs_of_the_same_records_are_paired() {
    let list: Vec<String> = (0..8)
        .map(|k| format!("{{ \"name\": \"r{k}\", \"sha256\": \"{k}\" }}"))
        .collect();
    let suite = format!(
        "\"suites\": [{{ \"kind\": \"ordinary\", \"source\": \"s\", \
         \"component_rule\": \"\", \"records\": 8, \"earthquakes\": null, \
         \"sha256\": \"ab\", \"list\": [{}], \"shown_alone\": [], \
         \"analyses\": 9, \"unresolved\": 0, \
         \"first_overturnings_reevaluated\": {{ \"all\": 0, \
         \"resolved_by_double\": 0, \"resolved_by_double_double\": 0, \
         \"resolved_by_octuple\": 0, \"unresolved\": 0, \
         \"wrong_in_double\": 0 }}, \"largest_shift_if_flipped\": 0 }}]",
        list.join(", ")
    );
    let old = FINDINGS.replacen("\"suites\": []", &suite, 1);
    let numbers = |value, low, high| {
        format!("\"value\": {value}, \"low\": {low}, \"high\": {high}")
    };
    let (was, is) = (numbers(3.3, 3.1, 3.5), numbers(3.7, 3.5, 3.9));
    let new = old.replacen(&was, &is, 1);
    // The ratios of the eight records are 1.05 to 1.12.
    let table = |by: &dyn Fn(i32) -> f64| {
        let rows = (0..8).map(|k| format!("a,pga,1,r{k},1,{},,\n", by(k)));
        let rows: String = rows.collect();
        format!(
            "panel,im,shift,record,edp,intensity,q16,q84\n{rows}\
             a,pga,1,r0,0.5,9,,\nb,pgv,1,r0,1,9,,\na,pga,1,median,1,9,,\n"
        )
    };
    let place = folder(
        "diff-paired",
        &[
            ("old/data/findings.json", &old),
            ("old/data/figure-11.csv", &table(&|_| 2.0)),
            ("new/data/findings.json", &new),
            (
                "new/data/figure-11.csv",
                &table(&|k| 2.0 * (1.05 + 0.01 * f64::from(k))),
            ),
        ],
    );
    let (_, out, _) = run(&place, "diff old new");
    assert!(out.contains("No setting changed (same 8 records)."), "{out}");
    let moved = "record by record +8.5 % (95 %: 5 to 12; block of Figure 11, \
                 n = 8)";
    assert!(out.contains(moved), "{out}");
    // The same name with other samples is another record.
    let other = new.replacen("\"sha256\": \"7\"", "\"sha256\": \"8\"", 1);
    fs::write(place.join("new/data/findings.json"), other).unwrap();
    let (_, out, _) = run(&place, "diff old new");
    let parted = "7 ordinary records are in both runs, 1 (r7) only in the \
                  old one, 1 (r7) only in the new one.";
    assert!(out.contains(parted) && out.contains("n = 7)"), "{out}");
}

#[test]
fn bad_input_is_refused_with_the_file_and_what_was_expected() {
    let place = sides("refused", &[], &[]);
    let files = [
        ("cut.json", &FINDINGS[..300], "expected JSON"),
        ("list.json", "[1]", "expected findings of a study"),
        ("other.json", "{\"a\": 1}", "expected findings of a study"),
        ("first.json", "{\"claims\": []}", "schema 1, expected schema 7"),
    ];
    for (name, text, _) in files {
        fs::write(place.join(name), text).unwrap();
    }
    fs::create_dir(place.join("empty")).unwrap();
    for (name, _, words) in files {
        refused_for(&place, &format!("diff {name} new"), &[name, words]);
        refused_for(&place, &format!("diff new {name}"), &[name, words]);
    }
    let flawed = [
        ("\"seen\": \"yes\"", "\"seen\": \"maybe\"", "one of yes, in part"),
        ("1.01,", "1.21,", "expected a low end not above"),
        ("1.01,", "null,", "expected a low end not above"),
        ("\"value\": 1.1", "\"value\": \"one\"", "found \"one\""),
        ("\"value\": 1.1,", "", "missing field `value` at line"),
        ("\"p_rad_s\": 1.0", "\"p_rad_s\": 3.0", "twice"),
        ("energy-loss", "quantiles-coincide", "twice"),
    ];
    for (from, to, words) in flawed {
        assert!(FINDINGS.contains(from));
        fs::write(place.join("flawed.json"), FINDINGS.replacen(from, to, 1))
            .unwrap();
        let arguments = "diff old flawed.json";
        refused_for(&place, arguments, &["flawed.json", words]);
    }
    let flawed = [
        ("\"pass\"", "\"good\"", "one of pass, fail"),
        ("\"values\": 1 ", "\"values\": 1, \"x\": 1 ", "unknown field `x`"),
        ("\"values\": 1 ", "\"values\": -1 ", "at line 6"),
        ("\"absolute\"", "\"abs\"", "exact, absolute, relative"),
    ];
    for (from, to, words) in flawed {
        assert!(CASES.contains(from));
        fs::write(place.join("flawed.json"), CASES.replacen(from, to, 1))
            .unwrap();
        let arguments = "diff flawed.json old";
        refused_for(&place, arguments, &["flawed.json", words]);
    }
    for (arguments, words) in [
        ("diff absent new", "absent: "),
        ("diff old absent", "expected findings.json, verification.json"),
        ("diff old empty", "expected findings.json or verification.json"),
        (
            "diff old/findings.json new/data/verification.json",
            "nothing in common",
        ),
    ] {
        refused_for(&place, arguments, &[words]);
    }
    fs::write(place.join("new/findings.json"), FINDINGS).unwrap();
    refused_for(&place, "diff old new", &["new", "one of them"]);
}

#[test]
fn without_names_the_committed_report_and_the_last_study() {
    let files = [("reports/data/findings.json", FINDINGS)];
    let place = folder("diff-default", &files);
    refused_for(&place, "diff", &["rocking-report", "rocking study"]);
    // One name alone is not enough.
    let error = super::support::refused(&place, "diff reports");
    assert!(error.contains("NEW"), "{error}");
    let changed =
        FINDINGS.replacen("2.31, \"low\": 2.27, \"high\": 2.3353", "2.6", 1);
    fs::create_dir_all(place.join("rocking-report/data")).unwrap();
    let new = place.join("rocking-report/data/findings.json");
    fs::write(&new, changed).unwrap();
    let (status, out, _) = run(&place, "diff");
    assert_eq!(status, 1);
    assert!(out.contains("2.31 -> 2.6, +13 %"), "{out}");
    fs::write(&new, FINDINGS).unwrap();
    assert_eq!(run(&place, "diff").0, 0);
}

/// A report is compared only if its files are of one run.
#[test]
fn a_report_of_two_runs_is_refused() {
    let place = folder(
        "diff-mixed",
        &[
            ("old/data/findings.json", FINDINGS),
            ("old/index.html", "<!DOCTYPE html>"),
            ("new/data/findings.json", FINDINGS),
        ],
    );
    let diff = "diff old new";
    refused_for(&place, diff, &["old: no SHA256SUMS, so that its files may"]);
    let names = ["data/findings.json", "index.html"];
    let file = |name: &str| {
        (name.to_owned(), fs::read(place.join("old").join(name)).unwrap())
    };
    let manifest = sums(&names.into_iter().map(file).collect());
    fs::write(place.join("old").join(SUMS), manifest).unwrap();
    assert_eq!(run(&place, diff).0, 0);
    let changed = FINDINGS.replace("2.31", "2.32");
    fs::write(place.join("old/data/findings.json"), changed).unwrap();
    let words = "data/findings.json: SHA-256 ";
    refused_for(&place, diff, &["old: ", words, "of the run that wrote"]);
    fs::write(place.join("old/data/findings.json"), FINDINGS).unwrap();
    assert_eq!(run(&place, diff).0, 0);
    // A run that ended while it put files into place.
    let part = place.join("old/.rocking-killed.part");
    fs::create_dir(&part).unwrap();
    fs::write(part.join("moving"), "").unwrap();
    refused_for(&place, diff, &["old: files of two runs"]);
    refused_for(&place, "study --out old --check", &["files of two runs"]);
}
