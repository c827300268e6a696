//! Objects, records and a hazard curve to one page.

use std::collections::BTreeMap;

use pyo3::prelude::*;
use rocking::accelerogram::Accelerogram;
use rocking::block::Restitution;
use rocking_assessment::{About, files, recorded_ratios};
use rocking_exchange::Id;
use rocking_procedures::assess::NamedFloor;
use rocking_procedures::{
    AssessOptions, Draws, ModelError, Object, assess as procedure,
};
use rocking_records::floor::Floor;
use rocking_statistics::Clusters;

use crate::exchange::{HazardInput, ModelErrorInput, model_error, read};
use crate::given::{ExcitationInput, block_of, positive_gravity, suite_of};
use crate::work::{self, refuse};

/// An object.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct GivenObject {
    id: String,
    block: (f64, f64),
    eta: f64,
    friction: Option<f64>,
    limit_ratio: Option<f64>,
    floor: Option<(String, f64, f64, f64)>,
    notes: Vec<(String, String)>,
    position_m: Option<(f64, f64)>,
}

impl GivenObject {
    fn object(self, key: &Id) -> PyResult<Object> {
        let floor = self.floor.map(|(name, period_s, damping, height)| {
            let floor = Floor::try_new(period_s, damping, height);
            let floor = floor.map_err(|e| refuse(format!("{name}: {e}")))?;
            Ok::<_, PyErr>(NamedFloor { name, floor })
        });
        let eta = Restitution::constant(self.eta).map_err(refuse)?;
        Ok(Object {
            id: key.to_string(),
            notes: self.notes,
            position_m: self.position_m,
            friction: self.friction,
            limit_ratio: self.limit_ratio,
            floor: floor.transpose()?,
            ..Object::new(&self.id, block_of(self.block)?, eta)
        })
    }
}

/// How objects are assessed.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Options {
    years: f64,
    target: Option<f64>,
    sliding_share: f64,
    certify: bool,
    replicates: usize,
    seed: u64,
    gravity: f64,
    model_error: ModelErrorInput,
}

/// The files of an assessment by their names; records are `embedded`, or have
/// these earthquakes.
#[pyfunction]
pub fn assess(
    py: Python<'_>,
    objects: Vec<GivenObject>,
    records: Vec<ExcitationInput<'_>>,
    events: Vec<String>,
    embedded: bool,
    hazard: Option<HazardInput>,
    options: Options,
    threads: Option<usize>,
) -> PyResult<BTreeMap<String, String>> {
    let labels: Vec<&str> = objects.iter().map(|one| &*one.id).collect();
    let keys = Id::of_labels(&labels);
    let objects = objects.into_iter().zip(&keys);
    let objects = objects.map(|(one, key)| one.object(key));
    let objects = objects.collect::<PyResult<Vec<Object>>>()?;
    let records: Vec<Accelerogram> = suite_of(records)?;
    let clusters = Clusters::of_events(&events, records.len());
    let hazard = hazard.as_ref().map(read).transpose()?;
    let ratios = match embedded {
        true => recorded_ratios(hazard.as_ref()),
        false => Ok(Vec::new()),
    };
    let Options { replicates, seed, .. } = options;
    let model_error = model_error(&options.model_error, ModelError::fitted())?;
    let years = options.years;
    let target = options.target.map(|target| {
        AssessOptions::target(target, years).ok_or_else(|| {
            refuse(format!(
                "target {target}: expected a return period of 1 year or more, \
                 or a probability between 0 and 1"
            ))
        })
    });
    let own = AssessOptions {
        gravity_m_s2: positive_gravity(options.gravity)?,
        hazard: hazard.as_ref(),
        years: options.years,
        draws: Draws { replicates, seed },
        certify: options.certify,
        model_error,
        recorded_ratios: &ratios.map_err(refuse)?,
        target_years: target.transpose()?,
        sliding_share: options.sliding_share,
    };
    let ground = match embedded {
        true => "No records are given: the motions are synthetic, made by \
                 published relations for ordinary earthquakes."
            .to_owned(),
        false => format!("The motions are {} records.", records.len()),
    };
    let program = crate::SOFTWARE.to_owned();
    let about = About::of(ground, [("Program", Some(program))]);
    let found = work::run(py, threads, None, 0, |_| {
        procedure(&objects, &records, &clusters, &own)
    })?;
    let files = files(&found.map_err(refuse)?, &about).map_err(refuse)?;
    let text = |(name, bytes): (String, Vec<u8>)| {
        Ok((name, String::from_utf8(bytes).map_err(refuse)?))
    };
    files.into_iter().map(text).collect()
}
