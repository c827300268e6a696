//! The page from made-up words.

use super::*;
use crate::evidence::{self, Proof};
use rocking_common::findings::Theme;
use rocking_common::paper::{Arm, Verdict};
use rocking_common::table::PlainTable;
use rocking_draw::colour;
use rocking_draw::figures::{BlockSketch, Figure, Heading};
use rocking_draw::page::STYLE;

fn sketches() -> [Figure; 3] {
    [1, 6, 8].map(|number| {
        let title = "made-up numbers & <marks>";
        let heading =
            Heading::numbered(number, title, "of nothing", Some(Arm::C));
        BlockSketch { heading, alpha_rad: 0.3, rotation_rad: 0.15 }
            .figure("Nothing can be seen here.".into())
    })
}

fn made_up(figures: &[Figure]) -> ReportInput<'_> {
    let recorded = crate::basis::recorded();
    let column = |name| Column {
        name,
        findings: recorded.clone(),
        first: Arm::C,
        score: vec![(Verdict::Confirmed, 18)],
    };
    let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/data");
    let proof = Proof::read(data.as_ref()).unwrap();
    let words = |cells: &[&str]| -> Vec<String> {
        cells.iter().map(|c| (*c).into()).collect()
    };
    ReportInput {
        title: "Rocking: what was verified, what was found".into(),
        intro: vec!["Free-standing blocks under 86 + 44 records".into()],
        lab: false,
        signatures: vec![
            ("Issued".into(), Some("a day".into())),
            ("Approved by".into(), None),
        ],
        answers: vec![AnswerRow {
            question: "Is slenderness normalized out?".into(),
            answer: "Nearly: for ratios; open for quantiles.".into(),
            effect: "-0.9 % (-1 to -0.8 %)".into(),
            shown: vec![("figure-08-c".into(), "Figure 8".into())],
        }],
        otherwise: Some("Other motions say the same.".into()),
        first: Vec::new(),
        scope: Chapter {
            text: vec!["Made-up numbers.".into()],
            ..Chapter::titled("scope", "Scope")
        },
        columns: ["recorded suites", "embedded suites"].map(column).into(),
        findings: vec![Shown {
            theme: Theme::Statistics,
            paragraph: "On average it does.".into(),
            figures: figures.iter().collect(),
            more: Vec::new(),
        }],
        proof: "By the results handed in: all cases pass.".into(),
        families: evidence::shown(&proof).unwrap(),
        identities: PlainTable::default(),
        method: vec!["As one would.".into()],
        glossary: vec![("p".into(), "frequency parameter".into())],
        evidence: Chapter::default(),
        chapters: vec![Chapter {
            text: vec!["Two suites only.".into()],
            ..Chapter::titled("limits", "Limits")
        }],
        head: vec![(
            "suite ordinary".into(),
            "sha256 ".to_owned() + &"ab1".repeat(21),
        )],
        files: PlainTable {
            name: "list-of-files".into(),
            title: "Files".into(),
            reading: "Each with its hash.".into(),
            header: words(&["file", "SHA-256"]),
            rows: vec![words(&["data/table-1.csv", &"ab1".repeat(21)])],
        },
        annexes: vec![Chapter {
            id: "blocks",
            title: "Blocks".into(),
            tables: vec![PlainTable {
                name: "table-1".into(),
                title: "Table 1. The blocks".into(),
                reading: "Sizes follow from p and alpha.".into(),
                header: words(&["α (rad)", "p (1/s)", "R (m)", "2b (m)"]),
                rows: vec![words(&["0.05", "1", "7.358", "0.735"]); 5],
            }],
            ..Chapter::default()
        }],
    }
}

/// Writes the page where `ROCKING_FIGURES` says, to be looked at.
#[test]
fn writes_it_to_be_looked_at() {
    let Ok(folder) = std::env::var("ROCKING_FIGURES") else { return };
    std::fs::write(
        format!("{folder}/index.html"),
        page(&made_up(&sketches())),
    )
    .unwrap();
}

#[test]
fn suites_are_named_without_a_second_article() {
    let figures = sketches();
    let mut input = made_up(&figures);
    input.columns.truncate(1);
    input.columns[0].name = "your suites";
    let html = page(&input);
    assert!(html.contains("Your suites, "), "your suites are not named");
    assert!(!html.contains("the your"));
}

#[test]
fn same_bytes_twice() {
    assert_eq!(page(&made_up(&sketches())), page(&made_up(&sketches())));
}

#[test]
fn asks_nothing_of_network_or_scripts() {
    let html = page(&made_up(&sketches()));
    for word in ["<script", "<link", "@import", "url(", "src="] {
        assert!(!html.contains(word), "{word}");
    }
    let plain = html.replace("http://www.w3.org/2000/svg", "");
    let plain = plain.replace("meta http-equiv=", "");
    assert!(!plain.contains("http"));
    // And a browser lets nothing through.
    assert!(html.contains("content=\"default-src 'none'; style-src "));
}

/// Suites and files are named by users.
#[test]
fn hostile_names_stay_text() {
    let name = "<script>alert(1)</script>\" onload='b()' x=\"&lt;";
    let figures = sketches();
    let mut input = made_up(&figures);
    input.head[0].1 = name.into();
    input.chapters[0].text[0] = name.into();
    input.annexes[0].tables[0].rows[0][0] = name.into();
    input.annexes[0].tables[0].title = name.into();
    input.intro[0] = name.into();
    let html = page(&input);
    let escaped = "&lt;script&gt;alert(1)&lt;/script&gt;&quot; onload='b()' \
                   x=&quot;&amp;lt;";
    // The title of a table also names its box.
    assert_eq!(html.matches(escaped).count(), 6);
    assert!(!html.contains("<script") && !html.contains("\" onload"));
}

#[test]
fn every_anchor_leads_somewhere_and_no_name_is_used_twice() {
    let html = page(&made_up(&sketches()));
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
    assert_eq!(page(&made_up(&sketches())).matches(colour::STYLE).count(), 1);
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
