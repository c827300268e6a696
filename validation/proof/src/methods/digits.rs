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
use crate::scene::{CaseScene, Model, Overturning};

/// What a precision reaches.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reach {
    /// So many significant digits.
    Digits(f64),
    /// Not even the fate.
    WrongFate,
    /// Nothing to compare.
    Nothing,
}

/// Significant digits of one scene in single, double and double-double
/// precision.
#[derive(Clone, Debug, PartialEq)]
pub struct DigitsRow {
    /// The case.
    pub id: String,
    /// 1 or 2.
    pub equation: u8,
    /// True where the truth is a reference of 36 digits, false where it is
    /// the double-double run itself.
    pub has_reference: bool,
    /// Peak |theta|/alpha, or the time of overturning.
    pub end: [Reach; 3],
    /// The worst of the times and speeds of the first ten impacts.
    pub impacts: [Reach; 3],
}

/// Arithmetics in the order of the columns, and the digits of each.
const PRECISIONS: [(Precision, f64); 3] = [
    (Precision::Single, 7.2),
    (Precision::Double, 16.0),
    (Precision::DoubleDouble, 31.9),
];

/// Impacts compared.
const IMPACTS: usize = 10;

/// Every reference trajectory and hard case that moves, hard cases first.
///
/// # Errors
/// An error where a case cannot be read or run.
pub fn digits() -> Result<Vec<DigitsRow>> {
    let mut cases = load_all()?;
    let is_hard = |case: &Case| case.family == "hard-cases";
    cases.retain(|case| is_hard(case) || case.method == "trajectory");
    cases.sort_by_key(|case| !is_hard(case));
    let rows = cases.par_iter().map(|case| row(case).context(case.id.clone()));
    let rows: Vec<Option<DigitsRow>> = rows.collect::<Result<_>>()?;
    Ok(rows.into_iter().flatten().collect())
}

fn row(case: &Case) -> Result<Option<DigitsRow>> {
    let (scene, truth) = match case.method.as_str() {
        "trajectory" => {
            let (scene, truth) = reference(case)?;
            (scene, Some(truth))
        }
        "response" | "double-against-double-double" => {
            (fates::scene_of(case)?, None)
        }
        _ => return Ok(None),
    };
    let mut runs = Vec::new();
    for (arithmetic, _) in PRECISIONS {
        runs.push(WideTrace::run(&scene, arithmetic)?);
    }
    let has_reference = truth.is_some();
    let Some(own) = runs.last().cloned() else { return Ok(None) };
    let truth = truth.unwrap_or(own);
    if truth.uplift_s.is_none() {
        return Ok(None);
    }
    let (mut end, mut impacts) = ([Reach::Nothing; 3], [Reach::Nothing; 3]);
    for (k, (run, (_, most))) in runs.iter().zip(PRECISIONS).enumerate() {
        if k == 2 && !has_reference {
            continue;
        }
        end[k] = end_reach(run, &truth, most);
        impacts[k] = impact_reach(run, &truth, most);
    }
    Ok(Some(DigitsRow {
        id: case.id.clone(),
        equation: match scene.model {
            Model::Nonlinear => 1,
            Model::Linearized => 2,
        },
        has_reference,
        end,
        impacts,
    }))
}

/// Scene and truth of a trajectory, under the criterion that it is about.
fn reference(case: &Case) -> Result<(CaseScene, WideTrace)> {
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
    Ok((scene, truth))
}

fn end_reach(run: &WideTrace, truth: &WideTrace, most: f64) -> Reach {
    match (run.overturned_s, truth.overturned_s) {
        (None, None) => {
            Reach::Digits(shared(run.peak_ratio, truth.peak_ratio, most))
        }
        (Some(found), Some(due)) => Reach::Digits(shared(found, due, most)),
        _ => Reach::WrongFate,
    }
}

fn impact_reach(run: &WideTrace, truth: &WideTrace, most: f64) -> Reach {
    let mut worst = None;
    for (k, (time, speed)) in truth.impacts.iter().take(IMPACTS).enumerate() {
        let digits = run.impacts.get(k).map_or(0.0, |found| {
            let time = shared(found.0, *time, most);
            time.min(shared(found.1, *speed, most))
        });
        worst = Some(digits.min(worst.unwrap_or(most)));
    }
    worst.map_or(Reach::Nothing, Reach::Digits)
}

/// Significant digits that two numbers share, to a tenth.
fn shared(found: DoubleDouble, due: DoubleDouble, most: f64) -> f64 {
    let error = ((found - due).abs() / due.abs()).to_f64();
    if error == 0.0 {
        return most;
    }
    let digits = -libm::log10(error);
    // Not a number shares nothing.
    if !(digits > 0.0) {
        return 0.0;
    }
    0.1 * (10.0 * digits.min(most)).round()
}

impl Reach {
    fn text(self) -> String {
        match self {
            Self::Digits(digits) => format!("{digits:.1}"),
            Self::WrongFate => "wrong fate".to_owned(),
            Self::Nothing => String::new(),
        }
    }
}

/// First line of the table as CSV.
pub const DIGITS_HEADER: &str = "case,equation,truth,end_single,end_double,\
    end_double_double,impacts_single,impacts_double,impacts_double_double\n";

/// The table as CSV.
pub fn digits_csv(rows: &[DigitsRow]) -> String {
    let line = |row: &DigitsRow| {
        let truth =
            if row.has_reference { "36 digits" } else { "double-double" };
        let reached = row.end.iter().chain(&row.impacts).map(|r| r.text());
        let reached: Vec<String> = reached.collect();
        let (id, equation) = (&row.id, row.equation);
        format!("{id},{equation},{truth},{}\n", reached.join(","))
    };
    rows.iter().fold(DIGITS_HEADER.to_owned(), |text, row| text + &line(row))
}
