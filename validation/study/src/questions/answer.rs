//! Answers and their tables.

use crate::words::{TableWords, table_words};
use rocking_common::table::{PlainTable, Table};
use rocking_draw::figures::Figure;

/// A question with its answer and its numbers.
#[derive(Default)]
pub struct StudyAnswer {
    /// Short name, also of the first file: `grid`.
    pub id: &'static str,
    /// The question.
    pub question: &'static str,
    /// The answer, one or two sentences made from the numbers.
    pub answer: String,
    /// The tables that the page shows.
    pub tables: Vec<PlainTable>,
    /// Drawings.
    pub figures: Vec<Figure>,
    /// CSV files by name, the numbers of the first table first.
    pub files: Vec<(String, String)>,
}

impl StudyAnswer {
    /// Adds a further part: its words, tables and files.
    pub(super) fn beside(mut self, part: Self) -> Self {
        self.answer += &format!("\n{}", part.answer);
        self.tables.extend(part.tables);
        self.files.extend(part.files);
        self
    }
}

/// Rows of a CSV and of a table of the page: each cell stands beside the name of
/// its column.
#[derive(Default)]
pub struct Rows {
    csv: Option<Table>,
    header: Vec<&'static str>,
    shown: Vec<Vec<String>>,
}

impl Rows {
    /// A row of the CSV and of the page.
    pub fn row(&mut self, cells: Vec<(&'static str, TableCell)>) {
        self.row_if(true, cells);
    }

    /// A row of the CSV, and of the page if it is `shown` there.
    pub fn row_if(
        &mut self,
        shown: bool,
        cells: Vec<(&'static str, TableCell)>,
    ) {
        let names: Vec<&str> = cells.iter().map(|(name, _)| *name).collect();
        let csv = self.csv.get_or_insert_with(|| Table::new(&names));
        csv.row(cells.iter().map(|(_, cell)| cell.full.clone()));
        let (header, cells): (Vec<&str>, Vec<TableCell>) =
            cells.into_iter().unzip();
        if shown {
            let cells = cells.into_iter().map(|cell| cell.short);
            self.shown.push(cells.collect());
        }
        self.header = header;
    }

    /// The text of the CSV.
    pub fn csv(self) -> String {
        self.csv.map_or_else(String::new, Table::finish)
    }

    /// An answer, or a part of one, with these rows. `words.toml` has the other
    /// words.
    pub fn answer(self, id: &'static str, answer: String) -> StudyAnswer {
        let TableWords { question, reading, .. } = table_words(id);
        let above = match question.as_str() {
            "" => String::new(),
            _ => format!("{answer}\n"),
        };
        let mut table = self.table(id);
        table.reading = format!("{above}{reading} All rows: {id}.csv.");
        StudyAnswer {
            id,
            question,
            answer,
            tables: vec![table],
            files: vec![(format!("{id}.csv"), self.csv())],
            ..StudyAnswer::default()
        }
    }

    /// A table of the page with the shown rows. `words.toml` has its words.
    pub fn table(&self, id: &str) -> PlainTable {
        let TableWords { title, reading, .. } = table_words(id);
        PlainTable {
            name: format!("table-{id}"),
            title: title.clone(),
            reading: reading.clone(),
            header: self.header.iter().map(|h| h.replace('_', " ")).collect(),
            rows: self.shown.clone(),
        }
    }
}

/// A cell: in the CSV, and on the page.
pub struct TableCell {
    full: String,
    short: String,
}

pub fn word(text: impl Into<String>) -> TableCell {
    let full = text.into();
    TableCell { short: full.clone(), full }
}

pub fn count(of: usize) -> TableCell {
    word(of.to_string())
}

/// A number with its decimals on the page.
pub fn number(x: f64, decimals: usize) -> TableCell {
    let full = rocking_common::table::number(x);
    let short = match x.is_finite() {
        true => format!("{x:.decimals$}"),
        false if x.is_nan() => "–".into(),
        false => full.clone(),
    };
    TableCell { full, short }
}
