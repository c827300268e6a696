use super::respond_precise;
use crate::accelerogram::Accelerogram;
use crate::block::{Block, Restitution};
use crate::excitation::{
    Excitation, NormalisedRecord, Pulse, PulseKind, ScaledRecord,
};
use crate::integrator::{Model, Observe, Overturning, Scene};
use crate::number::double::DoubleDouble;
use crate::number::octuple::Octuple;
use crate::number::{Number, Real};

fn scene(model: Model, excitation: Excitation<'_>, ratio: f64) -> Scene<'_> {
    Scene {
        block: Block::try_new(0.2, 2.0).unwrap(),
        restitution: Restitution::constant(0.92).unwrap(),
        model,
        overturning: Overturning::HalfPi,
        excitation,
        initial_ratio: ratio,
    }
}

/// A number in double-double less one in octuple precision, as a share of it.
fn gap(found: DoubleDouble, exact: Octuple) -> f64 {
    let found = Octuple::from_f64(found.hi()) + Octuple::from_f64(found.lo());
    ((found - exact) / exact).abs().to_f64()
}

fn agree(scene: &Scene<'_>) {
    let observe = Observe { accuracy: true, ..Observe::default() };
    let wide = respond_precise::<Octuple>(scene, &observe).unwrap();
    let found = respond_precise::<DoubleDouble>(scene, &observe).unwrap();
    assert_eq!(wide.outcome.is_overturned(), found.outcome.is_overturned());
    assert_eq!(wide.work.impacts, found.work.impacts);
    let error = gap(found.peak_ratio, wide.peak_ratio);
    assert!(error < 1e-29, "{scene:?}: {error:e}");
    // The estimates of both say so.
    let estimate = |error: Option<f64>| error.unwrap();
    assert!(estimate(wide.error_estimate) < 1e-70, "{scene:?}");
    assert!(estimate(found.error_estimate) < 1e-27, "{scene:?}");
}

#[test]
fn a_pulse_gives_in_double_double_what_it_gives_in_octuple_precision() {
    for kind in [
        PulseKind::OneSine { amplitude: 3.5, omega_rad_s: 8.0 },
        PulseKind::HalfSine { amplitude: 3.9, omega_rad_s: 5.0 },
    ] {
        let pulse = Pulse::try_new_si(kind, 9.81).unwrap();
        for model in [Model::Nonlinear, Model::Linearized] {
            agree(&scene(model, Excitation::Pulse(&pulse), 0.0));
        }
    }
}

#[test]
fn a_record_gives_in_double_double_what_it_gives_in_octuple_precision() {
    // Steps of 0.01, 0.03 (in parts) and 0.2 of 1/p: short and long series.
    for (dt_s, count) in [(0.005, 400), (0.015, 200), (0.1, 40)] {
        let sample = |k: i32| {
            let t = dt_s * f64::from(k);
            libm::sin(4.0 * t) + 0.6 * libm::sin(11.0 * t + 1.0)
        };
        let samples = (0..count).map(sample).collect();
        let record = Accelerogram::try_new("wave", dt_s, samples).unwrap();
        let record = NormalisedRecord::new(&record);
        let scaled = ScaledRecord::to_pga(&record, 0.45);
        for model in [Model::Nonlinear, Model::Linearized] {
            agree(&scene(model, Excitation::Record(scaled), 0.0));
        }
    }
}

#[test]
fn free_rocking_comes_to_rest_when_it_does_in_octuple_precision() {
    let observe = Observe { events: true, ..Observe::default() };
    for model in [Model::Nonlinear, Model::Linearized] {
        let scene = scene(model, Excitation::Free, 0.6);
        let wide = respond_precise::<Octuple>(&scene, &observe).unwrap();
        let found = respond_precise(&scene, &observe).unwrap();
        let (exact, rest) = (wide.rest_time_s, found.rest_time_s);
        assert!(gap(rest.unwrap(), exact.unwrap()) < 1e-29);
        for (hop, exact) in found.impacts.iter().zip(&wide.impacts) {
            assert!(gap(hop.time_s, exact.time_s) < 1e-29);
        }
    }
}
