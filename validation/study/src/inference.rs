//! Inference of the study: one set of replicates serves all claims.
//!
//! The records are the sample; blocks, stripes, levels, intensity measures
//! and arms are computed from the same records. A replicate takes the same
//! records everywhere and recomputes the whole measure of a claim. The two
//! suites are resampled independently of each other.

mod counted;
mod drawn;
mod needed;

use rayon::prelude::*;
use rocking::statistics::Proportion;
use rocking::statistics::bootstrap::{Bootstrap, accelerated, estimate};
use rocking::statistics::resampling::{
    Subsampling, share_inside, simultaneous,
};

use rocking_common::findings::{
    CellCounts, ClaimResult, Detail, Interval, Measured, Quantifier, Region,
    Tested, Unit,
};
use rocking_common::paper::{Arm, SuiteKind, Verdict};

pub use drawn::by_cell;
use needed::needed;

/// Level of all intervals.
pub const LEVEL: f64 = 0.95;

/// Replicates of the bootstrap.
pub const REPLICATES: usize = 2000;

/// Subsamples without replacement.
pub const SUBSAMPLES: usize = 1000;

/// A cell with fewer records than this decides nothing.
pub const LEAST_DECIDING: usize = 30;

/// How often a replicate holds each record, by suite.
#[derive(Clone, Copy, Debug)]
pub struct Draw<'a> {
    ordinary: &'a [u32],
    pulse: &'a [u32],
}

impl<'a> Draw<'a> {
    /// The multiplicities of a suite's records.
    #[must_use]
    pub fn of(&self, suite: SuiteKind) -> &'a [u32] {
        match suite {
            SuiteKind::Ordinary => self.ordinary,
            SuiteKind::PulseType => self.pulse,
        }
    }
}

/// Sets of draws, one for each suite.
#[derive(Debug)]
struct Set([Vec<Vec<u32>>; 2]);

impl Set {
    fn new(
        sizes: [usize; 2],
        of: impl Fn(usize, SuiteKind) -> Vec<Vec<u32>>,
    ) -> Self {
        let [a, b] = SuiteKind::BOTH;
        Self([of(sizes[0], a), of(sizes[1], b)])
    }

    fn draw(&self, index: usize) -> Draw<'_> {
        Draw { ordinary: &self.0[0][index], pulse: &self.0[1][index] }
    }

    fn map(&self, f: &Measure<'_>) -> Vec<Vec<f64>> {
        (0..self.0[0].len())
            .into_par_iter()
            .map(|index| f(self.draw(index)))
            .collect()
    }
}

/// Cells of a measure in a replicate.
pub type Measure<'a> = dyn Fn(Draw<'_>) -> Vec<f64> + Sync + 'a;

/// The draws that all claims share.
#[derive(Debug)]
pub struct Draws {
    sizes: [usize; 2],
    whole: Set,
    bootstrap: Set,
    subsamples: Set,
    halves: Set,
    without_one: [Set; 2],
    rules: [Subsampling; 2],
}

impl Draws {
    /// The draws for suites of these sizes, ordinary and pulse-type.
    ///
    /// Streams: `study/records/SUITE` (bootstrap), `study/nine-tenths/SUITE`
    /// and `study/halves/SUITE` (subsamples), each of seed 0.
    #[must_use]
    pub fn new(sizes: [usize; 2]) -> Self {
        let ones = |n: usize| vec![1; n];
        let whole = Set::new(sizes, |n, _| vec![ones(n)]);
        let bootstrap = Set::new(sizes, |n, suite| {
            let name = format!("study/records/{suite}");
            let draws = Bootstrap::new(&name, 0, n, REPLICATES);
            (0..REPLICATES as u64).map(|i| draws.multiplicities(i)).collect()
        });
        let nine_tenths = |n: usize, suite: SuiteKind| {
            let name = format!("study/nine-tenths/{suite}");
            Subsampling::new(&name, 0, n, n - n.div_ceil(10))
        };
        let drawn = |rule: &Subsampling, count: usize| {
            (0..count as u64).map(|i| rule.multiplicities(i)).collect()
        };
        let subsamples = Set::new(sizes, |n, suite| {
            drawn(&nine_tenths(n, suite), SUBSAMPLES)
        });
        let halves = Set::new(sizes, |n, suite| {
            let name = format!("study/halves/{suite}");
            drawn(&Subsampling::new(&name, 0, n, n / 2), SUBSAMPLES / 5)
        });
        let without = |place: usize| {
            let n = sizes[place];
            let one = |left_out: usize| {
                let mut counts = ones(n);
                counts[left_out] = 0;
                counts
            };
            let other = vec![ones(sizes[1 - place]); n];
            let own: Vec<Vec<u32>> = (0..n).map(one).collect();
            if place == 0 { Set([own, other]) } else { Set([other, own]) }
        };
        let [a, b] = SuiteKind::BOTH;
        Self {
            sizes,
            whole,
            bootstrap,
            subsamples,
            halves,
            without_one: [without(0), without(1)],
            rules: [nine_tenths(sizes[0], a), nine_tenths(sizes[1], b)],
        }
    }

    /// Every record once.
    #[must_use]
    pub fn whole(&self) -> Draw<'_> {
        self.whole.draw(0)
    }

    fn size(&self, tested: Tested) -> usize {
        match tested {
            Tested::PulseType => self.sizes[1],
            // Of a comparison, the smaller suite bounds what is known.
            Tested::Both => self.sizes[0].min(self.sizes[1]),
            Tested::Ordinary | Tested::None => self.sizes[0],
        }
    }

    /// A smooth measure over the replicates of the bootstrap.
    #[must_use]
    pub fn smooth(&self, tested: Tested, f: &Measure<'_>) -> Replicated {
        let without_one = match tested {
            Tested::Ordinary => self.without_one[0].map(f),
            Tested::PulseType => self.without_one[1].map(f),
            Tested::None | Tested::Both => Vec::new(),
        };
        Replicated {
            scheme: Scheme::Bootstrap,
            points: f(self.whole()),
            replicates: self.bootstrap.map(f),
            without_one,
            halves: Vec::new(),
            counts: Vec::new(),
        }
    }

    /// A measure that ties spoil, over subsamples without replacement.
    #[must_use]
    pub fn subsampled(&self, tested: Tested, f: &Measure<'_>) -> Replicated {
        let own = |place: usize| self.without_one[place].map(f);
        let without_one = match tested {
            Tested::Ordinary => own(0),
            Tested::PulseType => own(1),
            Tested::None => Vec::new(),
            Tested::Both => [own(0), own(1)].concat(),
        };
        Replicated {
            scheme: Scheme::Subsampling,
            points: f(self.whole()),
            replicates: self.subsamples.map(f),
            without_one,
            halves: self.halves.map(f),
            counts: Vec::new(),
        }
    }
}

/// Where the intervals of a measure's cells come from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scheme {
    /// Replicates drawn with replacement.
    Bootstrap,
    /// Replicates drawn without.
    Subsampling,
    /// The cells are counts of records, which have exact intervals: no
    /// replicate is drawn.
    Counted,
}

/// The cells of a measure: of all records, and of every replicate.
#[derive(Clone, Debug)]
pub struct Replicated {
    scheme: Scheme,
    points: Vec<f64>,
    replicates: Vec<Vec<f64>>,
    without_one: Vec<Vec<f64>>,
    halves: Vec<Vec<f64>>,
    /// The cells where they are counts; empty otherwise.
    counts: Vec<Proportion>,
}

impl Replicated {
    /// Other measures made of this one's cells; of counts they have no
    /// interval.
    #[must_use]
    pub fn map(&self, f: impl Fn(&[f64]) -> Vec<f64>) -> Self {
        let all = |rows: &[Vec<f64>]| rows.iter().map(|row| f(row)).collect();
        Self {
            scheme: self.scheme,
            points: f(&self.points),
            replicates: all(&self.replicates),
            without_one: all(&self.without_one),
            halves: all(&self.halves),
            counts: Vec::new(),
        }
    }

    /// A cell of all records.
    #[must_use]
    pub fn point(&self, k: usize) -> f64 {
        self.points[k]
    }

    /// The cells with other values of all records: what the replicates say
    /// of their own values moves along.
    #[must_use]
    pub fn moved_to(mut self, points: &[f64]) -> Self {
        let by: Vec<f64> =
            points.iter().zip(&self.points).map(|(a, b)| a - b).collect();
        let rows =
            [&mut self.replicates, &mut self.without_one, &mut self.halves];
        for row in rows.into_iter().flatten() {
            for (x, by) in row.iter_mut().zip(&by) {
                *x += by;
            }
        }
        self.points = points.to_vec();
        self
    }

    fn column(rows: &[Vec<f64>], k: usize) -> Vec<f64> {
        rows.iter().map(|row| row[k]).collect()
    }

    /// The interval of one cell.
    fn interval(
        &self,
        k: usize,
        rules: &[Subsampling; 2],
        tested: Tested,
        level: f64,
    ) -> Option<(f64, f64, Interval)> {
        let point = self.points[k];
        let values = Self::column(&self.replicates, k);
        let others = Self::column(&self.without_one, k);
        match self.scheme {
            Scheme::Bootstrap => {
                if !others.is_empty()
                    && let Some(e) =
                        accelerated(point, &values, &others, level)
                {
                    return Some((e.low, e.high, Interval::Accelerated));
                }
                let e = estimate(point, &values, level)?;
                Some((e.low, e.high, Interval::Percentile))
            }
            Scheme::Subsampling => {
                let rule = &rules[usize::from(tested == Tested::PulseType)];
                let e = rule.interval(point, &values, &others, level)?;
                Some((e.low, e.high, Interval::Subsampling))
            }
            Scheme::Counted => {
                let (low, high) = self.counts.get(k)?.interval(level).ok()?;
                Some((low, high, Interval::Exact))
            }
        }
    }
}

/// What a claim asks of its cells.
#[derive(Clone, Copy, Debug)]
pub struct Rule {
    /// How many of them.
    pub quantifier: Quantifier,
    /// Where they have to lie.
    pub region: Region,
    /// Unit of a cell.
    pub unit: Unit,
    /// Ends that a value cannot cross: 0 and 1 of a share.
    pub range: (f64, f64),
}

/// A cell's name, and how many records are in it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Cell {
    /// Where it is: `p = 3, alpha = 0.20`.
    pub at: String,
    /// Records whose values are in it.
    pub records: usize,
}

/// The result of a claim on a suite and arm.
#[must_use]
pub fn judge(
    draws: &Draws,
    tested: Tested,
    arm: Option<Arm>,
    rule: &Rule,
    cells: &[Cell],
    measured: &Replicated,
) -> ClaimResult {
    let mut result = ClaimResult {
        suite: tested,
        arm,
        value: f64::NAN,
        low: f64::NAN,
        high: f64::NAN,
        unit: rule.unit,
        by_criterion: None,
        by_equivalence: Some(Verdict::Inconclusive),
        at: String::new(),
        interval: None,
        cells: None,
        deciding_cell: None,
        details: Vec::new(),
        records_needed: None,
    };
    match rule.quantifier {
        Quantifier::One => one(draws, rule, cells, measured, &mut result),
        _ => many(draws, rule, cells, measured, &mut result),
    }
    if result.interval.is_none() {
        // No interval, no verdict.
        result.by_equivalence = None;
    }
    // Exact ends do not shrink by the root of the number of records.
    let scales = measured.scheme != Scheme::Counted;
    if scales && result.by_equivalence == Some(Verdict::Inconclusive) {
        let n = draws.size(tested);
        result.records_needed = needed(n, rule, &result);
    }
    result
}

/// A share of cells with its interval, and on which side of a region it is.
#[must_use]
pub fn share(
    draws: &Draws,
    tested: Tested,
    measured: &Replicated,
    region: Region,
) -> (Measured, Verdict) {
    let value = measured.points[0];
    let Some((low, high, _)) =
        measured.interval(0, &draws.rules, tested, LEVEL)
    else {
        return (Measured::exact(value), Verdict::Inconclusive);
    };
    let (low, high) = (clipped(low, (0.0, 1.0)), clipped(high, (0.0, 1.0)));
    let measured = Measured { value, interval: Some((low, high)) };
    (measured, region.verdict(low, high))
}

fn clipped(x: f64, (low, high): (f64, f64)) -> f64 {
    if x < low {
        low
    } else if x > high {
        high
    } else {
        x
    }
}

fn one(
    draws: &Draws,
    rule: &Rule,
    cells: &[Cell],
    measured: &Replicated,
    result: &mut ClaimResult,
) {
    let (Some(value), Some(cell)) = (measured.points.first(), cells.first())
    else {
        return;
    };
    result.value = *value;
    result.at.clone_from(&cell.at);
    let ends = measured.interval(0, &draws.rules, result.suite, LEVEL);
    if let Some((low, high, interval)) = ends {
        result.low = clipped(low, rule.range);
        result.high = clipped(high, rule.range);
        result.interval = Some(interval);
        result.by_equivalence =
            Some(rule.region.verdict(result.low, result.high));
    }
    if !measured.halves.is_empty() {
        let halves = Replicated::column(&measured.halves, 0);
        let finite: Vec<f64> =
            halves.into_iter().filter(|x| x.is_finite()).collect();
        let sum = finite.iter().fold(0.0, |sum, x| sum + x);
        result.details.push(Detail {
            name: "mean over halves of the records".into(),
            measured: Measured::exact(sum / finite.len() as f64),
        });
    }
}

/// Cells with enough records to decide.
fn deciding(cells: &[Cell], measured: &Replicated) -> Vec<usize> {
    let decides = |k: &usize| {
        cells[*k].records >= LEAST_DECIDING && measured.points[*k].is_finite()
    };
    (0..cells.len()).filter(decides).collect()
}

/// The band that holds all cells of a measure at once.
fn band(
    draws: &Draws,
    tested: Tested,
    range: (f64, f64),
    own: &Replicated,
) -> Vec<(f64, f64)> {
    let band = match own.scheme {
        Scheme::Bootstrap => simultaneous(&own.points, &own.replicates, LEVEL),
        Scheme::Subsampling => {
            // Bonferroni: these cells are few.
            let count = own.points.len();
            let level = 1.0 - (1.0 - LEVEL) / count as f64;
            let ends = |k| own.interval(k, &draws.rules, tested, level);
            (0..count).map(|k| ends(k).map(|e| (e.0, e.1))).collect()
        }
        Scheme::Counted => {
            let band = Proportion::band(&own.counts, LEVEL);
            band.unwrap_or_default().into_iter().map(Some).collect()
        }
    };
    band.into_iter()
        .map(|ends| ends.unwrap_or((f64::NEG_INFINITY, f64::INFINITY)))
        .map(|(a, b)| (clipped(a, range), clipped(b, range)))
        .collect()
}

/// Verdict over many cells, by the band that holds all of them at once: the
/// share of cells in the region lies between the share whose whole interval
/// is inside and the share whose interval is not wholly outside, with the
/// band's probability.
fn many(
    draws: &Draws,
    rule: &Rule,
    cells: &[Cell],
    measured: &Replicated,
    result: &mut ClaimResult,
) {
    let deciding = deciding(cells, measured);
    let own = measured.select(&deciding);
    result.interval = Some(match own.scheme {
        Scheme::Bootstrap => Interval::Simultaneous,
        Scheme::Subsampling => Interval::Subsampling,
        Scheme::Counted => Interval::ExactSimultaneous,
    });
    let band = band(draws, result.suite, rule.range, &own);
    let verdicts: Vec<Verdict> =
        band.iter().map(|(a, b)| rule.region.verdict(*a, *b)).collect();
    let count = |verdict| verdicts.iter().filter(|v| **v == verdict).count();
    let (inside, outside) =
        (count(Verdict::Confirmed), count(Verdict::NotConfirmed));
    result.cells = Some(CellCounts {
        deciding: deciding.len(),
        inside,
        outside,
        too_few: cells.len() - deciding.len(),
    });
    if deciding.is_empty() {
        result.interval = None;
        result.at = format!("no cell has {LEAST_DECIDING} records or more");
        return;
    }
    // The cell that decides: the worst among those that bear the verdict.
    let verdict_of_all = if outside > 0 {
        Verdict::NotConfirmed
    } else if inside == deciding.len() {
        Verdict::Confirmed
    } else {
        Verdict::Inconclusive
    };
    let reach = |k: usize| {
        let (a, b) = band[k];
        let (a, b) = (rule.region.badness(a), rule.region.badness(b));
        if a > b { a } else { b }
    };
    let worst = (0..deciding.len())
        .filter(|k| verdicts[*k] == verdict_of_all)
        .max_by(|a, b| {
            // A cell without an interval has no reach to be compared.
            let known = |k: usize| (reach(k).is_finite(), reach(k));
            let ((a, of_a), (b, of_b)) = (known(*a), known(*b));
            a.cmp(&b).then(of_a.total_cmp(&of_b))
        })
        .unwrap_or(0);
    let total = deciding.len() as f64;
    if rule.quantifier == Quantifier::All {
        result.value = own.points[worst];
        (result.low, result.high) = band[worst];
        result.at.clone_from(&cells[deciding[worst]].at);
        result.by_equivalence = Some(verdict_of_all);
    } else {
        let holding =
            own.points.iter().filter(|x| rule.region.holds(**x)).count();
        result.value = holding as f64 / total;
        let known: Vec<_> = band.iter().copied().map(Some).collect();
        let is = |verdict| {
            move |low, high| rule.region.verdict(low, high) == verdict
        };
        (result.low, result.high) = share_inside(
            &known,
            is(Verdict::Confirmed),
            is(Verdict::NotConfirmed),
        );
        result.unit = Unit::Share;
        result.at = "share of the cells".into();
        let region = match rule.quantifier {
            Quantifier::Most => Region::Above(0.5),
            _ => Region::Within(0.9, 1.0),
        };
        result.by_equivalence = Some(region.verdict(result.low, result.high));
        result.deciding_cell = Some(Detail {
            name: cells[deciding[worst]].at.clone(),
            measured: Measured {
                value: own.points[worst],
                interval: Some(band[worst]),
            },
        });
    }
    if let Region::Within(a, b) = rule.region {
        let middle = 0.5 * (a + b);
        details(&own, middle, result);
    }
}

/// The middle and the 90 % value over the cells of the distance from the
/// region's middle, with percentile intervals.
fn details(own: &Replicated, middle: f64, result: &mut ClaimResult) {
    for (name, share) in [("median", 0.5), ("90 %", 0.9)] {
        let over = |row: &[f64]| {
            let mut away: Vec<f64> = row
                .iter()
                .map(|x| (x - middle).abs())
                .filter(|x| x.is_finite())
                .collect();
            away.sort_by(f64::total_cmp);
            let place = (share * away.len() as f64).ceil() as usize;
            away.get(place.saturating_sub(1)).copied().unwrap_or(f64::NAN)
        };
        let values: Vec<f64> =
            own.replicates.iter().map(|row| over(row)).collect();
        let point = over(&own.points);
        let interval =
            estimate(point, &values, LEVEL).map(|e| (e.low, e.high));
        result.details.push(Detail {
            name: format!(
                "{name} over the cells of the distance from {middle}"
            ),
            measured: Measured { value: point, interval },
        });
    }
}

#[cfg(test)]
mod tests;
