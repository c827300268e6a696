//! The judge on both sides of every kind of bound.

use super::*;

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
    assert!(one(Bound::Coverage(2000), &[0.93], &[0.95]));
    assert!(!one(Bound::Coverage(2000), &[0.92], &[0.95]));
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
