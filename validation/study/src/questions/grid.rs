//! How many rejections does the grid of 0.01 g cause?

use rocking::capacity::ResponseCurve;
use rocking_statistics::ExtendedSample;
use rocking_statistics::lilliefors::{Inapplicable, LillieforsTest};
use rocking_statistics::lognormal::fit_intervals;

use super::answer::{Rows, StudyAnswer, count, number, word};
use super::nulls;
use crate::analyses::SuiteResults;
use crate::distributions::BlockSamples;
use crate::fits::Fits;
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
    /// Rejected share of the levels, shifted, by grid; NaN for a grid that was
    /// not run.
    rejected: [f64; 3],
    /// Distinct first overturnings by grid.
    distinct: [usize; 3],
    /// Levels at which ties decide, by grid.
    tied: [usize; 3],
    /// Dispersion above the shift at first overturning: of the levels of grid A,
    /// of its brackets by the interval likelihood, of the bisected levels of
    /// grid B.
    dispersions: [f64; 3],
    /// Rejected share of samples that are shifted lognormal like the first
    /// overturnings of the finest grid, put on the grid of 0.01 g.
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
                     steps of the grid, {} distinct values of {})",
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
    let finest = &of(results.plan.common())?.blocks;
    let on_grids = ARMS.map(|arm| of(arm).ok());
    let brackets = suite.curves(Arm::A).ok();
    let row = |(i, finest): (usize, &BlockSamples)| {
        let blocks = on_grids.map(|found| found.map(|d| &d.blocks[i]));
        let each = |of: fn(&BlockSamples) -> f64| {
            blocks.map(|block| block.map_or(f64::NAN, of))
        };
        let counts = |of: fn(&BlockSamples) -> usize| {
            blocks.map(|block| block.map_or(0, of))
        };
        let [taken, bisected, _] = each(dispersion);
        let intervals =
            brackets.map_or(f64::NAN, |curves| by_intervals(&curves[i], 1.0));
        GridRow {
            rejected: each(|block| 1.0 - block.shares()[1]),
            distinct: counts(|block| distinct(block.overturning())),
            tied: counts(|block| {
                block.tests[1].iter().filter(|test| tied(test)).count()
            }),
            dispersions: [taken, intervals, bisected],
            grid_alone: grid_alone(finest).unwrap_or(f64::NAN),
        }
    };
    Ok(finest.iter().enumerate().map(row).collect())
}

/// Dispersion of the overturnings above the shift by maximum likelihood; NaN
/// without a fit.
fn dispersion(block: &BlockSamples) -> f64 {
    let sample = ExtendedSample::try_new(block.overturning()).ok();
    let fit = sample.and_then(|own| Fits::new(own, block.shift).ssfl);
    fit.map_or(f64::NAN, |f| f.dispersion())
}

/// Dispersion by maximum likelihood from intervals, each from the last level at
/// which the block stood to the first at which it overturned; NaN without a fit.
fn by_intervals(curves: &[ResponseCurve], shift: f64) -> f64 {
    let high = |c: &ResponseCurve| c.overturning_im().unwrap_or(f64::INFINITY);
    let known = curves.iter().map(|c| (c.last_im(), high(c)));
    let fit = fit_intervals(&known.collect::<Vec<_>>(), shift);
    fit.map_or(f64::NAN, |fit| fit.distribution.dispersion())
}

fn tied(assessment: &LillieforsTest) -> bool {
    matches!(assessment.verdict, Err(Inapplicable::Ties { .. }))
}

fn distinct(values: &[f64]) -> usize {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.chunk_by(|a, b| a == b).count()
}

/// A row of panels for each suite.
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

/// One frequency parameter, whose blocks are the first rows.
fn panel(title: String, rows: &[GridRow]) -> ChartPanel {
    let line = |label: &str, mark, of: &dyn Fn(&GridRow) -> f64| {
        let rows = rows[..SLENDERNESSES_RAD.len()].iter();
        let shares = rows.map(|row| 100.0 * of(row)).collect();
        Series::new(label, mark, SLENDERNESSES_RAD.to_vec(), shares)
    };
    let mut series: Vec<Series> = ARMS
        .iter()
        .enumerate()
        .filter(|(k, _)| rows[0].rejected[*k].is_finite())
        .map(|(k, arm)| {
            let label = format!("grid {}", arm.name());
            line(&label, Mark::LineAndPoints, &|r| r.rejected[k])
        })
        .collect();
    let words = "by the steps of the grid, at overturning";
    series.push(line(words, Mark::Dashed, &|r| r.grid_alone));
    let x = ChartAxis::linear("*α* (rad)", (0.03, 0.27));
    let y = ChartAxis::linear("rejected levels (%)", (0.0, 100.0));
    ChartPanel { title, x, y, series }
}
