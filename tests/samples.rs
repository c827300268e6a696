//! The commands that read sample files and curves, run as a user runs them.
//!
//! The declared cases prove the numbers; here one value of each command shows
//! that the command asks for what it prints.

use rocking_statistics::normal;
use serde_json::Value;

use super::support::{answer, close, folder, json, refused};

/// The sample of `fixtures/oracles/lognormal.py` and of sample b of
/// `normality.R`, in a user's spelling.
const SAMPLE: &str = "# intensities\n1.05\n1.12 # first\n1.2\n1.21\n\n1.3\n\
    1.33\n1.41\n1.5\n1.52\n1.6\n1.75\n1.8\n1.93\n2.0\n2.2\r\n2.4\n2.45\n\
    2.9\n3.1\n3.8\n4.5\n7.5\n";

/// A folder with the sample and these files.
fn with(name: &str, files: &[(&str, &str)]) -> crate::support::Place {
    let own = [("sample.txt", SAMPLE)];
    folder(&format!("samples-{name}"), &[&own, files].concat())
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
fn a_fit_is_that_of_the_method_and_the_shift() {
    let csv = include_str!("../fixtures/oracles/lognormal.csv");
    let fit = "fragility fit --sample sample.txt --shift 1 --method trimmed";
    let out = json(&with("fit", &[]), fit);
    let expected = oracle(csv, &["trimmed", "1"]);
    close(&out["fitted"]["dispersion"], expected[2], 1e-12);
}

#[test]
fn a_free_shift_brings_its_interval() {
    let csv = include_str!("../fixtures/oracles/likelihoods.csv");
    let left = "1\n4\n6\n7\n7.5\n7.9\n";
    let place = with("free", &[("left.txt", left)]);
    let free = "fragility fit --sample sample.txt --shift free";
    let out = json(&place, free);
    let expected = oracle(csv, &["profile"]);
    close(&out["shift_interval"]["high"], expected[2], 1e-9);
    for (command, words) in [
        (&*format!("{free} --bootstrap 9"), "interval of the shift"),
        (&*format!("{free} --method moment"), "expected the method mle"),
        (
            "fragility fit --sample left.txt --shift free",
            "no maximum over the shift",
        ),
        (
            "lilliefors --sample left.txt --shift free",
            "expected a non-negative number, or min",
        ),
    ] {
        let said = refused(&place, command);
        assert!(said.contains(words), "{said}");
    }
}

#[test]
fn fragility_tells_intervals_in_rows_and_the_unit() {
    let place = with("intervals", &[]);
    let fit = "fragility fit --sample sample.txt --shift 1 --bootstrap 50";
    let text = answer(&place, fit);
    assert!(!text.contains(['{', '}', '"', '_']), "{text}");
    assert!(text.starts_with("The fragility has a median of "), "{text}");
    // Of median and dispersion in the sentence, and of Eqs. 5 to 7.
    assert_eq!(text.matches("95 % interval ").count(), 5, "{text}");
    let rough = "intervals are rough: 50 draws, fewer than 200";
    assert!(text.contains(rough), "{text}");
    assert!(text.contains("that of the sample"), "{text}");
    let out = json(&place, fit);
    assert_eq!(out["unit"], "that of the sample");
    assert_eq!(out["bootstrap"]["replicates"], 50);
    assert_eq!(out["bootstrap"]["remark"], rough);
}

/// Two values have no interval, and two draws a rough one.
#[test]
fn few_values_and_few_draws_are_said() {
    let files = [("two.txt", "1.5\n2.5\n"), ("few.txt", "1.5\n2\n3.5\n")];
    let place = with("few", &files);
    let fit = |file: &str, draws: usize| {
        let words = "--band 2 --bootstrap";
        let words = format!("fragility fit --sample {file} {words} {draws}");
        json(&place, &words)
    };
    let out = fit("two.txt", 200);
    let found = &out["bootstrap"];
    assert_eq!(found["remark"], "no intervals: 2 records, fewer than 8");
    assert!(found["dispersion"].is_null() && found["median"].is_null());
    assert!(out["band"]["points"][0]["low"].is_null(), "{out}");
    let out = fit("few.txt", 2);
    let rough = "intervals are rough: 3 records, fewer than 8; 2 draws, fewer than 200";
    assert_eq!(out["bootstrap"]["remark"], rough);
    assert_eq!(out["band"]["remark"], rough);
}

#[test]
fn equations_are_undefined_with_their_limit() {
    let place = with("equations", &[]);
    let transform = "fragility transform --im50 1.9 --beta 0.6 --shift 1";
    let with_c = |c| json(&place, &format!("{transform} --c {c}"));
    let csv = include_str!("../fixtures/oracles/fragility.csv");
    let expected = oracle(csv, &["1.9", "0.6", "1", "0.75"]);
    close(&with_c("0.75")["eq7"], expected[0], 1e-14);
    let out = with_c("2");
    let reason = out["eq7"]["reason"].as_str().unwrap();
    assert!(reason.contains("c_max"), "{reason}");
    // ln(1.9)/0.6, ln(1.9 - 1)
    close(&out["c_max"], 1.069_756_476_953_991_3, 1e-14);
    close(&out["eq5"], -0.105_360_515_657_826_4, 1e-14);
}

#[test]
fn lilliefors_tests_the_logarithms() {
    let csv = include_str!("../fixtures/oracles/normality.csv");
    let expected = oracle(csv, &["b", "22"]);
    let place = with("lilliefors", &[]);
    let out = json(&place, "lilliefors --sample sample.txt --log");
    close(&out["statistic"]["d"], expected[0], 1e-9);
    close(&out["shapiro_wilk"]["p_value"], expected[6], 1e-9);
    assert_eq!(out["n"], 22);
    assert_eq!(out["verdict"], "not-rejected");
}

#[test]
fn lilliefors_says_why_it_gives_no_verdict() {
    let files = [
        ("censored.txt", "1\n2\n3\n4\n5\ninf\n"),
        ("ties.txt", "1\n2\n2\n2\n2\n2\n2\n3\n4\n5\n"),
        ("few.txt", "1\n2\n3\n"),
    ];
    let place = with("no-verdict", &files);
    for (sample, reason) in [
        ("censored.txt", "infinite"),
        ("ties.txt", "ties"),
        ("few.txt", "at least 4"),
        ("sample.txt --shift 1.1", "above the shift"),
    ] {
        let out = json(&place, &format!("lilliefors --sample {sample}"));
        assert_eq!(out["verdict"], Value::Null, "{sample}");
        assert!(out["reason"].as_str().unwrap().contains(reason));
    }
}

#[test]
fn large_samples_are_simulated_without_shapiro_and_wilk() {
    // Evenly spaced normal scores: as normal as a sample can be.
    let scores = (1..=5001).map(|i| {
        normal::quantile((f64::from(i) - 0.5) / 5001.0).to_string() + "\n"
    });
    let scores: String = scores.collect();
    let place = with("large", &[("large.txt", &scores)]);
    let test = "lilliefors --sample large.txt --replicates 200 --seed 1";
    let found = json(&place, test);
    assert_eq!(found["verdict"], "not-rejected");
    assert_eq!(found["replicates"], 200);
    assert_eq!(found["shapiro_wilk"], Value::Null);
    assert!(found["anderson_darling"]["p_value"].as_f64().unwrap() > 0.99);
}

#[test]
fn quantiles_are_of_the_type_and_boxplots_have_their_parts() {
    let place = with("quantiles", &[]);
    let words = "sample --sample sample.txt --quantile-type 7 --at 0.5,0.84";
    // numpy.quantile of method linear.
    close(&json(&place, words)["quantiles"][1]["value"], 3.028, 1e-12);
    let out = json(&place, "sample --sample sample.txt");
    let out = &out["boxplot"];
    close(&out["median"], 1.775, 1e-12);
    // Ranks 6 and 17 of 22: 1 - 2 P(B <= 5).
    let coverage = 0.983_099_460_601_806_6;
    close(&out["median_interval"]["coverage"], coverage, 1e-12);
    assert_eq!(out["outliers"], serde_json::json!([4.5, 7.5]));
}

#[test]
fn capacities_of_a_curve_have_their_places() {
    let place = with("capacities", &[]);
    let curve = "1:0,1.2:0.4,1.4:0.8,1.6:0.5,1.8:0.3";
    let words = format!("capacities --curve {curve} --overturning 2");
    let out = json(&place, &format!("{words} --levels 0.5,1"));
    let level = &out["levels"][0];
    // By exact rationals.
    for (key, expected) in
        [("median", 1.6), ("first", 1.25), ("last", 2.0), ("monotone", 1.65)]
    {
        close(&level[key], expected, 1e-15);
    }
    assert_eq!(level["crossings"].as_array().unwrap().len(), 3);
    close(&out["levels"][1]["median"], 2.0, 0.0);
    let out = json(&place, "capacities --curve 1:0,1.2:0.4");
    let last = out["levels"].as_array().unwrap().last().unwrap().clone();
    close(&last["edp"], 1.0, 0.0);
    assert_eq!(last["median"], Value::Null, "censored");
}

#[test]
fn ratios_are_compared_pair_by_pair() {
    let a = "0.93\n1.08\n1.01\n0.98\n1.13\n0.99\n1.02\n1.035\n0.87\n1.11\n\
             1.06\ninf\n0\n1\n";
    let b = "1\n".repeat(12) + "0\ninf\n";
    let place = with("pairs", &[("a.txt", a), ("b.txt", &b)]);
    let said = refused(&place, "compare --a a.txt --b b.txt");
    assert!(said.contains("a.txt: 0 names of records for 14"), "{said}");
    // The second file has the records in the opposite order.
    let named = |text: &str, backwards: bool| {
        let lines = text.lines().enumerate();
        let lines = lines.map(|(i, value)| format!("{value} # r{i}\n"));
        let mut lines: Vec<String> = lines.collect();
        if backwards {
            lines.reverse();
        }
        lines.concat()
    };
    let (a, b) = (named(a, false), named(&b, true));
    let place = with("pairs-named", &[("a.txt", &a), ("b.txt", &b)]);
    let out = json(&place, "compare --a a.txt --b b.txt");
    let csv = include_str!("../fixtures/oracles/paired.csv");
    let expected = |key: &str| oracle(csv, &["a", key])[0];
    let mean = &out["mean_equivalence"];
    close(&mean["p_upper"], expected("p_upper"), 1e-9);
    let median = &out["median_equivalence"];
    close(&median["p_lower"], expected("sign_lower"), 1e-9);
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
fn other_records_are_contrasted() {
    let few = "1.1\n1.3\n1.4\n1.8\n";
    let others = "2.2 # a # X\n2.6 # b # X\n2.8 # c # Y\n3.6 # d # Z\n";
    let files = [("few.txt", few), ("others.txt", others)];
    let place = with("contrast", &files);
    let out = json(&place, "contrast --a few.txt --b others.txt");
    close(&out["median_ratio"]["point"], 1.35 / 2.7, 1e-12);
    assert_eq!(out["kolmogorov_smirnov"]["distance"], 1.0);
    let reason = out["kolmogorov_smirnov"]["p_value"]["reason"].as_str();
    assert!(reason.unwrap().contains("not independent"), "{out}");
    let drawn = "4 records of 3 earthquakes; unit: earthquake";
    assert_eq!(out["b"]["drawn"], drawn);
    let out = json(&place, "contrast --a few.txt --b few.txt --bootstrap 99");
    close(&out["kolmogorov_smirnov"]["p_value"], 1.0, 0.0);
    let same = "contrast --a others.txt --b others.txt";
    let said = refused(&place, same);
    assert!(said.contains("record a is in both samples"), "{said}");
}

#[test]
fn bad_input_is_refused_with_its_place() {
    let files = [
        ("letters.txt", "1\n2\nthree\n"),
        ("nan.txt", "1\nnan\n"),
        ("huge.txt", "1\n1e400\n"),
        ("empty.txt", "# nothing\n"),
    ];
    let place = with("bad", &files);
    let fit = "fragility fit --sample sample.txt";
    for (command, expected) in [
        ("sample --sample letters.txt", "letters.txt:3"),
        ("sample --sample nan.txt", "nan.txt:2"),
        ("fragility fit --sample huge.txt", "huge.txt:2"),
        ("lilliefors --sample empty.txt", "empty"),
        ("sample --sample /no/such/file", "/no/such/file"),
        ("compare --a sample.txt --b empty.txt", "empty"),
        ("sample --sample sample.txt --quantile-type 10", "1 to 9"),
        ("sample --sample sample.txt --at -0.1", "[0, 1]"),
        (&format!("{fit} --shift -1"), "negative"),
        (&format!("{fit} --shift min --bootstrap 100"), "no valid"),
        (&format!("{fit} --im50 2"), "--im50"),
        ("lilliefors --sample sample.txt --n 9", "--n"),
        ("lilliefors --critical-values --n 3", "at least 4"),
        ("lilliefors --sample sample.txt --level 2", "level"),
        ("capacities --curve 1:0.1", "EDP"),
        ("capacities --curve 1:0,0.9:0.2", "increasing"),
        ("capacities --curve 1:0 --im pga", "--im"),
        ("capacities --ida sample.txt", "columns"),
    ] {
        let message = refused(&place, command);
        assert!(message.contains(expected), "{command}: {message}");
    }
}
