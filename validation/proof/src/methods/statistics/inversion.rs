//! Inversion of response curves, on examples in exact rationals.

use anyhow::Result;
use rocking::capacity::{InversionRule, ResponseCurve};

use crate::methods::method::{Context, Reply, WrongModel};

/// Capacities at the levels by every rule, and the number of crossings.
pub fn inversion(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// (IM, EDP), the first with EDP 0.
        curve: Vec<(f64, f64)>,
        overturning: Option<f64>, levels: Vec<f64>,
    }
    let mut vertices = curve.clone();
    let mut overturning = overturning;
    if context.is(WrongModel::OverturningAsAnAngle)
        && let Some(im) = overturning.take()
    {
        // pi/2 at alpha = 0.05, interpolated to.
        vertices.push((im, 31.415_926_535_897_93));
    }
    let curve = ResponseCurve::try_new(&vertices, overturning)?;
    for level in levels {
        // Strictly above instead of at or above.
        let above = level * (1.0 + f64::EPSILON);
        let level = context.or(WrongModel::OpenCrossings, above, level);
        let crossings = curve.crossings(level)?;
        answer.see("crossings", [crossings.all().len() as f64]);
        for named in InversionRule::ALL {
            let rule = match (context.wrong, named) {
                (Some(WrongModel::FirstForMedian), InversionRule::Median) => {
                    InversionRule::First
                }
                _ => named,
            };
            answer.see(named.name(), [crossings.capacity(rule).im()]);
        }
    }
    Ok(())
}
