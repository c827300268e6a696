//! The files of a report, and where they lie in its folder.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs;
use std::path::Path;

use crate::answers;
pub use crate::answers::AnswerRow;
use crate::basis::{self, FindingSets};
use crate::evidence::{self, Proof};
use crate::head::Signatures;
use crate::law::LawCells;
use crate::page::{Page, TITLE, annexes, html};
use crate::quantity::{count_text, effect_text};
use crate::scored;
use crate::shaking::{self, RockTests};
use crate::timings::Timings;
use crate::words::words;
use rocking_common::files::{SUMS, sums};
use rocking_common::findings::{Claim, Exists, Findings};
use rocking_common::paper::{FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD};
use rocking_common::suites::inputs::sha256_hex;
use rocking_common::table::{PlainTable, Table, number};
use rocking_draw::figures::Figure;
use rocking_study::results::StudyResults;
use rocking_study::{Study, questions};

/// Files of a report by name; folders in a name are parted by `/`.
pub type Files = BTreeMap<String, Vec<u8>>;

/// The page of a report.
pub const PAGE: &str = "index.html";

/// The files that are put into place last: where they are, all others are.
pub const LAST: [&str; 2] = [PAGE, SUMS];

/// Results of the declared cases, which `rocking verify` writes.
pub(super) const CASES: [&str; 2] =
    ["data/precision.csv", "data/verification.json"];

/// Where a report's findings lie.
pub const FINDINGS: &str = "data/findings.json";

/// Where a report on suites of files has what its figures draw.
pub const FIGURES: &str = "data/figures.json";

/// What of a folder no study wrote, if it holds such a thing: a report there
/// would replace it, or stand among it.
///
/// A study's folder is known by its findings and its page. Results of the
/// declared cases alone, which a study shows, are no hindrance; hidden files
/// are none either.
pub fn foreign(folder: &Path) -> Option<String> {
    let read = |name: &str| fs::read(folder.join(name)).ok();
    let findings = read(FINDINGS);
    if findings.is_some_and(|text| Findings::is_any(&text)) {
        let page = read(PAGE).filter(|page| !is_page(page));
        return page.map(|_| PAGE.to_owned());
    }
    let entries = |inner: &str| {
        let entries = fs::read_dir(folder.join(inner));
        let names = entries.into_iter().flatten().flatten();
        let names = names.map(|entry| {
            format!("{inner}{}", entry.file_name().to_string_lossy())
        });
        names.filter(|name| !name.starts_with('.')).collect::<Vec<_>>()
    };
    let mut all = entries("");
    if folder.join("data").is_dir() {
        all.retain(|name| name != "data");
        all.extend(entries("data/"));
    }
    all.retain(|name| !CASES.contains(&name.as_str()));
    all.sort();
    all.into_iter().next()
}

/// Title of the page in former versions.
const FORMER: &str = "The statistics of rocking";

/// Whether it is the page of a study, of whatever version.
fn is_page(text: &[u8]) -> bool {
    let head = &text[..text.len().min(1 << 12)];
    let head = String::from_utf8_lossy(head);
    let is_titled =
        |own: &str| head.contains(&format!("<title>{own}</title>"));
    text.starts_with(b"<!DOCTYPE html>")
        && [TITLE, FORMER].into_iter().any(is_titled)
}

/// Puts what a person compares into `data/`, drawings into `figures/`; the
/// page stays on top.
fn laid_out(files: Files) -> Files {
    let place = |name: String| match name.rsplit_once('.') {
        Some((_, "csv" | "json")) => format!("data/{name}"),
        Some((_, "svg")) => format!("figures/{name}"),
        _ => name,
    };
    files.into_iter().map(|(name, text)| (place(name), text)).collect()
}

/// The report's files: `index.html`, numbers in `data/`, drawings in
/// `figures/`, and the manifest of all of them. The page shows `proof`, the
/// results of the declared cases, if they were handed in. It links
/// [`lab::LAB`](crate::lab::LAB) if that lies beside it.
///
/// # Errors
/// Where a figure cannot be drawn, and for two files of one name.
pub fn files(
    study: &Study,
    proof: Option<&Proof>,
    signatures: &Signatures,
    lab: bool,
) -> anyhow::Result<Files> {
    let mut files = Files::new();
    let (timings, tests) = (Timings::kept()?, RockTests::kept()?);
    let mut charts = vec![timings.figure(), scored::codes_figure()?];
    charts.extend(evidence::charts()?);
    charts.extend(tests.figures());
    charts.push(LawCells::kept()?.figure()?);
    let basis = FindingSets::of(study.results.embedded(), &study.findings)?;
    let figures = basis.figures(&study.figures)?;
    for figure in figures.iter().chain(&charts) {
        let name = &figure.heading.name;
        put(&mut files, format!("{name}.svg"), figure.svg())?;
        put(&mut files, format!("{name}.csv"), figure.csv())?;
    }
    put(&mut files, "single-records.csv", single_csv(&study.results))?;
    put(&mut files, "findings.json", study.findings.text())?;
    put(&mut files, "shaking-table.json", shaking::KEPT)?;
    if !basis.embedded {
        put(&mut files, "figures.json", basis::kept(study)?)?;
    }
    for (name, text) in questions::answer_files(&study.answers) {
        put(&mut files, name, text)?;
    }
    let page = Page {
        study,
        basis: &basis,
        figures: &figures,
        charts: &charts,
        proof,
        signatures,
        tests: &tests,
        timings: &timings,
        words: words()?,
        lab,
    };
    let annexes = annexes(&page)?;
    let mut titles = titles(study, figures.iter().chain(&charts));
    let filed = annexes.iter().filter(|annex| annex.is_filed);
    for table in filed.flat_map(|annex| &annex.tables) {
        put(&mut files, format!("{}.csv", table.name), csv(table))?;
        titles.insert(table.name.clone(), table.title.clone());
    }
    let listed = list(&files, proof, &titles);
    let text = html(&page, &annexes, &listed)?;
    files.insert(PAGE.into(), text.into_bytes());
    let mut files = laid_out(files);
    files.insert(SUMS.into(), sums(&files));
    Ok(files)
}

/// Adds a file, whose name no other file may have.
fn put(
    files: &mut Files,
    name: impl Into<String>,
    text: impl Into<Vec<u8>>,
) -> anyhow::Result<()> {
    let name = name.into();
    anyhow::ensure!(!files.contains_key(&name), "two files named {name}");
    files.insert(name, text.into());
    Ok(())
}

/// A table of the page as CSV.
fn csv(printed: &PlainTable) -> String {
    let header: Vec<&str> =
        printed.header.iter().map(String::as_str).collect();
    let mut table = Table::new(&header);
    for row in &printed.rows {
        table.row(row.clone());
    }
    table.finish()
}

/// The data files and their hashes, with what they hold.
fn list(
    files: &Files,
    proof: Option<&Proof>,
    titles: &BTreeMap<String, String>,
) -> PlainTable {
    let own = files.iter().filter(|(name, _)| !name.ends_with(".svg"));
    let own = own.map(|(name, text)| (name.clone(), sha256_hex(text)));
    let cases = proof.into_iter().flat_map(Proof::hashes);
    let all: BTreeMap<String, String> = own.chain(cases).collect();
    let row = |(name, hash): (&String, &String)| {
        let stem = name.rsplit_once('.').map_or("", |(stem, _)| stem);
        let holds = titles.get(stem).map_or("", String::as_str);
        vec![format!("data/{name}"), holds.to_owned(), hash.clone()]
    };
    PlainTable::new(
        "list-of-files",
        "Annexes: data files and their hashes",
        "Each annex is a file beside this page. Its SHA-256 identifies the \
         version that this report is based on.",
        &["file", "content", "SHA-256"],
        all.iter().map(row).collect(),
    )
}

/// What the files hold, by name.
fn titles<'a>(
    study: &Study,
    figures: impl Iterator<Item = &'a Figure>,
) -> BTreeMap<String, String> {
    let figures = figures.map(|figure| {
        let heading = &figure.heading;
        (
            heading.name.clone(),
            format!("{}. {}", heading.label(), heading.title),
        )
    });
    let questions = study.answers.iter().flat_map(|answer| {
        let names = answer.files.iter().map(|(name, _)| name);
        let names = names.map(|name| name.replace(".csv", ""));
        names.map(|name| (name, answer.question.to_owned()))
    });
    let known = [
        ("findings", "Every statement with its results by suite and grid"),
        ("precision", "Digits that three precisions reach"),
        ("shaking-table", "Tests on a shaking table, and the model's"),
        ("single-records", "Records one by one: Figures 2 to 5 for all"),
        ("verification", "Every reference case with its result"),
    ];
    let known = known.map(|(name, words)| (name.to_owned(), words.to_owned()));
    figures.chain(questions).chain(known).collect()
}

/// Every record's histories and curves against those of alpha = 0.10.
fn single_csv(results: &StudyResults) -> String {
    let mut table = Table::headed(
        "suite,record,p_rad_s,intensity_pga,alpha_rad,normalized_l2_distance,\
         peak_ratio,mean_abs_ln_im_ratio",
    );
    let others: Vec<f64> = (0..SLENDERNESSES_RAD.len())
        .filter(|s| *s != REFERENCE)
        .map(|s| SLENDERNESSES_RAD[s])
        .collect();
    for suite in results.suites() {
        for (single, p) in suite.single.iter().zip(FREQUENCIES_RAD_S) {
            for (record, apart) in suite.records.iter().zip(&single.apart) {
                for (alpha, a) in others.iter().zip(apart) {
                    table.row([
                        suite.kind.name().into(),
                        record.name.clone(),
                        number(p),
                        number(single.im),
                        number(*alpha),
                        number(a.distance),
                        number(a.peak_ratio),
                        number(a.mean_ln_im),
                    ]);
                }
            }
        }
    }
    table.finish()
}

/// The first table of a page on embedded suites or others, and in a sentence
/// where other motions answer otherwise.
///
/// # Errors
/// Where the kept timings or results cannot be read.
pub fn first_table(
    embedded: bool,
    findings: &Findings,
    proof: Option<&Proof>,
) -> anyhow::Result<(Vec<AnswerRow>, Option<String>)> {
    let basis = FindingSets::of(embedded, findings)?;
    let rows = answers::rows(&basis, &Timings::kept()?, proof, &[])?;
    Ok((rows, answers::differing(&basis)?))
}

/// The answers of the page as text for a terminal.
///
/// # Errors
/// As [`first_table`].
pub fn answers_text(
    study: &Study,
    proof: Option<&Proof>,
) -> anyhow::Result<String> {
    let (embedded, findings) = (study.results.embedded(), &study.findings);
    let basis = FindingSets::of(embedded, findings)?;
    let (rows, otherwise) = first_table(embedded, findings, proof)?;
    let text = |row: &AnswerRow| {
        let AnswerRow { question, answer, effect, .. } = row;
        format!("{question}\n  {answer}\n  {effect}.\n")
    };
    let rows = rows.iter().map(text).chain(otherwise.map(|w| w + "\n"));
    let summary = answers::summary(&basis, proof)?;
    let summary = summary.into_iter().map(|(_, words)| words + "\n");
    Ok(summary.chain(rows).collect())
}

/// The findings among the claims as a table for people: whether each is seen
/// and exists, its effect, and the numbers by which it is seen or not.
pub fn claims_table(claims: &[Claim]) -> String {
    let mut out = String::new();
    for claim in claims {
        for result in &claim.results {
            let both = claim.yardsticks.iter().zip(&result.counts);
            let counts: Vec<String> =
                both.map(|(y, n)| count_text(y, n)).collect();
            // Writing to a string cannot fail.
            let _ = writeln!(
                out,
                "{:<13} {:<13} {:<26} {:<17} {:<32} {}",
                result.seen,
                result.exists.map_or("-", Exists::name),
                claim.id,
                result.place(),
                effect_text(claim, result).whole(),
                counts.join("; "),
            );
        }
    }
    out
}
