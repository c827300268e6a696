//! The results in the README are those of the committed report.

use rocking_validation::findings::{Findings, Topic};
use rocking_validation::paper::{Intensity, SuiteKind, Verdict};
use serde_json::Value;

use super::read;

const BEGIN: &str = "<!-- results -->\n";
const END: &str = "<!-- end of results -->";

/// Number of claims with each verdict.
fn claims(findings: &Findings) -> String {
    let claims = &findings.claims;
    let count = |v: Verdict| claims.iter().filter(|c| c.verdict == v).count();
    format!(
        "{} of {} confirmed, {} not confirmed, {} inconclusive",
        count(Verdict::Confirmed),
        claims.len(),
        count(Verdict::NotConfirmed),
        count(Verdict::Inconclusive)
    )
}

/// Median overturning intensities of one block, with their intervals.
fn overturning(findings: &Findings, suite: SuiteKind) -> String {
    let table = findings.table(Topic::Overturning).unwrap();
    let row = table.rows.iter().find(|row| {
        row.at.suite == Some(suite)
            && row.at.intensity == Some(Intensity::Pga)
            && row.at.p_rad_s == Some(3.0)
            && row.at.alpha_rad == Some(0.2)
    });
    let median = row.unwrap().values[0];
    let (low, high) = median.interval.unwrap();
    format!("{:.2} ({low:.2} to {high:.2})", median.value)
}

/// Share of its tolerance that half of all compared numbers stay below.
fn middle_margin(cases: &Value) -> f64 {
    let mut margins: Vec<f64> = cases
        .as_object()
        .unwrap()
        .values()
        .flat_map(|case| case["quantities"].as_object().unwrap().values())
        .filter(|quantity| quantity["kind"] != "waived")
        .filter_map(|quantity| quantity["margin"].as_f64())
        .collect();
    margins.sort_by(f64::total_cmp);
    margins[margins.len() / 2]
}

fn table() -> String {
    let report = |name: &str| read(&format!("reports/data/{name}"));
    let findings = Findings::parse(&report("findings.json")).unwrap();
    let cases: Value =
        serde_json::from_str(&report("validation.json")).unwrap();
    let all = cases.as_object().unwrap();
    let passed = all.values().filter(|case| case["verdict"] == "pass").count();
    let rejected: usize = all
        .values()
        .map(|case| case["rejected"].as_object().unwrap().len())
        .sum();
    let suites = &findings.suites;
    let analyses: u64 = suites.iter().map(|suite| suite.analyses).sum();
    let open: usize =
        suites.iter().map(|suite| suite.not_told_by_double_precision).sum();
    let rows = [
        (
            "declared cases that pass",
            format!(
                "{passed} of {}; half of their numbers use less than {:.0e} \
                 of the tolerance; wrong models rejected: {rejected}",
                all.len(),
                middle_margin(&cases)
            ),
        ),
        ("claims of the paper, embedded suites", claims(&findings)),
        (
            "analyses up to overturning; flagged: rounding may have \
             changed their peak or fate",
            format!("{analyses}; {open}"),
        ),
        (
            "median overturning PGA/(g tan alpha), p = 3 rad/s, alpha = \
             0.20, ordinary (95 % interval)",
            overturning(&findings, SuiteKind::Ordinary),
        ),
        ("the same, pulse-type", overturning(&findings, SuiteKind::PulseType)),
    ];
    let lines: Vec<String> = rows
        .iter()
        .map(|(what, result)| format!("| {what} | {result} |\n"))
        .collect();
    format!("| what | result |\n|---|---|\n{}", lines.concat())
}

#[test]
fn the_readme_shows_the_committed_results() {
    let readme = read("README.md");
    let (_, rest) = readme.split_once(BEGIN).unwrap();
    let (found, _) = rest.split_once(END).unwrap();
    let expected = table();
    assert!(
        found == expected,
        "README.md, between the marks of the results, expected:\n{expected}"
    );
    let figure = "reports/figures/figure-08-c.svg";
    assert!(readme.contains(figure) && read(figure).starts_with("<svg"));
}
