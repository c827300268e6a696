//! `rocking diff` on small made-up results.

use std::fs;
use std::path::PathBuf;

use serde_json::Value;

use super::support::{folder, json, refused_for, run};

const FINDINGS: &str = r#"{
  "schema": 5,
  "version": "0.1.0",
  "settings": {
    "arms": ["C"], "eta": 0.92, "overturning": "alpha", "refinement_im": 0.0001
  },
  "suites": [],
  "claims": [
    {
      "id": "ratios", "kind": "finding", "theme": "statistics",
      "section": { "number": 4, "shown": { "figure": 7 } },
      "quote": "The same.", "plain": "the same",
      "measure": "median paired ratio",
      "blocks": "p = 3 and 4", "quantifier": "one",
      "region": { "within": [0.95, 1.05] }, "reason": "5 %",
      "criterion": "", "case": "", "note": "",
      "results": [
        {
          "suite": "ordinary", "arm": "C",
          "value": 1.0, "low": 0.98, "high": 1.02, "unit": "1",
          "by_criterion": null, "by_equivalence": "confirmed",
          "at": "p = 3", "interval": "percentile", "cells": null,
          "deciding_cell": null, "details": [],
          "p": 0.01, "monte_carlo_error": 0.001
        }
      ]
    },
    {
      "id": "energy-loss", "kind": "identity", "theme": "choices",
      "section": { "number": 3, "shown": "text" },
      "quote": "15.36%.", "plain": "",
      "measure": "1 - eta^2", "blocks": "all 15",
      "quantifier": null, "region": null, "reason": "",
      "criterion": "", "case": "block-geometry/restitution", "note": "",
      "results": [
        {
          "suite": "none", "arm": null,
          "value": 0.1536, "low": null, "high": null, "unit": "1",
          "by_criterion": null, "by_equivalence": null,
          "at": "", "interval": null, "cells": null,
          "deciding_cell": null, "details": [],
          "p": 0.01, "monte_carlo_error": 0.001
        }
      ]
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
) -> PathBuf {
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
            ("old/validation.json", CASES),
            ("new/data/findings.json", &changed(FINDINGS, findings)),
            ("new/data/validation.json", &changed(CASES, cases)),
        ],
    )
}

#[test]
fn identical_results_say_so() {
    let place = sides("identical", &[], &[]);
    for (old, new) in [
        ("old", "new"),
        ("old/findings.json", "new/data/findings.json"),
        ("old/validation.json", "new"),
    ] {
        let (status, out, error) = run(&place, &format!("diff {old} {new}"));
        assert_eq!((status, error.as_str()), (0, ""), "{old} {new}");
        assert!(out.starts_with("Identical: "), "{out}");
    }
    let answer = json(&place, "diff old new --json");
    assert_eq!(answer["identical"], true);
    assert_eq!(answer["significant"], 0);
    // A file on one side only is named.
    fs::remove_file(place.join("old/validation.json")).unwrap();
    let (status, out, _) = run(&place, "diff old new");
    assert_eq!(status, 0);
    assert!(out.contains("validation.json: only among the new"), "{out}");
}

#[test]
fn a_number_beyond_its_interval_is_reported_in_engineering_terms() {
    let place = sides("number", &[("2.31,", "2.35,")], &[]);
    let (status, out, error) = run(&place, "diff old new");
    assert_eq!(status, 1);
    assert_eq!(error, "rocking: 1 significant change\n");
    // (2.3353 - 2.31)/1.96 is a standard error of 0.0129.
    let line = "    median overturning PGA/(g tan alpha) at p = 3, alpha = \
                0.20, arm C: 2.31 to 2.35, +1.7 %, 3.1 standard errors\n";
    assert!(out.contains(line), "{out}");
    assert!(out.contains("  ordinary suite: overturning"), "{out}");
    let (status, out, _) = run(&place, "diff old new --markdown");
    assert_eq!(status, 1);
    let row = "| median overturning PGA/(g tan alpha) at p = 3, alpha = \
               0.20, arm C | 2.31 | 2.35 | +1.7 % | 3.1 standard errors |\n";
    assert!(out.contains(row), "{out}");
    let (status, out, _) = run(&place, "diff old new --json");
    assert_eq!(status, 1);
    let answer: Value = serde_json::from_str(&out).unwrap();
    let number = &answer["numbers"][0];
    assert_eq!(number["values"], serde_json::json!([2.31, 2.35]));
    let errors = number["measure"]["standard_errors"].as_f64().unwrap();
    assert!((errors - 3.099).abs() < 1e-3, "{errors}");
}

#[test]
fn a_number_within_its_interval_does_not_matter() {
    let changes = [("2.31,", "2.32,"), ("3.3,", "3.4,")];
    let place = sides("small", &changes, &[]);
    let (status, out, error) = run(&place, "diff old new");
    assert_eq!((status, error.as_str()), (0, ""), "{out}");
    // The more significant first: 0.77 against 0.98 standard errors.
    let (first, second) = ("at p = 1", "at p = 3");
    assert!(out.find(first).unwrap() < out.find(second).unwrap(), "{out}");
}

#[test]
fn verdicts_come_first_and_settings_before_them() {
    let changes = [
        ("\"confirmed\"", "\"inconclusive\""),
        ("\"eta\": 0.92", "\"eta\": 0.919"),
        ("2.31,", "2.45,"),
        ("0.1536", "0.155439"),
    ];
    let cases =
        [("\"verdict\": \"pass\"", "\"verdict\": \"fail\""), ("0.5]", "0.6]")];
    let place = sides("verdicts", &changes, &cases);
    let (status, out, _) = run(&place, "diff old new");
    assert_eq!(status, 1);
    let lines = [
        "    eta: 0.92 to 0.919\n",
        "    ratios, ordinary, arm C, \"The same.\": confirmed to inconclusive\n",
        "    case free-rocking/one: pass to fail\n",
        "    case free-rocking/one: peak: 0.5 to 0.6, +20 %, ",
        "    energy-loss: 1 - eta^2, none: 0.154 to 0.155, +1.2 %, \
         no interval stated\n",
    ];
    let at: Vec<usize> = lines
        .iter()
        .map(|line| out.find(line).unwrap_or_else(|| panic!("{line}\n{out}")))
        .collect();
    assert!(at[0] < at[1] && at[1] < at[3] && at[2] < at[3], "{out}");
    // What states no interval comes after what does.
    assert!(at[3] < at[4], "{out}");
    // A looser limit takes what has no interval, nothing else.
    let (_, out, _) = run(&place, "diff old new --relative 0.02 --json");
    let answer: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(answer["significant"], 6 - 1);
}

#[test]
fn what_appeared_or_vanished_is_named() {
    let renamed = [("energy-loss", "energy")];
    let cases = [("free-rocking/two", "free-rocking/three")];
    let place = sides("presence", &renamed, &cases);
    let (status, out, error) = run(&place, "diff old new");
    assert_eq!(status, 1);
    assert!(error.contains("4 significant"), "{error}");
    let (_, lists) = out.split_once("\nAppeared\n").unwrap();
    let (appeared, vanished) = lists.split_once("\nVanished\n").unwrap();
    for (list, names) in [
        (appeared, ["claim energy", "case free-rocking/three"]),
        (vanished, ["claim energy-loss", "case free-rocking/two"]),
    ] {
        for name in names {
            assert!(list.contains(name), "{name}: {out}");
        }
    }
}

#[test]
fn tolerances_and_exact_numbers_of_cases() {
    for (name, change, status) in [
        ("exact", ("7.0]", "8.0]"), 1),
        ("within", ("0.5]", "0.500000001]"), 0),
        ("beyond", ("0.5]", "0.500000004]"), 1),
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

#[test]
fn bad_input_is_refused_with_the_file_and_what_was_expected() {
    let place = sides("refused", &[], &[]);
    let files = [
        ("cut.json", &FINDINGS[..300], "expected JSON"),
        ("list.json", "[1]", "found a list, expected findings"),
        ("other.json", "{\"a\": 1}", "found the keys `a`"),
        ("twice.json", "{\"claims\": [], \"claims\": []}", "stands twice"),
        ("first.json", "{\"claims\": []}", "schema 1, expected schema 5"),
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
        ("\"confirmed\"", "\"perhaps\"", "unknown variant `perhaps`"),
        ("0.98,", "1.03,", "expected rising numbers"),
        ("0.98,", "null,", "expected rising numbers"),
        ("\"value\": 1.0", "\"value\": \"one\"", "found \"one\""),
        ("\"value\": 1.0,", "", "missing field `value` at line 25"),
        ("\"p_rad_s\": 1.0", "\"p_rad_s\": 3.0", "twice"),
        ("energy-loss", "ratios", "twice"),
    ];
    for (from, to, words) in flawed {
        assert!(FINDINGS.contains(from));
        fs::write(place.join("flawed.json"), FINDINGS.replacen(from, to, 1))
            .unwrap();
        let arguments = "diff old flawed.json";
        refused_for(&place, arguments, &["flawed.json", words]);
    }
    let flawed = [
        ("\"pass\"", "\"good\"", "`pass`, `fail`"),
        ("\"values\": 1 ", "\"values\": 1, \"x\": 1 ", "unknown field `x`"),
        ("\"values\": 1 ", "\"values\": -1 ", "case free-rocking/one"),
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
        ("diff old absent", "expected findings.json, validation.json"),
        ("diff old empty", "expected findings.json or validation.json"),
        (
            "diff old/findings.json new/data/validation.json",
            "nothing in common",
        ),
        ("diff old new --relative -1", "--relative -1"),
        ("diff old new --relative NaN", "--relative NaN"),
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
    let changed = FINDINGS.replacen("2.31,", "2.35,", 1);
    fs::create_dir_all(place.join("rocking-report/data")).unwrap();
    let new = place.join("rocking-report/data/findings.json");
    fs::write(&new, changed).unwrap();
    let (status, out, _) = run(&place, "diff");
    assert_eq!(status, 1);
    assert!(out.contains("2.31 to 2.35, +1.7 %"), "{out}");
    fs::write(&new, FINDINGS).unwrap();
    assert_eq!(run(&place, "diff").0, 0);
}
