//! The committed page in a browser: no error, no request, no overflow,
//! everything there and readable. Without Chromium nothing is run, and that
//! is said; the gate installs it.

#[path = "page/browser.rs"]
mod browser;
#[path = "page/lab.rs"]
mod lab;
#[path = "page/print.rs"]
mod print;

use std::fs;
use std::path::{Path, PathBuf};

use browser::Browser;
use print::Printed;
use rocking_common::findings::Findings;
use rocking_proof::cases::{Cost, load_all};
use serde_json::Value;

const CHECKS: &str = include_str!("page/checks.js");

/// Widths of a phone, a tablet and a desk, in px, each in a colour scheme: the
/// layout does not depend on the scheme, nor the contrast on the width.
const VIEWS: [(u32, &str); 3] =
    [(360, "dark"), (820, "dark"), (1400, "light")];

fn root() -> PathBuf {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    root.canonicalize().expect("repository")
}

fn started(name: &str) -> Option<Browser> {
    let binary = browser::find();
    if binary.is_none() {
        eprintln!("not run: no Chromium");
    }
    binary.map(|binary| Browser::start(&binary, name))
}

fn lines(list: &Value) -> Vec<String> {
    let list = list.as_array().expect("a list").iter();
    list.map(|line| line.as_str().expect("a line").to_owned()).collect()
}

/// What is wrong with a page at one width and scheme.
fn problems(
    browser: &mut Browser,
    page: &Path,
    width_px: u32,
    scheme: &str,
) -> Vec<String> {
    browser.open(page, width_px, scheme);
    let found = browser.evaluate(CHECKS);
    let mut problems = lines(&found["problems"]);
    let folder = page.parent().expect("folder");
    for file in lines(&found["files"]) {
        if !folder.join(&file).is_file() {
            problems.push(format!("link: {file} is no file beside the page"));
        }
    }
    problems.extend(browser.events());
    problems
}

/// Violations that axe-core finds, if the gate has put it there.
fn axe(browser: &mut Browser) -> Option<Vec<String>> {
    let script =
        fs::read_to_string(root().join("target/axe/axe.min.js")).ok()?;
    browser.evaluate(&format!("{script};0"));
    let found = browser.evaluate(
        "axe.run(document, {resultTypes: ['violations']}).then((found) => \
         found.violations.map((v) => `${v.id}: ${v.help}, ${v.nodes.length} \
         times, first ${v.nodes[0].target}`))",
    );
    Some(lines(&found))
}

#[test]
fn the_committed_page_is_whole_and_readable() {
    let Some(mut browser) = started("committed") else { return };
    let page = root().join("reports/index.html");
    let mut found = Vec::new();
    for (width_px, scheme) in VIEWS {
        let here = problems(&mut browser, &page, width_px, scheme);
        found.extend(
            here.iter().map(|p| format!("{width_px} px, {scheme}: {p}")),
        );
        // The tablet has nothing that phone and desk lack.
        match (width_px != 820).then(|| axe(&mut browser)) {
            Some(Some(here)) => found.extend(here),
            Some(None) => eprintln!("not run: axe-core, no target/axe"),
            None => {}
        }
    }
    assert!(found.is_empty(), "{}", found.join("\n"));
}

/// The visible words of all elements that a selector names.
fn words(browser: &mut Browser, selector: &str) -> Vec<String> {
    lines(&browser.evaluate(&format!(
        "[...document.querySelectorAll('{selector}')].map((element) => {{ \
         const words = element.cloneNode(true); \
         words.querySelectorAll('.unseen').forEach((own) => own.remove()); \
         return words.textContent; }})"
    )))
}

/// A screen of a desk, in px.
const SCREEN_PX: f64 = 900.0;

/// Where the answers and the main part end, in px, and how many words the
/// main part shows: those with a letter or a digit, without drawings and what
/// is folded.
const LENGTHS: &str = "(() => { \
    const end = (selector, side) => scrollY + \
        document.querySelector(selector).getBoundingClientRect()[side]; \
    const shown = document.body.cloneNode(true); \
    shown.querySelectorAll('#annexes, details, svg, .unseen, footer') \
        .forEach((e) => e.replaceWith(' ')); \
    shown.querySelectorAll('*').forEach((e) => e.append(' ')); \
    const words = shown.textContent.split(/\\s+/); \
    return [end('table.answers', 'bottom'), end('#annexes', 'top'), \
        words.filter((w) => /[\\p{L}\\p{N}]/u.test(w)).length]; })()";

/// One screen answers, fourteen say why: what a decision maker and a
/// researcher have time for.
#[test]
fn the_first_screen_answers_and_the_main_part_is_short() {
    let Some(mut browser) = started("lengths") else { return };
    browser.open(&root().join("reports/index.html"), 1400, "light");
    let found = browser.evaluate(LENGTHS);
    let [answers, main, words] =
        [0, 1, 2].map(|k| found[k].as_f64().expect("a number"));
    assert!(answers <= SCREEN_PX, "the answers end at {answers} px");
    assert!(main <= 14.0 * SCREEN_PX, "{:.2} screens", main / SCREEN_PX);
    assert!(words <= 5000.0, "{words} words");
}

/// A4 sheets of a copy to file.
const SHEETS: usize = 24;

/// The paper has the report whole, and of its annexes the list of their
/// files.
#[test]
fn the_printed_copy_is_whole_and_short() {
    let Some(mut browser) = started("paper") else { return };
    let page = root().join("reports/index.html");
    let binary = browser::find().expect("a browser");
    let Some(printed) = Printed::of(&binary, &page) else {
        eprintln!("not run: no pdftotext");
        return;
    };
    let text = fs::read_to_string(root().join("reports/data/findings.json"));
    let findings = Findings::parse(&text.expect("findings")).expect("form");
    let mut missing = Vec::new();
    for claim in &findings.claims {
        if !printed.has(&claim.quote) {
            missing.push(format!("claim {}: {}", claim.id, claim.quote));
        }
    }
    browser.open(&page, 1400, "light");
    let drawn = ".figures > figure > figcaption";
    for part in ["section:not(#annexes)", "#files"] {
        let cells = "td:not(:has(math))";
        for kind in ["caption", drawn, "th", cells, "dd"] {
            let all = words(&mut browser, &format!("{part} {kind}"));
            for text in all.iter().filter(|text| !printed.has_end(text)) {
                missing.push(format!("{kind}: {text}"));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
    let equations = words(&mut browser, "#equations td math");
    assert_eq!(equations.len(), 8, "Eqs. 1 to 7 and the closed form");
    let files = words(&mut browser, "#files tbody td:last-child");
    assert!(files.len() > 20, "{} files", files.len());
    for hash in &files {
        assert!(printed.has_word(hash), "{hash} is broken");
    }
    // A case stands on the screen, and in its file.
    let cases = words(&mut browser, "#cases tbody th");
    for case in load_all().expect("cases") {
        let quick = case.cost == Cost::Quick;
        assert!(!quick || cases.contains(&case.id), "case {}", case.id);
    }
    let last = format!("Page {0} of {0}", printed.pages);
    assert!(printed.has(&last), "{last}");
    assert!(printed.pages <= SHEETS, "{} sheets", printed.pages);
}

#[test]
fn what_is_cut_off_paper_is_missed() {
    let Some(binary) = browser::find() else { return };
    let body = "<h2>Part</h2><p>On paper.</p><p style=\"width: 90rem; \
                text-align: right\">beyond the edge</p>\
                <details><summary>s</summary><p>folded away</p></details>";
    let style = "@page { size: A4 } body { overflow: hidden; width: 30rem }";
    let page = small(style, body);
    let Some(printed) = Printed::of(&binary, page.path()) else {
        return;
    };
    assert!(printed.has("On paper."));
    assert!(!printed.has("beyond the edge"));
    assert!(!printed.has("folded away"));
}

/// A page with `body`, sound but for what is in it.
fn small(style: &str, body: &str) -> tempfile::NamedTempFile {
    let html = tempfile::Builder::new().suffix(".html").tempfile();
    let page = html.expect("page");
    let text = format!(
        "<!DOCTYPE html><html lang=\"en\"><head><meta charset=\"utf-8\">\
         <meta name=\"viewport\" content=\"width=device-width\">\
         <meta name=\"color-scheme\" content=\"light dark\">\
         <title>Small</title><style>body {{ background: Canvas; \
         overflow-wrap: break-word }} {style}</style></head><body>\
         <header><h1>Small</h1></header>\
         <nav aria-label=\"Contents\"><a href=\"#main\">Main</a></nav>\
         <main id=\"main\">{body}</main>\
         <footer><p>End</p></footer></body></html>"
    );
    fs::write(&page, text).expect("page");
    page
}

#[test]
fn a_sound_page_has_no_problem() {
    let Some(mut browser) = started("sound") else { return };
    let body = "<h2>Part</h2><table><caption>Numbers</caption><tr>\
                <th scope=\"col\">p</th></tr><tr><td>3</td></tr></table>\
                <svg width=\"200\" height=\"100\"><title>Lines</title>\
                <path d=\"M0 0L50 50\"/><path d=\"M0 0L90 50\"/>\
                <path d=\"M0 9L50 50\"/></svg>";
    let page = small("svg { max-width: 100% }", body);
    for scheme in ["light", "dark"] {
        let found = problems(&mut browser, page.path(), 360, scheme);
        assert!(found.is_empty(), "{scheme}: {found:?}");
    }
}

#[test]
fn every_defect_is_reported() {
    let Some(mut browser) = started("broken") else { return };
    let svg = "<svg width=\"200\" height=\"100\">";
    for (name, style, body, words) in [
        ("wide", "", "<p style=\"width: 50rem\">x</p>", "overflow"),
        (
            "folded",
            "",
            "<details><summary>s</summary><p style=\"width: 50rem\">x</p>\
             </details>",
            "overflow",
        ),
        (
            "error",
            "",
            "<script>console.error('said')</script>",
            "console error",
        ),
        ("exception", "", "<script>absent()</script>", "exception"),
        (
            "request",
            "",
            "<img alt=\"a\" src=\"http://localhost:9/a.png\">",
            "request: http",
        ),
        ("image", "", "<img alt=\"a\" src=\"absent.png\">", "image"),
        ("empty", "", &format!("{svg}<title>t</title></svg>"), "is empty"),
        (
            "untitled",
            "",
            &format!("{svg}<path d=\"M0 0L9 9\"/></svg>"),
            "without title",
        ),
        (
            "clipped",
            "",
            &format!(
                "{svg}<title>t</title><text x=\"190\" y=\"50\">label</text>\
                 </svg>"
            ),
            "is clipped",
        ),
        ("heading", "", "<h3>Deep</h3>", "heading: h1 to h3"),
        ("main", "", "<h1>Again</h1>", "landmark h1: 2"),
        ("anchor", "", "<a href=\"#gone\">x</a>", "#gone leads nowhere"),
        ("file", "", "<a href=\"gone.csv\">x</a>", "gone.csv is no file"),
        ("id", "", "<p id=\"a\"></p><p id=\"a\"></p>", "id: a twice"),
        (
            "table",
            "",
            "<table><caption>c</caption><tr><td>1</td></tr></table>",
            "without headers",
        ),
        (
            "scope",
            "",
            "<table><caption>c</caption><tr><th>1</th></tr></table>",
            "without scope",
        ),
        ("pale", "p { color: #999 }", "<p>pale</p>", "contrast: 2.85"),
        (
            "keyboard",
            "",
            "<div style=\"overflow-x: auto\"><p style=\"width: 50rem\">x</p>\
             </div>",
            "keyboard",
        ),
    ] {
        let page = small(style, body);
        let found = problems(&mut browser, page.path(), 360, "light");
        let is_reported = found.iter().any(|problem| problem.contains(words));
        assert!(is_reported, "{name}: {words:?} is not in {found:?}");
    }
    // What is readable in the light may not be in the dark.
    let page = small("footer { color: #333 }", "<h2>x</h2>");
    assert!(problems(&mut browser, page.path(), 360, "light").is_empty());
    let found = problems(&mut browser, page.path(), 360, "dark");
    assert!(found.iter().any(|p| p.contains("contrast")), "{found:?}");
}
