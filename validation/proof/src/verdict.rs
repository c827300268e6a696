//! The one function that says whether a case holds, and its result.

pub mod snapshot;

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context as _, Result, bail};

use crate::cases::{Bound, Case, EvidenceKind, Status, ToleranceBasis};
use crate::methods::{self, Quantities, Reply};
use rocking::names::named;

named! {
    /// Result of a case.
    pub enum CaseVerdict: "verdict" {
        /// Every bound holds and every wrong model is rejected.
        Pass = "pass",
        /// A bound is broken, or a wrong model is not rejected.
        Fail = "fail",
        /// The case could not be judged.
        Error = "error",
        /// Fails, as declared.
        KnownFailure = "known-failure",
        /// Passes although declared to fail.
        UnexpectedPass = "unexpected-pass",
    }
}

impl CaseVerdict {
    /// Whether the gate stays green.
    pub fn is_accepted(self) -> bool {
        matches!(self, Self::Pass | Self::KnownFailure)
    }
}

/// One quantity against its bound.
#[derive(Clone, Debug, PartialEq)]
pub struct Check {
    /// Name of the quantity.
    pub quantity: String,
    /// Its bound.
    pub bound: Bound,
    /// What was observed.
    pub observed: Vec<f64>,
    /// What was expected; empty where the bound needs nothing.
    pub expected: Vec<f64>,
    /// Largest error in the bound's own measure; infinite where the values
    /// cannot be compared.
    pub error: f64,
    /// Error over bound: at most 1 passes.
    pub margin: f64,
}

impl Check {
    /// Whether the bound holds; not a number fails.
    pub fn holds(&self) -> bool {
        self.margin <= 1.0
    }
}

/// How a wrong model fared.
#[derive(Clone, Debug, PartialEq)]
pub struct Rejection {
    /// Its name.
    pub model: &'static str,
    /// Largest error over bound: above 1 is rejected.
    pub margin: f64,
    /// The quantity that shows it best.
    pub quantity: String,
}

/// A judged case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseOutcome {
    /// The case's id.
    pub id: String,
    /// Its kind.
    pub kind: EvidenceKind,
    /// Where its bounds come from.
    pub basis: ToleranceBasis,
    /// Each quantity.
    pub checks: Vec<Check>,
    /// Each wrong model.
    pub rejections: Vec<Rejection>,
    /// The verdict.
    pub verdict: CaseVerdict,
    /// What went wrong, if anything did.
    pub messages: Vec<String>,
}

impl CaseOutcome {
    /// Largest margin over the quantities; none where all are exact.
    pub fn worst_margin(&self) -> f64 {
        self.checks.iter().fold(0.0, |worst, c| largest(worst, c.margin))
    }

    /// Bounds that are far from what is reached or nearly broken. Bounds at
    /// the floor and those taken from another code's errors cannot be
    /// tightened; printed digits use up their bound.
    pub fn bounds_to_look_at(&self) -> Vec<&Check> {
        let printed = self.basis == ToleranceBasis::ReferenceRounding;
        let given = self.basis == ToleranceBasis::AttainableFloat64;
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

/// No bound in double precision is asked to be tighter.
const FLOOR: f64 = 1.01e-13;

fn largest(a: f64, b: f64) -> f64 {
    if a.is_nan() || b.is_nan() { f64::INFINITY } else { a.max(b) }
}

/// Compares quantities by name, never by position; `floor` widens absolute
/// and relative bounds to what a naive method can do.
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
        let seen = observed.get(name).cloned().unwrap_or_default();
        let needed = !matches!(bound, Bound::Interval(..));
        let wanted = match expected.get(name) {
            Some(values) => values.clone(),
            None if needed => {
                bail!("quantity `{name}` has no expected value");
            }
            None => Vec::new(),
        };
        let (error, margin) = measure(bound, &seen, &wanted, floor);
        checks.push(Check {
            quantity: name.clone(),
            bound: bound.clone(),
            observed: seen,
            expected: wanted,
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
    let pairs = || seen.iter().zip(wanted);
    let widened = |x: f64| floor.map_or(x, |f| if f > x { f } else { x });
    let over = |error: f64, limit: f64| {
        let margin = if error == 0.0 { 0.0 } else { error / limit };
        (error, margin)
    };
    let worst = |of: fn(f64, f64) -> f64| {
        pairs().fold(0.0, |worst, (s, w)| {
            let same = s == w;
            largest(worst, if same { 0.0 } else { of(*s, *w) })
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
        Bound::Coverage(trials) => {
            // One false alarm in a million, two-sided: 4.8917 sigma.
            let n = f64::from(*trials);
            pairs().fold((0.0, 0.0), |(e, m), (s, w)| {
                let error = (s - w).abs();
                let limit = 4.8917 * (w * (1.0 - w) / n).sqrt() + 0.5 / n;
                (largest(e, error), largest(m, error / limit))
            })
        }
    }
}

/// Runs a case and its wrong models, and gives the verdict.
pub fn run_case(case: &Case) -> CaseOutcome {
    let mut outcome = CaseOutcome {
        id: case.id.clone(),
        kind: case.kind,
        basis: case.tolerance.basis,
        checks: Vec::new(),
        rejections: Vec::new(),
        verdict: CaseVerdict::Error,
        messages: Vec::new(),
    };
    if let Err(error) = fill(&mut outcome, case) {
        outcome.messages.push(format!("{error:#}"));
        return outcome;
    }
    let holds = outcome.messages.is_empty();
    outcome.verdict = match (&case.status, holds) {
        (Status::Pass, true) => CaseVerdict::Pass,
        (Status::Pass, false) => CaseVerdict::Fail,
        (Status::KnownFailure { .. }, false) => CaseVerdict::KnownFailure,
        (Status::KnownFailure { .. }, true) => CaseVerdict::UnexpectedPass,
    };
    outcome
}

/// Runs the case alone, without its wrong models.
///
/// # Errors
/// An error where no answer can be given or judged.
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
        let rejection = strongest(name, &checks);
        if rejection.margin <= 1.0 {
            messages.push(format!("wrong model `{name}` passes"));
        }
        outcome.rejections.push(rejection);
    }
    Ok(())
}

/// Runs cases side by side; outcomes in the order of the cases.
pub fn run_all(cases: &[Case]) -> Vec<CaseOutcome> {
    use rayon::prelude::*;
    cases.par_iter().map(run_case).collect()
}

/// A rejection by the naive integrator proves something only if that
/// integrator passes with its rules right.
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
            bail!(
                "quantity `{name}` is expected by the method and by the case"
            );
        }
    }
    judge(&case.tolerance.bounds, &observed, &expected, floor)
}

fn strongest(model: &'static str, checks: &[Check]) -> Rejection {
    let mut rejection =
        Rejection { model, margin: 0.0, quantity: String::new() };
    for check in checks {
        if check.margin > rejection.margin {
            rejection.margin = check.margin;
            rejection.quantity.clone_from(&check.quantity);
        }
    }
    rejection
}

/// A broken bound with its values, as decimals and as bits.
fn describe(check: &Check) -> String {
    use std::fmt::Write as _;
    let mut text = format!(
        "{}: error {:e} against {:?} (margin {:.3})",
        check.quantity, check.error, check.bound, check.margin
    );
    if check.observed.len() != check.expected.len() {
        let (o, e) = (check.observed.len(), check.expected.len());
        let _ = write!(text, "; {o} values for {e} expected");
    }
    let pairs = check.observed.iter().zip(&check.expected);
    for (i, (o, e)) in pairs.enumerate().filter(|(_, (o, e))| o != e).take(4) {
        let _ = write!(
            text,
            "\n  [{i}] observed {o:e} ({:016x}), expected {e:e} ({:016x})",
            o.to_bits(),
            e.to_bits()
        );
    }
    text
}
