//! One trial for every declared case, its kind in the name, and trials that
//! fail when something declared goes untested.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::ExitCode;
use std::sync::{Arc, OnceLock};

use libtest_mimic::{Arguments, Failed, Trial};
use rocking_proof::cases::{Case, Cost, FAMILIES, WrongModel, load_all};
use rocking_proof::methods::{all_methods, digits_csv};
use rocking_proof::verdict::{CaseOutcome, CaseVerdict, run_case, snapshot};

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let cases = match load_all() {
        Ok(cases) => cases,
        Err(error) => {
            eprintln!("{error}");
            return ExitCode::FAILURE;
        }
    };
    let mut trials = coverage(&cases);
    let quick = cases.into_iter().filter(|case| case.cost == Cost::Quick);
    let judged = |case| Arc::new(Judged { case, outcome: OnceLock::new() });
    let quick: Vec<Arc<Judged>> = quick.map(judged).collect();
    trials.extend(quick.iter().cloned().map(trial));
    // Last, when the outcomes are known.
    trials.extend(snapshots(quick));
    libtest_mimic::run(&arguments, trials).exit_code()
}

/// A case that is run once, whoever asks for its outcome.
struct Judged {
    case: Case,
    outcome: OnceLock<CaseOutcome>,
}

impl Judged {
    fn outcome(&self) -> &CaseOutcome {
        self.outcome.get_or_init(|| run_case(&self.case))
    }
}

fn trial(judged: Arc<Judged>) -> Trial {
    let kind = judged.case.kind.name();
    Trial::test(judged.case.id.clone(), move || {
        let (case, outcome) = (&judged.case, judged.outcome());
        if outcome.verdict == CaseVerdict::Pass {
            return Ok(());
        }
        let mut text = format!("{}: {}", case.claim, outcome.verdict.name());
        for message in &outcome.messages {
            text.push_str("\n- ");
            text.push_str(message);
        }
        Err(Failed::from(text))
    })
    .with_kind(kind)
}

fn coverage(cases: &[Case]) -> Vec<Trial> {
    let mut trials = Vec::new();
    let mut add = |name: &str, missing: Vec<String>| {
        let name = format!("coverage/{name}");
        trials.push(Trial::test(name, move || {
            if missing.is_empty() {
                Ok(())
            } else {
                Err(Failed::from(missing.join("\n")))
            }
        }));
    };
    let methods: BTreeSet<&str> =
        cases.iter().map(|case| case.method.as_str()).collect();
    let registered = || all_methods().map(|(name, _)| name);
    add("every-method-has-a-case", {
        let unused = registered().filter(|name| !methods.contains(*name));
        unused.map(|name| format!("no case uses `{name}`")).collect()
    });
    add("every-case-has-a-method", {
        let known = |name: &&&str| registered().all(|m| m != *name);
        methods.iter().filter(known).map(|m| format!("no `{m}`")).collect()
    });
    let rejected: BTreeSet<WrongModel> = cases
        .iter()
        .flat_map(|case| case.tolerance.reject.iter().copied())
        .collect();
    add("every-wrong-model-is-rejected", {
        let idle = WrongModel::ALL.iter().filter(|m| !rejected.contains(m));
        idle.map(|m| format!("no case rejects `{}`", m.name())).collect()
    });
    add("cases-are-found", {
        let families = FAMILIES.iter().map(|(family, _)| family);
        let empty = families.filter(|f| cases.iter().all(|c| c.family != **f));
        let mut missing: Vec<String> =
            empty.map(|f| format!("family `{f}` has no case")).collect();
        if cases.is_empty() {
            missing.push("no case at all".to_owned());
        }
        missing
    });
    trials
}

/// The committed results, byte for byte.
fn snapshots(quick: Vec<Arc<Judged>>) -> [Trial; 2] {
    let committed = |name: &str| {
        let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/data");
        std::fs::read_to_string(Path::new(data).join(name)).unwrap_or_default()
    };
    let verification = move || {
        let outcomes = quick.iter().map(|j| j.outcome().clone());
        let outcomes: Vec<CaseOutcome> = outcomes.collect();
        let own = snapshot::text(&outcomes);
        if committed("verification.json") == own {
            return Ok(());
        }
        Err(Failed::from(
            "reports/data/verification.json is stale: see what changed with \
             `rocking verify --check --out reports`, accept it with \
             `.ci/accept`",
        ))
    };
    let precision = move || {
        let own = digits_csv().map_err(|e| e.to_string())?;
        if committed("precision.csv") == own {
            return Ok(());
        }
        Err(Failed::from(
            "reports/data/precision.csv is stale: accept it with \
             `.ci/accept`",
        ))
    };
    [
        Trial::test("snapshot/verification-json", verification),
        Trial::test("snapshot/precision-csv", precision),
    ]
}
