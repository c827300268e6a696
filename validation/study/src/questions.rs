//! Questions that the paper leaves open, answered with tables and figures.

mod answer;
mod grid;
mod nulls;
mod options;
mod recorded;
mod suites;
mod trimming;

pub use answer::StudyAnswer;

use crate::results::StudyResults;
use rocking_common::findings::Question;

/// All answers, in a fixed order.
///
/// # Errors
/// If a number cannot be computed.
pub fn study_answers(
    results: &StudyResults,
) -> anyhow::Result<Vec<StudyAnswer>> {
    Ok(vec![
        grid::answer(results)?,
        options::answer(results)?,
        suites::answer(results)?,
        recorded::answer(results)?,
    ])
}

/// Questions and answers as findings.
pub fn findings(answers: &[StudyAnswer]) -> Vec<Question> {
    let one = |answer: &StudyAnswer| Question {
        id: answer.id.into(),
        question: answer.question.into(),
        answer: answer.answer.clone(),
        data: format!("{}.csv", answer.id),
    };
    answers.iter().map(one).collect()
}

/// The CSV files of the answers, by name.
pub fn answer_files(
    answers: &[StudyAnswer],
) -> impl Iterator<Item = (String, Vec<u8>)> {
    let files = answers.iter().flat_map(|answer| answer.files.iter().cloned());
    files.map(|(name, csv)| (name, csv.into_bytes()))
}
