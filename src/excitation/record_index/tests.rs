use super::{RUN, RecordIndex, WINDOWS, Window};

/// Noise with a drift, no multiple of a run long.
fn samples() -> Vec<f64> {
    let mut state = 7_u64;
    let noise = |k: usize| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let white = (state >> 40) as f64 / 16_777_216.0 - 0.5;
        white + 0.3 * libm::sin(0.03 * k as f64) + 0.01
    };
    (0..50 * RUN + 11).map(noise).collect()
}

/// Velocity and place by sums over a hundredth of an interval, zero at the
/// end.
fn motion(samples: &[f64]) -> Vec<(f64, f64)> {
    const PARTS: usize = 100;
    let part = 1.0 / PARTS as f64;
    let (mut v, mut d) = (0.0, 0.0);
    let mut out = vec![(v, d)];
    for pair in samples.windows(2).rev() {
        for k in (0..PARTS).rev() {
            let share = (k as f64 + 0.5) * part;
            let a = pair[0] + share * (pair[1] - pair[0]);
            d -= (v - 0.5 * a * part) * part;
            v -= a * part;
            out.push((v, d));
        }
    }
    out.reverse();
    out
}

/// Bounds hold, and by no more than what summarising runs costs.
#[test]
fn what_is_left_is_bounded_by_fine_sums() {
    let samples = samples();
    let index = RecordIndex::new(&samples);
    let motion = motion(&samples);
    for interval in (0..samples.len() - 1).step_by(41) {
        let rest = &motion[100 * interval..];
        let left = index.left(interval);
        let speed = rest.iter().map(|m| m.0.abs()).fold(0.0, f64::max);
        let travel: f64 = rest.iter().map(|m| 0.01 * m.0.abs()).sum();
        assert!(left.speed >= speed && left.travel >= 0.999 * travel);
        let run = &motion[100 * (interval / RUN * RUN)..];
        let speed = run.iter().map(|m| m.0.abs()).fold(0.0, f64::max);
        let travel: f64 = run.iter().map(|m| 0.01 * m.0.abs()).sum();
        assert!(left.speed < speed + 0.3 && left.travel < 1.1 * travel + 1.0);
        for (k, runs) in WINDOWS.iter().enumerate() {
            let width = |from: usize, to: usize| {
                let to = (100 * to).min(motion.len() - 1);
                let window = &motion[100 * from..=to];
                let places = window.iter().map(|m| m.1);
                let low = places.clone().fold(f64::INFINITY, f64::min);
                places.fold(f64::NEG_INFINITY, f64::max) - low
            };
            let sway = index.sway(interval, Window(k));
            let longest = RUN * (runs - 1);
            assert_eq!(RecordIndex::window(longest as f64), Some(Window(k)));
            assert!(sway >= width(interval, interval + longest));
            if interval / RUN + runs > 50 {
                let first = interval / RUN * RUN;
                assert!(sway < width(first, samples.len()) + 0.3);
            }
        }
    }
    let most = RUN * (WINDOWS[WINDOWS.len() - 1] - 1);
    assert_eq!(RecordIndex::window(most as f64 + 0.5), None);
    assert_eq!(RecordIndex::window(f64::NAN), None);
}

#[test]
fn windows_are_at_most_twice_the_ones_before() {
    let mut before = 1;
    for runs in WINDOWS {
        assert!(before < runs && runs <= 2 * before);
        before = runs;
    }
}
