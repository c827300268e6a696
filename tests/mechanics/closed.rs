//! Closed forms written out here, and refusals.

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, BlockError, Restitution};
use rocking::excitation::{Excitation, Pulse, PulseKind, ScaledRecord};
use rocking::integrator::{
    Assessment, Model, Observe, Outcome, Overturning, Scene, SceneError, Side,
    respond, uplift_threshold,
};

use super::compare::near;

fn scene<'a>(model: Model, excitation: Excitation<'a>) -> Scene<'a> {
    Scene {
        block: Block::try_new(0.2, 2.0).unwrap(),
        restitution: Restitution::constant(0.92).unwrap(),
        model,
        overturning: Overturning::HalfPi,
        excitation,
        initial_ratio: 0.0,
    }
}

#[test]
fn blocks_are_what_their_lengths_say() {
    for (p, alpha) in [(1.0, 0.25), (3.0, 0.20), (4.0, 0.05)] {
        let block = Block::try_new(alpha, p).unwrap();
        let size = block.dimensions(9.81).unwrap();
        let back = Block::from_dimensions(size.width_m, size.height_m, 9.81);
        let back = back.unwrap();
        near("alpha by size, rad", back.slenderness_rad(), alpha, 1e-15);
        near("p by size, rad/s", back.frequency_rad_s(), p, 1e-14);
        assert_eq!(uplift_threshold(&block, Model::Linearized), alpha);
        let tangent = size.width_m / size.height_m;
        let found = uplift_threshold(&block, Model::Nonlinear);
        near("threshold, g, by b/h", found, tangent, 1e-15);
    }
    let half = Restitution::from_energy_ratio(0.25).unwrap();
    assert_eq!(half.velocity_ratio(), 0.5);
    assert_eq!(
        Restitution::from_energy_ratio(1.0).unwrap().energy_ratio(),
        1.0
    );
    assert_eq!(Restitution::constant(1.0).unwrap().velocity_ratio(), 1.0);
}

#[test]
fn what_is_no_block_is_refused() {
    let (nan, infinity) = (f64::NAN, f64::INFINITY);
    let right = std::f64::consts::FRAC_PI_2;
    for alpha in [0.0, -0.1, right, 2.0, nan] {
        let found = Block::try_new(alpha, 1.0);
        assert!(matches!(found, Err(BlockError::Slenderness(_))));
    }
    for p in [0.0, -1.0, infinity, nan] {
        let found = Block::try_new(0.1, p);
        assert!(matches!(found, Err(BlockError::Frequency(_))));
        let found = Block::from_dimensions(p, 1.0, 9.81);
        assert!(matches!(found, Err(BlockError::Dimensions { .. })));
        let found = Block::from_dimensions(1.0, p, 9.81);
        assert!(matches!(found, Err(BlockError::Dimensions { .. })));
        let found = Block::from_dimensions(1.0, 2.0, p);
        assert!(matches!(found, Err(BlockError::Gravity(_))));
        let found = Block::try_new(0.1, 1.0).unwrap().dimensions(p);
        assert!(matches!(found, Err(BlockError::Gravity(_))));
    }
    for ratio in [0.0, -0.5, 1.0_f64.next_up(), nan] {
        assert!(Restitution::constant(ratio).is_err());
        assert!(Restitution::from_energy_ratio(ratio).is_err());
    }
    assert!(
        Restitution::housner(&Block::try_new(0.96, 1.0).unwrap()).is_err()
    );
    assert!(Restitution::housner(&Block::try_new(0.95, 1.0).unwrap()).is_ok());
}

#[test]
fn what_is_no_scene_is_refused() {
    let plain = scene(Model::Nonlinear, Excitation::Free);
    let quiet = Observe::default();
    for initial_ratio in [-0.1, 1.0, f64::NAN] {
        let found = respond(&Scene { initial_ratio, ..plain }, &quiet);
        assert!(matches!(found, Err(SceneError::InitialRatio(_))));
    }
    for time in [0.0, -1.0, f64::INFINITY, f64::NAN] {
        let history_interval_s = Some(time);
        let found = respond(&plain, &Observe { history_interval_s, ..quiet });
        assert!(matches!(found, Err(SceneError::Time { .. })));
        let until_s = Some(time);
        let found = respond(&plain, &Observe { until_s, ..quiet });
        assert!(matches!(found, Err(SceneError::Time { .. })));
    }
    let record = Accelerogram::try_new("two", 0.1, vec![0.0, 1.0]).unwrap();
    let record = ScaledRecord::by_factor(&record, f64::INFINITY);
    let found =
        respond(&scene(Model::Nonlinear, Excitation::Record(record)), &quiet);
    assert!(matches!(found, Err(SceneError::Amplitude(_))));
    let rest = respond(&plain, &quiet).unwrap();
    assert_eq!(rest.outcome, Outcome::NoUplift);
    assert_eq!(rest.outcome.edp(), 0.0);
    assert_eq!(rest.rest_time_s, None);
    assert_eq!((Side::Positive.sign(), Side::Negative.sign()), (1.0, -1.0));
}

/// Without a look at its decisions nothing is said of a run.
#[test]
fn a_run_that_nobody_assessed_is_not_called_clear() {
    let plain = scene(Model::Nonlinear, Excitation::Free);
    let free = Scene { initial_ratio: 0.5, ..plain };
    let quiet = respond(&free, &Observe::default()).unwrap();
    assert_eq!(quiet.assessment(), Assessment::NotAssessed);
    let observe = Observe { accuracy: true, ..Observe::default() };
    let found = respond(&free, &observe).unwrap();
    assert_eq!(found.assessment(), Assessment::Clear);
    let least = found.certificate.unwrap().least();
    assert!(least.ratio > 1e10 && least.ratio.is_finite(), "{least:?}");
}

#[test]
fn a_history_ends_with_rest_and_shows_it() {
    for model in [Model::Nonlinear, Model::Linearized] {
        let free =
            Scene { initial_ratio: 0.3, ..scene(model, Excitation::Free) };
        let long = Observe {
            events: true,
            history_interval_s: Some(0.5),
            until_s: Some(20.0),
            ..Observe::default()
        };
        let response = respond(&free, &long).unwrap();
        let rest = response.rest_time_s.unwrap();
        assert_eq!(response.history.len(), 41);
        for (k, point) in response.history.iter().enumerate() {
            assert_eq!(point.time_s, 0.5 * k as f64);
            let at_rest = point.time_s > rest;
            assert_eq!(point.rotation_rad == 0.0, at_rest, "{point:?} {rest}");
        }
        let open = Observe { until_s: None, ..long };
        let open = respond(&free, &open).unwrap();
        assert_eq!(open.history.len(), (rest / 0.5) as usize + 1);
        // Observation that ends in flight, before the first impact.
        let first = response.impacts[0].time_s;
        let until_s = Some(0.5 * first);
        let short = respond(&free, &Observe { until_s, ..long }).unwrap();
        assert!(short.impacts.is_empty() && short.rest_time_s.is_none());
        let after = Some(1.01 * first);
        let short =
            respond(&free, &Observe { until_s: after, ..long }).unwrap();
        assert_eq!(short.impacts.len(), 1);
    }
}

/// Zeros of a history before the uplift and after the motion; a rise that
/// observation cuts is the peak.
#[test]
fn observation_cuts_a_rise() {
    let kind = PulseKind::Rectangle { amplitude: 0.5, duration_s: 0.1 };
    let pulse = Pulse::try_new(kind).unwrap();
    let cut = scene(Model::Linearized, Excitation::Pulse(&pulse));
    let observe = Observe { until_s: Some(0.05), ..Observe::default() };
    let response = respond(&cut, &observe).unwrap();
    // u = (A - alpha) (cosh(p t) - 1), over alpha.
    let expected = 1.5 * (libm::cosh(0.1) - 1.0);
    near("peak ratio", response.peak_ratio, expected, 1e-15);
    assert_eq!(response.peak_time_s, Some(0.05));
    assert_eq!(response.uplift_time_s, Some(0.0));
    assert_eq!(
        response.outcome,
        Outcome::Rocked { peak_ratio: response.peak_ratio }
    );
    assert_eq!(response.outcome.edp(), response.peak_ratio);
    assert!(!response.outcome.is_overturned());
}

/// The condition number against what eta and the state do to the peak.
#[test]
fn a_condition_number_is_the_derivative_by_eta() {
    let kind = PulseKind::OneSine { amplitude: 0.3, omega_rad_s: 8.0 };
    let pulse = Pulse::try_new(kind).unwrap();
    for model in [Model::Nonlinear, Model::Linearized] {
        let base = scene(model, Excitation::Pulse(&pulse));
        let peak = |eta: f64| {
            let restitution = Restitution::constant(eta).unwrap();
            let observe = Observe { accuracy: true, ..Observe::default() };
            respond(&Scene { restitution, ..base }, &observe).unwrap()
        };
        let middle = peak(0.92);
        let step = 1e-5;
        let slope = (peak(0.92 + step).peak_ratio
            - peak(0.92 - step).peak_ratio)
            / (2.0 * step);
        let relative = (slope * 0.92 / middle.peak_ratio).abs();
        let found = middle.condition_number.unwrap();
        assert!(
            relative > 0.01
                && found >= 0.98 * relative
                && found < 100.0 * relative,
            "{model:?}, condition number: got {found}, expected 0.98 to 100 \
             times the derivative by eta, {relative}, which is above 0.01"
        );
    }
}

/// Whoever asks for forces gets the same motion, and a block that does not
/// lift needs the friction PGA/g alone.
#[test]
fn forces_are_observed_without_a_change_of_the_motion() {
    let sample = |k: u32| 0.35 * libm::sin(0.09 * f64::from(k));
    let samples = (0..400).map(sample).collect();
    let record = Accelerogram::try_new("sines", 0.01, samples).unwrap();
    let of = |factor: f64, forces: bool| {
        let record = ScaledRecord::by_factor(&record, factor);
        let scene = scene(Model::Nonlinear, Excitation::Record(record));
        let observe = Observe {
            events: true,
            accuracy: true,
            forces,
            ..Observe::default()
        };
        respond(&scene, &observe).unwrap()
    };
    let mut seen = of(1.0, true);
    let forces = seen.forces.take().unwrap();
    assert_eq!(seen, of(1.0, false));
    assert!(seen.work.impacts > 0 && forces.friction > libm::tan(0.2));
    let least = forces.least_normal_over_weight;
    assert!(least < 1.0 && least > 0.0, "{forces:?}");
    let rest = of(0.5, true).forces.unwrap();
    assert_eq!((rest.friction_time_s, rest.least_normal_time_s), (None, None));
    assert_eq!(rest.least_normal_over_weight, 1.0);
    near("friction at rest", rest.friction, 0.5 * record.pga_g(), 1e-16);
}
