//! Measurements of single analyses as rows, in memory and as CSV.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::{Context as _, bail};
use serde::{Deserialize, Serialize};

use super::answers::{COMPARED, ToolAnswer};
use super::cases::SpeedCase;
use super::csv;
use rocking_common::words::rounded;

/// A tool with its setting on one case.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TimingRow {
    /// `rocking`, `SciPy` and so on.
    pub tool: String,
    /// Its version.
    pub version: String,
    /// `Taylor`, `DOP853` and so on.
    pub method: String,
    /// Order or relative tolerance.
    pub setting: String,
    /// Name of the case.
    pub case: String,
    /// Processor time in s.
    pub cpu_s: f64,
    /// Derivatives evaluated, or Taylor polynomials expanded.
    pub work: u64,
    /// Absolute error of peak |theta|/alpha; empty if one overturned.
    pub peak_error: Option<f64>,
    /// Largest error of the first ten impact times, in s; `inf` if one is
    /// missing.
    pub impact_error_s: f64,
    /// Whether the outcome is right.
    pub right_fate: bool,
    /// Whether the number of impacts is right.
    pub same_impacts: bool,
}

/// The answer of another tool: one line of its driver's output.
#[derive(Clone, Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct ToolRow {
    tool: String,
    version: String,
    method: String,
    setting: String,
    case: String,
    cpu_s: f64,
    work: u64,
    /// `inf` when overturned.
    peak_ratio: f64,
    impacts: usize,
    /// Times in s, separated by blanks.
    first_impacts_s: String,
}

/// A row from an answer, its CPU time in s and its work.
pub fn row(
    label: [&str; 4],
    (case, reference): (&SpeedCase, &ToolAnswer),
    (cpu_s, work): (f64, u64),
    answer: &ToolAnswer,
) -> TimingRow {
    let [tool, version, method, setting] = label.map(str::to_owned);
    let outcomes = [answer, reference].map(ToolAnswer::is_overturned);
    let peak_error = (answer.peak_ratio - reference.peak_ratio).abs();
    TimingRow {
        tool,
        version,
        method,
        setting,
        case: case.name.clone(),
        cpu_s,
        work,
        peak_error: (outcomes == [Some(false); 2]).then_some(peak_error),
        impact_error_s: answer.impact_error_s(reference),
        right_fate: outcomes[0].is_some() && outcomes[0] == outcomes[1],
        same_impacts: answer.impacts == reference.impacts,
    }
}

/// Reads the answers of another tool and compares them with the references.
///
/// # Errors
/// For a file that is not a driver's output.
pub fn read_answers(
    path: &Path,
    cases: &[(SpeedCase, ToolAnswer)],
) -> anyhow::Result<Vec<TimingRow>> {
    let shown = path.display();
    let table = || shown.to_string();
    let mut reader = csv::Reader::from_path(path).with_context(table)?;
    let mut rows = Vec::new();
    for given in reader.deserialize() {
        let given: ToolRow = given.with_context(table)?;
        let known = cases.iter().find(|(case, _)| case.name == given.case);
        let Some((case, reference)) = known else {
            bail!("{shown}: no such case: {}", given.case);
        };
        let times = given.first_impacts_s.split_whitespace();
        let times = times.map(str::parse).collect::<Result<_, _>>();
        let mut first_impacts_s: Vec<f64> = times.with_context(|| {
            let found = &given.first_impacts_s;
            format!("{shown}: impact times {found:?}: expected numbers")
        })?;
        first_impacts_s.truncate(COMPARED);
        let (peak_ratio, impacts) = (given.peak_ratio, given.impacts);
        let answer = ToolAnswer { peak_ratio, impacts, first_impacts_s };
        let ToolRow { tool, version, method, setting, .. } = &given;
        rows.push(row(
            [tool, version, method, setting],
            (case, reference),
            (given.cpu_s, given.work),
            &answer,
        ));
    }
    Ok(rows)
}

/// The rows as CSV: times to four digits, errors to three.
///
/// # Errors
/// None in practice: memory can be written to.
pub fn text(rows: &[TimingRow]) -> Result<Vec<u8>, csv::Error> {
    csv(rows.iter().map(|row| TimingRow {
        cpu_s: rounded(row.cpu_s, 4),
        peak_error: row.peak_error.map(|e| rounded(e, 3)),
        impact_error_s: rounded(row.impact_error_s, 3),
        ..row.clone()
    }))
}

/// Summary of a tool in one setting over the cases.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Total {
    /// Tool, version, method, setting.
    pub label: [String; 4],
    /// Cases.
    pub cases: usize,
    /// Median processor time in s.
    pub cpu_s: f64,
    /// Mean processor time in s.
    pub mean_cpu_s: f64,
    /// Median work.
    pub work: f64,
    /// Median error of the peak over the blocks that stand.
    pub peak_error: f64,
    /// The error of the peak that nine in ten do not exceed.
    pub peak_error_90: f64,
    /// The largest.
    pub peak_error_worst: f64,
    /// Median error of impact times in s.
    pub impact_error_s: f64,
    /// The largest.
    pub impact_error_worst_s: f64,
    /// Wrong outcomes.
    pub wrong_fates: usize,
    /// Cases with a wrong number of impacts.
    pub other_impacts: usize,
    /// Median ratio of the time to the time of the base tool on the same case;
    /// NaN if that has none.
    pub ratio: f64,
}

impl Total {
    /// Tool, method and setting, whatever the version.
    pub fn key(&self) -> [&str; 3] {
        let [tool, _, method, setting] = &self.label;
        [tool, method, setting]
    }
}

/// Totals by tool and setting, in the order of the rows; ratios are to the
/// times of `base` (tool, method, setting).
pub fn totals(rows: &[TimingRow], base: [&str; 3]) -> Vec<Total> {
    let label = |row: &TimingRow| {
        [&row.tool, &row.version, &row.method, &row.setting].map(String::clone)
    };
    let mut groups: Vec<([String; 4], Vec<&TimingRow>)> = Vec::new();
    for row in rows {
        let own = label(row);
        match groups.iter_mut().find(|(other, _)| *other == own) {
            Some((_, group)) => group.push(row),
            None => groups.push((own, vec![row])),
        }
    }
    let is_base = |row: &&TimingRow| {
        [row.tool.as_str(), &row.method, &row.setting] == base
    };
    let base_s: BTreeMap<&str, f64> = rows
        .iter()
        .filter(is_base)
        .map(|row| (row.case.as_str(), row.cpu_s))
        .collect();
    let total = |(label, of): ([String; 4], Vec<&TimingRow>)| {
        let at = |value: &dyn Fn(&TimingRow) -> f64, share| {
            ranked(of.iter().map(|row| value(row)).collect(), share)
        };
        let peak = |share| {
            ranked(of.iter().filter_map(|row| row.peak_error).collect(), share)
        };
        let sum = of.iter().fold(0.0, |sum, row| sum + row.cpu_s);
        let base_s = |row: &TimingRow| base_s.get(&*row.case).copied();
        Total {
            cases: of.len(),
            cpu_s: at(&|row| row.cpu_s, 0.5),
            mean_cpu_s: sum / of.len() as f64,
            work: at(&|row| row.work as f64, 0.5),
            peak_error: peak(0.5),
            peak_error_90: peak(0.9),
            peak_error_worst: peak(1.0),
            impact_error_s: at(&|row| row.impact_error_s, 0.5),
            impact_error_worst_s: at(&|row| row.impact_error_s, 1.0),
            wrong_fates: of.iter().filter(|row| !row.right_fate).count(),
            other_impacts: of.iter().filter(|row| !row.same_impacts).count(),
            ratio: at(&|r| r.cpu_s / base_s(r).unwrap_or(f64::NAN), 0.5),
            label,
        }
    };
    groups.into_iter().map(total).collect()
}

/// The smallest value that at least a share of the values do not exceed.
fn ranked(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    let place = (share * n as f64).ceil() as usize;
    values.get(place.max(1) - 1).copied().unwrap_or(f64::NAN)
}
