//! What the paper's procedure does: questions that the paper leaves open,
//! answered with figures beside its claims.

mod answer;
mod contents;
mod grid;
mod levels;
mod nulls;
mod options;
mod power;
mod recorded;
mod suites;
mod trimming;

pub use answer::Answer;

use crate::inference::Draws;
use crate::results::Results;
use rocking_common::findings::Question;

/// All answers, in a fixed order.
///
/// # Errors
/// Where a number cannot be computed.
pub fn all(results: &Results, draws: &Draws) -> anyhow::Result<Vec<Answer>> {
    Ok(vec![
        grid::answer(results)?,
        power::answer(results)?,
        options::answer(results)?,
        suites::answer(results)?,
        recorded::answer(results)?,
        contents::answer(results, draws)?,
    ])
}

/// Questions and answers as findings.
#[must_use]
pub fn findings(answers: &[Answer]) -> Vec<Question> {
    let one = |answer: &Answer| Question {
        id: answer.id.into(),
        question: answer.question.into(),
        answer: answer.answer.clone(),
        data: format!("{}.csv", answer.id),
    };
    answers.iter().map(one).collect()
}

/// The answers' CSV files, by name.
pub fn files(answers: &[Answer]) -> impl Iterator<Item = (String, Vec<u8>)> {
    let files = answers.iter().flat_map(|answer| answer.files.iter().cloned());
    files.map(|(name, csv)| (name, csv.into_bytes()))
}
