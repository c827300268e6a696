//! Tables of words and numbers.

use maud::{Markup, Render, html};

use rocking_common::table::PlainTable;

/// The table under its title.
pub fn plain(table: &PlainTable) -> Markup {
    html! {
        div id=(table.name) {
            h3 { (table.title) }
            (untitled(table))
        }
    }
}

/// The table alone.
pub fn untitled(table: &PlainTable) -> Markup {
    let body = html! {
        table {
            caption { span { (table.reading) } }
            (head(&table.header))
            tbody { @for row in &table.rows { (line(row)) } }
        }
    };
    scrolled(&table.title, body)
}

/// A box that scrolls sideways, so that the page does not.
pub fn scrolled(label: &str, body: Markup) -> Markup {
    html! {
        div.scroll role="region" aria-label=(label) tabindex="0" { (body) }
    }
}

/// The heads of the columns.
pub fn head<T: Render>(names: &[T]) -> Markup {
    html! {
        thead { tr { @for name in names { th scope="col" { (name) } } } }
    }
}

/// No line breaks between a number and its per cent, or within a power.
pub fn joined(text: &str) -> String {
    let text = text.replace(" %", "\u{a0}%");
    ('0'..='9').fold(text, |text, digit| {
        let (power, whole) =
            (format!("e-{digit}"), format!("e-\u{2060}{digit}"));
        text.replace(&power, &whole)
    })
}

fn line(cells: &[String]) -> Markup {
    html! {
        tr {
            @for (k, cell) in cells.iter().enumerate() {
                @if k == 0 {
                    th scope="row" { (joined(cell)) }
                } @else {
                    td { (joined(cell)) }
                }
            }
        }
    }
}
