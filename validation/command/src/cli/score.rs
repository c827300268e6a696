//! `rocking score`: how right a rocking code is, and what is wrong with it.

use std::path::PathBuf;

use rocking_common::files::Outputs;
use rocking_report::scored::page;
use rocking_score::{Answers, CodeVerdict, own_answers, score};

use super::shared::JsonArg;
use crate::failure::Failure;
use crate::input;

/// Scores the answers of any rocking code, and names its mistake.
///
/// ANSWERS.csv has the columns `scene,quantity,value`. The scenes, in SI
/// units, and the quantities to compute are in fixtures/benchmark; its README
/// explains them. A missing line counts as unanswered. Digits are -log10 of
/// the relative error, up to the limit of double precision. The diagnosis
/// compares all answers with those of 34 wrong models and 15 pairs of them. It
/// names the mistake that explains the answers, or several that these answers
/// cannot distinguish. Otherwise it reports that the answers are right, right
/// but coarse, or wrong for an unknown reason: then it gives the quantities,
/// excitations or equations that deviate, and their factor if they have one in
/// common.
#[derive(clap::Args)]
#[command(after_help = "Examples:\n  \
    rocking score answers.csv\n  \
    rocking score answers.csv --out page.html\n  \
    rocking score --write-answers ours.csv")]
pub struct ScoreCommand {
    /// Answers of a code; `-` is standard input.
    #[arg(
        value_name = "ANSWERS.csv",
        required_unless_present = "write_answers"
    )]
    answers: Option<PathBuf>,
    /// Write a page with a figure: digits against difficulty, compared with
    /// known codes.
    #[arg(long, value_name = "PAGE.html", requires = "answers")]
    out: Option<PathBuf>,
    /// Write the answers of this program; `-` is standard output.
    #[arg(
        long,
        value_name = "OUT.csv",
        conflicts_with_all = ["answers", "out", "json"]
    )]
    write_answers: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArg,
}

/// Runs `rocking score`.
///
/// # Errors
/// [`Failure`] for answers that are refused.
pub fn run_score(args: &ScoreCommand) -> Result<(), Failure> {
    let mut outputs = Outputs::of(args.answers.iter().cloned().collect());
    if let Some(out) = outputs.open_some(args.write_answers.as_ref())? {
        out.write(own_answers().map_err(Failure::input)?.csv())?;
    }
    let Some(path) = &args.answers else { return Ok(()) };
    let out = outputs.open_some(args.out.as_ref())?;
    let answers = Answers::parse(&input::text(path)?, path)?;
    let found = score(&answers);
    if let Some(out) = out {
        out.write(page(&found))?;
    }
    let verdict = match found.diagnosis.verdict {
        CodeVerdict::None => "They are right within their scatter.",
        CodeVerdict::Known => "A known mistake explains them.",
        CodeVerdict::Coarse => "They are right, but coarse.",
        CodeVerdict::Unknown => "No known mistake explains them.",
        CodeVerdict::TooFew => "They are too few for a diagnosis.",
    };
    let mut lines = found.diagnosis.remarks.clone();
    let sentence = format!(
        "The code gives {} of {} answers. {verdict}",
        found.answered, found.asked
    );
    lines.insert(0, sentence);
    args.json.show(&[&lines.join("\n")], &found)
}
