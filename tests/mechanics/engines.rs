//! Fates that double precision misses, doubtful runs, where a curve begins.

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{
    Excitation, NormalisedRecord, Pulse, PulseKind, ScaledRecord,
};
use rocking::ida::{Adjust, Analysis, curve};
use rocking::integrator::{
    Arithmetic, Certify, Model, Observe, Overturning, Scene, certify, respond,
};

fn scene<'a>(model: Model, excitation: Excitation<'a>) -> Scene<'a> {
    Scene {
        block: Block::try_new(0.1, 3.0).unwrap(),
        restitution: Restitution::constant(0.92).unwrap(),
        model,
        overturning: Overturning::HalfPi,
        excitation,
        initial_ratio: 0.0,
    }
}

/// Next to a critical amplitude of a one-sine pulse double precision misses
/// the fates of two amplitudes, and of none on either side of them; what it
/// says is kept beside what is so.
#[test]
fn a_fate_that_double_precision_misses_is_resolved_and_said_so() {
    for (amplitude, overturns, missed) in [
        (9.922_004_265_836_232, false, false),
        (9.922_004_265_836_234, true, true),
        (9.922_004_265_836_236, true, true),
        (9.922_004_265_836_238, true, false),
    ] {
        let kind = PulseKind::OneSine { amplitude, omega_rad_s: 12.5 };
        let pulse = Pulse::try_new_si(kind, 9.81).unwrap();
        let near = Scene {
            block: Block::try_new(0.2, 2.0).unwrap(),
            ..scene(Model::Nonlinear, Excitation::Pulse(&pulse))
        };
        let fate = certify(&near, &Certify::default()).unwrap();
        assert!(fate.resolved && fate.by == Arithmetic::DoubleDouble);
        assert_eq!(fate.outcome.is_overturned(), overturns);
        let quick = respond(&near, &Observe::default()).unwrap();
        assert_eq!(fate.double, quick.outcome);
        assert_eq!(fate.double.is_overturned(), overturns != missed);
        assert_eq!(fate.wrong_in_double(), missed);
    }
}

/// Where the slenderness is adjusted, the onset is that of a block whose
/// uplift threshold is the record's own PGA, by the rule of the equation.
#[test]
fn the_onset_of_a_curve_follows_the_rule_of_its_equation() {
    let samples = (0..200).map(|k| 0.3 * libm::sin(0.1 * f64::from(k)));
    let record = Accelerogram::try_new("sine", 0.01, samples.collect());
    let record = NormalisedRecord::new(&record.unwrap());
    let own = record.pga_g();
    for (model, slenderness_rad) in
        [(Model::Nonlinear, libm::atan(own)), (Model::Linearized, own)]
    {
        let block = Block::try_new(0.2, 3.0).unwrap();
        let restitution = Restitution::constant(0.92).unwrap();
        let analysis = Analysis {
            model,
            adjust: Adjust::SlendernessAdjustment,
            ..Analysis::paper(block, restitution)
        };
        let onset = curve(&record, &analysis).unwrap().onset;
        assert_eq!((onset.im, onset.edp()), (1.0, 0.0));
        assert_eq!(onset.slenderness_rad, slenderness_rad, "{model:?}");
        assert_eq!(onset.pga_g, own);
    }
}

/// A run that nobody asked to be assessed ends at the impact that makes it
/// doubtful, and gives what an assessed run gives.
#[test]
fn a_doubtful_run_is_the_assessed_one() {
    let wave = |rate: f64, k: u32| libm::sin(rate * f64::from(k));
    let samples = (0..6000).map(|k| {
        wave(0.021, k) + wave(0.047, k) + wave(0.11, k) + wave(0.173, k)
    });
    let record = Accelerogram::try_new("waves", 0.01, samples.collect());
    let record = NormalisedRecord::new(&record.unwrap());
    let block = Block::try_new(0.15, 4.0).unwrap();
    let eta = Restitution::constant(0.92).unwrap();
    let mut doubtful = 0;
    for level in 16..56 {
        let pga_g = 0.01 * f64::from(level);
        let ground = ScaledRecord::to_pga(&record, pga_g);
        let scene = Scene::new(block, eta, Excitation::Record(ground));
        let events = Observe { events: true, ..Observe::default() };
        let found = respond(&scene, &events).unwrap();
        let assessed = Observe { accuracy: true, ..events };
        let assessed = respond(&scene, &assessed).unwrap();
        if found.certificate.is_some() {
            doubtful += 1;
            assert!(found.doubt.is_some_and(|doubt| !(doubt < 2.5e-3)));
            let mut same = assessed;
            same.doubt = found.doubt;
            assert_eq!(found, same, "{pga_g}");
        } else {
            assert!(found.doubt.is_some_and(|doubt| doubt < 2.5e-3));
            assert_eq!(found.outcome, assessed.outcome);
            assert_eq!(found.work, assessed.work);
        }
    }
    assert!((1..40).contains(&doubtful), "{doubtful}");
}
