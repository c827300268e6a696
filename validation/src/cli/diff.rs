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
/// reports and what `rocking study` wrote last. Verdicts come first, then numbers
/// by the size of their change over what it may be: the 95 % interval of a
/// finding, the tolerance of a case; those without either come last. Ends
/// with 1 where a verdict, a setting or a number beyond its uncertainty
/// changed, or a claim or a case is on one side only.
#[derive(clap::Args)]
pub struct Args {
    /// Results before.
    #[arg(value_name = "OLD", requires = "new", default_value = "reports")]
    old: PathBuf,
    /// Results after.
    #[arg(value_name = "NEW", default_value = REPORT)]
    new: PathBuf,
    /// Relative change that is significant where a finding states no
    /// interval.
    #[arg(long, value_name = "SHARE", default_value_t = 0.01)]
    relative: f64,
    /// List every change, also those within their uncertainty; JSON always
    /// does.
    #[arg(long, conflicts_with = "json")]
    all: bool,
    /// Print Markdown for a pull request.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
    #[command(flatten)]
    json: JsonArg,
}

#[derive(Serialize)]
struct Shown<'a> {
    identical: bool,
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
    if !(args.relative >= 0.0 && args.relative.is_finite()) {
        return Err(Failure::input(format!(
            "--relative {}: expected a share, 0 or more",
            args.relative
        )));
    }
    if args.new.as_os_str() == REPORT && !args.new.exists() {
        return Err(Failure::input(format!(
            "no folder {REPORT}: expected what `rocking study` writes there"
        )));
    }
    let (old, new) = (Results::read(&args.old)?, Results::read(&args.new)?);
    let comparison = compare(&old, &new, args.relative)?;
    if args.json.json {
        args.json.show(&Shown {
            identical: comparison.is_identical(),
            significant: comparison.significant(),
            comparison: &comparison,
        })?;
    } else if args.markdown {
        print(&comparison.markdown(args.all))?;
    } else {
        say(&comparison.text(args.all))?;
    }
    match comparison.significant() {
        0 => Ok(()),
        1 => Err(Failure::gate("1 significant change")),
        n => Err(Failure::gate(format!("{n} significant changes"))),
    }
}
