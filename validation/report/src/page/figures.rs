//! Figures on the page, each with its reading and its data.

use maud::{Markup, PreEscaped, html};

use rocking_draw::colour;
use rocking_draw::figures::Figure;

/// A wider drawing scrolls on a phone instead of shrinking to its width.
const WIDE_PX: f64 = 640.0;

/// A figure with title, reading and data; under it, folded, the same figure
/// of other motions.
pub fn figure(shown: &Figure, others: &[&Figure]) -> Markup {
    let heading = &shown.heading;
    let (name, title, number) =
        (&heading.name, &heading.title, heading.label());
    // Others share what stands in the place of a number.
    let called = if heading.number.is_some() { &number } else { title };
    let label = format!("{called}, drawing");
    let svg = shown.svg();
    let class = if shown.scene().extent().right > WIDE_PX {
        "scroll drawing wide"
    } else {
        "scroll drawing"
    };
    html! {
        figure.figure id=(name) {
            figcaption {
                p.title { (number) ". " (title) }
                p {
                    (shown.reading) " "
                    a href={ "data/" (name) ".csv" } { "Numbers" } "."
                }
            }
            div class=(class) role="region" aria-label=(label) tabindex="0" {
                (PreEscaped(inline(&svg)))
            }
            @for other in others {
                details.beside {
                    summary { "Show: " (other.heading.label()) }
                    (figure(other, &[]))
                }
            }
        }
    }
}

/// The SVG without its own style sheet, which the page has once.
pub fn inline(svg: &str) -> String {
    let style = format!("<style>{}</style>\n", colour::STYLE);
    svg.replacen(&style, "", 1)
}
