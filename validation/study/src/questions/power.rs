//! What can the tests detect in suites of these sizes?

use libm::{exp, log1p};
use rayon::prelude::*;
use rocking_statistics::Sample;
use rocking_statistics::lilliefors::{LillieforsTable, Statistic};
use rocking_statistics::normality::{
    anderson_darling, cramer_von_mises, shapiro_wilk,
};
use rocking_statistics::streams::{Streams, standard_normal};

use super::answer::{Rows, StudyAnswer, count, number};
use super::{levels, nulls, trimming};
use crate::normality::LEVEL;
use crate::results::StudyResults;

/// Excess medians of the truth, in units of the shift.
const EXCESSES: [f64; 6] = [0.25, 0.5, 1.0, 2.0, 4.0, 8.0];

/// Dispersion of the truth above the shift.
const DISPERSION: f64 = 0.6;

/// Samples for each.
const TRIALS: u64 = 1000;

pub(super) fn answer(results: &StudyResults) -> anyhow::Result<StudyAnswer> {
    let sizes = results.suites().map(|suite| suite.records.len());
    let mut table = Rows::default();
    // At an excess median of 1, in percent.
    let mut at = Vec::new();
    for n in sizes {
        for excess in EXCESSES {
            let rates = rejected(n, excess);
            table.row(vec![
                ("records", count(n)),
                ("excess_median", number(excess, 2)),
                ("dispersion", number(DISPERSION, 1)),
                ("lilliefors", number(rates[0], 2)),
                ("anderson_darling", number(rates[1], 2)),
                ("cramer_von_mises", number(rates[2], 2)),
                ("shapiro_wilk", number(rates[3], 2)),
            ]);
            if excess == 1.0 {
                at.push(rates.map(|rate| 100.0 * rate));
            }
        }
    }
    let own = format!(
        "Where capacities are lognormal above 1 (excess median 1, dispersion \
         {DISPERSION}), the test of the unshifted sample rejects in {:.0} % \
         of the samples with {} records and in {:.0} % with {} by \
         Lilliefors, in {:.0} % and {:.0} % by Shapiro-Wilk: an accepted \
         lognormal is weak evidence, and unequal suites are not to be \
         compared.",
        at[0][0], sizes[0], at[1][0], sizes[1], at[0][3], at[1][3],
    );
    let parts = [
        nulls::nulls_part(results),
        levels::levels_part(results),
        trimming::trimming_part(results)?,
    ];
    let words = parts.iter().map(|part| part.answer.clone());
    let words: Vec<String> = std::iter::once(own).chain(words).collect();
    let mut answer = table.answer("power", words.join("\n"));
    for part in parts {
        answer.tables.extend(part.tables);
        answer.files.extend(part.files);
    }
    Ok(answer)
}

/// Rejected shares of the four tests.
fn rejected(n: usize, excess: f64) -> [f64; 4] {
    let streams = Streams::new("study/power", 0);
    let critical = LillieforsTable::embedded().critical_value(n, LEVEL).ok();
    let found: Vec<[bool; 4]> = (0..TRIALS)
        .into_par_iter()
        .map(|index| {
            let mut stream = streams.stream(index);
            let logs: Vec<f64> = (0..n)
                .map(|_| {
                    let z = standard_normal(&mut stream);
                    log1p(excess * exp(DISPERSION * z))
                })
                .collect();
            let sample = Sample::try_new(&logs).ok()?;
            let d = Statistic::try_new(&sample).ok()?.d;
            let [a, w, s] = [anderson_darling, cramer_von_mises, shapiro_wilk]
                .map(|test| test(&sample).map(|t| t.p_value < LEVEL));
            Some([d > critical?.0, a.ok()?, w.ok()?, s.ok()?])
        })
        .flatten()
        .collect();
    [0, 1, 2, 3].map(|k: usize| {
        let count = found.iter().filter(|row| row[k]).count();
        count as f64 / found.len() as f64
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shapiro_wilk_sees_more_than_lilliefors_and_86_more_than_44() {
        let (large, small) = (rejected(86, 1.0), rejected(44, 1.0));
        assert!(large[3] > large[0] && small[3] > small[0]);
        assert!((0..4).all(|k| large[k] > small[k]));
        // Far from the shift there is nothing to see: the level remains.
        let far = rejected(86, 1e6);
        // Four binomial deviations of 1000 trials.
        assert!(far.iter().all(|r| (r - 0.05).abs() < 0.03), "{far:?}");
    }
}
