//! Tables of words and numbers.

use maud::{Markup, html};

use crate::table::{PlainTable, cells};

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
