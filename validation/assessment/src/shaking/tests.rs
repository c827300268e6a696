use rocking_procedures::shaking::TestComparison;
use serde_json::{Value, json};

use super::{files, page, text};
use crate::About;

fn estimate(point: f64, low: f64, high: f64) -> Value {
    json!({ "point": point, "low": low, "high": high })
}

fn predictor(name: &str, score: f64, median: Value) -> Value {
    json!({
        "predictor": name,
        "right": estimate(0.8, 0.7, 0.9),
        "median": median,
        "dispersion": estimate(0.31, 0.25, 0.4),
        "auc": estimate(0.95, 0.9, 0.97),
        "log_score": estimate(score, 0.9 * score, 1.1 * score),
        "log_likelihood": -100.0 * score,
    })
}

/// A comparison of 100 made-up tests: every second one overturned the
/// specimen.
fn made_up() -> Value {
    let each = (0..100).map(|k| {
        let capacity = 2.0 / (0.3 + 0.03 * f64::from(k));
        json!({
            "test": format!("t{k}"),
            "motion": format!("m{}", k % 9),
            "pga_g": 0.01 * f64::from(k + 1),
            "intensities":
                [0.01 * f64::from(k + 1), 0.004 * f64::from(k % 9 + 1)],
            "capacity_factor": capacity,
            "overturns_at_level": capacity <= 1.0,
            "probability": 0.01 * f64::from(k),
            "overturned": k % 2 == 1 || k > 60,
        })
    });
    let reliability = (0..10).map(|k| {
        let share = 0.05 + 0.1 * f64::from(k);
        json!({
            "tests": 10,
            "predicted": share,
            "observed": estimate(share, share - 0.05, share + 0.05),
        })
    });
    let distribution = |im: &str, unit: &str, scale: f64| {
        json!({
            "im": im,
            "unit": unit,
            "measured_median": 0.4 * scale,
            "measured_dispersion": 0.6,
            "computed_median": 0.42 * scale,
            "computed_dispersion": 0.52,
            "median_ratio": estimate(0.952, 0.9, 1.02),
            "dispersion_difference": estimate(0.08, 0.02, 0.13),
            "missing_dispersion": estimate(0.299, 0.15, 0.38),
        })
    };
    json!({
        "tests": 100,
        "motions": 9,
        "overturned": 70,
        "unknown": 2,
        "never_overturned": 1,
        "alpha_rad": { "point": 0.085, "low": null, "high": null },
        "alpha_is_fitted": false,
        "p_rad_s": 4.55,
        "eta": 0.92,
        "model": "nonlinear",
        "level": 0.9,
        "replicates": 500,
        "seed": 0,
        "remark": "few motions",
        "computed": predictor("block", 0.21, estimate(1.02, 0.97, 1.08)),
        "rivals": [
            predictor("pga", 0.4, estimate(0.4, 0.3, 0.5)),
            predictor("pgv", 0.3, estimate(0.2, 0.15, 0.25)),
        ],
        "unfitted": [],
        "reliability": reliability.collect::<Vec<_>>(),
        "repeatability": {
            "pairs": 12,
            "different": 2,
            "mixed_motions": 8,
            "not_monotone": 3,
            "dispersion": 0.12,
        },
        "resurrected": {
            "tests": 5,
            "overturned": 2,
            "expected": 4.6,
            "right_at_level": 0.79,
        },
        "onset": {
            "onset_g": 0.0852,
            "tests": 90,
            "overturned_below": 0,
            "below": 10,
            "whole": -20.5,
            "above": -22.5,
            "pga_unshifted": -41.5,
            "pga_shifted": null,
        },
        "distributions": [
            distribution("pga", "g", 1.0),
            distribution("pgv", "m/s", 0.2),
        ],
        "each": each.collect::<Vec<_>>(),
    })
}

/// The comparison, a field of it by its place set to another value.
fn comparison(place: &str, value: Value) -> TestComparison {
    let mut made_up = made_up();
    *made_up.pointer_mut(place).unwrap() = value;
    serde_json::from_value(made_up).unwrap()
}

fn page_of(found: &TestComparison) -> String {
    page(found, &About::default())
}

#[test]
fn sentences_follow_the_intervals() {
    let median = "/computed/median";
    let difference = "/distributions/0/dispersion_difference";
    let cases = [
        (median, estimate(1.02, 0.97, 1.08), "no bias is seen"),
        (median, estimate(1.2, 1.1, 1.3), "on the safe side"),
        (median, estimate(0.8, 0.7, 0.9), "which is unsafe"),
        (median, json!({ "point": 0.8 }), "without an interval"),
        ("/alpha_is_fitted", json!(true), "say nothing of a bias"),
        (difference, estimate(0.08, 0.02, 0.13), "leaves out a dispersion"),
        (difference, estimate(0.08, -0.02, 0.13), "difference holds 0"),
        (difference, estimate(-0.1, -0.2, -0.01), "is the wider one"),
        ("/rivals/0/log_score", estimate(0.2, 0.1, 0.3), "PGA alone predicts"),
        (
            "/rivals/0/log_score",
            estimate(0.4, 0.3, 0.5),
            "than each intensity",
        ),
        ("/resurrected/tests", json!(5), "In 5 of the tests the block stands"),
        ("/repeatability/pairs", json!(12), "2 of 12 pairs"),
        ("/never_overturned", json!(1), "any level that was run"),
    ];
    let all: Vec<&str> = cases.iter().map(|(_, _, words)| *words).collect();
    for (place, value, expected) in cases {
        let found = comparison(place, value);
        for shown in [text(&found), page_of(&found)] {
            assert!(shown.contains(expected), "{place} {expected}: {shown}");
            // Of the sentences that exclude each other one is there.
            for group in [&all[..5], &all[8..10]] {
                let there = group.iter().filter(|w| shown.contains(**w));
                let count = there.count();
                assert_eq!(count, 1, "{place} {group:?}: {shown}");
            }
        }
    }
    for place in ["/resurrected/tests", "/repeatability/pairs"] {
        let shown = page_of(&comparison(place, json!(0)));
        assert!(!shown.contains("In 0 of the tests"), "{shown}");
        assert!(!shown.contains(" of 0 pairs"), "{shown}");
    }
}

#[test]
fn a_page_has_three_drawings_and_the_numbers_of_its_files() {
    let found = comparison("/tests", json!(100));
    let about = About {
        ground: "Made-up motions.".to_owned(),
        provenance: vec![("Table".to_owned(), "t.csv".to_owned())],
    };
    let files = files(&found, &about).unwrap();
    let of = |name: &str| String::from_utf8(files[name].clone()).unwrap();
    let page = of("index.html");
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(page.contains("80 % (70 to 90) of the fates of 100"));
    assert!(page.contains("href=\"tests.csv\""));
    let kept: Value = serde_json::from_str(&of("tests.json")).unwrap();
    assert_eq!(kept["provenance"][0]["is"], "t.csv");
    assert_eq!(kept["each"].as_array().unwrap().len(), 100);
    assert_eq!(of("tests.csv").lines().count(), 101);
    assert!(!page.contains("NaN") && !page.contains("inf"), "{page}");
}

/// Made-up tests are in the order of their PGA, ten in a class; the block
/// overturns from the 58th on, the specimen in every second test and from the
/// 62nd on.
#[test]
fn shares_of_classes_are_counted() {
    let found = comparison("/tests", json!(100));
    let csv = super::charts::fragilities(&found).figure("").csv();
    let shares = |name: &str| {
        let rows = csv.lines().filter(|line| {
            line.starts_with("a,")
                && line.contains(name)
                && line.contains("share")
        });
        let y = rows.map(|line| line.rsplit(',').nth(2).unwrap());
        y.map(|y| y.parse::<f64>().unwrap()).collect::<Vec<f64>>()
    };
    let computed = [0.0, 0.0, 0.0, 0.0, 0.0, 0.3, 1.0, 1.0, 1.0, 1.0];
    assert_eq!(shares("computed"), computed);
    let measured = [0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.9, 1.0, 1.0, 1.0];
    assert_eq!(shares("measured"), measured);
}
