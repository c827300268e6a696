//! Single responses, and excitations at a level.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking::accelerogram::Accelerogram;
use rocking::excitation::{NormalisedRecord, Pulse, ScaledRecord};
use rocking::integrator::{
    Assessment, Certify, Observe, Outcome, SceneError, certify,
    uplift_threshold,
};
use rocking::{Excitation, Response, Scene, integrator};

use crate::given::{
    ExcitationInput, Physics, RecordOrPulse, block_of, choose,
};
use crate::ida::table;
use crate::work::{self, refuse};

/// What is scaled to a level.
#[derive(Clone, Copy, PartialEq)]
pub enum By {
    /// PGA/(g tan alpha).
    Im,
    /// PGA in g.
    PgaG,
    /// A factor.
    Scale,
}

pub const BY: [(&str, By); 3] =
    [("im", By::Im), ("pga_g", By::PgaG), ("scale", By::Scale)];

/// An excitation, a record also divided by its peak.
pub enum NormalisedMotion<'a> {
    Record(&'a Accelerogram, NormalisedRecord),
    Pulse(&'a Pulse),
}

impl<'a> NormalisedMotion<'a> {
    pub fn of(ground: &'a RecordOrPulse) -> Self {
        match ground {
            RecordOrPulse::Record(record) => {
                Self::Record(record, NormalisedRecord::new(record))
            }
            RecordOrPulse::Pulse(pulse) => Self::Pulse(pulse),
        }
    }
}

/// An excitation at a level.
pub enum Scaled<'a> {
    Record(ScaledRecord<'a>),
    Pulse(Pulse),
}

impl<'a> Scaled<'a> {
    pub fn of(
        motion: &'a NormalisedMotion<'_>,
        by: By,
        level: f64,
        threshold: f64,
    ) -> Result<Self, String> {
        let is_fit = match by {
            By::Scale => level.is_finite(),
            By::Im | By::PgaG => level > 0.0 && level.is_finite(),
        };
        if !is_fit {
            return Err(match by {
                By::Scale => format!("scale {level}: expected a number"),
                By::Im => format!("im {level}: expected a positive number"),
                By::PgaG => {
                    format!("pga_g {level}: expected a positive number")
                }
            });
        }
        let pga_g = if by == By::Im { level * threshold } else { level };
        Ok(match motion {
            NormalisedMotion::Record(record, _) if by == By::Scale => {
                Self::Record(ScaledRecord::by_factor(record, level))
            }
            NormalisedMotion::Record(_, unit) => {
                if !(unit.pga_g() > 0.0) {
                    let name = unit.name();
                    return Err(format!(
                        "record {name}: all samples are zero and cannot be \
                         scaled"
                    ));
                }
                Self::Record(ScaledRecord::to_pga(unit, pga_g))
            }
            NormalisedMotion::Pulse(pulse) => {
                let scaled = match by {
                    By::Scale => pulse.scaled(level),
                    By::Im | By::PgaG => pulse.with_pga(pga_g),
                };
                Self::Pulse(scaled.map_err(|e| e.to_string())?)
            }
        })
    }

    pub fn excitation(&self) -> Excitation<'_> {
        match self {
            Self::Record(record) => Excitation::Record(*record),
            Self::Pulse(pulse) => Excitation::Pulse(pulse),
        }
    }
}

/// The response of one block, as a dict of the fields of `Response`.
#[pyfunction]
pub fn respond<'py>(
    py: Python<'py>,
    block: (f64, f64),
    excitation: ExcitationInput<'py>,
    physics: Physics,
    by: &str,
    level: f64,
    history_dt: Option<f64>,
    certified: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let block = block_of(block)?;
    let model = physics.model()?;
    let ground = RecordOrPulse::of(excitation)?;
    let threshold = uplift_threshold(&block, model);
    let by = choose("by", by, &BY)?;
    let motion = NormalisedMotion::of(&ground);
    let scaled = Scaled::of(&motion, by, level, threshold).map_err(refuse)?;
    let scene = Scene {
        model,
        overturning: physics.overturning()?,
        ..Scene::new(block, physics.restitution(&block)?, scaled.excitation())
    };
    let observe = Observe {
        events: true,
        accuracy: true,
        history_interval_s: history_dt,
        ..Observe::default()
    };
    let answer = || -> Result<_, SceneError> {
        let response = integrator::respond(&scene, &observe)?;
        let fate = certified
            .then(|| certify(&scene, &Certify::default()))
            .transpose()?;
        Ok((response, fate))
    };
    let (response, fate) = work::alone(py, answer)?.map_err(refuse)?;
    let out = to_python(py, &response)?;
    if let Some(fate) = fate {
        out.set_item("outcome", fate.outcome.name())?;
        out.set_item("peak_ratio", fate.outcome.edp())?;
        out.set_item("resolved", fate.resolved)?;
        out.set_item("fate_margin", fate.margin)?;
        out.set_item("error_estimate", fate.error)?;
        out.set_item("certified_by", fate.by.name())?;
    }
    Ok(out)
}

fn to_python<'py>(
    py: Python<'py>,
    response: &Response,
) -> PyResult<Bound<'py, PyDict>> {
    let out = PyDict::new(py);
    let (time_s, side) = match response.outcome {
        Outcome::Overturned { time_s, side } => {
            (Some(time_s), Some(side.sign()))
        }
        Outcome::NoUplift | Outcome::Rocked { .. } => (None, None),
    };
    out.set_item("outcome", response.outcome.name())?;
    out.set_item("peak_ratio", response.outcome.edp())?;
    let is_clear = response.assessment() == Assessment::Clear;
    out.set_item("resolved", is_clear)?;
    out.set_item("fate_margin", response.fate_margin)?;
    out.set_item("error_estimate", response.error_estimate)?;
    out.set_item("peak_time", response.peak_time_s)?;
    out.set_item("uplift_time", response.uplift_time_s)?;
    out.set_item("rest_time", response.rest_time_s)?;
    out.set_item("overturning_time", time_s)?;
    out.set_item("overturning_side", side)?;
    let impacts = response.impacts.iter();
    let impacts = impacts.flat_map(|i| [i.time_s, i.speed_before_rad_s]);
    let shape = (response.impacts.len(), 2);
    out.set_item("impacts", table(py, shape, impacts.collect())?)?;
    let history = response.history.iter();
    let history =
        history.flat_map(|h| [h.time_s, h.rotation_rad, h.velocity_rad_s]);
    let shape = (response.history.len(), 3);
    out.set_item("history", table(py, shape, history.collect())?)?;
    out.set_item("certified_by", py.None())?;
    Ok(out)
}
