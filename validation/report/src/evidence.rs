//! What the report shows of the proof: the declared cases with their
//! results, the digits that each precision reaches, and figures of closed
//! forms.

mod defect;
pub mod families;
mod fates;
mod proof;
mod spectrum;
mod tables;

use families::{Family, families};
pub use proof::{NOT_RUN, Proof};

use rocking_common::table::PlainTable;
use rocking_draw::figures::Figure;
use rocking_proof::cases::load_all;

/// Declared cases with their results, family by family.
///
/// # Errors
/// Where the cases cannot be read.
pub fn shown(proof: &Proof) -> anyhow::Result<Vec<Family>> {
    Ok(families(&load_all()?, proof.results()))
}

/// The tables of the proof: digits and pulses against closed forms, if
/// results were handed in, and critical values beside published ones.
///
/// # Errors
/// Where the cases cannot be read.
pub fn checks(proof: Option<&Proof>) -> anyhow::Result<Vec<PlainTable>> {
    let pulses = proof.map(|proof| tables::similarity(proof.results()));
    let digits = proof.map(Proof::digits_table);
    let mut all: Vec<PlainTable> =
        digits.into_iter().chain(pulses.transpose()?).collect();
    all.push(tables::critical_values()?);
    Ok(all)
}

/// The figures of the proof.
///
/// # Errors
/// Where a scene is refused.
pub fn charts() -> anyhow::Result<Vec<Figure>> {
    Ok(vec![defect::chart()?, spectrum::chart()?, fates::map()?])
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use super::*;
    use rocking_proof::cases::Cost;

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

    #[test]
    fn every_quick_case_is_shown_with_its_result() {
        let data = concat!(env!("CARGO_MANIFEST_DIR"), "/../../reports/data");
        let proof = Proof::read(data.as_ref()).unwrap();
        let families = shown(&proof).unwrap();
        let cases: usize = families.iter().map(|f| f.cases.len()).sum();
        let all = load_all().unwrap();
        let quick = all.iter().filter(|c| c.cost == Cost::Quick).count();
        assert_eq!(cases, quick);
        let shown = families.iter().flat_map(|f| &f.cases);
        assert!(shown.into_iter().all(|(_, result)| result.is_some()));
    }
}
