//! What does an estimated shift do to Figure 14?

use rocking::statistics::lilliefors::{ShiftedNull, Table};

use super::answer::{Answer, Rows, count, number, word};
use crate::analyses::SuiteResults;
use crate::distributions::{BlockSamples, factors};
use crate::estimates::median;
use crate::normality::{LEVEL, over_critical};
use crate::results::Results;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, demand_index, demands,
};
use rocking_common::words::{capital, percent, range};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Series,
};

/// Demands at which the null is simulated; between them the ratio of the
/// two critical values is linear.
const PLACES: [f64; 12] =
    [0.005, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Replicates at each of them.
const REPLICATES: u64 = 2000;
/// Standard error of the ratio of a critical value to the table's at so many.
const STANDARD_ERROR: f64 = 0.016;

/// One block under both nulls.
struct Row {
    /// Critical value with the shift estimated anew over the table's, at
    /// [`PLACES`]; NaN where the joint model does not hold.
    ratios: Vec<f64>,
    /// Accepted share of the levels with the shift as given.
    given: f64,
    /// The same with the shift estimated anew.
    anew: f64,
    /// Share of the draws made again, at the worst place.
    redrawn: f64,
}

pub(super) fn answer(results: &Results) -> anyhow::Result<Answer> {
    let arm = results.plan.common();
    let mut table = Rows::default();
    let mut words = Vec::new();
    let mut drawn = Vec::new();
    let all = results.common();
    for (suite, found) in all.filter(|(_, d)| d.intensity == Intensity::Pgv) {
        let mut changes = Vec::new();
        let mut all_ratios = Vec::new();
        for block in &found.blocks {
            let row = of_block(suite, block)?;
            let finite: Vec<f64> =
                row.ratios.iter().copied().filter(|x| x.is_finite()).collect();
            let (least, most) = range(finite.iter().copied());
            let middle = median(&finite).value;
            let without = PLACES.len() - finite.len();
            table.row(vec![
                ("suite", word(suite.kind.name())),
                ("p_rad_s", number(block.p_rad_s, 0)),
                ("alpha_rad", number(block.alpha_rad, 2)),
                ("accepted_shift_as_given", number(row.given, 3)),
                ("accepted_shift_estimated_anew", number(row.anew, 3)),
                ("critical_value_ratio_least", number(least, 3)),
                ("critical_value_ratio_median", number(middle, 3)),
                ("critical_value_ratio_largest", number(most, 3)),
                ("places_without_a_null", count(without)),
                ("largest_share_drawn_again", number(row.redrawn, 3)),
            ]);
            changes.push(row.anew - row.given);
            drawn.push((suite.kind.name(), block.p_rad_s, row));
            all_ratios.extend(finite);
        }
        let (least, most) = range(changes.iter().copied());
        words.push(format!(
            "{} records: with the shift estimated anew in every draw the \
             critical value is {:.3} times the table's (median), and the \
             accepted share of a block changes by {:.3} (median; {least:.3} \
             to {most:.3}).",
            capital(suite.kind.name()),
            median(&all_ratios).value,
            median(&changes).value,
        ));
    }
    let answer = table.answer(
        "null",
        "What does the calibrated null do to Figure 14, where the shift is \
         the suite's own lowest PGV of uplift?",
        words.join(" "),
        "Figure 14 under the null of an estimated shift",
        "Shifted PGV; the null draws onset and capacity jointly and takes \
         the lowest onset of the draw as its shift. A level without a null \
         counts as not tested.",
    );
    Ok(Answer { figures: vec![figure(&drawn, arm)], ..answer })
}

fn of_block(
    suite: &SuiteResults,
    block: &BlockSamples,
) -> anyhow::Result<Row> {
    let onsets = factors(suite, Intensity::Pgv, block.p_rad_s);
    let n = onsets.len();
    let tabulated = Table::embedded().critical_value(n, LEVEL);
    let mut redrawn: f64 = 0.0;
    let ratios: Vec<f64> = PLACES
        .iter()
        .map(|edp| {
            let sample = &block.samples[demand_index(*edp)];
            let null =
                ShiftedNull::lowest_onset(&onsets, sample, REPLICATES, 0)
                    .ok()?;
            let total = (null.redrawn + REPLICATES) as f64;
            let share = null.redrawn as f64 / total;
            redrawn = if share > redrawn { share } else { redrawn };
            let critical = null.null.critical_value(LEVEL).ok()?;
            Some(critical.value / tabulated.ok()?.0)
        })
        .map(|ratio| ratio.unwrap_or(f64::NAN))
        .collect();
    let (mut tested, mut accepted) = (0_usize, 0_usize);
    for (edp, assessment) in demands().iter().zip(&block.shifted) {
        let over = over_critical(assessment) / between(&ratios, *edp);
        tested += usize::from(over.is_finite());
        accepted += usize::from(over <= 1.0);
    }
    Ok(Row {
        ratios,
        given: block.shares().1,
        anew: accepted as f64 / tested as f64,
        redrawn,
    })
}

/// Linear interpolation over [`PLACES`].
fn between(values: &[f64], edp: f64) -> f64 {
    let i = PLACES.partition_point(|place| *place < edp);
    let i = i.clamp(1, PLACES.len() - 1);
    let share = (edp - PLACES[i - 1]) / (PLACES[i] - PLACES[i - 1]);
    if share <= 0.0 {
        values[i - 1]
    } else if share >= 1.0 {
        values[i]
    } else {
        f64::mul_add(share, values[i] - values[i - 1], values[i - 1])
    }
}

fn figure(rows: &[(&'static str, f64, Row)], arm: Arm) -> Figure {
    // One scale for both suites, wide enough that scatter does not look like
    // a trend.
    let ratios = rows.iter().flat_map(|(.., row)| row.ratios.iter().copied());
    let (low, high) = range(ratios);
    let ends = (low.min(0.9), high.max(1.1));
    let ends = (low <= high).then_some(ends);
    let panel = |kind: &str| {
        let series = FREQUENCIES_RAD_S.iter().map(|p| {
            let at = |k: usize| {
                let own: Vec<f64> = rows
                    .iter()
                    .filter(|(suite, q, _)| *suite == kind && q == p)
                    .map(|(.., row)| row.ratios[k])
                    .filter(|x| x.is_finite())
                    .collect();
                (median(&own).value, range(own.into_iter()))
            };
            let (y, ends) = (0..PLACES.len()).map(at).unzip();
            let label = format!("*p* = {p} rad/s");
            let marks = Mark::LineAndPoints;
            Series::new(label, marks, PLACES.to_vec(), y).with(ends)
        });
        let around = [-1.0, 1.0].map(|side| {
            let y = vec![1.0 + side * 1.96 * STANDARD_ERROR; 2];
            Series::new("", Mark::Dashed, vec![0.0, 1.0], y).keyed([])
        });
        let series = around.into_iter().chain(series).collect();
        ChartPanel {
            title: format!("{kind} records"),
            x: ChartAxis::linear("*θ̃*", (0.0, 1.0)),
            y: ChartAxis::linear("critical value over the table's", ends),
            series,
        }
    };
    Chart {
        heading: Heading::new(
            "figure-null",
            "Critical values with the shift estimated anew",
            "Critical value of Lilliefors' test at 5 % with the shift \
             estimated in every draw, over the tabulated one, along the \
             demand; shifted PGV, ordinary and pulse-type records.",
        )
        .of(arm),
        panels: vec![panel("ordinary"), panel("pulse-type")],
        columns: 2,
    }
    .figure(words(rows))
}

/// Largest departure of a critical value from the table's, in a sentence.
fn words(rows: &[(&'static str, f64, Row)]) -> String {
    let ratios = rows.iter().flat_map(|(.., row)| row.ratios.iter());
    let (low, high) = range(ratios.map(|x| 100.0 * (x - 1.0)));
    format!(
        "Estimating IM_R anew moves the 5 % critical value by {} to {} %. \
         A point rests on {REPLICATES} replicates and has a standard error \
         of {}: what lies between the dashed lines may be its scatter. Bars \
         span the five slendernesses.",
        signed(low),
        signed(high),
        percent(STANDARD_ERROR, 1)
    )
}

fn signed(x: f64) -> String {
    format!("{x:+.1}").replace('-', "−")
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
