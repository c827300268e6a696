//! Orders of convergence: of the fixed-order steps of Eq. 1, and of naive
//! schemes, whose orders show how they locate impacts, not the order of
//! their steps.

use anyhow::{Result, bail};
use rocking::integrator::{Impact, Observe, Order, Solver};

use super::fates::through;
use super::method::{Context, Reply, WrongModel};
use crate::engine::{Quotient, on_core};
use crate::naive::{Events, Naive, Rules};
use crate::references;
use crate::scene::{CaseScene, Engine as _, Forcing, Overturning};

/// Division of the run that counts as the truth.
const FINEST: usize = 16;

/// Observed order in the step: the same broken line with more samples. The
/// slope is signed, so an error that grows has a negative one.
pub fn order(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        order: u32,
        /// Block: alpha (rad), p (rad/s), eta.
        block: [f64; 3],
        dt_s: f64, acceleration_m_s2: Vec<f64>,
        /// Parts into which an interval of the record is divided.
        divisions: Vec<usize>,
    }
    // A series that stops two terms early; below order 4 only the naive
    // integrator exists.
    let low = context.is(WrongModel::OrderTooLow);
    let crude = low && order == 4;
    let used = if low && order >= 6 { order - 2 } else { order };
    let used: Order = used.to_string().parse()?;
    let observe = Observe { events: true, ..Observe::default() };
    let run = |division: usize, order: Order| {
        let samples = acceleration_m_s2.iter().enumerate();
        let corners: Vec<_> =
            samples.map(|(k, a)| (k * division, *a)).collect();
        let forcing = through(dt_s / division as f64, &corners)?;
        let [alpha, p, eta] = block;
        let scene = CaseScene::new([alpha, p, 9.81], eta, forcing);
        if crude && division < FINEST {
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
    let error = |division: &usize| {
        let found = run(*division, used)?;
        let off = |k: usize| (found[k] - truth[k]).abs() / truth[k].abs();
        Ok([0, 1, 2].map(off))
    };
    let errors: Vec<[f64; 3]> =
        divisions.iter().map(error).collect::<Result<_>>()?;
    let names = ["peak", "impact-time", "impact-speed"];
    for (k, name) in names.iter().enumerate() {
        for (pair, steps) in errors.windows(2).zip(divisions.windows(2)) {
            let ratio = steps[1] as f64 / steps[0] as f64;
            let slope = libm::log(pair[0][k] / pair[1][k]) / libm::log(ratio);
            let due = f64::from(order);
            answer.put(&format!("order-of-{name}"), [slope], [due]);
        }
    }
    Ok(())
}

/// Peak, and time and speed of the first impact.
fn measures(peak_ratio: f64, impacts: &[Impact]) -> [f64; 3] {
    let first = impacts.first().map(|i| (i.time_s, i.speed_before_rad_s));
    let (time_s, speed_rad_s) = first.unwrap_or((f64::NAN, f64::NAN));
    [peak_ratio, time_s, speed_rad_s]
}

/// Slope of the root mean square error of the impact times of naive schemes,
/// over steps that put the impacts anywhere in a step.
pub fn orders(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Trajectories under records.
        entries: Vec<String>,
        /// Impacts whose times are compared.
        impacts: usize,
        /// Steps an interval, and how much finer the second set is.
        divisions: Vec<u32>,
        finer: u32,
        /// The same for located impacts, whose errors soon are rounding.
        located_divisions: Vec<u32>,
        located_finer: u32,
    }
    let error = |events: Events, divisions: &[u32], finer: u32| {
        let (mut sum, mut count) = (0.0, 0.0);
        for entry in &entries {
            let case = references::trajectory(entry)?;
            let scene = case.scene(Overturning::HalfPi)?;
            let p = scene.frequency_rad_s;
            let Forcing::Samples { dt_s, .. } = scene.forcing else {
                bail!("`{entry}`: no record");
            };
            for &division in divisions {
                let step_p = dt_s * p / f64::from(division * finer);
                let located = events == Events::Located;
                let step_p = if located { step_p } else { 0.1 * step_p };
                let rules = Rules { events, step_p, ..Rules::default() };
                let trace = Naive(rules).respond(&scene)?;
                let pairs = trace.impacts.iter().zip(&case.expected.impacts);
                for (impact, due) in pairs.take(impacts) {
                    let off = (impact.time_s - due.t.near) * p;
                    sum += off * off;
                    count += 1.0;
                }
            }
        }
        Ok((sum / count).sqrt())
    };
    let late = context.is(WrongModel::OrderTooLow);
    for (name, events, late_events) in [
        ("step-ends-rotation-kept", Events::StepEndsRotationKept, None),
        ("step-ends", Events::StepEnds, None),
        ("interpolated", Events::Interpolated, Some(Events::StepEnds)),
        ("located", Events::Located, Some(Events::StepEnds)),
    ] {
        let (divisions, finer) = match events {
            Events::Located => (&located_divisions, located_finer),
            _ => (&divisions, finer),
        };
        let events = late_events.filter(|_| late).unwrap_or(events);
        let coarse = error(events, divisions, 1)?;
        let fine = error(events, divisions, finer)?;
        let slope = libm::log(coarse / fine) / libm::log(f64::from(finer));
        answer.see(&format!("order-{name}"), [slope]);
    }
    Ok(())
}
