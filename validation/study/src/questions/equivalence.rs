//! What does an equivalence test say where the paper says "conforms to 1.0
//! with 95 % confidence"?

use rocking::capacity::InversionRule;
use rocking::statistics::boxplot::median_interval;
use rocking::statistics::paired::{
    Pairs, SignTest, equivalence, sign_equivalence,
};
use rocking::statistics::{Boxplot, ExtendedSample, QuantileType};

use super::answer::{Answer, Cell, Rows, count, number, word};
use crate::analyses::no_arm;
use crate::results::Results;
use crate::runs::capacities;
use crate::stripes::{of_arm, pairs};
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, LEAST_USABLE, REFERENCE, SLENDERNESSES_RAD,
    position,
};
use rocking_common::words::range;

/// Demands at which intensities are compared.
const DEMANDS: [f64; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// Margins of equivalence.
const MARGINS: [f64; 2] = [0.05, 0.10];

/// Level of the tests.
const LEVEL: f64 = 0.05;

/// Counts over cells: a slenderness on a stripe, or at a demand.
#[derive(Default)]
struct Counts {
    cells: usize,
    notch_covers: usize,
    interval_covers: usize,
    sign_accepts: usize,
    equivalent_mean: [usize; 2],
    equivalent_median: [usize; 2],
    discordant: usize,
    censored: usize,
    medians: Vec<f64>,
}

impl Counts {
    fn add(&mut self, pairs: &Pairs) -> anyhow::Result<()> {
        if pairs.ratios.len() < LEAST_USABLE {
            return Ok(());
        }
        let sample = ExtendedSample::try_new(&pairs.ratios)?;
        let boxplot = Boxplot::try_new(&sample, QuantileType::default())?;
        let count = |yes: bool| usize::from(yes);
        self.cells += 1;
        self.notch_covers +=
            count(boxplot.notch_low <= 1.0 && boxplot.notch_high >= 1.0);
        let covers = median_interval(&sample, 1.0 - LEVEL)
            .is_some_and(|i| i.low <= 1.0 && i.high >= 1.0);
        self.interval_covers += count(covers);
        let sign = SignTest::of(&pairs.ratios, 1.0);
        self.sign_accepts += count(sign.p_value > LEVEL);
        for (k, margin) in MARGINS.into_iter().enumerate() {
            // All ratios equal leave the mean's test without a spread.
            let mean = equivalence(&pairs.ratios, margin);
            self.equivalent_mean[k] +=
                count(mean.is_ok_and(|t| t.p_value < LEVEL));
            let median = sign_equivalence(&pairs.ratios, margin)?;
            self.equivalent_median[k] += count(median.p_value < LEVEL);
        }
        self.discordant += count(pairs.mcnemar().p_value < LEVEL);
        self.censored += pairs.only_a_infinite + pairs.only_b_infinite;
        self.medians.push(boxplot.median);
        Ok(())
    }
}

pub(super) fn answer(results: &Results) -> anyhow::Result<Answer> {
    let mut table = Rows::default();
    let mut words = Vec::new();
    for arm in results.plan.drawn() {
        for compared in
            [Compared::Demand, Compared::Intensity, Compared::Adjusted]
        {
            let mut total = Counts::default();
            for (frequency, p) in FREQUENCIES_RAD_S.into_iter().enumerate() {
                let mut counts = Counts::default();
                for pairs in compared.pairs(results, arm, frequency)? {
                    counts.add(&pairs)?;
                    total.add(&pairs)?;
                }
                table.row(cells(arm, compared, p, &counts));
            }
            words.push(format!(
                "Arm {}, {}: of {} medians the notch of {} and the exact 95 % interval \
                 of {} cover 1, but {} are equivalent to 1 within 5 % and {} \
                 within 10 % (median; by the mean {} and {}).",
                arm.letter(),
                compared.words(),
                total.cells,
                total.notch_covers,
                total.interval_covers,
                total.equivalent_median[0],
                total.equivalent_median[1],
                total.equivalent_mean[0],
                total.equivalent_mean[1],
            ));
        }
    }
    Ok(table.answer(
        "equivalence",
        "What does an equivalence test say where the paper says \"conforms to \
         1.0 with 95 % confidence\"?",
        words.join(" "),
        "Equality and equivalence of paired ratios",
        "A notch or interval that covers 1 fails to show a difference, and \
         the fewer records the easier; equivalence is shown by two \
         one-sided tests at 5 %, of the median (sign tests) and of the mean \
         of the logarithm (t tests). Cells with at least 10 usable ratios.",
    ))
}

fn cells(
    arm: Arm,
    compared: Compared,
    p: f64,
    c: &Counts,
) -> Vec<(&'static str, Cell)> {
    let (least, most) = range(c.medians.iter().copied());
    vec![
        ("arm", word(arm.letter())),
        ("compared", word(compared.words())),
        ("p_rad_s", number(p, 0)),
        ("cells", count(c.cells)),
        ("notch_covers_1", count(c.notch_covers)),
        ("exact_interval_covers_1", count(c.interval_covers)),
        ("sign_test_accepts_1", count(c.sign_accepts)),
        ("mean_equivalent_5_percent", count(c.equivalent_mean[0])),
        ("mean_equivalent_10_percent", count(c.equivalent_mean[1])),
        ("median_equivalent_5_percent", count(c.equivalent_median[0])),
        ("median_equivalent_10_percent", count(c.equivalent_median[1])),
        ("mcnemar_rejects", count(c.discordant)),
        ("pairs_with_one_infinite", count(c.censored)),
        ("least_median", number(least, 4)),
        ("largest_median", number(most, 4)),
    ]
}

/// What is paired.
#[derive(Clone, Copy)]
enum Compared {
    /// Demands on the stripes, over alpha = 0.10 (Figures 6 and 7).
    Demand,
    /// Intensities at given demand, over alpha = 0.10.
    Intensity,
    /// Demands on the stripes, adjusted over scaled (Figure 9).
    Adjusted,
}

impl Compared {
    fn words(self) -> &'static str {
        match self {
            Self::Demand => "demand at given intensity",
            Self::Intensity => "intensity at given demand",
            Self::Adjusted => "demand, slenderness adjusted over scaled",
        }
    }

    fn pairs(
        self,
        results: &Results,
        arm: Arm,
        frequency: usize,
    ) -> anyhow::Result<Vec<Pairs>> {
        let suite = &results.ordinary;
        let others = (0..SLENDERNESSES_RAD.len()).filter(|s| *s != REFERENCE);
        let mut out = Vec::new();
        let mut on_stripes = |slenderness| -> anyhow::Result<()> {
            if let Some(stripes) = of_arm(suite, arm) {
                let found = pairs(stripes, frequency, slenderness)?;
                out.extend(found.into_iter().map(|(_, pairs)| pairs));
            }
            Ok(())
        };
        match self {
            Self::Demand => {
                for slenderness in others {
                    on_stripes(Some(slenderness))?;
                }
            }
            Self::Adjusted => on_stripes(None)?,
            Self::Intensity => {
                let curves = suite.curves(arm).ok_or_else(no_arm)?;
                let of = |s| -> anyhow::Result<Vec<Vec<f64>>> {
                    curves[position(frequency, s)]
                        .iter()
                        .map(|curve| {
                            capacities(curve, &DEMANDS, InversionRule::Median)
                        })
                        .collect()
                };
                let reference = of(REFERENCE)?;
                for slenderness in others {
                    let own = of(slenderness)?;
                    for k in 0..DEMANDS.len() {
                        let [a, b] = [&own, &reference].map(|all| {
                            all.iter().map(|row| row[k]).collect::<Vec<_>>()
                        });
                        out.push(Pairs::try_new(&a, &b)?);
                    }
                }
            }
        }
        Ok(out)
    }
}
