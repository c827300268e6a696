//! Our own methods on the single analyses.

use rocking::integrator::{
    Observe, Order, SceneError, Solver, respond_precise,
};
use rocking::number::double::DoubleDouble;

use super::answers::ToolAnswer;
use super::cases::SpeedCase;
use super::clock::least_s;
use super::measured::{TimingRow, row};

/// The tool, method and setting that ratios refer to.
pub const BASE: [&str; 3] = ["rocking", "Taylor", "as shipped"];

/// Batches of a measurement, and the duration of each in s.
const BATCHES: (u32, f64) = (5, 4e-3);

/// The orders, as settings.
pub const ORDERS: [(&str, Option<Order>); 5] = [
    ("order 4", Some(Order::Four)),
    ("order 6", Some(Order::Six)),
    ("order 8", Some(Order::Eight)),
    ("order 10", Some(Order::Ten)),
    ("as shipped", None),
];

/// Measures every order on every case, and double-double once.
///
/// # Errors
/// [`SceneError`] in none of the cases.
pub fn measure(
    cases: &[(SpeedCase, ToolAnswer)],
    done: impl Fn(),
) -> Result<Vec<TimingRow>, SceneError> {
    let version = env!("CARGO_PKG_VERSION");
    let (bare, (batches, batch_s)) = (Observe::default(), BATCHES);
    let seen = Observe { events: true, ..Observe::default() };
    let mut rows = Vec::new();
    for (setting, order) in ORDERS {
        let label = ["rocking", version, "Taylor", setting];
        let solver = Solver { order, ..Solver::default() };
        for (case, reference) in cases {
            let scene = case.scene();
            let run = || solver.respond(&scene, &bare);
            let (cpu_s, plain) = least_s(batches, batch_s, run);
            let answer = ToolAnswer::of(case, &solver.respond(&scene, &seen)?);
            let took = (cpu_s, plain?.work.steps);
            rows.push(row(label, (case, reference), took, &answer));
            done();
        }
    }
    let label = ["rocking", version, "Taylor, double-double", "order 27"];
    for (case, reference) in cases {
        let scene = case.scene();
        let run = || respond_precise::<DoubleDouble>(&scene, &bare);
        let (cpu_s, plain) = least_s(1, 0.0, run);
        let took = (cpu_s, plain?.work.steps);
        rows.push(row(label, (case, reference), took, reference));
        done();
    }
    Ok(rows)
}
