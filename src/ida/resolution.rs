//! Which arithmetic resolved the analyses of a curve.

use crate::ida::IdaPoint;
use crate::integrator::Arithmetic;

/// Rough estimate (see [`DOUBTFUL`](crate::integrator::DOUBTFUL)) above which
/// the decisions of an analysis are assessed one by one, if the curve is
/// certified.
pub(crate) const WORTH_ASSESSING: f64 = 5e-4;

/// Whether outcome and peak of an analysis are resolved, and by which
/// arithmetic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub struct Resolution {
    /// The widest arithmetic that assessed every decision; `None` if the rough
    /// estimate of the run was enough.
    pub by: Option<Arithmetic>,
    /// False if outcome and peak are not known: the error of the run may have
    /// turned one of its decisions.
    pub resolved: bool,
    /// True if double precision gives another outcome.
    pub wrong_in_double: bool,
    /// False if other inputs that round to the same doubles may have another
    /// outcome.
    pub for_inputs: bool,
}

impl Resolution {
    /// Resolution by the rough estimate.
    pub(crate) fn roughly(resolved: bool) -> Self {
        Self {
            by: None,
            resolved,
            wrong_in_double: false,
            for_inputs: resolved,
        }
    }
}

/// How many analyses of a curve each arithmetic resolved.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
#[non_exhaustive]
pub struct ResolutionCounts {
    /// Analyses counted: levels, the refined end, and levels above.
    pub analyses: u64,
    /// Analyses whose decisions were assessed one by one.
    pub assessed: u64,
    /// Assessed analyses that double precision resolved.
    pub resolved_by_double: u64,
    /// Analyses that double-double arithmetic resolved.
    pub resolved_by_double_double: u64,
    /// Analyses that octuple precision resolved.
    pub resolved_by_octuple: u64,
    /// Analyses whose outcome and peak are not known.
    pub unresolved: u64,
    /// Analyses with another outcome in double precision.
    pub wrong_in_double: u64,
    /// Analyses resolved for the doubles given, but not for all inputs that
    /// round to them.
    pub only_these_doubles: u64,
}

impl ResolutionCounts {
    /// Counts an analysis.
    pub(crate) fn count(&mut self, point: &IdaPoint) {
        let Resolution { by, resolved, wrong_in_double, for_inputs } =
            point.resolution;
        self.analyses += 1;
        self.assessed += u64::from(by.is_some());
        self.wrong_in_double += u64::from(wrong_in_double);
        if !resolved {
            self.unresolved += 1;
            return;
        }
        self.only_these_doubles += u64::from(!for_inputs);
        match by {
            None => {}
            Some(Arithmetic::Double) => self.resolved_by_double += 1,
            Some(Arithmetic::DoubleDouble) => {
                self.resolved_by_double_double += 1;
            }
            Some(Arithmetic::Octuple) => self.resolved_by_octuple += 1,
        }
    }

    /// Adds the counts of another curve.
    pub fn add(&mut self, other: &Self) {
        self.analyses += other.analyses;
        self.assessed += other.assessed;
        self.resolved_by_double += other.resolved_by_double;
        self.resolved_by_double_double += other.resolved_by_double_double;
        self.resolved_by_octuple += other.resolved_by_octuple;
        self.unresolved += other.unresolved;
        self.wrong_in_double += other.wrong_in_double;
        self.only_these_doubles += other.only_these_doubles;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sum_takes_every_count() {
        let counts = |times: u64| ResolutionCounts {
            analyses: times,
            assessed: 2 * times,
            resolved_by_double: 3 * times,
            resolved_by_double_double: 4 * times,
            resolved_by_octuple: 5 * times,
            unresolved: 6 * times,
            wrong_in_double: 7 * times,
            only_these_doubles: 8 * times,
        };
        let mut sum = counts(1);
        sum.add(&counts(10));
        assert_eq!(sum, counts(11));
    }
}
