//! Answers, and the tables behind them.

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
    pub(super) fn new(
        id: &'static str,
        question: &'static str,
        answer: String,
    ) -> Self {
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

/// One of several tables that answer a question.
pub struct Part {
    /// Short name, also of the CSV.
    pub id: &'static str,
    /// What it adds to the answer.
    pub words: String,
    /// What the page shows.
    pub table: PlainTable,
    /// The numbers.
    pub csv: String,
}

/// Rows for a CSV and a table of the page at once: each cell stands beside
/// the name of its column.
#[derive(Default)]
pub struct Rows {
    csv: Option<Table>,
    header: Vec<&'static str>,
    shown: Vec<Vec<String>>,
}

impl Rows {
    /// A row of the CSV and of the page.
    pub fn row(&mut self, cells: Vec<(&'static str, Cell)>) {
        self.row_if(true, cells);
    }

    /// A row of the CSV, and of the page if it is `shown` there.
    pub fn row_if(&mut self, shown: bool, cells: Vec<(&'static str, Cell)>) {
        let names: Vec<&str> = cells.iter().map(|(name, _)| *name).collect();
        let csv = self.csv.get_or_insert_with(|| Table::new(&names));
        csv.row(cells.iter().map(|(_, cell)| cell.full()));
        if shown {
            let cells = cells.iter().map(|(_, cell)| cell.short());
            self.shown.push(cells.collect());
        }
        self.header = cells.into_iter().map(|(name, _)| name).collect();
    }

    /// The CSV alone.
    pub fn csv(self) -> String {
        self.csv.map_or_else(String::new, Table::finish)
    }

    /// The answer to a question, with these rows under a title.
    pub fn answer(
        self,
        id: &'static str,
        question: &'static str,
        answer: String,
        title: &str,
        reading: &str,
    ) -> Answer {
        let reading = format!("{answer}\n{reading}");
        let Part { table, csv, .. } = self.part(id, "", title, &reading);
        let tables = vec![table];
        Answer { csv, tables, ..Answer::new(id, question, answer) }
    }

    /// A part of an answer, with these rows under a title.
    pub fn part(
        self,
        id: &'static str,
        words: impl Into<String>,
        title: &str,
        reading: &str,
    ) -> Part {
        let reading = format!("{reading} All rows: {id}.csv.");
        let table = self.table(format!("table-{id}"), title, reading);
        Part { id, words: words.into(), table, csv: self.csv() }
    }

    /// A table of the page with the rows shown.
    pub fn table(
        &self,
        name: impl Into<String>,
        title: &str,
        reading: impl Into<String>,
    ) -> PlainTable {
        PlainTable {
            name: name.into(),
            title: title.into(),
            reading: reading.into(),
            header: self.header.iter().map(|h| h.replace('_', " ")).collect(),
            rows: self.shown.clone(),
        }
    }
}

/// One cell.
pub enum Cell {
    Word(String),
    Count(usize),
    /// A number with so many decimals on the page.
    Number(f64, usize),
}

impl Cell {
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

pub fn word(text: impl Into<String>) -> Cell {
    Cell::Word(text.into())
}

pub fn count(of: usize) -> Cell {
    Cell::Count(of)
}

pub fn number(x: f64, decimals: usize) -> Cell {
    Cell::Number(x, decimals)
}
