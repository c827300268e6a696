//! In which arithmetic the analyses of a curve were told.

use crate::ida::IdaPoint;
use crate::integrator::Arithmetic;

/// Rough estimate (see [`DOUBTFUL`](crate::integrator::DOUBTFUL)) above which
/// an analysis has its decisions assessed one by one, where fates are
/// certified.
pub(crate) const WORTH_ASSESSING: f64 = 3e-5;

/// How outcome and peak of an analysis were told.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Told {
    /// Which arithmetic assessed every decision, the widest if several did;
    /// none where the rough estimate of the run was enough.
    pub by: Option<Arithmetic>,
    /// False where outcome and peak are not known: the error of the run may
    /// have turned one of its decisions.
    pub resolved: bool,
    /// True where double precision told another fate.
    pub moved: bool,
    /// False where other inputs that round to the same doubles may have
    /// another outcome.
    pub for_inputs: bool,
}

impl Told {
    /// By the rough estimate.
    pub(crate) fn roughly(resolved: bool) -> Self {
        Self { by: None, resolved, moved: false, for_inputs: resolved }
    }
}

/// How many analyses of a curve were told in which arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub struct Certification {
    /// Analyses counted: levels, the refined end, and levels above.
    pub analyses: u64,
    /// Those whose decisions were assessed one by one.
    pub assessed: u64,
    /// Assessed analyses that double precision resolved.
    pub double: u64,
    /// Those that double-double arithmetic resolved.
    pub double_double: u64,
    /// Those that octuple precision resolved.
    pub octuple: u64,
    /// Analyses of which outcome and peak are not known.
    pub unresolved: u64,
    /// Fates that double precision had told wrongly.
    pub moved: u64,
    /// Analyses told for the doubles given, but not for all inputs that
    /// round to them.
    pub only_these_doubles: u64,
}

impl Certification {
    /// Takes an analysis in.
    pub(crate) fn count(&mut self, point: &IdaPoint) {
        let Told { by, resolved, moved, for_inputs } = point.told;
        self.analyses += 1;
        self.assessed += u64::from(by.is_some());
        self.moved += u64::from(moved);
        if !resolved {
            self.unresolved += 1;
            return;
        }
        self.only_these_doubles += u64::from(!for_inputs);
        match by {
            None => {}
            Some(Arithmetic::Double) => self.double += 1,
            Some(Arithmetic::DoubleDouble) => self.double_double += 1,
            Some(Arithmetic::Octuple) => self.octuple += 1,
        }
    }

    /// Adds the counts of another curve.
    pub fn add(&mut self, other: &Self) {
        self.analyses += other.analyses;
        self.assessed += other.assessed;
        self.double += other.double;
        self.double_double += other.double_double;
        self.octuple += other.octuple;
        self.unresolved += other.unresolved;
        self.moved += other.moved;
        self.only_these_doubles += other.only_these_doubles;
    }
}
