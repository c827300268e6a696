//! Text with `*italic*`, `_{subscript}` and `^{superscript}`.
//!
//! A backslash takes the next character as it is; a `_` or `^` without a
//! brace after it is an ordinary character.

use maud::Render as _;

/// Size of sub- and superscripts relative to the text.
const SCRIPT: f64 = 0.72;
/// How far a subscript goes down, in units of the text size.
const SUB_EM: f64 = 0.22;
/// How far a tilde goes up, and its middle to the right of the letter's.
const ACCENT_EM: f64 = -0.13;
const ACCENT_SLANT_EM: f64 = 0.05;
/// Width of the tilde.
const TILDE_EM: f64 = 0.333;
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
    /// A tilde over the character before it.
    Accent,
}

impl Level {
    /// How far it goes down, in units of the text size, and how much of the
    /// usual width it takes.
    fn form(self) -> (f64, f64) {
        match self {
            Self::Base => (0.0, 1.0),
            Self::Sub => (SUB_EM, SCRIPT),
            Self::Super => (SUPER_EM, SCRIPT),
            Self::Accent => (ACCENT_EM, 0.0),
        }
    }
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
/// use rocking_draw::markup::{Level, runs};
/// let parts = runs("*r*_{0.10} = 1");
/// assert_eq!(parts.len(), 3);
/// assert!(parts[0].italic);
/// assert_eq!(parts[1].level, Level::Sub);
/// ```
pub fn runs(markup: &str) -> Vec<Run> {
    let mut runs: Vec<Run> = Vec::new();
    let (mut italic, mut level) = (false, Level::Base);
    let mut characters = markup.chars().peekable();
    while let Some(c) = characters.next() {
        let mut next = Some(c);
        match c {
            '\\' => next = characters.next(),
            '*' => (italic, next) = (!italic, None),
            // Fonts place the combining tilde badly over italics.
            '\u{303}' => {
                let (text, level) = ('˜'.into(), Level::Accent);
                runs.push(Run { text, italic: false, level });
                next = None;
            }
            '_' | '^' if characters.next_if_eq(&'{').is_some() => {
                level = if c == '_' { Level::Sub } else { Level::Super };
                next = None;
            }
            '}' if level != Level::Base => (level, next) = (Level::Base, None),
            _ => {}
        }
        let Some(c) = next else { continue };
        match runs.last_mut() {
            Some(run) if (run.italic, run.level) == (italic, level) => {
                run.text.push(c);
            }
            _ => runs.push(Run { text: c.into(), italic, level }),
        }
    }
    runs
}

/// Text that is to be read as it is, such as a file name.
pub fn escape(text: &str) -> String {
    let mark = |c: char| matches!(c, '\\' | '*' | '_' | '^' | '}');
    let escape = |c| mark(c).then_some('\\').into_iter().chain([c]);
    text.chars().flat_map(escape).collect()
}

/// Width in px of the marked-up text at a size in px, by Helvetica's widths.
pub fn width(markup: &str, size_px: f64) -> f64 {
    let of = |run: &Run| {
        let letters = run.text.chars().map(character_width).map(f64::from);
        run.level.form().1 * letters.sum::<f64>()
    };
    runs(markup).iter().map(of).sum::<f64>() * size_px / 1000.0
}

/// The text cut to a width, with an ellipsis where it was cut.
pub fn fit(text: &str, size_px: f64, width_px: f64) -> String {
    if width(&escape(text), size_px) <= width_px {
        return text.to_owned();
    }
    let mut kept = text.to_owned();
    let room_px = width_px - size_px;
    while !kept.is_empty() && width(&escape(&kept), size_px) > room_px {
        kept.pop();
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
        'θ' => 556,
        'α' => 578,
        '·' | '’' | '‘' => 250,
        '…' | '—' => 1000,
        'ω' => 781,
        '∞' => 713,
        '–' => 556,
        _ => 600,
    }
}

/// The content of a `<text>` element: tspans where the style changes.
pub(super) fn tspans(markup: &str, size_px: f64) -> String {
    let (mut out, mut raised) = (String::new(), 0.0);
    // Width of the last letter, and how far the next run is to be moved.
    let (mut letter, mut along) = (0.0, 0.0);
    for run in runs(markup) {
        let (shift, scale) = run.level.form();
        if run.level == Level::Accent {
            along = -f64::midpoint(letter, TILDE_EM) + ACCENT_SLANT_EM;
        }
        let (step, script) = (shift * size_px - raised, scale == SCRIPT);
        raised = shift * size_px;
        let attributes = [
            (along != 0.0).then(|| format!(" dx=\"{:.2}\"", along * size_px)),
            (step != 0.0).then(|| format!(" dy=\"{step:.2}\"")),
            script.then(|| format!(" font-size=\"{:.2}\"", SCRIPT * size_px)),
            run.italic.then(|| " font-style=\"italic\"".to_owned()),
        ];
        let attributes: String = attributes.into_iter().flatten().collect();
        let text = escaped(&run.text);
        out += &match attributes.is_empty() {
            true => text,
            false => format!("<tspan{attributes}>{text}</tspan>"),
        };
        along = if run.level == Level::Accent {
            0.5 * (letter - TILDE_EM) - ACCENT_SLANT_EM
        } else {
            0.0
        };
        let last = run.text.chars().last();
        letter = last.map_or(0.0, |c| f64::from(character_width(c)) / 1000.0);
    }
    out
}

/// Characters so that XML reads them back; control characters, which XML
/// cannot hold, are left out.
pub(super) fn escaped(text: &str) -> String {
    text.replace(char::is_control, "").render().into_string()
}

/// Marked-up text without its marks.
pub fn plain(markup: &str) -> String {
    markup.replace(['*', '{', '}'], "").replace(['_', '^'], "")
}
