//! `rocking diff`: what changed between two results.

use std::path::PathBuf;

use super::shared::JsonArg;
use super::show::json;
use super::study::REPORT;
use crate::failure::{Failure, ensure};
use crate::terminal::{print, say};
use rocking_report::diff::{ResultFiles, compare};

/// What changed between two results, and whether it matters.
///
/// OLD and NEW are each a folder of a study, a folder of reports, or one file:
/// findings.json or verification.json. Without them, the committed reports are
/// compared with what `rocking study` wrote last. The first lines name the
/// settings and records that changed, the effect on overturning intensities,
/// and how many answers, verdicts on statements (seen, exists) and numbers
/// changed. A number is relevant if it moved by more than the smallest effect
/// of interest: 5 % of a response ratio, 10 % of a median intensity or a
/// dispersion, 10 points of a share, 0.05 of a probability; in a reference
/// case, by more than its tolerance. Relevant numbers are sorted by their
/// change divided by the half-widths of both intervals (u) or, without
/// intervals, by that effect; numbers from fewer than 30 records (n) come
/// last. Exits with 1 if a change is relevant: an answer, a word, a setting,
/// the records, such a number, or a result that one side lacks.
#[derive(clap::Args)]
pub struct DiffCommand {
    /// Results before.
    #[arg(value_name = "OLD", requires = "new", default_value = "reports")]
    old: PathBuf,
    /// Results after.
    #[arg(value_name = "NEW", default_value = REPORT)]
    new: PathBuf,
    /// List every change, including those that are not relevant, as JSON does.
    #[arg(long, conflicts_with_all = ["json", "markdown"])]
    all: bool,
    /// Print Markdown for a pull request: the text in a fence.
    #[arg(long, conflicts_with = "json")]
    markdown: bool,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking diff`.
///
/// # Errors
/// [`Failure`] for results that cannot be read or have nothing in common
/// (status 2), and for a relevant change (status 1).
pub fn run_diff(args: &DiffCommand) -> Result<(), Failure> {
    ensure!(
        args.new.as_os_str() != REPORT || args.new.exists(),
        "no folder {REPORT}: expected what `rocking study` writes there"
    );
    let (old, new) =
        (ResultFiles::read(&args.old)?, ResultFiles::read(&args.new)?);
    let comparison = compare(&old, &new)?;
    if args.json.json {
        print(&json(&comparison)?)?;
    } else if args.markdown {
        let text = comparison.text(false);
        print(&format!("## What changed\n\n```text\n{text}```\n"))?;
    } else {
        say(&comparison.text(args.all))?;
    }
    match comparison.relevant {
        0 => Ok(()),
        1 => Err(Failure::gate("1 relevant change")),
        n => Err(Failure::gate(format!("{n} relevant changes"))),
    }
}
