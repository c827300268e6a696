//! The numbers of an assessment as files.

use rocking_common::table::columns::{
    ASSESSED_CAPACITIES, ASSESSED_FRAGILITIES, ASSESSED_RESPONSES,
};
use rocking_common::table::{Table, number, optional};
use rocking_exchange::{BlockFragility, Format, Id, LimitState};
use rocking_procedures::assess::{Alternative, Answer, Assessed, Assessment};
use rocking_procedures::counts::Bounds;
use rocking_procedures::fragility::risk::Contribution;
use serde::Serialize;

use crate::About;

/// Version of the layout of `assess.json`.
const SCHEMA: u32 = 1;

#[derive(Serialize)]
struct File<'a> {
    schema: u32,
    version: &'static str,
    im: String,
    unit: &'static str,
    records: usize,
    drawn: String,
    level: f64,
    years: f64,
    correlation: &'a Option<Bounds>,
    objects: Vec<Object<'a>>,
    together: Vec<Together>,
    provenance: Vec<Provenance<'a>>,
}

#[derive(Serialize)]
struct Provenance<'a> {
    what: &'a str,
    is: &'a str,
}

#[derive(Serialize)]
struct Object<'a> {
    id: &'a str,
    width_m: f64,
    height_m: f64,
    alpha_rad: f64,
    p_rad_s: f64,
    eta: f64,
    floor: Option<&'a str>,
    damage: String,
    onset_pga_g: f64,
    #[serde(flatten)]
    numbers: Numbers,
    p_damage: Vec<Probability>,
    contributions: &'a [Contribution],
    first_in_draws: f64,
    friction_share: Option<f64>,
    unresolved: u64,
    analyses: u64,
    records_without_damage: usize,
    best_im: Option<&'a str>,
    best_im_dispersion: Option<f64>,
    records_needed: Option<f64>,
    alternatives: Vec<Other>,
}

/// What a fragility says.
#[derive(Serialize)]
struct Numbers {
    median_im: Bounds,
    im_at_5_percent: Bounds,
    dispersion: f64,
    shift: f64,
    annual_frequency: Option<Bounds>,
    probability: Option<Bounds>,
}

#[derive(Serialize)]
struct Probability {
    im: f64,
    p: f64,
    low: Option<f64>,
    high: Option<f64>,
}

#[derive(Serialize)]
struct Other {
    assumption: String,
    #[serde(flatten)]
    numbers: Numbers,
}

#[derive(Serialize)]
struct Together {
    at_least: usize,
    #[serde(flatten)]
    numbers: Numbers,
}

impl Numbers {
    fn of(answer: &Answer) -> Self {
        Self {
            median_im: answer.median_im,
            im_at_5_percent: answer.small_im,
            dispersion: answer.fitted.dispersion(),
            shift: answer.fitted.shift(),
            annual_frequency: answer.annual_frequency(),
            probability: answer.probability(),
        }
    }
}

/// The measure that leaves the least dispersion, with that dispersion.
pub(crate) fn best(one: &Assessed) -> Option<(&str, f64)> {
    let measures = one.ranking.measures.iter();
    let known = measures
        .filter_map(|m| Some((m.im.as_str(), m.dispersion.as_ref()?.point)));
    known.min_by(|a, b| a.1.total_cmp(&b.1))
}

/// All numbers, as JSON.
///
/// # Errors
/// None in practice.
pub fn json(found: &Assessment, about: &About) -> anyhow::Result<String> {
    let together = found.together.iter().map(|row| Together {
        at_least: row.at_least,
        numbers: Numbers::of(&row.answer),
    });
    let provenance = about.provenance.iter();
    let file = File {
        schema: SCHEMA,
        version: env!("CARGO_PKG_VERSION"),
        im: found.im.to_string(),
        unit: found.unit,
        records: found.records,
        drawn: found.drawn.to_string(),
        level: found.level,
        years: found.years,
        correlation: &found.correlation,
        objects: found.objects.iter().map(object).collect(),
        together: together.collect(),
        provenance: provenance
            .map(|(what, is)| Provenance { what, is })
            .collect(),
    };
    Ok(serde_json::to_string_pretty(&file)? + "\n")
}

fn object(one: &Assessed) -> Object<'_> {
    let edges = one.contributions.iter();
    let edges: Vec<f64> = edges.flat_map(|c| [c.from_im, c.to_im]).collect();
    let band = one.fragility.band.iter().flat_map(|band| &band.points);
    let at_hazard = band.filter(|point| edges.contains(&point.intensity));
    let best = best(one);
    let other = |other: &Alternative| Other {
        assumption: other.assumption.to_string(),
        numbers: Numbers::of(&other.answer),
    };
    Object {
        id: &one.id,
        width_m: one.width_m,
        height_m: one.height_m,
        alpha_rad: one.alpha_rad,
        p_rad_s: one.p_rad_s,
        eta: one.eta,
        floor: one.floor.as_deref(),
        damage: one.damage.to_string(),
        onset_pga_g: one.uplift_pga_g,
        numbers: Numbers::of(&one.answer),
        p_damage: at_hazard
            .map(|point| Probability {
                im: point.intensity,
                p: point.probability,
                low: point.low,
                high: point.high,
            })
            .collect(),
        contributions: &one.contributions,
        first_in_draws: one.first_in_draws,
        friction_share: one.slides_first,
        unresolved: one.resolution.unresolved,
        analyses: one.resolution.analyses,
        records_without_damage: one
            .by_record
            .iter()
            .filter(|r| !r.damages)
            .count(),
        best_im: best.map(|best| best.0),
        best_im_dispersion: best.map(|best| best.1),
        records_needed: one.fragility.needed.as_ref().map(|n| n.for_median),
        alternatives: one.alternatives.iter().map(other).collect(),
    }
}

/// The fragility curves with their bands, as CSV.
pub(crate) fn fragilities(found: &Assessment) -> String {
    let mut table = Table::of(&ASSESSED_FRAGILITIES);
    for one in &found.objects {
        let band = one.fragility.band.iter().flat_map(|b| &b.points);
        for point in band {
            table.row([
                one.id.clone(),
                found.im.to_string(),
                found.unit.to_owned(),
                number(point.intensity),
                number(point.probability),
                optional(point.low),
                optional(point.high),
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

/// The fragilities of all objects in a format of another program; none where
/// the format does not hold the intensity measure.
///
/// # Errors
/// A name that other programs do not take, and a block that is none.
pub(crate) fn exchanged(
    found: &Assessment,
    format: Format,
) -> anyhow::Result<Vec<(&'static str, String)>> {
    let fragility = |one: &Assessed| {
        let id = |name: &str| {
            name.parse::<Id>()
                .map_err(|error| anyhow::anyhow!("{name}: {error}"))
        };
        let own_unit = one.answer.fitted.scaled(1.0 / found.units_per_im_unit);
        let state = LimitState { name: id("damage")?, fragility: own_unit? };
        anyhow::Ok(BlockFragility {
            id: id(&one.id)?,
            block: one.block,
            eta: Some(one.eta),
            im: found.im.clone(),
            limit_states: vec![state],
            origin: format!("{} records, rocking assess", found.records),
        })
    };
    let all = found.objects.iter().map(fragility);
    let all = all.collect::<anyhow::Result<Vec<_>>>()?;
    let Ok(texts) = format.texts(&all) else { return Ok(Vec::new()) };
    let main = match format {
        Format::Nrml => "nrml.xml",
        Format::Pelicun => "pelicun.csv",
        Format::Pact => "pact.csv",
        Format::Csv => "parameters.csv",
    };
    let beside = texts.beside.map(|(_, text)| ("pelicun.json", text));
    Ok(std::iter::once((main, texts.main)).chain(beside).collect())
}
