//! `rocking verify`: the declared cases, judged.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use serde::Serialize;

use super::shared::JsonArg;
use crate::failure::{AtPlace as _, Failure, ensure};
use crate::input;
use crate::terminal::say;
use rocking_common::files::Outputs;
use rocking_proof::cases::{Case, Cost, FAMILIES, load_all};
use rocking_proof::methods::digits_csv;
use rocking_proof::verdict::{CaseOutcome, CaseVerdict, run_all, snapshot};
use rocking_report::diff::{self, ResultFiles};

// With `--out` it writes the results to OUT/data/verification.json, and to
// OUT/data/precision.csv what single, double and double-double precision
// reach.
/// Runs the reference cases against closed forms and other solutions.
#[derive(clap::Args)]
pub struct VerifyCommand {
    /// Run only this family.
    #[arg(long, conflicts_with = "out")]
    family: Option<String>,
    /// Run the long cases as well.
    #[arg(long, conflicts_with = "out")]
    full: bool,
    /// Compare with the results in OUT, write nothing, and fail if they
    /// differ.
    #[arg(long, requires = "out")]
    check: bool,
    /// Folder of the reports; without it, nothing is written.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking verify`.
///
/// # Errors
/// [`Failure`] for unreadable cases or an unknown family (status 2), for a
/// case that is not accepted and for results that differ (status 1).
pub fn run_verify(args: &VerifyCommand) -> Result<(), Failure> {
    let cases = selected(args)?;
    let outputs = match &args.out {
        Some(out) if !args.check => {
            let folder = out.join("data");
            let place = format_args!("cannot make {}", folder.display());
            std::fs::create_dir_all(&folder).at(place)?;
            let mut outputs = Outputs::default();
            Some([
                outputs.open(&folder.join("verification.json"))?,
                outputs.open(&folder.join("precision.csv"))?,
            ])
        }
        _ => None,
    };
    let outcomes = run_all(&cases);
    let summary = VerifySummary::of(&outcomes);
    let sentence = "{passed} of {of} cases pass.";
    args.json.summarise(&Outputs::default(), &[sentence], &summary)?;
    let (of, refused) = (summary.of, summary.of - summary.passed);
    if refused > 0 {
        let words = format!("{refused} of {of} cases are not accepted");
        return Err(Failure::gate(words));
    }
    let Some(out) = &args.out else { return Ok(()) };
    let folder = out.join("data");
    let path = folder.join("verification.json");
    let text = snapshot::text(&outcomes);
    let digits_path = folder.join("precision.csv");
    let digits = digits_csv()?;
    if let Some([results, precision]) = outputs {
        results.write(text)?;
        return Ok(precision.write(digits)?);
    }
    compare(&path, &text)?;
    if digits == input::text(&digits_path)? {
        return Ok(());
    }
    Err(stale(&digits_path))
}

fn selected(args: &VerifyCommand) -> Result<Vec<Case>, Failure> {
    let mut cases = load_all()?;
    if let Some(family) = &args.family {
        let names: Vec<&str> = FAMILIES.iter().map(|f| f.0).collect();
        ensure!(
            names.contains(&family.as_str()),
            "no family `{family}`: expected one of {}",
            names.join(", ")
        );
        cases.retain(|case| case.family == *family);
    }
    cases.retain(|case| args.full || case.cost == Cost::Quick);
    Ok(cases)
}

fn compare(path: &Path, text: &str) -> Result<(), Failure> {
    let found = input::text(path)?;
    if found == text {
        return Ok(());
    }
    let old = ResultFiles::from_text(path, &found)?;
    let new = ResultFiles::from_text(path, text)?;
    say(&diff::compare(&old, &new)?.text(true))?;
    Err(stale(path))
}

fn stale(path: &Path) -> Failure {
    Failure::gate(format!(
        "{} is stale: `rocking verify --out DIR` accepts what is there now",
        path.display()
    ))
}

/// Results of the cases.
#[derive(Default, Serialize)]
struct VerifySummary<'a> {
    cases: Vec<CaseMargin<'a>>,
    messages: Vec<CaseMessage<'a>>,
    /// Checks whose margin is below 1e-3 or above 0.9.
    bounds_to_look_at: Vec<CloseBound<'a>>,
    kinds: Vec<VerdictCount<'a>>,
    passed: usize,
    of: usize,
}

#[derive(Serialize)]
struct CaseMargin<'a> {
    case: &'a str,
    verdict: &'static str,
    margin: f64,
    wrong_models_rejected: usize,
}

#[derive(Serialize)]
struct CaseMessage<'a> {
    case: &'a str,
    message: &'a str,
}

#[derive(Serialize)]
struct CloseBound<'a> {
    case: &'a str,
    quantity: &'a str,
    margin: f64,
}

#[derive(Serialize)]
struct VerdictCount<'a> {
    kind: &'a str,
    verdict: &'a str,
    cases: usize,
}

impl<'a> VerifySummary<'a> {
    fn of(outcomes: &'a [CaseOutcome]) -> Self {
        let mut found = Self { of: outcomes.len(), ..Self::default() };
        let mut kinds: BTreeMap<(&str, &str), usize> = BTreeMap::new();
        for outcome in outcomes {
            let (case, verdict) = (&*outcome.case.id, outcome.verdict.name());
            let rejected = outcome.rejections.values();
            let rejected = rejected.filter(|r| r.margin.0 > 1.0);
            found.cases.push(CaseMargin {
                case,
                verdict,
                margin: outcome.worst_margin(),
                wrong_models_rejected: rejected.count(),
            });
            let said = outcome.messages.iter().flat_map(|all| all.lines());
            let said = said.map(|message| CaseMessage { case, message });
            found.messages.extend(said);
            let close = outcome.bounds_to_look_at().into_iter();
            found.bounds_to_look_at.extend(close.map(|check| CloseBound {
                case,
                quantity: &check.quantity,
                margin: check.margin,
            }));
            *kinds.entry((outcome.case.kind.name(), verdict)).or_default() +=
                1;
            found.passed += usize::from(outcome.verdict == CaseVerdict::Pass);
        }
        let kinds = kinds.into_iter();
        let count =
            |((kind, verdict), cases)| VerdictCount { kind, verdict, cases };
        found.kinds = kinds.map(count).collect();
        found
    }
}
