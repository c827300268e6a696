//! Judges a case: its quantities against their bounds, and its wrong models.

pub mod snapshot;

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, Result, bail};

use crate::cases::{Bound, Case, ToleranceBasis};
use crate::methods::{self, Quantities, Reply};
use rocking::names::named;
use rocking_common::json::Extended;
use serde::{Deserialize, Serialize};

named! {
    /// Result of a case.
    pub enum CaseVerdict: "verdict" {
        /// Every bound holds and every wrong model is rejected.
        Pass = "pass",
        /// A bound is exceeded, or a wrong model is not rejected.
        Fail = "fail",
        /// The case could not be judged.
        Error = "error",
    }
}

/// One quantity against its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Name of the quantity.
    pub quantity: String,
    /// Its bound.
    pub bound: Bound,
    /// Observed values.
    pub observed: Vec<f64>,
    /// Expected values; empty if the bound needs none.
    pub expected: Vec<f64>,
    /// Largest error in the measure of the bound; infinite if the values
    /// cannot be compared.
    pub error: f64,
    /// Error over bound: at most 1 passes.
    pub margin: f64,
}

impl Check {
    /// True if the bound holds; not a number fails.
    pub fn holds(&self) -> bool {
        self.margin <= 1.0
    }
}

/// Rejection of a wrong model.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rejection {
    /// Largest error over bound.
    pub margin: Extended,
    /// The quantity that shows it best.
    pub quantity: String,
}

/// A judged case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseOutcome {
    /// The case.
    pub case: Case,
    /// Each quantity.
    pub checks: Vec<Check>,
    /// Each wrong model by its name: a margin above 1 is rejected.
    pub rejections: BTreeMap<String, Rejection>,
    /// The verdict.
    pub verdict: CaseVerdict,
    /// Failures, if any.
    pub messages: Vec<String>,
}

impl CaseOutcome {
    /// Largest margin over the quantities.
    pub fn worst_margin(&self) -> f64 {
        self.checks.iter().fold(0.0, |worst, c| largest(worst, c.margin))
    }

    /// Bounds that are far above the error or nearly broken. Bounds at the
    /// floor and bounds taken from another code's errors cannot be tightened;
    /// printed digits use up their bound.
    pub fn bounds_to_look_at(&self) -> Vec<&Check> {
        let basis = self.case.tolerance.basis;
        let printed = basis == ToleranceBasis::ReferenceRounding;
        let given = basis == ToleranceBasis::AttainableFloat64;
        let odd = |c: &&Check| {
            let (Bound::Absolute(bound) | Bound::Relative(bound)) = c.bound
            else {
                return false;
            };
            let loose = c.margin > 0.0 && c.margin < 1e-3 && bound > FLOOR;
            (loose && !given) || (c.margin > 0.9 && !printed)
        };
        self.checks.iter().filter(odd).collect()
    }
}

/// Lower limit of a useful bound in double precision.
const FLOOR: f64 = 1.01e-13;

fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Compares quantities by name, never by position; `floor` widens absolute
/// and relative bounds to the accuracy of a naive method.
///
/// # Errors
/// An error for a quantity without bound or expectation, and for a
/// bound without quantity.
pub fn judge(
    bounds: &BTreeMap<String, Bound>,
    observed: &Quantities,
    expected: &Quantities,
    floor: Option<f64>,
) -> Result<Vec<Check>> {
    let names: BTreeSet<&String> =
        observed.keys().chain(expected.keys()).collect();
    if let Some(name) = bounds.keys().find(|name| !names.contains(name)) {
        bail!("bound on `{name}`, which the method does not give");
    }
    let mut checks = Vec::with_capacity(names.len());
    for name in names {
        let bound = bounds
            .get(name)
            .with_context(|| format!("quantity `{name}` has no bound"))?;
        let observed = observed.get(name).cloned().unwrap_or_default();
        let expected = expected.get(name);
        if expected.is_none() && !matches!(bound, Bound::Interval(..)) {
            bail!("quantity `{name}` has no expected value");
        }
        let expected = expected.cloned().unwrap_or_default();
        let (error, margin) = measure(bound, &observed, &expected, floor);
        let (quantity, bound) = (name.clone(), bound.clone());
        checks.push(Check {
            quantity,
            bound,
            observed,
            expected,
            error,
            margin,
        });
    }
    Ok(checks)
}

fn measure(
    bound: &Bound,
    seen: &[f64],
    wanted: &[f64],
    floor: Option<f64>,
) -> (f64, f64) {
    let never = (f64::INFINITY, f64::INFINITY);
    let widened = |x: f64| floor.map_or(x, |f| if f > x { f } else { x });
    let over = |error: f64, limit: f64| {
        (error, if error == 0.0 { 0.0 } else { error / limit })
    };
    let worst = |of: fn(f64, f64) -> f64| {
        seen.iter().zip(wanted).fold(0.0, |worst, (s, w)| {
            largest(worst, if s == w { 0.0 } else { of(*s, *w) })
        })
    };
    match bound {
        Bound::Waived(_) => (0.0, 0.0),
        Bound::Interval(low, high) => {
            let inside = |x: &f64| *x >= *low && *x <= *high;
            let held = !seen.is_empty() && seen.iter().all(inside);
            if held { (0.0, 0.0) } else { never }
        }
        _ if seen.len() != wanted.len() => never,
        Bound::Exact => {
            let error = worst(|_, _| f64::INFINITY);
            (error, error)
        }
        Bound::Absolute(limit) => {
            over(worst(|s, w| (s - w).abs()), widened(*limit))
        }
        Bound::Relative(limit) => {
            over(worst(|s, w| (s - w).abs() / w.abs()), widened(*limit))
        }
        Bound::Order(slack) => {
            over(worst(|s, w| if s > w { 0.0 } else { w - s }), *slack)
        }
    }
}

/// Runs a case and its wrong models, and gives the verdict.
pub fn run_case(case: &Case) -> CaseOutcome {
    let mut outcome = CaseOutcome {
        case: case.clone(),
        checks: Vec::new(),
        rejections: BTreeMap::new(),
        verdict: CaseVerdict::Fail,
        messages: Vec::new(),
    };
    if let Err(error) = fill(&mut outcome, case) {
        outcome.verdict = CaseVerdict::Error;
        outcome.messages.push(format!("{error:#}"));
    } else if outcome.messages.is_empty() {
        outcome.verdict = CaseVerdict::Pass;
    }
    outcome
}

/// Runs the case without its wrong models.
///
/// # Errors
/// An error if no answer can be given or judged.
pub fn checks_of(case: &Case) -> Result<Vec<Check>> {
    checks(case, methods::run_method(case, None), None)
}

/// Runs the case and its wrong models.
fn fill(outcome: &mut CaseOutcome, case: &Case) -> Result<()> {
    outcome.checks = checks_of(case)?;
    let messages = &mut outcome.messages;
    let broken = outcome.checks.iter().filter(|check| !check.holds());
    messages.extend(broken.map(describe));
    let wrong = &case.tolerance.reject;
    if wrong.is_empty() {
        messages.push("rejects no wrong model".to_owned());
    }
    if wrong.iter().any(|wrong| wrong.is_naive()) {
        messages.extend(naive_passes(case).err().map(|e| format!("{e:#}")));
    }
    for wrong in wrong.iter().copied() {
        let name = wrong.name();
        let floor = case.tolerance.naive.filter(|_| wrong.is_naive());
        let answer = methods::run_method(case, Some(wrong));
        let checks = checks(case, answer, floor).context(name)?;
        // The first of the largest margins.
        let by_margin = |a: &&Check, b: &&Check| a.margin.total_cmp(&b.margin);
        let strongest = checks.iter().rev().max_by(by_margin);
        let strongest = strongest.context("no quantity")?;
        if strongest.margin <= 1.0 {
            messages.push(format!("wrong model `{name}` passes"));
        }
        let quantity = strongest.quantity.clone();
        let margin = Extended(strongest.margin);
        let rejection = Rejection { margin, quantity };
        outcome.rejections.insert(name.to_owned(), rejection);
    }
    Ok(())
}

/// Runs cases side by side; outcomes in the order of the cases.
pub fn run_all(cases: &[Case]) -> Vec<CaseOutcome> {
    use rayon::prelude::*;
    cases.par_iter().map(run_case).collect()
}

/// A rejection by the naive integrator proves something only if that
/// integrator passes with correct rules.
fn naive_passes(case: &Case) -> Result<()> {
    let floor = case.tolerance.naive.context(
        "a wrong algorithm is rejected without `naive`, the tolerance of the \
         right one",
    )?;
    let checks = checks(case, methods::run_naive(case), Some(floor))?;
    match checks.iter().find(|check| !check.holds()) {
        None => Ok(()),
        Some(check) => {
            bail!("naive integrator with right rules: {}", describe(check))
        }
    }
}

fn checks(
    case: &Case,
    answer: Result<Reply>,
    floor: Option<f64>,
) -> Result<Vec<Check>> {
    let Reply { observed, mut expected } = answer?;
    for (name, values) in &case.expect.values {
        if expected.insert(name.clone(), values.to_vec()).is_some() {
            bail!("both the method and the case give `{name}` a value");
        }
    }
    judge(&case.tolerance.bounds, &observed, &expected, floor)
}

/// A broken bound with its values, as decimals and as bits.
fn describe(check: &Check) -> String {
    use std::fmt::Write as _;
    let Check { quantity, bound, error, margin, observed, expected } = check;
    let mut text = format!(
        "{quantity}: error {error:e} against {bound:?} (margin {margin:.3})"
    );
    let (n, due) = (observed.len(), expected.len());
    if n != due {
        let _ = write!(text, "; {n} values for {due} expected");
    }
    let pairs = observed.iter().zip(expected).enumerate();
    for (i, (o, e)) in pairs.filter(|(_, (o, e))| o != e).take(4) {
        let (seen, due) = (o.to_bits(), e.to_bits());
        let _ = write!(
            text,
            "\n  [{i}] observed {o:e} ({seen:016x}), \
             expected {e:e} ({due:016x})"
        );
    }
    text
}
