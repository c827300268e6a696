//! The proof in the report: the reference cases with their results, the
//! digits that each precision reaches, and figures of closed forms.

mod defect;
mod fates;
mod proof;
mod spectrum;
mod tables;

pub use proof::{NOT_RUN, Proof};

use rocking_common::table::PlainTable;
use rocking_draw::figures::Figure;

/// The tables of the proof, if its results were given: digits, and pulses
/// against closed forms.
pub fn checks(proof: Option<&Proof>) -> Vec<PlainTable> {
    proof.map_or_else(Vec::new, |proof| {
        vec![proof.digits_table(), tables::similarity(proof)]
    })
}

/// The figures of the proof.
///
/// # Errors
/// If a scene is refused.
pub fn charts() -> anyhow::Result<Vec<Figure>> {
    Ok(vec![defect::chart()?, spectrum::chart()?, fates::map()?])
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;

    #[test]
    fn charts_have_something_in_every_series() {
        // The last is a map, with other columns.
        for figure in charts().unwrap().into_iter().take(2) {
            assert!(figure.svg().starts_with("<svg"));
            assert!(!figure.reading.contains("NaN"), "{}", figure.reading);
            let mut drawn: BTreeMap<[String; 2], usize> = BTreeMap::new();
            let csv = figure.csv();
            let mut rows = csv::Reader::from_reader(csv.as_bytes());
            for row in rows.records() {
                let row = row.unwrap();
                let series = [row[0].to_owned(), row[1].to_owned()];
                let y: Result<f64, _> = row[3].parse();
                let finite = y.is_ok_and(f64::is_finite);
                *drawn.entry(series).or_default() += usize::from(finite);
            }
            assert!(drawn.values().all(|n| *n >= 2), "{drawn:?}");
        }
    }
}
