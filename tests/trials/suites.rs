//! What double precision tells of the analyses of a suite.

use rayon::prelude::*;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, IdaError, curve};
use rocking::integrator::{
    Assessment, Model, Observe, Outcome, Overturning, Response, Scene,
    SceneError, Solver, respond, respond_precise,
};
use rocking::number::Real;
use rocking::number::double::DoubleDouble;
use rocking::number::octuple::Octuple;

/// Levels below the first overturning that wider arithmetic tells.
const LEVELS_BELOW: usize = 5;

/// Difference of a peak ratio that counts as another peak.
const ANOTHER: f64 = 1e-6;

/// Analyses of a suite in numbers: every 0.01 g level of every block up to
/// the first overturning, Eq. 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Survey {
    /// Curves and analyses.
    pub curves: usize,
    /// See `curves`.
    pub analyses: usize,
    /// Analyses that a curve flags, by the rough estimate of each run.
    pub flagged: usize,
    /// Analyses whose certificate in double precision is not clear.
    pub unclear: usize,
    /// Those of them that are not flagged.
    pub missed: usize,
    /// Those of these whose fate, or whose peak by more than 1e-6, is another
    /// in wider arithmetic.
    pub missed_and_wrong: usize,
    /// Condition number of the peak of blocks that rocked, in rising order.
    pub conditions: Vec<f64>,
    /// Analyses near the first overturning (itself and the last five levels
    /// below it) that wider arithmetic resolved.
    pub near: Near,
}

/// Analyses near first overturnings, in wider arithmetic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Near {
    /// All of them.
    pub analyses: usize,
    /// Resolved by octuple precision, the others by double-double; by none.
    pub by_octuple: usize,
    /// See `by_octuple`.
    pub undecided: usize,
    /// Flagged ones; fates and peaks (by more than 1e-6) that are others.
    pub flagged: usize,
    /// See `flagged`.
    pub fates_moved: usize,
    /// See `flagged`.
    pub peaks_moved: usize,
    /// Moved ones that were not flagged.
    pub moved_and_not_flagged: usize,
}

impl Survey {
    fn add(&mut self, other: Self) {
        self.curves += other.curves;
        self.analyses += other.analyses;
        self.flagged += other.flagged;
        self.unclear += other.unclear;
        self.missed += other.missed;
        self.missed_and_wrong += other.missed_and_wrong;
        self.conditions.extend(other.conditions);
        let (near, more) = (&mut self.near, other.near);
        near.analyses += more.analyses;
        near.by_octuple += more.by_octuple;
        near.undecided += more.undecided;
        near.flagged += more.flagged;
        near.fates_moved += more.fates_moved;
        near.peaks_moved += more.peaks_moved;
        near.moved_and_not_flagged += more.moved_and_not_flagged;
    }

    /// Names of what [`Self::row`] gives.
    pub const HEADER: &str = "curves,analyses,flagged,unclear,missed,\
        missed_and_wrong,condition_50,condition_90,condition_99,\
        condition_99_9,condition_largest,near,near_flagged,near_by_octuple,\
        near_undecided,fates_moved,peaks_moved,moved_and_not_flagged";

    /// The numbers as a row of a table.
    #[must_use]
    pub fn row(&self) -> String {
        let near = &self.near;
        let counts = |all: &[usize]| {
            let all: Vec<String> = all.iter().map(usize::to_string).collect();
            all.join(",")
        };
        let conditions = [500, 900, 990, 999, 1000]
            .map(|share| format!("{:.1e}", self.condition(share)));
        let first = [
            self.curves,
            self.analyses,
            self.flagged,
            self.unclear,
            self.missed,
            self.missed_and_wrong,
        ];
        let last = [
            near.analyses,
            near.flagged,
            near.by_octuple,
            near.undecided,
            near.fates_moved,
            near.peaks_moved,
            near.moved_and_not_flagged,
        ];
        let (first, last) = (counts(&first), counts(&last));
        format!("{first},{},{last}", conditions.join(","))
    }

    /// Condition number below which this share of the peaks lies, in
    /// thousandths.
    #[must_use]
    pub fn condition(&self, thousandths: usize) -> f64 {
        let last = self.conditions.len().saturating_sub(1);
        let at = (last * thousandths).div_ceil(1000);
        self.conditions.get(at).copied().unwrap_or(f64::NAN)
    }

    /// Looks at every level of the curves of these blocks and records.
    ///
    /// # Errors
    /// [`IdaError`] for a record of zeros or a scene that is refused.
    pub fn of(
        blocks: &[Block],
        records: &[NormalisedRecord],
        restitution: Restitution,
    ) -> Result<Self, IdaError> {
        let pairs: Vec<(&Block, &NormalisedRecord)> = blocks
            .iter()
            .flat_map(|block| records.iter().map(move |r| (block, r)))
            .collect();
        let all: Vec<Result<Self, IdaError>> = pairs
            .par_iter()
            .with_max_len(1)
            .map(|(block, record)| Self::of_curve(block, record, restitution))
            .collect();
        let mut sum = Self::default();
        for one in all {
            sum.add(one?);
        }
        sum.conditions.sort_by(f64::total_cmp);
        Ok(sum)
    }

    fn of_curve(
        block: &Block,
        record: &NormalisedRecord,
        restitution: Restitution,
    ) -> Result<Self, IdaError> {
        let curve = curve(record, &Analysis::paper(*block, restitution))?;
        let mut out = Self { curves: 1, ..Self::default() };
        let count = curve.points.len();
        for (k, point) in curve.points.iter().enumerate() {
            let record = ScaledRecord::to_pga(record, point.pga_g);
            let scene = Scene {
                block: *block,
                restitution,
                model: Model::Nonlinear,
                overturning: Overturning::Alpha,
                excitation: Excitation::Record(record),
                initial_ratio: 0.0,
            };
            let flagged = !point.resolution.resolved;
            let near =
                curve.overturning.is_some() && k + LEVELS_BELOW >= count - 1;
            out.look(&scene, flagged, near)?;
        }
        Ok(out)
    }

    fn look(
        &mut self,
        scene: &Scene<'_>,
        flagged: bool,
        near: bool,
    ) -> Result<(), SceneError> {
        let observe = Observe { accuracy: true, ..Observe::default() };
        let run = respond(scene, &observe)?;
        let unclear = run.assessment() != Assessment::Clear;
        self.analyses += 1;
        self.flagged += usize::from(flagged);
        self.unclear += usize::from(unclear);
        if let Outcome::Rocked { .. } = run.outcome {
            self.conditions.extend(run.condition_number);
        }
        let missed = unclear && !flagged;
        self.missed += usize::from(missed);
        if !(missed || near) {
            return Ok(());
        }
        let solver = Solver { peak_only: true, ..Solver::default() };
        let quick = solver.respond(scene, &Observe::default())?;
        let truth =
            Truth::of(&respond_precise::<DoubleDouble>(scene, &observe)?);
        let (truth, octuple) = match truth {
            None => (
                Truth::of(&respond_precise::<Octuple>(scene, &observe)?),
                true,
            ),
            truth => (truth, false),
        };
        let own = Truth {
            overturned: quick.outcome.is_overturned(),
            peak_ratio: quick.peak_ratio,
        };
        let fate = truth.is_some_and(|t| t.overturned != own.overturned);
        let peak = truth.is_some_and(|t| {
            let gap = (t.peak_ratio - own.peak_ratio).abs();
            !t.overturned && !own.overturned && !(gap <= ANOTHER)
        });
        self.missed_and_wrong += usize::from(missed && (fate || peak));
        if near {
            let near = &mut self.near;
            near.analyses += 1;
            near.by_octuple += usize::from(octuple && truth.is_some());
            near.undecided += usize::from(truth.is_none());
            near.flagged += usize::from(flagged);
            near.fates_moved += usize::from(fate);
            near.peaks_moved += usize::from(peak);
            let silent = (fate || peak) && !flagged;
            near.moved_and_not_flagged += usize::from(silent);
        }
        Ok(())
    }
}

/// Fate and peak as wider arithmetic tells them.
#[derive(Clone, Copy)]
struct Truth {
    overturned: bool,
    peak_ratio: f64,
}

impl Truth {
    /// None where it does not.
    fn of<N: Real>(response: &Response<N>) -> Option<Self> {
        let clear = response.assessment() == Assessment::Clear;
        clear.then(|| Self {
            overturned: response.outcome.is_overturned(),
            peak_ratio: response.peak_ratio.to_f64(),
        })
    }
}
