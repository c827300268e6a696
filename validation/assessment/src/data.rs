//! The numbers of an assessment as files.

use rocking_common::table::columns::{
    ASSESSED_CAPACITIES, ASSESSED_FRAGILITIES, ASSESSED_OBJECTS,
    ASSESSED_RESPONSES,
};
use rocking_common::table::{Table, number, optional};
use rocking_exchange::{BlockFragility, ExchangeFormat, Id, LimitState};
use rocking_procedures::assess::{Assessment, ObjectAssessment, ObjectState};
use rocking_statistics::Estimate;
use serde::Serialize;

use crate::words::remarks;
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

/// The objects with their states and answers, as CSV.
pub(crate) fn objects(found: &Assessment) -> String {
    let mut table = Table::of(&ASSESSED_OBJECTS);
    for (one, rank) in found.objects.iter().zip(1..) {
        let years = one.answer.return_period_years();
        let target = one.target.map(|own| own.to_string());
        table.row([
            one.facts.object.id.clone(),
            one.facts.object.label.clone(),
            one.state().to_string(),
            rank.to_string(),
            optional(years.map(|own| own.value())),
            optional(years.and_then(|own| own.low())),
            optional(years.and_then(|own| own.high())),
            target.unwrap_or_default(),
            optional(one.slides_first),
            String::new(),
            remarks(&one.facts),
        ]);
    }
    for one in &found.not_rocking {
        let none = String::new;
        table.row([
            one.facts.object.id.clone(),
            one.facts.object.label.clone(),
            ObjectState::NotRocking.to_string(),
            none(),
            none(),
            none(),
            none(),
            none(),
            number(one.share),
            number(one.needed_friction),
            remarks(&one.facts),
        ]);
    }
    table.finish()
}

/// The fragility curves with their bands, as CSV.
pub(crate) fn fragilities(found: &Assessment) -> String {
    let mut table = Table::of(&ASSESSED_FRAGILITIES);
    for one in &found.objects {
        let band = one.band.iter().flat_map(|b| &b.points);
        for point in band {
            table.row([
                one.facts.object.id.clone(),
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
                one.facts.object.id.clone(),
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
                one.facts.object.id.clone(),
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
        let own = &one.facts.object;
        let remarks = remarks(&one.facts);
        let stated = match remarks.is_empty() {
            true => one.state().to_string(),
            false => format!("{}: {remarks}", one.state()),
        };
        // The factor of recorded motions is a bias of the capacity, too.
        let bias = Estimate::exact(one.answer.fitted.bias());
        let is_own = bias.value() == found.model_error.bias().value();
        let bias = (!is_own).then_some(bias);
        anyhow::Ok(BlockFragility {
            id: id(&own.id)?,
            block: own.block,
            eta: Some(own.restitution.velocity_ratio()),
            im: found.im.clone(),
            limit_states: vec![state],
            origin: format!(
                "{} records, rocking assess, {stated}",
                found.records
            ),
            model_error: found.model_error.or(bias, None),
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
