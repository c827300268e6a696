//! D of several samples at once, for simulations.
//!
//! Eight samples lie in lanes and are sorted together by a network of
//! comparisons (Batcher's odd-even merge; Knuth, TAOCP 3, 5.2.2, algorithm
//! M), which branches nowhere. Phi comes from a table of cubics. A lane has
//! the bits that its sample has in any other lane, at every level of
//! instructions.

use std::sync::LazyLock;

use crate::number::dispatch::{Isa, Kernel, WithSimd};
use crate::number::lanes::{Lanes, Simd, WIDTH};
use crate::statistics::normal;

/// Samples at once.
pub(crate) const LANES: usize = WIDTH;

/// A number of each sample.
type Each = [f64; LANES];

/// Values of a sample, at most, that a network sorts: a longer sample has
/// more comparisons in it than a sort of its own.
const LARGEST_NETWORK: usize = 2048;

/// Working space of [`LANES`] replicates.
pub(crate) struct Scratch {
    /// The values of a sample, to be filled in.
    pub values: Vec<f64>,
    /// Row i has the values i of all samples.
    rows: Vec<Lanes>,
    /// Comparisons of rows, in order; none for long samples.
    network: Vec<(u32, u32)>,
}

impl Scratch {
    /// Space for samples of n values.
    pub fn new(n: usize) -> Self {
        let network =
            if n <= LARGEST_NETWORK { network(n) } else { Vec::new() };
        Self {
            values: vec![0.0; n],
            rows: vec![Lanes::splat(0.0); n],
            network,
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
        let [means, scales] = isa.run(Moments(&self.rows));
        if self.network.is_empty() {
            for lane in 0..LANES {
                for (value, row) in self.values.iter_mut().zip(&self.rows) {
                    *value = row.0[lane];
                }
                self.values.sort_unstable_by(f64::total_cmp);
                self.put(lane);
            }
        }
        let Self { rows, network, .. } = self;
        if isa.run_wide(Sort { rows, network }).is_none() {
            Sort { rows, network }.run::<Lanes>();
        }
        isa.run(Distances { rows, means, scales })
    }
}

/// Comparisons that sort n values, each of a lower and a higher place.
fn network(n: usize) -> Vec<(u32, u32)> {
    let mut found = Vec::new();
    let top = n.next_power_of_two() / 2;
    let mut p = top;
    while p > 0 {
        let (mut q, mut r, mut d) = (top, 0, p);
        loop {
            for i in 0..n.saturating_sub(d) {
                if i & p == r {
                    found.push((i as u32, (i + d) as u32));
                }
            }
            if q == p {
                break;
            }
            (d, q, r) = (q - p, q / 2, p);
        }
        p /= 2;
    }
    found
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

/// The comparisons of a network.
struct Sort<'a> {
    rows: &'a mut [Lanes],
    network: &'a [(u32, u32)],
}

impl WithSimd for Sort<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Simd>(self) {
        for &(low, high) in self.network {
            let (low, high) = (low as usize, high as usize);
            let a = V::load(&self.rows[low]);
            let b = V::load(&self.rows[high]);
            a.min(b).store(&mut self.rows[low]);
            b.max(a).store(&mut self.rows[high]);
        }
    }
}

/// D of sorted samples with these moments.
struct Distances<'a> {
    rows: &'a [Lanes],
    means: Each,
    scales: Each,
}

impl Kernel for Distances<'_> {
    type Output = Each;

    #[inline(always)]
    fn run(self) -> Each {
        let Self { rows, means, scales } = self;
        let table = &*PHI;
        let step = 1.0 / rows.len() as f64;
        let mut distances = [0.0; LANES];
        let mut below = 0.0;
        for row in rows.iter() {
            let mut z = [0.0; LANES];
            for lane in 0..LANES {
                z[lane] = (row.0[lane] - means[lane]) * scales[lane];
            }
            let f = table.at(z);
            let (before, after) = (below * step, (below + 1.0) * step);
            below += 1.0;
            for lane in 0..LANES {
                let further = larger(f[lane] - before, after - f[lane]);
                distances[lane] = larger(distances[lane], further);
            }
        }
        distances
    }
}

/// The larger of two numbers that are not NaN: one instruction.
#[inline(always)]
fn larger(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

/// Phi by cubics between knots 1/128 apart: error at most
/// h^4 max|phi'''|/384 = 1.4e-11.
struct PhiTable {
    knots: Vec<[f64; 2]>,
}

const STEPS_PER_UNIT: f64 = 128.0;
/// Beyond, Phi is 0 or 1 to 6e-16.
const END: f64 = 8.0;
/// 2^52.
const WHOLE: f64 = 4_503_599_627_370_496.0;
/// Bits of the number of a cell: the last is 2 END `STEPS_PER_UNIT` = 2048.
const LAST_CELL: usize = 0xfff;

static PHI: LazyLock<PhiTable> = LazyLock::new(|| {
    let steps = (2.0 * END * STEPS_PER_UNIT) as u32;
    let knot = |k| {
        let z = f64::from(k) / STEPS_PER_UNIT - END;
        [normal::cdf(z), normal::pdf(z) / STEPS_PER_UNIT]
    };
    PhiTable { knots: (0..=steps + 1).map(knot).collect() }
});

impl PhiTable {
    #[inline(always)]
    fn at(&self, z: Each) -> Each {
        let (mut t, mut cells) = ([0.0; LANES], [0; LANES]);
        for lane in 0..LANES {
            let position = (z[lane].clamp(-END, END) + END) * STEPS_PER_UNIT;
            let cell = position.floor();
            t[lane] = position - cell;
            // Whole numbers below 2^52 are the last bits of this sum.
            cells[lane] = (cell + WHOLE).to_bits() as usize & LAST_CELL;
        }
        let (mut from, mut to) = ([[0.0; 2]; LANES], [[0.0; 2]; LANES]);
        for lane in 0..LANES {
            from[lane] = self.knots[cells[lane]];
            to[lane] = self.knots[cells[lane] + 1];
        }
        let mut f = [0.0; LANES];
        for lane in 0..LANES {
            let ([f0, d0], [f1, d1]) = (from[lane], to[lane]);
            let (t, rise) = (t[lane], f1 - f0);
            let (a, b) = (d0 - rise, rise - d1);
            f[lane] = f0 + t * (rise + (1.0 - t) * (a * (1.0 - t) + b * t));
        }
        f
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::statistics::{Sample, lilliefors::Statistic};
    use crate::streams::{Streams, standard_normal};

    #[test]
    fn cubics_are_close_to_phi() {
        for k in -90_000..=90_000 {
            let z = f64::from(k) * 1e-4;
            let error = (PHI.at([z; LANES])[3] - normal::cdf(z)).abs();
            assert!(error < 2e-11, "{z}: {error:e}");
        }
    }

    /// By the 0-1 principle: a network that sorts all zeros and ones sorts.
    #[test]
    fn the_network_sorts() {
        let sorts = |n: usize, ones: u32| {
            let mut values: Vec<u32> =
                (0..n).map(|i| (ones >> i) & 1).collect();
            for (low, high) in network(n) {
                if values[low as usize] > values[high as usize] {
                    values.swap(low as usize, high as usize);
                }
            }
            values.is_sorted()
        };
        for n in 1..=13 {
            assert!((0..1 << n).all(|ones| sorts(n, ones)), "{n}");
        }
        // One comparison less, and it does not.
        assert_eq!(network(4).len(), 5);
    }

    #[test]
    fn statistic_in_lanes_is_that_of_the_sample() {
        let streams = Streams::new("test of the lanes", 0);
        for n in [4, 5, 7, 44, 86, 400, LARGEST_NETWORK + 1] {
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
