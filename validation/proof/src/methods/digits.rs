//! Significant digits that single, double and double-double precision reach
//! on the reference trajectories and the hard cases.

use anyhow::{Context as _, Result};
use rayon::prelude::*;
use rocking::number::double::DoubleDouble;
use rocking::number::{Number as _, Real as _};

use super::fates;
use crate::cases::{Case, load_all};
use crate::engine::{Precision, WideTrace};
use crate::references;
use crate::scene::{CaseScene, Overturning, by_equation};

/// Kinds of arithmetic in the order of the columns, and the digits of each.
const PRECISIONS: [(Precision, f64); 3] = [
    (Precision::Single, 7.2),
    (Precision::Double, 16.0),
    (Precision::DoubleDouble, 31.9),
];

/// Impacts compared.
const IMPACTS: usize = 10;

/// The table as CSV: a line for every reference trajectory and hard case that
/// moves, hard cases first. A line has, in single, double and double-double
/// precision, the digits of the peak |theta|/alpha or of the time of
/// overturning, and the worst of the times and speeds of the first ten impacts.
/// The truth is a reference of 36 digits, or the double-double run.
///
/// # Errors
/// An error if a case cannot be read or run.
pub fn digits_csv() -> Result<String> {
    let mut cases = load_all()?;
    let is_hard = |case: &Case| case.family == "hard-cases";
    cases.retain(|case| is_hard(case) || case.method == "trajectory");
    cases.sort_by_key(|case| !is_hard(case));
    let rows = cases.par_iter().map(|case| row(case).context(case.id.clone()));
    let rows: Vec<Option<String>> = rows.collect::<Result<_>>()?;
    let rows = rows.into_iter().flatten();
    Ok([DIGITS_HEADER.to_owned()].into_iter().chain(rows).collect())
}

fn row(case: &Case) -> Result<Option<String>> {
    let (scene, truth) = match case.method.as_str() {
        "trajectory" => reference(case)?,
        "response" | "double-against-double-double" => {
            (fates::scene_of(case)?, None)
        }
        _ => return Ok(None),
    };
    let runs = PRECISIONS.map(|(by, _)| WideTrace::run(&scene, by));
    let runs = runs.into_iter().collect::<Result<Vec<_>, _>>()?;
    let has_reference = truth.is_some();
    let truth = truth.unwrap_or_else(|| runs[2].clone());
    if truth.uplift_s.is_none() {
        return Ok(None);
    }
    let mut reached = [const { String::new() }; 6];
    for (k, (run, (_, most))) in runs.iter().zip(PRECISIONS).enumerate() {
        if k < 2 || has_reference {
            reached[k] = end_reach(run, &truth, most);
            reached[3 + k] = impact_reach(run, &truth, most);
        }
    }
    let equation = by_equation(scene.model, 1, 2);
    let truth = if has_reference { "36 digits" } else { "double-double" };
    let reached = reached.join(",");
    Ok(Some(format!("{},{equation},{truth},{reached}\n", case.id)))
}

/// Scene and truth of a trajectory, under its criterion.
fn reference(case: &Case) -> Result<(CaseScene, Option<WideTrace>)> {
    let entry = case.input.get("entry").and_then(toml::Value::as_str);
    let entry = references::trajectory(entry.unwrap_or_default())?;
    let tangency = case.id.contains("-flip-");
    let criterion =
        if tangency { Overturning::Alpha } else { Overturning::HalfPi };
    let scene = entry.scene(criterion)?;
    let due = &entry.expected;
    let overturned_s = due.overturned(criterion).map(|t| t.wide);
    let truth = WideTrace {
        uplift_s: due.uplifts.first().map(|u| u.t.wide),
        impacts: due.impacts_until(criterion),
        peak_ratio: match (overturned_s, due.peak()) {
            (None, Some(peak)) => peak.wide,
            _ => DoubleDouble::zero(),
        },
        overturned_s,
        rest_s: None,
        error_estimate: 0.0,
        resolved: true,
    };
    Ok((scene, Some(truth)))
}

/// Digits of the peak or of the time of overturning, if the outcome is right.
fn end_reach(run: &WideTrace, truth: &WideTrace, most: f64) -> String {
    let (found, due) = match (run.overturned_s, truth.overturned_s) {
        (None, None) => (run.peak_ratio, truth.peak_ratio),
        (Some(found), Some(due)) => (found, due),
        _ => return "wrong fate".to_owned(),
    };
    format!("{:.1}", shared(found, due, most))
}

/// Fewest digits of the impacts, if there are any.
fn impact_reach(run: &WideTrace, truth: &WideTrace, most: f64) -> String {
    let impacts = truth.impacts.iter().take(IMPACTS).enumerate();
    let digits = impacts.map(|(k, (time, speed))| {
        run.impacts.get(k).map_or(0.0, |found| {
            let time = shared(found.0, *time, most);
            time.min(shared(found.1, *speed, most))
        })
    });
    let worst = digits.reduce(f64::min);
    worst.map_or(String::new(), |digits| format!("{digits:.1}"))
}

/// Significant digits that two numbers share, to a tenth.
fn shared(found: DoubleDouble, due: DoubleDouble, most: f64) -> f64 {
    let error = ((found - due).abs() / due.abs()).to_f64();
    if error == 0.0 {
        return most;
    }
    let digits = -libm::log10(error);
    // Not a number shares nothing.
    if digits > 0.0 { 0.1 * (10.0 * digits.min(most)).round() } else { 0.0 }
}

/// First line of the table as CSV.
pub const DIGITS_HEADER: &str = "case,equation,truth,end_single,end_double,\
    end_double_double,impacts_single,impacts_double,impacts_double_double\n";
