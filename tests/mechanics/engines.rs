//! One source in lanes, one by one, and in double-double.

use rocking::block::{Block, Restitution};
use rocking::excitation::{
    Excitation, NormalisedRecord, Pulse, PulseKind, ScaledRecord,
};
use rocking::ida::{Adjust, Analysis, Batch, Grid, curve, curves};
use rocking::integrator::{
    Arithmetic, Certify, Model, Observe, Outcome, Overturning, Scene, certify,
    respond, respond_precise,
};
use rocking::number::double::DoubleDouble;
use rocking::record::Accelerogram;

use super::compare::{near, same};

fn wave(seed: f64, dt_s: f64) -> Accelerogram {
    let sample = |k: u32| {
        let t = dt_s * f64::from(k);
        let low = libm::sin((3.0 + seed) * t + seed);
        let high = 0.7 * libm::sin((11.0 + 2.0 * seed) * t);
        (low + high) * libm::sin(0.8 * t)
    };
    let count = (3.0 / dt_s) as u32;
    Accelerogram::try_new("wave", dt_s, (0..count).map(sample).collect())
        .unwrap()
}

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

#[test]
fn lanes_have_the_bits_of_single_runs() {
    let records: Vec<NormalisedRecord> =
        [(0.0, 0.01), (1.0, 0.02), (2.0, 0.02), (3.0, 0.03)]
            .map(|(seed, dt_s)| NormalisedRecord::new(&wave(seed, dt_s)))
            .into();
    let mut panel = Vec::new();
    for (p, alpha) in [(3.0, 0.1), (1.5, 0.25), (3.0, 0.05)] {
        let restitution = Restitution::constant(0.92).unwrap();
        let paper =
            Analysis::paper(Block::try_new(alpha, p).unwrap(), restitution);
        let base = Analysis {
            grid: Grid::Im { step: 0.5 },
            highest_im: 4.0,
            ..paper
        };
        panel.push(base);
        panel.push(Analysis { overturning: Overturning::HalfPi, ..base });
        panel.push(Analysis { model: Model::Linearized, ..base });
    }
    let found = curves(&records, &panel, &Batch::default()).unwrap();
    for (a, (analysis, found)) in panel.iter().zip(&found).enumerate() {
        for (record, found) in records.iter().zip(found) {
            let alone = curve(record, analysis).unwrap();
            let what = format!("lanes, analysis {a}, {} s", record.dt_s());
            same(&what, &found.points, &alone.points);
            assert_eq!(*found, alone, "{what}");
        }
    }
}

/// The estimate of double precision bounds its distance from double-double.
#[test]
fn estimates_bound_the_distance_from_double_double() {
    let observe =
        Observe { events: true, accuracy: true, ..Observe::default() };
    let kind = PulseKind::OneSine { amplitude: 0.25, omega_rad_s: 14.0 };
    let pulse = Pulse::try_new(kind).unwrap();
    let samples = vec![0.0, 0.3, -0.1, -0.4, 0.2, 0.05, 0.0];
    let record = Accelerogram::try_new("short", 0.05, samples).unwrap();
    let record = ScaledRecord::by_factor(&record, 1.0);
    for excitation in [Excitation::Pulse(&pulse), Excitation::Record(record)] {
        for model in [Model::Nonlinear, Model::Linearized] {
            let scene = scene(model, excitation);
            let double = respond(&scene, &observe).unwrap();
            let precise =
                respond_precise::<DoubleDouble>(&scene, &observe).unwrap();
            let error = double.error_estimate.unwrap();
            let peak = precise.peak_ratio.hi();
            near(
                "peak ratio, by its estimate",
                double.peak_ratio,
                peak,
                error,
            );
            near("error estimate", error, 0.0, 1e-12);
            let error = precise.error_estimate.unwrap();
            near("error estimate in double-double", error, 0.0, 1e-26);
            let impacts = double.impacts.iter().zip(&precise.impacts);
            for (k, (a, b)) in impacts.take(8).enumerate() {
                let what = format!("{model:?}, time of impact {k}, s");
                near(what, a.time_s, b.time_s.hi(), 1e-12);
                let what = format!("{model:?}, speed before {k}, rad/s");
                let speed = b.speed_before_rad_s.hi();
                near(what, a.speed_before_rad_s, speed, 1e-12 * speed);
            }
            let (a, b) = (double.rest_time_s, precise.rest_time_s);
            assert_eq!(a.is_some(), b.is_some());
            let Some((a, b)) = a.zip(b) else { continue };
            near("rest, s", a, b.hi(), 1e-8);
            // Impacts are followed down to where the rest of them is a
            // geometric series to the last digit of each arithmetic.
            let unit = 3.0 * 0.1;
            let slow = double.impacts.last().unwrap().speed_before_rad_s;
            assert!(slow < 2e-10 * unit && slow > 1e-12 * unit, "{slow:e}");
            let slow = precise.impacts.last().unwrap().speed_before_rad_s;
            let slow = slow.hi();
            assert!(slow < 2e-26 * unit && slow > 1e-28 * unit, "{slow:e}");
        }
    }
}

/// The two doubles around the critical amplitude of `trajectories.json`.
#[test]
fn neighbours_of_a_critical_amplitude_are_resolved() {
    let first = 4.072_395_807_424_461_f64;
    for (amplitude, overturns, by) in [
        (first.next_down(), false, Arithmetic::DoubleDouble),
        (first, true, Arithmetic::DoubleDouble),
        (3.0, false, Arithmetic::Double),
        (5.0, true, Arithmetic::Double),
    ] {
        let kind = PulseKind::HalfSine { amplitude, omega_rad_s: 5.0 };
        let pulse = Pulse::try_new_si(kind, 9.81).unwrap();
        let near = Scene {
            block: Block::try_new(0.2, 2.0).unwrap(),
            ..scene(Model::Nonlinear, Excitation::Pulse(&pulse))
        };
        let fate = certify(&near, &Certify::default()).unwrap();
        assert!(fate.resolved && fate.by == by, "{fate:?}");
        assert_eq!(fate.outcome.is_overturned(), overturns);
        let quick = respond(&near, &Observe::default()).unwrap();
        assert_eq!(fate.double, quick.outcome);
        let other = fate.double.is_overturned() != overturns;
        assert_eq!(fate.wrong_in_double(), other);
        assert!(fate.least.is_clear());
        if let Outcome::Rocked { peak_ratio } = fate.outcome {
            assert!(peak_ratio > 0.0 && peak_ratio < 1.0);
        }
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
