//! The kept tests: what is said of them, and what decisions take from them.

use rocking_common::findings::Seen;
use rocking_procedures::ModelError;
use rocking_procedures::shaking::TestComparison;
use serde_json::{Value, json};

use super::*;

/// The kept results after a change.
fn changed(change: impl Fn(&mut Value)) -> anyhow::Result<RockTests> {
    let mut value: Value = serde_json::from_str(KEPT)?;
    change(&mut value);
    Ok(serde_json::from_value(value)?)
}

/// The usual error of the model follows from these tests: its range holds
/// what is missing in PGV and in average SA of both rocks, its largest value
/// is no more than 0.1 above them, and the bias of a fitted object holds the
/// ratios of medians.
#[test]
fn the_usual_error_of_the_model_follows_from_the_tests() {
    let kept = RockTests::kept().unwrap();
    let (usual, fitted) = (ModelError::default(), ModelError::fitted());
    let range = usual.dispersion().interval().unwrap();
    let bias = fitted.bias().interval().unwrap();
    let mut largest = 0.0_f64;
    for measure in [TestMeasure::PGV, TestMeasure::AVERAGE_SA] {
        for own in &kept.fitted {
            let own = measure.fragilities(own).unwrap();
            let missing = own.missing_dispersion.value();
            assert!(range.holds(missing), "{}: {missing}", own.im);
            largest = largest.max(missing);
            let ratio = own.median_ratio.value();
            assert!(bias.holds(ratio), "{}: {ratio}", own.im);
            // Derived again from both dispersions.
            let [a, b] = [own.measured_dispersion, own.computed_dispersion];
            let square = a.mul_add(a, -(b * b)).max(0.0);
            assert!((square.sqrt() - missing).abs() < 1e-3, "{}", own.im);
        }
    }
    assert!(range.high() < largest + 0.1, "{largest}");
    // Of an object that was not tested: eta from 0.85 to 0.97 moves the
    // fitted angle, and so the capacity of a given one, within the range.
    let unfitted = usual.bias().interval().unwrap();
    for own in kept.varied.iter().filter(|v| v.change.starts_with("eta")) {
        for (other, own) in own.rocks.iter().zip(&kept.fitted) {
            let moved = other.alpha_rad.value() / own.alpha_rad.value();
            assert!(unfitted.holds(moved) && !bias.holds(moved), "{moved}");
        }
    }
    assert!(kept.left_out().contains("contains these values in PGV"));
    let more = changed(|all| {
        for own in all["fitted"][1]["distributions"].as_array_mut().unwrap() {
            own["missing_dispersion"] = json!({"point": range.high() + 0.1});
        }
    });
    assert!(more.unwrap().left_out().contains("does not contain all values"));
    assert!(kept.left_out().contains("makes the outcomes more likely than"));
    let above = changed(|all| all["fitted"][1]["onset"]["above"] = json!(0.0));
    assert!(above.unwrap().left_out().contains("does not make all outcomes"));
}

/// Two rocks, 490 tests, one fitted angle: no more is claimed.
#[test]
fn counts_are_those_of_the_tests() {
    let kept = RockTests::kept().unwrap();
    let of = |own: &TestComparison| (own.tests, own.unknown, own.motions);
    for (own, all) in kept.fitted.iter().zip(&kept.measured) {
        assert!(own.alpha_is_fitted && own.each.is_empty());
        assert_eq!(of(own), of(&kept.fitted[0]));
        assert_eq!(all.tests, own.tests + kept.missing_motions);
        assert!(own.overturned < all.overturned);
        assert!((all.onset_g - own.onset.onset_g).abs() < 0.01);
    }
    for own in &kept.without_targets {
        assert_eq!(own.tests + kept.targets, kept.compared());
    }
    assert!(kept.given.iter().all(|own| !own.alpha_is_fitted));
    for own in &kept.housner {
        assert!(own.alpha_is_fitted && own.eta > 0.98, "{}", own.eta);
    }
    assert_eq!((kept.compared(), kept.measured[0].tests), (490, 582));
    let said = [kept.introduction(), kept.right(), kept.counted()].concat();
    assert!(said.contains("records of 490 tests") && said.contains("of 490"));
}

#[test]
fn words_on_sentences_follow_from_the_numbers() {
    let seen = |tests: &RockTests| -> Vec<String> {
        let rows = tests.sentences().rows;
        rows.into_iter().map(|row| row[1].clone()).collect()
    };
    let kept = RockTests::kept().unwrap();
    let now = seen(&kept);
    let name = |word: Seen| word.to_string();
    // Each turns if its numbers do.
    let other = changed(|all| {
        for k in 0..2 {
            let own = &mut all["measured"][k];
            own["expected_below"] = own["overturned_below"].clone();
            own["pgv_shifted"] =
                json!(own["pgv_unshifted"].as_f64().unwrap() + 99.0);
            let own = &mut all["fitted"][k];
            let scores = own["rivals"].as_array_mut().unwrap();
            scores
                .iter_mut()
                .for_each(|one| one["log_score"] = json!({"point": 0.5}));
            own["resurrected"]["right_at_level"] = json!(1.0);
            all["housner"][k]["computed"]["log_likelihood"] = json!(0.0);
        }
    });
    let other = other.unwrap();
    assert_eq!(seen(&other), [0; 5].map(|_| name(Seen::No)));
    assert_eq!(other.on_fragility(), "tests of two rocks disagree");
    // On one rock alone it is in part.
    let part = changed(|all| {
        all["measured"][0]["expected_below"] = json!(0.0);
    });
    let part = part.unwrap();
    assert_eq!(seen(&part)[0], name(Seen::InPart));
    assert_eq!(part.on_fragility(), "tests of two rocks agree in part");
    assert_eq!(now.len(), 5);
    assert_eq!(now[0], name(Seen::Yes));
    assert_eq!(now[2], name(Seen::Yes));
}

#[test]
fn every_sentence_and_cell_is_whole() {
    let kept = RockTests::kept().unwrap();
    let texts = [
        kept.introduction(),
        kept.fates(),
        kept.left_out(),
        kept.unknown(),
        kept.right(),
        kept.below_uplift(),
    ];
    let tables = [kept.predictors(), kept.sentences(), kept.sensitivity()];
    for table in &tables {
        let width = table.header.len();
        assert!(table.rows.iter().all(|row| row.len() == width));
    }
    let cells = tables.into_iter().flat_map(|t| t.rows).flatten();
    for text in texts.into_iter().chain(cells) {
        for broken in ["NaN", "no data", "no fit", "inf", "  ", "{"] {
            assert!(!text.contains(broken), "{text}");
        }
    }
}

#[test]
fn figures_show_both_rocks_and_every_measure() {
    let kept = RockTests::kept().unwrap();
    let figures = kept.figures();
    for figure in &figures {
        let svg = figure.svg();
        assert!(svg.starts_with("<svg") && !svg.contains("no data"));
        assert!(!figure.csv().contains("NaN"));
        if let Ok(folder) = std::env::var("ROCKING_FIGURES") {
            let name = &figure.heading.name;
            std::fs::write(format!("{folder}/{name}.svg"), svg).unwrap();
        }
    }
    let lines = |k: usize, word: &str| {
        let csv = figures[k].csv();
        csv.lines().filter(|line| line.contains(word)).count()
    };
    assert!(lines(0, "measured") > 200 && lines(0, "computed") > 400);
    for rock in ["rock 1", "rock 2"] {
        assert_eq!(lines(1, rock), 10 + 3 + 3);
    }
}

#[test]
fn a_damaged_file_is_refused() {
    assert!(changed(|_| ()).is_ok());
    let without = changed(|all| {
        all.as_object_mut().unwrap().remove("housner");
    });
    assert!(without.unwrap_err().to_string().contains("housner"));
    assert!(changed(|all| all["fitted"] = json!([])).is_err());
    assert!(changed(|all| all["more"] = json!(1)).is_err());
}
