//! Intervals of the cells of a measure at any level, and how far other draws
//! would move their ends.

use rayon::prelude::*;
use rocking_statistics::boxplot::median_interval;
use rocking_statistics::confidence::Confidence;
use rocking_statistics::{
    Clusters, Estimate, ExtendedSample, Interval, Range, power,
};

use super::draws::{
    LEAST_DECIDING, REPLICATES, Replicates, Resamples, Scheme,
};
use rocking_common::findings::{
    DecisionPower, ERROR, IntervalMethod, LEVEL, Region, SuiteSet,
};
use rocking_common::paper::ClaimVerdict;
use rocking_statistics::resampling::Subsampling;

/// An interval as its method gives it; the standard error of each end over
/// sets of draws; the range of the quantity, which limits the ends.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ends {
    pub(super) interval: Interval,
    pub(super) errors: (f64, f64),
    pub(super) range: Range,
    pub(super) way: IntervalMethod,
}

impl Ends {
    /// The ends, each moved outwards by `by` times its error.
    fn moved(&self, by: f64) -> (f64, f64) {
        // Not moved by no error: an error may be infinite.
        let away = |error: f64| if by == 0.0 { 0.0 } else { by * error };
        let low = self.interval.low() - away(self.errors.0);
        let high = self.interval.high() + away(self.errors.1);
        (self.range.nearest(low), self.range.nearest(high))
    }

    /// The interval within the range of the quantity.
    pub(super) fn within(&self) -> Interval {
        self.interval.within(self.range)
    }

    /// A value beside this interval, corrected for bias or reflected; without
    /// it where the quantity cannot take the value.
    pub(super) fn beside(&self, value: f64) -> Estimate {
        Estimate::beside(value, self.within(), self.range)
            .unwrap_or(Estimate::exact(value))
    }

    /// On which side of a region the interval lies, wherever other draws put
    /// its ends, or would put them in all likelihood.
    pub(super) fn verdict(
        &self,
        region: Region,
        caution: f64,
    ) -> ClaimVerdict {
        let (low, high) = self.moved(caution);
        region.verdict(low, high)
    }

    /// Error of the end that is nearest to one of the region's.
    pub(super) fn deciding_error(&self, region: Region) -> f64 {
        let (low, high) = self.within().ends();
        let away = |x: f64| (x - region.nearest_end(x)).abs();
        let error =
            if away(low) < away(high) { self.errors.0 } else { self.errors.1 };
        if error.is_finite() { error } else { f64::NAN }
    }
}

/// By how many errors of the draws the ends of a verdict are moved outwards:
/// what is decided then stays so with other draws. A negative number moves
/// them inwards, to what other draws may decide.
pub(super) const CAUTION: f64 = 4.0;

/// The cells of a measure with everything that their intervals need.
pub(super) struct CellIntervals<'a> {
    pub(super) measured: &'a Replicates,
    pub(super) clusters: &'a Clusters,
    rule: &'a Subsampling,
    pub(super) range: Range,
    /// Intervals of a bootstrap, one for each cell; empty otherwise.
    confidence: Vec<Option<Confidence>>,
}

impl<'a> CellIntervals<'a> {
    pub(super) fn new(
        draws: &'a Resamples,
        tested: SuiteSet,
        range: Range,
        measured: &'a Replicates,
    ) -> Self {
        let of = |k: usize| {
            let values = Replicates::column(&measured.replicates, k);
            // What no replicate moves is not certain: no error is known.
            if values.iter().all(|x| *x == measured.points[k]) {
                return None;
            }
            let others = Replicates::column(&measured.without_one, k);
            Confidence::new(measured.points[k], &values, &others)
        };
        let confidence = match measured.scheme {
            Scheme::Bootstrap => {
                (0..measured.points.len()).into_par_iter().map(of).collect()
            }
            _ => Vec::new(),
        };
        Self {
            measured,
            clusters: draws.clusters(tested),
            rule: draws.rule(tested),
            range,
            confidence,
        }
    }

    /// The interval of a cell by the replicates, at a level.
    pub(super) fn drawn(&self, k: usize, level: f64) -> Option<Ends> {
        let (interval, errors, way) = match self.measured.scheme {
            Scheme::Bootstrap => {
                let own = self.confidence.get(k)?.as_ref()?;
                let ends = own.interval(self.clusters.half_width(level))?;
                let way = match own.is_accelerated() {
                    true => IntervalMethod::Accelerated,
                    false => IntervalMethod::Percentile,
                };
                let errors = (ends.low_error, ends.high_error);
                (ends.interval, errors, way)
            }
            Scheme::Subsampling => {
                let point = self.measured.points[k];
                let column = |rows| Replicates::column(rows, k);
                let values = column(&self.measured.replicates);
                let others = column(&self.measured.without_one);
                let of = |others: &[f64]| {
                    let found =
                        self.rule.interval(point, &values, others, level);
                    found?.estimate.interval()
                };
                let (found, plain) = (of(&others)?, of(&[])?);
                let own = Confidence::new(point, &values, &[])?;
                let z = Clusters::singletons(0).half_width(level);
                let ends = own.interval(z)?;
                let width = |of: Interval| of.high() - of.low();
                let scale = width(plain) / width(ends.interval);
                // What one earthquake carries moves with no draw.
                let error = |moves: bool, error: f64| match moves {
                    true if scale.is_finite() => scale * error,
                    _ => 0.0,
                };
                let errors = (
                    error(found.low() == plain.low(), ends.high_error),
                    error(found.high() == plain.high(), ends.low_error),
                );
                (found, errors, IntervalMethod::Subsampling)
            }
            Scheme::Counted => {
                let count = self.measured.counts.get(k)?;
                let interval = count.interval(level).ok()?;
                (interval, (0.0, 0.0), IntervalMethod::Exact)
            }
        };
        Some(Ends { interval, errors, range: self.range, way })
    }

    /// The interval of a cell of few records: exact, of the order statistics
    /// of a median; its unit is the record.
    fn exact(&self, k: usize, level: f64) -> Option<Ends> {
        let ranked = self.measured.samples.get(k)?;
        let values: Vec<f64> = ranked.each().map(|(x, _)| x).collect();
        let sample = ExtendedSample::try_new(&values).ok()?;
        let interval = median_interval(&sample, level)?.interval;
        let (low, high) = interval.ends();
        (low.is_finite() && high.is_finite()).then_some(Ends {
            interval,
            errors: (0.0, 0.0),
            range: self.range,
            way: IntervalMethod::Exact,
        })
    }

    /// The interval by which a cell with this number of records is judged.
    pub(super) fn cell(
        &self,
        k: usize,
        records: usize,
        level: f64,
    ) -> Option<Ends> {
        match self.are_few(records) {
            true => self.exact(k, level),
            false => self.drawn(k, level),
        }
    }

    /// Whether this number of records is too small for replicates.
    pub(super) fn are_few(&self, records: usize) -> bool {
        let drawn = self.measured.scheme != Scheme::Counted;
        drawn && records < LEAST_DECIDING
    }

    /// What a suite like this one is able to decide where the truth is the
    /// value of a cell, whose interval it is; none without replicates.
    pub(super) fn power(
        &self,
        k: usize,
        ends: &Ends,
        level: f64,
        region: Region,
    ) -> Option<DecisionPower> {
        let column = Replicates::column(&self.measured.replicates, k);
        let point = self.measured.points[k];
        if self.measured.scheme == Scheme::Counted {
            let decides = decides(point, region, self.range);
            let count = *self.measured.counts.get(k)?;
            let found = power::Power::of_count(count, level, decides);
            return Some(stored(&found));
        }
        let deviations = match self.measured.scheme {
            Scheme::Subsampling => self.rule.deviations(&column),
            _ => self.clusters.deviations(point, &column),
        };
        let student = match ends.way {
            // Its unit is the record.
            IntervalMethod::Exact => 1.0,
            _ => self.clusters.student_over_normal(LEVEL),
        };
        power_of(point, ends, student, &deviations, region)
    }

    /// A cell with its interval.
    pub(super) fn shown(&self, k: usize, ends: Option<Ends>) -> Estimate {
        let value = self.measured.points[k];
        ends.map_or(Estimate::exact(value), |ends| ends.beside(value))
    }
}

/// What such a suite is able to decide where the truth is `point`, by the
/// deviations of suites from it.
pub(super) fn power_of(
    point: f64,
    ends: &Ends,
    student: f64,
    deviations: &[f64],
    region: Region,
) -> Option<DecisionPower> {
    let decides = decides(point, region, ends.range);
    let (low, high) = ends.interval.ends();
    let found = power::Power::of_measure(
        (point, low, high),
        student,
        deviations,
        decides,
    );
    (!deviations.is_empty()).then(|| stored(&found))
}

/// Whether an interval lies on the side of the limit where `point` lies.
fn decides(
    point: f64,
    region: Region,
    range: Range,
) -> impl Fn(f64, f64) -> bool {
    let wanted = region.verdict(point, point);
    move |low, high| {
        region.verdict(range.nearest(low), range.nearest(high)) == wanted
    }
}

fn stored(found: &power::Power) -> DecisionPower {
    DecisionPower { probability: found.probability, times: found.times }
}

/// The p-value of a verdict by the interval of one value, given at any level:
/// the smaller of the two sides' where nothing is decided, with the ends
/// moved by `caution`.
pub(super) fn p_of(
    ends: impl Fn(f64) -> Option<Ends>,
    region: Region,
    verdict: ClaimVerdict,
) -> f64 {
    let side =
        |wanted, caution| p_value(&ends, region, wanted, ERROR, caution);
    match verdict {
        ClaimVerdict::Inconclusive => {
            let inside = side(ClaimVerdict::Confirmed, CAUTION);
            let outside = side(ClaimVerdict::NotConfirmed, CAUTION);
            if inside < outside { inside } else { outside }
        }
        decided => side(decided, 0.0),
    }
}

/// The least one-sided error at which an interval lies on one side of a
/// region: by bisection on that side of `error` where it lies, 1 where the
/// value itself does not.
pub(super) fn p_value(
    ends: impl Fn(f64) -> Option<Ends>,
    region: Region,
    wanted: ClaimVerdict,
    error: f64,
    caution: f64,
) -> f64 {
    let lies = |p: f64| {
        let ends = ends(1.0 - 2.0 * p);
        ends.is_some_and(|e| e.verdict(region, caution) == wanted)
    };
    // Of one value what 2000 draws cannot distinguish from 0, and next to no
    // width at all.
    let least = error / ERROR * 0.5 / REPLICATES as f64;
    let most = 0.499;
    let (mut no, mut yes) =
        if lies(error) { (least, error) } else { (error, most) };
    if lies(no) {
        return no;
    }
    if !lies(yes) {
        return 1.0;
    }
    for _ in 0..14 {
        let middle = (no * yes).sqrt();
        if lies(middle) { yes = middle } else { no = middle }
    }
    yes
}

/// Each cell of a measure with the interval by which a claim on it is judged.
#[must_use]
pub fn by_cell(
    draws: &Resamples,
    tested: SuiteSet,
    range: Range,
    measured: &Replicates,
) -> Vec<Estimate> {
    let known = CellIntervals::new(draws, tested, range, measured);
    let count = measured.points.len();
    (0..count).map(|k| known.shown(k, known.drawn(k, LEVEL))).collect()
}
