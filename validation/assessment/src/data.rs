//! The numbers of an assessment as files.

use rocking_common::table::columns::{
    ASSESSED_CAPACITIES, ASSESSED_FRAGILITIES, ASSESSED_RESPONSES,
};
use rocking_common::table::{Table, number, optional};
use rocking_exchange::{BlockFragility, ExchangeFormat, Id, LimitState};
use rocking_procedures::assess::{Assessment, ObjectAssessment};
use serde::Serialize;

use crate::{About, Provenance};

/// Version of the layout of `assess.json`.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
struct ResultFile<'a, T> {
    schema: u32,
    version: &'static str,
    #[serde(flatten)]
    found: &'a T,
    provenance: &'a [Provenance],
}

/// All numbers of a result with its provenance, as JSON.
///
/// # Errors
/// None in practice.
pub fn json<T: Serialize>(found: &T, about: &About) -> anyhow::Result<String> {
    let provenance = &about.provenance;
    let version = env!("CARGO_PKG_VERSION");
    let file = ResultFile { schema: SCHEMA, version, found, provenance };
    Ok(serde_json::to_string_pretty(&file)? + "\n")
}

/// The fragility curves with their bands, as CSV.
pub(crate) fn fragilities(found: &Assessment) -> String {
    let mut table = Table::of(&ASSESSED_FRAGILITIES);
    for one in &found.objects {
        let band = one.band.iter().flat_map(|b| &b.points);
        for point in band {
            table.row([
                one.id.clone(),
                found.im.to_string(),
                found.unit.to_owned(),
                number(point.intensity),
                number(point.probability.value()),
                optional(point.probability.low()),
                optional(point.probability.high()),
            ]);
        }
    }
    table.finish()
}

/// The intensities at which each record damages each object, as CSV.
pub(crate) fn capacities(found: &Assessment) -> String {
    let mut table = Table::of(&ASSESSED_CAPACITIES);
    for one in &found.objects {
        for row in &one.by_record {
            table.row([
                one.id.clone(),
                row.record.clone(),
                found.im.to_string(),
                found.unit.to_owned(),
                number(row.im),
                row.damages.to_string(),
            ]);
        }
    }
    table.finish()
}

/// The response at rising intensity of each object, as CSV.
pub(crate) fn responses(found: &Assessment) -> String {
    let mut table = Table::of(&ASSESSED_RESPONSES);
    for one in &found.objects {
        for row in &one.ida {
            table.row([
                one.id.clone(),
                number(row.intensity),
                number(row.edp16),
                number(row.edp50),
                number(row.edp84),
            ]);
        }
    }
    table.finish()
}

/// The fragilities of all objects in a format of another program; none if the
/// format does not have the intensity measure.
///
/// # Errors
/// A name that other programs do not take, and an invalid block.
pub(crate) fn exchanged(
    found: &Assessment,
    format: &ExchangeFormat,
) -> anyhow::Result<Vec<(String, String)>> {
    let fragility = |one: &ObjectAssessment| {
        let id = |name: &str| {
            name.parse::<Id>()
                .map_err(|error| anyhow::anyhow!("{name}: {error}"))
        };
        let own_unit =
            one.fragility.fitted.scaled(1.0 / found.units_per_im_unit);
        let state = LimitState { name: id("damage")?, fragility: own_unit? };
        anyhow::Ok(BlockFragility {
            id: id(&one.id)?,
            block: one.block,
            eta: Some(one.eta),
            im: found.im.clone(),
            limit_states: vec![state],
            origin: format!("{} records, rocking assess", found.records),
            model_error: found.model_error,
        })
    };
    let all = found.objects.iter().map(fragility);
    let all = all.collect::<anyhow::Result<Vec<_>>>()?;
    let Ok(texts) = format.texts(&all) else { return Ok(Vec::new()) };
    let named = |ending| format!("{}.{ending}", format.name);
    let beside = format.beside.map(named).zip(texts.beside);
    let main = (named(format.extension), texts.main);
    Ok(std::iter::once(main).chain(beside).collect())
}
