//! Orders of naive schemes: what they miss at an impact shows in them, not
//! the order of their steps.

use serde::Deserialize;

use super::method::{Context, Reply, WrongModel};
use crate::naive::{Events, Naive, Rules};
use crate::references;
use crate::scene::{Engine as _, Forcing, Overturning};
use anyhow::{Result, bail};

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct SchemeInput {
    /// Trajectories under records.
    entries: Vec<String>,
    /// Impacts whose times are compared.
    impacts: usize,
    /// Steps an interval, and how much finer the second set is.
    divisions: Vec<u32>,
    finer: u32,
    /// The same where impacts are located, and errors soon are rounding.
    located_divisions: Vec<u32>,
    located_finer: u32,
}

/// Slope of the root mean square error of the impact times, over steps that
/// set the impacts anywhere in a step.
pub fn orders(context: &Context, answer: &mut Reply) -> Result<()> {
    let input: SchemeInput = context.input()?;
    let late = context.is(WrongModel::OrderTooLow);
    for (name, events) in [
        ("step-ends-rotation-kept", Events::StepEndsRotationKept),
        ("step-ends", Events::StepEnds),
        ("interpolated", Events::Interpolated),
        ("located", Events::Located),
    ] {
        let (divisions, finer) = match events {
            Events::Located => (&input.located_divisions, input.located_finer),
            _ => (&input.divisions, input.finer),
        };
        let events = match events {
            Events::Located | Events::Interpolated if late => Events::StepEnds,
            other => other,
        };
        let coarse = error(&input, events, divisions, 1)?;
        let fine = error(&input, events, divisions, finer)?;
        let slope = libm::log(coarse / fine) / libm::log(f64::from(finer));
        answer.see(&format!("order-{name}"), [slope]);
    }
    Ok(())
}

fn error(
    input: &SchemeInput,
    events: Events,
    divisions: &[u32],
    finer: u32,
) -> Result<f64> {
    let (mut sum, mut count) = (0.0, 0.0);
    for entry in &input.entries {
        let case = references::trajectory(entry)?;
        let scene = case.scene(Overturning::HalfPi)?;
        let Forcing::Samples { dt_s, .. } = scene.forcing else {
            bail!("`{entry}`: no record");
        };
        for &division in divisions {
            let step_p =
                dt_s * scene.frequency_rad_s / f64::from(division * finer);
            let step_p = match events {
                Events::Located => step_p,
                _ => 0.1 * step_p,
            };
            let rules = Rules { events, step_p, ..Rules::default() };
            let trace = Naive(rules).respond(&scene)?;
            let pairs = trace.impacts.iter().zip(&case.expected.impacts);
            for (impact, due) in pairs.take(input.impacts) {
                let off = (impact.time_s - due.t.near) * scene.frequency_rad_s;
                sum += off * off;
                count += 1.0;
            }
        }
    }
    Ok((sum / count).sqrt())
}
