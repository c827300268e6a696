//! D without sorting, for simulations.
//!
//! The values F_i fall into n bins of width 1/n; D+ is attained at the last
//! value of a bin, D- at the first (Gonzalez, Sahni and Franta, ACM TOMS 3
//! (1977) 60). Phi comes from a table of cubics.

use std::sync::LazyLock;

use crate::statistics::normal;

/// Working space of one replicate.
pub(crate) struct Scratch {
    /// The values of a sample, to be filled in.
    pub values: Vec<f64>,
    bins: Vec<Bin>,
}

#[derive(Clone, Copy)]
struct Bin {
    count: f64,
    first: f64,
    last: f64,
}

const EMPTY: Bin = Bin { count: 0.0, first: 2.0, last: -1.0 };

impl Scratch {
    /// Space for samples of n values.
    pub fn new(n: usize) -> Self {
        Self { values: vec![0.0; n], bins: vec![EMPTY; n] }
    }

    /// D of the values, in any order.
    pub fn statistic(&mut self) -> f64 {
        let count = self.values.len() as f64;
        let mean = self.values.iter().fold(0.0, |s, x| s + x) / count;
        let squares =
            self.values.iter().fold(0.0, |s, x| s + (x - mean) * (x - mean));
        let scale = 1.0 / (squares / (count - 1.0)).sqrt();
        self.bins.fill(EMPTY);
        let last_bin = self.bins.len() - 1;
        let table = &*PHI;
        for x in &self.values {
            let f = table.at((x - mean) * scale);
            let bin = &mut self.bins[((f * count) as usize).min(last_bin)];
            bin.count += 1.0;
            bin.first = if f < bin.first { f } else { bin.first };
            bin.last = larger(bin.last, f);
        }
        let step = 1.0 / count;
        let (mut d, mut below) = (0.0_f64, 0.0);
        for bin in &self.bins {
            if bin.count > 0.0 {
                let before = bin.first - below * step;
                below += bin.count;
                let after = below * step - bin.last;
                d = larger(d, larger(before, after));
            }
        }
        d
    }
}

/// The larger of two numbers that are not NaN: one instruction.
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

static PHI: LazyLock<PhiTable> = LazyLock::new(|| {
    let steps = (2.0 * END * STEPS_PER_UNIT) as u32;
    let knot = |k| {
        let z = f64::from(k) / STEPS_PER_UNIT - END;
        [normal::cdf(z), normal::pdf(z) / STEPS_PER_UNIT]
    };
    PhiTable { knots: (0..=steps + 1).map(knot).collect() }
});

impl PhiTable {
    fn at(&self, z: f64) -> f64 {
        let position = (z.clamp(-END, END) + END) * STEPS_PER_UNIT;
        let cell = position as usize;
        let t = position - cell as f64;
        let [f0, d0] = self.knots[cell];
        let [f1, d1] = self.knots[cell + 1];
        let rise = f1 - f0;
        let (a, b) = (d0 - rise, rise - d1);
        f0 + t * (rise + (1.0 - t) * (a * (1.0 - t) + b * t))
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
            let error = (PHI.at(z) - normal::cdf(z)).abs();
            assert!(error < 2e-11, "{z}: {error:e}");
        }
    }

    #[test]
    fn statistic_without_sorting_is_the_sorted_one() {
        let streams = Streams::new("test of the bins", 0);
        for n in [4, 5, 7, 44, 86, 400] {
            let mut scratch = Scratch::new(n);
            for index in 0..200 {
                let mut stream = streams.stream(index);
                for value in &mut scratch.values {
                    *value = standard_normal(&mut stream);
                }
                let fast = scratch.statistic();
                let sample = Sample::try_new(&scratch.values).unwrap();
                let exact = Statistic::try_new(&sample).unwrap().d;
                assert!((fast - exact).abs() < 4e-11, "n = {n}, {index}");
            }
        }
    }
}
