//! Tests of the embedded suites as wholes.

use crate::pair::Pair;
use crate::suites::tests::MADE;
use crate::suites::{ORDINARY, PULSE, pairs};

fn check(made: &[Pair], count: usize, name: &str) {
    assert_eq!(made.len(), count);
    for (i, pair) in made.iter().enumerate() {
        for (record, letter) in pair.components.iter().zip(['a', 'b']) {
            let expected = format!("{name}-{:02}-{letter}", i + 1);
            assert_eq!(record.name(), expected);
            assert!(record.pga_g() > 0.14, "{expected}");
            let duration = record.duration_s();
            assert!((20.0..=90.0).contains(&duration), "{expected}");
            let end = record
                .samples_g()
                .windows(2)
                .fold(0.0, |v, w| v + 0.5 * record.dt_s() * (w[0] + w[1]));
            assert!(
                f64::abs(end) < 1e-4 * record.pgv_g_s(),
                "{expected}: end velocity {end} g s"
            );
            for a in record.samples_g() {
                let text = format!("{a:.6}");
                assert_eq!(text.parse::<f64>().expect("number"), *a);
            }
        }
    }
}

#[test]
fn suites_have_their_size_names_peaks_and_rest() {
    check(&MADE[0].0, 86, "ordinary");
    check(&MADE[1].0, 44, "pulse");
}

#[test]
fn suites_are_the_same_for_any_number_of_threads() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(3).build();
    let suites = pool.expect("pool").install(|| {
        [&ORDINARY, &PULSE].map(|suite| pairs(suite).expect("suite"))
    });
    // On the threads that the machine has.
    assert_eq!(suites, [0, 1].map(|k| MADE[k].0.clone()));
}
