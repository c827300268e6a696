//! Critical values if the shift is estimated from the same records.

use rocking_statistics::lilliefors::{LillieforsTable, ShiftedNull};

use super::answer::{Rows, StudyAnswer, count, number, word};
use crate::distributions::{BlockSamples, factors};
use crate::estimates::median;
use crate::facts::Facts;
use crate::normality::{LEVEL, over_critical};
use crate::results::StudyResults;
use rocking_common::paper::{Intensity, demand_index, demands};
use rocking_common::words::{capital, range};

/// Demands at which the null is simulated. Between them the ratio of the two
/// critical values is interpolated linearly.
const PLACES: [f64; 12] =
    [0.005, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Replicates at each of them.
const REPLICATES: u64 = 2000;

pub(super) fn nulls_part(results: &StudyResults) -> StudyAnswer {
    let mut table = Rows::default();
    let mut words = Vec::new();
    let all = results.common();
    for (suite, found) in all.filter(|(_, d)| d.intensity == Intensity::Pgv) {
        let mut changes = Vec::new();
        let mut all_ratios = Vec::new();
        for block in &found.blocks {
            let (ratios, anew, redrawn) = of_block(&suite.records, block);
            let given = block.shares()[1];
            let finite: Vec<f64> =
                ratios.into_iter().filter(|x| x.is_finite()).collect();
            let (least, most) = range(finite.iter().copied());
            let middle = median(&finite).value();
            let without = PLACES.len() - finite.len();
            table.row(vec![
                ("suite", word(suite.kind.name())),
                ("p_rad_s", number(block.p_rad_s, 0)),
                ("alpha_rad", number(block.alpha_rad, 2)),
                ("accepted_shift_as_given", number(given, 3)),
                ("accepted_shift_estimated_anew", number(anew, 3)),
                ("critical_value_ratio_least", number(least, 3)),
                ("critical_value_ratio_median", number(middle, 3)),
                ("critical_value_ratio_largest", number(most, 3)),
                ("places_without_a_null", count(without)),
                ("largest_share_drawn_again", number(redrawn, 3)),
            ]);
            changes.push(anew - given);
            all_ratios.extend(finite);
        }
        let (least, most) = range(changes.iter().copied());
        words.push(format!(
            "{} records: with the shift estimated anew in every draw the \
             critical value is {:.3} times the table's (median), and the \
             accepted share of a block changes by {:.3} (median; {least:.3} \
             to {most:.3}).",
            capital(suite.kind.name()),
            median(&all_ratios).value(),
            median(&changes).value(),
        ));
    }
    table.answer("null", words.join(" "))
}

/// One block with its shift estimated anew: critical value over the table's at
/// [`PLACES`] (NaN if the joint model does not hold), accepted share of the levels,
/// and largest share of repeated draws at any place.
fn of_block(records: &[Facts], block: &BlockSamples) -> (Vec<f64>, f64, f64) {
    let onsets = factors(records, Intensity::Pgv, block.p_rad_s);
    let tabulated =
        LillieforsTable::embedded().critical_value(onsets.len(), LEVEL);
    let mut redrawn: f64 = 0.0;
    let ratios: Vec<f64> = PLACES
        .iter()
        .map(|edp| {
            let sample = &block.samples[demand_index(*edp)];
            let null =
                ShiftedNull::lowest_onset(&onsets, sample, REPLICATES, 0)
                    .ok()?;
            let total = (null.redrawn + REPLICATES) as f64;
            redrawn = redrawn.max(null.redrawn as f64 / total);
            let critical = null.null.critical_value(LEVEL).ok()?;
            Some(critical.estimate.value() / tabulated.ok()?.0)
        })
        .map(|ratio| ratio.unwrap_or(f64::NAN))
        .collect();
    let (mut tested, mut accepted) = (0_usize, 0_usize);
    for (edp, assessment) in demands().iter().zip(&block.tests[1]) {
        let over = over_critical(assessment) / between(&ratios, *edp);
        tested += usize::from(over.is_finite());
        accepted += usize::from(over <= 1.0);
    }
    (ratios, accepted as f64 / tested as f64, redrawn)
}

/// Linear interpolation over [`PLACES`].
fn between(values: &[f64], edp: f64) -> f64 {
    let i = PLACES.partition_point(|place| *place < edp);
    let i = i.clamp(1, PLACES.len() - 1);
    let share = (edp - PLACES[i - 1]) / (PLACES[i] - PLACES[i - 1]);
    match share {
        share if share <= 0.0 => values[i - 1],
        share if share >= 1.0 => values[i],
        _ => f64::mul_add(share, values[i] - values[i - 1], values[i - 1]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn between_places_the_ratio_is_linear() {
        let mut ratios = vec![1.0; PLACES.len()];
        ratios[3] = 1.2;
        assert_eq!(between(&ratios, 0.2), 1.2);
        assert!((between(&ratios, 0.15) - 1.1).abs() < 1e-12);
        assert!((between(&ratios, 0.275) - 1.05).abs() < 1e-12);
        assert_eq!(between(&ratios, 1.0), 1.0);
        ratios[0] = f64::NAN;
        assert!(between(&ratios, 0.01).is_nan());
    }
}
