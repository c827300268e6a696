//! Figures on the page, each with its reading and its data.

use maud::{Markup, PreEscaped, html};

use rocking_draw::colour;

/// A wider drawing scrolls on a phone instead of shrinking to its width.
const WIDE_PX: u32 = 640;

/// A drawing ready for the page.
#[derive(Debug, Clone, Default)]
pub struct ShownFigure {
    /// File stem, unique, also the anchor: `figure-06-c`.
    pub name: String,
    /// `Figure 6, arm C`.
    pub number: String,
    /// What it shows, in a few words.
    pub title: String,
    /// What is to be seen in it, in one sentence.
    pub reading: String,
    /// The drawing as [`rocking_draw::figures::Figure::svg`] gives it.
    pub svg: String,
}

impl ShownFigure {
    /// What it is called where it is named: its number, or its title if it
    /// shares the number with others.
    fn called(&self) -> &str {
        if self.number.starts_with("Figure") {
            &self.number
        } else {
            &self.title
        }
    }
}

/// The figure with title, reading and data.
pub fn figure(shown: &ShownFigure) -> Markup {
    let label = format!("{}, drawing", shown.called());
    let class = if width_px(&shown.svg) > WIDE_PX {
        "scroll drawing wide"
    } else {
        "scroll drawing"
    };
    html! {
        figure.figure id=(shown.name) {
            p.title { (shown.number) ". " (shown.title) }
            div class=(class) role="region" aria-label=(label) tabindex="0" {
                (PreEscaped(inline(&shown.svg)))
            }
            figcaption {
                (shown.reading) " "
                a href={ "data/" (shown.name) ".csv" } { "Numbers" } "."
            }
        }
    }
}

/// The width that the SVG says it has, or 0.
fn width_px(svg: &str) -> u32 {
    let value = svg.split(" width=\"").nth(1);
    let digits = value.and_then(|v| v.split('"').next());
    digits.and_then(|d| d.parse().ok()).unwrap_or(0)
}

/// The SVG without its own style sheet, which the page has once.
fn inline(svg: &str) -> String {
    let style = format!("<style>{}</style>\n", colour::STYLE);
    svg.replacen(&style, "", 1)
}
