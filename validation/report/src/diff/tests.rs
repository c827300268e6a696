use rocking_common::findings::{Effect, Unit};

use super::moved::{Kind, Limit, Number};
use super::{Change, Comparison};

const TENTH: Limit = Limit::Effect(Effect::Relative(0.1), Unit::One);
const POINTS: Limit = Limit::Effect(Effect::Absolute(0.1), Unit::Share);

/// A kind of numbers of these cells: place, old and new value.
fn kind(limit: Limit, cells: &[(&str, f64, f64)]) -> Kind {
    let mut kind = Kind::new("", "it", limit);
    for (at, old, new) in cells {
        let [old, new] = [old, new].map(|x| Number::new(*x, limit));
        kind.add(at, &old, &new);
    }
    kind.finish();
    kind
}

#[test]
fn a_change_is_held_against_the_smallest_effect_of_interest() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    for (limit, old, new, beyond) in [
        (TENTH, 2.0, 2.21, 1),
        (TENTH, 2.0, 2.2, 0),
        (TENTH, 2.0, 1.79, 1),
        // In points of the share, not as a part of it.
        (POINTS, 0.05, 0.1, 0),
        (POINTS, 0.9, 0.8, 0),
        (POINTS, 0.9, 0.79, 1),
        (TENTH, 0.0, 1e-9, 1),
        (TENTH, 1.0, nan, 1),
        (TENTH, inf, 1.0, 1),
        (TENTH, inf, inf, 0),
        (TENTH, nan, nan, 0),
        (Limit::Tolerance(0.0), 7.0, 8.0, 1),
        (Limit::Tolerance(1e-9), 0.5, 0.500_000_000_9, 0),
        (Limit::Tolerance(1e-9), 0.5, nan, 1),
        (Limit::None, 1.0, 9.0, 0),
    ] {
        let found = kind(limit, &[("here", old, new)]).beyond();
        assert_eq!(found, beyond, "{limit:?}: {old} to {new}");
    }
}

#[test]
fn a_kind_is_the_median_over_its_cells_and_the_furthest_of_them() {
    let cells = [("a", 2.0, 2.24), ("b", 1.0, 1.05), ("c", 1.0, 1.2)];
    assert_eq!(
        kind(TENTH, &cells).sentence(),
        "it: +12 %; beyond 10 % in 2 of 3 cells\nmost c: 1 to 1.2, +20 %"
    );
    let one = kind(POINTS, &[("p = 1", 0.97, 0.4)]);
    assert_eq!(
        one.sentence(),
        "it\np = 1: 97 % to 40 %, -57 points, beyond 10 points"
    );
    // Digits that tell two numbers apart.
    let near = kind(TENTH, &[("a", 2.312_34, 2.312_36)]);
    let moved = &near.moved[0];
    assert_eq!((&*moved.old, &*moved.new), ("2.3123", "2.3124"));
    let none = kind(TENTH, &[("a", f64::NAN, 1e-12)]);
    assert_eq!(none.one(&none.moved[0]), "a: none to 1e-12");
}

#[test]
fn medians_by_frequency_stand_in_the_order_of_p() {
    let mut by_p = Kind::new("", "median", TENTH);
    for (p, new) in [(3.0, 1.12), (1.0, 1.15), (1.0, 1.15), (12.0, 1.0)] {
        let number =
            |value| Number { p_rad_s: Some(p), ..Number::new(value, TENTH) };
        by_p.add("a", &number(1.0), &number(new));
    }
    by_p.finish();
    let by = "(p = 1: +15 %, p = 3: +12 %, p = 12: 0 %)";
    assert!(by_p.sentence().contains(by), "{}", by_p.sentence());
}

#[test]
fn values_of_different_cells_are_not_compared() {
    let decided = |value, at: &str| Number {
        decided_at: at.into(),
        ..Number::new(value, TENTH)
    };
    let mut kind = Kind::new("", "restitution", TENTH);
    let (old, new) = (decided(1.21, "eta 0.85"), decided(0.714, "eta 0.97"));
    kind.add("ordinary", &old, &new);
    assert!(kind.finish());
    assert_eq!((kind.beyond(), kind.cells, kind.moved.len()), (0, 0, 0));
    assert_eq!(kind.decided_elsewhere, ["ordinary: eta 0.85; now eta 0.97"]);
}

#[test]
fn markdown_is_short_whatever_changed() {
    let mut all = Comparison::default();
    let change = |k: usize| Change {
        what: format!("{k} {}", "|".repeat(1500)),
        places: Vec::new(),
        old: "a".into(),
        new: "b".into(),
    };
    all.answers.changed = (0..12).map(change).collect();
    all.verdicts.changed = (0..40).map(change).collect();
    let markdown = all.markdown();
    assert!(markdown.chars().count() <= 20_000, "{}", markdown.len());
    assert!(markdown.ends_with("The rest: `rocking diff OLD NEW --all`.\n"));
    all.answers.changed.truncate(1);
    all.verdicts.changed.truncate(1);
    assert!(!all.markdown().contains("The rest"), "{}", all.markdown());
}
