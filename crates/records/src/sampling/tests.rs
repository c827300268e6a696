//! Steps of times in every printing; breaks of each kind; the rule by all
//! pairs of times.

use proptest::prelude::*;

use super::*;

/// How a program writes the time `i dt`.
#[derive(Clone, Copy, Debug)]
enum Printing {
    Significant(usize),
    Decimals(usize),
    /// `float32(i * dt)`.
    Single,
    /// `i * float32(dt)`, which rounds twice.
    SingleStep,
    /// `t += float32(dt)`.
    SingleSum,
}

use Printing::*;

fn read(text: &str) -> f64 {
    text.parse().unwrap()
}

fn printed(printing: Printing, dt_s: f64, first: usize, n: usize) -> Vec<f64> {
    let single = dt_s as f32;
    let mut sum = first as f32 * single;
    let time = |i: usize| {
        let time = i as f64 * dt_s;
        match printing {
            Significant(digits) => read(&format!("{time:.*e}", digits - 1)),
            Decimals(places) => read(&format!("{time:.places$}")),
            Single => f64::from(time as f32),
            SingleStep => f64::from(i as f32 * single),
            SingleSum => {
                let now = sum;
                sum += single;
                f64::from(now)
            }
        }
    };
    (first..first + n).map(time).collect()
}

fn found(times: &[f64]) -> Result<Sampling, Uneven> {
    let digits = Digits::of(times);
    interval(times, |i| digits.resolution_s(times[i]))
}

const PRINTINGS: [Printing; 11] = [
    Significant(5),
    Significant(6),
    Significant(7),
    Decimals(2),
    Decimals(3),
    Decimals(4),
    Decimals(5),
    Decimals(6),
    Single,
    SingleStep,
    SingleSum,
];

fn printing() -> impl Strategy<Value = Printing> {
    (0..PRINTINGS.len()).prop_map(|i| PRINTINGS[i])
}

/// Intervals of recorders: whole numbers of samples a second, and decimals.
fn recorder() -> impl Strategy<Value = f64> {
    let rates = [50, 64, 75, 100, 120, 128, 150, 200, 250, 256, 300, 400, 500];
    let rate = (0..rates.len()).prop_map(move |i| 1.0 / f64::from(rates[i]));
    prop_oneof![rate, (1..60_u32).prop_map(|n| f64::from(n) / 1000.0)]
}

/// Whether the digits of the first two times resolve a step, or all times
/// are exact.
fn resolves(printing: Printing, dt_s: f64, times: &[f64]) -> bool {
    let off = |i: usize| (times[i] - times[0] - i as f64 * dt_s).abs();
    let exact = (0..times.len()).all(|i| off(i) < 1e-7 * dt_s);
    let unit = match printing {
        Decimals(places) => read(&format!("1e-{places}")),
        Significant(digits) => {
            let text = format!("{:.*e}", digits - 1, times[1]);
            let exponent: i32 =
                text.split_once('e').unwrap().1.parse().unwrap();
            let last = exponent - digits as i32 + 1;
            read(&format!("1e{last}"))
        }
        Single | SingleStep | SingleSum => 0.0,
    };
    exact || 0.5 * unit < 0.249 * dt_s
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(60))]

    /// The step comes back to the last bit wherever digits resolve it, and
    /// is refused elsewhere.
    #[test]
    fn the_step_comes_back(
        printing in printing(),
        dt_s in recorder(),
        first in 0..2_usize,
        n in 2000..8000_usize,
    ) {
        let times = printed(printing, dt_s, first, n);
        match found(&times) {
            Ok(found) => prop_assert_eq!(found.dt_s, dt_s),
            Err(error) => {
                prop_assert!(!resolves(printing, dt_s, &times), "{}", error);
            }
        }
    }

    /// A line that is missing, doubled or moved is refused, at its place or
    /// the one that shows it.
    #[test]
    fn breaks_are_refused_at_their_place(
        printing in printing(),
        dt_s in recorder(),
        n in 20..2000_usize,
        at in 0.0..1.0_f64,
        kind in 0..3_usize,
    ) {
        let whole = printed(printing, dt_s, 0, n);
        // Resolved to the last line.
        let coarse = match printing {
            // Zeros at the end are not written.
            Significant(_) | Decimals(_) => {
                Digits::of(&whole).resolution_s(whole[n - 1])
            }
            Single | SingleStep | SingleSum => 1e-5,
        };
        // Steps of dt and of 2 dt: each end is off by twice that at most.
        prop_assume!(8.0 * coarse < 0.99 * dt_s);
        let k = 1 + (at * (n - 3) as f64) as usize;
        let mut times = whole.clone();
        let shows = match kind {
            0 => {
                times.remove(k);
                k
            }
            1 => {
                times.insert(k, whole[k]);
                k + 1
            }
            _ => {
                times[k] = whole[k + 1];
                k
            }
        };
        let error = found(&times).unwrap_err();
        prop_assert_eq!(error.index(), Some(shows.max(2)), "{}", error);
        let text = error.to_string();
        let (time, expected) = text.split_once(" s: expected ").unwrap();
        let time = time.strip_prefix("time ").unwrap();
        let shown = expected.split_once(" s,").unwrap().0;
        prop_assert!(shown.split(" to ").all(|one| one != time), "{}", text);
    }

    /// A step that changes by 1 % or more is refused as soon as the change
    /// adds up to more than the digits hide.
    #[test]
    fn a_changed_step_is_refused(
        printing in printing(),
        dt_s in recorder(),
        n in 200..2000_usize,
        change in 0.01..0.5_f64,
        faster in prop::bool::ANY,
    ) {
        let places = match printing {
            Decimals(places) => places,
            Significant(digits) => digits - 2,
            Single | SingleStep | SingleSum => 5,
        };
        let coarse = read(&format!("1e-{places}"));
        prop_assume!(coarse < 0.2 * dt_s);
        let change = if faster { 1.0 + change } else { 1.0 - 0.5 * change };
        let k = n / 2;
        let time = |i: usize| {
            let steps = k.min(i) as f64 + i.saturating_sub(k) as f64 * change;
            read(&format!("{:.places$}", steps * dt_s))
        };
        let times: Vec<f64> = (0..n).map(time).collect();
        prop_assume!((change - 1.0).abs() * dt_s * (n - k) as f64 > 4.0 * coarse);
        let error = found(&times).unwrap_err();
        prop_assert!(error.index() > Some(1), "{}", error);
        if !matches!(error, Uneven::Step { coarse: true, .. }) {
            prop_assert!(error.index() > Some(k), "{}", error);
        }
    }

    /// The hulls find the steps of all pairs of times, and the same fault.
    #[test]
    fn the_steps_are_those_of_all_pairs(
        offs in prop::collection::vec((-1.0..1.0_f64, 0.1..1.0_f64), 2..40),
        wide in 0.1..2.0_f64,
        loose in 0.0..0.2_f64,
    ) {
        let times: Vec<f64> =
            (0..).zip(&offs).map(|(i, (off, _))| f64::from(i) + off).collect();
        let allowed = |i: usize| wide * offs[i].1;
        let drift = |i: usize| loose * i as f64;
        let pairs = |n: usize| {
            let (mut least, mut most) = (0.0_f64, f64::INFINITY);
            for j in 0..n {
                for i in 0..j {
                    let apart = times[j] - times[i];
                    let room = allowed(i) + allowed(j) + drift(j) - drift(i);
                    let steps = (j - i) as f64;
                    least = least.max((apart - room) / steps);
                    most = most.min((apart + room) / steps);
                }
            }
            (least, most)
        };
        let fails = (1..=times.len()).find(|n| {
            let (least, most) = pairs(*n);
            least > most
        });
        match constant(&times, allowed, drift) {
            Ok(Steps { least_s, most_s }) => {
                prop_assert_eq!(fails, None);
                let (least, most) = pairs(times.len());
                prop_assert!((least_s - least).abs() < 1e-12);
                prop_assert!((most_s - most).abs() < 1e-12);
            }
            Err(error) => {
                prop_assert_eq!(error.index().map(|i| i + 1), fails);
                let Uneven::Step { found_s, expected_s, coarse: false, .. } =
                    error
                else { return Err(TestCaseError::fail("another fault")) };
                let (least, most) = expected_s;
                prop_assert!(least <= most);
                prop_assert!(found_s < least || found_s > most);
            }
        }
    }
}

/// MATLAB's five digits beyond 100 s at 0.005 s: half of the times are those
/// of the line before, and still a line more or less shows.
#[test]
fn five_digits_beyond_a_hundred_seconds() {
    let times = printed(Significant(5), 0.005, 0, 30_000);
    let Sampling { dt_s, off_s } = found(&times).unwrap();
    assert_eq!(dt_s, 0.005);
    assert!(off_s > 0.0049 && off_s < 0.0051, "{off_s}");
    for k in [25_000, 25_001, 29_000] {
        let mut gap = times.clone();
        gap.remove(k);
        let place = found(&gap).unwrap_err().index().unwrap();
        assert!(place >= k && place < k + 10, "{k}: {place}");
        let mut twice = times.clone();
        twice.insert(k, times[k]);
        let place = found(&twice).unwrap_err().index().unwrap();
        assert!(place >= k && place < k + 10, "{k}: {place}");
    }
}

/// Sums in single precision leave the grid by several steps.
#[test]
fn sums_in_single_precision_are_followed() {
    let times = printed(SingleSum, 0.005, 0, 20_000);
    let Sampling { dt_s, off_s } = found(&times).unwrap();
    assert_eq!(dt_s, 0.005);
    assert!(off_s > 0.005, "{off_s}");
    let mut gap = times.clone();
    gap.remove(15_000);
    assert_eq!(found(&gap).unwrap_err().index(), Some(15_000));
    // The same drift in times with all digits of a double is none.
    let drift = |i: usize| times[i] + 1e-9 * (i % 7) as f64;
    let drifting: Vec<f64> = (0..times.len()).map(drift).collect();
    assert!(found(&drifting).is_err());
}

#[test]
fn faults_are_distinguished() {
    let text = |times: &[f64]| found(times).unwrap_err().to_string();
    assert_eq!(text(&[0.0]), "number of times: 1: expected at least 2");
    assert!(text(&[0.0, f64::NAN, 1.0]).starts_with("a time that is not"));
    assert!(text(&[0.1, 0.0]).starts_with("the times end at 0 s: expected"));
    // Three decimals whose step changes at the third time.
    assert_eq!(
        text(&[0.0, 0.005, 0.006, 0.007, 0.008]),
        "time 0.006 s: expected 0.01 s, a constant step from the times \
         before, or times with more digits"
    );
    assert_eq!(
        text(&[0.0, 0.0, 0.01]),
        "time 0 s: expected 0.005 s, a constant step from the times before, \
         or times with more digits"
    );
    assert_eq!(
        text(&[0.0, 0.008, 0.016, 0.023]),
        "steps of 7.500e-3 to 8.000e-3 s fit the times: expected more times, \
         or times with more digits"
    );
}
