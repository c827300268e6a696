//! Does an accepted share hang on the size of the suite, on one record, or
//! on the shift?

use rayon::prelude::*;
use rocking::statistics::ExtendedSample;
use rocking::statistics::lilliefors::{Assessment, Null, Scale, Table};
use rocking::streams::{Streams, below};

use super::answer::{Answer, Rows, number, word};
use crate::distributions::BlockSamples;
use crate::estimates::mean;
use crate::estimates::median;
use crate::normality::{LEVEL, accepted_share, every};
use crate::results::Results;
use rocking_common::words::{capital, range};

/// Subsamples of the size of the pulse-type suite.
const SUBSAMPLES: u64 = 200;

/// Every so many levels enter.
const STRIDE: usize = 8;

pub(super) fn answer(results: &Results) -> anyhow::Result<Answer> {
    let (large, small) =
        (results.ordinary.records.len(), results.pulse.records.len());
    let mut table = Rows::default();
    let mut words = Vec::new();
    for (suite, found) in results.common() {
        let intensity = found.intensity;
        let (mut gains, mut swings, mut moves) =
            (Vec::new(), Vec::new(), Vec::new());
        for block in &found.blocks {
            let levels: Vec<&Vec<f64>> =
                every(&block.samples, STRIDE).collect();
            let all: Vec<usize> = (0..suite.records.len()).collect();
            let whole = share(&levels, &all, block.shift);
            let n = suite.records.len();
            let draws = if small < n { SUBSAMPLES } else { 0 };
            let shares = subsamples(block, &levels, (n, small), draws);
            let without: Vec<f64> = all
                .par_iter()
                .map(|left_out| {
                    let mut kept = all.clone();
                    kept.remove(*left_out);
                    share(&levels, &kept, block.shift)
                })
                .collect();
            let (low, high) = range(without.iter().copied());
            let subsampled = mean(shares.iter().copied());
            let farthest = (0..without.len()).max_by(|i, j| {
                let off = |k: &usize| (without[*k] - whole).abs();
                off(i).total_cmp(&off(j)).then(j.cmp(i))
            });
            let farthest =
                farthest.map_or("", |i| suite.records[i].name.as_str());
            let nine = share(&levels, &all, 0.9 * block.shift);
            let ends = quantiles(&shares);
            gains.push(subsampled - whole);
            swings.push(high - low);
            moves.push(nine - whole);
            table.row(vec![
                ("suite", word(suite.kind.name())),
                ("im", word(intensity.name())),
                ("p_rad_s", number(block.p_rad_s, 0)),
                ("alpha_rad", number(block.alpha_rad, 2)),
                ("accepted_share", number(whole, 2)),
                ("subsample_mean", number(subsampled, 2)),
                ("subsample_low", number(ends.0, 2)),
                ("subsample_high", number(ends.1, 2)),
                ("without_one_record_low", number(low, 2)),
                ("without_one_record_high", number(high, 2)),
                ("most_influential_record", word(farthest)),
                ("share_at_0.9_im_r", number(nine, 2)),
            ]);
        }
        let of = |values: &[f64]| median(values).value;
        let by_size = if gains.iter().any(|x| x.is_finite()) {
            format!(
                "{small} of the {large} records instead of all change it \
                 by {:+.2} (median over blocks), ",
                of(&gains)
            )
        } else {
            String::new()
        };
        words.push(format!(
            "{}, shifted {}, accepted share: {by_size}leaving one record out \
             moves it within a range of {:.2}, and 0.9 IM_R changes it by {:+.2}.",
            capital(suite.kind.name()),
            intensity.name().to_uppercase(),
            of(&swings),
            of(&moves),
        ));
    }
    Ok(table.answer(
        "robustness",
        "Does the accepted share hang on the number of records, on one \
         record, or on the shift?",
        words.join(" "),
        "Accepted shares with fewer records, without one, and with another shift",
        "Shifted samples, every eighth level. Fewer records reject less, \
         so shares of suites of unequal size are not to be compared; the \
         subsamples have the smaller suite's size (mean, 5 and 95 %).",
    ))
}

/// Accepted share of the levels for these records; NaN if none was tested.
fn share(levels: &[&Vec<f64>], records: &[usize], shift: f64) -> f64 {
    let tests: Vec<Assessment> = levels
        .iter()
        .filter_map(|level| {
            let values: Vec<f64> = records.iter().map(|i| level[*i]).collect();
            let sample = ExtendedSample::try_new(&values).ok()?;
            let null = Null::Table(Table::embedded());
            let scale = Scale::Logarithmic { shift };
            Some(Assessment::new(&sample, scale, LEVEL, null))
        })
        .collect();
    accepted_share(&tests)
}

/// Accepted shares of seeded subsamples without replacement, ascending.
fn subsamples(
    block: &BlockSamples,
    levels: &[&Vec<f64>],
    (n, size): (usize, usize),
    draws: u64,
) -> Vec<f64> {
    // The same records for every block and measure.
    let streams = Streams::new("study/subsamples", 0);
    let mut shares: Vec<f64> = (0..draws)
        .into_par_iter()
        .map(|index| {
            let mut stream = streams.stream(index);
            let mut records: Vec<usize> = (0..n).collect();
            for i in 0..size {
                let j = i + below(&mut stream, n - i);
                records.swap(i, j);
            }
            share(levels, &records[..size], block.shift)
        })
        .collect();
    shares.sort_by(f64::total_cmp);
    shares
}

/// The 5 and 95 % order statistics.
fn quantiles(sorted: &[f64]) -> (f64, f64) {
    let at = |p: f64| {
        let i = (p * sorted.len() as f64) as usize;
        sorted.get(i).copied().unwrap_or(f64::NAN)
    };
    (at(0.05), at(0.95))
}
