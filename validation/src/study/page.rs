//! The page of a study.

use maud::{DOCTYPE, Markup, PreEscaped, html};

use super::StudyError;
use super::figures::{Figure, Results};
use super::findings::{Claim, Verdict};
use super::whole::arm_words;

const STYLE: &str = "
:root { color-scheme: light dark; }
body { font: 16px/1.5 system-ui, sans-serif; margin: 0 auto; max-width: 72rem;
  padding: 1rem; }
figure { margin: 2rem 0; }
figure svg { max-width: 100%; height: auto; }
.table { overflow-x: auto; }
table { border-collapse: collapse; font-size: 0.9rem; }
th, td { text-align: left; vertical-align: top; padding: 0.3rem 0.6rem;
  border-bottom: 1px solid #8888; }
";

/// The report as one file.
///
/// # Errors
/// [`StudyError`] where a figure cannot be drawn.
pub fn html(
    results: &Results,
    figures: &[Figure],
    claims: &[Claim],
) -> Result<String, StudyError> {
    let drawings = figures
        .iter()
        .map(figure)
        .collect::<Result<Vec<Markup>, StudyError>>()?;
    let page = html! {
        (DOCTYPE)
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport"
                    content="width=device-width, initial-scale=1";
                title { "The statistics of rocking" }
                style { (PreEscaped(STYLE)) }
            }
            body {
                main {
                    h1 { "The statistics of rocking" }
                    (asked(results))
                    h2 { "What was found" }
                    (counts(claims))
                    (claims_table(claims))
                    h2 { "Figures" }
                    @for drawing in &drawings { (drawing) }
                }
            }
        }
    };
    Ok(page.into_string() + "\n")
}

fn asked(results: &Results) -> Markup {
    html! {
        p {
            "Fifteen rigid blocks, p = 1, 3, 4 rad/s and alpha = 0.05 to \
             0.25 rad, restitution "
            (results.plan.setup.restitution.velocity_ratio())
            ", were rocked to overturning by every record of two suites."
        }
        ul {
            @for suite in [&results.ordinary, &results.pulse] {
                li {
                    (suite.kind) ": " (suite.records.len()) " records, "
                    (suite.source) "; component: " (suite.component_rule)
                    "; sha256 " code { (suite.sha256) }
                }
            }
            @for arm in &results.plan.arms {
                li { "Arm " (arm_words(*arm)) }
            }
        }
    }
}

fn counts(claims: &[Claim]) -> Markup {
    let count = |v| claims.iter().filter(|c| c.verdict == v).count();
    html! {
        p {
            (count(Verdict::Confirmed)) " claims confirmed, "
            (count(Verdict::NotConfirmed)) " not confirmed, "
            (count(Verdict::Inconclusive)) " inconclusive."
        }
    }
}

fn claims_table(claims: &[Claim]) -> Markup {
    html! {
        div.table {
            table {
                thead {
                    tr {
                        th { "Claim" }
                        th { "Suite, blocks" }
                        th { "Measure" }
                        th { "Value" }
                        th { "Margin" }
                        th { "Verdict" }
                    }
                }
                tbody {
                    @for claim in claims {
                        tr {
                            td {
                                (claim.quote) " (" (claim.section) ")"
                            }
                            td {
                                (claim.suite) ", " (claim.blocks)
                                @if let Some(arm) = claim.arm {
                                    ", arm " (arm.letter())
                                }
                            }
                            td {
                                (claim.measure)
                                @if !claim.note.is_empty() {
                                    " (" (claim.note) ")"
                                }
                            }
                            td { (value(claim)) }
                            td { (claim.margin) }
                            td { (claim.verdict.name()) }
                        }
                    }
                }
            }
        }
    }
}

fn value(claim: &Claim) -> String {
    let m = claim.measured;
    match m.interval {
        _ if m.value.is_nan() => "none".into(),
        Some((low, high)) => {
            format!("{:.4} [{low:.4}, {high:.4}]", m.value)
        }
        None => format!("{:.4}", m.value),
    }
}

fn figure(figure: &Figure) -> Result<Markup, StudyError> {
    let heading = figure.drawing.heading();
    let svg = figure.drawing.svg()?;
    Ok(html! {
        figure id=(heading.name) {
            (PreEscaped(svg))
            figcaption {
                b { (heading.title) ". " }
                (figure.reading) " "
                a href={ (heading.name) ".csv" } { "Data" }
            }
        }
    })
}
