//! The page of a study.

use super::StudyError;
use super::figures::{Figure, Results};
use super::findings::{Claim, Verdict};
use super::whole::arm_words;
use crate::figures::data::Arm;
use crate::report::{
    Finding, PlainTable, ReportInput, ShownFigure, Summary, page,
};

const ASKED: &str = "Is slenderness normalized out of the rocking response, \
    for which motions and with what exceptions? Is the intensity that brings \
    a block to a given rotation lognormal, or lognormal above the onset of \
    rocking? Both questions are put to records and blocks as the paper put \
    them, with the choices it left open made visible.";

const TRUST: &str = "A verdict is that of the whole interval: confirmed where \
    all of it lies within the margin decided beforehand, not confirmed where \
    all of it lies outside, inconclusive otherwise. Single responses near \
    overturning are sensitive to their last digits; statistics of a suite \
    are not.";

const LIMITS: [&str; 5] = [
    "Planar motion of a rigid rectangular block on a rigid base: no sliding, \
     no bouncing, no vertical ground motion.",
    "The coefficient of restitution is a constant, the same for every block \
     and impact.",
    "Two suites of motions. Embedded suites are synthetic: what they confirm \
     holds for their model of ground motion.",
    "No experiment was compared with; the model is taken as given.",
    "A chain ends at its first overturning: what stands again at a higher \
     intensity is counted, not analysed.",
];

/// The report as one file; `table_1` is Table 1 as CSV.
///
/// # Errors
/// [`StudyError`] where a figure cannot be drawn.
pub fn html(
    results: &Results,
    figures: &[Figure],
    claims: &[Claim],
    table_1: &str,
) -> Result<String, StudyError> {
    let figures = figures
        .iter()
        .map(shown)
        .collect::<Result<Vec<ShownFigure>, StudyError>>()?;
    let [ordinary, pulse] = [&results.ordinary, &results.pulse];
    Ok(page(&ReportInput {
        title: "The statistics of rocking".into(),
        subtitle: format!(
            "Fifteen blocks under {} ordinary and {} pulse-type motions.",
            ordinary.records.len(),
            pulse.records.len()
        ),
        summary: summary(claims),
        findings: claims.iter().map(|c| finding(c, &figures)).collect(),
        families: Vec::new(),
        tables: vec![PlainTable::from_csv(
            "table-1",
            "Table 1. The fifteen blocks",
            "Sizes follow from frequency parameter and slenderness with a \
             gravity of 9.81 m/s²; the last column is Housner's coefficient \
             of restitution.",
            table_1,
        )],
        figures,
        provenance: provenance(results),
        limits: LIMITS.map(String::from).to_vec(),
        credibility: Vec::new(),
    }))
}

fn summary(claims: &[Claim]) -> Summary {
    let refuted = claims.iter().filter(|c| c.verdict == Verdict::NotConfirmed);
    Summary {
        asked: ASKED.into(),
        found: refuted
            .map(|c| format!("Not confirmed: {} ({})", c.quote, tested_on(c)))
            .collect(),
        trust: TRUST.into(),
    }
}

fn tested_on(claim: &Claim) -> String {
    let arm =
        claim.arm.map_or(String::new(), |a| format!(", arm {}", a.letter()));
    format!("{}, {}{arm}", claim.suite, claim.blocks)
}

fn finding(claim: &Claim, figures: &[ShownFigure]) -> Finding {
    let measured = claim.measured;
    let value = if measured.value.is_nan() {
        "none".into()
    } else {
        format!("{:.4}", measured.value)
    };
    Finding {
        id: claim.id.clone(),
        claim: claim.quote.clone(),
        source: claim.section.clone(),
        tested_on: tested_on(claim),
        measure: claim.measure.clone(),
        value,
        interval: measured.interval.map_or(String::new(), |(low, high)| {
            format!("{low:.4} to {high:.4}")
        }),
        margin: claim.margin.clone(),
        verdict: claim.verdict,
        figures: figures
            .iter()
            .filter(|f| names(&claim.section, number(&f.name)))
            .filter(|f| arm_fits(&f.name, claim.arm))
            .map(|f| f.name.clone())
            .collect(),
        remark: claim.note.clone(),
    }
}

/// Whether the words name the figure of that number.
fn names(words: &str, number: &str) -> bool {
    words
        .split(|c: char| !c.is_alphanumeric())
        .any(|w| w.trim_end_matches(|c: char| c.is_alphabetic()) == number)
        && words.contains("Figure")
}

/// Whether a figure of one arm is of the claim's arm, if it has one.
fn arm_fits(name: &str, arm: Option<Arm>) -> bool {
    match (arm_of(name), arm) {
        (Some(letter), Some(arm)) => letter == arm.letter(),
        _ => true,
    }
}

/// `6` of `figure-06-c`.
fn number(name: &str) -> &str {
    let number = name.split('-').nth(1).unwrap_or("");
    number.trim_start_matches('0')
}

/// `C` of `figure-06-c`.
fn arm_of(name: &str) -> Option<&'static str> {
    let last = name.rsplit('-').next()?;
    [Arm::A, Arm::B, Arm::C]
        .map(Arm::letter)
        .into_iter()
        .find(|letter| letter.eq_ignore_ascii_case(last))
}

fn shown(figure: &Figure) -> Result<ShownFigure, StudyError> {
    let heading = figure.drawing.heading();
    let arm = arm_of(&heading.name);
    let arm = arm.map_or(String::new(), |a| format!(", arm {a}"));
    Ok(ShownFigure {
        name: heading.name.clone(),
        number: format!("Figure {}{arm}", number(&heading.name)),
        title: heading.title.clone(),
        reading: figure.reading.clone(),
        svg: figure.drawing.svg()?,
        csv: figure.drawing.csv(),
        csv_path: format!("{}.csv", heading.name),
    })
}

fn provenance(results: &Results) -> Vec<(String, String)> {
    let eta = results.plan.setup.restitution.velocity_ratio();
    let mut out = vec![
        ("version".into(), env!("CARGO_PKG_VERSION").into()),
        ("coefficient of restitution".into(), eta.to_string()),
    ];
    for suite in [&results.ordinary, &results.pulse] {
        let words = format!(
            "{} records, {}; component: {}; sha256 {}",
            suite.records.len(),
            suite.source,
            suite.component_rule,
            suite.sha256
        );
        out.push((format!("{} suite", suite.kind), words));
    }
    for arm in &results.plan.arms {
        out.push(("arm".into(), arm_words(*arm).into()));
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn figures_are_named_by_number_and_arm() {
        assert_eq!(number("figure-06-c"), "6");
        assert_eq!(number("figure-12"), "12");
        assert_eq!(arm_of("figure-06-c"), Some("C"));
        assert_eq!(arm_of("figure-12"), None);
        assert!(names("section 5, Figure 13a", "13"));
        assert!(names("Figures 6 and 7", "7"));
        assert!(!names("Figure 13a", "1") && !names("section 6", "6"));
        assert!(arm_fits("figure-06-c", Some(Arm::C)));
        assert!(!arm_fits("figure-06-c", Some(Arm::A)));
        assert!(arm_fits("figure-12", Some(Arm::A)));
    }
}
