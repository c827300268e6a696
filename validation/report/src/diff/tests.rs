use super::change::{Change, Measure};
use super::words::{pair, percent};
use super::{Content, Item, Limit};

fn item(value: f64, limit: Limit) -> Item {
    Item {
        owner: "o".into(),
        name: "n".into(),
        group: "g".into(),
        words: "w".into(),
        content: Content::Number { value, limit },
    }
}

fn change(old: (f64, Limit), new: (f64, Limit)) -> Option<Change> {
    Change::between(&item(old.0, old.1), &item(new.0, new.1), 0.01)
}

#[test]
fn standard_errors_of_the_side_that_the_change_goes_to() {
    // 0.19599640 above the median is 1.96 standard errors of 0.1.
    let interval = Limit::Interval(1.5, 2.195_996_398_5);
    let up = change((2.0, interval), (2.31, interval)).unwrap();
    assert!(up.significant);
    let Measure::StandardErrors(n) = up.measure else { panic!() };
    assert!((n - 3.1).abs() < 1e-6, "{n}");
    assert_eq!(up.sentence(), "w: 2 to 2.31, +16 %, 3.1 standard errors");
    // The other side is 0.5 wide.
    let down = change((2.0, interval), (1.69, interval)).unwrap();
    assert!(!down.significant);
    // An interval on the new side alone.
    let back = change((2.31, Limit::None), (2.0, interval)).unwrap();
    assert!(back.significant);
}

#[test]
fn an_end_at_the_value_leaves_no_room() {
    let interval = Limit::Interval(1.0, 1.0);
    assert!(change((1.0, interval), (1.0, interval)).is_none());
    let out = change((1.0, interval), (1.001, interval)).unwrap();
    assert!(out.significant);
    assert!(out.sentence().contains("ends at the old value"));
    // The ninth digit is rounding.
    let last = change((1.0, interval), (1.000_000_01, interval)).unwrap();
    assert!(!last.significant);
}

#[test]
fn without_an_interval_the_share_decides() {
    let none = Limit::None;
    assert!(!change((100.0, none), (100.9, none)).unwrap().significant);
    let out = change((100.0, none), (101.1, none)).unwrap();
    assert!(out.significant);
    assert_eq!(out.sentence(), "w: 100 to 101, +1.1 %, no interval stated");
    assert!(change((0.0, none), (1e-9, none)).unwrap().significant);
    assert!(change((1.0, none), (f64::NAN, none)).unwrap().significant);
    assert!(change((1.0, none), (f64::INFINITY, none)).unwrap().significant);
    assert!(change((f64::NAN, none), (f64::NAN, none)).is_none());
    let inf = f64::INFINITY;
    assert!(change((inf, none), (inf, none)).is_none());
}

#[test]
fn tolerances_are_widened_by_the_last_digit() {
    let limit = Limit::Tolerance(5e-4, 1e-3);
    assert!(!change((14.697, limit), (14.698, limit)).unwrap().significant);
    assert!(change((14.697, limit), (14.699, limit)).unwrap().significant);
    let exact = Limit::Tolerance(0.0, 0.0);
    assert!(change((7.0, exact), (8.0, exact)).unwrap().significant);
    let change_found =
        change((1.0, Limit::Verdict), (9.0, Limit::Verdict)).unwrap();
    assert!(!change_found.significant);
}

#[test]
fn digits_that_tell_two_numbers_apart() {
    let two = |a: &str, b: &str| (a.to_owned(), b.to_owned());
    assert_eq!(pair(2.312_34, 2.351_1), two("2.31", "2.35"));
    assert_eq!(pair(2.312_34, 2.312_36), two("2.3123", "2.3124"));
    assert_eq!(pair(86.0, 85.0), two("86", "85"));
    assert_eq!(pair(f64::NAN, 0.5), two("none", "0.5"));
    assert_eq!(pair(1e-12, 2e-12), two("1e-12", "2e-12"));
    assert_eq!(percent(0.017_3), "+1.7 %");
    assert_eq!(percent(-0.000_031), "-0.0031 %");
}
