//! What double precision resolves of the analyses of a suite.

use rayon::prelude::*;
use rocking::block::{Block, Restitution};
use rocking::excitation::{Excitation, NormalisedRecord, ScaledRecord};
use rocking::ida::{Analysis, IdaError, curve};
use rocking::integrator::{
    Assessment, Extent, Model, Observe, Outcome, Overturning, Response, Scene,
    SceneError, Solver, respond, respond_precise,
};
use rocking::number::Real;
use rocking::number::double::DoubleDouble;
use rocking::number::octuple::Octuple;

/// Levels below the first overturning that wider arithmetic runs.
const LEVELS_BELOW: usize = 5;

/// Difference of a peak ratio that counts as another peak.
const ANOTHER: f64 = 1e-6;

/// Analyses of a suite in numbers: every 0.01 g level of every block up to
/// the first overturning, Eq. 1.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Survey {
    /// Numbers by [`Count`].
    counts: [usize; COUNTS.len()],
    /// Condition number of the peak of blocks that rocked, in rising order.
    conditions: Vec<f64>,
}

/// What is counted; the place in [`COUNTS`]. *Near* are the first overturning
/// and the last five levels below it, which wider arithmetic runs as well.
#[derive(Clone, Copy)]
pub enum Count {
    Curves,
    Analyses,
    /// Flagged by the curve, by the rough estimate of each run.
    Flagged,
    /// Analyses whose certificate in double precision is not clear.
    Unclear,
    /// Unclear ones that are not flagged.
    Missed,
    /// Missed ones whose fate, or whose peak by more than 1e-6, is another in
    /// wider arithmetic.
    MissedAndWrong,
    Near,
    NearFlagged,
    /// Near ones that octuple precision resolved, the others by double-double.
    NearByOctuple,
    NearUnresolved,
    /// Near ones that have another fate, or another peak, in double precision.
    FatesWrong,
    PeaksWrong,
    /// Wrong ones that are not flagged.
    WrongAndNotFlagged,
}

/// Names of the counts.
const COUNTS: [&str; 13] = [
    "curves",
    "analyses",
    "flagged",
    "unclear",
    "missed",
    "missed_and_wrong",
    "near",
    "near_flagged",
    "near_by_octuple",
    "near_unresolved",
    "fates_wrong",
    "peaks_wrong",
    "wrong_and_not_flagged",
];

/// Shares of the condition numbers that are shown, in thousandths.
const SHARES: [usize; 5] = [500, 900, 990, 999, 1000];

impl Survey {
    pub fn of_count(&self, count: Count) -> usize {
        self.counts[count as usize]
    }

    fn count(&mut self, count: Count, is_one: bool) {
        self.counts[count as usize] += usize::from(is_one);
    }

    fn add(&mut self, other: Self) {
        for (own, more) in self.counts.iter_mut().zip(other.counts) {
            *own += more;
        }
        self.conditions.extend(other.conditions);
    }

    /// Names of what [`Self::row`] gives.
    pub fn header() -> String {
        let shares = SHARES.map(|share| format!(",condition_{share}"));
        COUNTS.join(",") + &shares.concat()
    }

    /// The numbers as a row of a table.
    pub fn row(&self) -> String {
        let counts = self.counts.map(|n| n.to_string()).join(",");
        let at = |share| format!(",{:.1e}", self.condition(share));
        counts + &SHARES.map(at).concat()
    }

    /// Condition number below which this share of the peaks lies, in
    /// thousandths.
    fn condition(&self, thousandths: usize) -> f64 {
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
        let mut out = Self::default();
        out.count(Count::Curves, true);
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
        self.count(Count::Analyses, true);
        self.count(Count::Flagged, flagged);
        self.count(Count::Unclear, unclear);
        if let Outcome::Rocked { .. } = run.outcome {
            self.conditions.extend(run.condition_number);
        }
        let missed = unclear && !flagged;
        self.count(Count::Missed, missed);
        if !(missed || near) {
            return Ok(());
        }
        let solver = Solver { extent: Extent::Peak, ..Solver::default() };
        let quick = solver.respond(scene, &Observe::default())?;
        let truth =
            WideTruth::of(&respond_precise::<DoubleDouble>(scene, &observe)?);
        let (truth, octuple) = match truth {
            None => (
                WideTruth::of(&respond_precise::<Octuple>(scene, &observe)?),
                true,
            ),
            truth => (truth, false),
        };
        let own = WideTruth {
            overturned: quick.outcome.is_overturned(),
            peak_ratio: quick.peak_ratio,
        };
        let fate = truth.is_some_and(|t| t.overturned != own.overturned);
        let peak = truth.is_some_and(|t| {
            let gap = (t.peak_ratio - own.peak_ratio).abs();
            !t.overturned && !own.overturned && !(gap <= ANOTHER)
        });
        let wrong = fate || peak;
        self.count(Count::MissedAndWrong, missed && wrong);
        self.count(Count::Near, near);
        self.count(Count::NearFlagged, near && flagged);
        let by_octuple = octuple && truth.is_some();
        self.count(Count::NearByOctuple, near && by_octuple);
        self.count(Count::NearUnresolved, near && truth.is_none());
        self.count(Count::FatesWrong, near && fate);
        self.count(Count::PeaksWrong, near && peak);
        self.count(Count::WrongAndNotFlagged, near && wrong && !flagged);
        Ok(())
    }
}

/// Fate and peak in wider arithmetic.
#[derive(Clone, Copy)]
struct WideTruth {
    overturned: bool,
    peak_ratio: f64,
}

impl WideTruth {
    /// None where it is not resolved.
    fn of<N: Real>(response: &Response<N>) -> Option<Self> {
        let clear = response.assessment() == Assessment::Clear;
        clear.then(|| Self {
            overturned: response.outcome.is_overturned(),
            peak_ratio: response.peak_ratio.to_f64(),
        })
    }
}
