//! The results in the README are those of the committed report.

use serde_json::Value;

use super::read;

const BEGIN: &str = "<!-- results -->\n";
const END: &str = "<!-- end of results -->";

fn report(name: &str) -> Value {
    serde_json::from_str(&read(&format!("reports/data/{name}"))).unwrap()
}

fn list<'a>(value: &'a Value, name: &str) -> &'a [Value] {
    value[name].as_array().unwrap()
}

/// Number of claims with each verdict.
fn claims(findings: &Value) -> String {
    let claims = list(findings, "claims");
    let count = |verdict: &str| {
        claims.iter().filter(|c| c["verdict"] == verdict).count()
    };
    format!(
        "{} of {} confirmed, {} not confirmed, {} inconclusive",
        count("confirmed"),
        claims.len(),
        count("not confirmed"),
        count("inconclusive")
    )
}

/// Median overturning intensities of one block, with their intervals.
fn overturning(findings: &Value, suite: &str) -> String {
    let row = list(findings, "overturning").iter().find(|row| {
        row["suite"] == suite
            && row["im_kind"] == "pga"
            && row["p_rad_s"] == 3.0
            && row["alpha_rad"] == 0.2
    });
    let row = row.unwrap();
    let number = |value: &Value| value.as_f64().unwrap();
    format!(
        "{:.2} ({:.2} to {:.2})",
        number(&row["median"]),
        number(&row["interval"][0]),
        number(&row["interval"][1])
    )
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
    let (findings, cases) =
        (report("findings.json"), report("validation.json"));
    let all = cases.as_object().unwrap();
    let passed = all.values().filter(|case| case["verdict"] == "pass").count();
    let rejected: usize = all
        .values()
        .map(|case| case["rejected"].as_object().unwrap().len())
        .sum();
    let analyses: u64 = list(&findings, "suites")
        .iter()
        .map(|suite| suite["analyses"].as_u64().unwrap())
        .sum();
    let open: u64 = list(&findings, "suites")
        .iter()
        .map(|suite| suite["not_told_by_double_precision"].as_u64().unwrap())
        .sum();
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
            overturning(&findings, "ordinary"),
        ),
        ("the same, pulse-type", overturning(&findings, "pulse-type")),
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
