use super::{Event, is_clear_of_base};
use crate::block::{Block, Restitution};
use crate::integrator::driver::Driver;
use crate::integrator::dynamics::{Dynamics, Model, Overturning};
use crate::integrator::forcing::{Moment, Shaking};
use crate::integrator::taylor::TaylorSeries;
use crate::number::dispatch::Isa;

/// A block that overturns at 0.5.
fn driver() -> Driver<f64, Shaking<f64>, 1, 4> {
    let block = Block::try_new(0.5, 1.0).unwrap();
    let restitution = Restitution::constant(0.9).unwrap();
    let dynamics = Dynamics::new(
        &block,
        restitution,
        Model::Linearized,
        Overturning::Alpha,
    );
    Driver::new(dynamics, Shaking::nothing(), Isa::best())
}

/// First event in a step, and after which part of it.
fn event(c: [f64; 4]) -> (&'static str, f64) {
    match driver().first_event(&c) {
        Event::None => ("none", 0.0),
        Event::Impact(x) => ("impact", x),
        Event::Overturning(x) => ("overturning", x),
    }
}

#[test]
fn a_step_that_ends_on_the_base_or_at_the_limit_ends_there() {
    // Straight lines: the bounds of the screens are what they bound.
    assert_eq!(event([0.375, -0.375, 0.0, 0.0]), ("impact", 1.0));
    assert_eq!(event([0.25, -0.125, 0.0, 0.0]), ("none", 0.0));
    assert_eq!(event([0.25, -0.5, 0.0, 0.0]), ("impact", 0.5));
    assert_eq!(event([0.125, 0.375, 0.0, 0.0]), ("overturning", 1.0));
    assert_eq!(event([0.25, 0.5, 0.0, 0.0]), ("overturning", 0.5));
    // From the base: up, up and back again, down.
    assert_eq!(event([0.0, 0.25, 0.0, 0.0]), ("none", 0.0));
    assert_eq!(event([0.0, 0.25, -0.25, 0.0]), ("impact", 1.0));
    assert_eq!(event([0.0, 0.25, -0.5, 0.0]), ("impact", 0.5));
    assert_eq!(event([0.0, -0.25, 0.0, 0.0]), ("impact", 0.0));
    // Over the limit and back within the step.
    assert_eq!(event([0.0, 3.0, -4.0, 0.0]), ("overturning", 0.25));
    assert_eq!(event([0.25, 1.25, -1.25, 0.0]).0, "overturning");
    assert_eq!(event([0.25, 0.5, -0.5, 0.0]), ("none", 0.0));
}

#[test]
fn the_screen_of_the_base_tells_what_is_sure_and_no_more() {
    // 0.5 - 0.2 x -+ 0.25 x^2 on [0, 1], and with more or less of each.
    let screen = is_clear_of_base::<f64>;
    assert!(screen([0.5, -0.2], -0.2, 0.25));
    assert!(!screen([0.45, -0.2], -0.2, 0.25));
    assert!(!screen([0.4, -0.2], -0.2, 0.25));
    // From the base a rise must outweigh the rest.
    assert!(screen([0.0, 0.3], 0.0, 0.25));
    assert!(!screen([0.0, 0.25], 0.0, 0.25));
    assert!(!screen([0.0, 0.2], 0.0, 0.25));
    assert!(!screen([-0.1, 0.3], 0.0, 0.25));
}

/// Turning points count where they raise the peak, and nowhere else: 0.25 +
/// 0.125 tau - 0.125 tau^2 reaches at most 0.5 by its bound, and 0.28125.
#[test]
fn turning_points_count_where_they_raise_the_peak() {
    let c = [0.25, 0.125, -0.125, 0.0];
    let v = [0.125, -0.25, 0.0, 0.0];
    let counted = |v: [f64; 4], peak: f64| {
        let mut driver = driver();
        driver.record.peak = peak;
        let place = Moment { piece: 0, offset: 0.0 };
        driver.turning_points(&TaylorSeries { c, v }, 1.0, (place, 1.0));
        (driver.record.work.turning_points, driver.record.peak)
    };
    assert_eq!(counted(v, 0.5), (0, 0.5));
    assert_eq!(counted(v, 0.281_25), (0, 0.281_25));
    assert_eq!(counted(v, 0.281_25_f64.next_down()), (1, 0.281_25));
    assert_eq!(counted(v, 0.0), (1, 0.281_25));
    // A velocity that surely keeps its sign has none; one that may lose it
    // at the very end is looked at, and turns at no point inside.
    assert_eq!(counted([0.375, -0.25, 0.0, 0.0], 0.0), (0, 0.0));
    assert_eq!(counted([0.25, -0.25, 0.0, 0.0], 0.0), (0, 0.0));
}
