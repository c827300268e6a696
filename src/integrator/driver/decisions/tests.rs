use crate::block::{Block, Restitution};
use crate::excitation::{Pulse, PulseKind};
use crate::integrator::Side;
use crate::integrator::driver::{Driver, Stage, Step};
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::forcing::{Moment, PulseForcing};
use crate::integrator::motion::BlockMotion;
use crate::integrator::screen::{DOUBTFUL, PROPAGATION, Screen};
use crate::number::dispatch::Isa;

const ALPHA: f64 = 0.25;

/// Rough estimate after a step in which Eq. 2 under a constant push sinks at
/// 0.01 and turns at `lowest`, with a standard deviation of the rotation.
fn estimate(lowest: f64, deviation: f64) -> f64 {
    let block = Block::try_new(ALPHA, 1.0).unwrap();
    let dynamics = Dynamics::new(
        &block,
        Restitution::constant(0.9).unwrap(),
        Model::Linearized,
        Overturning::Alpha,
    );
    let kind = PulseKind::Rectangle { amplitude: -1.0, duration_s: 1.0 };
    let forcing =
        PulseForcing::new(&Pulse::try_new(kind).unwrap(), 1.0, Isa::best());
    let mut driver: Driver<f64, PulseForcing<f64>, 2, 12> =
        Driver::new(dynamics, forcing, Isa::best());
    let uu = deviation * deviation;
    *driver.screen() = Screen { uu, ..Screen::at_rest() };
    // (u + b)^2 - w^2 is constant, and w = 0 where it turns.
    let (b, w) = (1.0 - ALPHA, -0.01_f64);
    let u = (w * w + (lowest + b) * (lowest + b)).sqrt() - b;
    let step = Step {
        place: Moment { piece: 0, offset: 0.0 },
        index: 0,
        motion: BlockMotion { side: Side::Positive, u, w },
        at_threshold: false,
    };
    let Stage::Flying(after) = driver.proceed::<12>(step) else {
        panic!("the block stays in flight");
    };
    assert!(after.motion.w > 0.0 && after.motion.u > lowest);
    driver.screen().doubt.sqrt()
}

/// The propagation tolerates an error of 1e-4 of its own margin: a base that
/// is missed by hardly more than that error is doubtful at every height.
#[test]
fn a_base_that_is_nearly_met_is_held_against_the_error() {
    for share in [1e-9, 1e-6, 1.1e-6, 1e-5, 1e-3] {
        let lowest = share * ALPHA;
        let found = estimate(lowest, 0.01 * lowest);
        assert!((found / 0.01 - 1.0).abs() < 0.02, "{share}: {found}");
        assert!(found > DOUBTFUL);
        let found = estimate(lowest, 1e-6 * lowest);
        assert!(found < DOUBTFUL, "{share}: {found}");
    }
}

#[test]
fn a_base_missed_by_far_decides_nothing() {
    let lowest = 1.01 * PROPAGATION * ALPHA;
    assert_eq!(estimate(lowest, 0.01 * lowest), 0.0);
}
