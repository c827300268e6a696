//! Single responses, and excitations at a level.

use pyo3::prelude::*;
use pyo3::types::PyDict;
use rocking::accelerogram::Accelerogram;
use rocking::excitation::{NormalisedRecord, Pulse, ScaledRecord};
use rocking::integrator::{
    Assessment, Certify, Observe, Outcome, SceneError, certify,
    uplift_threshold,
};
use rocking::{Excitation, Scene, integrator};

use crate::given::{
    ExcitationInput, Physics, RecordOrPulse, block_of, choose,
};
use crate::ida::table;
use crate::work::{self, refuse};

/// The quantity that is scaled to a level.
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
        let (name, least, number) = match by {
            By::Scale => ("scale", f64::NEG_INFINITY, "a number"),
            By::Im => ("im", 0.0, "a positive number"),
            By::PgaG => ("pga_g", 0.0, "a positive number"),
        };
        if !(level > least && level.is_finite()) {
            return Err(format!("{name} {level}: expected {number}"));
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
    let out = PyDict::new(py);
    let (outcome, resolved, margin, error) = match &fate {
        Some(fate) => (fate.outcome, fate.resolved, fate.margin, fate.error),
        None => (
            response.outcome,
            response.assessment() == Assessment::Clear,
            response.fate_margin,
            response.error_estimate,
        ),
    };
    let (time_s, side) = match response.outcome {
        Outcome::Overturned { time_s, side } => {
            (Some(time_s), Some(side.sign()))
        }
        Outcome::NoUplift | Outcome::Rocked { .. } => (None, None),
    };
    out.set_item("outcome", outcome.name())?;
    out.set_item("peak_ratio", outcome.edp())?;
    out.set_item("resolved", resolved)?;
    out.set_item("fate_margin", margin)?;
    out.set_item("error_estimate", error)?;
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
    out.set_item("certified_by", fate.map(|fate| fate.by.name()))?;
    Ok(out)
}
