//! The null distribution of D by simulation.

use std::sync::LazyLock;

use rand_distr::{Distribution as _, StandardNormal};
use rayon::prelude::*;
use statrs::distribution::{Beta, ContinuousCDF as _};

use super::{LillieforsError, PValue};
use crate::statistics::normal;
use crate::streams::Streams;

/// Replicates that share one scratch space.
const CHUNK: u64 = 4096;

/// Simulated statistics D of normal samples of one size, ascending.
///
/// Replicate i draws from stream i of the family "lilliefors, n", so the
/// result does not depend on threads. D is computed without sorting: the
/// values F_i fall into n bins of width 1/n, and D+ is attained at the last
/// value of a bin, D- at the first (Gonzalez, Sahni and Franta, ACM TOMS 3
/// (1977) 60). Phi comes from a table of cubics that is within 2e-11 of it.
///
/// ```
/// use rocking::statistics::lilliefors::NullDistribution;
/// let null = NullDistribution::simulate(20, 2000, 0)?;
/// let critical = null.critical_value(0.05)?;
/// assert!((critical.value - 0.192).abs() < 4.0 * critical.standard_error);
/// # Ok::<(), rocking::statistics::lilliefors::LillieforsError>(())
/// ```
#[derive(Clone, Debug)]
pub struct NullDistribution {
    n: usize,
    sorted: Vec<f64>,
}

/// A critical value with its Monte Carlo error.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub struct CriticalValue {
    /// The order statistic of rank ceil((1 - level)(N + 1)): a sample's D
    /// exceeds it with probability `level` exactly, over both draws.
    pub value: f64,
    /// sqrt(level (1 - level)/N)/f, with the density f by the difference
    /// quotient of the order statistics 0.2 level to either side.
    pub standard_error: f64,
    /// Lower end of the 95 % interval by order statistics.
    pub low: f64,
    /// Upper end of the 95 % interval by order statistics.
    pub high: f64,
}

impl NullDistribution {
    /// Simulates the statistics of `replicates` samples of n values.
    ///
    /// # Errors
    /// [`LillieforsError`] for n < 4, and for fewer than 100 or more than
    /// 10^8 replicates.
    pub fn simulate(
        n: usize,
        replicates: u64,
        seed: u64,
    ) -> Result<Self, LillieforsError> {
        if n < 4 {
            return Err(LillieforsError::TooFew(n));
        }
        if !(100..=100_000_000).contains(&replicates) {
            return Err(LillieforsError::Replicates(replicates));
        }
        let streams = Streams::new(&format!("lilliefors, {n}"), seed);
        let chunks: Vec<Vec<f64>> = (0..replicates.div_ceil(CHUNK))
            .into_par_iter()
            .map(|chunk| {
                let mut scratch = Scratch::new(n);
                let first = chunk * CHUNK;
                (first..(first + CHUNK).min(replicates))
                    .map(|index| scratch.replicate(&streams, index))
                    .collect()
            })
            .collect();
        let mut sorted = chunks.concat();
        drop(chunks);
        sorted.par_sort_unstable_by(f64::total_cmp);
        Ok(Self { n, sorted })
    }

    /// Size of the samples.
    #[must_use]
    pub fn n(&self) -> usize {
        self.n
    }

    /// The simulated statistics, ascending.
    #[must_use]
    pub fn sorted(&self) -> &[f64] {
        &self.sorted
    }

    /// The value that D exceeds with probability `level`.
    ///
    /// # Errors
    /// [`LillieforsError::Level`] unless at least ten replicates lie on
    /// either side.
    pub fn critical_value(
        &self,
        level: f64,
    ) -> Result<CriticalValue, LillieforsError> {
        let count = self.sorted.len() as f64;
        let (low, high) = (10.0 / count, 1.0 - 10.0 / count);
        if !(level >= low && level <= high) {
            return Err(LillieforsError::Level { level, low, high });
        }
        // The product's own rounding must not lift a whole number.
        let rank = ((1.0 - level) * (count + 1.0) * (1.0 - 1e-15)).ceil();
        let at = |rank: f64| self.sorted[rank.clamp(1.0, count) as usize - 1];
        let span = (0.2 * level.min(1.0 - level) * count).ceil();
        let spacing = at(rank + span) - at(rank - span);
        let deviation = (level * (1.0 - level) * count).sqrt();
        let half = (normal::quantile(0.975) * deviation).ceil();
        Ok(CriticalValue {
            value: at(rank),
            standard_error: deviation * spacing / (2.0 * span),
            low: at(rank - half),
            high: at(rank + half),
        })
    }

    /// The p-value of a statistic, (b + 1)/(N + 1) with b the number of
    /// replicates not below it, and the 95 % Clopper-Pearson interval of b.
    #[must_use]
    pub fn p_value(&self, d: f64) -> PValue {
        let below = self.sorted.partition_point(|&x| x < d);
        let count = self.sorted.len();
        let (low, high) = clopper_pearson(count - below, count, 0.95);
        let value = (count - below + 1) as f64 / (count + 1) as f64;
        PValue { value, low, high }
    }
}

/// Exact interval of a probability after `successes` of `trials`.
fn clopper_pearson(successes: usize, trials: usize, level: f64) -> (f64, f64) {
    let (b, n) = (successes as f64, trials as f64);
    let tail = 0.5 * (1.0 - level);
    let at = |a: f64, b: f64, p: f64| {
        Beta::new(a, b).map_or(f64::NAN, |beta| beta.inverse_cdf(p))
    };
    let low = if successes == 0 { 0.0 } else { at(b, n - b + 1.0, tail) };
    let high =
        if successes == trials { 1.0 } else { at(b + 1.0, n - b, 1.0 - tail) };
    (low, high)
}

/// Working space of one replicate.
struct Scratch {
    values: Vec<f64>,
    bins: Vec<Bin>,
}

#[derive(Clone, Copy)]
struct Bin {
    count: u32,
    first: f64,
    last: f64,
}

const EMPTY: Bin = Bin { count: 0, first: 2.0, last: -1.0 };

impl Scratch {
    fn new(n: usize) -> Self {
        Self { values: vec![0.0; n], bins: vec![EMPTY; n] }
    }

    fn replicate(&mut self, streams: &Streams, index: u64) -> f64 {
        let mut stream = streams.stream(index);
        for value in &mut self.values {
            *value = StandardNormal.sample(&mut stream);
        }
        self.statistic()
    }

    /// D of the values, in any order.
    fn statistic(&mut self) -> f64 {
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
            bin.count += 1;
            bin.first = bin.first.min(f);
            bin.last = bin.last.max(f);
        }
        let (mut d, mut below) = (0.0, 0);
        for bin in &self.bins {
            if bin.count > 0 {
                d = f64::max(d, bin.first - f64::from(below) / count);
                below += bin.count;
                d = f64::max(d, f64::from(below) / count - bin.last);
            }
        }
        d
    }
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
                let fast = scratch.replicate(&streams, index);
                let sample = Sample::try_new(&scratch.values).unwrap();
                let exact = Statistic::try_new(&sample).unwrap().d;
                assert!((fast - exact).abs() < 4e-11, "n = {n}, {index}");
            }
        }
    }

    #[test]
    fn threads_do_not_matter() {
        let run = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let simulate = || NullDistribution::simulate(10, 10_000, 1);
            pool.build().unwrap().install(simulate).unwrap().sorted
        };
        assert_eq!(run(1), run(3));
    }

    #[test]
    fn clopper_pearson_has_its_closed_ends() {
        // No success: 1 - (0.025)^(1/n); published 5 of 10: .1871, .8129.
        let (low, high) = clopper_pearson(0, 20, 0.95);
        let expected = 1.0 - libm::pow(0.025, 1.0 / 20.0);
        assert!(low == 0.0 && (high - expected).abs() < 1e-10);
        let (low, high) = clopper_pearson(5, 10, 0.95);
        assert!((low - 0.1871).abs() < 5e-5 && (high - 0.8129).abs() < 5e-5);
    }
}
