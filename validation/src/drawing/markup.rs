//! Text with `*italic*`, `_{subscript}` and `^{superscript}`.
//!
//! A backslash takes the next character as it is; a `_` or `^` without a
//! brace after it is an ordinary character.

use std::fmt::Write as _;

/// Size of sub- and superscripts relative to the text.
const SCRIPT: f64 = 0.72;
/// How far a subscript goes down, in units of the text size.
const SUB_EM: f64 = 0.22;
/// How far a superscript goes up.
const SUPER_EM: f64 = -0.36;

/// Where a run of text stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    /// On the baseline.
    Base,
    /// Below.
    Sub,
    /// Above.
    Super,
}

/// Characters of one style.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Run {
    /// The characters.
    pub text: String,
    /// Whether they are italic.
    pub italic: bool,
    /// Where they stand.
    pub level: Level,
}

/// Takes the marked-up text apart.
///
/// ```
/// use rocking_validation::drawing::markup::{Level, runs};
/// let parts = runs("*r*_{0.10} = 1");
/// assert_eq!(parts.len(), 3);
/// assert!(parts[0].italic);
/// assert_eq!(parts[1].level, Level::Sub);
/// ```
#[must_use]
pub fn runs(markup: &str) -> Vec<Run> {
    let mut done: Vec<Run> = Vec::new();
    let mut now =
        Run { text: String::new(), italic: false, level: Level::Base };
    let turn = |now: &mut Run, done: &mut Vec<Run>| {
        if !now.text.is_empty() {
            done.push(now.clone());
            now.text.clear();
        }
    };
    let mut characters = markup.chars().peekable();
    while let Some(c) = characters.next() {
        match c {
            '\\' => now.text.extend(characters.next()),
            '*' => {
                turn(&mut now, &mut done);
                now.italic = !now.italic;
            }
            '_' | '^' if characters.peek() == Some(&'{') => {
                characters.next();
                turn(&mut now, &mut done);
                now.level = if c == '_' { Level::Sub } else { Level::Super };
            }
            '}' if now.level != Level::Base => {
                turn(&mut now, &mut done);
                now.level = Level::Base;
            }
            _ => now.text.push(c),
        }
    }
    turn(&mut now, &mut done);
    done
}

/// Text that is to be read as it is, such as a file name.
#[must_use]
pub fn escape(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if matches!(c, '\\' | '*' | '_' | '^' | '}') {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

/// Width in px of the marked-up text at a size in px, by Helvetica's widths.
#[must_use]
pub fn width(markup: &str, size_px: f64) -> f64 {
    let mut thousandths = 0.0;
    for run in runs(markup) {
        let scale = if run.level == Level::Base { 1.0 } else { SCRIPT };
        for c in run.text.chars() {
            thousandths += scale * f64::from(character_width(c));
        }
    }
    thousandths * size_px / 1000.0
}

/// The text cut to a width, with an ellipsis where it was cut.
#[must_use]
pub fn fit(text: &str, size_px: f64, width_px: f64) -> String {
    if width(&escape(text), size_px) <= width_px {
        return text.to_owned();
    }
    let mut kept = String::new();
    for c in text.chars() {
        kept.push(c);
        if width(&escape(&kept), size_px) + size_px > width_px {
            kept.pop();
            break;
        }
    }
    format!("{}…", kept.trim_end())
}

/// Widths of the printable ASCII characters in Adobe's Helvetica, in
/// thousandths of the size (Arial and Liberation Sans share them).
const ASCII: [u16; 95] = [
    278, 278, 355, 556, 556, 889, 667, 191, 333, 333, 389, 584, 278, 333, 278,
    278, 556, 556, 556, 556, 556, 556, 556, 556, 556, 556, 278, 278, 584, 584,
    584, 556, 1015, 667, 667, 722, 722, 667, 611, 778, 722, 278, 500, 667,
    556, 833, 722, 778, 667, 778, 722, 667, 611, 722, 667, 944, 667, 667, 611,
    278, 278, 278, 469, 556, 333, 556, 556, 500, 556, 556, 278, 556, 556, 222,
    222, 500, 222, 833, 556, 556, 556, 556, 333, 500, 278, 556, 500, 722, 500,
    500, 500, 334, 260, 334, 584,
];

fn character_width(c: char) -> u16 {
    match c {
        ' '..='~' => ASCII[c as usize - 32],
        '\u{300}'..='\u{36f}' => 0,
        '·' | '’' | '‘' => 250,
        '…' | '—' => 1000,
        'ω' => 781,
        '∞' => 713,
        '–' => 556,
        _ => 600,
    }
}

/// Writes the content of a `<text>` element: tspans where the style changes.
pub(super) fn write_tspans(out: &mut String, markup: &str, size_px: f64) {
    let mut raised = 0.0;
    for run in runs(markup) {
        let (shift, script) = match run.level {
            Level::Base => (0.0, false),
            Level::Sub => (SUB_EM * size_px, true),
            Level::Super => (SUPER_EM * size_px, true),
        };
        let step = shift - raised;
        raised = shift;
        if step == 0.0 && !script && !run.italic {
            write_escaped(out, &run.text);
            continue;
        }
        out.push_str("<tspan");
        if step != 0.0 {
            let _ = write!(out, " dy=\"{step:.2}\"");
        }
        if script {
            let _ = write!(out, " font-size=\"{:.2}\"", SCRIPT * size_px);
        }
        if run.italic {
            out.push_str(" font-style=\"italic\"");
        }
        out.push('>');
        write_escaped(out, &run.text);
        out.push_str("</tspan>");
    }
}

/// Writes characters so that XML reads them back; control characters, which
/// XML cannot hold, are left out.
pub(super) fn write_escaped(out: &mut String, text: &str) {
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            c if c.is_control() => {}
            c => out.push(c),
        }
    }
}
