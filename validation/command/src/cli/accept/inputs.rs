//! Files of `fixtures` that this program made and that it compiles in: the
//! surrogate, and what a study of the recorded suites found.

use std::env;
use std::fs;
use std::path::Path;
use std::process::Command;

use super::super::study;
use crate::failure::Failure;
use crate::terminal::note;
use rocking_common::paper::SuiteKind;
use rocking_common::suites::inputs::sha256_hex;
use rocking_report::output::{FIGURES, FINDINGS, Files};
use rocking_report::stale;
use rocking_surrogate::{self as surrogate, Surrogate};

/// The recorded suites, which the repository may not hold.
const RECORDED: [&str; 2] =
    ["../shared/records/ordinary.csv", "../shared/records/pulse.csv"];

/// What a study of them found.
const RECORDED_FINDINGS: &str = "fixtures/recorded/findings.json";
/// What its figures draw.
const RECORDED_FIGURES: &str = "fixtures/recorded/figures.json";
/// Embedded and recorded suites side by side.
const COMPARISON: &str = "fixtures/comparison/suites.csv";
/// The blocks that the surrogate is fitted to.
const DESIGN: &str = "fixtures/surrogate/design.csv";
const UNSEEN: &str = "fixtures/surrogate/unseen.csv";
const COEFFICIENTS: &str = "fixtures/surrogate/coefficients.csv";
/// Hashes of all fixtures.
const MANIFEST: &str = "fixtures/MANIFEST.toml";

/// Numbers of blocks: fitted to, and unseen.
const BLOCKS: [u64; 2] = [1000, 100];
/// So many blocks are swept first. Where they are as they are kept, so are
/// all others, and twelve minutes of a core are saved.
const FIRST: u64 = 10;

/// The files that this program makes from what it has compiled in. Adds to
/// `words` what the recorded findings say differently.
///
/// # Errors
/// [`Failure`] for a sweep, a fit or a study that fails.
pub(super) fn made(words: &mut String) -> Result<Files, Failure> {
    let mut files = Files::new();
    let mut put = |name: &str, text: String| {
        files.insert(name.into(), text.into_bytes());
    };
    note(&format!("sweeps of {FIRST} blocks for the surrogate"));
    if swept(1, FIRST)? != first_of(&super::file(DESIGN)?) {
        let [design, unseen] = [(1, BLOCKS[0]), (1 + BLOCKS[0], BLOCKS[1])];
        note("sweeps of all blocks for the surrogate: minutes");
        let design = swept(design.0, design.1)?;
        // What is kept is what is fitted.
        let blocks = surrogate::read_table(DESIGN, &design)?;
        let (models, _) = surrogate::fit(&blocks)?;
        put(COEFFICIENTS, Surrogate::coefficients(&models));
        put(DESIGN, design);
        put(UNSEEN, swept(unseen.0, unseen.1)?);
    }
    if RECORDED.iter().all(|path| Path::new(path).is_file()) {
        note("study of the recorded suites");
        let [ordinary, pulse] = RECORDED;
        let suites = ["--ordinary", ordinary, "--pulse", pulse];
        let text = |files: &Files, name: &str| -> Result<String, Failure> {
            let file = files.get(name).ok_or_else(|| {
                Failure::gate(format!("the study writes no {name}"))
            })?;
            Ok(String::from_utf8_lossy(file).into_owned())
        };
        let all = study::report(&suites, None)?;
        let found = text(&all, FINDINGS)?;
        let old = super::file(RECORDED_FINDINGS)?;
        let path = Path::new(RECORDED_FINDINGS);
        *words += &stale::compared(path, &old, &found);
        put(RECORDED_FINDINGS, found);
        put(RECORDED_FIGURES, text(&all, FIGURES)?);
        let of_c =
            study::report(&[&suites, &["--arms", "C"][..]].concat(), None)?;
        put(COMPARISON, text(&of_c, "data/suites.csv")?);
    } else {
        note(&format!(
            "left as they are: {RECORDED_FINDINGS}, {RECORDED_FIGURES} and \
             {COMPARISON}, no {}",
            RECORDED.join(", ")
        ));
    }
    let mut manifest = super::file(MANIFEST)?;
    for (name, new) in &files {
        let old = fs::read(name).unwrap_or_default();
        manifest = manifest.replace(&sha256_hex(&old), &sha256_hex(new));
    }
    files.insert(MANIFEST.into(), manifest.into_bytes());
    Ok(files)
}

/// The first blocks of both suites in a table, with its header.
fn first_of(table: &str) -> String {
    let of = |suite: SuiteKind| {
        let own = format!("{},", suite.name());
        let rows = table.lines().filter(move |row| row.starts_with(&own));
        rows.take(FIRST as usize)
    };
    let rows = SuiteKind::ALL.into_iter().flat_map(of);
    let rows = table.lines().take(1).chain(rows);
    rows.map(|row| format!("{row}\n")).collect()
}

/// Overturning of blocks of the surrogate's design under both embedded
/// suites, as a table: the commands of `rocking sweep`.
fn swept(first: u64, blocks: u64) -> Result<String, Failure> {
    let place = tempfile::tempdir()?;
    // Where cargo has put the program: the tests above may have put it there
    // anew.
    let program = fs::canonicalize(env::args_os().next().unwrap_or_default())?;
    let run = |line: &str| -> Result<(), Failure> {
        let done = Command::new(&program)
            .args(line.split_whitespace())
            .current_dir(place.path())
            .output()?;
        if done.status.success() {
            return Ok(());
        }
        let error = String::from_utf8_lossy(&done.stderr);
        Err(Failure::gate(format!("rocking {line}: {error}")))
    };
    let design = surrogate::design(first, blocks);
    fs::write(place.path().join("blocks.csv"), design)?;
    run("suite export --out suites")?;
    let mut all = Vec::new();
    for (suite, name) in SuiteKind::ALL.into_iter().zip(["ordinary", "pulse"])
    {
        run(&format!(
            "sweep plan --blocks blocks.csv --suite suites/{name}.csv \
             --out {name}"
        ))?;
        run(&format!("sweep run {name}"))?;
        run(&format!("sweep merge {name} --out {name}.csv"))?;
        let merged = place.path().join(format!("{name}.csv"));
        all.extend(surrogate::read_merged(suite, &merged)?);
    }
    Ok(surrogate::table(&all))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_rows_of_both_suites_are_taken() {
        let row = |suite: &str, k: u64| format!("{suite},{k}\n");
        let of = |count: u64| -> String {
            let rows = ["ordinary", "pulse-type"].into_iter();
            let rows = rows.flat_map(|s| (0..count).map(move |k| row(s, k)));
            "suite,k\n".to_owned() + &rows.collect::<String>()
        };
        assert_eq!(first_of(&of(12)), of(FIRST));
    }
}
