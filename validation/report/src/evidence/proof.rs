//! The results of the reference cases, as `rocking verify` wrote them.

use std::collections::BTreeSet;
use std::fmt;
use std::fs;
use std::path::Path;

use anyhow::{anyhow, bail};

use rocking_common::findings::LEVEL;
use rocking_common::suites::inputs::sha256_hex;
use rocking_common::table::{PlainTable, cells};
use rocking_common::words::{percent, range};
use rocking_proof::cases::{Case, Cost, load_all};
use rocking_proof::methods::DIGITS_HEADER;
use rocking_proof::verdict::snapshot::{self, CaseResult};

/// File of the results of the reference cases.
const RESULTS: &str = "verification.json";
/// File of the digits that each precision reaches.
const DIGITS: &str = "precision.csv";

/// Method of the cases that measure the coverage of the study's intervals.
const COVERAGE: &str = "coverage-of-inference";

/// How to get results that are missing.
pub const NOT_RUN: &str = "The reference cases were not run here: `rocking \
    verify --out FOLDER` runs them and writes their results to \
    FOLDER/data, and `rocking study --proof FOLDER/data` shows them.";

/// Results of the reference cases: one for each case that `rocking verify`
/// runs without `--full`.
#[derive(Clone, Debug)]
pub struct Proof {
    place: String,
    cases: Vec<Case>,
    results: snapshot::Results,
    digits: String,
    /// SHA-256 of the file of results.
    hash: String,
}

/// Shares of simulated suites in which an interval contains the truth: for
/// each claim the nominal share, and the share found.
#[derive(Clone, Debug)]
pub struct Coverage {
    rows: Vec<(String, f64, f64)>,
}

impl Coverage {
    /// The shares for the findings' intervals, in a sentence.
    pub fn words(&self) -> String {
        let own = self.rows.iter().filter(|row| row.1 == LEVEL);
        let (low, high) = range(own.map(|row| row.2));
        format!(
            "Coverage. Intervals of 90 % contained the known truth in {} to \
             {} of simulated suites (annex).",
            percent(low, 1),
            percent(high, 1)
        )
    }

    /// The shares, one by one.
    pub fn table(&self) -> PlainTable {
        let row = |(claim, nominal, share): &(String, f64, f64)| {
            vec![claim.clone(), percent(*nominal, 0), percent(*share, 1)]
        };
        PlainTable::new(
            "coverage",
            "Coverage of the intervals of the findings",
            "Share of simulated suites, whose truth is known, in which the \
             interval contains it. The suites resemble the recorded ones in \
             their earthquakes and in the correlation of blocks and levels. \
             The standard error of a share is 1 to 3 %.",
            &["interval", "nominal", "found"],
            self.rows.iter().map(row).collect(),
        )
    }
}

impl Proof {
    /// Reads the folder into which `rocking verify` wrote the results.
    ///
    /// # Errors
    /// For a file that is missing or damaged, and for results of other cases
    /// than this program's.
    pub fn read(folder: &Path) -> anyhow::Result<Self> {
        let text = |name| file_text(&folder.join(name));
        Self::from_texts(folder, &text(RESULTS)?, text(DIGITS)?)
    }

    /// Results from the texts of both files; `folder` only appears in
    /// messages.
    fn from_texts(
        folder: &Path,
        results: &str,
        digits: String,
    ) -> anyhow::Result<Self> {
        let path = folder.join(RESULTS);
        let hash = sha256_hex(results.as_bytes());
        let results: snapshot::Results = serde_json::from_str(results)
            .map_err(|e| anyhow!("{}: {e}, expected JSON", path.display()))?;
        let mut cases = load_all()?;
        cases.retain(|case| case.cost == Cost::Quick);
        same_cases(&path, &cases, &results)?;
        whole_table(&folder.join(DIGITS), &digits)?;
        // The same words wherever the folder lies.
        let place = Path::new(folder.file_name().unwrap_or_default());
        let place = place.join(RESULTS).display().to_string();
        Ok(Self { place, cases, results, digits, hash })
    }

    /// The results in a folder; none if it has neither file.
    ///
    /// # Errors
    /// As [`Proof::read`].
    pub fn find(folder: &Path) -> anyhow::Result<Option<Self>> {
        let there = |name| folder.join(name).exists();
        (there(RESULTS) || there(DIGITS))
            .then(|| Self::read(folder))
            .transpose()
    }

    /// Its files, each with its hash.
    pub fn hashes(&self) -> [(String, String); 2] {
        let digits = sha256_hex(self.digits.as_bytes());
        [(RESULTS.into(), self.hash.clone()), (DIGITS.into(), digits)]
    }

    /// The results by id.
    pub fn results(&self) -> &snapshot::Results {
        &self.results
    }

    /// Number of cases that passed.
    pub fn passed(&self) -> usize {
        self.results.values().filter(|case| case.passed()).count()
    }

    /// Number of cases that failed.
    pub fn failed(&self) -> usize {
        self.results.len() - self.passed()
    }

    /// The reference cases with their results, in the order of the files.
    pub fn cases(&self) -> impl Iterator<Item = (&Case, &CaseResult)> {
        // Every case has a result, or the results were refused.
        self.cases.iter().filter_map(|case| {
            self.results.get(&case.id).map(|result| (case, result))
        })
    }

    /// Those cases by family, under its name.
    pub fn families(&self) -> Vec<(&str, Vec<(&Case, &CaseResult)>)> {
        let all: Vec<_> = self.cases().collect();
        let families = all.chunk_by(|a, b| a.0.family == b.0.family);
        families.map(|own| (own[0].0.family.as_str(), own.to_vec())).collect()
    }

    /// How often the intervals of the study contain the truth of simulated
    /// suites, from the cases that simulate them.
    pub fn coverage(&self) -> Coverage {
        let own = self.cases().filter(|(case, _)| case.method == COVERAGE);
        let row = |(case, result): (&Case, &CaseResult)| {
            let nominal = case.input.get("nominal")?.as_float()?;
            let rate = result.quantities.get("rate");
            let rate = rate.and_then(|rate| rate.first.first());
            let share = rate.map_or(f64::NAN, |rate| rate.0);
            Some((case.claim.clone(), nominal, share))
        };
        Coverage { rows: own.filter_map(row).collect() }
    }

    /// Significant digits that each precision reaches on the hard cases and
    /// the reference trajectories.
    pub fn digits_table(&self) -> PlainTable {
        PlainTable::new(
            "table-precision",
            "Table 2. Significant digits reached by three precisions",
            "End: the peak of |theta|/alpha, or the instant of overturning. \
             Impacts: the worst of the instants and speeds of the first ten. \
             If there is no reference of 36 digits, the double-double run is \
             taken as the truth. The same source runs in all three \
             precisions; digits that double precision lacks are lost to the \
             sensitivity of the motion, which the error estimate reports.",
            &[
                "case",
                "equation",
                "truth",
                "end, single",
                "end, double",
                "end, double-double",
                "impacts, single",
                "impacts, double",
                "impacts, double-double",
            ],
            self.digits.lines().skip(1).map(cells).collect(),
        )
    }
}

/// The origin of these results, the number of cases that passed, and the share
/// of the tolerances that their numbers use.
impl fmt::Display for Proof {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = self.results.values().flat_map(|case| case.compared());
        let mut shares: Vec<f64> = all
            .map(|(_, quantity)| quantity.margin.0)
            .filter(|share| share.is_finite())
            .collect();
        shares.sort_by(f64::total_cmp);
        let middle = shares.get(shares.len() / 2).copied();
        write!(
            f,
            "{} of {} reference cases pass against closed forms, trajectories \
             with 36 digits and other oracles, in a separate run ({}). In the \
             median, the {} numbers compared use {:.0e} of their tolerance.",
            self.passed(),
            self.results.len(),
            self.place,
            shares.len(),
            middle.unwrap_or(f64::NAN)
        )
    }
}

fn file_text(path: &Path) -> anyhow::Result<String> {
    fs::read_to_string(path).map_err(|error| {
        anyhow!(
            "cannot read {}: {error}; expected {RESULTS} and {DIGITS} as \
             `rocking verify --out` writes them",
            path.display()
        )
    })
}

fn same_cases(
    path: &Path,
    cases: &[Case],
    results: &snapshot::Results,
) -> anyhow::Result<()> {
    let declared: BTreeSet<&String> =
        cases.iter().map(|case| &case.id).collect();
    let found: BTreeSet<&String> = results.keys().collect();
    if declared == found {
        return Ok(());
    }
    let less = |a: &BTreeSet<&String>, b| {
        let ids: Vec<&str> = a.difference(b).map(|id| id.as_str()).collect();
        if ids.is_empty() { "none".into() } else { ids.join(", ") }
    };
    bail!(
        "{}: not the cases of this program; `rocking verify` runs those. \
         Missing: {}. Unknown: {}",
        path.display(),
        less(&declared, &found),
        less(&found, &declared)
    );
}

/// Refuses a table with other columns, without rows, or cut.
fn whole_table(path: &Path, text: &str) -> anyhow::Result<()> {
    let columns = cells(DIGITS_HEADER).len();
    let lines: Vec<&str> = text.split_inclusive('\n').collect();
    let is_whole = |(k, line): (usize, &str)| match k {
        0 => line == DIGITS_HEADER,
        _ => cells(line).len() == columns && line.ends_with('\n'),
    };
    // A header alone lacks a row.
    let padded = lines.iter().copied().chain((lines.len() < 2).then_some(""));
    let Some((k, found)) = padded.enumerate().find(|own| !is_whole(*own))
    else {
        return Ok(());
    };
    let expected = match k {
        0 => format!("{DIGITS_HEADER:?}"),
        _ => format!("a row of {columns} cells"),
    };
    bail!("{}:{}: {found:?}, expected {expected}", path.display(), k + 1)
}

/// The folder of the committed results.
#[cfg(test)]
fn committed() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../reports/data")
}

#[cfg(test)]
impl Proof {
    /// The committed results, of which the first `failed` are made to fail.
    pub(crate) fn committed(failed: usize) -> Self {
        let text = |name| file_text(&committed().join(name)).expect(name);
        let results = text(RESULTS).replacen(
            "\"verdict\": \"pass\"",
            "\"verdict\": \"fail\"",
            failed,
        );
        let proof = Self::from_texts(&committed(), &results, text(DIGITS));
        let proof = proof.expect("results");
        assert_eq!(proof.failed(), failed);
        proof
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Reads the committed results after a change of both texts.
    fn changed(
        name: &str,
        results: impl Fn(&str) -> String,
        digits: impl Fn(&str) -> String,
    ) -> String {
        let own = format!("rocking-proof-{name}-{}", std::process::id());
        let folder = std::env::temp_dir().join(own);
        fs::create_dir_all(&folder).unwrap();
        for (file, change) in
            [(RESULTS, &results as &dyn Fn(&str) -> String), (DIGITS, &digits)]
        {
            let text = fs::read_to_string(committed().join(file)).unwrap();
            fs::write(folder.join(file), change(&text)).unwrap();
        }
        let message = Proof::find(&folder)
            .map_or_else(|e| e.to_string(), |_| "accepted".into());
        fs::remove_dir_all(&folder).unwrap();
        message
    }

    fn refused(message: &str, words: &[&str]) {
        for word in words {
            assert!(message.contains(word), "{word:?} not in {message:?}");
        }
    }

    #[test]
    fn the_committed_results_are_whole_and_say_whose_they_are() {
        let proof = Proof::read(&committed()).unwrap();
        let (passed, all) = (proof.passed(), proof.results().len());
        assert_eq!(passed, all);
        let count = format!("{all} of {all} reference cases pass");
        let text = proof.to_string();
        assert!(text.starts_with(&count), "{text}");
        let place = "in a separate run (data/verification.json)";
        assert!(text.contains(place), "{text}");
        assert!(!text.contains("NaN"), "{text}");
        assert!(proof.digits_table().rows.len() > 30);
        assert!(Proof::find(Path::new("nowhere")).unwrap().is_none());
    }

    #[test]
    fn results_of_other_cases_are_refused_by_their_ids() {
        let same = str::to_owned;
        assert_eq!(changed("same", same, same), "accepted");
        let id = load_all().unwrap()[0].id.clone();
        let renamed = format!("{id}-renamed");
        let other = |text: &str| {
            let found = format!("\"{id}\": {{");
            assert!(text.contains(&found));
            text.replacen(&found, &format!("\"{renamed}\": {{"), 1)
        };
        let missing = format!("Missing: {id}. Unknown: {renamed}");
        refused(&changed("other", other, same), &[RESULTS, &missing]);
    }

    #[test]
    fn damaged_results_are_refused() {
        let same = str::to_owned;
        let half = |text: &str| text[..text.len() / 2].to_owned();
        refused(&changed("cut", half, same), &[RESULTS, "JSON"]);
        let bad = |text: &str| text.replacen("\"pass\"", "\"maybe\"", 1);
        refused(&changed("verdict", bad, same), &["maybe", "pass"]);
        let cut = |text: &str| text[..text.len() - 3].to_owned();
        refused(&changed("row", same, cut), &[DIGITS, "a row of 9 cells"]);
        let headless = |text: &str| text.replacen("equation", "eq", 1);
        refused(&changed("head", same, headless), &["precision.csv:1:"]);
        refused(&changed("none", same, |_| DIGITS_HEADER.into()), &[":2:"]);
    }

    #[test]
    fn one_file_alone_is_refused() {
        let own = format!("rocking-proof-alone-{}", std::process::id());
        let folder = std::env::temp_dir().join(own);
        fs::create_dir_all(&folder).unwrap();
        fs::copy(committed().join(RESULTS), folder.join(RESULTS)).unwrap();
        let message = Proof::find(&folder).unwrap_err().to_string();
        fs::remove_dir_all(&folder).unwrap();
        refused(&message, &[DIGITS, "rocking verify"]);
    }
}
