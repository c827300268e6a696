//! What is known of an object without its answer, and its state.

use std::fmt;

use libm::{hypot, sin};

use super::{AssessError, Damage, Object};
use crate::ProcedureError;
use rocking::block::{BlockError, Restitution};
use rocking::integrator::{Model, uplift_threshold};
use rocking::names::{as_text, named};

/// Sizes in m between which objects are plausible.
const SIZES_M: (f64, f64) = (0.005, 15.0);

/// Difference from Housner's coefficient of restitution from which on there is
/// a remark.
const FAR: f64 = 0.1;

named! {
    /// Whether an object has an answer.
    pub enum ObjectState: "state of an object" {
        /// It has a rank.
        Ranked = "ranked",
        /// It has a rank, and at least one remark.
        Remarked = "remarked",
        /// It slides before it rocks, and has no rank.
        NotRocking = "not rocking",
    }
}

/// A doubt about the input or the answer of an object.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum ObjectRemark {
    /// A width or height in m that may be in another unit.
    Size(f64),
    /// A coefficient of restitution far from Housner's.
    Restitution {
        /// The coefficient.
        eta: f64,
        /// Housner's, 0 where his formula is not positive.
        housner: f64,
    },
    /// Damage is rarer than the hazard curve tells: once in more than this
    /// number of years.
    BeyondHazard(f64),
}

impl fmt::Display for ObjectRemark {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Size(size_m) => {
                let (least, most) = SIZES_M;
                let size_m = (1e4 * size_m).round() / 1e4;
                write!(
                    f,
                    "a size of {size_m} m is not between {least} and {most} \
                     m: check the unit"
                )
            }
            Self::Restitution { eta, housner } => write!(
                f,
                "coefficient of restitution {eta}: Housner's formula gives \
                 {housner:.2} for this slenderness"
            ),
            Self::BeyondHazard(years) => write!(
                f,
                "rarer than 1 in {years:.0} years, the last point of the \
                 hazard curve"
            ),
        }
    }
}

as_text!(write ObjectRemark);

/// What is known of an object without its answer.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct ObjectFacts {
    /// The object.
    pub object: Object,
    /// What counts as damage.
    pub damage: Damage,
    /// Width in m.
    pub width_m: f64,
    /// Height in m.
    pub height_m: f64,
    /// Peak acceleration in g, of the ground or of its floor, at which the
    /// object begins to rock.
    pub uplift_pga_g: f64,
    /// How far its top leans out in m, beyond the edge of its base, at the
    /// rotation that counts as damage.
    pub lean_m: f64,
    /// Labels of the objects on the same floor that it can reach if it falls;
    /// empty if no position is known.
    pub falls_on: Vec<String>,
    /// Doubts about the object.
    pub remarks: Vec<ObjectRemark>,
}

impl ObjectFacts {
    pub(super) fn refused(&self, source: ProcedureError) -> AssessError {
        AssessError::Fit { id: self.object.id.clone(), source }
    }

    pub(super) fn of(
        object: &Object,
        all: &[Object],
        gravity_m_s2: f64,
    ) -> Result<Self, BlockError> {
        let block = &object.block;
        let size = block.dimensions(gravity_m_s2)?;
        let (width_m, height_m) = (size.width_m, size.height_m);
        let limit = object.limit_ratio;
        let angle = limit.unwrap_or(1.0) * block.slenderness_rad();
        let mut remarks = Vec::new();
        for size_m in [width_m, height_m] {
            if !(SIZES_M.0..=SIZES_M.1).contains(&size_m) {
                remarks.push(ObjectRemark::Size(size_m));
            }
        }
        let eta = object.restitution.velocity_ratio();
        let housner = Restitution::housner(block);
        let housner = housner.map_or(0.0, |own| own.velocity_ratio());
        if !((eta - housner).abs() <= FAR) {
            remarks.push(ObjectRemark::Restitution { eta, housner });
        }
        let mut falls_on = Vec::new();
        for other in all {
            let size = other.block.dimensions(gravity_m_s2)?;
            let apart = || {
                let (a, b) = (object.position_m?, other.position_m?);
                Some(hypot(a.0 - b.0, a.1 - b.1) - 0.5 * size.width_m)
            };
            let reach_m = 0.5 * width_m + height_m;
            if other.label != object.label
                && other.floor == object.floor
                && apart().is_some_and(|apart_m| apart_m <= reach_m)
            {
                falls_on.push(other.label.clone());
            }
        }
        Ok(Self {
            object: object.clone(),
            damage: limit.map_or(Damage::Overturning, Damage::Rotation),
            width_m,
            height_m,
            uplift_pga_g: uplift_threshold(block, Model::Nonlinear),
            lean_m: height_m * sin(angle),
            falls_on,
            remarks,
        })
    }
}

/// An object that slides before it rocks: its fragility does not apply.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub struct SlidingObject {
    /// What is known of it.
    pub facts: ObjectFacts,
    /// Share of records that need more friction than there is before they
    /// damage the object.
    pub share: f64,
    /// The friction with which it slides first under no more than the
    /// permitted share of the records; infinite if no friction is enough.
    pub needed_friction: f64,
}
