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
    let digit = |c: char| c.is_ascii_digit();
    let mut parts = text.split("e-");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let power = out.ends_with(digit) && part.starts_with(digit);
        out += if power { "e-\u{2060}" } else { "e-" };
        out += part;
    }
    out
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

#[cfg(test)]
mod tests {
    use super::joined;

    #[test]
    fn numbers_stay_whole_and_names_stay_as_they_are() {
        assert_eq!(joined("5 % of 1e-9."), "5\u{a0}% of 1e-\u{2060}9.");
        for name in ["data/table-01.csv", "one-sine-0", "e-1", ""] {
            assert_eq!(joined(name), name);
        }
    }
}
