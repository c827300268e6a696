//! Typed findings of a study. `findings.json` contains them; the terminal and the
//! comparison of two studies read them.
//!
//! The file is one object of [`Findings`]. Numbers have nine significant digits.
//! An infinite number is `"inf"` or `"-inf"`, a missing one `null`.

mod claims;
mod effect;
pub mod estimate;
mod unit;

use std::collections::BTreeMap;
use std::fmt;

use rocking::block::Block;
use rocking::integrator::Overturning;
use rocking_statistics::Estimate;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::json::nine;
use crate::paper::{Arm, Intensity, SuiteKind};

pub use effect::Effect;
pub use unit::Unit;

pub use claims::{
    Claim, ClaimResult, Detail, Exists, Kind, LEVEL, NoEffect, Region,
    SampleCount, Seen, StatedEffect, SuiteSet, Theme, Yardstick,
};

/// Version of the file's shape. It rises with every change of a field or of
/// its meaning.
pub const SCHEMA: u32 = 7;

/// The results of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Findings {
    /// [`SCHEMA`] of the program that wrote the file.
    pub schema: u32,
    /// Version of that program.
    pub version: String,
    /// Settings of the study.
    pub settings: StudySettings,
    /// The suites, and the work on them.
    pub suites: Vec<SuiteSummary>,
    /// The paper's claims with their results.
    pub claims: Vec<Claim>,
    /// The numbers that claims and figures rest on.
    pub tables: Vec<FindingsTable>,
    /// Questions beyond the paper.
    pub questions: Vec<Question>,
}

/// Settings of a study.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StudySettings {
    /// The intensity grids.
    pub arms: Vec<Arm>,
    /// Coefficient of restitution.
    #[serde(with = "nine")]
    pub eta: f64,
    /// Overturning criterion.
    pub overturning: Overturning,
    /// Width in IM to which first overturnings are bisected.
    #[serde(with = "nine")]
    pub refinement_im: f64,
    /// Whether other choices are run on all blocks.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub full: bool,
}

impl StudySettings {
    /// Names and values.
    pub fn named(&self) -> [(&'static str, String); 5] {
        let arms: Vec<&str> = self.arms.iter().map(|a| a.name()).collect();
        [
            ("grids", arms.join(", ")),
            ("eta", self.eta.to_string()),
            ("overturning", self.overturning.to_string()),
            ("refinement im", self.refinement_im.to_string()),
            ("full", self.full.to_string()),
        ]
    }
}

/// A suite, and the work on it.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct SuiteSummary {
    /// Which of the two.
    pub kind: SuiteKind,
    /// Origin of the records.
    pub source: String,
    /// Rule by which the component of a pair is chosen.
    pub component_rule: String,
    /// Number of records.
    pub records: usize,
    /// Number of earthquakes; `None` if they are unknown, and each record counts
    /// as one.
    pub earthquakes: Option<usize>,
    /// SHA-256 over the records.
    pub sha256: String,
    /// The records, each by its name and the hash of its samples.
    pub list: Vec<RecordName>,
    /// Records whose histories are shown.
    pub shown_alone: Vec<String>,
    /// Remarks on records, if there are any.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub remarks: Option<String>,
    /// Files that were set aside when the suite was read, by reason.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub set_aside: Vec<AsideFiles>,
    /// Analyses made.
    pub analyses: u64,
    /// Analyses whose peak or outcome double precision does not resolve.
    pub unresolved: usize,
    /// First overturnings among the unresolved analyses.
    pub first_overturnings_reevaluated: Reevaluation,
    /// Largest shift of an overturning quantile if all open outcomes flipped.
    #[serde(with = "nine")]
    pub largest_shift_if_flipped: f64,
}

/// Files that were set aside for one reason.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct AsideFiles {
    /// The reason.
    pub code: String,
    /// Number of files.
    pub files: usize,
    /// The first of them.
    pub first: String,
}

/// A record of a suite: enough to find it again, and no sample of it.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordName {
    /// Name of the record and of its component.
    pub name: String,
    /// SHA-256 over the component's interval and samples.
    pub sha256: String,
}

/// First overturnings that were evaluated again with every decision assessed, by
/// the arithmetic that resolved them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Reevaluation {
    /// All of them.
    pub all: usize,
    /// Resolved by double precision.
    pub resolved_by_double: usize,
    /// Resolved by double-double precision.
    pub resolved_by_double_double: usize,
    /// Resolved by octuple precision.
    pub resolved_by_octuple: usize,
    /// Not resolved.
    pub unresolved: usize,
    /// Outcomes that were wrong in double precision.
    pub wrong_in_double: usize,
}

/// Topic of a table, in the order of consequence for an engineer.
#[derive(
    Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize,
)]
#[serde(rename_all = "kebab-case")]
pub enum Topic {
    /// Median overturning intensities.
    Overturning,
    /// Shares of demand levels that the Lilliefors test accepts.
    AcceptedShares,
    /// Capacities by other choices.
    Sensitivities,
    /// Figure 9: slenderness adjusted instead of scaling the record.
    SlendernessAdjustment,
    /// Figures 2 to 5: records one by one.
    SingleRecords,
    /// Blocks that stand at an intensity above their first overturning.
    Resurrections,
    /// Records that move a block without being scaled.
    UpliftUnscaled,
}

impl Topic {
    /// The smallest effect of interest of a quantity of this table: 5 % of a
    /// response ratio, else the effect of its unit.
    pub fn smallest_effect(self, unit: Unit) -> Option<Effect> {
        match (self, unit) {
            (Self::SlendernessAdjustment | Self::SingleRecords, Unit::One) => {
                Some(Effect::Relative(0.05))
            }
            _ => Effect::of(unit),
        }
    }

    /// Words of the topic.
    pub fn words(self) -> &'static str {
        match self {
            Self::AcceptedShares => "lognormality along the demand",
            Self::SlendernessAdjustment => {
                "slenderness adjusted instead of scaling"
            }
            Self::Overturning => "overturning intensities",
            Self::Resurrections => "resurrections",
            Self::Sensitivities => "other choices",
            Self::SingleRecords => "records one by one",
            Self::UpliftUnscaled => "uplift without scaling",
        }
    }
}

/// Rows of some quantities at different places.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct FindingsTable {
    /// Its topic.
    pub topic: Topic,
    /// The quantities, one for each value of a row.
    pub quantities: Vec<Quantity>,
    /// The rows.
    pub rows: Vec<TableRow>,
}

impl FindingsTable {
    /// Refuses a row without a value for each quantity.
    fn check(&self) -> Result<(), String> {
        let (topic, expected) = (self.topic.words(), self.quantities.len());
        let found = self.rows.iter().map(|row| row.values.len());
        match (1..).zip(found).find(|(_, found)| *found != expected) {
            None => Ok(()),
            Some((row, found)) => Err(format!(
                "{topic}, row {row}: {found} values, expected {expected}"
            )),
        }
    }
}

/// Meaning of a number of a table.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Quantity {
    /// Short name.
    pub name: String,
    /// The quantity in words.
    pub words: String,
    /// Its unit.
    pub unit: Unit,
}

/// One place and its values.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct TableRow {
    /// The place.
    pub at: RowPlace,
    /// A value for each quantity of the table.
    #[serde(with = "estimate::list")]
    pub values: Vec<Estimate>,
}

/// Place of a row of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, default)]
pub struct RowPlace {
    /// Suite.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub suite: Option<SuiteKind>,
    /// Intensity grid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub arm: Option<Arm>,
    /// Intensity measure.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub intensity: Option<Intensity>,
    /// A choice other than the study's.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub choice: Option<String>,
    /// Frequency parameter, in rad/s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub p_rad_s: Option<f64>,
    /// Slenderness angle, in rad.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub alpha_rad: Option<f64>,
    /// Intensity of the stripe, PGA/(g tan alpha).
    #[serde(skip_serializing_if = "Option::is_none")]
    pub im_pga: Option<f64>,
    /// Demand, |theta|/alpha.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub edp: Option<f64>,
}

impl RowPlace {
    /// The place of a block.
    pub fn of(block: &Block) -> Self {
        Self {
            p_rad_s: Some(block.frequency_rad_s()),
            alpha_rad: Some(block.slenderness_rad()),
            ..Self::default()
        }
    }
}

/// The place within its suite and intensity measure:
/// `p = 3, alpha = 0.20, arm C`.
impl fmt::Display for RowPlace {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let number =
            |name: &str, x: Option<f64>| x.map(|x| format!("{name} {x}"));
        let parts = [
            self.choice.clone(),
            number("p =", self.p_rad_s),
            self.alpha_rad.map(|alpha| format!("alpha = {alpha:.2}")),
            number("PGA/(g tan alpha) =", self.im_pga),
            number("demand", self.edp),
            self.arm.map(|arm| format!("grid {}", arm.name())),
        ];
        let parts: Vec<String> = parts.into_iter().flatten().collect();
        f.write_str(&parts.join(", "))
    }
}

/// A question beyond the paper, and its answer.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Question {
    /// Short name.
    pub id: String,
    /// The question.
    pub question: String,
    /// The answer.
    pub answer: String,
    /// File with the numbers.
    pub data: String,
}

impl Findings {
    /// The file's text: one value a line, a line break at the end.
    pub fn text(&self) -> String {
        // These types print without an error.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// Whether a file's text is the findings of a study, of any [`SCHEMA`].
    ///
    /// ```
    /// use rocking_common::findings::Findings;
    /// let other = br#"{"version": "1", "suites": [], "claims": []}"#;
    /// assert!(!Findings::is_any(other));
    /// ```
    pub fn is_any(text: &[u8]) -> bool {
        let keys = ["version", "settings", "suites", "claims"];
        serde_json::from_slice::<BTreeMap<String, IgnoredAny>>(text)
            .is_ok_and(|found| keys.iter().all(|key| found.contains_key(*key)))
    }

    /// Findings from a file's text.
    ///
    /// # Errors
    /// A text of another form, with line and column; findings of another
    /// [`SCHEMA`].
    ///
    /// ```
    /// use rocking_common::findings::Findings;
    /// let error = Findings::parse(r#"{"claims": []}"#).unwrap_err();
    /// assert!(error.contains("schema 1"));
    /// ```
    pub fn parse(text: &str) -> Result<Self, String> {
        #[derive(Deserialize)]
        struct Version {
            schema: Option<u32>,
        }
        let found: Version =
            serde_json::from_str(text).map_err(|e| e.to_string())?;
        // The first schema had no number.
        let found = found.schema.unwrap_or(1);
        if found != SCHEMA {
            return Err(format!(
                "findings of schema {found}, expected schema {SCHEMA}: \
                 findings of different schemas cannot be compared; make both \
                 by one version of the program"
            ));
        }
        let found: Self =
            serde_json::from_str(text).map_err(|e| e.to_string())?;
        found.tables.iter().try_for_each(FindingsTable::check)?;
        Ok(found)
    }

    /// The table of a topic, if there is one.
    pub fn table(&self, topic: Topic) -> Option<&FindingsTable> {
        self.tables.iter().find(|table| table.topic == topic)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rocking_statistics::{Interval, Range};

    fn read(text: &str) -> Result<Estimate, String> {
        let mut from = serde_json::Deserializer::from_str(text);
        estimate::deserialize(&mut from).map_err(|e| e.to_string())
    }

    fn written(of: &Estimate) -> String {
        let mut out = Vec::new();
        let mut to = serde_json::Serializer::new(&mut out);
        estimate::serialize(of, &mut to).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn measured_numbers_are_read_as_they_are_written() {
        for (value, interval) in [
            (1.5, Some((1.0, f64::INFINITY))),
            (f64::INFINITY, None),
            (0.1, Some((0.1, 0.1))),
        ] {
            let one =
                interval.map_or(Estimate::exact(value), |(low, high)| {
                    let interval = Interval::try_new(low, high).unwrap();
                    Estimate::try_new(value, interval, Range::Real).unwrap()
                });
            let text = written(&one);
            assert_eq!(read(&text).unwrap(), one, "{text}");
        }
        let text = written(&Estimate::exact(f64::NAN));
        assert_eq!(text, r#"{"value":null}"#);
        assert!(read(&text).unwrap().value().is_nan());
    }

    #[test]
    fn an_interval_that_is_none_is_refused() {
        for text in [
            r#"{"value":1,"low":2,"high":1}"#,
            r#"{"value":1,"low":null,"high":1}"#,
            r#"{"value":1,"low":1,"high":null}"#,
        ] {
            assert!(read(text).unwrap_err().contains("low end"), "{text}");
        }
        let text = r#"{"value":"one","low":null,"high":null}"#;
        assert!(read(text).unwrap_err().contains("\"inf\""));
        assert!(read(r#"{"low":1,"high":2}"#).is_err());
    }

    #[test]
    fn a_row_has_a_value_for_each_quantity() {
        let text = r#"{"topic":"overturning",
            "quantities":[{"name":"a","words":"b","unit":"1"}],
            "rows":[{"at":{"p_rad_s":1.0},"values":[]}]}"#;
        let table: FindingsTable = serde_json::from_str(text).unwrap();
        let error = table.check().unwrap_err();
        assert!(error.contains("row 1: 0 values, expected 1"), "{error}");
    }

    #[test]
    fn other_schemas_are_refused() {
        let text = format!(r#"{{"schema": {}}}"#, SCHEMA + 1);
        let error = Findings::parse(&text).unwrap_err();
        assert!(error.contains("different schemas"), "{error}");
    }
}
