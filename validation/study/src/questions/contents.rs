//! How do FEMA P-58's overturning fragilities of contents compare with those
//! of blocks of the same size?

use libm::{exp, log};
use rocking::units::STANDARD_GRAVITY_M_S2;

use super::answer::{Rows, StudyAnswer, number, word};
use crate::analyses::SuiteResults;
use crate::contents::{Furnishing, items};
use crate::estimates::{LEVEL, mean};
use crate::fits::of_intervals;
use crate::inference::{Resample, Resamples};
use crate::results::StudyResults;
use crate::runs::overturning;
use crate::words::{caption, heading};
use rocking_common::paper::SuiteKind;
use rocking_common::words::{capital, range};
use rocking_draw::figures::{
    Chart, ChartAxis, ChartPanel, Figure, Mark, Series,
};
use rocking_statistics::{Estimate, Range};

/// Items of one depth, with which FEMA P-58's medians are read.
const BOOKCASES: usize = 5;

/// Median PGV in m/s at first overturning, and its dispersion: cells are
/// items, the median first.
struct ItemFits {
    suite: SuiteKind,
    found: Vec<Estimate>,
}

impl ItemFits {
    fn of(suite: &SuiteResults, draws: &Resamples) -> anyhow::Result<Self> {
        let mut known: Vec<Vec<(f64, f64)>> = Vec::new();
        for (item, curves) in items().iter().zip(&suite.contents) {
            let threshold = libm::tan(item.block()?.slenderness_rad());
            let of = |(curve, facts)| {
                let facts: &crate::facts::Facts = facts;
                let factor =
                    threshold * facts.velocity_ratio_s * STANDARD_GRAVITY_M_S2;
                let (low, high) = overturning(curve);
                (factor * low, factor * high)
            };
            known.push(curves.iter().zip(&suite.records).map(of).collect());
        }
        let kind = suite.kind;
        let of = |draw: Resample<'_>| -> Vec<f64> {
            let counts = draw.of(kind);
            let fitted = |known: &Vec<(f64, f64)>| {
                of_intervals(known, counts, 0.0)
                    .map_or([f64::NAN; 2], |f| [f.median(), f.dispersion()])
            };
            known.iter().flat_map(fitted).collect()
        };
        let measured = draws.smooth(kind.into(), &of);
        let limits = (Range::NotNegative, LEVEL);
        let found = draws.estimates(kind.into(), limits, &measured);
        Ok(Self { suite: kind, found })
    }

    fn median_m_s(&self, item: usize) -> f64 {
        self.found[2 * item].value()
    }

    fn dispersion(&self, item: usize) -> f64 {
        self.found[2 * item + 1].value()
    }

    fn interval_m_s(&self, item: usize) -> (f64, f64) {
        self.found[2 * item].ends()
    }

    /// Our median over FEMA P-58's, by item.
    fn ratios(&self) -> Vec<f64> {
        let theirs = items().iter().enumerate();
        theirs.map(|(k, item)| self.median_m_s(k) / item.median_m_s).collect()
    }
}

/// A median velocity over g depth/height: seconds.
fn scaled_s(item: &Furnishing, median_m_s: f64) -> f64 {
    let ratio = item.depth_m() / item.height_m();
    median_m_s / (STANDARD_GRAVITY_M_S2 * ratio)
}

pub(super) fn answer(
    results: &StudyResults,
    draws: &Resamples,
) -> anyhow::Result<StudyAnswer> {
    let [ordinary, pulse] = results.suites();
    let ours = [ItemFits::of(ordinary, draws)?, ItemFits::of(pulse, draws)?];
    let mut table = Rows::default();
    for (k, item) in items().iter().enumerate() {
        let block = item.block()?;
        let [(a, b), (c, d)] = ours.each_ref().map(|one| one.interval_m_s(k));
        table.row(vec![
            ("fema_p58", word(&item.id)),
            ("item", word(&item.item)),
            ("depth_m", number(item.depth_m(), 3)),
            ("height_m", number(item.height_m(), 3)),
            ("alpha_rad", number(block.slenderness_rad(), 3)),
            ("p_rad_s", number(block.frequency_rad_s(), 2)),
            ("fema_median_m_s", number(item.median_m_s, 3)),
            ("fema_dispersion", number(item.dispersion, 1)),
            ("ordinary_median_m_s", number(ours[0].median_m_s(k), 3)),
            ("ordinary_low", number(a, 3)),
            ("ordinary_high", number(b, 3)),
            ("ordinary_dispersion", number(ours[0].dispersion(k), 2)),
            ("pulse_type_median_m_s", number(ours[1].median_m_s(k), 3)),
            ("pulse_type_low", number(c, 3)),
            ("pulse_type_high", number(d, 3)),
            ("pulse_type_dispersion", number(ours[1].dispersion(k), 2)),
        ]);
    }
    let answer = table.answer("contents", words(&ours));
    Ok(StudyAnswer { figures: vec![figure(&ours)], ..answer })
}

fn words(ours: &[ItemFits; 2]) -> String {
    let compared = ours.each_ref().map(|one| {
        let ratios = one.ratios();
        let (least, most) = range(ratios.iter().copied());
        let logs: Vec<f64> = ratios.iter().map(|r| log(*r)).collect();
        format!(
            "{} motions: our median PGV over FEMA P-58's is {:.2} (geometric \
             mean of nine items; {least:.2} to {most:.2}); of the bookcases \
             {:.2} for the lowest and {:.2} for the highest",
            capital(one.suite.name()),
            exp(mean(logs.iter().copied())),
            ratios[0],
            ratios[BOOKCASES - 1],
        )
    });
    let cabinets = items().iter().skip(BOOKCASES);
    let (c, d) = range(cabinets.map(|i| scaled_s(i, i.median_m_s)));
    let bookcases = || items().iter().take(BOOKCASES).enumerate();
    let (a, b) = range(bookcases().map(|(_, i)| scaled_s(i, i.median_m_s)));
    let grown = ours.each_ref().map(|one| {
        let of = |(k, item)| scaled_s(item, one.median_m_s(k));
        let all: Vec<f64> = bookcases().map(of).collect();
        format!(
            "{:.3} to {:.3} s under {} motions",
            all[0],
            all[BOOKCASES - 1],
            one.suite
        )
    });
    format!(
        "{}. FEMA P-58's five bookcases have medians of {a:.3} to {b:.3} s \
         times g depth/height, whatever their size, its four cabinets {c:.3} \
         to {d:.3} s. Ours go from the lowest bookcase to the highest from \
         {}.",
        compared.join(". "),
        grown.join(", and from "),
    )
}

fn figure(ours: &[ItemFits; 2]) -> Figure {
    let all: Vec<usize> = (0..items().len()).collect();
    let shelves: Vec<usize> = (0..BOOKCASES).collect();
    let panel = |title: &str,
                 of: &[usize],
                 x: (ChartAxis, fn(&Furnishing) -> f64),
                 y: (ChartAxis, fn(&Furnishing, f64) -> f64)| {
        let places: Vec<f64> = of.iter().map(|k| x.1(&items()[*k])).collect();
        let mark = Mark::Points;
        let mut series = Vec::new();
        for (label, kind) in [("bookcases", true), ("cabinets", false)] {
            let own: Vec<&Furnishing> = of
                .iter()
                .filter(|k| (**k < BOOKCASES) == kind)
                .map(|k| &items()[*k])
                .collect();
            if !own.is_empty() {
                series.push(Series::new(
                    format!("FEMA P-58, {label}"),
                    mark,
                    own.iter().map(|i| x.1(i)).collect(),
                    own.iter().map(|i| y.1(i, i.median_m_s)).collect(),
                ));
            }
        }
        for one in ours {
            let scaled = |k: &usize, v| y.1(&items()[*k], v);
            let ends = |k: &usize| {
                let (low, high) = one.interval_m_s(*k);
                (scaled(k, low), scaled(k, high))
            };
            let medians = of.iter().map(|k| scaled(k, one.median_m_s(*k)));
            let label = format!("blocks, {} motions", one.suite);
            let own =
                Series::new(label, mark, places.clone(), medians.collect());
            series.push(own.with(of.iter().map(ends).collect()));
        }
        ChartPanel { title: title.into(), x: x.0, y: y.0, series }
    };
    let axis = |label: &str, ends: (f64, f64)| ChartAxis::linear(label, ends);
    let scaled = "median *PGV* / (*g* depth/height) (s)";
    let panels = vec![
        panel(
            "Bookcases of 0.32 m depth",
            &shelves,
            (axis("height (m)", (0.5, 2.3)), Furnishing::height_m),
            (axis("median *PGV* (m/s)", (0.0, 1.2)), |_, v| v),
        ),
        panel(
            "All nine items",
            &all,
            (
                axis("half diagonal (m)", (0.3, 1.1)),
                Furnishing::half_diagonal_m,
            ),
            (axis(scaled, (0.0, 0.4)), scaled_s),
        ),
    ];
    let heading = heading("contents");
    Chart { heading, panels, columns: 2 }.figure(caption("contents"))
}
