//! Right answers with faults that no wrong model has: what deviates is named.
//! Coarse answers are called coarse, and wrong models never are.

use rocking::integrator::Model;
use rocking_score::{
    Answers, CodeVerdict, Item, OwnResponse, Problem, SceneExcitation, Value,
    answers_of, diagnose, own_answers, reference,
};

/// A normal number: the sum of twelve uniform ones of SplitMix64.
fn normal(state: &mut u64) -> f64 {
    let mut uniform = || {
        *state = state.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = *state;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        (z ^ (z >> 31)) as f64 / u64::MAX as f64
    };
    (0..12).map(|_| uniform()).sum::<f64>() - 6.0
}

/// Answers with each number altered.
fn altered(
    answers: &Answers,
    mut of: impl FnMut(&Problem, &Item, f64) -> f64,
) -> Answers {
    let mut out = answers.clone();
    for (place, item) in reference().items.iter().enumerate() {
        if let Some(Value::Number(x)) = answers.get(place) {
            let x = of(reference().scene(item), item, *x);
            out.set(place, Some(Value::Number(x)));
        }
    }
    out
}

/// Answers with a relative scatter that grows with a power of the condition.
fn noisy(answers: &Answers, scatter: f64, power: f64, seed: u64) -> Answers {
    let mut state = seed;
    altered(answers, |_, item, x| {
        let size = scatter * libm::pow(item.condition.max(1.0), power);
        x * (1.0 + size * normal(&mut state))
    })
}

/// Answers of the core to altered scenes.
fn answers_to(alter: impl Fn(&mut Problem)) -> Answers {
    let run = |scene: &Problem| {
        let mut scene = scene.clone();
        alter(&mut scene);
        OwnResponse::double(&scene)
    };
    answers_of(run).unwrap()
}

/// Answers of the core to altered samples at their interval in s.
fn answers_to_samples(alter: impl Fn(f64, &mut [f64])) -> Answers {
    answers_to(|scene| {
        let excitation = &mut scene.excitation;
        if let SceneExcitation::Samples { dt_s, samples_m_s2 } = excitation {
            alter(*dt_s, samples_m_s2);
        }
    })
}

/// The end of the names of quantities, their fault, the first group in words,
/// and its factor.
type Fault =
    (&'static str, fn(&Problem, f64) -> f64, &'static str, &'static str);

#[test]
fn factors_in_common_are_found() {
    let own = own_answers().unwrap();
    let peaks = "peak_ratio: the 30";
    let times = "impact_K_time_s: the 235";
    let thetas = "theta_K_rad: the 247";
    let faults: [Fault; 7] = [
        ("peak_ratio", |s, x| x * s.alpha_rad, peaks, "alpha"),
        ("peak_ratio", |_, x| 2.0 * x, peaks, "2"),
        ("_time_s", |_, x| 1e3 * x, times, "1000"),
        ("_rad", |_, x| x.to_degrees(), thetas, "57.2958"),
        ("_rad", |s, x| x / s.alpha_rad, thetas, "1/alpha"),
        ("_rad", |_, x| -x, thetas, "-1"),
        ("_rad", |_, x| x.abs(), thetas, "their sign"),
    ];
    for (end, fault, group, factor) in faults {
        let first = format!(
            "{group} answers are the certified values times {factor}."
        );
        // At a scatter of a right code, as without one.
        for scatter in [0.0, 1e-6] {
            let answers = altered(&own, |scene, item, x| {
                let is_it = item.quantity.ends_with(end);
                if is_it { fault(scene, x) } else { x }
            });
            let answers = noisy(&answers, scatter, 0.0, 1);
            let found = diagnose(&answers, &[]);
            assert_eq!(found.verdict, CodeVerdict::Unknown, "{end}");
            assert_eq!(found.remarks[0], first);
            // Each kind of time is a group.
            let groups = if end == "_time_s" { 5 } else { 1 };
            assert_eq!(found.remarks.len(), groups + 1);
        }
    }
}

#[test]
fn what_deviates_is_named() {
    let own = own_answers().unwrap();
    let means = |_: f64, a: &mut [f64]| {
        let mean = a.iter().sum::<f64>() / a.len() as f64;
        a.iter_mut().for_each(|a| *a -= mean);
    };
    // Each sample in part the sample before it.
    let late = |dt: f64, a: &mut [f64]| {
        for k in (1..a.len()).rev() {
            a[k] += (a[k - 1] - a[k]) * 0.002 / dt;
        }
    };
    let tapered = |_: f64, a: &mut [f64]| {
        let n = a.len() as f64;
        for (k, a) in a.iter_mut().enumerate() {
            *a *= (1.5 * (n - k as f64) / n).min(1.0);
        }
    };
    let linear = altered(&own, |scene, _, x| {
        let is_linear = scene.equation == Model::Linearized;
        if is_linear { 1.01 * x } else { x }
    });
    let small = answers_to(|scene| {
        if let SceneExcitation::Pulse(kind) = &mut scene.excitation {
            *kind.amplitude_mut() *= 0.98;
        }
    });
    for (answers, group) in [
        (answers_to_samples(means), "samples: "),
        (answers_to_samples(late), "samples: "),
        (answers_to_samples(tapered), "samples: "),
        (small, "pulses: "),
        (linear, "linearized equation: "),
    ] {
        let found = diagnose(&answers, &[]);
        assert_eq!(found.verdict, CodeVerdict::Unknown, "{group}");
        let remarks = found.remarks;
        assert_eq!(remarks.len(), 2, "{remarks:?}");
        assert!(remarks[0].starts_with(group), "{remarks:?}");
        let others = "agree to 15 digits at a condition of 1.";
        assert!(remarks[1].ends_with(others), "{remarks:?}");
    }
}

#[test]
fn coarse_answers_are_coarse() {
    let own = own_answers().unwrap();
    for power in [0.0, 0.5, 1.0] {
        for seed in 0..4 {
            for scatter in [1e-12, 1e-7, 1e-6] {
                let found = diagnose(&noisy(&own, scatter, power, seed), &[]);
                assert_eq!(found.verdict, CodeVerdict::None);
                assert_eq!(found.remarks.len(), 0);
            }
            for scatter in [1e-3, 1e-2, 5e-2] {
                let found = diagnose(&noisy(&own, scatter, power, seed), &[]);
                assert_eq!(found.verdict, CodeVerdict::Coarse, "{scatter}");
                // 99 % of normal numbers are within 2.6 deviations.
                let within = found.remarks[0].split(' ').nth(8).unwrap();
                let within = within.parse::<f64>().unwrap() / 100.0 / scatter;
                assert!((2.0..3.2).contains(&within), "{within}");
                assert_eq!(found.remarks.len(), 1);
            }
        }
        // Worse than half a digit is not right.
        let found = diagnose(&noisy(&own, 0.3, power, 1), &[]);
        assert_eq!(found.verdict, CodeVerdict::Unknown);
    }
    // A quarter of the answers does not show that no group is an exception.
    let mut few = noisy(&own, 1e-2, 0.0, 1);
    for place in (0..reference().items.len()).filter(|n| n % 4 > 0) {
        few.set(place, None);
    }
    assert_eq!(diagnose(&few, &[]).verdict, CodeVerdict::Unknown);
}

#[test]
fn a_scatter_with_exceptions_is_not_coarse() {
    let own = own_answers().unwrap();
    let is_time = |item: &Item| item.quantity.ends_with("_time_s");
    // Scatters of free motion, of forced motion, of its first uplift; and all
    // errors of times in one direction.
    for (free, forced, uplift, is_late) in [
        (0.0, 1e-2, 1e-2, false),
        (1e-3, 1e-3, 5e-2, false),
        (1e-2, 1e-2, 1e-2, true),
    ] {
        let mut state = 5;
        let answers = altered(&own, |scene, item, x| {
            let is_free = matches!(scene.excitation, SceneExcitation::Free);
            let mut error = normal(&mut state);
            if is_late && is_time(item) {
                error = error.abs();
            }
            let size = match item.quantity.as_str() {
                "uplift_time_s" => uplift,
                _ if is_free => free,
                _ => forced,
            };
            x * (1.0 + size * error)
        });
        let found = diagnose(&answers, &[]);
        assert_eq!(found.verdict, CodeVerdict::Unknown, "{free} {uplift}");
    }
}

#[test]
fn wrong_models_are_neither_right_nor_coarse() {
    let set = reference();
    for (model, name) in set.models.iter().enumerate() {
        let mut answers = Answers::none();
        for (place, item) in set.items.iter().enumerate() {
            answers.set(place, item.wrong[model].clone());
        }
        let withheld: Vec<&str> = name.split('+').collect();
        for scatter in [0.0, 1e-5, 1e-4] {
            let answers = noisy(&answers, scatter, 0.0, 7);
            let found = diagnose(&answers, &withheld);
            // The answers of this one agree to 1e-3.
            let expected = match name.as_str() {
                "last-sample-lost" => found.verdict == CodeVerdict::None,
                _ => {
                    found.verdict == CodeVerdict::Known
                        || found.verdict == CodeVerdict::Unknown
                }
            };
            assert!(expected, "{name}: {found:?}");
            let is_unknown = found.verdict == CodeVerdict::Unknown;
            assert_eq!(is_unknown, !found.remarks.is_empty());
        }
    }
}
