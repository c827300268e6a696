//! The language of texts for people: no stale number, no word of a house
//! dialect.

use super::{files, pass, read};

/// Pages that people write, without what tests fill.
fn pages() -> Vec<String> {
    let own = [
        "README.md",
        "ARCHITECTURE.md",
        "CONTRIBUTING.md",
        "SECURITY.md",
        "paper.md",
        "src/README.md",
        "src/certainty.md",
        "python/README.md",
        "fixtures/benchmark/README.md",
    ];
    let docs = files("docs").into_iter();
    let docs = docs.filter(|path| path.ends_with(".md"));
    docs.chain(own.map(str::to_owned)).collect()
}

/// Words of the page and of the help, which people write elsewhere.
fn words() -> Vec<String> {
    let mut out = files("validation/study/claims");
    out.extend(
        ["study", "report"].map(|of| format!("validation/{of}/words.toml")),
    );
    out.push("validation/report/answers.toml".into());
    let help = files("tests/cli/snapshots").into_iter();
    out.extend(help.filter(|path| path.contains("help")));
    out
}

/// The lines of a page between its marks, and outside of them.
fn prose(page: &str) -> Vec<String> {
    let text = read(page);
    let mut parts = text.split("<!-- results: ");
    let mut out = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        out += part.split_once("<!-- end of results -->").expect(page).1;
    }
    let mut is_code = false;
    let lines = out.lines().map(str::to_owned);
    lines
        .filter(|line| {
            let is_fence = line.trim_start().starts_with("```");
            is_code ^= is_fence;
            !is_code && !is_fence
        })
        .collect()
}

/// Figures that look like results: a number with per cent, years, times or ns,
/// or with an exponent.
fn figures(line: &str) -> Vec<String> {
    let words: Vec<&str> = line.split_whitespace().collect();
    let number = |word: &str| {
        let word = word.trim_start_matches(['(', '`', '±', '+', '-']);
        word.starts_with(|c: char| c.is_ascii_digit())
    };
    let mut out = Vec::new();
    for (k, word) in words.iter().enumerate().filter(|(_, w)| number(w)) {
        let next = words.get(k + 1).copied().unwrap_or_default();
        let next = next.trim_end_matches([',', '.', ';', ':', ')', '|']);
        let is_measured = ["%", "years", "times", "ns"].contains(&next)
            || word.contains('%')
            || word.contains("e-");
        if is_measured {
            out.push(format!("{word} {next}"));
        }
    }
    out
}

/// Figures that are no results of the program: levels of quantiles and
/// intervals, limits that the program has as constants, and the measurements
/// of one campaign that the page describes.
const FIXED: [(&str, &str, &str); 15] = [
    ("", "% interval", "level of an interval"),
    ("", "% intervals", "level of an interval"),
    ("", "% quantile", "level of a quantile"),
    ("", "SA(T, 5 %)", "damping of a spectrum"),
    ("docs/tables.md", "", "written by a test from the columns"),
    ("docs/commands.md", "1.5 times uplift", "input of an example"),
    ("docs/formats.md", "1e-150", "range of an input"),
    ("docs/report.md", "90 %", "level of an interval"),
    ("docs/report.md", "(5 % of a response ratio", "limit of `rocking diff`"),
    ("docs/report.md", "are its 95 %", "level of an interval"),
    ("docs/theory.md", "off by more than 15 %", "rule set before the law"),
    ("docs/theory.md", "0.15 to 1.0 times 2 pi/p", "definition of a measure"),
    ("docs/tour.md", "0.15 to 1.0 times 2 pi/p", "definition of a measure"),
    ("src/certainty.md", "", "limits in the code, and one campaign"),
    ("fixtures/benchmark/README.md", "", "limits of the score"),
];

#[test]
fn a_number_of_a_result_stands_between_marks() {
    let mut problems = Vec::new();
    for page in pages() {
        for line in prose(&page) {
            let is_fixed = FIXED.iter().any(|(own, words, _)| {
                (own.is_empty() || *own == page) && line.contains(words)
            });
            if !is_fixed {
                let all = figures(&line).into_iter();
                problems.extend(all.map(|own| format!("{page}: {own}")));
            }
        }
    }
    pass(&problems);
    assert_eq!(figures("| (5.3 % of 7 records), 31 times").len(), 2);
    assert_eq!(figures("off by 2.2e-16, in 13 ns").len(), 2);
    assert_eq!(figures("see Figure 8 and 44 records"), [""; 0]);
}

/// Words that a native editor sends back, each with a better one.
const DIALECT: [(&str, &str); 14] = [
    ("alone", "only, by itself"),
    ("are none", "a noun or an adjective"),
    ("arm", "grid"),
    ("arms", "grids"),
    ("asked", "requested"),
    ("come out otherwise", "are judged differently"),
    ("declared case", "reference case"),
    ("declared cases", "reference cases"),
    ("fate", "outcome"),
    ("fates", "outcomes"),
    ("is none", "a noun or an adjective"),
    ("so many", "a number of"),
    ("told", "distinguished, given"),
    ("whoever", "a person who"),
];

#[test]
fn texts_for_people_are_without_dialect() {
    let mut problems = Vec::new();
    let texts = pages().into_iter().map(|page| (prose(&page), page));
    let words = words().into_iter().map(|path| {
        let lines = read(&path).lines().map(str::to_owned).collect();
        (lines, path)
    });
    for (lines, path) in texts.chain(words) {
        for line in lines.iter().filter(|line| !is_exempt(line)) {
            let line = line.to_lowercase();
            let parts = line.split(|c: char| !c.is_alphanumeric() && c != '-');
            let line = format!(" {} ", parts.collect::<Vec<_>>().join(" "));
            let own = DIALECT
                .iter()
                .filter(|(word, _)| line.contains(&format!(" {word} ")));
            let own = own.map(|(word, better)| {
                format!("{path}: {word:?}, better: {better}: {line}")
            });
            problems.extend(own);
        }
    }
    pass(&problems);
}

/// Words of the paper, and names that commands and files have.
fn is_exempt(line: &str) -> bool {
    ["quote", "arms = "].iter().any(|own| line.starts_with(own))
        || ["--arms", "--fate", "`"].iter().any(|own| line.contains(own))
}
