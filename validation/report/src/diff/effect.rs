//! The records that two runs share, and the change of overturning
//! intensities.

use std::collections::BTreeMap;

use serde::Serialize;
use serde_json::Value;

use super::number::{percent, plain};
use rocking_statistics::Interval;
use rocking_study::estimates::median;

/// Records of a suite in two runs. The same name with other samples is another
/// record.
#[derive(Clone, Debug, Default, Serialize)]
pub struct RecordSets {
    /// In both runs.
    pub both: Vec<String>,
    /// Only in the old run.
    pub lost: Vec<String>,
    /// Only in the new run.
    pub gained: Vec<String>,
}

impl RecordSets {
    /// Adds a record of either side or of both.
    pub fn add(&mut self, sides: [Option<&Value>; 2]) {
        let ([Some(record), _] | [_, Some(record)]) = sides else { return };
        let list = match sides {
            [Some(_), Some(_)] => &mut self.both,
            [Some(_), None] => &mut self.lost,
            _ => &mut self.gained,
        };
        list.extend(record["name"].as_str().map(str::to_owned));
    }

    /// Whether both runs have the same ones.
    pub fn are_same(&self) -> bool {
        self.lost.is_empty() && self.gained.is_empty()
    }

    /// The number of records in both runs, and the others, in a sentence.
    pub fn sentence(&self, suite: &str) -> String {
        let named = |records: &[String]| match records.len() {
            n @ 1..=3 => format!("{n} ({})", records.join(", ")),
            n => n.to_string(),
        };
        format!(
            "{} {suite} records are in both runs, {} only in the old one, {} \
             only in the new one.",
            self.both.len(),
            named(&self.lost),
            named(&self.gained)
        )
    }
}

/// Changes of overturning intensities, relative to the old ones.
#[derive(Clone, Debug, Default, Serialize)]
pub struct OverturningChange {
    /// Changes of the medians of all blocks, by suite and intensity measure.
    pub medians: BTreeMap<String, Vec<f64>>,
    /// Changes of the first overturning of Figure 11's block, by record.
    pub records: BTreeMap<String, f64>,
}

impl OverturningChange {
    /// The effect in a sentence, if overturning intensities are known. Of
    /// single records, those count that both runs have.
    pub fn sentence(&self, both: &[String]) -> Option<String> {
        let all: Vec<f64> = self.medians.values().flatten().copied().collect();
        let own = both.iter().filter_map(|name| self.records.get(name));
        let own: Vec<f64> = own.copied().collect();
        let mut known = all.iter().chain(&own).filter(|x| !x.is_nan());
        if known.clone().count() > 0 && known.all(|change| *change == 0.0) {
            return Some("Effect: no overturning intensity changed.".into());
        }
        let change = |own: &[f64]| percent(median(own).value());
        let mut parts = Vec::new();
        if all.iter().any(|change| !change.is_nan()) {
            let group = |(group, own): (&String, &Vec<f64>)| {
                format!("{group} {}", change(own))
            };
            let groups: Vec<String> = self.medians.iter().map(group).collect();
            parts.push(format!(
                "median overturning intensities {} ({})",
                change(&all),
                groups.join("; ")
            ));
        }
        if let Some((low, high)) = median(&own).interval().map(Interval::ends)
        {
            parts.push(format!(
                "record by record {} (95 %: {} to {}; block of Figure 11, n = \
                 {})",
                change(&own),
                plain(100.0 * low, 2),
                plain(100.0 * high, 2),
                own.len()
            ));
        }
        (!parts.is_empty()).then(|| format!("Effect: {}.", parts.join("; ")))
    }
}
