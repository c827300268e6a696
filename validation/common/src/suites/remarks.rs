//! Remarks on suspicious records of a command, reported with its results.

use std::collections::{BTreeMap, BTreeSet};

use rocking_records::{
    MemberMotion, Remark, RemarkInput, Suite, remarks_together,
};
use serde::{Serialize, Serializer};

/// Codes of remarks, the gravest first.
const GRAVEST: [&str; 16] = [
    "units",
    "interval",
    "vertical",
    "borehole",
    "flat",
    "clipped",
    "offset",
    "one-sided",
    "last-line",
    "duplicate",
    "direction",
    "unequal-components",
    "times",
    "interval-rounded",
    "end-velocity",
    "padding",
];

/// Remarks on the records of a command.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Remarks {
    records: usize,
    /// Numbers of records whose interval, and whose unit, the caller gave.
    given: (usize, usize),
    /// Names of records with their remarks, each code once, in the order of the
    /// records.
    found: Vec<(String, Vec<Remark>)>,
    /// Position of the remarks on a record.
    places: BTreeMap<String, usize>,
}

impl Remarks {
    /// Remarks on records.
    pub fn of(records: &[RemarkInput<'_>]) -> Self {
        let mut remarks = remarks_together(records);
        for of_one in &mut remarks {
            let mut seen = BTreeSet::new();
            of_one.retain(|remark| seen.insert(remark.code()));
        }
        let named = records.iter().map(|one| one.profile.name().to_owned());
        let found = named.zip(remarks).filter(|(_, all)| !all.is_empty());
        let found: Vec<(String, Vec<Remark>)> = found.collect();
        let place =
            |(place, (name, _)): (usize, &(String, _))| (name.clone(), place);
        let places = found.iter().enumerate().map(place).collect();
        let count = |given: fn(&RemarkInput<'_>) -> bool| {
            records.iter().filter(|one| given(one)).count()
        };
        let given = (count(|one| one.given.dt), count(|one| one.given.unit));
        Self { records: records.len(), given, found, places }
    }

    /// Remarks on all records of a suite.
    pub fn on<M: MemberMotion>(suite: &Suite<M>) -> Self {
        let all = suite.members().iter().map(RemarkInput::from);
        Self::of(&all.collect::<Vec<_>>())
    }

    /// Codes of the remarks on the record `name`, separated by blanks.
    pub fn codes(&self, name: &str) -> String {
        let place = self.places.get(name);
        let codes = place.map_or(&[][..], |place| &self.found[*place].1);
        codes.iter().map(Remark::code).collect::<Vec<_>>().join(" ")
    }

    /// Numbers of records with the caller's interval and unit, if the files of other
    /// records state their own.
    pub fn given(&self) -> Vec<String> {
        let (dt, unit) = self.given;
        let all = [("--dt", dt, "interval"), ("--units", unit, "unit")];
        let some = |count: usize| count > 0 && count < self.records;
        let words = |(flag, count, what): (&str, usize, &str)| {
            format!(
                "{flag}: taken for {count} of {} records, whose files state \
                 no {what}",
                self.records
            )
        };
        let some = all.into_iter().filter(|(_, count, _)| some(*count));
        some.map(words).collect()
    }

    /// Each code with the number of its records and the remark on the first record,
    /// the gravest first.
    fn by_code(&self) -> Vec<(&'static str, usize, &str, &Remark)> {
        let mut all: Vec<(&'static str, usize, &str, &Remark)> = Vec::new();
        for (name, remarks) in &self.found {
            for remark in remarks {
                match all.iter_mut().find(|row| row.0 == remark.code()) {
                    Some(row) => row.1 += 1,
                    None => all.push((remark.code(), 1, name, remark)),
                }
            }
        }
        let rank = |code: &str| GRAVEST.iter().position(|c| *c == code);
        all.sort_by_key(|row| rank(row.0).unwrap_or(GRAVEST.len()));
        all
    }

    /// The count of records with remarks, the count of each code, and the
    /// gravest remark; `None` without any.
    pub fn words(&self) -> Option<String> {
        let all = self.by_code();
        let (code, _, record, remark) = all.first()?;
        let counts: Vec<String> =
            all.iter().map(|(code, n, ..)| format!("{code} {n}")).collect();
        Some(format!(
            "{} of {} records ({}); {record}: {code}: {remark}",
            self.found.len(),
            self.records,
            counts.join(", ")
        ))
    }
}

/// The number of records with remarks, and for each code the number of its records,
/// the first record and the remark on it.
impl Serialize for Remarks {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        #[derive(Serialize)]
        struct CodeCount<'a> {
            code: &'a str,
            records: usize,
            first: &'a str,
            message: String,
        }
        #[derive(Serialize)]
        struct All<'a> {
            records: usize,
            of: usize,
            codes: Vec<CodeCount<'a>>,
        }
        let code = |(code, records, first, remark): (_, _, _, &Remark)| {
            let message = remark.to_string();
            CodeCount { code, records, first, message }
        };
        All {
            records: self.found.len(),
            of: self.records,
            codes: self.by_code().into_iter().map(code).collect(),
        }
        .serialize(to)
    }
}

#[cfg(test)]
mod tests {
    use rocking::accelerogram::Accelerogram;

    use super::*;

    #[test]
    fn the_gravest_comes_first_with_counts() {
        let motion = |name: &str, scale: f64, mean: f64| {
            let wave = (0..401)
                .map(|i| libm::sin(0.05 * std::f64::consts::PI * f64::from(i)))
                .map(|a| scale * (a + mean));
            Accelerogram::try_new(name, 0.01, wave.collect()).unwrap()
        };
        let clean = [motion("a", 0.3, 0.0)];
        let of = |records: &[Accelerogram]| {
            let one = |record| RemarkInput::of(record, None, &[]);
            Remarks::of(&records.iter().map(one).collect::<Vec<_>>())
        };
        assert_eq!(of(&clean).words(), None);
        let mixed = [
            motion("x", 0.3, 0.02),
            motion("y", 300.0, 0.0),
            motion("z", 0.2, 0.03),
            motion("x2", 0.3, 0.02),
            motion("x3", 0.3, 0.02),
        ];
        let found = of(&mixed);
        let words = found.words().unwrap();
        let start = "5 of 5 records (units 1, offset 4, duplicate 5, ";
        assert!(words.starts_with(start), "{words}");
        assert!(words.contains("; y: units: PGA 3.000e2 g"), "{words}");
        assert_eq!(found.codes("x"), "end-velocity offset duplicate");
        assert_eq!(found.codes("nobody"), "");
        let json = serde_json::to_value(&found).unwrap();
        assert_eq!(json["codes"][1]["first"], "x");
    }
}
