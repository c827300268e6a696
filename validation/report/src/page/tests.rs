//! The page of a study without records.

mod printed;

use super::*;
use crate::basis::{self, FindingSets};
use crate::evidence::Proof;
use crate::head::Signatures;
use crate::shaking::RockTests;
use crate::tests::on_embedded_suites;
use crate::timings::Timings;
use crate::words::words;
use rocking_common::findings::Findings;
use rocking_common::paper::Arm;
use rocking_draw::colour;
use rocking_draw::figures::Figure;
use rocking_draw::figures::{BlockSketch, Heading};
use rocking_draw::page::STYLE;
use rocking_study::Study;
use rocking_study::questions::StudyAnswer;

fn sketches() -> [Figure; 3] {
    [1, 6, 8].map(|number| {
        let title = "made-up numbers & <marks>";
        let heading =
            Heading::numbered(number, title, "of nothing", Some(Arm::C));
        BlockSketch { heading, alpha_rad: 0.3, rotation_rad: 0.15 }
            .figure("Nothing can be seen here.".into())
    })
}

/// Names that users give.
#[derive(Default)]
struct Names {
    rule: String,
    signature: Option<String>,
    cell: String,
    title: String,
    own_suites: bool,
}

/// The page of a study without records that found this.
fn page_of(names: Names, findings: Findings) -> String {
    let mut results = on_embedded_suites();
    results.ordinary.component_rule = names.rule;
    let table = PlainTable::new(
        "made-up",
        &names.title,
        "Nothing.",
        &["name"],
        vec![vec![names.cell]],
    );
    let answer = StudyAnswer {
        id: "made-up",
        question: "What?",
        answer: String::new(),
        tables: vec![table],
        figures: Vec::new(),
        files: Vec::new(),
    };
    let study = Study {
        results,
        figures: Vec::new(),
        findings,
        answers: vec![answer],
    };
    let page = Page {
        study: &study,
        basis: &FindingSets::of(!names.own_suites, &study.findings)
            .expect("kept"),
        figures: &sketches(),
        charts: &[],
        proof: Some(&Proof::committed(0)),
        signatures: &Signatures {
            approved_by: names.signature,
            ..Signatures::default()
        },
        tests: &RockTests::kept().expect("tests"),
        timings: &Timings::kept().expect("timings"),
        words: words().expect("words"),
        lab: false,
    };
    let annexes = annexes(&page).expect("annexes");
    html(&page, &annexes, &PlainTable::default()).expect("page")
}

/// The page beside what is kept.
fn page() -> String {
    page_of(Names::default(), basis::recorded())
}

/// Writes the page where `ROCKING_FIGURES` says, to be looked at.
#[test]
fn writes_it_to_be_looked_at() {
    let Ok(folder) = std::env::var("ROCKING_FIGURES") else { return };
    let html = page();
    std::fs::write(format!("{folder}/index.html"), html).unwrap();
}

#[test]
fn suites_are_named_without_a_second_article() {
    let names = Names { own_suites: true, ..Names::default() };
    let html = page_of(names, basis::recorded());
    assert!(html.contains(">your suites<"), "your suites are not named");
    assert!(!html.contains("the your"));
}

#[test]
fn same_bytes_twice() {
    assert_eq!(page(), page());
}

#[test]
fn asks_nothing_of_network_or_scripts() {
    let html = page();
    for word in ["<script", "<link", "@import", "url(", "src="] {
        assert!(!html.contains(word), "{word}");
    }
    let plain = html.replace("http://www.w3.org/2000/svg", "");
    let plain = plain.replace("http://www.w3.org/1998/Math/MathML", "");
    let plain = plain.replace("meta http-equiv=", "");
    assert!(!plain.contains("http"));
    // And a browser lets nothing through.
    assert!(html.contains("content=\"default-src 'none'; style-src "));
}

/// Suites and files are named by users.
#[test]
fn hostile_names_stay_text() {
    let name = || "<script>alert(1)</script>\" onload='b()' x=\"&lt;".into();
    let names = Names {
        rule: name(),
        signature: Some(name()),
        cell: name(),
        title: name(),
        own_suites: false,
    };
    let html = page_of(names, basis::recorded());
    let escaped = "&lt;script&gt;alert(1)&lt;/script&gt;&quot; onload='b()' \
                   x=&quot;&amp;lt;";
    // The title of a table also names its box.
    assert_eq!(html.matches(escaped).count(), 5);
    assert!(!html.contains("<script") && !html.contains("\" onload"));
}

#[test]
fn every_anchor_leads_somewhere_and_no_name_is_used_twice() {
    let html = page();
    let values = |key: &str| -> Vec<String> {
        let parts = html.split(key).skip(1);
        parts.map(|p| p.split('"').next().unwrap().to_owned()).collect()
    };
    let mut ids = values(" id=\"");
    assert!(ids.len() > 30);
    for target in values("href=\"#") {
        assert!(ids.contains(&target), "{target}");
    }
    let all = ids.len();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), all);
}

#[test]
fn figures_share_one_style_sheet() {
    let html = page();
    assert_eq!(html.matches(colour::STYLE).count(), 1);
}

/// WCAG 2 contrast of two colours.
fn contrast(a: &str, b: &str) -> f64 {
    let luminance = |hex: &str| {
        let full: String = if hex.len() == 4 {
            hex[1..].chars().flat_map(|c| [c, c]).collect()
        } else {
            hex[1..].to_owned()
        };
        let channel = |k: usize| {
            let byte = u8::from_str_radix(&full[2 * k..2 * k + 2], 16);
            let x = f64::from(byte.unwrap()) / 255.0;
            if x <= 0.04045 {
                x / 12.92
            } else {
                libm::pow((x + 0.055) / 1.055, 2.4)
            }
        };
        0.2126 * channel(0) + 0.7152 * channel(1) + 0.0722 * channel(2)
    };
    let (a, b) = (luminance(a), luminance(b));
    (a.max(b) + 0.05) / (a.min(b) + 0.05)
}

#[test]
fn text_has_contrast_4_5_and_lines_3() {
    let colour = |css: &str, key: &str| -> String {
        let at = css.find(key).unwrap_or_else(|| panic!("{key}"));
        let rest = &css[at + key.len()..];
        rest.split([';', '}']).next().unwrap().trim().to_owned()
    };
    let (light, dark) = STYLE.split_once("@media screen").unwrap();
    for css in [light, dark] {
        let paper = colour(css, "--paper:");
        for key in
            ["--ink:", "--soft:", "--link:", "--yes:", "--no:", "--open:"]
        {
            let ratio = contrast(&colour(css, key), &paper);
            assert!(ratio >= 4.5, "{key} {ratio}");
        }
    }
    let (light, dark) = colour::STYLE.split_once("@media").unwrap();
    for css in [light, dark] {
        let paper = colour(css, ".p{fill:");
        for (key, least) in [(".t{fill:", 4.5), (".m{fill:", 4.5)] {
            let ratio = contrast(&colour(css, key), &paper);
            assert!(ratio >= least, "{key} {ratio}");
        }
        let mut last = f64::INFINITY;
        for k in 1..=5 {
            let key = format!(".l.s{k}{{stroke:");
            let ratio = contrast(&colour(css, &key), &paper);
            assert!(ratio >= 3.0, "{key} {ratio}");
            assert!(ratio < last || css == dark, "{key} {ratio}");
            last = ratio;
        }
    }
}
