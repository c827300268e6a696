//! Each blemish, and records that are one recording.

use super::*;

fn codes(dt_s: f64, samples: Vec<f64>) -> Vec<&'static str> {
    let record = Accelerogram::try_new("x", dt_s, samples).unwrap();
    remarks(&record).iter().map(Remark::code).collect()
}

/// A motion without a blemish: whole periods, ended at rest.
fn clean() -> Vec<f64> {
    (0..401)
        .map(|i| 0.3 * libm::sin(0.1 * std::f64::consts::PI * f64::from(i)))
        .map(|a| if a.abs() < 1e-12 { 0.0 } else { a })
        .collect()
}

#[test]
fn each_blemish_has_its_code() {
    assert_eq!(codes(0.01, clean()), [""; 0]);
    let scaled = |f: f64| clean().iter().map(|a| a * f).collect();
    assert_eq!(codes(0.01, scaled(980.665)), ["units"]);
    assert_eq!(codes(0.01, scaled(1e-4)), ["units"]);
    let clipped = clean().iter().map(|a| a.clamp(-0.2, 0.2)).collect();
    assert_eq!(codes(0.01, clipped), ["clipped"]);
    let mut flat = clean();
    flat.splice(100..100, (0..120).map(|i| 0.01 * (i / 60) as f64));
    assert_eq!(codes(0.01, flat)[..1], ["flat"]);
    let offset = clean().iter().map(|a| a + 0.004).collect();
    assert_eq!(codes(0.01, offset), ["end-velocity", "offset"]);
    for dt_s in [0.0024, 0.03] {
        assert_eq!(codes(dt_s, clean()), ["interval-rounded"], "{dt_s}");
    }
    for dt_s in [0.001, 0.0025, 0.005, 0.01, 0.02, 1.0 / 410.0] {
        assert_eq!(codes(dt_s, clean()), [""; 0], "{dt_s}");
    }
    let mut padded = clean();
    padded.extend([0.0; 100]);
    assert_eq!(codes(0.01, padded), ["padding"]);
    assert_eq!(codes(0.01, vec![0.0; 10]), ["units"]);
}

#[test]
fn components_of_a_pair_are_compared() {
    let record = |name: &str, dt_s: f64, n: usize| {
        let mut samples = clean();
        samples.truncate(n);
        Accelerogram::try_new(name, dt_s, samples).unwrap()
    };
    let a = record("a", 0.01, 401);
    let remarked = |b: &Accelerogram, pair| {
        let one = |record, pair| RemarkInput::of(record, pair, &[]);
        let found =
            remarks_together(&[one(&a, Some("p")), one(b, Some(pair))]);
        let unequal = |name: &str| Remark::UnequalComponents(name.to_owned());
        [found[0].contains(&unequal("b")), found[1].contains(&unequal("a"))]
    };
    let other = record("b", 0.02, 401);
    assert_eq!(remarked(&other, "p"), [true; 2]);
    assert_eq!(remarked(&other, "q"), [false; 2]);
    // Measures of a pair put zeros behind the shorter component.
    assert_eq!(remarked(&record("b", 0.01, 381), "p"), [false; 2]);
}

#[test]
fn a_recording_is_known_again_by_its_shape() {
    let motion = |shift: usize, scale: f64, power: f64| {
        let wave = (0..600).map(|i| {
            let t = 0.01 * f64::from(i) - 3.0;
            scale * libm::exp(-t * t) * libm::cos(power * t)
        });
        let samples = std::iter::repeat_n(0.0, shift).chain(wave);
        Accelerogram::try_new("x", 0.01, samples.collect()).unwrap()
    };
    // More than are compared together: the scale of each is its own.
    let many = (0..40).map(|k| match k {
        37 => motion(77, -0.2, 9.0),
        35 => motion(3, 0.1, 9.7),
        _ => motion(0, 0.3, 9.0 + 0.7 * f64::from(k)),
    });
    let profiles: Vec<_> = many.map(|record| Profile::of(&record)).collect();
    let found = duplicates(&profiles.iter().collect::<Vec<_>>());
    let others: Vec<(usize, usize, usize)> = (0..)
        .zip(&found)
        .filter_map(|(i, of)| of.map(|(first, _, count)| (i, first, count)))
        .collect();
    assert_eq!(others, [(0, 37, 1), (1, 35, 1), (35, 1, 1), (37, 0, 1)]);
}

/// Equal records are compared once, and count each.
#[test]
fn copies_count_beside_what_is_only_similar() {
    let record = |samples| Accelerogram::try_new("x", 0.01, samples).unwrap();
    let near = clean().iter().map(|a| a + 1e-5).collect();
    let other = clean().iter().rev().map(|a| a.abs()).collect();
    let [a, b, c] = [clean(), near, other].map(|s| Profile::of(&record(s)));
    let found = duplicates(&[&b, &a, &c, &a, &b, &a]);
    let counts = found.iter().map(|of| of.map(|(first, _, n)| (first, n)));
    let expected = [Some((1, 4)), Some((0, 4)), None];
    let later = [Some((0, 4)); 3];
    assert_eq!(counts.collect::<Vec<_>>(), [expected, later].concat());
}

/// What is compared does not change what is found.
mod pairwise {
    use proptest::prelude::*;

    use super::*;

    /// Every record against every other one.
    fn of_all_pairs(records: &[&Profile]) -> Vec<Option<(usize, u64, usize)>> {
        let of_one = |i: usize| {
            let alike = (0..records.len()).filter_map(|j| {
                let (first, second) = (records[i], records[j]);
                let with = correlation(first, second);
                let same = i != j && first.dt_s == second.dt_s;
                (same && with > SAME_RECORDING).then_some((j, with.to_bits()))
            });
            let alike: Vec<_> = alike.collect();
            let (first, with) = alike.first()?;
            Some((*first, *with, alike.len()))
        };
        (0..records.len()).map(of_one).collect()
    }

    /// One of three motions, with a little or much of another, from a sample
    /// to a sample, at one of two intervals.
    fn motion() -> impl Strategy<Value = Profile> {
        let shape = (0..3_u8, prop_oneof![Just(0.0), 0.0..0.4], 0..4_u8);
        let cut = (prop_oneof![Just(0), 0..330_usize], 350..900_usize);
        let scale = prop_oneof![Just(0.2), Just(-0.1)];
        (shape, cut, scale, 0..8).prop_map(
            |(shape, (from, to), scale, slow)| {
                let (base, share, other) = shape;
                let wave = |i: usize, k: u8| {
                    let (k, t) = (f64::from(k), i as f64 / 100.0 - 3.4);
                    libm::exp(-t * t * (0.2 + k))
                        * libm::cos((7.0 + 5.0 * k) * t + 0.3 * k)
                };
                let sample =
                    |i| scale * (wave(i, base) + share * wave(i, 3 + other));
                let dt_s = if slow == 0 { 0.02 } else { 0.01 };
                let samples = (from..to).map(sample).collect();
                let record = Accelerogram::try_new("x", dt_s, samples);
                Profile::of(&record.unwrap())
            },
        )
    }

    proptest! {
        #[test]
        fn all_pairs_give_the_same(
            motions in prop::collection::vec(motion(), 2..24),
            twice in prop::collection::vec(any::<prop::sample::Index>(), 0..6),
        ) {
            let copies = twice.iter().map(|k| k.get(&motions));
            let records: Vec<_> = motions.iter().chain(copies).collect();
            let found = duplicates(&records).into_iter();
            let bits = |(by, with, n): (usize, f64, usize)| {
                (by, with.to_bits(), n)
            };
            let found: Vec<_> = found.map(|of| of.map(bits)).collect();
            prop_assert_eq!(found, of_all_pairs(&records));
        }
    }
}

/// The same numbers at another interval are another motion.
#[test]
fn records_of_different_intervals_are_not_one_recording() {
    let alike = |dt_s: f64| {
        let record = |dt_s| Accelerogram::try_new("x", dt_s, clean()).unwrap();
        let both = [0.01, dt_s].map(|dt_s| Profile::of(&record(dt_s)));
        duplicates(&both.each_ref()).iter().flatten().count()
    };
    assert_eq!((alike(0.01), alike(0.02)), (2, 0));
}

/// A remark names one record, however many are alike: their number squared
/// would fill the memory.
#[test]
fn many_copies_of_a_record_have_a_remark_each() {
    let copy = |k: usize| {
        Accelerogram::try_new(format!("r{k:03}"), 0.01, clean()).unwrap()
    };
    let all: Vec<_> = (0..600).map(copy).collect();
    let all: Vec<_> =
        all.iter().map(|record| RemarkInput::of(record, None, &[])).collect();
    let found = remarks_together(&all);
    assert!(found.iter().all(|remarks| remarks.len() == 1));
    let words = |k: usize| found[k][0].to_string();
    assert!(words(0).contains("with r001 about"), "{}", words(0));
    assert!(words(7).contains("with r000 about"), "{}", words(7));
    assert!(words(599).contains("similar with 598 others"), "{}", words(599));
}
