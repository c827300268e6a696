//! D of several samples at once, for simulations.
//!
//! Eight samples lie in lanes. D needs no sorted sample (Gonzalez, Sahni and
//! Franta, ACM Trans. Math. Software 3 (1977) 60): of the values whose Phi
//! lies in a bin of width 1/n, only the smallest and the largest can be
//! furthest from the steps of the empirical distribution. Phi comes from a
//! table of cubics. A lane has the bits that its sample has in any other
//! lane, at every level of instructions.

use std::sync::LazyLock;

use crate::normal;
use rocking::number::dispatch::{Isa, Kernel, WithSimd};
use rocking::number::lanes::{Lanes, Mask, Simd, WIDTH};

/// Samples at once.
pub(crate) const LANES: usize = WIDTH;

/// A number of each sample.
type Each = [f64; LANES];

/// Working space of [`LANES`] replicates.
pub(crate) struct Scratch {
    /// The values of a sample, to be filled in.
    pub values: Vec<f64>,
    /// Row i has the values i of all samples.
    rows: Vec<Lanes>,
    /// Bin k holds Phi in [k/n, (k + 1)/n); the last one holds Phi = 1.
    bins: Vec<Bin>,
}

/// What D needs of the values of each sample in a bin.
#[derive(Clone, Copy)]
struct Bin {
    count: Lanes,
    lowest: Lanes,
    highest: Lanes,
}

impl Bin {
    const EMPTY: Self = Self {
        count: Lanes::splat(0.0),
        lowest: Lanes::splat(f64::INFINITY),
        highest: Lanes::splat(f64::NEG_INFINITY),
    };
}

impl Scratch {
    /// Space for samples of n values.
    pub fn new(n: usize) -> Self {
        Self {
            values: vec![0.0; n],
            rows: vec![Lanes::splat(0.0); n],
            bins: vec![Bin::EMPTY; n + 1],
        }
    }

    /// Puts the values into a lane.
    pub fn put(&mut self, lane: usize) {
        for (row, value) in self.rows.iter_mut().zip(&self.values) {
            row.0[lane] = *value;
        }
    }

    /// D of the samples in all lanes, whose values may be in any order. What
    /// was put is lost.
    pub fn statistics(&mut self) -> Each {
        let isa = Isa::best();
        let Self { rows, bins, .. } = self;
        let [means, scales] = isa.run(Moments(rows));
        let [means, scales] = [means, scales].map(Lanes);
        isa.run_wide(Distances { rows, bins, means, scales }).unwrap_or_else(
            || Distances { rows, bins, means, scales }.run::<Lanes>(),
        )
    }
}

/// Means and one over standard deviations of the samples.
struct Moments<'a>(&'a [Lanes]);

impl Kernel for Moments<'_> {
    type Output = [Each; 2];

    #[inline(always)]
    fn run(self) -> [Each; 2] {
        let count = self.0.len() as f64;
        let (mut means, mut squares) = ([0.0; LANES], [0.0; LANES]);
        for row in self.0 {
            for (mean, value) in means.iter_mut().zip(&row.0) {
                *mean += value;
            }
        }
        for mean in &mut means {
            *mean /= count;
        }
        for row in self.0 {
            for lane in 0..LANES {
                let off = row.0[lane] - means[lane];
                squares[lane] += off * off;
            }
        }
        let scales = squares.map(|sum| 1.0 / (sum / (count - 1.0)).sqrt());
        [means, scales]
    }
}

/// D of samples with these moments.
struct Distances<'a> {
    rows: &'a mut [Lanes],
    bins: &'a mut [Bin],
    means: Lanes,
    scales: Lanes,
}

impl WithSimd for Distances<'_> {
    type Output = Each;

    #[inline(always)]
    fn run<V: Simd>(self) -> Each {
        let Self { rows, bins, means, scales } = self;
        let (means, scales) = (V::load(&means), V::load(&scales));
        let count = rows.len() as f64;
        let zero = V::from_f64(0.0);
        let knots = PHI.as_slice();
        for row in &mut *rows {
            let f = phi(knots, (V::load(row) - means) * scales);
            f.store(row);
        }
        bins.fill(Bin::EMPTY);
        for row in rows {
            let (_, places) = floor(V::load(row) * V::from_f64(count));
            for lane in 0..LANES {
                let (bin, f) = (&mut bins[places[lane]], row[lane]);
                bin.count[lane] += 1.0;
                bin.lowest[lane] = smaller(f, bin.lowest[lane]);
                bin.highest[lane] = larger(f, bin.highest[lane]);
            }
        }
        let step = V::from_f64(1.0 / count);
        let (mut distances, mut below) = (zero, zero);
        for bin in bins {
            let through = below + V::load(&bin.count);
            let before = V::load(&bin.lowest) - below * step;
            let after = through * step - V::load(&bin.highest);
            let further = before.max(after).max(distances);
            distances = below.lt(through).select(further, distances);
            below = through;
        }
        let mut found = Lanes::splat(0.0);
        distances.store(&mut found);
        found.0
    }
}

/// The smaller of two numbers that are not NaN: one instruction.
#[inline(always)]
fn smaller(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The larger of two numbers that are not NaN: one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// 2^52.
const WHOLE: f64 = 4_503_599_627_370_496.0;

/// The largest whole numbers that numbers from 0 to 2^32 are not below, and
/// these as indices: the last bits of their sums with 2^52.
#[inline(always)]
fn floor<V: Simd>(x: V) -> (V, [usize; LANES]) {
    let whole = V::from_f64(WHOLE);
    let nearest = (x + whole) - whole;
    let less = nearest - V::from_f64(1.0);
    let floor = x.lt(nearest).select(less, nearest);
    let mut sums = Lanes::splat(0.0);
    (floor + whole).store(&mut sums);
    // A loop, since `map` on an array is compiled as a call.
    let mut places = [0; LANES];
    for (place, sum) in places.iter_mut().zip(sums.0) {
        *place = sum.to_bits() as u32 as usize;
    }
    (floor, places)
}

/// Knots of Phi and of its derivative times their distance of 1/128.
static PHI: LazyLock<Vec<[f64; 2]>> = LazyLock::new(|| {
    let steps = (2.0 * END * STEPS_PER_UNIT) as u32;
    let knot = |k| {
        let z = f64::from(k) / STEPS_PER_UNIT - END;
        [normal::cdf(z), normal::pdf(z) / STEPS_PER_UNIT]
    };
    (0..=steps + 1).map(knot).collect()
});

const STEPS_PER_UNIT: f64 = 128.0;
/// Beyond, Phi is 0 or 1 to 6e-16.
const END: f64 = 8.0;

/// Phi by cubics between knots: error at most
/// h^4 max|phi'''|/384 = 1.4e-11.
#[inline(always)]
fn phi<V: Simd>(knots: &[[f64; 2]], z: V) -> V {
    let end = V::from_f64(END);
    let position = z.max(-end).min(end) + end;
    let position = position * V::from_f64(STEPS_PER_UNIT);
    let (floor, cells) = floor(position);
    let t = position - floor;
    let [mut from, mut to] = [[&knots[0]; LANES]; 2];
    for (lane, cell) in cells.into_iter().enumerate() {
        (from[lane], to[lane]) = (&knots[cell], &knots[cell + 1]);
    }
    let (f0, d0) = V::gather_pairs(from);
    let (f1, d1) = V::gather_pairs(to);
    let (rise, rest) = (f1 - f0, V::from_f64(1.0) - t);
    let (a, b) = (d0 - rise, rise - d1);
    f0 + t * (rise + rest * (a * rest + b * t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::streams::{Streams, standard_normal};
    use crate::{Sample, lilliefors::Statistic};

    #[test]
    fn cubics_are_close_to_phi() {
        for k in -90_000..=90_000 {
            let z = f64::from(k) * 1e-4;
            let error = (phi(&PHI, Lanes::splat(z))[3] - normal::cdf(z)).abs();
            assert!(error < 2e-11, "{z}: {error:e}");
        }
    }

    #[test]
    fn statistic_in_lanes_is_that_of_the_sample() {
        let streams = Streams::new("test of the lanes", 0);
        for n in [4, 5, 7, 44, 86, 400, 3000] {
            let mut scratch = Scratch::new(n);
            let rounds = if n > 400 { 1 } else { 25 };
            for round in 0..rounds {
                let mut exact = Vec::new();
                for lane in 0..LANES {
                    let index = (round * LANES + lane) as u64;
                    let mut stream = streams.stream(index);
                    for value in &mut scratch.values {
                        *value = standard_normal(&mut stream);
                    }
                    scratch.put(lane);
                    let sample = Sample::try_new(&scratch.values).unwrap();
                    exact.push(Statistic::try_new(&sample).unwrap().d);
                }
                for (fast, exact) in scratch.statistics().iter().zip(exact) {
                    assert!((fast - exact).abs() < 4e-11, "{n}, {round}");
                }
            }
        }
    }

    /// A sample has the same bits in every lane, beside any others.
    #[test]
    fn lanes_do_not_matter() {
        let streams = Streams::new("test of the lanes", 1);
        let sample = |index: u64| -> Vec<f64> {
            let mut stream = streams.stream(index);
            (0..86).map(|_| standard_normal(&mut stream)).collect()
        };
        let of = |first: u64, turn: usize| {
            let mut scratch = Scratch::new(86);
            for lane in 0..LANES {
                scratch.values = sample(first + lane as u64);
                scratch.put((lane + turn) % LANES);
            }
            scratch.statistics()
        };
        let (a, b) = (of(0, 0), of(0, 3));
        for lane in 0..LANES {
            assert_eq!(a[lane].to_bits(), b[(lane + 3) % LANES].to_bits());
        }
        assert_eq!(of(5, 0)[..3], a[5..]);
    }
}
