//! What pages share: styles, figures with reading and data, and tables.

pub mod table;

use maud::{Markup, PreEscaped, html};

use crate::colour;
use crate::figures::Figure;

/// The style sheet of a page, beside that of its [drawings](colour::STYLE).
pub const STYLE: &str = include_str!("page/page.css");

/// Nothing is loaded and nothing runs; styles stand in the page.
const POLICY: &str = "default-src 'none'; style-src 'unsafe-inline'; \
                          base-uri 'none'; form-action 'none'";

/// A wider drawing scrolls on a phone instead of shrinking to its width.
const WIDE_PX: u32 = 640;

/// The head of a page, with all styles. In print each sheet has the title.
pub fn head(title: &str) -> Markup {
    let plain = title.replace(['"', '\\', '<', '\n'], "");
    let running = format!(
        "@page{{@top-left{{content:\"{plain}\";font:8pt sans-serif;\
         color:#4d4d4d}}}}"
    );
    html! {
        head {
            meta charset="utf-8";
            meta http-equiv="Content-Security-Policy" content=(POLICY);
            meta name="viewport"
                content="width=device-width, initial-scale=1";
            meta name="color-scheme" content="light dark";
            title { (title) }
            style {
                (PreEscaped(STYLE)) (PreEscaped(colour::STYLE))
                (PreEscaped(running))
            }
        }
    }
}

/// A figure with title, reading and data; under it, folded, the same figure
/// of other motions.
pub fn figure(shown: &Figure, others: &[&Figure]) -> Markup {
    let heading = &shown.heading;
    let (name, title, number) =
        (&heading.name, &heading.title, heading.label());
    // Others share what stands in the place of a number.
    let called = if heading.number.is_some() { &number } else { title };
    let label = format!("{called}, drawing");
    let drawing = shown.scene();
    let wide = if drawing.size_px.0 > WIDE_PX { " wide" } else { "" };
    let svg = drawing.finish();
    html! {
        figure.figure id=(name) {
            figcaption {
                p.title { (number) ". " (title) }
                p {
                    (shown.reading) " "
                    a href={ "data/" (name) ".csv" } { "Numbers" } "."
                }
            }
            div class={ "scroll drawing" (wide) } role="region" aria-label=(label) tabindex="0" {
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
