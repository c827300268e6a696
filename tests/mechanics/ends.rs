//! The end of observation, and ground accelerations at the uplift threshold:
//! closed forms written out here.

use std::cell::Cell;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Arithmetic, Assessment, Certify, Decision, Model, Observe, Outcome,
    Overturning, Response, Scene, certify, respond,
};

const ALPHA: f64 = 0.25;

/// Eq. 2, whose threshold is alpha itself; p = 2.
fn scene(excitation: Excitation<'_>) -> Scene<'_> {
    Scene {
        block: Block::try_new(ALPHA, 2.0).unwrap(),
        restitution: Restitution::constant(0.9).unwrap(),
        model: Model::Linearized,
        overturning: Overturning::Alpha,
        excitation,
        initial_ratio: 0.0,
    }
}

fn rectangle(amplitude: f64, duration_s: f64) -> Pulse {
    Pulse::try_new(PulseKind::Rectangle { amplitude, duration_s }).unwrap()
}

fn until(scene: &Scene<'_>, until_s: f64) -> Response {
    let until_s = Some(until_s);
    let observe = Observe { accuracy: true, until_s, ..Observe::default() };
    respond(scene, &observe).unwrap()
}

/// After a rectangle of d = 0.2/p at twice the threshold the block rises on:
/// u/alpha = 1 - (2 - cosh d) cosh t + sinh d sinh t, until it turns.
#[test]
fn a_rise_after_the_excitation_that_observation_cuts_is_the_peak() {
    let pulse = rectangle(2.0 * ALPHA, 0.1);
    let scene = scene(Excitation::Pulse(&pulse));
    let (c, s) = (libm::cosh(0.2), libm::sinh(0.2));
    let at = |t: f64| 1.0 - (2.0 - c) * libm::cosh(t) + s * libm::sinh(t);
    let top = libm::atanh(s / (2.0 - c));
    for share in [0.01, 0.5, 0.999, 1.0, 1.5, 3.0] {
        let until_s = 0.1 + 0.5 * share * top;
        let found = until(&scene, until_s);
        let due = at(top * share.min(1.0));
        let gap = (found.peak_ratio - due).abs();
        let bound = found.error_estimate.unwrap();
        assert!(gap <= bound && bound < 1e-13, "{share}: {gap:e} {bound:e}");
        let peak_s = found.peak_time_s.unwrap();
        let due_s = 0.1 + 0.5 * top * share.min(1.0);
        assert!((peak_s - due_s).abs() < 1e-9, "{share}: {peak_s}");
        let outcome = Outcome::Rocked { peak_ratio: found.peak_ratio };
        assert_eq!(found.outcome, outcome);
    }
}

/// A rectangle of 1.2 times the threshold overturns the block at
/// cosh(p t) = 6, in free motion where it ends before.
#[test]
fn an_overturning_at_the_end_of_observation_is_not_resolved() {
    for duration_s in [5.0, 1.0] {
        let pulse = rectangle(1.2 * ALPHA, duration_s);
        let scene = scene(Excitation::Pulse(&pulse));
        let observe = Observe { accuracy: true, ..Observe::default() };
        let whole = respond(&scene, &observe).unwrap();
        let Outcome::Overturned { time_s, .. } = whole.outcome else {
            panic!("{whole:?}");
        };
        let due = 0.5 * libm::acosh(6.0);
        assert!(duration_s < 2.0 || (time_s - due).abs() < 1e-14, "{time_s}");
        assert_eq!(whole.assessment(), Assessment::Clear);
        let end = whole.certificate.unwrap().of(Decision::End);
        assert_eq!(end.ratio, f64::INFINITY);
        for near in [time_s.next_down(), time_s, time_s.next_up()] {
            let found = until(&scene, near);
            assert_eq!(found.assessment(), Assessment::Unresolved);
            let least = found.certificate.unwrap().least();
            assert_eq!(least.decision, Decision::End);
            assert_eq!(found.error_estimate, None);
            // Without being asked, too.
            let until_s = Some(near);
            let observe = Observe { until_s, ..Observe::default() };
            let quiet = respond(&scene, &observe).unwrap();
            assert_eq!(quiet.assessment(), Assessment::Unresolved);
            let ask = Certify { until_s, ..Certify::default() };
            let fate = certify(&scene, &ask).unwrap();
            assert!(fate.resolved && !fate.resolved_for_inputs, "{fate:?}");
            assert_eq!(fate.by, Arithmetic::DoubleDouble);
        }
        for (share, falls) in [(1.0 - 1e-9, false), (1.0 + 1e-9, true)] {
            let found = until(&scene, share * time_s);
            assert_eq!(found.assessment(), Assessment::Clear);
            assert_eq!(found.outcome.is_overturned(), falls);
            assert!(found.fate_margin > 1e-10 && found.fate_margin < 1e-7);
        }
    }
}

/// A rest within the observation is resolved, though the block lifts later.
#[test]
fn a_rest_before_the_end_of_observation_is_resolved() {
    let mut samples = vec![0.0; 200];
    for place in [5, 190] {
        samples[place] = 1.3 * ALPHA;
    }
    let record = Accelerogram::try_new("made", 0.1, samples).unwrap();
    let record = ScaledRecord::by_factor(&record, 1.0);
    let scene = scene(Excitation::Record(record));
    let at = |until_s: Option<f64>| {
        let observe = Observe { events: true, until_s, ..Observe::default() };
        respond(&scene, &observe).unwrap()
    };
    let rest_s = at(Some(10.0)).rest_time_s.unwrap();
    assert!(rest_s > 0.5 && rest_s < 10.0);
    assert_eq!(at(Some(18.0)).rest_time_s, Some(rest_s));
    assert_eq!(at(Some(0.99 * rest_s)).rest_time_s, None);
    assert!(at(None).rest_time_s.unwrap() > 19.0);
}

#[test]
fn certify_says_where_it_stands() {
    let pulse = rectangle(1.2 * ALPHA, 5.0);
    let scene = scene(Excitation::Pulse(&pulse));
    let until_s = Some(0.5 * libm::acosh(6.0));
    let (calls, last) = (Cell::new(0), Cell::new(-1.0));
    let progress = |by, time_s| {
        assert_eq!(by, Arithmetic::DoubleDouble);
        assert!(time_s >= last.get());
        calls.set(calls.get() + 1);
        last.set(time_s);
    };
    let ask = Certify { until_s, progress: &progress, ..Certify::default() };
    let fate = certify(&scene, &ask).unwrap();
    assert_eq!(fate.by, Arithmetic::DoubleDouble);
    assert!(
        calls.get() > 10 && last.get() > 1.0,
        "{} {}",
        calls.get(),
        last.get()
    );
}
