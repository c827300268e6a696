//! How much of the rejections is the grid of 0.01 g?

use rocking::capacity::ResponseCurve;
use rocking_statistics::ExtendedSample;
use rocking_statistics::lilliefors::{Inapplicable, LillieforsTest};

use super::answer::{Rows, StudyAnswer, count, number, word};
use super::nulls;
use crate::analyses::SuiteResults;
use crate::fits::{Fits, of_intervals};
use crate::results::StudyResults;
use crate::ties::grid_alone;
use crate::words::{caption, heading};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, Intensity, SLENDERNESSES_RAD, position,
};
use rocking_common::words::{capital, percent};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Mark, Series,
};

/// One block of a suite.
struct GridRow {
    /// Rejected share of the levels, shifted, by arm; NaN for an arm that
    /// was not run.
    rejected: [f64; 3],
    /// Distinct first overturnings by arm.
    distinct: [usize; 3],
    /// Levels at which ties decide, by arm.
    tied: [usize; 3],
    /// Dispersion above the shift at first overturning: of arm A's levels
    /// taken as they are, of its brackets by the interval likelihood, of arm
    /// B's bisected ones.
    dispersions: [f64; 3],
    /// Rejected share of samples that are shifted lognormal like the finest
    /// arm's first overturnings, put on the grid of 0.01 g.
    grid_alone: f64,
}

const ARMS: [Arm; 3] = [Arm::A, Arm::B, Arm::C];

pub(super) fn answer(results: &StudyResults) -> anyhow::Result<StudyAnswer> {
    let mut table = Rows::default();
    let mut words = Vec::new();
    let mut by_suite = Vec::new();
    for suite in results.suites() {
        let rows = rows(results, suite)?;
        for (i, row) in rows.iter().enumerate() {
            let share = |x: f64| number(x, 3);
            let slenderness = i % SLENDERNESSES_RAD.len();
            let p = FREQUENCIES_RAD_S[i / SLENDERNESSES_RAD.len()];
            table.row_if(
                slenderness == 0 || suite.kind == results.ordinary.kind,
                vec![
                    ("suite", word(suite.kind.name())),
                    ("p_rad_s", number(p, 0)),
                    ("alpha_rad", number(SLENDERNESSES_RAD[slenderness], 2)),
                    ("rejected_a", share(row.rejected[0])),
                    ("rejected_b", share(row.rejected[1])),
                    ("rejected_c", share(row.rejected[2])),
                    ("distinct_a", count(row.distinct[0])),
                    ("distinct_b", count(row.distinct[1])),
                    ("distinct_c", count(row.distinct[2])),
                    ("levels_decided_by_ties_a", count(row.tied[0])),
                    ("rejected_by_the_grid_alone", share(row.grid_alone)),
                    ("dispersion_a", share(row.dispersions[0])),
                    ("dispersion_a_by_intervals", share(row.dispersions[1])),
                    ("dispersion_b", share(row.dispersions[2])),
                ],
            );
        }
        let slender: Vec<String> = FREQUENCIES_RAD_S
            .iter()
            .enumerate()
            .map(|(frequency, p)| {
                let row = &rows[position(frequency, 0)];
                let [a, b, c] = row.rejected.map(|share| percent(share, 0));
                format!(
                    "{a} in A, {b} in B and {c} in C at p = {p} ({} by the \
                     grid alone, {} distinct values of {})",
                    percent(row.grid_alone, 0),
                    row.distinct[0],
                    suite.records.len(),
                )
            })
            .collect();
        words.push(format!(
            "{} records, alpha = 0.05, shifted PGA, rejected levels: {}.",
            capital(suite.kind.name()),
            slender.join("; ")
        ));
        by_suite.push((suite.kind.name(), rows));
    }
    let answer = table.answer("grid", words.join(" "));
    let answer = StudyAnswer { figures: vec![figure(&by_suite)], ..answer };
    Ok(answer.beside(nulls::nulls_part(results)))
}

fn rows(
    results: &StudyResults,
    suite: &SuiteResults,
) -> anyhow::Result<Vec<GridRow>> {
    let of = |arm| suite.distributions(arm, Intensity::Pga);
    let finest = of(results.plan.common())?;
    (0..finest.blocks.len())
        .map(|i| {
            let mut row = GridRow {
                rejected: [f64::NAN; 3],
                distinct: [0; 3],
                tied: [0; 3],
                dispersions: [f64::NAN; 3],
                grid_alone: grid_alone(&finest.blocks[i]).unwrap_or(f64::NAN),
            };
            for (arm, found) in ARMS.into_iter().map(of).enumerate() {
                let Ok(block) = found.map(|d| &d.blocks[i]) else {
                    continue;
                };
                let overturning = block.overturning();
                row.rejected[arm] = 1.0 - block.shares().1;
                let taken = dispersion(overturning, block.shift);
                if arm < 2 {
                    row.dispersions[2 * arm] = taken.unwrap_or(f64::NAN);
                }
                row.distinct[arm] = distinct(overturning);
                row.tied[arm] =
                    block.shifted.iter().filter(|a| tied(a)).count();
            }
            if let Ok(curves) = suite.curves(Arm::A) {
                let intervals = by_intervals(&curves[i], 1.0);
                row.dispersions[1] = intervals.unwrap_or(f64::NAN);
            }
            Ok(row)
        })
        .collect()
}

/// Dispersion above a shift by maximum likelihood.
fn dispersion(values: &[f64], shift: f64) -> Option<f64> {
    let sample = ExtendedSample::try_new(values).ok()?;
    Fits::new(&sample, shift).ssfl.map(|f| f.dispersion())
}

/// Dispersion by maximum likelihood from intervals: above the last level at
/// which the block stood, up to the first at which it overturned.
fn by_intervals(curves: &[ResponseCurve], shift: f64) -> Option<f64> {
    let high = |c: &ResponseCurve| c.overturning_im().unwrap_or(f64::INFINITY);
    let known = curves.iter().map(|c| (c.last_im(), high(c)));
    let known: Vec<(f64, f64)> = known.collect();
    let once = vec![1; known.len()];
    of_intervals(&known, &once, shift).map(|f| f.dispersion())
}

fn tied(assessment: &LillieforsTest) -> bool {
    matches!(assessment.verdict, Err(Inapplicable::Ties { .. }))
}

fn distinct(values: &[f64]) -> usize {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.chunk_by(|a, b| a == b).count()
}

/// A row of panels a suite.
fn figure(suites: &[(&str, Vec<GridRow>)]) -> Figure {
    let panels = suites
        .iter()
        .flat_map(|(kind, rows)| {
            let frequencies = FREQUENCIES_RAD_S.iter().enumerate();
            frequencies.map(move |(frequency, p)| {
                let title = format!("*p* = {p} rad/s, {kind}");
                panel(title, &rows[position(frequency, 0)..])
            })
        })
        .collect();
    Chart { heading: heading("grid"), panels, columns: 3 }
        .figure(caption("grid"))
}

/// One frequency parameter: the first rows are its blocks.
fn panel(title: String, rows: &[GridRow]) -> ChartPanel {
    let line = |label: &str, mark, of: &dyn Fn(&GridRow) -> f64| {
        Series::new(
            label,
            mark,
            SLENDERNESSES_RAD.to_vec(),
            rows[..SLENDERNESSES_RAD.len()]
                .iter()
                .map(|row| 100.0 * of(row))
                .collect(),
        )
    };
    let mut series: Vec<Series> = ARMS
        .iter()
        .enumerate()
        .filter(|(k, _)| rows[0].rejected[*k].is_finite())
        .map(|(k, arm)| {
            let label = format!("arm {}", arm.name());
            line(&label, Mark::LineAndPoints, &|r| r.rejected[k])
        })
        .collect();
    let words = "the grid alone, at overturning";
    series.push(line(words, Mark::Dashed, &|r| r.grid_alone));
    let x = ChartAxis::linear("*α* (rad)", (0.03, 0.27));
    let y = ChartAxis::linear("rejected levels (%)", (0.0, 100.0));
    ChartPanel { title, x, y, series }
}
