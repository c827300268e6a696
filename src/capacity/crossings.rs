//! All crossings of a level, and the single capacities made of them.

use super::{CapacityError, ResponseCurve};
use crate::names::named;

/// An intensity that reaches a level, or a lower bound if none does.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Capacity {
    /// The intensity.
    Reached(f64),
    /// The level was not reached up to the last intensity run.
    Censored {
        /// The capacity lies above this: the last intensity run, or by
        /// [`InversionRule::Monotone`] the length below the level up to it.
        above: f64,
    },
}

impl Capacity {
    /// The intensity, plus infinity if censored.
    pub fn im(self) -> f64 {
        match self {
            Self::Reached(im) => im,
            Self::Censored { .. } => f64::INFINITY,
        }
    }
}

named! {
    /// Which single capacity is made of several crossings.
    #[non_exhaustive]
    pub enum InversionRule: "inversion rule" {
        /// The median crossing, the paper's "median point along the vertical".
        /// The count is odd, so it is a point of the curve; of three it is the
        /// descending one, so it can fall as the level rises.
        Median = "median",
        /// The first crossing.
        First = "first",
        /// The last crossing.
        Last = "last",
        /// c1 - c2 + c3 - .., the length of intensity below the level: never
        /// falls as the level rises, and averages to the area above the stripe
        /// fragility.
        Monotone = "monotone",
    }
}

/// All intensities at which a curve crosses a level, in ascending order.
///
/// A vertex exceeds the level if its EDP is at least the level (closed).
/// Overturning exceeds every level; a record that stands below the level at
/// the end and never overturned crosses at infinity. So the count is odd.
#[derive(Clone, Debug, PartialEq)]
pub struct Crossings {
    crossings: Vec<f64>,
    last_im: f64,
}

impl Crossings {
    /// The crossings, ascending; an infinite last one is censored.
    pub fn all(&self) -> &[f64] {
        &self.crossings
    }

    /// The capacity by a rule.
    pub fn capacity(&self, rule: InversionRule) -> Capacity {
        let c = &self.crossings;
        let im = match rule {
            InversionRule::Median => c[c.len() / 2],
            InversionRule::First => c[0],
            InversionRule::Last => c[c.len() - 1],
            InversionRule::Monotone => {
                // Each pair adds a length, so nothing cancels.
                let pairs = c[1..].as_chunks::<2>().0;
                pairs.iter().fold(c[0], |sum, [down, up]| sum + (up - down))
            }
        };
        if im.is_finite() {
            return Capacity::Reached(im);
        }
        let above = match rule {
            InversionRule::Monotone => {
                let pairs = c[..c.len() - 1].as_chunks::<2>().0;
                pairs
                    .iter()
                    .fold(self.last_im, |sum, [up, down]| sum - (down - up))
            }
            _ => self.last_im,
        };
        Capacity::Censored { above }
    }
}

impl ResponseCurve {
    /// All crossings of an EDP level; only the first overturning crosses an
    /// infinite level.
    ///
    /// # Errors
    /// [`CapacityError::Level`] unless the level is positive.
    pub fn crossings(&self, level: f64) -> Result<Crossings, CapacityError> {
        if !(level > 0.0) {
            return Err(CapacityError::Level(level));
        }
        let mut crossings = Vec::new();
        for pair in self.vertices.windows(2) {
            let [(a, edp_a), (b, edp_b)] = [pair[0], pair[1]];
            if (edp_a >= level) != (edp_b >= level) {
                // A vertex on the level is its crossing, unrounded.
                crossings.push(if level == edp_a {
                    a
                } else if level == edp_b {
                    b
                } else {
                    let share = (level - edp_a) / (edp_b - edp_a);
                    f64::mul_add(share, b - a, a)
                });
            }
        }
        if crossings.len() % 2 == 0 {
            crossings.push(self.overturning_im.unwrap_or(f64::INFINITY));
        }
        Ok(Crossings { crossings, last_im: self.last_im() })
    }

    /// The capacity at an EDP level, infinite for overturning, by a rule.
    ///
    /// # Errors
    /// [`CapacityError::Level`] unless the level is positive.
    pub fn capacity(
        &self,
        level: f64,
        rule: InversionRule,
    ) -> Result<Capacity, CapacityError> {
        Ok(self.crossings(level)?.capacity(rule))
    }
}
