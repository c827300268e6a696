//! Draws of the records, and what a measure gives in them.

use rayon::prelude::*;
use rocking::statistics::Proportion;
use rocking::statistics::bootstrap::{Bootstrap, accelerated, estimate};
use rocking::statistics::resampling::Subsampling;

use rocking_common::findings::{Interval, Tested};
use rocking_common::paper::SuiteKind;

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
    pub(super) rules: [Subsampling; 2],
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

    pub(super) fn size(&self, tested: Tested) -> usize {
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
    pub(super) scheme: Scheme,
    pub(super) points: Vec<f64>,
    pub(super) replicates: Vec<Vec<f64>>,
    pub(super) without_one: Vec<Vec<f64>>,
    pub(super) halves: Vec<Vec<f64>>,
    /// The cells where they are counts; empty otherwise.
    pub(super) counts: Vec<Proportion>,
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

    pub(super) fn column(rows: &[Vec<f64>], k: usize) -> Vec<f64> {
        rows.iter().map(|row| row[k]).collect()
    }

    /// The interval of one cell.
    pub(super) fn interval(
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
