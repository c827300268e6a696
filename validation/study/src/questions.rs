//! What the paper's procedure does: questions that the paper leaves open,
//! answered with figures beside its claims.

mod contents;
mod equivalence;
mod grid;
mod inversion;
mod levels;
mod measures;
mod nulls;
mod options;
mod power;
mod recorded;
mod robustness;
mod suites;
mod surface;
mod trimming;

use crate::analyses::SuiteResults;
use crate::error::StudyError;
use crate::inference::Draws;
use crate::results::Results;
use rocking_common::findings::Question;
use rocking_common::table::{PlainTable, Table};
use rocking_draw::figures::Figure;

/// A question with its answer and the numbers behind it.
pub struct Answer {
    /// Short name, also of the CSV: `grid`.
    pub id: &'static str,
    /// What is asked.
    pub question: &'static str,
    /// What came out, in a sentence or two made from the numbers.
    pub answer: String,
    /// The numbers, full and as CSV.
    pub csv: String,
    /// What the page shows of them.
    pub tables: Vec<PlainTable>,
    /// Drawings.
    pub figures: Vec<Figure>,
    /// Other CSV files, by name.
    pub files: Vec<(String, String)>,
}

impl Answer {
    fn new(id: &'static str, question: &'static str, answer: String) -> Self {
        Self {
            id,
            question,
            answer,
            csv: String::new(),
            tables: Vec::new(),
            figures: Vec::new(),
            files: Vec::new(),
        }
    }
}

/// All answers, in a fixed order.
///
/// # Errors
/// [`StudyError`] where a number cannot be computed.
pub fn all(
    results: &Results,
    draws: &Draws,
    full: bool,
) -> Result<Vec<Answer>, StudyError> {
    Ok(vec![
        grid::answer(results)?,
        nulls::answer(results)?,
        levels::answer(results)?,
        power::answer(results)?,
        robustness::answer(results)?,
        equivalence::answer(results)?,
        inversion::answer(results)?,
        options::answer(results, full)?,
        trimming::answer(results)?,
        suites::answer(results)?,
        recorded::answer(results)?,
        surface::answer(results)?,
        measures::answer(results, draws)?,
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
    answers.iter().flat_map(|answer| {
        let own = (format!("{}.csv", answer.id), answer.csv.clone());
        let all = std::iter::once(own).chain(answer.files.iter().cloned());
        all.map(|(name, csv)| (name, csv.into_bytes()))
    })
}

/// Rows for a CSV and a table of the page at once.
struct Rows {
    csv: Table,
    header: Vec<String>,
    shown: Vec<Vec<String>>,
}

impl Rows {
    fn new(header: &[&str]) -> Self {
        Self {
            csv: Table::new(header),
            header: header.iter().map(|h| h.replace('_', " ")).collect(),
            shown: Vec::new(),
        }
    }

    /// A row of the CSV, and of the page if it is `shown` there.
    fn row(&mut self, shown: bool, cells: Vec<Cell>) {
        if shown {
            self.shown.push(cells.iter().map(Cell::short).collect());
        }
        self.csv.row(cells.iter().map(Cell::full));
    }

    fn finish(self, answer: &mut Answer, title: &str, reading: &str) {
        answer.csv = self.csv.finish();
        answer.tables.push(PlainTable {
            name: format!("table-{}", answer.id),
            title: title.into(),
            reading: format!(
                "{} {reading} All rows: {}.csv.",
                answer.answer, answer.id
            ),
            header: self.header,
            rows: self.shown,
        });
    }
}

/// One cell.
enum Cell {
    Word(String),
    Count(usize),
    /// A number with so many decimals on the page.
    Number(f64, usize),
}

impl Cell {
    fn word(text: impl Into<String>) -> Self {
        Self::Word(text.into())
    }

    fn full(&self) -> String {
        match self {
            Self::Word(text) => text.clone(),
            Self::Count(count) => count.to_string(),
            Self::Number(x, _) => rocking_common::table::number(*x),
        }
    }

    fn short(&self) -> String {
        match self {
            Self::Number(x, _) if !x.is_finite() => {
                if x.is_nan() {
                    "–".into()
                } else {
                    self.full()
                }
            }
            Self::Number(x, decimals) => format!("{x:.decimals$}"),
            _ => self.full(),
        }
    }
}

/// Mean of some numbers; NaN of none.
fn mean(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |sum, x| sum + x) / values.len() as f64
}

fn both(results: &Results) -> [&SuiteResults; 2] {
    [&results.ordinary, &results.pulse]
}
