//! A probability from a count.

use anyhow::{Context as _, Result};
use rocking_statistics::estimate::EstimateError;
use rocking_statistics::{Clusters, Interval, Proportion, normal};

use crate::methods::cells::Csv;
use crate::methods::method::{Context, Reply, WrongModel};

const PROPORTION: Csv = Csv::new("oracles/proportion.csv");

const LEVEL: f64 = 0.95;

/// Wilson's interval, which is not exact.
fn wilson(
    share: f64,
    trials: usize,
    level: f64,
) -> Result<Interval, EstimateError> {
    let (z, n) = (normal::quantile(0.5 * (1.0 + level)), trials as f64);
    let middle = (share + z * z / (2.0 * n)) / (1.0 + z * z / n);
    let spread = share * (1.0 - share) / n + z * z / (4.0 * n * n);
    let half = z * spread.sqrt() / (1.0 + z * z / n);
    Interval::try_new(middle - half, middle + half)
}

/// Exact intervals of probabilities, alone or of many at once.
pub fn intervals(context: &Context, answer: &mut Reply) -> Result<()> {
    input! { context;
        /// Successes and trials.
        counts: Vec<(usize, usize)>,
        /// How many such probabilities are held at once.
        together: usize,
    }
    for (successes, trials) in counts {
        let one = Proportion::try_new(successes, trials)?;
        let count = context.or(WrongModel::PointwiseIntervals, 1, together);
        let all = vec![one; count];
        let band = Proportion::band(&all, LEVEL)?;
        let mut interval = *band.first().context("no probability")?;
        if context.is(WrongModel::WilsonInterval) {
            let level = 1.0 - (1.0 - LEVEL) / count as f64;
            interval = wilson(one.share(), trials, level)?;
        }
        let words = [successes, trials, together].map(|k| k.to_string());
        let row = PROPORTION.row(&words.each_ref().map(String::as_str))?;
        let ends = [("low", interval.low()), ("high", interval.high())];
        row.put(answer, 3, &ends)?;
    }
    Ok(())
}

/// Intervals at 90 % of counts over clusters, by the effective number of
/// trials.
pub fn of_clusters(context: &Context, answer: &mut Reply) -> Result<()> {
    for row in PROPORTION.rows("clusters")? {
        let clusters = Clusters::from_labels(row.text(1).split(' '));
        let held = row.list(2, ' ')?;
        let held: Vec<bool> = held.into_iter().map(|x| x > 0.0).collect();
        let drawn = context.drawn(&clusters);
        let found = Proportion::of_clusters(&held, &drawn)?.interval(0.9)?;
        let ends = [("low", found.low()), ("high", found.high())];
        row.put(answer, 3, &ends)?;
    }
    Ok(())
}
