//! The page from made-up words.

use super::*;
use crate::draw::colour;
use crate::draw::figures::{Figure, demonstration};

fn made_up() -> ReportInput {
    let finding = |k: usize| Finding {
        id: format!("stage-{k}"),
        claim: "“the median r conforms to 1.0 with 95 % confidence”".into(),
        source: format!("section {k}"),
        tested_on: "86 ordinary records, p = 1, arm C".into(),
        measure: "share of stripes whose interval holds 1".into(),
        value: "0.91".into(),
        interval: "0.83 to 0.96 (95 %)".into(),
        margin: "at least 0.90".into(),
        verdict: Verdict::ALL[k % 3],
        figures: vec!["figure-08".into()],
        remark: if k == 1 { "The lowest stripe.".into() } else { "".into() },
    };
    let case = |k: usize| ShownCase {
        id: format!("free-rocking/decay-{k}"),
        claim: "peaks fall as the closed form says".into(),
        source: "Housner 1963, Eq. 8".into(),
        tolerance: "1e-12 relative".into(),
        because: "hundred times what double precision can give".into(),
        error: "3.1e-14".into(),
        margin: "32 times".into(),
        rejects: "energy ratio taken for velocity ratio".into(),
        passed: k != 2,
    };
    let shown = |figure: &Figure| {
        let heading = &figure.heading;
        ShownFigure {
            name: heading.name.clone(),
            number: heading.name.replace("figure-", "Figure "),
            title: "made-up numbers & <marks>".into(),
            reading: "Nothing can be seen here, the numbers are made up."
                .into(),
            svg: figure.svg(),
            csv: figure.csv.clone(),
            csv_path: format!("data/{}.csv", heading.name),
        }
    };
    let words = |cells: &[&str]| -> Vec<String> {
        cells.iter().map(|c| (*c).into()).collect()
    };
    ReportInput {
        title: "Rocking: what was verified, what was found".into(),
        subtitle: "Free-standing blocks under 86 + 44 records".into(),
        summary: Summary {
            asked: "Is slenderness normalized out? ".repeat(4),
            found: vec!["It is, on average.".into(); 3],
            trust: "As far as the cases go. ".repeat(3),
        },
        findings: (0..7).map(finding).collect(),
        proof: "By the results handed in: all cases pass.".into(),
        families: vec![Family {
            name: "free-rocking".into(),
            purpose: "The motion has closed forms.".into(),
            cases: (0..3).map(case).collect(),
        }],
        tables: vec![PlainTable {
            name: "table-1".into(),
            title: "Table 1. The blocks".into(),
            reading: "Sizes follow from p and alpha.".into(),
            header: words(&["α (rad)", "p (1/s)", "R (m)", "2b (m)"]),
            rows: vec![words(&["0.05", "1", "7.358", "0.735"]); 5],
        }],
        figures: demonstration().iter().map(shown).collect(),
        provenance: vec![
            ("version".into(), "0.1.0".into()),
            (
                "suite ordinary".into(),
                "sha256 ".to_owned() + &"ab1".repeat(21),
            ),
        ],
        limits: vec!["Two suites only.".into(); 3],
        credibility: vec![],
    }
}

/// Writes the page where `ROCKING_FIGURES` says, to be looked at.
#[test]
fn writes_it_to_be_looked_at() {
    let Ok(folder) = std::env::var("ROCKING_FIGURES") else { return };
    std::fs::write(format!("{folder}/index.html"), page(&made_up())).unwrap();
}

#[test]
fn same_bytes_twice() {
    assert_eq!(page(&made_up()), page(&made_up()));
}

#[test]
fn asks_nothing_of_network_or_scripts() {
    let html = page(&made_up());
    for word in ["<script", "<link", "@import", "url(", "src="] {
        assert!(!html.contains(word), "{word}");
    }
    let plain = html.replace("http://www.w3.org/2000/svg", "");
    assert!(!plain.contains("http"));
}

#[test]
fn every_anchor_leads_somewhere_and_no_name_is_used_twice() {
    let html = page(&made_up());
    let values = |key: &str| -> Vec<String> {
        let parts = html.split(key).skip(1);
        parts.map(|p| p.split('"').next().unwrap().to_owned()).collect()
    };
    let mut ids = values(" id=\"");
    assert!(ids.len() > 30);
    for target in values("href=\"#") {
        assert!(ids.contains(&target), "{target}");
    }
    for labels in values("aria-labelledby=\"") {
        for label in labels.split(' ') {
            assert!(ids.contains(&label.to_owned()), "{label}");
        }
    }
    let all = ids.len();
    ids.sort();
    ids.dedup();
    assert_eq!(ids.len(), all);
}

#[test]
fn has_landmarks_and_headings_without_gaps() {
    let html = page(&made_up());
    for tag in ["<header>", "<nav ", "<main ", "<footer>", "lang=\"en\""] {
        assert_eq!(html.matches(tag).count(), 1, "{tag}");
    }
    let levels = html.match_indices("<h").filter_map(|(at, _)| {
        html[at + 2..].chars().next().and_then(|c| c.to_digit(10))
    });
    let levels: Vec<u32> = levels.collect();
    assert_eq!(levels.iter().filter(|l| **l == 1).count(), 1);
    assert!(levels.windows(2).all(|w| w[1] <= w[0] + 1), "{levels:?}");
    assert_eq!(
        html.matches("<svg").count(),
        html.matches("role=\"img\"").count()
    );
}

#[test]
fn figures_share_one_style_sheet() {
    assert_eq!(page(&made_up()).matches(colour::STYLE).count(), 1);
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
