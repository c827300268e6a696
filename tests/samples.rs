//! The commands that read sample files and curves, run as a user runs them.
//!
//! Expected numbers are those of R, NumPy, SciPy and mpmath in
//! `fixtures/oracles`.

use std::path::PathBuf;
use std::process::{Command, Output};

use rocking::statistics::normal;
use serde_json::Value;

use super::compare::near;

/// The sample of `fixtures/oracles/lognormal.py` and of sample b of
/// `normality.R`, in a user's spelling.
const SAMPLE: &str = "# intensities\n1.05\n1.12 # first\n1.2\n1.21\n\n1.3\n\
    1.33\n1.41\n1.5\n1.52\n1.6\n1.75\n1.8\n1.93\n2.0\n2.2\r\n2.4\n2.45\n\
    2.9\n3.1\n3.8\n4.5\n7.5\n";

fn file(name: &str, content: &str) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, content).unwrap();
    path.to_str().unwrap().to_owned()
}

fn rocking(args: &[&str]) -> Output {
    let binary = env!("CARGO_BIN_EXE_rocking");
    Command::new(binary).args(args).output().unwrap()
}

fn json(args: &[&str]) -> Value {
    let output = rocking(args);
    let error = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{args:?}: {error}");
    serde_json::from_slice(&output.stdout).unwrap()
}

/// What a refused command says; its exit status is 2 and it prints nothing.
fn refused(args: &[&str]) -> String {
    let output = rocking(args);
    assert_eq!(output.status.code(), Some(2), "{args:?}");
    assert!(output.stdout.is_empty(), "{args:?}");
    String::from_utf8(output.stderr).unwrap()
}

#[track_caller]
fn close(value: &Value, expected: f64, tolerance: f64) {
    let limit = tolerance * expected.abs();
    near("number printed", value.as_f64().unwrap(), expected, limit);
}

/// A row of an oracle's CSV by its first fields.
fn oracle(csv: &str, keys: &[&str]) -> Vec<f64> {
    let row = csv
        .lines()
        .map(|line| line.split(',').collect::<Vec<_>>())
        .find(|fields| fields.starts_with(keys))
        .unwrap();
    row[keys.len()..].iter().map(|f| f.parse().unwrap()).collect()
}

#[test]
fn fragility_agrees_with_scipy_and_mpmath() {
    let csv = include_str!("../fixtures/oracles/lognormal.csv");
    let sample = file("fragility.txt", SAMPLE);
    for method in ["mle", "moment", "quantile", "trimmed", "censored"] {
        for shift in ["0", "1"] {
            let expected = oracle(csv, &[method, shift]);
            let out = json(&[
                "fragility",
                "fit",
                "--sample",
                &sample,
                "--shift",
                shift,
                "--method",
                method,
                "--json",
            ]);
            let keys = [
                "/n_kept",
                "/fitted/log_mean",
                "/fitted/dispersion",
                "/log_likelihood",
                "/ks_distance",
                "/area_distance",
            ];
            for (key, expected) in keys.iter().zip(expected) {
                close(out.pointer(key).unwrap(), expected, 1e-12);
            }
        }
    }
}

#[test]
fn a_free_shift_agrees_with_mpmath_and_brings_its_interval() {
    let csv = include_str!("../fixtures/oracles/rivals.csv");
    let expected = oracle(csv, &["profile"]);
    let sample = file("free-shift.txt", SAMPLE);
    let args = ["fragility", "fit", "--sample", &sample, "--shift", "free"];
    let out = json(&[&args[..], &["--json"]].concat());
    // The place of a maximum is known to the root of the rounding.
    close(&out["fitted"]["shift"], expected[0], 1e-7);
    close(&out["shift_interval"]["low"], expected[1], 1e-9);
    close(&out["shift_interval"]["high"], expected[2], 1e-9);
    close(&out["log_likelihood"], expected[3], 1e-13);
    for (more, words) in [
        (&["--bootstrap", "9"][..], "interval of the shift"),
        (&["--method", "moment"], "expected the method mle"),
    ] {
        assert!(refused(&[&args[..], more].concat()).contains(words));
    }
    let left = file("no-shift.txt", "1\n4\n6\n7\n7.5\n7.9\n");
    let free = ["fragility", "fit", "--sample", &left, "--shift", "free"];
    let said = refused(&free);
    assert!(said.contains("no maximum over the shift"), "{said}");
    let said = refused(&["lilliefors", "--sample", &left, "--shift", "free"]);
    assert!(said.contains("choice of distributions"), "{said}");
}

#[test]
fn fragility_tells_intervals_in_rows_and_the_unit() {
    let sample = file("intervals.txt", SAMPLE);
    let args = [
        "fragility",
        "fit",
        "--sample",
        &sample,
        "--shift",
        "1",
        "--bootstrap",
        "50",
    ];
    let text = String::from_utf8(rocking(&args).stdout).unwrap();
    assert!(!text.contains(['{', '}', '"', '_']), "{text}");
    let bca = text.lines().filter(|line| line.starts_with("    bca "));
    let intervals: Vec<&str> = bca.collect();
    assert_eq!(intervals.len(), 6, "{text}");
    for line in intervals {
        assert!(line.contains('[') && line.ends_with(']'), "{text}");
    }
    assert!(text.contains("that of the sample"), "{text}");
    let out = json(&[&args[..], &["--json"]].concat());
    assert_eq!(out["unit"], "that of the sample");
    assert_eq!(out["bootstrap"]["replicates"], 50);
}

#[test]
fn equations_are_undefined_with_their_limit() {
    let with_c = |c| {
        json(&[
            "fragility",
            "transform",
            "--im50",
            "1.9",
            "--beta",
            "0.6",
            "--shift",
            "1",
            "--c",
            c,
            "--json",
        ])
    };
    let csv = include_str!("../fixtures/oracles/fragility.csv");
    let expected = oracle(csv, &["1.9", "0.6", "1", "0.75"]);
    close(&with_c("0.75")["eq7"], expected[0], 1e-14);
    let out = with_c("2");
    let reason = out["eq7"]["reason"].as_str().unwrap();
    assert!(reason.contains("c_max"), "{reason}");
    // ln(1.9)/0.6
    close(&out["c_max"], 1.069_756_476_953_991_3, 1e-14);
    close(&out["eq5"], -0.105_360_515_657_826_4, 1e-14);
}

#[test]
fn lilliefors_agrees_with_r() {
    let csv = include_str!("../fixtures/oracles/normality.csv");
    let expected = oracle(csv, &["b", "22"]);
    let sample = file("lilliefors.txt", SAMPLE);
    let out = json(&["lilliefors", "--sample", &sample, "--log", "--json"]);
    let keys = [
        "/statistic/d",
        "/anderson_darling/statistic",
        "/anderson_darling/p_value",
        "/cramer_von_mises/statistic",
        "/cramer_von_mises/p_value",
        "/shapiro_wilk/statistic",
        "/shapiro_wilk/p_value",
    ];
    for (key, expected) in keys.iter().zip(expected) {
        close(out.pointer(key).unwrap(), expected, 1e-9);
    }
    assert_eq!(out["n"], 22);
    assert_eq!(out["verdict"], "not-rejected");
    // Critical value of an independent simulation (its error 4e-5).
    close(&out["critical_value"], 0.18367, 1e-3);
}

#[test]
fn lilliefors_says_why_it_gives_no_verdict() {
    let sample = file("refused.txt", SAMPLE);
    let censored = file("censored.txt", "1\n2\n3\n4\n5\ninf\n");
    let ties = file("ties.txt", "1\n2\n2\n2\n2\n2\n2\n3\n4\n5\n");
    let few = file("few.txt", "1\n2\n3\n");
    for (args, reason) in [
        (vec!["--sample", &censored], "infinite"),
        (vec!["--sample", &ties], "ties"),
        (vec!["--sample", &few], "at least 4"),
        (vec!["--sample", &sample, "--shift", "1.1"], "above the shift"),
    ] {
        let out = json(&[&["lilliefors", "--json"], &args[..]].concat());
        assert_eq!(out["verdict"], Value::Null, "{args:?}");
        assert!(out["reason"].as_str().unwrap().contains(reason));
    }
}

#[test]
fn large_samples_are_simulated_without_shapiro_and_wilk() {
    // Evenly spaced normal scores: as normal as a sample can be.
    let scores = (1..=5001).map(|i| {
        normal::quantile((f64::from(i) - 0.5) / 5001.0).to_string() + "\n"
    });
    let sample = file("large", &scores.collect::<String>());
    let test = |more: &[&str]| {
        let args = ["lilliefors", "--sample", &sample, "--json"];
        json(&[&args[..], more].concat())
    };
    let found = test(&["--replicates", "200", "--seed", "1"]);
    assert_eq!(found["verdict"], "not-rejected");
    assert_eq!(found["replicates"], 200);
    assert_eq!(found["shapiro_wilk"], Value::Null);
    assert!(found["anderson_darling"]["p_value"].as_f64().unwrap() > 0.99);
}

#[test]
fn critical_values_do_not_depend_on_threads() {
    let run = |threads| {
        rocking(&[
            "lilliefors",
            "--critical-values",
            "--n",
            "20",
            "--replicates",
            "20000",
            "--threads",
            threads,
            "--json",
        ])
    };
    let (one, two) = (run("1"), run("2"));
    assert_eq!(one.stdout, two.stdout);
    let out: Value = serde_json::from_slice(&one.stdout).unwrap();
    let out = &out["critical_value"];
    let (low, high) = (&out["low"], &out["high"]);
    let interval = low.as_f64().unwrap()..high.as_f64().unwrap();
    // Four standard errors, from an independent simulation.
    let half = 2.0 * (interval.end - interval.start);
    assert!((out["value"].as_f64().unwrap() - 0.19193).abs() < half);
}

#[test]
fn quantiles_and_boxplots_agree_with_numpy() {
    let sample = file("quantile.txt", SAMPLE);
    // numpy.quantile of methods hazen and linear.
    for (number, expected) in
        [("5", [1.2118, 1.775, 3.096]), ("7", [1.2424, 1.775, 3.028])]
    {
        let out = json(&[
            "sample",
            "--sample",
            &sample,
            "--quantile-type",
            number,
            "--at",
            "0.16,0.5,0.84",
            "--json",
        ]);
        for (value, expected) in
            out["quantiles"].as_array().unwrap().iter().zip(expected)
        {
            close(&value["value"], expected, 1e-12);
        }
    }
    let out = json(&["sample", "--sample", &sample, "--json"]);
    let out = &out["boxplot"];
    for (key, expected) in [
        ("q1", 1.33),
        ("median", 1.775),
        ("q3", 2.45),
        ("whisker_low", 1.05),
        ("whisker_high", 3.8),
    ] {
        close(&out[key], expected, 1e-12);
    }
    for (key, expected) in [
        // Ranks 6 and 17 of 22: 1 - 2 P(B <= 5).
        ("low", 1.33),
        ("high", 2.45),
        ("coverage", 0.983_099_460_601_806_6),
    ] {
        close(&out["median_interval"][key], expected, 1e-12);
    }
    let outliers: Vec<f64> =
        serde_json::from_value(out["outliers"].clone()).unwrap();
    assert_eq!(outliers, [4.5, 7.5]);
}

#[test]
fn capacities_agree_with_exact_rationals() {
    let curve = "1:0,1.2:0.4,1.4:0.8,1.6:0.5,1.8:0.3";
    let out = json(&[
        "capacities",
        "--curve",
        curve,
        "--overturning",
        "2",
        "--levels",
        "0.5,1",
        "--json",
    ]);
    let level = &out["levels"][0];
    for (key, expected) in
        [("median", 1.6), ("first", 1.25), ("last", 2.0), ("monotone", 1.65)]
    {
        close(&level[key], expected, 1e-15);
    }
    assert_eq!(level["crossings"].as_array().unwrap().len(), 3);
    close(&out["levels"][1]["median"], 2.0, 0.0);
    let out = json(&["capacities", "--curve", "1:0,1.2:0.4", "--json"]);
    let last = out["levels"].as_array().unwrap().last().unwrap().clone();
    close(&last["edp"], 1.0, 0.0);
    assert_eq!(last["median"], serde_json::Value::Null, "censored");
}

#[test]
fn ratios_are_compared_pair_by_pair() {
    let a = file(
        "a.txt",
        "0.93\n1.08\n1.01\n0.98\n1.13\n0.99\n1.02\n1.035\n\
        0.87\n1.11\n1.06\ninf\n0\n1\n",
    );
    let b = file("b.txt", &("1\n".repeat(12) + "0\ninf\n"));
    let out = json(&["compare", "--a", &a, "--b", &b, "--json"]);
    let csv = include_str!("../fixtures/oracles/paired.csv");
    let expected = |key: &str| oracle(csv, &["a", key])[0];
    let mean = &out["mean_equivalence"];
    close(&mean["p_upper"], expected("p_upper"), 1e-9);
    let median = &out["median_equivalence"];
    close(&median["p_lower"], expected("sign_lower"), 1e-9);
    close(&out["sign_test"]["p_value"], expected("sign"), 1e-12);
    close(&out["hodges_lehmann"]["low"], expected("hl_low"), 1e-12);
    for (key, count) in [
        ("n", 14),
        ("usable", 11),
        ("only_a_infinite", 1),
        ("only_b_infinite", 1),
        ("both_zero", 1),
    ] {
        assert_eq!(out[key], count, "{key}");
    }
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let sample = file("good.txt", SAMPLE);
    let letters = file("letters.txt", "1\n2\nthree\n");
    let nan = file("nan.txt", "1\nnan\n");
    let huge = file("huge.txt", "1\n1e400\n");
    let empty = file("empty.txt", "# nothing\n");
    for (args, expected) in [
        (vec!["sample", "--sample", &letters], "letters.txt:3"),
        (vec!["sample", "--sample", &nan], "nan.txt:2"),
        (vec!["fragility", "fit", "--sample", &huge], "huge.txt:2"),
        (vec!["lilliefors", "--sample", &empty], "empty"),
        (vec!["sample", "--sample", "/no/such/file"], "/no/such/file"),
        (vec!["compare", "--a", &sample, "--b", &empty], "empty"),
        (
            vec!["sample", "--sample", &sample, "--quantile-type", "10"],
            "1 to 9",
        ),
        (vec!["sample", "--sample", &sample, "--at", "-0.1"], "[0, 1]"),
        (
            vec!["fragility", "fit", "--sample", &sample, "--shift", "-1"],
            "negative",
        ),
        (
            [
                "fragility",
                "fit",
                "--sample",
                &sample,
                "--shift",
                "min",
                "--bootstrap",
                "100",
            ]
            .into(),
            "gives no interval",
        ),
        (
            vec!["fragility", "fit", "--sample", &sample, "--im50", "2"],
            "--im50",
        ),
        (vec!["lilliefors", "--sample", &sample, "--n", "9"], "--n"),
        (vec!["lilliefors", "--critical-values", "--n", "3"], "at least 4"),
        (vec!["lilliefors", "--sample", &sample, "--level", "2"], "level"),
        (vec!["capacities", "--curve", "1:0.1"], "EDP"),
        (vec!["capacities", "--curve", "1:0,0.9:0.2"], "increasing"),
        (vec!["capacities", "--curve", "1:0", "--im", "pga"], "--im"),
        (vec!["capacities", "--ida", &sample], "columns"),
    ] {
        let message = refused(&args);
        assert!(message.contains(expected), "{args:?}: {message}");
    }
}
