//! `rocking diff`: what changed between two results.

use std::path::PathBuf;

use serde::Serialize;

use super::shared::JsonArg;
use super::study::REPORT;
use crate::failure::Failure;
use crate::terminal::{print, say};
use rocking_report::diff::{Comparison, Results, compare};

/// What changed between two results, and whether it matters.
///
/// OLD and NEW are each a folder of a study, a folder of reports, or one
/// file: findings.json or validation.json; without them, the committed
/// reports and what `rocking study` wrote last. Answers and verdicts come
/// first, then numbers by kind, each against the smallest effect of interest:
/// 5 % of a response ratio, 10 % of a median intensity or a dispersion, 10
/// points of a share, 0.05 of a probability; a number of a declared case
/// against its tolerance. Ends with 1 where an answer, a verdict or a setting
/// changed, a number moved by more than that, or a claim, a case or a number
/// is on one side only.
#[derive(clap::Args)]
pub struct Args {
    /// Results before.
    #[arg(value_name = "OLD", requires = "new", default_value = "reports")]
    old: PathBuf,
    /// Results after.
    #[arg(value_name = "NEW", default_value = REPORT)]
    new: PathBuf,
    /// List every change, also those that do not matter; JSON always does.
    #[arg(long, conflicts_with_all = ["json", "markdown"])]
    all: bool,
    /// Print Markdown for a pull request, of 20,000 characters at most.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Serialize)]
struct Shown<'a> {
    significant: usize,
    #[serde(flatten)]
    comparison: &'a Comparison,
}

/// Runs the command.
///
/// # Errors
/// [`Failure`] for results that cannot be read or have nothing in common
/// (status 2), and for a significant change (status 1).
pub fn run(args: &Args) -> Result<(), Failure> {
    if args.new.as_os_str() == REPORT && !args.new.exists() {
        return Err(Failure::input(format!(
            "no folder {REPORT}: expected what `rocking study` writes there"
        )));
    }
    let (old, new) = (Results::read(&args.old)?, Results::read(&args.new)?);
    let comparison = compare(&old, &new)?;
    if args.json.json {
        args.json.show(&Shown {
            significant: comparison.significant(),
            comparison: &comparison,
        })?;
    } else if args.markdown {
        print(&comparison.markdown())?;
    } else {
        say(&comparison.text(args.all))?;
    }
    match comparison.significant() {
        0 => Ok(()),
        1 => Err(Failure::gate("1 significant change")),
        n => Err(Failure::gate(format!("{n} significant changes"))),
    }
}
