//! Parts that sections share: paragraphs, lists, tables, figures, and parts
//! that are folded on a screen.

use maud::{Markup, html};

use rocking_common::table::PlainTable;
use rocking_draw::figures::Figure;
use rocking_draw::page;
use rocking_draw::page::table::{self, joined};

/// A heading whose part is folded on a screen.
pub fn folded(id: &str, title: &str, body: &Markup) -> Markup {
    html! {
        details.part id=(id) {
            summary { h3 { (title) } }
            (body)
        }
    }
}

/// Names and values.
pub fn list(pairs: &[(String, String)]) -> Markup {
    html! {
        dl {
            @for (name, value) in pairs {
                dt { (name) }
                dd { (joined(value)) }
            }
        }
    }
}

/// Paragraphs in columns.
pub fn columns(paragraphs: &[String]) -> Markup {
    html! { div.columns { @for words in paragraphs { p { (joined(words)) } } } }
}

/// Tables under a heading; one of the same title gets no second one.
pub fn tables(heading: &str, tables: &[PlainTable]) -> Markup {
    html! {
        @for t in tables {
            @if t.title == heading {
                div id=(t.name) { (table::untitled(t)) }
            } @else {
                (table::plain(t))
            }
        }
    }
}

/// A folded table that has its part's title.
pub fn folded_table(id: &str, one: &PlainTable) -> Markup {
    folded(
        id,
        &one.title,
        &html! { div id=(one.name) { (table::untitled(one)) } },
    )
}

/// Figures, those of other motions folded under the first of their kind.
pub fn drawings(figures: &[&Figure]) -> Markup {
    html! {
        @if !figures.is_empty() {
            div.figures {
                @for same in of_one_kind(figures) {
                    (page::figure(same[0], &same[1..]))
                }
            }
        }
    }
}

/// The names of figures.
pub fn labels(figures: &[&Figure]) -> String {
    let names: Vec<String> =
        of_one_kind(figures).map(|f| f[0].heading.label()).collect();
    names.join(", ")
}

/// Neighbours that are the same figure of other motions.
fn of_one_kind<'a, 'b>(
    figures: &'b [&'a Figure],
) -> impl Iterator<Item = &'b [&'a Figure]> {
    figures.chunk_by(|a, b| a.heading.is_beside(&b.heading))
}
