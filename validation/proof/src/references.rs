//! High-precision references, embedded; every number is a decimal string
//! with 36 or 40 digits and is read to the nearest double.

use std::sync::LazyLock;

use rocking::excitation::{PulseName, PulseParameter};
use rocking::number::double::DoubleDouble;
use serde::Deserialize;
use serde_json::Value;

use crate::arithmetic::decimal;
use crate::error::MethodError;
use crate::scene::{Forcing, Model, Overturning, PulseKind, Scene, rescaled};

/// An embedded file.
pub(crate) struct Reference {
    pub file: &'static str,
    text: &'static str,
}

macro_rules! reference {
    ($name:literal) => {
        Reference {
            file: concat!("fixtures/references/", $name),
            text: include_str!(concat!(
                "../../../fixtures/references/",
                $name
            )),
        }
    };
}

pub(crate) const TRAJECTORIES: Reference = reference!("trajectories.json");
pub(crate) const RECORDS: Reference = reference!("records.json");
pub(crate) const LINEAR_PULSES: Reference = reference!("linear_pulses.json");
pub(crate) const FREE_ROCKING: Reference = reference!("free_rocking.json");
pub(crate) const RECT_PULSE: Reference = reference!("rect_pulse.json");
pub(crate) const SPECTRUM: Reference =
    reference!("linear_overturning_spectrum.json");

impl Reference {
    pub fn read(&self) -> Result<Value, MethodError> {
        serde_json::from_str(self.text).map_err(|e| self.lacks(e))
    }

    pub fn lacks(&self, what: impl std::fmt::Display) -> MethodError {
        MethodError::Reference { file: self.file, what: what.to_string() }
    }

    /// The field `key` of `value`.
    pub fn get<'a>(
        &self,
        value: &'a Value,
        key: &str,
    ) -> Result<&'a Value, MethodError> {
        value.get(key).ok_or_else(|| self.lacks(format!("no field `{key}`")))
    }

    /// The list `key` of `value`.
    pub fn list<'a>(
        &self,
        value: &'a Value,
        key: &str,
    ) -> Result<&'a [Value], MethodError> {
        let found = self.get(value, key)?.as_array();
        found
            .map(Vec::as_slice)
            .ok_or_else(|| self.lacks(format!("`{key}` is no list")))
    }

    /// A number, from JSON or from the first word of a string.
    pub fn number(&self, value: &Value) -> Result<f64, MethodError> {
        let text = value.as_str().and_then(|s| s.split_whitespace().next());
        let read = match text {
            Some(word) => word.parse().ok(),
            None => value.as_f64(),
        };
        read.ok_or_else(|| self.lacks(format!("`{value}` is no number")))
    }

    /// The number `key` of `value`.
    pub fn f64(&self, value: &Value, key: &str) -> Result<f64, MethodError> {
        self.number(self.get(value, key)?)
    }

    /// The number `key` of `value`, which may be null.
    pub fn optional(
        &self,
        value: &Value,
        key: &str,
    ) -> Result<Option<f64>, MethodError> {
        match self.get(value, key)? {
            Value::Null => Ok(None),
            found => self.number(found).map(Some),
        }
    }

    /// The number `key` of `value` to the last bits of a double-double.
    pub fn wide(
        &self,
        value: &Value,
        key: &str,
    ) -> Result<DoubleDouble, MethodError> {
        let found = self.get(value, key)?;
        let number = found.as_str().and_then(decimal);
        number.ok_or_else(|| self.lacks(format!("`{found}` is no decimal")))
    }

    /// The numbers `key` of every entry of a list.
    pub fn column(
        &self,
        entries: &[Value],
        key: &str,
    ) -> Result<Vec<f64>, MethodError> {
        entries.iter().map(|entry| self.f64(entry, key)).collect()
    }
}

/// Input of a case: a named trajectory.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Named {
    pub entry: String,
}

/// Input of a case: an entry by its place in the file.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct Numbered {
    pub entry: usize,
}

/// Input of a case: a pulse in Eq. 2 by its place in the file, and blocks:
/// alpha (rad), p (rad/s), g (m/s2).
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct PulseOnBlocks {
    pub entry: usize,
    pub blocks: Vec<[f64; 3]>,
}

/// The entry of this number among a file's cases.
pub(crate) fn entry(
    file: &Reference,
    number: usize,
) -> Result<Value, MethodError> {
    let all = file.read()?;
    let found = file.list(&all, "cases")?.get(number).cloned();
    found.ok_or_else(|| file.lacks(format!("no entry {number}")))
}

/// A block (alpha, p, g) in Eq. 2 under the pulse of a dimensionless case of
/// `linear_pulses.json`.
pub(crate) fn linear_scene(
    case: &Value,
    [alpha, p, g]: [f64; 3],
    criterion: Overturning,
) -> Result<Scene, MethodError> {
    let file = &LINEAR_PULSES;
    let fields = Fields {
        kind: "pulse",
        amplitude: "A",
        omega: "Omega",
        duration: "tau_d",
        period: "tau_p",
        cycles: None,
    };
    let pulse = pulse(file, case, &fields)?
        .ok_or_else(|| file.lacks(format!("pulse {}", case["pulse"])))?;
    Ok(Scene {
        model: Model::Linearized,
        overturning: criterion,
        ..Scene::new(
            [alpha, p, g],
            file.f64(case, "eta")?,
            Forcing::Pulse(rescaled(pulse, g * alpha, p)),
        )
    })
}

/// What the fields of a pulse are called in a file.
struct Fields {
    kind: &'static str,
    amplitude: &'static str,
    omega: &'static str,
    duration: &'static str,
    period: &'static str,
    /// Of a Ricker pulse's length in periods; 4 where there is none.
    cycles: Option<&'static str>,
}

/// The pulse of an entry; none where its kind is not that of a pulse.
fn pulse(
    file: &Reference,
    value: &Value,
    fields: &Fields,
) -> Result<Option<PulseKind>, MethodError> {
    use PulseParameter as P;
    let name = match file.get(value, fields.kind)?.as_str() {
        Some("one_sine") => PulseName::OneSine,
        Some("half_sine") => PulseName::HalfSine,
        Some("one_cosine") => PulseName::OneCosine,
        Some("rectangular") => PulseName::Rectangle,
        Some("triangular") => PulseName::Triangle,
        Some("ricker_sym") => PulseName::RickerSymmetric,
        Some("ricker_anti") => PulseName::RickerAntisymmetric,
        Some("mavroeidis") => PulseName::MavroeidisPapageorgiou,
        _ => return Ok(None),
    };
    let kind = name.kind(|parameter| {
        let key = match (parameter, fields.cycles) {
            (P::Cycles, None) => return Ok(4.0),
            (P::Cycles, Some(cycles)) => cycles,
            (P::Amplitude, _) => fields.amplitude,
            (P::Omega, _) => fields.omega,
            (P::Duration, _) => fields.duration,
            (P::Period, _) => fields.period,
            (P::Velocity, _) => "A_v",
            (P::Frequency, _) => "f_p",
            (P::Gamma, _) => "gamma",
            (P::Phase, _) => "nu",
        };
        file.f64(value, key)
    });
    kind.map(Some)
}

/// The block and pulse of an entry of `rect_pulse.json`.
pub(crate) fn rectangular_scene(
    case: &Value,
    criterion: Overturning,
) -> Result<Scene, MethodError> {
    let file = &RECT_PULSE;
    Ok(Scene {
        overturning: criterion,
        ..Scene::new(
            [
                file.f64(case, "alpha")?,
                file.f64(case, "p")?,
                file.f64(&file.read()?, "g")?,
            ],
            file.f64(case, "eta")?,
            Forcing::Pulse(PulseKind::Rectangle {
                amplitude: file.f64(case, "a0")?,
                duration_s: file.f64(case, "td")?,
            }),
        )
    })
}

/// The file of trajectories, read once.
static READ: LazyLock<Result<Value, MethodError>> =
    LazyLock::new(|| TRAJECTORIES.read());

/// The trajectory of this name.
pub(crate) fn trajectory(name: &str) -> Result<&'static Value, MethodError> {
    let file = READ.as_ref().map_err(Clone::clone)?;
    let named = |case: &&Value| case["name"] == name;
    TRAJECTORIES
        .list(file, "cases")?
        .iter()
        .find(named)
        .ok_or_else(|| TRAJECTORIES.lacks(format!("no case `{name}`")))
}

/// What a careful double-precision code was off by on the trajectory of this
/// name.
pub(crate) fn attainable_float64(
    name: &str,
) -> Result<&'static Value, MethodError> {
    TRAJECTORIES.get(trajectory(name)?, "attainable_float64")
}

/// The scene of a trajectory.
pub(crate) fn scene(
    case: &Value,
    criterion: Overturning,
) -> Result<Scene, MethodError> {
    let file = &TRAJECTORIES;
    let equation = match case["model"].as_str() {
        Some("nonlinear") => Model::Nonlinear,
        Some("linear") => Model::Linearized,
        _ => return Err(file.lacks("model neither nonlinear nor linear")),
    };
    Ok(Scene {
        model: equation,
        overturning: criterion,
        ..Scene::new(
            [
                file.f64(case, "alpha")?,
                file.f64(case, "p")?,
                file.f64(case, "g")?,
            ],
            file.f64(case, "eta")?,
            forcing(file.get(case, "forcing")?)?,
        )
    })
}

fn forcing(value: &Value) -> Result<Forcing, MethodError> {
    let file = &TRAJECTORIES;
    let fields = Fields {
        kind: "kind",
        amplitude: "a_p",
        omega: "omega",
        duration: "t_d",
        period: "T_p",
        cycles: Some("n_Tp"),
    };
    if let Some(pulse) = pulse(file, value, &fields)? {
        return Ok(Forcing::Pulse(pulse));
    }
    match file.get(value, "kind")?.as_str() {
        Some("sampled") => Ok(Forcing::Samples {
            dt_s: file.f64(value, "dt")?,
            acceleration_m_s2: samples(value)?,
        }),
        kind => Err(file.lacks(format!("forcing of kind {kind:?}"))),
    }
}

fn samples(value: &Value) -> Result<Vec<f64>, MethodError> {
    let file = &TRAJECTORIES;
    if file.get(value, "acc")?.is_array() {
        let list = file.list(value, "acc")?;
        return list.iter().map(|a| file.number(a)).collect();
    }
    let name = file.get(value, "record")?.as_str().unwrap_or_default();
    record(name).map(|(_, samples)| samples)
}

/// A synthetic record: interval in s and samples in m/s2.
pub(crate) fn record(name: &str) -> Result<(f64, Vec<f64>), MethodError> {
    let records = RECORDS.read()?;
    let record = RECORDS.get(&records, name)?;
    let list = RECORDS.list(record, "acc")?;
    let samples: Result<_, _> =
        list.iter().map(|a| RECORDS.number(a)).collect();
    Ok((RECORDS.f64(record, "dt")?, samples?))
}
