//! Two samples over the same records.

use std::collections::BTreeMap;

use thiserror::Error;

use rocking::accelerogram::are_places;
use rocking_statistics::paired::{
    Equivalence, HodgesLehmann, PairedError, Pairs, SignEquivalence, SignTest,
    equivalence, hodges_lehmann, sign_equivalence,
};
use rocking_statistics::{Boxplot, ExtendedSample, QuantileType};

/// Paired ratios a/b of two samples, and tests of a centre at 1.
#[derive(Clone, Debug, PartialEq, serde::Serialize)]
#[non_exhaustive]
pub struct Comparison {
    /// The pairs by what they allow.
    #[serde(flatten)]
    pub pairs: Pairs,
    /// Pairs with a ratio.
    pub usable: usize,
    /// Share of pairs with a ratio.
    pub share: f64,
    /// Boxplot of the ratios (quantiles of type 5); none for no ratio.
    pub boxplot: Option<Boxplot>,
    /// Sign test of the ratios against 1.
    pub sign_test: SignTest,
    /// McNemar's test on the pairs with one infinite value.
    pub mcnemar: SignTest,
    /// Centre of the ratios.
    #[serde(serialize_with = "super::or_reason")]
    pub hodges_lehmann: Result<HodgesLehmann, PairedError>,
    /// Two one-sided t tests of the mean of ln ratio.
    #[serde(serialize_with = "super::or_reason")]
    pub mean_equivalence: Result<Equivalence, PairedError>,
    /// Two one-sided sign tests of the median ratio.
    #[serde(serialize_with = "super::or_reason")]
    pub median_equivalence: Result<SignEquivalence, PairedError>,
}

/// The first or the second of two samples.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SampleSide {
    /// The first.
    A,
    /// The second.
    B,
}

/// Why a comparison was rejected.
#[derive(Clone, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum ComparisonError {
    /// Names and values differ in number.
    #[error(
        "{names} names of records for {values} values: expected a name for \
         each value, by which values are paired; a contrast takes samples of \
         different records"
    )]
    Unnamed {
        /// Which sample.
        side: SampleSide,
        /// Number of names.
        names: usize,
        /// Number of values.
        values: usize,
    },
    /// The names are only places.
    #[error(
        "records without names, numbered by their places: expected names, by \
         which values are paired; a contrast takes samples of different \
         records"
    )]
    Numbered(SampleSide),
    /// A record twice in a sample.
    #[error(
        "record {record} occurs twice in the sample: expected it once in both"
    )]
    Twice {
        /// Which sample.
        side: SampleSide,
        /// The record.
        record: String,
        /// Place of the second value, from 0.
        place: usize,
    },
    /// A record that is only in one sample.
    #[error(
        "record {record} is not in the other sample: expected each record \
         once in both; a contrast takes samples of different records"
    )]
    Lone {
        /// Which sample has it.
        side: SampleSide,
        /// The record.
        record: String,
        /// Place of its value, from 0.
        place: usize,
    },
    /// The pairs are invalid.
    #[error(transparent)]
    Pairs(#[from] PairedError),
}

impl ComparisonError {
    /// The invalid sample, and the place of the value.
    pub fn place(&self) -> Option<(SampleSide, Option<usize>)> {
        match *self {
            Self::Unnamed { side, .. } | Self::Numbered(side) => {
                Some((side, None))
            }
            Self::Twice { side, place, .. }
            | Self::Lone { side, place, .. } => Some((side, Some(place))),
            Self::Pairs(_) => None,
        }
    }
}

/// Values, one per record, with the names of the records.
#[derive(Clone, Copy, Debug)]
pub struct NamedSample<'a, S> {
    /// Names of the records.
    pub records: &'a [S],
    /// Their values.
    pub values: &'a [f64],
}

impl<'a, S: AsRef<str>> NamedSample<'a, S> {
    /// Places of the values by the names of their records.
    fn places(
        &self,
        side: SampleSide,
    ) -> Result<BTreeMap<&'a str, usize>, ComparisonError> {
        let (names, values) = (self.records.len(), self.values.len());
        if names != values {
            return Err(ComparisonError::Unnamed { side, names, values });
        }
        if are_places(self.records) {
            return Err(ComparisonError::Numbered(side));
        }
        let mut places = BTreeMap::new();
        for (place, name) in self.records.iter().enumerate() {
            let name = name.as_ref();
            if places.insert(name, place).is_some() {
                let record = name.to_owned();
                return Err(ComparisonError::Twice { side, record, place });
            }
        }
        Ok(places)
    }
}

/// Compares two samples of the same records.
///
/// Values are not negative or infinite, and are paired by the names of their
/// records, whatever their order. Ratios between 1/(1 + `margin`) and 1 +
/// `margin` count as equivalent to 1.
///
/// ```
/// use rocking_procedures::compare;
/// use rocking_procedures::comparison::NamedSample;
/// let a = NamedSample { records: &["x", "y", "z"], values: &[1.0, 2.0, 3.0] };
/// let b = NamedSample { records: &["z", "x", "y"], values: &[3.1, 1.0, 1.9] };
/// let found = compare(a, b, 0.05)?;
/// assert_eq!(found.pairs.ratios.len(), 3);
/// assert_eq!(found.sign_test.equal, 1);
/// # Ok::<(), rocking_procedures::ComparisonError>(())
/// ```
///
/// # Errors
/// [`ComparisonError`] for records without names, a record that is only in one
/// sample, a value that is negative or NaN, or a margin that is not positive.
pub fn compare<S: AsRef<str>>(
    a: NamedSample<'_, S>,
    b: NamedSample<'_, S>,
    margin: f64,
) -> Result<Comparison, ComparisonError> {
    if !(margin > 0.0 && margin.is_finite()) {
        return Err(PairedError::Margin(margin).into());
    }
    let (named, others) = (a.places(SampleSide::A)?, b.places(SampleSide::B)?);
    for (side, own, others) in
        [(SampleSide::A, &named, &others), (SampleSide::B, &others, &named)]
    {
        let mut own = own.iter();
        if let Some((name, &place)) =
            own.find(|(name, _)| !others.contains_key(*name))
        {
            let record = (*name).to_owned();
            return Err(ComparisonError::Lone { side, record, place });
        }
    }
    let names = a.records.iter();
    let second: Vec<f64> =
        names.map(|name| b.values[others[name.as_ref()]]).collect();
    let pairs = Pairs::try_new(a.values, &second)?;
    let ratios = &pairs.ratios;
    let sample = ExtendedSample::try_new(ratios).ok();
    let boxplot = sample
        .and_then(|s| Boxplot::try_new(&s, QuantileType::default()).ok());
    Ok(Comparison {
        usable: ratios.len(),
        share: pairs.share(),
        boxplot,
        sign_test: SignTest::about(ratios, 1.0),
        mcnemar: pairs.mcnemar(),
        hodges_lehmann: hodges_lehmann(ratios),
        mean_equivalence: equivalence(ratios, margin),
        median_equivalence: sign_equivalence(ratios, margin),
        pairs,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_paired_by_name_or_not_at_all() {
        let values = [1.0, 2.0, 4.0];
        let named = |records: [&'static str; 3]| records;
        let ask = |a: &[&str], b: &[&str]| {
            let a = NamedSample { records: a, values: &values };
            let b = NamedSample { records: b, values: &values };
            compare(a, b, 0.05)
        };
        let own = named(["x", "y", "z"]);
        let found = ask(&own, &["z", "y", "x"]).unwrap();
        assert_eq!(found.pairs.ratios, [0.25, 1.0, 4.0]);
        let places = named(["1", "2", "3"]);
        for (a, b, expected) in [
            (&own[..], &["x", "y", "w"][..], "record z is not in the other"),
            (&["x", "y", "x"], &own, "record x occurs twice"),
            (&[], &own, "0 names of records for 3 values"),
            (&places, &places, "numbered by their places"),
        ] {
            let error = ask(a, b).unwrap_err().to_string();
            assert!(error.contains(expected), "{error}");
        }
    }
}
