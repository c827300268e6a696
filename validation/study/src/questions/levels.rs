//! What does an accepted share of levels that share records mean?

use rayon::prelude::*;
use rocking::statistics::acceptance::{AcceptedShare, NullBand};
use rocking::statistics::lilliefors::{Assessment, Inapplicable};
use rocking::statistics::multiple::{benjamini_hochberg, holm};
use rocking::statistics::normality::Battery;

use super::answer::{Answer, Cell, Rows, count, number, word};
use crate::error::StudyError;
use crate::estimates::mean;
use crate::normality::{
    BAND_STRIDE, LEVEL, accepted_share, ends, every, over_critical,
};
use crate::results::Results;
use rocking_common::paper::SuiteKind;
use rocking_common::words::capital;

/// Replicates behind the critical values of the other tests.
const REPLICATES: u64 = 20_000;

pub(super) fn answer(results: &Results) -> Result<Answer, StudyError> {
    let mut table = Rows::default();
    let mut words = Vec::new();
    let batteries = SuiteKind::BOTH.map(|kind| {
        let size = results.suite(kind).records.len();
        (kind, Battery::simulate(size, REPLICATES, 0).ok())
    });
    for (suite, found) in results.common() {
        let battery = batteries.iter().find(|b| b.0 == suite.kind);
        let battery = battery.and_then(|b| b.1.as_ref());
        let intensity = found.intensity;
        let mut low = [0_usize; 2];
        let mut shares: [Vec<f64>; 4] = Default::default();
        for block in &found.blocks {
            for (shifted, tests) in
                [&block.original, &block.shifted].into_iter().enumerate()
            {
                let row =
                    Row::new(tests, block.bands[shifted].as_ref(), battery);
                low[shifted] += usize::from(row.p_of_share < LEVEL);
                if shifted == 1 {
                    let own = [row.share].into_iter().chain(row.others);
                    shares
                        .iter_mut()
                        .zip(own)
                        .for_each(|(all, x)| all.push(x));
                }
                let kind = ["original", "shifted"][shifted];
                let mut cells = vec![
                    ("suite", word(suite.kind.name())),
                    ("im", word(intensity.name())),
                    ("sample", word(kind)),
                    ("p_rad_s", number(block.p_rad_s, 0)),
                    ("alpha_rad", number(block.alpha_rad, 2)),
                ];
                cells.extend(row.cells());
                table.row_if(shifted == 1, cells);
            }
        }
        let [d, a, w, s] = shares.map(mean);
        words.push(format!(
            "{}, {}: the accepted share is lower than lognormal \
             capacities with the same dependence between levels allow \
             (p < 0.05) for {} of {} original and {} shifted samples; \
             mean accepted share of the shifted ones {d:.2} by \
             Lilliefors, {a:.2} by Anderson-Darling, {w:.2} by Cramer-von \
             Mises, {s:.2} by Shapiro-Wilk.",
            capital(suite.kind.name()),
            intensity.name().to_uppercase(),
            low[0],
            found.blocks.len(),
            low[1],
        ));
    }
    Ok(table.answer(
        (
            "levels",
            "What does an accepted share of levels that share records mean?",
        ),
        words.join(" "),
        "Accepted shares, their null bands and adjusted counts",
        "Band: central 95 % of the Gaussian-score bootstrap; effective \
         levels: (sum of eigenvalues)^2 over the sum of their squares, of \
         the correlation between levels; Holm and Benjamini-Hochberg at \
         5 % over 200 levels; the other tests at 5 % by simulation.",
    ))
}

struct Row {
    share: f64,
    band: (f64, f64),
    p_of_share: f64,
    p_of_mean: f64,
    effective: f64,
    rejected: [usize; 3],
    ties: usize,
    by_step: [f64; 4],
    others: [f64; 3],
}

impl Row {
    fn new(
        tests: &[Assessment],
        band: Option<&NullBand>,
        battery: Option<&Battery>,
    ) -> Self {
        let share = accepted_share(tests);
        let stands: Vec<Assessment> =
            every(tests, BAND_STRIDE).cloned().collect();
        let observed = accepted_share(&stands);
        let ratios: Vec<f64> = stands.iter().map(over_critical).collect();
        let p_values: Vec<f64> =
            tests.iter().filter_map(|t| Some(t.p_value?.value)).collect();
        let below = |adjusted: Vec<f64>| {
            adjusted.iter().filter(|p| **p <= LEVEL).count()
        };
        let counts = AcceptedShare::of(tests);
        let tied = |t: &&Assessment| {
            matches!(t.verdict, Err(Inapplicable::Ties { .. }))
        };
        let with_step = |stride: usize| {
            let kept: Vec<Assessment> =
                every(tests, stride).cloned().collect();
            accepted_share(&kept)
        };
        let limits = band.and_then(ends);
        Self {
            share,
            band: limits.unwrap_or((f64::NAN, f64::NAN)),
            p_of_share: band.map_or(f64::NAN, |b| b.p_value(observed)),
            p_of_mean: band.map_or(f64::NAN, |b| {
                b.p_value_of_mean_ratio(mean(ratios.iter().copied()))
            }),
            effective: band.map_or(f64::NAN, |b| b.effective_levels),
            rejected: [
                counts.tested - counts.accepted,
                below(holm(&p_values)),
                below(benjamini_hochberg(&p_values)),
            ],
            ties: tests.iter().filter(tied).count(),
            by_step: [
                with_step(2),
                with_step(4),
                with_step(10),
                accepted_share(&tests[19..]),
            ],
            others: battery.map_or([f64::NAN; 3], |b| others(tests, b)),
        }
    }

    fn cells(&self) -> Vec<(&'static str, Cell)> {
        let share = |x: f64| number(x, 3);
        vec![
            ("accepted_share", share(self.share)),
            ("band_low", share(self.band.0)),
            ("band_high", share(self.band.1)),
            ("p_of_share", share(self.p_of_share)),
            ("p_of_mean_d", share(self.p_of_mean)),
            ("effective_levels", number(self.effective, 1)),
            ("rejected_plain", count(self.rejected[0])),
            ("rejected_holm", count(self.rejected[1])),
            ("rejected_benjamini_hochberg", count(self.rejected[2])),
            ("ties_decide", count(self.ties)),
            ("share_step_0.01", share(self.by_step[0])),
            ("share_step_0.02", share(self.by_step[1])),
            ("share_step_0.05", share(self.by_step[2])),
            ("share_from_0.1", share(self.by_step[3])),
            ("accepted_anderson_darling", share(self.others[0])),
            ("accepted_cramer_von_mises", share(self.others[1])),
            ("accepted_shapiro_wilk", share(self.others[2])),
        ]
    }
}

/// Accepted shares of Anderson-Darling, Cramer-von Mises and Shapiro-Wilk,
/// at every eighth level.
fn others(tests: &[Assessment], battery: &Battery) -> [f64; 3] {
    let stands: Vec<&Assessment> = every(tests, BAND_STRIDE).collect();
    let accepted: Vec<[Option<bool>; 3]> = stands
        .par_iter()
        .map(|test| {
            let values = test.tested.as_ref();
            let found = values.and_then(|v| battery.assess(v).ok());
            found.map_or([None; 3], |found| {
                found.map(|t| Some(t.p_value.value > LEVEL))
            })
        })
        .collect();
    [0, 1, 2].map(|k: usize| {
        let decided: Vec<bool> =
            accepted.iter().filter_map(|a| a[k]).collect();
        let yes = decided.iter().filter(|a| **a).count();
        yes as f64 / decided.len() as f64
    })
}
