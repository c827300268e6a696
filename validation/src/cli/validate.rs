//! `rocking validate`: the declared cases, judged.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use serde_json::json;

use super::{Failure, print_json, say};
use rocking_common::files::Outputs;
use rocking_proof::cases::{Case, Cost, FAMILIES, load_all};
use rocking_proof::methods::{digits, digits_csv};
use rocking_proof::verdict::{Outcome, Verdict, run_all, snapshot};
use rocking_report::diff::{self, Results};

/// Runs the declared cases. With `--out` it writes the results to
/// OUT/data/validation.json, and to OUT/data/precision.csv what single,
/// double and double-double precision reach.
#[derive(clap::Args)]
pub struct Args {
    /// Run this family alone.
    #[arg(long, conflicts_with = "out")]
    family: Option<String>,
    /// Run the long cases as well.
    #[arg(long, conflicts_with = "out")]
    full: bool,
    /// Compare with the results in OUT, write nothing, fail where they
    /// differ.
    #[arg(long, requires = "out")]
    check: bool,
    /// Folder of the reports; without it nothing is written.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Print JSON.
    #[arg(long)]
    json: bool,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for unreadable cases or an unknown family (status 2), for a
/// case that is not accepted and for results that differ (status 1).
pub fn run(args: &Args) -> Result<(), Failure> {
    let cases = selected(args)?;
    let outputs = match &args.out {
        Some(out) if !args.check => {
            let folder = out.join("data");
            std::fs::create_dir_all(&folder).map_err(|e| {
                Failure::input(format!(
                    "cannot make {}: {e}",
                    folder.display()
                ))
            })?;
            let mut outputs = Outputs::default();
            Some([
                outputs.open(&folder.join("validation.json"))?,
                outputs.open(&folder.join("precision.csv"))?,
            ])
        }
        _ => None,
    };
    let outcomes = run_all(&cases);
    if args.json {
        print_json(machine(&outcomes))?;
    } else {
        say(&people(&outcomes))?;
    }
    let refused = outcomes.iter().filter(|o| !o.verdict.is_accepted()).count();
    if refused > 0 {
        return Err(Failure::gate(format!(
            "{refused} of {} cases are not accepted",
            outcomes.len()
        )));
    }
    let Some(out) = &args.out else { return Ok(()) };
    let folder = out.join("data");
    let path = folder.join("validation.json");
    let text = snapshot::text(&cases, &outcomes);
    let digits_path = folder.join("precision.csv");
    let digits = digits_csv(&digits()?);
    if let Some([results, precision]) = outputs {
        results.write(text)?;
        return Ok(precision.write(digits)?);
    }
    compare(&path, &text)?;
    if digits == read(&digits_path)? {
        return Ok(());
    }
    Err(stale(&digits_path))
}

fn read(path: &Path) -> Result<String, Failure> {
    std::fs::read_to_string(path).map_err(|e| {
        Failure::input(format!("cannot read {}: {e}", path.display()))
    })
}

fn selected(args: &Args) -> Result<Vec<Case>, Failure> {
    let mut cases = load_all()?;
    if let Some(family) = &args.family {
        if FAMILIES.iter().all(|(name, _)| name != family) {
            let names: Vec<&str> =
                FAMILIES.iter().map(|(name, _)| *name).collect();
            return Err(Failure::input(format!(
                "no family `{family}`: expected one of {}",
                names.join(", ")
            )));
        }
        cases.retain(|case| case.family == *family);
    }
    cases.retain(|case| args.full || case.cost == Cost::Quick);
    Ok(cases)
}

fn compare(path: &Path, text: &str) -> Result<(), Failure> {
    let found = read(path)?;
    if found == text {
        return Ok(());
    }
    let old = Results::from_text(path, &found)?;
    let new = Results::from_text(path, text)?;
    // A declared tolerance is stated for every number.
    say(&diff::compare(&old, &new, 0.0)?.text(true))?;
    Err(stale(path))
}

fn stale(path: &Path) -> Failure {
    Failure::gate(format!(
        "{} is stale: `rocking validate --out DIR` accepts what is there now",
        path.display()
    ))
}

fn machine(outcomes: &[Outcome]) -> serde_json::Value {
    let cases: Vec<serde_json::Value> = outcomes
        .iter()
        .map(|outcome| {
            json!({
                "id": outcome.id,
                "kind": outcome.kind.name(),
                "verdict": outcome.verdict.name(),
                "margin": outcome.worst_margin(),
                "quantities": outcome.checks.iter().map(|c| json!({
                    "quantity": c.quantity,
                    "observed": &c.observed,
                    "expected": &c.expected,
                    "error": c.error,
                    "margin": c.margin,
                })).collect::<Vec<_>>(),
                "rejected": outcome.rejections.iter().map(|r| json!({
                    "model": r.model,
                    "margin": r.margin,
                    "quantity": r.quantity,
                })).collect::<Vec<_>>(),
                "messages": outcome.messages,
            })
        })
        .collect();
    json!({ "cases": cases })
}

pub(super) fn people(outcomes: &[Outcome]) -> String {
    let mut text = String::new();
    for outcome in outcomes {
        let _ = writeln!(
            text,
            "{:<15} {:>9.1e}  {} ({} wrong models rejected)",
            outcome.verdict.name(),
            outcome.worst_margin(),
            outcome.id,
            outcome.rejections.iter().filter(|r| r.margin > 1.0).count()
        );
        for message in &outcome.messages {
            let _ = writeln!(text, "    {}", message.replace('\n', "\n    "));
        }
    }
    let odd: Vec<String> = outcomes
        .iter()
        .flat_map(|outcome| {
            outcome.bounds_to_look_at().into_iter().map(|check| {
                let id = &outcome.id;
                format!("  {:.0e}  {id} {}", check.margin, check.quantity)
            })
        })
        .collect();
    if !odd.is_empty() {
        let _ = writeln!(
            text,
            "\nBounds to be looked at (margin below 1e-3 or above 0.9):\n{}",
            odd.join("\n")
        );
    }
    let mut kinds: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for outcome in outcomes {
        let key = (outcome.kind.name(), outcome.verdict.name());
        *kinds.entry(key).or_default() += 1;
    }
    let _ = writeln!(text);
    for ((kind, verdict), count) in kinds {
        let _ = writeln!(text, "{count:>5} {kind}: {verdict}");
    }
    let passed =
        outcomes.iter().filter(|o| o.verdict == Verdict::Pass).count();
    let _ = writeln!(text, "{passed} of {} cases pass", outcomes.len());
    text
}
