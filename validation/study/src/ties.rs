//! Effect of only the grid of 0.01 g on Lilliefors' test: capacities of a
//! shifted lognormal, each put on the next level of the grid.

use libm::{exp, log, tan};
use rayon::prelude::*;
use rocking_statistics::lilliefors::{
    LillieforsTable, LillieforsTest, Null, Scale,
};
use rocking_statistics::lognormal::fit;
use rocking_statistics::streams::{Streams, standard_normal};
use rocking_statistics::{ExtendedSample, Lognormal, QuantileType, Sample};

use crate::distributions::BlockSamples;
use crate::fits::MLE;
use crate::normality::LEVEL;

/// Samples drawn for the share of the grid.
const DRAWS: u64 = 1000;

/// Rejected share of samples that are lognormal above the shift like the
/// block's first overturnings, each put on the next level of the 0.01 g
/// grid; `None` without a fit.
pub(crate) fn grid_alone(block: &BlockSamples) -> Option<f64> {
    on_the_blocks_grid(block, rejected_on_grid)
}

/// The 95 % quantile of D over the table's critical value for such samples on
/// this grid; `None` without a fit.
pub(crate) fn critical_on_grid(block: &BlockSamples) -> Option<f64> {
    let ratios = on_the_blocks_grid(block, |truth, step, n| {
        on_grid(truth, step, n, LillieforsTest::ratio)
    })?;
    let ratios: Vec<f64> = ratios.into_iter().flatten().collect();
    let sample = Sample::try_new(&ratios).ok()?;
    QuantileType::default().quantile(&sample, 1.0 - LEVEL).ok()
}

/// A number of the lognormal above the shift of a block's first overturnings,
/// the step of its 0.01 g grid, and the number of records.
fn on_the_blocks_grid<T>(
    block: &BlockSamples,
    of: impl FnOnce(&Lognormal, f64, usize) -> T,
) -> Option<T> {
    let sample = block.overturning();
    let extended = ExtendedSample::try_new(sample).ok()?;
    let truth = fit(&extended, block.shift, MLE).ok()?.distribution;
    Some(of(&truth, 0.01 / tan(block.alpha_rad), sample.len()))
}

/// Share of samples of `n` capacities of a shifted lognormal that the shifted
/// test rejects after they were put on the next multiple of `step`.
fn rejected_on_grid(truth: &Lognormal, step: f64, n: usize) -> f64 {
    let rejected = on_grid(truth, step, n, LillieforsTest::exceeds);
    let count = rejected.into_iter().filter(|r| r.unwrap_or(true)).count();
    count as f64 / DRAWS as f64
}

/// Results of the shifted test for samples of `n` capacities of a shifted
/// lognormal, each put on the next multiple of `step`.
fn on_grid<T: Send>(
    truth: &Lognormal,
    step: f64,
    n: usize,
    of: impl Fn(&LillieforsTest) -> Option<T> + Sync,
) -> Vec<Option<T>> {
    let streams = Streams::new("study/grid alone", 0);
    let (shift, null) = (truth.shift(), LillieforsTable::embedded());
    let (centre, spread) = (truth.log_mean(), truth.dispersion());
    let one = |index| {
        let mut stream = streams.stream(index);
        let logs = (0..n).map(|_| {
            let z = standard_normal(&mut stream);
            let x = shift + exp(f64::mul_add(spread, z, centre));
            log((x / step).ceil() * step - shift)
        });
        let sample =
            ExtendedSample::try_new(&logs.collect::<Vec<_>>()).ok()?;
        let null = Null::Table(null);
        of(&LillieforsTest::new(&sample, Scale::Linear, LEVEL, null))
    };
    (0..DRAWS).into_par_iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_grid_alone_rejects_slender_blocks() {
        // Excess median 0.9, dispersion 0.6, 86 values: 91, 30 and 8.8 % by
        // an independent simulation of 4000 trials; four deviations.
        let truth =
            Lognormal::try_new(1.0, libm::log(0.9), 0.6).expect("truth");
        for (alpha_rad, rate) in [(0.05, 0.91), (0.10, 0.30), (0.25, 0.088)] {
            let ours = rejected_on_grid(&truth, 0.01 / tan(alpha_rad), 86);
            let variance = rate * (1.0 - rate) * (1e-3 + 1.0 / 4000.0);
            let bound = 4.0 * f64::sqrt(variance) + 0.005;
            assert!((ours - rate).abs() < bound, "{alpha_rad}: {ours}");
        }
    }
}
