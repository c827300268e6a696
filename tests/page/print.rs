//! The committed page on paper: Chromium prints it, pdftotext reads it back.

use std::path::Path;
use std::process::Command;

/// The text of a PDF, as it is and without white space: a cell may break
/// between words.
pub struct Printed {
    lines: String,
    text: String,
    pub pages: usize,
}

impl Printed {
    /// Prints a page; none where a tool is missing.
    pub fn of(browser: &Path, page: &Path) -> Option<Self> {
        let folder = tempfile::tempdir().expect("folder");
        let pdf = folder.path().join("page.pdf");
        let profile = folder.path().join("profile");
        let printed = Command::new(browser)
            .args([
                "--headless",
                "--no-sandbox",
                "--disable-gpu",
                "--no-pdf-header-footer",
            ])
            .arg(format!("--user-data-dir={}", profile.display()))
            .arg(format!("--print-to-pdf={}", pdf.display()))
            .arg(format!("file://{}", page.display()))
            .output()
            .expect("a browser that starts");
        assert!(printed.status.success(), "{printed:?}");
        // In the order of the page: a cell's lines follow each other.
        let read = Command::new("pdftotext")
            .args(["-raw".as_ref(), pdf.as_os_str(), "-".as_ref()])
            .output()
            .ok()?;
        assert!(read.status.success(), "{read:?}");
        let text = String::from_utf8(read.stdout).expect("text");
        let pages = text.matches('\u{c}').count();
        Some(Self { text: bare(&text), lines: text, pages })
    }

    /// Whether the paper has these words.
    pub fn has(&self, words: &str) -> bool {
        self.text.contains(&bare(words))
    }

    /// Whether the paper has this word in one piece.
    pub fn has_word(&self, word: &str) -> bool {
        self.lines.contains(word)
    }

    /// Whether the paper has the last words of a text.
    pub fn has_end(&self, text: &str) -> bool {
        let all = bare(text);
        let letters: Vec<char> = all.chars().collect();
        let from = letters.len().saturating_sub(20);
        self.text.contains(&letters[from..].iter().collect::<String>())
    }
}

fn bare(text: &str) -> String {
    let text = text.replace('\u{fb01}', "fi").replace('\u{fb02}', "fl");
    // A word joiner only tells where no line breaks.
    let shown = |c: &char| !c.is_whitespace() && *c != '\u{2060}';
    text.chars().filter(shown).collect()
}
