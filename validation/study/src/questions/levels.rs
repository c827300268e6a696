//! Accepted shares of levels that share their records.

use rayon::prelude::*;
use rocking_statistics::acceptance::{AcceptedShare, NullBand};
use rocking_statistics::lilliefors::{Inapplicable, LillieforsTest};
use rocking_statistics::multiple::{benjamini_hochberg, holm};
use rocking_statistics::normality::Battery;

use super::answer::{Rows, StudyAnswer, TableCell, count, number, word};
use crate::estimates::mean;
use crate::normality::{
    BAND_STRIDE, LEVEL, accepted_share, ends, every, over_critical,
};
use crate::results::StudyResults;
use rocking_common::words::capital;

/// Replicates behind the critical values of the other tests.
const REPLICATES: u64 = 20_000;

pub(super) fn levels_part(results: &StudyResults) -> StudyAnswer {
    let mut table = Rows::default();
    let mut words = Vec::new();
    let batteries = results.suites().map(|suite| {
        Battery::simulate(suite.records.len(), REPLICATES, 0).ok()
    });
    for (suite, found) in results.common() {
        let battery = usize::from(suite.kind == results.pulse.kind);
        let battery = batteries[battery].as_ref();
        let mut low = [0_usize; 2];
        let mut shares: [Vec<f64>; 4] = Default::default();
        for block in &found.blocks {
            let samples =
                [("original", &block.original), ("shifted", &block.shifted)];
            for (shifted, (kind, tests)) in samples.into_iter().enumerate() {
                let row = LevelsRow::new(
                    tests,
                    block.bands[shifted].as_ref(),
                    battery,
                );
                low[shifted] += usize::from(row.p_of_share < LEVEL);
                if shifted == 1 {
                    let all = shares.iter_mut().zip(row.shares);
                    all.for_each(|(all, x)| all.push(x));
                }
                let mut cells = vec![
                    ("suite", word(suite.kind.name())),
                    ("im", word(found.intensity.name())),
                    ("sample", word(kind)),
                    ("p_rad_s", number(block.p_rad_s, 0)),
                    ("alpha_rad", number(block.alpha_rad, 2)),
                ];
                cells.extend(row.cells);
                table.row_if(shifted == 1, cells);
            }
        }
        let [d, a, w, s] = shares.map(mean);
        let [original, shifted] = low.map(|n| match n {
            0 => "none".to_owned(),
            n => n.to_string(),
        });
        let blocks = found.blocks.len();
        words.push(format!(
            "{}, {}: the accepted share is lower than lognormal \
             capacities with the same dependence between levels allow \
             (p < 0.05) for {original} of {blocks} original and {shifted} of \
             {blocks} shifted samples; mean accepted share of the shifted \
             ones {d:.2} by Lilliefors, {a:.2} by Anderson-Darling, {w:.2} \
             by Cramer-von Mises, {s:.2} by Shapiro-Wilk.",
            capital(suite.kind.name()),
            found.intensity.name().to_uppercase(),
        ));
    }
    table.answer("levels", words.join(" "))
}

/// One sample of a block: its cells, the p-value of its accepted share, and
/// that share by Lilliefors' test and by the others.
struct LevelsRow {
    cells: Vec<(&'static str, TableCell)>,
    p_of_share: f64,
    shares: [f64; 4],
}

impl LevelsRow {
    fn new(
        tests: &[LillieforsTest],
        band: Option<&NullBand>,
        battery: Option<&Battery>,
    ) -> Self {
        let with_step = |stride: usize| -> Vec<LillieforsTest> {
            every(tests, stride).cloned().collect()
        };
        let accepted = accepted_share(tests);
        let stands = with_step(BAND_STRIDE);
        let ratios = mean(stands.iter().map(over_critical));
        let p_values: Vec<f64> =
            tests.iter().filter_map(|t| Some(t.p_value?.value())).collect();
        let below = |adjusted: Vec<f64>| {
            count(adjusted.iter().filter(|p| **p <= LEVEL).count())
        };
        let counts = AcceptedShare::from_tests(tests);
        let tied = |t: &&LillieforsTest| {
            matches!(t.verdict, Err(Inapplicable::Ties { .. }))
        };
        let share = |x: f64| number(x, 3);
        let of_band =
            |of: &dyn Fn(&NullBand) -> f64| band.map_or(f64::NAN, of);
        let (low, high) = band.and_then(ends).unwrap_or((f64::NAN, f64::NAN));
        let p_of_share = of_band(&|b| b.p_value(accepted_share(&stands)));
        let p_of_mean = of_band(&|b| b.p_value_of_mean_ratio(ratios));
        let effective = of_band(&|b| b.effective_levels);
        let [a, w, s] = battery.map_or([f64::NAN; 3], |b| others(&stands, b));
        let cells = vec![
            ("accepted_share", share(accepted)),
            ("band_low", share(low)),
            ("band_high", share(high)),
            ("p_of_share", share(p_of_share)),
            ("p_of_mean_d", share(p_of_mean)),
            ("effective_levels", number(effective, 1)),
            ("rejected_plain", count(counts.tested - counts.accepted)),
            ("rejected_holm", below(holm(&p_values))),
            (
                "rejected_benjamini_hochberg",
                below(benjamini_hochberg(&p_values)),
            ),
            ("ties_decide", count(tests.iter().filter(tied).count())),
            ("share_step_0.01", share(accepted_share(&with_step(2)))),
            ("share_step_0.02", share(accepted_share(&with_step(4)))),
            ("share_step_0.05", share(accepted_share(&with_step(10)))),
            ("share_from_0.1", share(accepted_share(&tests[19..]))),
            ("accepted_anderson_darling", share(a)),
            ("accepted_cramer_von_mises", share(w)),
            ("accepted_shapiro_wilk", share(s)),
        ];
        Self { cells, p_of_share, shares: [accepted, a, w, s] }
    }
}

/// Accepted shares of Anderson-Darling, Cramer-von Mises and Shapiro-Wilk.
fn others(tests: &[LillieforsTest], battery: &Battery) -> [f64; 3] {
    let accepted: Vec<[Option<bool>; 3]> = tests
        .par_iter()
        .map(|test| {
            let values = test.tested.as_ref();
            let found = values.and_then(|v| battery.assess(v).ok());
            found.map_or([None; 3], |found| {
                found.map(|t| Some(t.p_value.value() > LEVEL))
            })
        })
        .collect();
    [0, 1, 2].map(|k: usize| {
        let share = accepted.iter().filter_map(|a| a[k]);
        mean(share.map(|accepted| f64::from(u8::from(accepted))))
    })
}
