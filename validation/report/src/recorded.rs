//! The committed results of the recorded suites: what was found, and the
//! statistics that the figures draw.

use anyhow::Context as _;

use rocking_common::findings::Findings;
use rocking_common::words::rounded;
use rocking_draw::figures::{DIGITS, Figure, Motions};
use rocking_study::Study;
use serde_json::Value;

/// Findings of the recorded suites: values, intervals, verdicts, record names
/// and hashes, and no sample of a record. The file's own words say how it is
/// made.
const RECORDED: &str = rocking_fixtures::text("recorded/findings.json");

/// Figures of the recorded suites: peaks, capacities and statistics of them
/// as they are drawn, and no sample of a record. [`kept`] writes it.
const FIGURES: &str = rocking_fixtures::text("recorded/figures.json");

/// The paper's figures that draw a history of rotation. From a history the
/// record's acceleration could be computed: of recorded motions, which may
/// not be passed on, none is kept.
const HISTORIES: [u32; 2] = [2, 3];
/// The last of the paper's figures.
const LAST: u32 = 18;

/// The findings of the recorded suites.
///
/// # Errors
/// What the reader found instead of findings of this schema.
pub fn recorded() -> anyhow::Result<Findings> {
    Findings::parse(RECORDED)
        .map_err(anyhow::Error::msg)
        .context("fixtures/recorded/findings.json")
}

/// The figures of a study; of the embedded suites, each behind that of the
/// recorded suites where this is kept.
///
/// # Errors
/// What the reader found instead of figures.
pub(super) fn figures(study: &Study) -> anyhow::Result<Vec<Figure>> {
    if !study.results.embedded() {
        return Ok(study.figures.clone());
    }
    let kept: Vec<Figure> = serde_json::from_str(FIGURES)
        .context("fixtures/recorded/figures.json")?;
    let mut all = Vec::new();
    for own in &study.figures {
        let same = |f: &&Figure| f.heading.is_beside(&own.heading);
        let mut own = own.clone();
        if let Some(recorded) = kept.iter().find(same) {
            all.push(of(recorded.clone(), Motions::Recorded));
            own = of(own, Motions::Embedded);
        }
        if own.heading.number.is_some_and(|n| HISTORIES.contains(&n)) {
            own = of(own, Motions::Embedded);
            own.reading += " These motions are synthetic: from a history \
                            the acceleration of its record could be \
                            computed, and recorded motions may not be passed \
                            on.";
        }
        all.push(own);
    }
    Ok(all)
}

fn of(mut figure: Figure, motions: Motions) -> Figure {
    figure.heading = figure.heading.of_motions(motions);
    figure
}

/// The figures of a study that are kept if its suites are the recorded ones,
/// a figure a line, with the digits that a drawing needs.
///
/// # Errors
/// For a figure that cannot be written.
pub(super) fn kept(study: &Study) -> anyhow::Result<String> {
    let mut lines = Vec::new();
    for figure in &study.figures {
        let number = figure.heading.number.unwrap_or(u32::MAX);
        if number > HISTORIES[1] && number <= LAST {
            let mut value = serde_json::to_value(figure)?;
            round(&mut value);
            lines.push(value.to_string());
        }
    }
    Ok(format!("[\n{}\n]\n", lines.join(",\n")))
}

fn round(value: &mut Value) {
    match value {
        Value::Array(all) => all.iter_mut().for_each(round),
        Value::Object(fields) => fields.values_mut().for_each(round),
        Value::Number(number) if number.is_f64() => {
            *value = number
                .as_f64()
                .map_or(Value::Null, |x| Value::from(rounded(x, DIGITS)));
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_figures_are_those_without_histories() {
        let kept: Vec<Figure> = serde_json::from_str(FIGURES).expect("form");
        let numbers = kept.iter().filter_map(|f| f.heading.number);
        let mut numbers: Vec<u32> = numbers.collect();
        numbers.dedup();
        assert_eq!(numbers, (4..=LAST).collect::<Vec<_>>());
        for figure in &kept {
            let name = &figure.heading.name;
            let csv = figure.csv();
            let header = csv.lines().next().unwrap_or_default();
            assert!(!header.contains("time"), "{name}: {header}");
            assert!(csv.lines().count() > 10, "{name}");
            assert!(figure.svg().starts_with("<svg"), "{name}");
        }
    }

    #[test]
    fn numbers_are_rounded_wherever_they_stand() {
        let mut value = serde_json::json!({"a": [1.234_567_89, "inf", 7]});
        round(&mut value);
        assert_eq!(value, serde_json::json!({"a": [1.23457, "inf", 7]}));
    }
}
