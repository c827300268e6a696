//! Input from Python: blocks, models, records and pulses, checked by the core.

use std::borrow::Cow;
use std::collections::BTreeMap;

use numpy::{IntoPyArray, PyArray1, PyReadonlyArray1};
use pyo3::prelude::*;
use rocking::accelerogram::{Accelerogram, suite_names};
use rocking::block::{Block, Restitution};
use rocking::excitation::{Pulse, PulseName};
use rocking::integrator::{self, Model, Overturning};
use rocking::units::AccelerationUnit;
use rocking_records::intensity::IntensityMeasure;
use rocking_records::sampling::{Digits, interval};
use rocking_records::{Remark, remarks};

use crate::work::{self, refuse};

/// Finds a word among the choices, or rejects it.
pub fn choose<T: Copy>(
    what: &str,
    found: &str,
    choices: &[(&str, T)],
) -> PyResult<T> {
    let choice = choices.iter().find(|(name, _)| *name == found);
    choice.map(|(_, value)| *value).ok_or_else(|| {
        let names: Vec<_> = choices.iter().map(|(name, _)| *name).collect();
        let names = names.join(", ");
        refuse(format!("{what} {found:?}: expected one of {names}"))
    })
}

/// The constant step in s of an index of times in s, as far as their digits
/// determine it.
#[pyfunction]
pub fn sampling_interval(times_s: PyReadonlyArray1<'_, f64>) -> PyResult<f64> {
    let times = times_s.as_slice()?;
    let digits = Digits::of(times);
    let found = interval(times, |i| digits.resolution_s(times[i]));
    let found = found.map_err(|fault| {
        let row =
            fault.index().map_or(String::new(), |i| format!(" row {i}:"));
        refuse(format!("index:{row} {fault}"))
    })?;
    Ok(found.dt_s)
}

/// The unit in which samples are given.
pub fn unit(text: &str) -> PyResult<AccelerationUnit> {
    AccelerationUnit::parse(text).ok_or_else(|| {
        refuse(format!("units {text:?}: expected g, m/s2 or cm/s2"))
    })
}

/// Equation of motion, overturning criterion and restitution, as Python
/// names them; no `eta` is Housner's.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct Physics {
    eta: Option<f64>,
    model: String,
    overturn: String,
}

/// Gravity in m/s2, checked.
pub fn positive_gravity(gravity_m_s2: f64) -> PyResult<f64> {
    if gravity_m_s2 > 0.0 && gravity_m_s2.is_finite() {
        return Ok(gravity_m_s2);
    }
    Err(refuse(format!(
        "gravity {gravity_m_s2} m/s2: expected a positive number"
    )))
}

impl Physics {
    pub fn model(&self) -> PyResult<Model> {
        self.model.parse().map_err(refuse)
    }

    pub fn overturning(&self) -> PyResult<Overturning> {
        self.overturn.parse().map_err(refuse)
    }

    pub fn restitution(&self, block: &Block) -> PyResult<Restitution> {
        restitution_of(self.eta, block)
    }
}

/// A constant restitution, or Housner's of the block if none is given.
pub fn restitution_of(
    eta: Option<f64>,
    block: &Block,
) -> PyResult<Restitution> {
    match eta {
        Some(eta) => Restitution::constant(eta),
        None => Restitution::housner(block),
    }
    .map_err(refuse)
}

/// A block by (alpha, p).
pub fn block_of((alpha, p): (f64, f64)) -> PyResult<Block> {
    Block::try_new(alpha, p).map_err(refuse)
}

/// An excitation as Python hands it over: name, samples in g with their
/// interval, and a pulse's parameters if there are no samples.
pub type ExcitationInput<'py> =
    (String, Option<PyReadonlyArray1<'py, f64>>, f64, BTreeMap<String, f64>);

/// An excitation, checked.
pub enum RecordOrPulse {
    Record(Accelerogram),
    Pulse(Pulse),
}

impl RecordOrPulse {
    pub fn of(
        (name, samples, dt, numbers): ExcitationInput<'_>,
    ) -> PyResult<Self> {
        match samples {
            None => Ok(Self::Pulse(pulse_of(&name, &numbers)?)),
            Some(samples) => {
                // Copies of many records take a while.
                samples.py().check_signals()?;
                let samples = samples.as_slice()?.to_vec();
                let record = Accelerogram::try_new(name, dt, samples)
                    .map_err(refuse)?;
                Ok(Self::Record(record))
            }
        }
    }
}

/// The records of a suite, with distinct names.
pub fn suite_of(
    given: Vec<ExcitationInput<'_>>,
) -> PyResult<Vec<Accelerogram>> {
    let records = given.into_iter().map(record_of);
    let records = records.collect::<PyResult<Vec<_>>>()?;
    let given: Vec<&str> = records.iter().map(Accelerogram::name).collect();
    let names = suite_names(&given).map_err(|error| {
        refuse(format!(
            "{error}; Record(..., name=...) and Record.of(..., name=...) \
             name a record"
        ))
    })?;
    let names = names.into_iter().map(Cow::into_owned);
    let names: Vec<String> = names.collect();
    let named = records.into_iter().zip(names);
    named.map(|(record, name)| record.named(name).map_err(refuse)).collect()
}

/// The record of a given excitation that must be one.
pub fn record_of(given: ExcitationInput<'_>) -> PyResult<Accelerogram> {
    match RecordOrPulse::of(given)? {
        RecordOrPulse::Record(record) => Ok(record),
        RecordOrPulse::Pulse(_) => Err(refuse("a pulse: expected a record")),
    }
}

/// A pulse by its kind's name and its numbers.
pub fn pulse_of(
    name: &str,
    numbers: &BTreeMap<String, f64>,
) -> PyResult<Pulse> {
    let mut left = numbers.clone();
    let pulse: PulseName = name.parse().map_err(refuse)?;
    let kind = pulse.kind(|parameter| {
        let key = parameter.name_over_gravity();
        left.remove(key)
            .ok_or_else(|| refuse(format!("pulse {name:?} needs {key}")))
    })?;
    if let Some(key) = left.keys().next() {
        return Err(refuse(format!("pulse {name:?} has no use for {key}")));
    }
    Pulse::try_new(kind).map_err(refuse)
}

/// The name of a pulse, and its keys with their default values.
type PulseKeys = (&'static str, Vec<(&'static str, Option<f64>)>);

/// The pulses with their keys.
#[pyfunction]
pub fn pulses() -> Vec<PulseKeys> {
    let pulses = PulseName::ALL.into_iter().map(|pulse| {
        let keys = pulse.parameters().iter();
        let keys = keys.map(|p| (p.name_over_gravity(), p.default_value()));
        (pulse.name(), keys.collect())
    });
    pulses.collect()
}

/// Checks the parameters of a block.
#[pyfunction]
pub fn block(alpha: f64, p: f64) -> PyResult<()> {
    block_of((alpha, p)).map(|_| ())
}

/// (alpha, p) of a block of this size.
#[pyfunction]
pub fn block_of_size(
    width_m: f64,
    height_m: f64,
    gravity: f64,
) -> PyResult<(f64, f64)> {
    let block =
        Block::from_dimensions(width_m, height_m, gravity).map_err(refuse)?;
    Ok((block.slenderness_rad(), block.frequency_rad_s()))
}

/// Width and height of a block in m.
#[pyfunction]
pub fn block_size(alpha: f64, p: f64, gravity: f64) -> PyResult<(f64, f64)> {
    let size = block_of((alpha, p))?.dimensions(gravity).map_err(refuse)?;
    Ok((size.width_m, size.height_m))
}

/// PGA in g above which a block lifts off.
#[pyfunction]
pub fn uplift_threshold(
    alpha: f64,
    p: f64,
    physics: Physics,
) -> PyResult<f64> {
    let block = block_of((alpha, p))?;
    Ok(integrator::uplift_threshold(&block, physics.model()?))
}

/// A remark as Python shows it.
pub fn remarked(remark: &Remark) -> String {
    format!("{}: {remark}", remark.code())
}

/// Samples in multiples of gravity, checked with the name of the record, and
/// remarks on suspicious samples.
#[pyfunction]
pub fn samples<'py>(
    py: Python<'py>,
    acc: PyReadonlyArray1<'py, f64>,
    dt: f64,
    units: &str,
    gravity: f64,
    name: &str,
) -> PyResult<(Bound<'py, PyArray1<f64>>, Vec<String>)> {
    let per_gravity = unit(units)?.per_gravity(positive_gravity(gravity)?);
    let samples: Vec<f64> =
        acc.as_slice()?.iter().map(|a| a / per_gravity).collect();
    let record = Accelerogram::try_new(name, dt, samples).map_err(refuse)?;
    let found = || remarks(&record).iter().map(remarked).collect();
    let found = work::on_numbers(py, record.samples_g().len(), found)?;
    Ok((record.samples_g().to_vec().into_pyarray(py), found))
}

/// The name of an intensity measure as results spell it.
#[pyfunction]
pub fn measure(name: &str) -> PyResult<String> {
    let found: IntensityMeasure = name.parse().map_err(refuse)?;
    Ok(found.to_string())
}

/// Duration in s, PGA in g and PGV/g in s of a pulse.
#[pyfunction]
pub fn pulse(
    kind: &str,
    numbers: BTreeMap<String, f64>,
) -> PyResult<(f64, f64, f64)> {
    let pulse = pulse_of(kind, &numbers)?;
    Ok((pulse.duration_s(), pulse.pga_g(), pulse.pgv_g_s()))
}
