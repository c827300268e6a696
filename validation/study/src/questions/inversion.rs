//! How biased is the inversion by the median point along the vertical?

use rocking::capacity::{InversionRule, ResponseCurve, inversion_discrepancy};

use super::answer::{Answer, Rows, both, count, number, word};
use crate::analyses::no_arm;
use crate::results::Results;
use crate::runs::capacities;
use rocking_common::paper::{FREQUENCIES_RAD_S, SLENDERNESSES_RAD, position};
use rocking_common::words::capital;

const DEMANDS: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Rules compared with the unbiased one.
const RULES: [InversionRule; 3] =
    [InversionRule::Median, InversionRule::First, InversionRule::Last];

pub(super) fn answer(results: &Results) -> anyhow::Result<Answer> {
    let arm = results.plan.common();
    let mut table = Rows::default();
    let mut words = Vec::new();
    for suite in both(results) {
        let curves = suite.curves(arm).ok_or_else(no_arm)?;
        let mut worst: f64 = 0.0;
        let mut place = (0.0, 0.0);
        let (mut several, mut all) = (0_usize, 0_usize);
        let mut gap: f64 = 0.0;
        for (frequency, p) in FREQUENCIES_RAD_S.into_iter().enumerate() {
            for edp in DEMANDS {
                let mut row = Row::default();
                for slenderness in 0..SLENDERNESSES_RAD.len() {
                    let own = &curves[position(frequency, slenderness)];
                    row.add(own, edp)?;
                }
                let bias = row.bias();
                if bias[0].abs() > worst.abs() {
                    worst = bias[0];
                    place = (p, edp);
                }
                several += row.several;
                all += row.curves;
                gap = if row.gap > gap { row.gap } else { gap };
                let share = row.several as f64 / row.curves as f64;
                table.row_if(
                    [0.1, 0.5, 1.0].contains(&edp),
                    vec![
                        ("suite", word(suite.kind.name())),
                        ("p_rad_s", number(p, 0)),
                        ("edp", number(edp, 1)),
                        ("curves", count(row.curves)),
                        ("share_with_several_crossings", number(share, 3)),
                        ("median_bias", number(bias[0], 4)),
                        ("first_bias", number(bias[1], 4)),
                        ("last_bias", number(bias[2], 4)),
                        ("largest_gap_to_stripes", number(row.gap, 3)),
                    ],
                );
            }
        }
        words.push(format!(
            "{} records: the mean capacity by median point differs by at \
             most {:+.1} % from the unbiased one (p = {}, demand {:.1}); \
             {:.1} % of the curves cross a level more than once, and the \
             fragility by inversion is up to {gap:.3} off the stripes'.",
            capital(suite.kind.name()),
            100.0 * worst,
            place.0,
            place.1,
            100.0 * several as f64 / all as f64,
        ));
    }
    Ok(table.answer(
        "inversion",
        "How biased is the inversion by the median point along the vertical?",
        words.join(" "),
        "Bias of the inversion",
        "Relative difference of the mean capacity to that of the monotone \
         inversion c1 - c2 + c3 - .., which averages to the area above the \
         stripe fragility; over five slendernesses, curves that reach the \
         level. Gap: largest difference of fragilities, a block.",
    ))
}

#[derive(Default)]
struct Row {
    curves: usize,
    several: usize,
    /// Sums of capacities by the unbiased rule, then by [`RULES`].
    sums: [f64; 4],
    gap: f64,
}

impl Row {
    fn add(
        &mut self,
        curves: &[ResponseCurve],
        edp: f64,
    ) -> anyhow::Result<()> {
        for curve in curves {
            let of = |rule| -> anyhow::Result<f64> {
                Ok(capacities(curve, &[edp], rule)?[0])
            };
            let unbiased = of(InversionRule::Monotone)?;
            if !unbiased.is_finite() {
                continue;
            }
            self.curves += 1;
            self.several += usize::from(curve.crossings(edp)?.all().len() > 1);
            self.sums[0] += unbiased;
            for (sum, rule) in self.sums[1..].iter_mut().zip(RULES) {
                *sum += of(rule)?;
            }
        }
        let gap = inversion_discrepancy(curves, edp, InversionRule::Median)?;
        self.gap = if gap > self.gap { gap } else { self.gap };
        Ok(())
    }

    fn bias(&self) -> [f64; 3] {
        [1, 2, 3].map(|k: usize| self.sums[k] / self.sums[0] - 1.0)
    }
}
