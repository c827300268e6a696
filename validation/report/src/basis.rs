//! What the answers of a page rest on: the findings of a run and, beside
//! those of embedded suites, the kept ones of recorded suites; and the figures
//! of both.

use anyhow::Context as _;

use rocking_common::findings::{Findings, SuiteSummary};
use rocking_common::words::{capital, percent, rounded, rounded_text};
use rocking_draw::figures::{DIGITS, Figure, Motions};
use rocking_study::Study;
use rocking_study::kept;
use serde_json::Value;

/// The paper's figures that draw a history of rotation. From a history the
/// record's acceleration could be computed: of recorded motions, which may
/// not be passed on, none is kept.
const HISTORIES: [u32; 2] = [2, 3];
/// The last of the paper's figures.
const LAST: u32 = 18;

/// Name of the recorded suites whose findings anyone can find again.
pub(crate) const REPEATABLE: &str = "recorded, repeatable";

/// Findings under the name of their suites, such as "recorded, stored".
pub(crate) type FindingColumn<'a> = (&'static str, &'a Findings);

/// The findings of a run and, if it has their settings, the kept ones.
pub(crate) struct FindingSets<'a> {
    /// What the run found.
    pub here: &'a Findings,
    /// Whether its suites are the embedded ones.
    pub embedded: bool,
    kept: Vec<(&'static str, Findings)>,
}

impl<'a> FindingSets<'a> {
    /// The basis of a run, on embedded suites or others.
    ///
    /// # Errors
    /// For kept results that cannot be read.
    pub fn of(embedded: bool, here: &'a Findings) -> anyhow::Result<Self> {
        let mut kept = vec![
            ("recorded, stored", kept::findings()?),
            (REPEATABLE, kept::repeatable()?),
        ];
        kept.retain(|(_, own)| embedded && own.settings == here.settings);
        Ok(Self { here, embedded, kept })
    }

    /// The kept findings of recorded suites, those that answer first.
    pub fn recorded(&self) -> impl Iterator<Item = FindingColumn<'_>> {
        self.kept.iter().map(|(name, found)| (*name, found))
    }

    /// Whether findings of recorded suites are kept.
    pub fn has_recorded(&self) -> bool {
        !self.kept.is_empty()
    }

    /// The findings that answer.
    pub fn lead(&self) -> &Findings {
        self.columns()[0].1
    }

    /// That figures without other motions are of the embedded ones.
    pub fn figures_here(&self) -> Option<String> {
        let words = "The figures of this annex show the embedded motions.";
        self.embedded.then(|| words.to_owned())
    }

    /// All findings, those that answer first.
    pub fn columns(&self) -> Vec<FindingColumn<'_>> {
        let here = if self.embedded { "embedded" } else { "your suites" };
        self.recorded().chain([(here, self.here)]).collect()
    }

    /// That recorded results of other settings were left out, where they
    /// were.
    ///
    /// # Errors
    /// For kept results that cannot be read.
    pub fn left_out(&self) -> anyhow::Result<Option<String>> {
        if !self.embedded || self.has_recorded() {
            return Ok(None);
        }
        let kept = kept::findings()?.settings.named();
        let other: Vec<String> = kept
            .into_iter()
            .zip(self.here.settings.named())
            .filter(|(kept, here)| kept != here)
            .map(|((name, kept), (_, here))| {
                format!("{name} {kept}, not {here}")
            })
            .collect();
        Ok(Some(format!(
            "Results on recorded motions are stored only for other settings \
             ({}); they are left out.",
            other.join("; ")
        )))
    }

    /// A word on the suites of each side.
    fn each(&self, of: impl Fn(&[SuiteSummary]) -> String) -> String {
        let side = |(name, findings): FindingColumn<'_>| {
            format!("{} ({name})", of(&findings.suites))
        };
        let sides: Vec<String> =
            self.columns().into_iter().map(side).collect();
        sides.join(", ")
    }

    /// The share of analyses that rounding may have changed, for each side.
    pub fn open(&self) -> String {
        let open = self.each(|suites| {
            let all: u64 = suites.iter().map(|s| s.analyses).sum();
            let open: usize = suites.iter().map(|s| s.unresolved).sum();
            let share = percent(open as f64 / all as f64, 1);
            format!("{share} of {all} analyses")
        });
        format!("rounding may have changed the outcome or peak in {open}")
    }

    /// What rounding may have changed, and what it had changed among the first
    /// overturnings, for each side.
    pub fn rounding(&self) -> String {
        let wrong = self.each(|suites| {
            let ends =
                || suites.iter().map(|s| s.first_overturnings_reevaluated);
            let wrong: usize = ends().map(|e| e.wrong_in_double).sum();
            let all: usize = ends().map(|e| e.all).sum();
            format!("{wrong} of {all}")
        });
        format!(
            "{}. The first overturnings among these were computed again in \
             higher precision: {wrong} had been wrong",
            self.open()
        )
    }

    /// What the work on each suite was, and what rounding may have changed.
    pub fn work(&self) -> Vec<String> {
        let of = |(name, findings): FindingColumn<'_>| -> Vec<String> {
            let suites = findings.suites.iter();
            suites.map(|suite| work_on(&capital(name), suite)).collect()
        };
        self.columns().into_iter().flat_map(of).collect()
    }

    /// The figures of the study, each behind that of the recorded suites
    /// where this is kept.
    ///
    /// # Errors
    /// What the reader found instead of figures.
    pub fn figures(&self, drawn: &[Figure]) -> anyhow::Result<Vec<Figure>> {
        if !self.embedded {
            return Ok(drawn.to_vec());
        }
        let kept: Vec<Figure> = match self.has_recorded() {
            true => serde_json::from_str(kept::FIGURES)
                .context("fixtures/recorded/figures.json")?,
            false => Vec::new(),
        };
        let mut all = Vec::new();
        for own in drawn {
            let same = |f: &&Figure| f.heading.is_beside(&own.heading);
            let mut own = own.clone();
            if let Some(recorded) = kept.iter().find(same) {
                all.push(of_motions(recorded.clone(), Motions::Recorded));
                own = of_motions(own, Motions::Embedded);
            }
            if own.heading.number.is_some_and(|n| HISTORIES.contains(&n)) {
                own = of_motions(own, Motions::Embedded);
                own.reading += " These motions are synthetic: the acceleration \
                                of a record could be computed from a history, \
                                and recorded motions may not be redistributed.";
            }
            all.push(own);
        }
        Ok(all)
    }
}

fn work_on(name: &str, suite: &SuiteSummary) -> String {
    let work = format!(
        "{name}: {} {} records, {} analyses",
        suite.records, suite.kind, suite.analyses
    );
    if suite.unresolved == 0 {
        return format!("{work}; double precision resolves every one.");
    }
    let ends = suite.first_overturnings_reevaluated;
    format!(
        "{work}. In {} of them the motion is chaotic, and rounding in double \
         precision may have changed the peak or the outcome. {} of these are \
         first overturnings, on which capacities depend. Of them, double \
         precision with error bounds resolves {}, double-double {}, octuple \
         precision {}, none {}. Wrong in double precision: {}; the 16, 50 and \
         84 % overturning intensities would move by {} at most.",
        suite.unresolved,
        ends.all,
        ends.resolved_by_double,
        ends.resolved_by_double_double,
        ends.resolved_by_octuple,
        ends.unresolved,
        ends.wrong_in_double,
        rounded_text(suite.largest_shift_if_flipped)
    )
}

fn of_motions(mut figure: Figure, motions: Motions) -> Figure {
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

/// The kept findings, whatever the settings of a run.
#[cfg(test)]
pub(crate) fn recorded() -> Findings {
    kept::findings().expect("findings")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kept_figures_are_those_without_histories() {
        let kept: Vec<Figure> =
            serde_json::from_str(kept::FIGURES).expect("form");
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
