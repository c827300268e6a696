//! Equality at the uplift threshold, jumps, and what a run takes.

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Arithmetic, Certify, Model, Observe, Outcome, Overturning, Response,
    Scene, Work, certify, respond,
};

use super::compare::near;

const ALPHA: f64 = 0.2;

/// Eq. 2, whose threshold is alpha itself; p = 2.
fn scene(excitation: Excitation<'_>) -> Scene<'_> {
    Scene {
        block: Block::try_new(ALPHA, 2.0).unwrap(),
        restitution: Restitution::constant(0.9).unwrap(),
        model: Model::Linearized,
        overturning: Overturning::HalfPi,
        excitation,
        initial_ratio: 0.0,
    }
}

fn under(dt_s: f64, samples: Vec<f64>, observe: &Observe) -> Response {
    let record = Accelerogram::try_new("made", dt_s, samples).unwrap();
    let record = ScaledRecord::by_factor(&record, 1.0);
    respond(&scene(Excitation::Record(record)), observe).unwrap()
}

#[test]
fn a_record_lifts_strictly_above_the_threshold() {
    let quiet = Observe::default();
    let at = |level: f64| {
        let mut samples = vec![0.0; 200];
        for (place, sign) in [(90, 1.0), (130, -1.0)] {
            samples[place] = sign * level;
        }
        under(0.02, samples, &quiet)
    };
    assert_eq!(at(ALPHA).outcome, Outcome::NoUplift);
    assert_eq!(at(ALPHA.next_down()).outcome, Outcome::NoUplift);
    // One unit in the last place lifts, at that sample.
    let time_s = at(ALPHA.next_up()).uplift_time_s.unwrap();
    near("uplift, s", time_s, 1.8, 1e-12);
    assert_eq!(at(1.1 * ALPHA).work.uplifts, 2);
    // A plateau at the threshold is no exceedance either.
    assert_eq!(
        under(0.02, vec![ALPHA; 100], &quiet).outcome,
        Outcome::NoUplift
    );
}

#[test]
fn a_pulse_that_touches_the_threshold_does_not_lift() {
    // Numbers that no operation rounds.
    let alpha = 0.375;
    for (excess, lifts) in [(0.0, false), (1e-9, true), (-1e-9, false)] {
        for sign in [1.0, -1.0] {
            let kind = PulseKind::Triangle {
                amplitude: sign * alpha * (1.0 + excess),
                duration_s: 1.5,
            };
            let pulse = Pulse::try_new(kind).unwrap();
            let scene = Scene {
                block: Block::try_new(alpha, 1.0).unwrap(),
                ..scene(Excitation::Pulse(&pulse))
            };
            let found = respond(&scene, &Observe::default()).unwrap();
            assert_eq!(found.uplift_time_s.is_some(), lifts, "{kind:?}");
        }
    }
}

/// From its first sample on a constant record is a rectangular pulse:
/// u = (a - alpha) (cosh(p t) - 1).
#[test]
fn a_first_sample_above_the_threshold_lifts_at_once() {
    let observe = Observe { until_s: Some(0.15), ..Observe::default() };
    for (level, side) in [(0.5, -1.0), (-0.5, 1.0)] {
        let found = under(0.01, vec![level; 40], &observe);
        let due = (0.5 / ALPHA - 1.0) * (libm::cosh(0.3) - 1.0);
        near("peak ratio", found.peak_ratio, due, 1e-14);
        assert_eq!(found.uplift_time_s, Some(0.0));
        let seen = Observe {
            history_interval_s: Some(0.1),
            until_s: Some(0.15),
            ..Observe::default()
        };
        let history = under(0.01, vec![level; 40], &seen).history;
        assert_eq!(history[1].rotation_rad.signum(), side);
    }
}

/// Long intervals are divided into equal steps of at most 0.1/p.
#[test]
fn long_intervals_take_as_many_steps_as_they_should() {
    for (dt_s, each) in
        [(0.04, 1), (0.05, 1), (0.06, 2), (0.1, 2), (0.11, 3), (0.4, 8)]
    {
        // Lifted at once, in flight to the end of observation.
        let pieces = 2;
        let until_s = Some(f64::from(pieces) * dt_s);
        let observe = Observe { until_s, ..Observe::default() };
        let found = under(dt_s, vec![0.21; 8], &observe);
        assert_eq!(found.work.impacts, 0);
        assert_eq!(
            found.work.steps,
            u64::from(pieces as u32 * each),
            "{dt_s}"
        );
        let due = 0.05 * (libm::cosh(2.0 * f64::from(pieces) * dt_s) - 1.0);
        near("peak ratio", found.peak_ratio, due, 1e-12 * due);
    }
}

/// Observation that ends before the motion shows leaves the peak where it
/// was: at the release.
#[test]
fn a_peak_is_the_first_of_equal_ones() {
    let free = Scene { initial_ratio: 0.5, ..scene(Excitation::Free) };
    let observe = Observe { until_s: Some(1e-9), ..Observe::default() };
    let record = Accelerogram::try_new("zeros", 0.1, vec![0.0; 5]).unwrap();
    let record = ScaledRecord::by_factor(&record, 1.0);
    let excitation = Excitation::Record(record);
    for scene in [free, Scene { excitation, ..free }] {
        let found = respond(&scene, &observe).unwrap();
        assert_eq!(found.peak_ratio, 0.5);
        assert_eq!(found.peak_time_s, Some(0.0));
        // It moves, though nothing lifted it and it met nothing yet.
        assert_eq!(found.outcome, Outcome::Rocked { peak_ratio: 0.5 });
    }
}

#[test]
fn nothing_costs_nothing() {
    let found = respond(&scene(Excitation::Free), &Observe::default());
    assert_eq!(found.unwrap().work, Work::default());
}

/// A ground that exceeds the threshold by so little that the block makes
/// endless tiny hops. Nothing depends on them: the next peak overturns it.
#[test]
fn hops_without_consequence_need_no_wider_arithmetic() {
    let threshold = libm::tan(ALPHA);
    let [next, held] = [1.5 * threshold, 0.5 * threshold];
    let samples = vec![0.0, threshold, 0.0, next, held, held, held];
    let record = Accelerogram::try_new("tie", 1.0, samples).unwrap();
    let block = Block::try_new(ALPHA, 2.0).unwrap();
    for eta in [0.5, 0.92, 0.99, 0.999] {
        for excess in [1e-12, 1e-9, 3e-7, 1e-4] {
            let record = ScaledRecord::by_factor(&record, 1.0 + excess);
            let eta = Restitution::constant(eta).unwrap();
            let scene = Scene::new(block, eta, Excitation::Record(record));
            let found = certify(&scene, &Certify::default()).unwrap();
            assert!(found.resolved, "{excess:e}: {found:?}");
            assert_eq!(found.by, Arithmetic::Double, "{excess:e}: {found:?}");
            assert!(found.outcome.is_overturned());
        }
    }
}
