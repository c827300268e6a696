//! Tables of words and numbers.

use maud::{Markup, html};

/// A table with its title.
#[derive(Debug, Clone, Default)]
pub struct PlainTable {
    /// Unique name, also the anchor.
    pub name: String,
    /// Title: `Table 1. The 15 blocks`.
    pub title: String,
    /// What it says, in a sentence.
    pub reading: String,
    /// Column heads with units.
    pub header: Vec<String>,
    /// Rows; the first cell names the row.
    pub rows: Vec<Vec<String>>,
}

impl PlainTable {
    /// A table from CSV text.
    #[must_use]
    pub fn from_csv(
        name: &str,
        title: &str,
        reading: &str,
        csv: &str,
    ) -> Self {
        let mut lines = csv.lines().map(cells);
        Self {
            name: name.into(),
            title: title.into(),
            reading: reading.into(),
            header: lines.next().unwrap_or_default(),
            rows: lines.collect(),
        }
    }
}

/// The table under its title.
pub fn plain(table: &PlainTable) -> Markup {
    let body = html! {
        table {
            caption { (table.reading) }
            (head(&table.header))
            tbody { @for row in &table.rows { (line(row)) } }
        }
    };
    html! {
        div id=(table.name) {
            h3 { (table.title) }
            (scrolled(&table.title, body))
        }
    }
}

/// The first rows of a CSV text as a table; the caption says how many there
/// are.
pub fn preview(name: &str, csv: &str, most: usize) -> Markup {
    let mut lines = csv.lines();
    let header = lines.next().map(cells).unwrap_or_default();
    let rows: Vec<&str> = lines.collect();
    let shown = rows.len().min(most);
    let body = html! {
        table.data {
            caption { "Rows 1 to " (shown) " of " (rows.len()) "." }
            (head(&header))
            tbody { @for row in &rows[..shown] { (line(&cells(row))) } }
        }
    };
    scrolled(&format!("Data of {name}"), body)
}

/// A box that scrolls sideways, so that the page does not.
pub fn scrolled(label: &str, body: Markup) -> Markup {
    html! {
        div.scroll role="region" aria-label=(label) tabindex="0" { (body) }
    }
}

fn head(names: &[String]) -> Markup {
    html! {
        thead { tr { @for name in names { th scope="col" { (name) } } } }
    }
}

fn line(cells: &[String]) -> Markup {
    html! {
        tr {
            @for (k, cell) in cells.iter().enumerate() {
                @if k == 0 {
                    th scope="row" { (cell) }
                } @else {
                    td { (cell) }
                }
            }
        }
    }
}

/// Cells of a line of CSV; a quoted cell has no line break in it.
pub fn cells(line: &str) -> Vec<String> {
    let mut cells = vec![String::new()];
    let mut quoted = false;
    let mut characters = line.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '"' if quoted && characters.peek() == Some(&'"') => {
                characters.next();
                push(&mut cells, '"');
            }
            '"' => quoted = !quoted,
            ',' if !quoted => cells.push(String::new()),
            _ => push(&mut cells, c),
        }
    }
    cells
}

fn push(cells: &mut [String], c: char) {
    if let Some(cell) = cells.last_mut() {
        cell.push(c);
    }
}
