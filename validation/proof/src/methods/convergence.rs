//! Order of convergence of the fixed-order steps of Eq. 1.

use anyhow::Result;
use rocking::integrator::{Impact, Observe, Order, Solver};
use serde::Deserialize;

use super::method::{Context, Reply, WrongModel};
use crate::engine::{Quotient, on_core};
use crate::naive::{Events, Naive, Rules};
use crate::scene::{CaseScene, Engine as _, Forcing};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct OrderInput {
    order: u32,
    /// Block: alpha (rad), p (rad/s), eta.
    block: [f64; 3],
    dt_s: f64,
    acceleration_m_s2: Vec<f64>,
    /// Intervals that one interval of the record is divided into.
    divisions: Vec<usize>,
}

/// Division and order of the run that stands for the truth.
const FINEST: usize = 16;

/// Observed order in the step: the same broken line with more samples. The
/// slope is signed, so an error that grows has a negative one.
pub fn order(context: &Context, answer: &mut Reply) -> Result<()> {
    let input: OrderInput = context.input()?;
    let order = match (input.order, context.wrong) {
        // A series that stops two terms early.
        (6.., Some(WrongModel::OrderTooLow)) => input.order - 2,
        _ => input.order,
    };
    let order: Order = order.to_string().parse()?;
    let crude = input.order == 4 && context.is(WrongModel::OrderTooLow);
    let observe = Observe { events: true, ..Observe::default() };
    let run = |division: usize, order: Order| {
        let scene = divided(&input, division);
        if crude && division < FINEST {
            // Below order 4 there is the naive integrator alone.
            let events = Events::StepEnds;
            let rules = Rules { events, ..Rules::default() };
            let trace = Naive(rules).respond(&scene)?;
            return anyhow::Ok(measures(trace.peak_ratio, &trace.impacts));
        }
        let order = Some(order);
        let found = on_core(&scene, Quotient::Rounded, |scene| {
            let solver = Solver { order, ..Solver::default() };
            solver.respond(scene, &observe)
        })?;
        Ok(measures(found.peak_ratio, &found.impacts))
    };
    let truth = run(FINEST, Order::Ten)?;
    let mut errors = Vec::new();
    for &division in &input.divisions {
        let found = run(division, order)?;
        errors.push(
            [0, 1, 2]
                .map(|k: usize| (found[k] - truth[k]).abs() / truth[k].abs()),
        );
    }
    let names = ["peak", "impact-time", "impact-speed"];
    for (k, name) in names.iter().enumerate() {
        let steps = input.divisions.windows(2);
        for (pair, steps) in errors.windows(2).zip(steps) {
            let ratio = steps[1] as f64 / steps[0] as f64;
            let slope = libm::log(pair[0][k] / pair[1][k]) / libm::log(ratio);
            let due = f64::from(input.order);
            answer.put(&format!("order-of-{name}"), [slope], [due]);
        }
    }
    Ok(())
}

fn divided(input: &OrderInput, division: usize) -> CaseScene {
    let [alpha, p, eta] = input.block;
    let mut fine = Vec::new();
    for pair in input.acceleration_m_s2.windows(2) {
        let rise = (pair[1] - pair[0]) / division as f64;
        fine.extend((0..division).map(|k| pair[0] + rise * k as f64));
    }
    fine.extend(input.acceleration_m_s2.last());
    let forcing = Forcing::samples(input.dt_s / division as f64, fine);
    CaseScene::new([alpha, p, 9.81], eta, forcing)
}

/// Peak, and time and speed of the first impact.
fn measures(peak_ratio: f64, impacts: &[Impact]) -> [f64; 3] {
    let first = impacts.first();
    [
        peak_ratio,
        first.map_or(f64::NAN, |i| i.time_s),
        first.map_or(f64::NAN, |i| i.speed_before_rad_s),
    ]
}
