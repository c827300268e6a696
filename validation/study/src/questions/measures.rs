//! Which intensity measure tells overturning best? The dispersion of the
//! records' overturning intensities in each measure, over that in PGA.

use libm::log;
use rocking::intensity::IntensityMeasure;

use super::answer::{Answer, Rows, both, number, word};
use crate::analyses::no_arm;
use crate::analyses::{Facts, OWN_PERIODS, SuiteResults};
use crate::fits::of_intervals;
use crate::inference::{Draw, Draws, Replicated, at_once};
use crate::results::Results;
use crate::runs::overturning;
use rocking_common::paper::{
    BLOCKS, FREQUENCIES_RAD_S, SLENDERNESSES_RAD, SuiteKind, position,
};
use rocking_common::words::capital;
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Heading, Mark, Series,
};

const QUESTION: &str =
    "Is there an intensity measure that halves the dispersion of PGA?";

/// Positions in [`OWN_PERIODS`] of the average: p T from 1.0 to 5.6.
const AVERAGED: std::ops::Range<usize> = 2..8;

/// Slenderness that the page shows: 0.15 rad.
const SHOWN: usize = 2;

/// The measures that are compared for a frequency parameter, PGA first and
/// [`SPECTRAL`] last.
fn measures(p_rad_s: f64) -> Vec<IntensityMeasure> {
    let periods_s = OWN_PERIODS.map(|t| t / p_rad_s);
    let mut all = vec![
        IntensityMeasure::Pga,
        IntensityMeasure::Pgv,
        IntensityMeasure::Pgd,
        IntensityMeasure::Arias,
        IntensityMeasure::Cav,
        IntensityMeasure::PgvDuration,
        IntensityMeasure::AverageSa(periods_s[AVERAGED].to_vec()),
    ];
    all.extend(periods_s.map(IntensityMeasure::Sa));
    all
}

/// Places among [`measures`].
const PGA: usize = 0;
const PGV: usize = 1;
const AVERAGE: usize = 6;
const SPECTRAL: std::ops::Range<usize> = 7..7 + OWN_PERIODS.len();
const COUNT: usize = SPECTRAL.end;

/// The name of a measure, its periods over p.
fn name(place: usize) -> String {
    let names = [
        "PGA",
        "PGV",
        "PGD",
        "root of Arias intensity",
        "CAV",
        "PGV D5-75^(1/4)",
    ];
    let at = |k: usize| format!("{:.1}/p", OWN_PERIODS[k]);
    let (first, last) = (AVERAGED.start, AVERAGED.end - 1);
    match names.get(place) {
        Some(name) => (*name).to_owned(),
        None if place == AVERAGE => {
            format!("average SA, T = {} to {}", at(first), at(last))
        }
        None => format!("SA, T = {}", at(place - SPECTRAL.start)),
    }
}

/// Values over the PGA of each of [`measures`] for a record.
fn over_pga(facts: &Facts, frequency: usize) -> Vec<f64> {
    let p_rad_s = FREQUENCIES_RAD_S[frequency];
    let mut measured = facts.measures.clone();
    measured.spectral_acceleration_g = facts.own_spectra_g[frequency].clone();
    let periods_s = OWN_PERIODS.map(|t| t / p_rad_s);
    let of = |measure: IntensityMeasure| {
        let value = measure.value(&measured, &periods_s).unwrap_or(f64::NAN);
        let root = if measure.is_squared() { value.sqrt() } else { value };
        root / facts.pga_g
    };
    measures(p_rad_s).into_iter().map(of).collect()
}

/// Dispersions of the first overturning of one suite: cells are blocks, then
/// measures.
struct Dispersions {
    suite: SuiteKind,
    measured: Replicated,
}

impl Dispersions {
    fn of(
        results: &Results,
        suite: &SuiteResults,
        draws: &Draws,
    ) -> anyhow::Result<Self> {
        let curves = suite.curves(results.plan.common());
        let curves = curves.ok_or_else(no_arm)?;
        // By block and measure, then by record: what is known of the
        // intensity at first overturning.
        let mut cells: Vec<Vec<(f64, f64)>> = Vec::new();
        for (at, curves) in curves.iter().enumerate() {
            let frequency = at / SLENDERNESSES_RAD.len();
            let factors: Vec<Vec<f64>> = suite
                .records
                .iter()
                .map(|facts| over_pga(facts, frequency))
                .collect();
            for place in 0..COUNT {
                let of = |(curve, factors): (_, &Vec<f64>)| {
                    let (low, high) = overturning(curve);
                    (factors[place] * low, factors[place] * high)
                };
                cells.push(curves.iter().zip(&factors).map(of).collect());
            }
        }
        let kind = suite.kind;
        let logs: Vec<Vec<f64>> = cells
            .iter()
            .map(|known| known.iter().map(|(low, _)| log(*low)).collect())
            .collect();
        let of = |draw: Draw<'_>| -> Vec<f64> {
            let counts = draw.of(kind);
            let cells = cells.iter().zip(&logs);
            cells
                .map(|(known, logs)| dispersion(known, logs, counts))
                .collect()
        };
        let measured = draws.smooth(kind.into(), &of);
        Ok(Self { suite: kind, measured })
    }

    /// Dispersions over those in PGA, by block, then by measure.
    fn ratios(&self) -> Replicated {
        self.measured.map(|row| {
            let blocks = row.chunks(COUNT);
            let of = |block: &[f64]| -> Vec<f64> {
                block.iter().map(|x| x / block[PGA]).collect()
            };
            blocks.flat_map(of).collect()
        })
    }

    /// The same for one measure.
    fn ratios_of(&self, place: usize) -> Replicated {
        self.ratios()
            .map(|row| row.chunks(COUNT).map(|block| block[place]).collect())
    }

    /// The spectral acceleration that has the least dispersion for a block.
    fn best(&self, block: usize) -> usize {
        let at = |place: &usize| self.measured.point(block * COUNT + place);
        let least = SPECTRAL.min_by(|a, b| at(a).total_cmp(&at(b)));
        least.unwrap_or(SPECTRAL.start)
    }
}

/// Dispersion of the lognormal of most likelihood for the records drawn so
/// often, NaN where there is none: the standard deviation of the logarithms
/// if all of them overturned.
fn dispersion(known: &[(f64, f64)], logs: &[f64], counts: &[u32]) -> f64 {
    let drawn = || counts.iter().enumerate().filter(|(_, n)| **n > 0);
    if drawn().any(|(i, _)| known[i].1.is_infinite()) {
        let fitted = of_intervals(known, counts, 0.0);
        return fitted.map_or(f64::NAN, |f| f.dispersion());
    }
    let sum = |f: &dyn Fn(f64) -> f64| {
        drawn().fold(0.0, |sum, (i, n)| sum + f64::from(*n) * f(logs[i]))
    };
    let count = sum(&|_| 1.0);
    let centre = sum(&|y| y) / count;
    (sum(&|y| (y - centre) * (y - centre)) / count).sqrt()
}

/// No interval.
const NONE: (f64, f64) = (f64::NAN, f64::NAN);

pub(super) fn answer(
    results: &Results,
    draws: &Draws,
) -> anyhow::Result<Answer> {
    let found = both(results)
        .map(|suite| Dispersions::of(results, suite, draws))
        .into_iter()
        .collect::<Result<Vec<_>, _>>()?;
    let words: Vec<String> = found.iter().map(|f| words(f, draws)).collect();
    let mut table = Rows::default();
    for one in &found {
        rows(one, draws, &mut table);
    }
    let answer = table.answer(
        "measures",
        QUESTION,
        words.join(" "),
        "Dispersion of the overturning intensity by intensity measure",
        "Dispersion is that of the lognormal of most likelihood, unshifted; a \
         record that never overturned counts as censored. SA has 5 % damping. \
         Intervals are the central 95 % of 2000 draws of the earthquakes, \
         the same for all rows, of one row at a time; the counts of the \
         answer are by limits that hold for all blocks at once, which are \
         wider. \
         Shown: alpha = 0.15, and of the single periods the one of least \
         dispersion.",
    );
    Ok(Answer { figures: vec![figure(&found, draws)], ..answer })
}

fn words(found: &Dispersions, draws: &Draws) -> String {
    let by_p = |value: &dyn Fn(usize) -> String| {
        let all = [0, 1, 2].map(|f| value(position(f, SHOWN)));
        format!("{}, {} and {}", all[0], all[1], all[2])
    };
    let ratios = found.ratios();
    let ratio = |block: usize, place: usize| {
        format!("{:.2}", ratios.point(block * COUNT + place))
    };
    let single = |block: usize| {
        let best = found.best(block);
        let period = OWN_PERIODS[best - SPECTRAL.start];
        format!("{} (T = {period:.1}/p)", ratio(block, best))
    };
    let clause = |place: usize, limit: f64, less: &str, more: &str| {
        let ratios = found.ratios_of(place);
        let (inside, outside) =
            at_once(draws, found.suite.into(), limit, &ratios);
        format!(
            "{less} for {inside} and {more} for {outside}, {} open",
            BLOCKS.len() - inside - outside
        )
    };
    format!(
        "{} motions, alpha = {:.2}, p = 1, 3 and 4 rad/s: of the dispersion \
         of PGA, the {} has {}; PGV has {}; the best single period has {}. \
         Of all {} blocks at once it is shown that this average has {}; that \
         PGV has {}.",
        capital(found.suite.name()),
        SLENDERNESSES_RAD[SHOWN],
        name(AVERAGE),
        by_p(&|block| ratio(block, AVERAGE)),
        by_p(&|block| ratio(block, PGV)),
        by_p(&single),
        BLOCKS.len(),
        clause(AVERAGE, 0.5, "less than half", "half or more"),
        clause(PGV, 1.0, "less than all", "as much or more"),
    )
}

fn rows(found: &Dispersions, draws: &Draws, table: &mut Rows) {
    let suite = found.suite.into();
    let own = found.measured.percentiles(draws, suite);
    let ratios = found.ratios();
    let of_ratios = ratios.percentiles(draws, suite);
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        for (slenderness, alpha) in SLENDERNESSES_RAD.iter().enumerate() {
            let block = position(frequency, slenderness);
            for place in 0..COUNT {
                let at = block * COUNT + place;
                let (low, high) = own[at].unwrap_or(NONE);
                let (from, to) = of_ratios[at].unwrap_or(NONE);
                let shown = slenderness == SHOWN
                    && (!SPECTRAL.contains(&place)
                        || place == found.best(block));
                table.row_if(
                    shown,
                    vec![
                        ("suite", word(found.suite.name())),
                        ("p_rad_s", number(*p, 0)),
                        ("alpha_rad", number(*alpha, 2)),
                        ("measure", word(name(place))),
                        ("dispersion", number(found.measured.point(at), 3)),
                        ("dispersion_low", number(low, 3)),
                        ("dispersion_high", number(high, 3)),
                        ("ratio_to_pga", number(ratios.point(at), 2)),
                        ("ratio_low", number(from, 2)),
                        ("ratio_high", number(to, 2)),
                    ],
                );
            }
        }
    }
}

/// Dispersion against p T, for alpha = 0.15.
fn figure(found: &[Dispersions], draws: &Draws) -> Figure {
    let ends = (OWN_PERIODS[0], OWN_PERIODS[OWN_PERIODS.len() - 1]);
    let mut panels = Vec::new();
    for one in found {
        let intervals = one.measured.percentiles(draws, one.suite.into());
        for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
            let at = |place| position(frequency, SHOWN) * COUNT + place;
            let flat = |place, label: &str, mark, x: (f64, f64)| {
                let y = one.measured.point(at(place));
                Series::new(label, mark, vec![x.0, x.1], vec![y, y])
            };
            let averaged =
                (OWN_PERIODS[AVERAGED.start], OWN_PERIODS[AVERAGED.end - 1]);
            let bars = SPECTRAL.map(|k| intervals[at(k)].unwrap_or(NONE));
            panels.push(ChartPanel {
                title: format!("{}, *p* = {p} rad/s", one.suite),
                x: ChartAxis::logarithmic("*p T*", ends),
                y: ChartAxis::linear("dispersion", (0.0, 1.2)),
                series: vec![
                    flat(PGA, "*PGA*", Mark::Dashed, ends),
                    flat(PGV, "*PGV*", Mark::Line, ends),
                    Series::new(
                        "*SA*(*T*), with its 95 % interval",
                        Mark::LineAndPoints,
                        OWN_PERIODS.to_vec(),
                        SPECTRAL.map(|k| one.measured.point(at(k))).collect(),
                    )
                    .with(bars.collect()),
                    flat(
                        AVERAGE,
                        "average *SA*, as long as its periods",
                        Mark::Line,
                        averaged,
                    ),
                ],
            });
        }
    }
    let heading = Heading::new(
        "figure-measures",
        "Dispersion of the overturning intensity by intensity measure",
        "Dispersion of the spectral acceleration at first overturning \
         against period times p, with those of PGA, PGV and an average \
         spectral acceleration as lines; alpha = 0.15; ordinary and \
         pulse-type suites, p = 1, 3 and 4 rad/s.",
    );
    let least: Vec<String> = found
        .iter()
        .map(|one| {
            let ratio = one.ratios_of(AVERAGE);
            let at = |f| ratio.point(position(f, SHOWN));
            format!(
                "under {} motions {:.2}, {:.2} and {:.2}",
                one.suite,
                at(0),
                at(1),
                at(2)
            )
        })
        .collect();
    Chart { heading, panels, columns: 3 }.figure(format!(
        "alpha = 0.15. The average spectral acceleration has, of the \
         dispersion of PGA, {} at p = 1, 3 and 4 rad/s.",
        least.join(", ")
    ))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_ways_to_a_dispersion_agree() {
        let known = [1.0, 1.5, 2.0, 4.0, 7.0].map(|x| (x, x));
        let logs = known.map(|(x, _)| log(x));
        let counts = [2, 0, 1, 3, 1];
        let drawn = [1.0, 1.0, 2.0, 4.0, 4.0, 4.0, 7.0].map(|x| (x, x));
        let fit = of_intervals(&drawn, &[1; 7], 0.0).unwrap();
        let found = dispersion(&known, &logs, &counts);
        assert!((found / fit.dispersion() - 1.0).abs() < 1e-12, "{found}");
        // A censored record counts by what is known of it, not as reached.
        let mut censored = known;
        censored[4].1 = f64::INFINITY;
        assert!(dispersion(&censored, &logs, &counts) > found);
        let without = [2, 0, 1, 3, 0];
        let same = dispersion(&known, &logs, &without);
        assert_eq!(dispersion(&censored, &logs, &without), same);
    }
}
