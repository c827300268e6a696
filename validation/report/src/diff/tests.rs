use rocking_common::findings::{Effect, Unit};
use rocking_statistics::{Estimate, Interval, Range};

use serde_json::json;

use super::number::NumberChange;
use super::walk::part;

const TENTH: Option<Effect> = Some(Effect::Relative(0.1));
const POINTS: Option<Effect> = Some(Effect::Absolute(0.1));
const TOLERANCE: Option<Effect> = Some(Effect::Absolute(1e-9));

/// The move of a number without an interval, on 86 records.
fn moved(
    effect: Option<Effect>,
    unit: Unit,
    ends: [f64; 2],
) -> Option<NumberChange> {
    let values = ends.map(Estimate::exact);
    NumberChange::between(effect, unit, values, [Some(86); 2])
}

#[test]
fn a_change_is_held_against_the_smallest_effect_of_interest() {
    let (nan, inf) = (f64::NAN, f64::INFINITY);
    for (effect, old, new, beyond) in [
        (TENTH, 2.0, 2.21, true),
        (TENTH, 2.0, 2.2, false),
        (TENTH, 2.0, 1.79, true),
        // In points of the share, not as a part of it.
        (POINTS, 0.05, 0.1, false),
        (POINTS, 0.9, 0.8, false),
        (POINTS, 0.9, 0.79, true),
        (TENTH, 0.0, 1e-9, true),
        (TENTH, 1.0, nan, true),
        (TENTH, inf, 1.0, true),
        (TENTH, inf, inf, false),
        (TENTH, nan, nan, false),
        (Some(Effect::Absolute(0.0)), 7.0, 8.0, true),
        (TOLERANCE, 0.5, 0.500_000_000_9, false),
        (TOLERANCE, 0.5, nan, true),
        (None, 1.0, 9.0, false),
        (None, 1.0, nan, true),
    ] {
        let one = moved(effect, Unit::One, [old, new]);
        let found = one.is_some_and(|moved| moved.is_beyond());
        assert_eq!(found, beyond, "{effect:?}: {old} to {new}");
    }
}

#[test]
fn a_move_has_the_digits_that_show_it() {
    for (effect, unit, ends, text) in [
        (POINTS, Unit::Share, [0.97, 0.4], "97 % -> 40 %, -57 points, n = 86"),
        (TENTH, Unit::One, [2.0, 2.0002], "2 -> 2.0002, +0.01 %, n = 86"),
        (TENTH, Unit::One, [f64::NAN, 1e-3], "none -> 0.001, n = 86"),
    ] {
        assert_eq!(moved(effect, unit, ends).unwrap().text(), text);
    }
}

#[test]
fn what_is_least_a_matter_of_chance_weighs_most() {
    let estimate = |value: f64, half: f64| {
        let interval = Interval::try_new(value - half, value + half).unwrap();
        Estimate::try_new(value, interval, Range::Real).unwrap()
    };
    let values = [estimate(1.0, 0.03), estimate(1.2, 0.04)];
    let sure = |n| {
        NumberChange::between(TENTH, Unit::One, values, [Some(n), Some(86)])
    };
    let u = sure(86).unwrap();
    let open = moved(TENTH, Unit::One, [1.0, 1.3]).unwrap();
    // 0.2 over the root of 0.03^2 + 0.04^2, against 30 % over 10 %.
    assert!((u.change_over_uncertainty.unwrap() - 4.0).abs() < 1e-9);
    assert_eq!(open.change_over_uncertainty, None);
    assert!(u.weight() > open.weight());
    assert!(sure(29).unwrap().weight() < open.weight());
}

#[test]
fn a_row_that_one_side_lacks_says_why() {
    let at = json!({ "p_rad_s": 3.0, "im_pga": 5.0, "arm": "C" });
    let path = ["tables", "slenderness-adjustment", "rows", "a"];
    for (arms, what, why) in [
        (["A", "C"], " = 5, grid C", "fewer than 10 ratios"),
        (["A", "B"], "results of grid C", "this grid was not run"),
    ] {
        let other = json!({ "settings": { "arms": arms } });
        let (found, reason) = part(&path, &json!({ "at": at }), &other);
        assert!(found.ends_with(what), "{found}");
        assert_eq!(reason.as_deref(), Some(why));
    }
}
