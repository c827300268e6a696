use std::collections::BTreeMap;

use super::*;
use libm::{exp, log, sin, tan};
use rocking::excitation::ScaledRecord;
use rocking::{Excitation, Observe, Scene, respond};
use rocking_records::intensity::IntensityMeasure;
use rocking_statistics::Interval;
use rocking_statistics::lognormal::FitError;
use rocking_statistics::streams::{Streams, standard_normal};

const P: f64 = 4.0;

fn block(alpha: f64) -> Block {
    Block::try_new(alpha, P).unwrap()
}

/// Five cycles that die away, of a period, with a peak near `level_g`.
fn motion(name: &str, period_s: f64, level_g: f64) -> Accelerogram {
    let sample = |k: u32| {
        let t = 0.01 * f64::from(k) / period_s;
        let fades = (exp(-0.5 * t) - exp(-2.5)).max(0.0);
        level_g * fades * sin(std::f64::consts::TAU * t)
    };
    let last = (500.0 * period_s) as u32;
    Accelerogram::try_new(name, 0.01, (0..=last).map(sample).collect())
        .unwrap()
}

fn options(slenderness: Slenderness) -> TestOptions {
    TestOptions {
        slenderness,
        restitution: Restitution::constant(0.92).unwrap(),
        model: Model::Nonlinear,
        gravity_m_s2: 9.81,
        measures: vec![IntensityMeasure::PGA],
        draws: Draws { replicates: 200, seed: 0 },
    }
}

/// Whether a block overturns under a record times a factor.
fn falls(alpha: f64, record: &Accelerogram, factor: f64) -> bool {
    let restitution = Restitution::constant(0.92).unwrap();
    let moved = ScaledRecord::by_factor(record, factor);
    let scene =
        Scene::new(block(alpha), restitution, Excitation::Record(moved));
    respond(&scene, &Observe::default()).unwrap().outcome.is_overturned()
}

/// Twelve motions at six levels; the specimen is a block that feels each
/// motion by a factor that scatters.
fn tests(alpha: f64, scatter: f64) -> Vec<ShakingTest> {
    let mut stream = Streams::new("shaking", 0).stream(0);
    let mut all = Vec::new();
    for k in 0..12u32 {
        let period_s = 0.4 + 0.07 * f64::from(k);
        for (j, level) in [0.2, 0.3, 0.42, 0.6, 0.85, 1.2].iter().enumerate() {
            let name = format!("test {k}-{j}");
            let record = motion(&name, period_s, *level);
            let felt = exp(scatter * standard_normal(&mut stream));
            let fate = match falls(alpha, &record, felt) {
                true => TestFate::Overturned,
                false => TestFate::Stood,
            };
            let columns = BTreeMap::from([
                ("level".to_owned(), *level),
                ("constant".to_owned(), 1.0),
            ]);
            all.push(ShakingTest {
                record,
                motion: format!("motion {k}"),
                fate,
                columns,
            });
        }
    }
    all
}

#[test]
fn a_capacity_parts_standing_from_overturning() {
    let alpha = 0.12;
    let all = tests(alpha, 0.2);
    let given = options(Slenderness::Given(block(alpha)));
    let found = compare_with_tests(&all, &given).unwrap();
    assert_eq!((found.tests, found.motions, found.unknown), (72, 12, 0));
    assert_eq!(found.never_overturned, 0);
    for (own, test) in found.each.iter().zip(&all) {
        let c = own.capacity_factor;
        assert!(falls(alpha, &test.record, 1.0001 * c), "{}", own.test);
        assert!(!falls(alpha, &test.record, 0.9985 * c), "{}", own.test);
        assert_eq!(own.overturns_at_level, falls(alpha, &test.record, 1.0));
    }
    // A level twice as high has half the capacity factor.
    let each = &found.each;
    let product = |one: &TestResult| one.capacity_factor * one.pga_g;
    for own in each.chunks(6) {
        let first = product(&own[0]);
        for other in own {
            assert!((product(other) / first - 1.0).abs() < 1e-3);
        }
    }
    // The specimen is the block, felt with the scatter 0.2.
    let bias = found.computed.median.interval().unwrap();
    assert!(bias.holds(1.0) && bias.high() / bias.low() < 1.4, "{bias}");
    let scatter = found.computed.dispersion.interval().unwrap();
    assert!(scatter.holds(0.2), "{scatter}");
    assert!(found.computed.right.value() > 0.85);
    assert_eq!(found.alpha_rad, Estimate::exact(alpha));
}

#[test]
fn the_slenderness_is_found_again() {
    let all = tests(0.12, 0.2);
    let fitted = options(Slenderness::Fitted { p_rad_s: P });
    let found = compare_with_tests(&all, &fitted).unwrap();
    let alpha = found.alpha_rad;
    let ends = alpha.interval().unwrap();
    assert!(found.alpha_is_fitted && ends.holds(0.12), "{ends}");
    assert_eq!(found.computed.median.value(), 1.0);
    // The interval of alpha is as wide as that of the bias, whose logarithm
    // falls as ln alpha rises.
    let bias = found.computed.median.interval().unwrap();
    let width = |ends: Interval| log(ends.high() / ends.low());
    let ratio = width(ends) / width(bias);
    assert!((0.8..1.25).contains(&ratio), "{ratio}");
    // The block found is the block given.
    let given = options(Slenderness::Given(block(alpha.value())));
    let given = compare_with_tests(&all, &given).unwrap();
    assert!((given.computed.median.value() - 1.0).abs() < 2e-3);
    assert_eq!(given.computed.dispersion, found.computed.dispersion);
}

#[test]
fn unknown_fates_are_counted_and_left_out() {
    let given = options(Slenderness::Given(block(0.12)));
    let all = tests(0.12, 0.2);
    let mut more = all.clone();
    for test in &all[20..25] {
        more.push(ShakingTest { fate: TestFate::Unknown, ..test.clone() });
    }
    let found = compare_with_tests(&more, &given).unwrap();
    let known = compare_with_tests(&all, &given).unwrap();
    assert_eq!((known.unknown, found.unknown), (0, 5));
    assert_eq!(TestComparison { unknown: 0, ..found }, known);
}

#[test]
fn a_motion_that_never_overturns_the_block_has_its_last_level() {
    let mut all = tests(0.12, 0.2);
    let fate = TestFate::Stood;
    // A push and a pull of a millisecond each.
    let samples = vec![0.0, 0.3, -0.3, 0.0];
    let record = Accelerogram::try_new("fast", 1e-3, samples).unwrap();
    let motion = "fast".to_owned();
    let columns = BTreeMap::new();
    all.push(ShakingTest { record, motion, fate, columns });
    let given = options(Slenderness::Given(block(0.12)));
    let found = compare_with_tests(&all, &given).unwrap();
    assert_eq!(found.never_overturned, 1);
    let last = found.each.last().unwrap();
    let reached = last.capacity_factor * last.pga_g / tan(0.12);
    assert!((reached - 100.0).abs() < 0.2, "{reached}");
    assert!(last.probability < 1e-6);
}

#[test]
fn a_measure_without_a_fit_is_named() {
    let all = tests(0.12, 0.2);
    let measures = ["column:level", "column:constant"];
    let measures = measures.map(|im| im.parse().unwrap()).to_vec();
    let given = options(Slenderness::Given(block(0.12)));
    let given = TestOptions { measures, ..given };
    let found = compare_with_tests(&all, &given).unwrap();
    assert_eq!(found.rivals.len(), 1);
    assert_eq!(found.distributions[0].im, "column:level");
    let [unfitted] = &found.unfitted[..] else { panic!("{found:?}") };
    assert_eq!(unfitted.im, "column:constant");
    assert!(!unfitted.computed && unfitted.reason.contains('1'));
}

#[test]
fn what_cannot_be_compared_is_refused() {
    let given = options(Slenderness::Given(block(0.12)));
    let refused = |all: &[ShakingTest]| compare_with_tests(all, &given);
    let all = tests(0.12, 0.2);
    let with = |fate: TestFate| -> Vec<ShakingTest> {
        all.iter().map(|t| ShakingTest { fate, ..t.clone() }).collect()
    };
    assert_eq!(refused(&[]), Err(ShakingError::NoTests { unknown: 0 }));
    let unknown = refused(&with(TestFate::Unknown));
    assert_eq!(unknown, Err(ShakingError::NoTests { unknown: 72 }));
    let one_fate = |which| ShakingError::OneFate { which, tests: 72 };
    let fell = refused(&with(TestFate::Overturned));
    assert_eq!(fell, Err(one_fate("all")));
    let stood = refused(&with(TestFate::Stood));
    assert_eq!(stood, Err(one_fate("none of")));
    let few = ShakingError::Motions { found: 2, tests: 12 };
    assert_eq!(refused(&all[..12]), Err(few));
    // The specimen is the block itself: one factor parts the outcomes.
    let found = refused(&all).unwrap();
    let same = all.iter().zip(&found.each).map(|(test, own)| {
        let (fell, stood) = (TestFate::Overturned, TestFate::Stood);
        let fate = if own.capacity_factor <= 1.0 { fell } else { stood };
        ShakingTest { fate, ..test.clone() }
    });
    let parted = refused(&same.collect::<Vec<_>>()).unwrap_err();
    let is_parted = matches!(
        parted,
        ShakingError::Fit { without: None, source: FitError::Parted { .. } }
    );
    assert!(is_parted, "{parted}");
    let text = parted.to_string();
    assert!(text.starts_with("demand over capacity of the tests: "), "{text}");
    let measures = vec!["column:mass".parse().unwrap()];
    let missing = TestOptions { measures, ..given.clone() };
    let missing = compare_with_tests(&all, &missing).unwrap_err();
    assert_eq!(
        missing.to_string(),
        "test test 0-0: column:mass is NaN: expected a positive number"
    );
    let draws = Draws { replicates: 1, seed: 0 };
    let few = TestOptions { draws, ..given.clone() };
    assert!(matches!(
        compare_with_tests(&all, &few),
        Err(ShakingError::Draws(_))
    ));
}
