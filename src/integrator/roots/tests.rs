use super::{ends_below, guess, refine, surely_positive};
use crate::integrator::taylor::value;
use crate::number::dispatch::Isa;
use crate::number::double::DoubleDouble;
use crate::number::{Number, Real};

fn first_descent<N: Real>(c: &[N], length: N) -> Option<N> {
    super::first_descent(c, length, Isa::best())
}

#[test]
fn tells_roots_apart_that_are_one_in_double_precision() {
    // (1/2 - tau) (1/2 + 2^-40 - tau), and (tau - 1/2)^2 + 2^-90.
    let [half, gap, lift] =
        [0.5, libm::scalbn(1.0, -40), libm::scalbn(1.0, -90)]
            .map(DoubleDouble::from_f64);
    let one = DoubleDouble::one();
    let pair = [half * (half + gap), -(one + gap), one];
    let found = first_descent(&pair, one).map(|tau| tau - half);
    assert!(found.is_some_and(|off| off.hi().abs() < 1e-19), "{found:?}");
    let miss = [half * half + lift, -one, one];
    assert_eq!(first_descent(&miss, one), None);
    assert!(first_descent(&[0.25, -1.0, 1.0], 1.0).is_some());
}

/// Coefficients of the product of (r - tau) for the roots given.
fn with_roots(roots: &[f64]) -> Vec<f64> {
    let mut c = vec![1.0];
    for r in roots {
        let mut next = vec![0.0; c.len() + 1];
        for (k, x) in c.iter().enumerate() {
            next[k] += r * x;
            next[k + 1] -= x;
        }
        c = next;
    }
    c
}

#[test]
fn finds_the_first_of_two_crossings_in_a_step() {
    let c = with_roots(&[0.3, 0.31]);
    let found = first_descent(&c, 1.0);
    assert!((found.unwrap_or(9.0) - 0.3).abs() < 1e-14);
    // Signs at the ends are equal: a test of the ends alone misses it.
    assert!(c[0] > 0.0 && c.iter().sum::<f64>() > 0.0);
}

#[test]
fn finds_close_pairs_and_leaves_near_misses() {
    let c = with_roots(&[0.5, 0.5 + 1e-6]);
    let found = first_descent(&c, 1.0).unwrap_or(9.0);
    assert!((found - 0.5).abs() < 1e-9, "{found}");
    // (tau - 1/2)^2 + 1e-12 never vanishes.
    assert_eq!(first_descent(&[0.25 + 1e-12, -1.0, 1.0], 1.0), None);
}

#[test]
fn deflates_a_start_on_the_event() {
    // tau (0.7 - tau), tau^3 (0.7 - tau)
    assert_eq!(first_descent(&[0.0, 0.5, -1.0], 1.0), Some(0.5));
    let triple = first_descent(&[0.0, 0.0, 0.0, 0.25, -1.0], 1.0);
    assert_eq!(triple, Some(0.25));
    assert_eq!(first_descent(&[0.0, 0.5, -1.0], 0.4), None);
    assert_eq!(first_descent(&[0.0, 0.5, -1.0], 0.5), Some(0.5));
    assert_eq!(first_descent(&[0.0, -0.5, 1.0], 0.5), Some(0.0));
    assert_eq!(first_descent(&[0.0, 0.0], 0.5), None);
}

/// Numbers in [0, 1), the same each time.
struct Draws(u64);

impl Draws {
    fn next(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 40) as f64 / 16_777_216.0
    }
}

/// Products of up to five real roots and two pairs of complex ones, at
/// whatever length: the first root within it is found, and no other.
#[test]
fn finds_the_first_of_known_roots() {
    let mut draws = Draws(7);
    let (mut found, mut missing) = (0, 0);
    for _ in 0..4000 {
        let count = (5.0 * draws.next()) as usize;
        let mut roots: Vec<f64> = (0..count)
            .map(|_| {
                let size = 0.01 + 1.4 * draws.next();
                if draws.next() < 0.2 { -size } else { size }
            })
            .collect();
        roots.sort_by(f64::total_cmp);
        if roots.windows(2).any(|pair| pair[1] - pair[0] < 0.01) {
            continue;
        }
        // Positive at the start: an even number of signs is needed.
        let mut c = with_roots(&roots);
        if c[0] < 0.0 {
            c.iter_mut().for_each(|x| *x = -*x);
        }
        for _ in 0..2 {
            // (tau - m)^2 + s^2
            let (m, s) = (draws.next(), 0.1 + draws.next());
            let mut next = vec![0.0; c.len() + 2];
            for (k, x) in c.iter().enumerate() {
                next[k] += x * (m * m + s * s);
                next[k + 1] -= 2.0 * m * x;
                next[k + 2] += x;
            }
            c = next;
        }
        let length = 0.1 + 1.5 * draws.next();
        let due = roots.iter().copied().find(|r| *r > 0.0);
        if due.is_some_and(|r| (r - length).abs() < 1e-6) {
            continue;
        }
        match (first_descent(&c, length), due.filter(|r| *r < length)) {
            (Some(tau), Some(due)) => {
                assert!((tau - due).abs() < 1e-8, "{roots:?} {tau}");
                found += 1;
            }
            (None, None) => missing += 1,
            (seen, due) => panic!("{roots:?} {length}: {seen:?} {due:?}"),
        }
    }
    assert!(found > 1000 && missing > 1000, "{found} {missing}");
}

#[test]
fn a_touch_is_looked_at_no_deeper_than_a_double_goes() {
    // (tau - r)^2 (2 + tau), whose value at the contact rounding decides.
    for r in [0.1875, 0.5, 0.6875, 0.8125, 1.0] {
        let c = [2.0 * r * r, r * r - 4.0 * r, 2.0 - 2.0 * r, 1.0];
        if let Some(tau) = first_descent(&c, 1.0) {
            assert!((tau - r).abs() < 1e-7, "{r} {tau}");
        }
        let lifted = [c[0] + 1e-9, c[1], c[2], c[3]];
        assert_eq!(first_descent(&lifted, 1.0), None, "{r}");
    }
}

/// Where the screens begin to tell: one coefficient against what it must
/// outweigh, worked out by hand.
#[test]
fn screens_tell_up_to_their_bounds() {
    // 1 - tau/2 and what the rest may take of it.
    for (c, length, sure) in [
        ([1.0, -0.5, 0.499, 0.0], 1.0, true),
        ([1.0, -0.5, -0.499, 0.0], 1.0, true),
        ([1.0, -0.5, 0.5, 0.0], 1.0, false),
        ([1.0, -0.5, 0.0, 5.99], 0.5, true),
        ([1.0, -0.5, 0.0, 6.0], 0.5, false),
        ([1.0, -0.5, 1.5, 3.0], 0.5, false),
        ([1.0, -0.5, 1.4, 3.0], 0.5, true),
        ([1.0, 5.0, -0.99, 0.0], 1.0, true),
        ([1.0, 5.0, -1.01, 0.0], 1.0, false),
    ] {
        assert_eq!(surely_positive(&c, length), sure, "{c:?}");
    }
    assert!(surely_positive(&[1.0], 1.0));
    assert!(!surely_positive(&[1.0, -1.0], 1.0));
    assert!(surely_positive(&[1.0, -0.99], 1.0));

    // It falls all the way where |c_1| > 1.01 (2 |c_2| L + 3 |c_3| L^2 + ..),
    // and is concave where 2 |c_2| > 1.01 (6 |c_3| L + 12 |c_4| L^2 + ..).
    let (none, above) = (None, Some(false));
    for (c, length, below) in [
        ([1.0, -1.0, 0.4950, 0.0, 0.0], 1.0, above),
        ([1.0, -1.0, 0.4951, 0.0, 0.0], 1.0, none),
        ([1.5, -1.0, 0.0, 0.3300, 0.0], 1.0, above),
        ([1.5, -1.0, 0.0, 0.3301, 0.0], 1.0, none),
        ([1.5, -1.0, 0.0, 1.3201, 0.0], 0.5, above),
        ([1.5, -1.0, 0.0, 1.3202, 0.0], 0.5, none),
        ([1.5, -1.0, 0.0, 0.0, 1.9801], 0.5, above),
        ([1.5, -1.0, 0.0, 0.0, 1.9803], 0.5, none),
        ([1.5, 0.5, -1.0, 0.3300, 0.0], 1.0, above),
        ([1.5, 0.5, -1.0, 0.3301, 0.0], 1.0, none),
        ([1.5, 0.5, -1.0, 0.6600, 0.0], 0.5, above),
        ([1.5, 0.5, -1.0, 0.6601, 0.0], 0.5, none),
        ([1.5, 0.5, -1.0, 0.0, 0.1650], 1.0, above),
        ([1.5, 0.5, -1.0, 0.0, 0.1651], 1.0, none),
        ([1.5, 0.5, -1.0, 0.0, 0.6600], 0.5, above),
        ([1.5, 0.5, -1.0, 0.0, 0.6601], 0.5, none),
        ([0.5, -1.0, 0.1, 0.1, 0.1], 1.0, Some(true)),
        ([0.5, 0.1, -1.0, 0.1, 0.05], 1.0, Some(true)),
        ([0.5, 0.1, 1.0, -0.1, -0.05], 1.0, none),
        // An end within 1e-11 of |c_0| + |c_1| L is not certain.
        ([1.0, -1.0 - 1.9e-11, 0.0, 0.0, 0.0], 1.0, none),
        ([1.0, -1.0 - 2.1e-11, 0.0, 0.0, 0.0], 1.0, Some(true)),
        ([1.0, -1.0 + 1.9e-11, 0.0, 0.0, 0.0], 1.0, none),
        ([1.0, -1.0 + 2.1e-11, 0.0, 0.0, 0.0], 1.0, above),
        ([1.0, -2.0 - 3.5e-11, 0.0, 0.0, 0.0], 0.5, none),
        ([1.0, -2.0 - 4.5e-11, 0.0, 0.0, 0.0], 0.5, Some(true)),
    ] {
        assert_eq!(ends_below(&c, length), below, "{c:?} {length}");
    }
    assert_eq!(ends_below(&[1.0, -2.0], 1.0), None);
}

/// What the screens say is so, on a thousand points of random polynomials.
#[test]
fn what_screens_tell_is_true() {
    let mut draws = Draws(11);
    let (mut sure, mut seen) = (0, [0, 0]);
    for _ in 0..3000 {
        let mut c = [0.0; 6];
        c[0] = draws.next();
        for (k, x) in c.iter_mut().enumerate().skip(1) {
            *x = (4.0 * draws.next() - 2.0) / (k * k) as f64;
        }
        let length = 0.2 + draws.next();
        let at = |k: usize| value(&c, length * k as f64 / 1000.0);
        if surely_positive(&c, length) {
            sure += 1;
            assert!((0..=1000).all(|k| at(k) > 0.0), "{c:?}");
        }
        let changes =
            (0..1000).filter(|k| (at(*k) > 0.0) != (at(k + 1) > 0.0));
        if let Some(below) = ends_below(&c, length) {
            seen[usize::from(below)] += 1;
            assert_eq!(changes.count(), usize::from(below), "{c:?}");
        }
    }
    assert!(sure > 500 && seen[0] > 200 && seen[1] > 200, "{sure} {seen:?}");
}

#[test]
fn a_parabola_has_its_first_root() {
    for roots in [[0.3, 0.7], [0.25, -2.0], [1e-6, 5.0]] {
        let mut c = with_roots(&roots);
        if c[0] < 0.0 {
            c.iter_mut().for_each(|x| *x = -*x);
        }
        let gap = guess(&c) / roots[0] - 1.0;
        assert!(gap.abs() < 1e-15, "{roots:?} {gap:e}");
    }
    assert_eq!(guess(&[1.0, -2.0]), 0.0);
}

/// The third and fourth terms of a step are small: what is left of the guess
/// is of the next.
#[test]
fn a_guess_knows_of_five_terms() {
    for (fifth, left) in [(0.0, 2e-7), (0.02, 1e-5)] {
        let c = [0.1, -1.0, -0.3, 0.05, -0.02, fifth];
        let root = refine(&c, 0.0, 1.0, 0.1);
        let gap = (guess(&c) / root - 1.0).abs();
        let three = (guess(&c[..3]) / root - 1.0).abs();
        assert!(gap < left && three > 3e-5, "{gap:e} {three:e}");
    }
}

#[test]
fn refinement_stays_in_its_bracket_and_ends() {
    // A triple root, where Newton's steps are short, from good and from
    // useless guesses; and one at a bracket's own middle.
    let triple = with_roots(&[0.4, 0.4, 0.4]);
    for guess in [0.399, 0.9, -1.0, f64::NAN] {
        let tau = refine(&triple, 0.0, 1.0, guess);
        assert!((tau - 0.4).abs() < 1e-4, "{guess} {tau}");
    }
    assert_eq!(refine(&[0.5, -1.0], 0.0, 1.0, 0.5), 0.5);
    assert_eq!(refine(&[0.5, -1.0], 0.0, 1.0, -3.0), 0.5);
    for root in [1e-9, 0.3, 1.0 - 1e-15] {
        let c = [root, -1.0, 0.0];
        let tau = refine(&c, 0.0, 1.0, 0.7);
        assert!((tau / root - 1.0).abs() < 1e-15, "{root} {tau}");
    }
}
