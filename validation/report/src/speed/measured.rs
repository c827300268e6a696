//! Measurements of single analyses as rows, in memory and as CSV.

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
    /// Absolute error of peak |theta|/alpha; empty where one overturned.
    pub peak_error: Option<f64>,
    /// Largest error of the first ten impact times, s; `inf` where one is
    /// missing.
    pub impact_error_s: f64,
    /// Whether the block stands where it should.
    pub right_fate: bool,
    /// Whether it has as many impacts.
    pub same_impacts: bool,
}

/// What a tool other than ours answered: one line of its driver's output.
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

/// A row from an answer and what it took.
pub fn row(
    [tool, version, method, setting]: [&str; 4],
    (case, reference): (&SpeedCase, &ToolAnswer),
    (cpu_s, work): (f64, u64),
    answer: &ToolAnswer,
) -> TimingRow {
    let error = answer.error(reference);
    TimingRow {
        tool: tool.into(),
        version: version.into(),
        method: method.into(),
        setting: setting.into(),
        case: case.name.clone(),
        cpu_s,
        work,
        peak_error: Some(error.peak).filter(|e| !e.is_nan()),
        impact_error_s: error.impact_s,
        right_fate: error.right_fate,
        same_impacts: error.same_impacts,
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
        let Ok(mut times) =
            times.map(str::parse).collect::<Result<Vec<_>, _>>()
        else {
            bail!(
                "{shown}: impact times {:?}: expected numbers",
                given.first_impacts_s
            );
        };
        times.truncate(COMPARED);
        let answer = ToolAnswer {
            peak_ratio: given.peak_ratio,
            impacts: given.impacts,
            first_impacts_s: times,
        };
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

/// What a tool with its setting came to over the cases.
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
    /// Median error of the peak, of those that stand.
    pub peak_error: f64,
    /// The error of the peak that nine in ten stay below.
    pub peak_error_90: f64,
    /// The largest.
    pub peak_error_worst: f64,
    /// Median error of impact times in s.
    pub impact_error_s: f64,
    /// The largest.
    pub impact_error_worst_s: f64,
    /// Wrong fates.
    pub wrong_fates: usize,
    /// Cases with another number of impacts.
    pub other_impacts: usize,
    /// Median ratio of the time to that of the reference tool's on the same
    /// case; NaN where it has none.
    pub ratio: f64,
}

impl Total {
    /// Tool, method and setting, whatever the version.
    pub fn key(&self) -> [&str; 3] {
        let [tool, _, method, setting] = &self.label;
        [tool, method, setting]
    }
}

/// Totals by tool and setting, in the order of the rows; ratios to the times
/// of `base` (tool, method, setting).
pub fn totals(rows: &[TimingRow], base: [&str; 3]) -> Vec<Total> {
    let label = |row: &TimingRow| {
        [&row.tool, &row.version, &row.method, &row.setting].map(String::clone)
    };
    let mut labels: Vec<[String; 4]> = Vec::new();
    for row in rows {
        let own = label(row);
        if !labels.contains(&own) {
            labels.push(own);
        }
    }
    let base_s = |case: &str| {
        let is = |row: &&TimingRow| {
            row.case == case
                && [row.tool.as_str(), &row.method, &row.setting] == base
        };
        rows.iter().find(is).map_or(f64::NAN, |row| row.cpu_s)
    };
    labels
        .into_iter()
        .map(|own| {
            let of: Vec<&TimingRow> =
                rows.iter().filter(|row| label(row) == own).collect();
            let each = |value: &dyn Fn(&TimingRow) -> f64| {
                of.iter().map(|row| value(row)).collect::<Vec<f64>>()
            };
            let peaks: Vec<f64> =
                of.iter().filter_map(|row| row.peak_error).collect();
            let impacts = each(&|row| row.impact_error_s);
            let times = each(&|row| row.cpu_s);
            let mean =
                times.iter().fold(0.0, |sum, t| sum + t) / times.len() as f64;
            Total {
                label: own.clone(),
                cases: of.len(),
                cpu_s: ranked(times, 0.5),
                mean_cpu_s: mean,
                work: ranked(each(&|row| row.work as f64), 0.5),
                peak_error: ranked(peaks.clone(), 0.5),
                peak_error_90: ranked(peaks.clone(), 0.9),
                peak_error_worst: ranked(peaks, 1.0),
                impact_error_s: ranked(impacts.clone(), 0.5),
                impact_error_worst_s: ranked(impacts, 1.0),
                wrong_fates: of.iter().filter(|r| !r.right_fate).count(),
                other_impacts: of.iter().filter(|r| !r.same_impacts).count(),
                ratio: ranked(each(&|row| row.cpu_s / base_s(&row.case)), 0.5),
            }
        })
        .collect()
}

/// The value that a share of the values does not exceed, in steps of one.
fn ranked(mut values: Vec<f64>, share: f64) -> f64 {
    values.sort_by(f64::total_cmp);
    let n = values.len();
    let place = (share * n as f64).ceil() as usize;
    values.get(place.max(1) - 1).copied().unwrap_or(f64::NAN)
}
