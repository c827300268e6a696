use rocking::block::{Block, Restitution};
use rocking::integrator::Model;
use rocking_procedures::Draws;
use rocking_procedures::shaking::{
    ComputedTests, Predictor, Slenderness, TestComparison, TestOptions,
    TestResult,
};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::{Estimate, Interval, Range};
use serde_json::Value;

use super::{files, page, text};
use crate::About;

fn estimate(point: f64, low: f64, high: f64) -> Estimate {
    let interval = Interval::try_new(low, high).unwrap();
    Estimate::try_new(point, interval, Range::Real).unwrap()
}

fn set(of: &mut Predictor, score: f64, median: Estimate) {
    of.right = estimate(0.8, 0.7, 0.9);
    of.median = median;
    of.log_score = estimate(score, 0.9 * score, 1.1 * score);
}

/// A comparison of 100 made-up tests: every second one overturned the
/// specimen, and all from the 62nd on. The numbers that sentences are chosen
/// by are set.
fn made_up() -> TestComparison {
    let test = |k: u32| {
        let capacity_factor = 2.0 / (0.3 + 0.03 * f64::from(k));
        TestResult {
            test: format!("t{k}"),
            motion: format!("m{}", k % 9),
            pga_g: 0.01 * f64::from(k + 1),
            // Out of order, so that the computed fates have a fragility.
            intensities: [0.01, 0.004]
                .map(|unit| unit * f64::from(k + k % 9 + 1))
                .into(),
            capacity_factor,
            overturns: true,
            overturns_at_level: capacity_factor <= 1.0,
            probability: f64::NAN,
            overturned: k % 2 == 1 || k > 60,
        }
    };
    let block = Block::try_new(0.085, 4.55).unwrap();
    let options = TestOptions {
        slenderness: Slenderness::Given(block),
        restitution: Restitution::constant(0.92).unwrap(),
        model: Model::Nonlinear,
        gravity_m_s2: 9.81,
        measures: vec![IntensityMeasure::PGA, IntensityMeasure::PGV],
        draws: Draws { replicates: 200, seed: 0 },
    };
    let tests = (0..100).map(test).collect();
    let (unknown, fitted_slope, options) = (2, None, &options);
    let tests = ComputedTests { tests, unknown, block, fitted_slope, options };
    let mut found = tests.compare().unwrap();
    set(&mut found.computed, 0.21, estimate(1.02, 0.97, 1.08));
    set(&mut found.rivals[0], 0.4, estimate(0.4, 0.3, 0.5));
    set(&mut found.rivals[1], 0.3, estimate(0.2, 0.15, 0.25));
    for test in &mut found.each {
        test.intensities[0] = test.pga_g;
    }
    assert_eq!(found.distributions.len(), 2);
    for own in &mut found.distributions {
        own.dispersion_difference = estimate(0.08, 0.02, 0.13);
    }
    found
}

fn page_of(found: &TestComparison) -> String {
    page(found, &About::default())
}

#[test]
fn sentences_follow_the_intervals() {
    type Change = fn(&mut TestComparison);
    let cases: [(Change, &str); 13] = [
        (|_| (), "no bias is seen"),
        (
            |found| found.computed.median = estimate(1.2, 1.1, 1.3),
            "on the safe side",
        ),
        (
            |found| found.computed.median = estimate(0.8, 0.7, 0.9),
            "which is unsafe",
        ),
        (
            |found| found.computed.median = Estimate::exact(0.8),
            "without an interval",
        ),
        (|found| found.alpha_is_fitted = true, "do not show a bias"),
        (|_| (), "leaves out a dispersion"),
        (
            |found| {
                let own = &mut found.distributions[0];
                own.dispersion_difference = estimate(0.08, -0.02, 0.13);
            },
            "difference contains 0",
        ),
        (
            |found| {
                let own = &mut found.distributions[0];
                own.dispersion_difference = estimate(-0.1, -0.2, -0.01);
            },
            "one is wider",
        ),
        (
            |found| found.rivals[0].log_score = estimate(0.2, 0.1, 0.3),
            "PGA by itself predicts",
        ),
        (|_| (), "than any single intensity"),
        (
            |found| found.resurrected.tests = 5,
            "In 5 of the tests the block survives",
        ),
        (
            |found| {
                found.repeatability.pairs = 12;
                found.repeatability.different = 2;
            },
            "2 of 12 pairs",
        ),
        (|found| found.never_overturned = 1, "any level that was run"),
    ];
    let all: Vec<&str> = cases.iter().map(|(_, words)| *words).collect();
    for (change, expected) in cases {
        let mut found = made_up();
        change(&mut found);
        for shown in [text(&found), page_of(&found)] {
            assert!(shown.contains(expected), "{expected}: {shown}");
            // Of the sentences that exclude each other one is there.
            for group in [&all[..5], &all[8..10]] {
                let there = group.iter().filter(|w| shown.contains(**w));
                let count = there.count();
                assert_eq!(count, 1, "{expected} {group:?}: {shown}");
            }
        }
    }
    let mut found = made_up();
    (found.resurrected.tests, found.repeatability.pairs) = (0, 0);
    let shown = page_of(&found);
    assert!(!shown.contains("In 0 of the tests"), "{shown}");
    assert!(!shown.contains(" of 0 pairs"), "{shown}");
}

#[test]
fn a_page_has_three_drawings_and_the_numbers_of_its_files() {
    let found = made_up();
    let known = [("Table", Some("t.csv".to_owned()))];
    let about = About::of("Made-up motions.".to_owned(), known);
    let files = files(&found, &about).unwrap();
    let of = |name: &str| String::from_utf8(files[name].clone()).unwrap();
    let page = of("index.html");
    assert_eq!(page.matches("<svg").count(), 3);
    assert!(page.contains("80 % (70 to 90) of the outcomes of 100"));
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
    let found = made_up();
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
