//! The decisions of a run, and how clear they are.
//!
//! A run under impacts takes discrete decisions: the block lifts or not, it
//! meets its base or misses it, its impacts end in rest or not, it reaches
//! overturning or turns before. Rounding moves the state by a tracked error.
//! If that error could turn a decision, nothing after it is known. A
//! certificate keeps, for each kind of decision, the least ratio of a
//! decision's margin to the error of that margin.

use crate::names::named;

/// Ratio of margin to error from which on a decision is clear.
///
/// Errors are bounds of 32 standard deviations, propagated linearly. The ratio
/// leaves room for the terms that the linear propagation omits. It was
/// measured on random scenes: see the reference cases of the certificate.
pub const CLEARANCE: f64 = 4.0;

/// Error of the rotation, over the slenderness angle, above which its linear
/// propagation is not trusted.
pub const LARGEST_ERROR: f64 = 0.01;

named! {
    /// A kind of discrete decision of a run.
    #[derive(PartialOrd, Ord)]
    pub enum Decision: "decision" {
        /// A block at rest lifts, or stays: the ground acceleration against
        /// the uplift threshold.
        Uplift = "uplift",
        /// The block meets its base, or turns just above it: the speed of the
        /// impact, or the lowest rotation without one.
        Contact = "contact",
        /// The impacts that a run counts as a rest end in one: the time left
        /// for it.
        Rest = "rest",
        /// The block reaches the rotation of overturning, or turns before it.
        Overturning = "overturning",
        /// Observation ends before or after the first uplift, before or after
        /// an overturning: the time between, or the rotation left to
        /// overturning.
        End = "end",
        /// The error is small enough for its linear propagation.
        Propagation = "propagation",
    }
}

/// The least clear decision of a kind.
#[derive(Clone, Copy, Debug, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct Clearance {
    /// Kind of the decision.
    pub decision: Decision,
    /// Margin over the error of the margin; infinite if there was no such
    /// decision or no error.
    pub ratio: f64,
    /// Time of the decision, s.
    pub time_s: f64,
}

impl Clearance {
    /// True if the error cannot turn the decision. NaN is not clear.
    pub fn is_clear(&self) -> bool {
        self.ratio >= CLEARANCE
    }
}

/// The least clear decision of every kind on which outcome and peak of a run
/// rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Certificate {
    least: [Clearance; Decision::ALL.len()],
}

/// Clarity, the ratio from which a decision is clear, the least clear
/// decision, and the least clear one of each kind.
#[cfg(feature = "serde")]
impl serde::Serialize for Certificate {
    fn serialize<S: serde::Serializer>(
        &self,
        to: S,
    ) -> Result<S::Ok, S::Error> {
        use serde::ser::SerializeStruct as _;
        let mut fields = to.serialize_struct("Certificate", 4)?;
        fields.serialize_field("clear", &self.is_clear())?;
        fields.serialize_field("clear_from_ratio", &CLEARANCE)?;
        fields.serialize_field("least", &self.least())?;
        fields.serialize_field("decisions", &self.least)?;
        fields.end()
    }
}

impl Default for Certificate {
    fn default() -> Self {
        let least = Decision::ALL.map(|decision| Clearance {
            decision,
            ratio: f64::INFINITY,
            time_s: 0.0,
        });
        Self { least }
    }
}

impl Certificate {
    /// The least clear decision of a kind.
    pub fn of(&self, decision: Decision) -> Clearance {
        self.least[decision as usize]
    }

    /// The least clear decision of all.
    pub fn least(&self) -> Clearance {
        let [first, rest @ ..] = self.least;
        rest.into_iter().fold(first, |least, next| {
            // A ratio that is not a number is less than every other.
            if least.ratio.is_nan() || next.ratio >= least.ratio {
                least
            } else {
                next
            }
        })
    }

    /// True if the error can turn no decision.
    pub fn is_clear(&self) -> bool {
        self.least.iter().all(Clearance::is_clear)
    }

    /// Notes a decision.
    pub(crate) fn note(
        &mut self,
        decision: Decision,
        ratio: f64,
        time_s: f64,
    ) {
        let least = &mut self.least[decision as usize];
        if !(ratio >= least.ratio) && !least.ratio.is_nan() {
            *least = Clearance { decision, ratio, time_s };
        }
    }
}
