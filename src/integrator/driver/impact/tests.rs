#[allow(clippy::duplicate_mod, reason = "also in ida/tests")]
#[path = "../../../../tests/compare.rs"]
mod compare;

use compare::hold;

use super::positive;
use crate::block::{Block, Restitution};
use crate::excitation::{Pulse, PulseKind};
use crate::integrator::driver::Driver;
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::forcing::PulseForcing;
use crate::number::dispatch::Isa;

const ALPHA: f64 = 0.25;

type Chattering = Driver<f64, PulseForcing<f64>, 2, 4>;

/// A block under whatever pulse, whose peak so far is this.
fn driver(model: Model, eta: f64, peak: f64) -> Chattering {
    let block = Block::try_new(ALPHA, 1.0).unwrap();
    let restitution = Restitution::constant(eta).unwrap();
    let dynamics =
        Dynamics::new(&block, restitution, model, Overturning::Alpha);
    let kind = PulseKind::Rectangle { amplitude: 1.0, duration_s: 1.0 };
    let forcing =
        PulseForcing::new(&Pulse::try_new(kind).unwrap(), 1.0, Isa::best());
    let mut driver = Driver::new(dynamics, forcing, Isa::best());
    driver.record.peak = peak;
    driver
}

/// Least number in (0, high) from which on this holds; infinite if none.
fn least(high: f64, holds: impl Fn(f64) -> bool) -> f64 {
    let (mut low, mut high) = (0.0, high);
    if !holds(high) {
        return f64::INFINITY;
    }
    for _ in 0..100 {
        let mid = 0.5 * (low + high);
        if holds(mid) { high = mid } else { low = mid }
    }
    high
}

#[test]
fn positive_excludes_zero_and_what_is_no_number() {
    assert_eq!(positive(0.5), Some(0.5));
    for x in [0.0, -0.0, -0.5, f64::NAN] {
        assert_eq!(positive(x), None);
    }
}

#[test]
fn an_impact_without_speed_rests_up_to_the_threshold() {
    for model in [Model::Nonlinear, Model::Linearized] {
        let driver = driver(model, 0.9, ALPHA);
        let threshold = driver.dynamics.threshold;
        for (f, rests) in [
            (0.0, true),
            (threshold, true),
            (-threshold, true),
            (threshold.next_up(), false),
            (-threshold.next_up(), false),
            (f64::NAN, true),
        ] {
            let found = driver.chatter(&[f, 0.1], 0.0, 1.0);
            let found = found.map(|chatter| chatter.time);
            assert_eq!(found, rests.then_some(0.0), "{f}");
        }
        // With speed, not at the threshold itself; nor without loss.
        let found = driver.chatter(&[threshold, 0.0], 1e-6, 1.0);
        assert!(found.is_none());
        let lossless = self::driver(model, 1.0, ALPHA);
        assert!(lossless.chatter(&[0.0, 0.0], 1e-6, 1.0).is_none());
        assert!(driver.chatter(&[0.0, 0.0], 1e-6, 1.0).is_some());
    }
}

/// Eq. 2 under a constant f: hops of 2 atanh(v/(alpha + s f)), s the side,
/// the speed falling by eta each.
fn series(eta: f64, f: f64, w: f64) -> f64 {
    let (mut time, mut v, mut side) = (0.0, w, 1.0);
    while v > 1e-16 * w {
        time += 2.0 * libm::atanh(v / (ALPHA + side * f));
        v *= eta;
        side = -side;
    }
    time
}

/// What is taken for proven is true, and its time is that of the series.
#[test]
fn chatter_ends_within_the_time_that_it_needs() {
    for eta in [0.3, 0.7, 0.92] {
        let driver = driver(Model::Linearized, eta, ALPHA);
        for f in [-0.12, 0.0, 0.05, 0.2] {
            for w in [1e-9, 1e-4, 3e-3] {
                let proven =
                    |left| driver.chatter(&[f, 0.0], w, left).is_some();
                let enough = least(1e3, proven);
                let exact = series(eta, f, w);
                assert!(
                    enough > exact * (1.0 - 1e-14),
                    "{eta} {f} {w} {enough}"
                );
                if enough.is_finite() {
                    let found = driver.chatter(&[f, 0.0], w, enough);
                    let found = found.unwrap();
                    let gap = (found.time / exact - 1.0).abs();
                    assert!(gap <= found.spread + 1e-14, "{gap:e}");
                    assert!(gap < 1e-14 + (w / 0.05) * (w / 0.05), "{gap:e}");
                } else {
                    assert!(w > 1e-9);
                }
            }
        }
    }
}

/// Where the proof begins to hold, as it is: time left, and largest rotation
/// so far.
#[test]
fn regresses_the_bounds_of_the_proof() {
    let mut found = Vec::new();
    for model in [Model::Nonlinear, Model::Linearized] {
        for eta in [0.5, 0.8] {
            let driver = driver(model, eta, ALPHA);
            for f in [[0.0, 0.0], [0.1, 0.5], [-0.15, 0.05], [0.05, -2.0]] {
                for w in [1e-4, 1e-3] {
                    let left = least(10.0, |left| {
                        driver.chatter(&f, w, left).is_some()
                    });
                    let peak = least(1.0, |peak| {
                        let driver = self::driver(model, eta, peak);
                        driver.chatter(&f, w, 1.0).is_some()
                    });
                    let name = format!("{model:?}, eta {eta}, f {f:?}, w {w}");
                    found.push((name, format!("{left:.6e} {peak:.6e}")));
                }
            }
        }
    }
    let columns = "least time left, least peak so far, of a proof";
    hold("rest.txt", columns, &found);
}
