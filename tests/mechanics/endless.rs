//! The work of every run is bounded: long pulses take no more than short
//! ones, and what never ends is refused.

use std::f64::consts::TAU;

use rocking::accelerogram::Accelerogram;
use rocking::block::{Block, Restitution};
use rocking::excitation::{
    Excitation, NormalisedRecord, Pulse, PulseKind, PulseName,
    PulseParameter as P, ScaledRecord,
};
use rocking::ida::{Analysis, Batch, Grid, IdaError, curve, curves};
use rocking::integrator::{
    Model, Observe, Outcome, Overturning, Scene, SceneError, WorkLimit,
    respond, respond_precise, uplift_threshold,
};
use rocking::number::double::DoubleDouble;

use super::compare::near;

const MODELS: [Model; 2] = [Model::Nonlinear, Model::Linearized];

fn scene<'a>(model: Model, eta: f64, excitation: Excitation<'a>) -> Scene<'a> {
    Scene {
        block: Block::try_new(0.2, 2.0).unwrap(),
        restitution: Restitution::constant(eta).unwrap(),
        model,
        overturning: Overturning::Alpha,
        excitation,
        initial_ratio: 0.0,
    }
}

/// Pulses that last about `duration_s`, of peaks of at most an amplitude, and
/// of most of it.
fn long(duration_s: f64, amplitude: f64) -> Vec<PulseKind> {
    // Long in one period, and in many.
    let both = [(duration_s / 4.0, 4.0), (1.0, duration_s)];
    let mut kinds = Vec::new();
    for (name, (period_s, cycles)) in
        PulseName::ALL.into_iter().flat_map(|name| both.map(|x| (name, x)))
    {
        let kind = name.kind(|parameter| {
            Ok::<_, ()>(match parameter {
                P::Amplitude => amplitude,
                P::Omega => 1.0 / duration_s,
                P::Duration => duration_s,
                P::Period => period_s,
                P::Cycles | P::Gamma => cycles,
                P::Velocity => {
                    amplitude * period_s / (TAU * (1.0 + 1.0 / cycles))
                }
                P::Frequency => 1.0 / period_s,
                P::Phase => 0.3,
            })
        });
        kinds.push(kind.unwrap());
    }
    kinds.dedup();
    kinds
}

/// Under a push that hardly changes the block overturns where it exceeds the
/// threshold, and does not move where it does not; neither takes long.
#[test]
fn long_pulses_take_no_longer_than_short_ones() {
    for duration_s in [1e6, 1e9] {
        for model in MODELS {
            let block = Block::try_new(0.2, 2.0).unwrap();
            let threshold = uplift_threshold(&block, model);
            for share in [0.5, 0.99, 1.0, 1.01, 2.0] {
                for kind in long(duration_s, share * threshold) {
                    endures(kind, model, share);
                }
            }
        }
    }
}

/// A pulse whose peak is at most a share of the uplift threshold.
fn endures(kind: PulseKind, model: Model, share: f64) {
    let scene_said = format!("{kind:?} {model:?} {share}");
    let pulse = Pulse::try_new(kind).unwrap();
    let of = scene(model, 0.92, Excitation::Pulse(&pulse));
    let few = WorkLimit { impacts: 20_000, steps: 20_000 };
    let observe = Observe { work_limit: few, ..Observe::default() };
    let cycles = match kind {
        PulseKind::MavroeidisPapageorgiou { gamma, .. } => gamma,
        _ => 1.0,
    };
    let found = respond(&of, &observe);
    if share >= 1.0 && cycles > 1e5 && found.is_err() {
        // It rocks through millions of cycles.
        return refused(found, "steps");
    }
    let found = found.unwrap_or_else(|error| panic!("{scene_said}: {error}"));
    let work = found.work;
    assert!(work.rest_scans < 1_000_000, "{scene_said} {work:?}");
    if share < 1.0 {
        assert_eq!(found.outcome, Outcome::NoUplift, "{scene_said}");
    } else if share > 1.5 {
        assert!(found.uplift_time_s.is_some(), "{scene_said}");
        let brief = scene_said.contains("period_s: 1.0,");
        assert!(brief || found.outcome.is_overturned(), "{scene_said}");
    }
}

/// The first exceedance lies where the formula says.
#[test]
fn a_long_pulse_lifts_the_block_when_it_passes_the_threshold() {
    for omega_rad_s in [1e-3, 1e-6, 1e-9] {
        let kind = PulseKind::OneSine { amplitude: 0.3, omega_rad_s };
        let pulse = Pulse::try_new(kind).unwrap();
        let of = scene(Model::Linearized, 0.92, Excitation::Pulse(&pulse));
        let found = respond(&of, &Observe::default()).unwrap();
        // 0.3 sin(omega t) = 0.2.
        let expected = libm::asin(2.0 / 3.0) / omega_rad_s;
        let time_s = found.uplift_time_s.unwrap();
        near("uplift, s", time_s, expected, 1e-13 * expected);
        assert!(found.outcome.is_overturned());
    }
}

#[test]
fn a_pulse_of_which_no_clock_tells_the_steps_is_refused() {
    let kind = PulseKind::Rectangle { amplitude: 0.1, duration_s: 1e16 };
    let pulse = Pulse::try_new(kind).unwrap();
    let of = scene(Model::Nonlinear, 0.92, Excitation::Pulse(&pulse));
    let found = respond(&of, &Observe::default());
    assert!(matches!(found, Err(SceneError::Pieces { .. })), "{found:?}");
}

/// A push that lifts the block, and silence.
fn push(count: usize) -> Accelerogram {
    let mut samples = vec![0.0; count];
    samples[1] = 1.0;
    Accelerogram::try_new("push", 0.01, samples).unwrap()
}

fn refused(found: Result<impl std::fmt::Debug, SceneError>, which: &str) {
    let Err(SceneError::Work { what, .. }) = found else {
        panic!("expected too many {which}, found {found:?}");
    };
    assert_eq!(what, which);
}

#[test]
fn a_block_that_never_rests_is_refused_within_a_record_and_after() {
    let record = NormalisedRecord::new(&push(2000));
    for model in MODELS {
        let block = Block::try_new(0.2, 2.0).unwrap();
        let pga = uplift_threshold(&block, model) * 1.000_001;
        let within = Excitation::Record(ScaledRecord::to_pga(&record, pga));
        let few = WorkLimit { impacts: 1000, ..WorkLimit::default() };
        let plain = Observe { work_limit: few, ..Observe::default() };
        let logged = Observe { events: true, ..plain };
        for observe in [plain, logged] {
            refused(respond(&scene(model, 1.0, within), &observe), "impacts");
        }
        refused(
            respond_precise::<DoubleDouble>(
                &scene(model, 1.0, within),
                &plain,
            ),
            "impacts",
        );
        for eta in [1.0 - 1e-6, 1.0 - 1e-9, 1.0_f64.next_down()] {
            let free = Scene {
                initial_ratio: 0.5,
                ..scene(model, eta, Excitation::Free)
            };
            let quiet = respond(&free, &Observe::default()).unwrap();
            assert_eq!(quiet.peak_ratio, 0.5);
            refused(respond(&free, &logged), "impacts");
            let history_interval_s = Some(0.01);
            let traced = Observe { history_interval_s, ..plain };
            refused(respond(&free, &traced), "impacts");
        }
    }
}

#[test]
fn steps_and_points_of_a_history_are_bounded() {
    let few = WorkLimit { steps: 500, ..WorkLimit::default() };
    let observe = Observe { work_limit: few, ..Observe::default() };
    let record = NormalisedRecord::new(&push(2000));
    let under = Excitation::Record(ScaledRecord::to_pga(&record, 0.5));
    let of = scene(Model::Nonlinear, 0.9999, under);
    refused(respond(&of, &observe), "steps");
    let kind = PulseKind::Rectangle { amplitude: 0.1, duration_s: 1e9 };
    let pulse = Pulse::try_new(kind).unwrap();
    let of = scene(Model::Nonlinear, 0.92, Excitation::Pulse(&pulse));
    let history_interval_s = Some(0.005);
    let observe = Observe { history_interval_s, ..observe };
    refused(respond(&of, &observe), "history points");
}

/// A run is refused or not wherever it is made, at the same limit.
#[test]
fn a_level_that_is_refused_is_named_and_the_same_in_lanes() {
    let accelerogram = push(2000);
    let record = NormalisedRecord::new(&accelerogram);
    for model in MODELS {
        let block = Block::try_new(0.2, 2.0).unwrap();
        let eta = Restitution::constant(1.0).unwrap();
        let analysis = Analysis {
            model,
            grid: Grid::Im { step: 1e-6 },
            highest_im: 1.000_001_5,
            work_limit: WorkLimit { impacts: 2000, steps: 1 << 40 },
            ..Analysis::paper(block, eta)
        };
        let alone = curve(&record, &analysis);
        let Err(IdaError::Work { record: name, im, source }) = &alone else {
            panic!("{alone:?}");
        };
        assert_eq!((name.as_str(), *im), ("push", 1.000_001));
        let text = format!("{source}");
        assert!(text.starts_with("more than 2000 impacts by "), "{text}");
        let many = vec![record.clone(); 20];
        let together = curves(&many, &[analysis], &Batch::default());
        assert_eq!(together.unwrap_err(), alone.unwrap_err());
    }
}

/// The limit itself is not beyond the limit.
#[test]
fn a_run_at_its_limit_is_not_refused() {
    let accelerogram = push(200);
    let record = NormalisedRecord::new(&accelerogram);
    for model in MODELS {
        let under = Excitation::Record(ScaledRecord::to_pga(&record, 0.5));
        let of = scene(model, 0.92, under);
        let work = respond(&of, &Observe::default()).unwrap().work;
        let within = |impacts, steps| {
            let work_limit = WorkLimit { impacts, steps };
            let observe = Observe { work_limit, ..Observe::default() };
            respond(&of, &observe)
        };
        assert!(work.impacts > 1 && work.steps > 1);
        assert!(within(work.impacts, work.steps).is_ok());
        refused(within(work.impacts - 1, work.steps), "impacts");
        refused(within(work.impacts, work.steps - 1), "steps");
    }
}

/// Accelerations beyond what double precision holds end in a refusal, not in
/// a peak that is no number.
#[test]
fn what_is_not_a_number_is_refused() {
    let kind = PulseKind::OneSine { amplitude: 1e300, omega_rad_s: 12.0 };
    let pulse = Pulse::try_new(kind).unwrap();
    let scene = scene(Model::Nonlinear, 0.9, Excitation::Pulse(&pulse));
    let found = respond(&scene, &Observe::default());
    assert!(matches!(found, Err(SceneError::NotANumber { .. })), "{found:?}");
}
