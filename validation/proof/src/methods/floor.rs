//! Motions of floors against matrix exponentials and limits.

use anyhow::Result;
use rocking::accelerogram::Accelerogram;
use rocking_records::floor::Floor;

use super::cells::Csv;
use super::method::{Context, Reply, WrongModel};

const EXPECTED: Csv = Csv::new("oracles/floor.csv");

/// Absolute acceleration of a floor.
pub fn motion(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        dt_s: f64, samples_g: Vec<f64>, period_s: f64, damping_ratio: f64,
        height_ratio: f64,
        /// Name in the file of expected values; without it the case has the
        /// expected values, at the samples of the ground.
        floor: Option<String>,
    }
    let period = context.or(WrongModel::PeriodOnePercentLong, 1.01, 1.0);
    // The least damping that a floor may have.
    let damping = context.or(WrongModel::NoDamping, 0.005, damping_ratio);
    let of = |h| Floor::try_new(period * period_s, damping, h);
    let ground = Accelerogram::try_new("case", dt_s, samples_g)?;
    let right = of(height_ratio)?.motion(&ground)?;
    let moved: Vec<f64> = match context.wrong {
        Some(WrongModel::RelativeForAbsolute) => {
            let still = std::iter::repeat(&0.0);
            let ground = ground.samples_g().iter().chain(still);
            right.samples_g().iter().zip(ground).map(|(a, b)| a - b).collect()
        }
        Some(WrongModel::MassForFloor) => {
            let mass = of(1.0)?.motion(&ground)?;
            mass.samples_g().iter().map(|a| height_ratio * a).collect()
        }
        _ => right.samples_g().to_vec(),
    };
    let Some(floor) = floor else {
        let during = moved.into_iter().take(ground.samples_g().len());
        answer.see("acceleration-g", during);
        return Ok(());
    };
    for row in EXPECTED.rows(&floor)? {
        let due = row.number(2)?;
        match row.text(1).parse::<usize>() {
            Ok(i) => {
                let own = moved.get(i).copied().unwrap_or(f64::NAN);
                answer.put("acceleration-g", [own], [due]);
            }
            Err(_) => answer.put("samples", [moved.len() as f64], [due]),
        }
    }
    Ok(())
}
