use super::*;

#[test]
fn every_pair_is_counted_once() {
    let inf = f64::INFINITY;
    let a = [1.0, inf, 2.0, inf, 0.0, 0.0, 3.0, inf];
    let b = [2.0, 1.0, inf, inf, 0.0, 1.0, 0.0, 2.0];
    let pairs = Pairs::try_new(&a, &b).unwrap();
    assert_eq!(pairs.ratios, [0.5]);
    assert_eq!((pairs.only_a_infinite, pairs.only_b_infinite), (2, 1));
    assert_eq!((pairs.both_infinite, pairs.both_zero), (1, 1));
    assert_eq!((pairs.only_a_zero, pairs.only_b_zero), (1, 1));
    assert_eq!(pairs.share(), 0.125);
    // 2 against 1: 2 P(B(3) <= 1) = 1.
    assert_eq!(pairs.mcnemar().p_value, 1.0);
}

#[test]
fn mcnemar_is_the_exact_binomial() {
    // 10 discordant, 1 against 9: 2 (1 + 10)/1024.
    let inf = f64::INFINITY;
    let mut a = vec![inf; 9];
    let mut b = vec![1.0; 9];
    a.push(1.0);
    b.push(inf);
    let p_value = Pairs::try_new(&a, &b).unwrap().mcnemar().p_value;
    assert!((p_value - 22.0 / 1024.0).abs() < 1e-14);
}

#[test]
fn bad_pairs_and_margins_are_refused() {
    assert!(Pairs::try_new(&[1.0], &[]).is_err());
    for value in [f64::NAN, -1.0, f64::NEG_INFINITY] {
        assert!(Pairs::try_new(&[1.0], &[value]).is_err());
    }
    for margin in [0.0, -0.1, f64::NAN] {
        assert!(equivalence(&[1.0, 1.1], margin).is_err());
        assert!(sign_equivalence(&[1.0, 1.1], margin).is_err());
    }
    assert_eq!(equivalence(&[1.0, 1.0], 0.1), Err(PairedError::Degenerate));
    assert_eq!(equivalence(&[1.0], 0.1), Err(PairedError::TooFew(1)));
    assert_eq!(hodges_lehmann(&[1.0]), Err(PairedError::TooFew(1)));
    let many = vec![1.0; 1 << 20];
    assert_eq!(hodges_lehmann(&many), Err(PairedError::TooMany(1 << 20)));
    // Few ratios reach no 95 %: the smallest and the largest hold the centre
    // unless all lie on one side of it.
    let level = |n| hodges_lehmann(&[1.0, 1.1, 1.2, 0.9, 1.3, 0.8][..n]);
    let levels = [2, 3, 4, 5, 6].map(|n| level(n).unwrap().level);
    assert_eq!(levels, [0.5, 0.75, 0.875, 0.9375, 0.95]);
}
