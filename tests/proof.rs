//! Every rule of the form of case files, broken once, and the judge on both
//! sides of every kind of bound. They stand here, and not in the crate, which
//! takes half a minute to compile once more for them.

use std::collections::BTreeMap;

use anyhow::Result;
use rocking::excitation::{Pulse, PulseName};
use rocking_common::table::{Table, digits};
use rocking_proof::cases::pinned::{COUNTERS, expect_counters};
use rocking_proof::cases::{
    Bound, Case, Cost, ToleranceBasis, load_all, load_family,
};
use rocking_proof::methods::{self, Quantities};
use rocking_proof::oracles::linear;
use rocking_proof::scene::Forcing;
use rocking_proof::verdict::judge;

use super::compare::{committed, near};

const GOOD: &str = r#"
[family]
title = "t"
kind = "code-verification"
[[case]]
name = "a"
claim = "c"
source = { cite = "s", where = "w" }
method = "m"
expect = { oracle = "closed-form", origin = "o" }
[case.tolerance]
basis = "identity"
because = "b"
bounds = { x = "exact", y = { relative = 1e-9 } }
"#;

#[test]
fn accepts_a_good_file_and_refuses_each_flaw() {
    let case = &load_family("f", GOOD).unwrap()[0];
    assert_eq!(case.id, "f/a");
    assert_eq!(case.cost, Cost::Quick);
    let twice = format!("{GOOD}{}", &GOOD[GOOD.find("[[case]]").unwrap()..]);
    let error = load_family("f", &twice).unwrap_err().to_string();
    assert_eq!(error, "cases/f.toml: two cases are named `a`");
    let flaws = [
        ("claim = \"c\"", "claim = \"c\"\ncost = \"slow\""),
        ("claim = \"c\"", "claim = \" \""),
        ("claim = \"c\"", "claim = \"c\"\nextra = 1"),
        ("where = \"w\"", "where = \"w\", extra = 1"),
        ("relative = 1e-9", "relative = -1.0"),
        ("relative = 1e-9", "relative = nan"),
        ("relative = 1e-9", "relativ = 1e-9"),
        ("name = \"a\"", "name = \"A b\""),
        ("because = \"b\"", "because = \"b\"\nreject = [\"no-such\"]"),
        ("name = \"a\"", ""),
        // What every case inherits is not said again.
        ("claim = \"c\"", "claim = \"c\"\ncost = \"quick\""),
    ];
    for (from, to) in flaws {
        let text = GOOD.replace(from, to);
        assert_ne!(text, GOOD, "{from}");
        assert!(load_family("f", &text).is_err(), "{to}");
    }
    let none = GOOD.split("[[case]]").next().unwrap();
    let error = load_family("f", none).unwrap_err().to_string();
    assert_eq!(error, "cases/f.toml: no case");
}

/// A family with defaults of its own and of a method.
const DEFAULTS: &str = r#"
[family]
title = "t"
kind = "code-verification"
[family.default]
source = { cite = "s", where = "w", note = "n" }
method = "m"
input = { u = 1, v = { a = 1 } }
expect = { oracle = "closed-form", origin = "o", values = { x = 1.0 } }
tolerance.basis = "identity"
tolerance.because = "b"
[family.default.tolerance.bounds]
x = "exact"
y = { relative = 1e-9 }
[family.method.other]
source.where = "elsewhere"
tolerance.bounds.x = { absolute = 0.5 }
[[case]]
name = "a"
claim = "c"
"#;

/// The case of [`DEFAULTS`] with these lines, one of the other method and
/// one without lines.
fn with(lines: &str) -> Result<Vec<Case>> {
    let other = "[[case]]\nname = \"z\"\nclaim = \"c\"\nmethod = \"other\"\n\
                 [[case]]\nname = \"y\"\nclaim = \"c\"";
    load_family("f", &format!("{DEFAULTS}{lines}\n{other}"))
}

#[test]
fn a_case_inherits_key_by_key_and_its_own_words_replace() {
    let cases = with("").unwrap();
    let (plain, other) = (&cases[0], &cases[1]);
    assert_eq!(plain.source.place, "w");
    assert_eq!(plain.tolerance.bounds["x"], Bound::Exact);
    // The defaults of a method stand over those of the family.
    assert_eq!(
        (&*other.source.cite, &*other.source.place),
        ("s", "elsewhere")
    );
    assert_eq!(other.tolerance.bounds["x"], Bound::Absolute(0.5));
    assert_eq!(other.tolerance.bounds["y"], Bound::Relative(1e-9));

    let own = "cost = \"full\"\ninput.v = { b = 2 }\n\
               expect.values.y = 2.0\nexpect.origin = \"p\"\n\
               tolerance.bounds.y = { absolute = 1e-3 }";
    let case = &with(own).unwrap()[0];
    assert_eq!(case.cost, Cost::Full);
    assert_eq!(case.expect.origin, "p");
    assert_eq!(case.expect.values.len(), 2);
    // Inputs and bounds replace as a whole: nothing of the old one stays.
    let due: toml::Table = toml::from_str("u = 1\nv = { b = 2 }").unwrap();
    assert_eq!(case.input, due);
    assert_eq!(case.tolerance.bounds["y"], Bound::Absolute(1e-3));
    assert_eq!(case.tolerance.bounds["x"], Bound::Exact);
}

#[test]
fn another_document_or_basis_inherits_no_words() {
    let case = &with("source = { cite = \"r\", where = \"w\" }").unwrap()[0];
    assert_eq!((&*case.source.place, &*case.source.note), ("w", ""));
    let error = with("source.cite = \"r\"").unwrap_err().to_string();
    assert!(error.contains("case `a`: missing field `where`"), "{error}");

    let own = "tolerance.basis = \"sampling\"";
    let error = with(own).unwrap_err().to_string();
    assert!(error.contains("case `a`: missing field `because`"), "{error}");
    let own = format!("{own}\ntolerance.because = \"b\"");
    assert_eq!(
        with(&own).unwrap()[0].tolerance.basis,
        ToleranceBasis::Sampling
    );
}

#[test]
fn refuses_what_is_said_twice() {
    let flaws = [
        ("method = \"m\"", "method"),
        ("source.where = \"w\"", "source.where"),
        ("source = { cite = \"s\", where = \"v\" }", "source.cite"),
        ("input.u = 1", "input.u"),
        ("input.v = { a = 1 }", "input.v"),
        ("expect.values.x = 1.0", "expect.values.x"),
        ("tolerance.basis = \"identity\"", "tolerance.basis"),
        ("tolerance.bounds.x = \"exact\"", "tolerance.bounds.x"),
    ];
    for (lines, due) in flaws {
        let error = with(lines).unwrap_err().to_string();
        let due = format!("case `a`: `{due}` repeats the inherited value");
        assert!(error.contains(&due), "{lines}: {error}");
    }
    let text = DEFAULTS.replace("elsewhere", "w");
    let lines = "[[case]]\nname = \"z\"\nclaim = \"c\"\nmethod = \"other\"";
    let error = load_family("f", &format!("{text}{lines}")).unwrap_err();
    let due = "[family.method.other]: `source.where` repeats";
    assert!(error.to_string().contains(due), "{error}");
}

#[test]
fn refuses_a_default_that_no_case_inherits() {
    let error = load_family("f", DEFAULTS).unwrap_err().to_string();
    let due = "[family.method.other]: no case inherits `source.where`";
    assert!(error.contains(due), "{error}");

    let text =
        GOOD.replace("[[case]]", "[family.default]\nmethod = \"k\"\n[[case]]");
    let error = load_family("f", &text).unwrap_err().to_string();
    let due = "[family.default]: no case inherits `method`";
    assert!(error.contains(due), "{error}");
}

#[test]
fn a_case_can_do_without_an_inherited_bound() {
    let case = &with("tolerance.without = [\"x\"]").unwrap()[0];
    assert!(case.tolerance.bounds.keys().eq(["y"]));
    let error = with("tolerance.without = [\"z\"]").unwrap_err();
    assert!(error.to_string().contains("`z`"), "{error}");
    assert!(with("tolerance.without = \"x\"").is_err());
}

/// A declaration of entries, with these lines.
fn entries(lines: &str) -> Result<Vec<Case>> {
    let text = GOOD.replace("name = \"a\"\nclaim = \"c\"\n", lines);
    assert_ne!(text, GOOD);
    load_family("f", &text)
}

#[test]
fn entries_are_one_case_each() {
    let cases =
        entries("entries = [\"B\", \"a-1\"]\nclaim = \"c\"\n").unwrap();
    let ids: Vec<_> = cases.iter().map(|case| case.id.as_str()).collect();
    assert_eq!(ids, ["f/b", "f/a-1"]);
    assert_eq!(cases[0].input["entry"].as_str(), Some("B"));
    assert_eq!(cases[1].claim, "c");
    let own = "entries = [[\"B\", \"d\"], [\"C\", \"e\"]]\ninput.k = 1\n";
    let cases = entries(own).unwrap();
    assert_eq!(cases[1].claim, "e");
    assert_eq!(cases[1].input.len(), 2);
    for flaw in [
        "entries = []\nclaim = \"c\"\n",
        "entries = [\"B\"]\n",
        "entries = [\"B\", \"b\"]\nclaim = \"c\"\n",
        "entries = [[\"B\"]]\n",
        "entries = [[\"B\", \"d\"]]\nclaim = \"c\"\n",
        "entries = [\"B\"]\nclaim = \"c\"\nname = \"b\"\n",
        "entries = [\"B\"]\nclaim = \"c\"\ninput.entry = \"B\"\n",
        "entries = [\"B\"]\nclaim = \"c\"\ninput = 1\n",
    ] {
        assert!(entries(flaw).is_err(), "{flaw}");
    }
}

/// The case of a trajectory, with this bound on `x`.
fn computed(entry: &str, bound: &str) -> Result<Bound> {
    let name = format!("name = \"a\"\ninput.entry = \"{entry}\"");
    let text = GOOD.replace("name = \"a\"", &name);
    let cases = load_family("f", &text.replace("\"exact\"", bound))?;
    Ok(cases[0].tolerance.bounds["x"].clone())
}

#[test]
fn bounds_follow_from_the_error_of_the_reference() {
    let rule = "{ absolute = { attainable = 100, of = [\"impact-times\", \
                \"peak\"], least = 1e-13 } }";
    // 100 times 1.159e-13, to two digits.
    let found = computed("smp-A-p3", rule).unwrap();
    assert_eq!(found, Bound::Absolute(1.2e-11));
    // The larger of two errors, and the least bound.
    let found = computed("hs-graze-0.001", rule).unwrap();
    assert_eq!(found, Bound::Absolute(7.1e-11));
    let found = computed("os-06-mode2", rule).unwrap();
    assert_eq!(found, Bound::Absolute(1e-13));
    let relative = rule.replace("absolute", "relative");
    let found = computed("smp-A-p3", &relative).unwrap();
    assert_eq!(found, Bound::Relative(1.2e-11));
    for (from, to) in [
        ("peak", "peaks"),
        ("of =", "off ="),
        (", least = 1e-13", ""),
        ("100", "nan"),
        ("100", "-100"),
        ("1e-13", "nan"),
        ("absolute", "order"),
    ] {
        let flaw = rule.replacen(from, to, 1);
        assert_ne!(flaw, rule);
        assert!(computed("smp-A-p3", &flaw).is_err(), "{flaw}");
    }
    let error = computed("no-such", rule).unwrap_err().to_string();
    assert!(error.contains("case `a`: tolerance.bounds.x"), "{error}");
    let nowhere = GOOD.replace("\"exact\"", rule);
    let error = load_family("f", &nowhere).unwrap_err().to_string();
    assert!(error.contains("`a` names no `entry`"), "{error}");
}

#[test]
fn a_bound_typed_like_the_computed_one_is_refused() {
    let rule = "[family.default]\ntolerance.bounds.x = { absolute = { \
                attainable = 100, of = [\"peak\"], least = 1e-13 } }\n[[case]]";
    let text = GOOD.replace("[[case]]", rule);
    let text =
        text.replace("name = \"a\"", "name = \"a\"\ninput.entry = \"hs-01\"");
    let same = text.replace("\"exact\"", "{ absolute = 2.4e-13 }");
    let error = load_family("f", &same).unwrap_err().to_string();
    assert!(error.contains("repeats the inherited value"), "{error}");
}

#[test]
fn the_reason_shows_the_error_of_the_reference() {
    let text = GOOD
        .replace(
            "name = \"a\"",
            "name = \"a\"\ninput.entry = \"os-02-survive\"",
        )
        .replace("because = \"b\"", "because = \"off by {attainable}\"");
    let case = &load_family("f", &text).unwrap()[0];
    assert_eq!(case.tolerance.because, "off by 1e-14");
}

fn one(bound: Bound, seen: &[f64], wanted: &[f64]) -> bool {
    let map = |x: &[f64]| BTreeMap::from([("q".to_owned(), x.to_vec())]);
    let bounds = BTreeMap::from([("q".to_owned(), bound)]);
    judge(&bounds, &map(seen), &map(wanted), None).unwrap()[0].holds()
}

#[test]
fn holds_each_kind_of_bound_on_both_sides() {
    assert!(one(Bound::Exact, &[1.0], &[1.0]));
    assert!(!one(Bound::Exact, &[1.0 + 1e-16 + 2e-16], &[1.0]));
    assert!(one(Bound::Absolute(0.1), &[1.05], &[1.0]));
    assert!(!one(Bound::Absolute(0.1), &[0.89], &[1.0]));
    assert!(one(Bound::Relative(0.1), &[10.9], &[10.0]));
    assert!(!one(Bound::Relative(0.1), &[1e-9], &[0.0]));
    assert!(one(Bound::Relative(0.1), &[f64::INFINITY], &[f64::INFINITY]));
    assert!(one(Bound::Order(0.2), &[7.9, 9.0], &[8.0, 8.0]));
    assert!(!one(Bound::Order(0.2), &[7.7], &[8.0]));
    assert!(!one(Bound::Order(0.2), &[-8.0], &[8.0]));
    assert!(one(Bound::Interval(0.0, 1.0), &[0.5], &[]));
    assert!(!one(Bound::Interval(0.0, 1.0), &[], &[]));
}

#[test]
fn refuses_nan_and_missing_values() {
    for bound in [Bound::Exact, Bound::Absolute(1.0), Bound::Order(9.0)] {
        assert!(!one(bound.clone(), &[f64::NAN], &[1.0]));
        assert!(!one(bound.clone(), &[f64::NAN], &[f64::NAN]));
        assert!(!one(bound.clone(), &[], &[1.0]));
        assert!(!one(bound, &[1.0, 1.0], &[1.0]));
    }
    assert!(!one(Bound::Interval(0.0, 1.0), &[f64::NAN], &[]));
    let none = Quantities::new();
    let some = BTreeMap::from([("q".to_owned(), vec![1.0])]);
    let bounds = BTreeMap::from([("q".to_owned(), Bound::Exact)]);
    assert!(judge(&BTreeMap::new(), &some, &some, None).is_err());
    assert!(judge(&bounds, &none, &none, None).is_err());
    assert!(judge(&bounds, &some, &none, None).is_err());
}

/// What was counted in each case of work counters, as the CSV that
/// [`expect_counters`] reads: one row for each trajectory.
fn counters_csv(found: &[(&Case, Quantities)]) -> String {
    let names: Vec<&str> = found[0].1.keys().map(String::as_str).collect();
    let mut table = Table::new(&[&["trajectory"], &names[..]].concat());
    for (case, counts) in found {
        let entries = case.input["entries"].as_array().unwrap();
        for (k, entry) in entries.iter().enumerate() {
            let counts = names.iter().map(|name| digits(counts[*name][k], 17));
            let entry = entry.as_str().unwrap().to_owned();
            table.row([entry].into_iter().chain(counts));
        }
    }
    table.finish()
}

#[test]
fn what_is_counted_is_what_is_expected() {
    let mut cases = load_all().unwrap();
    cases.retain(|case| case.method == COUNTERS);
    let run = |case: &Case| methods::run_method(case, None).unwrap().observed;
    let found: Vec<_> = cases.iter().map(|c| (c, run(c))).collect();
    let csv = counters_csv(&found);
    assert!(csv.lines().count() > 30);
    let kept = committed("validation/proof/work-counters.csv", &csv);
    // `.ci/accept` writes it, and judges the cases by it.
    let Some(kept) = kept else { return };
    assert!(csv == kept, "work-counters.csv: expected\n{csv}");
    // An accepted number that is another is one that is expected.
    let other = csv.replacen(",25,", ",26,", 1);
    assert_ne!(other, csv);
    let mut changed = cases.clone();
    expect_counters(&mut changed, &other);
    assert_ne!(changed, cases);
    expect_counters(&mut changed, &csv);
    assert_eq!(changed, cases);
}

/// The proof computes each pulse of the core anew.
#[test]
fn every_pulse_has_its_oracle() {
    for name in PulseName::ALL {
        let forcing = Forcing::pulse(name, 2.0, 1.3);
        let Forcing::Pulse(kind) = forcing else { unreachable!() };
        let core = Pulse::try_new(kind).unwrap();
        let end_s = core.duration_s();
        near(name.name(), forcing.end_s(), end_s, 1e-14 * end_s);
        for (piece, ends) in forcing.pieces_s().windows(2).enumerate() {
            for share in [0.1, 0.5, 0.9] {
                let t_s = ends[0] + share * (ends[1] - ends[0]);
                let own = forcing.at(piece, t_s);
                near(name.name(), own, core.acceleration_g(t_s), 1e-12);
            }
        }
        let uplift = linear::respond(kind, 0.9, 1).uplift.unwrap();
        let at_uplift = core.acceleration_g(uplift).abs();
        assert!(uplift == 0.0 || (at_uplift - 1.0).abs() < 1e-9, "{name}");
    }
}
