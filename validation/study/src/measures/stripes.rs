//! Section 4, Figures 6, 7 and 9, and resurrections: measures on stripes of
//! equal intensity.

use libm::{log, tan};

use super::source::{self, Criterion, Found, Prepared, Source, block};
use crate::analyses::{StripeDemands, SuiteResults};
use crate::inference::{Cell, Draw, LEAST_DECIDING, Replicated};
use crate::results::Results;
use crate::stripes::{adjusted_slenderness, of_arm};
use rocking_common::findings::Tested;
use rocking_common::paper::{
    Arm, FREQUENCIES_RAD_S, REFERENCE, SLENDERNESSES_RAD, STRIPES, SuiteKind,
    closed_form, position,
};
use rocking_statistics::Proportion;
use rocking_statistics::resampling::Ranked;

/// Ratios of one cell of Figure 6, 7 or 9, by record.
struct Ratios {
    at: String,
    ranked: Ranked,
}

impl Ratios {
    /// From two lists of demands; an overturned block has no demand.
    fn new(at: String, a: &[f64], b: &[f64], scale: f64) -> Self {
        let ratios = source::ratios(a, b, scale);
        Self { at, ranked: Ranked::new(&ratios) }
    }

    /// Whether the notch about the median of a replicate covers 1: McGill,
    /// Tukey and Larsen, Am. Stat. 32 (1978) 12.
    fn notch_covers_1(&self, counts: &[u32]) -> bool {
        let n = self.ranked.drawn(counts).len() as f64;
        let at = |p| self.ranked.quantile(counts, p);
        let half = 1.57 * (at(0.75) - at(0.25)) / n.sqrt();
        (at(0.5) - 1.0).abs() <= half
    }
}

/// A cell of Figures 6 and 7: block and stripe.
fn stripe_ratios(
    stripes: &StripeDemands,
    frequency: usize,
    slenderness: usize,
    scale: f64,
) -> Vec<Ratios> {
    let own = &stripes.demands[position(frequency, slenderness)];
    let reference = &stripes.demands[position(frequency, REFERENCE)];
    let name = block(frequency, slenderness);
    STRIPES
        .iter()
        .zip(own.iter().zip(reference))
        .map(|(im, (a, b))| {
            Ratios::new(format!("{name}, intensity {im}"), a, b, scale)
        })
        .collect()
}

/// Cells of Figure 9: frequency parameter and stripe; only records whose
/// adjusted slenderness is at most 0.25 (or above), if asked.
fn adjusted_ratios(
    source: &Source<'_>,
    stripes: &StripeDemands,
    part: Option<bool>,
) -> Vec<Ratios> {
    let records = &source.results.suite(source.kind()).records;
    let steepest = tan(SLENDERNESSES_RAD[SLENDERNESSES_RAD.len() - 1]);
    let mut out = Vec::new();
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        let scaled = &stripes.demands[position(frequency, REFERENCE)];
        let adjusted = &stripes.adjusted[frequency];
        for (im, (a, b)) in STRIPES.iter().zip(adjusted.iter().zip(scaled)) {
            let of_part: Vec<f64> = a
                .iter()
                .zip(records)
                .map(|(x, record)| {
                    let slender = record.pga_g <= im * steepest;
                    if part.is_none_or(|wanted| wanted == slender) {
                        *x
                    } else {
                        f64::NAN
                    }
                })
                .collect();
            let at = format!("p = {p}, intensity {im}");
            out.push(Ratios::new(at, &of_part, b, 1.0));
        }
    }
    out
}

/// Medians of cells over all draws, with the share of notches that cover 1.
fn medians(source: &Source<'_>, ratios: &[Ratios]) -> Prepared {
    let cells = ratios
        .iter()
        .map(|r| Cell { at: r.at.clone(), records: r.ranked.records() })
        .collect();
    let ranked = ratios.iter().map(|r| r.ranked.clone()).collect();
    let measured = source.draws.medians(source.kind(), ranked);
    let name = "share of the cells whose notch covers 1";
    let as_said = notches(source, ratios, name, |_| true);
    Prepared { criterion: Some(as_said), ..Prepared::new(cells, measured) }
}

/// The share of the deciding cells whose notch covers 1 where it has to, and
/// leaves 1 out where not.
fn notches(
    source: &Source<'_>,
    ratios: &[Ratios],
    name: &str,
    covers: impl Fn(&Ratios) -> bool + Sync,
) -> Criterion {
    let kind = source.kind();
    let enough = |r: &&Ratios| r.ranked.records() >= LEAST_DECIDING;
    let of = |draw: Draw<'_>| {
        let counts = draw.of(kind);
        let deciding = || ratios.iter().filter(enough);
        let as_said =
            deciding().filter(|r| r.notch_covers_1(counts) == covers(r));
        vec![as_said.count() as f64 / deciding().count() as f64]
    };
    let measured = source.draws.subsampled(source.tested, &of);
    Criterion { name: name.into(), measured }
}

/// Cells of Figures 6, 7 and 9 by name, with the median ratio once what the
/// small-rotation limit of Eq. 1 makes of it is divided out.
#[must_use]
pub fn without_closed_form(
    results: &Results,
    tested: Tested,
    arm: Arm,
) -> Vec<(String, f64)> {
    let kind = match tested {
        Tested::Ordinary => SuiteKind::Ordinary,
        Tested::PulseType => SuiteKind::PulseType,
        Tested::None | Tested::Both => return Vec::new(),
    };
    let suite = results.suite(kind);
    let Some(stripes) = of_arm(suite, arm) else { return Vec::new() };
    let mut cells = all_ratios(stripes, &[0, 1, 2], true);
    cells.extend(adjusted_without_closed_form(suite, stripes));
    let every = vec![1; suite.records.len()];
    let median = |r: Ratios| (r.at, r.ranked.median(&every));
    cells.into_iter().map(median).collect()
}

/// Cells of Figure 9, the closed form divided out record by record: each has
/// an adjusted slenderness of its own.
fn adjusted_without_closed_form(
    suite: &SuiteResults,
    stripes: &StripeDemands,
) -> Vec<Ratios> {
    let mut cells = Vec::new();
    for (frequency, p) in FREQUENCIES_RAD_S.iter().enumerate() {
        let scaled = &stripes.demands[position(frequency, REFERENCE)];
        let adjusted = &stripes.adjusted[frequency];
        for (im, (a, b)) in STRIPES.iter().zip(adjusted.iter().zip(scaled)) {
            let records = a.iter().zip(&suite.records);
            let left: Vec<f64> = records
                .map(|(x, r)| x / closed_form(adjusted_slenderness(r, *im)))
                .collect();
            let at = format!("p = {p}, intensity {im}");
            cells.push(Ratios::new(at, &left, b, 1.0));
        }
    }
    cells
}

/// The stripes of the source's suite and arm; none where they were not run.
fn stripes_of<'a>(source: &Source<'a>) -> Option<&'a StripeDemands> {
    of_arm(source.results.suite(source.kind()), source.arm)
}

/// Cells of Figures 6 and 7, if asked with the closed form divided out.
fn all_ratios(
    stripes: &StripeDemands,
    frequencies: &[usize],
    corrected: bool,
) -> Vec<Ratios> {
    let mut out = Vec::new();
    for frequency in frequencies {
        for (slenderness, alpha) in SLENDERNESSES_RAD.into_iter().enumerate() {
            if slenderness != REFERENCE {
                let scale =
                    if corrected { 1.0 / closed_form(alpha) } else { 1.0 };
                let own =
                    stripe_ratios(stripes, *frequency, slenderness, scale);
                out.extend(own);
            }
        }
    }
    out
}

/// The paper's exception: alpha = 0.25 on the lowest stripe, p = 1.
fn exception() -> String {
    let stocky = SLENDERNESSES_RAD.len() - 1;
    format!("{}, intensity {}", block(0, stocky), STRIPES[0])
}

/// Medians of Figures 6 and 7, without the paper's exception.
pub(super) fn ratios(source: &Source<'_>, frequencies: &[usize]) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let exception = exception();
    let mut cells = all_ratios(stripes, frequencies, false);
    cells.retain(|r| r.at != exception);
    Ok(Some(medians(source, &cells)))
}

/// The median of the paper's exception. By the paper's criterion it is the
/// only one: its notch leaves 1 out, and every other of p = 1 covers 1.
pub(super) fn only_exception(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let exception = exception();
    let all = all_ratios(stripes, &[0], false);
    let name = "share of the cells that come out as this sentence says";
    let as_said = notches(source, &all, name, |r| r.at != exception);
    let own: Vec<Ratios> =
        all.into_iter().filter(|r| r.at == exception).collect();
    let found = medians(source, &own);
    Ok(Some(Prepared { criterion: Some(as_said), ..found }))
}

/// How much more the records of smaller demands deviate than the others,
/// where the paper sees its exception: the median distance of the ratio from
/// 1 of the half with smaller demands over that of the other half.
pub(super) fn small_amplitudes(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let stocky = SLENDERNESSES_RAD.len() - 1;
    let demands =
        |s| stripes.demands[position(0, s)].first().map_or(&[][..], |d| d);
    let (own, reference) = (demands(stocky), demands(REFERENCE));
    let middle = Ranked::new(reference).median(&vec![1; reference.len()]);
    let half = |small: bool| {
        let ratios = source::ratios(own, reference, 1.0);
        let away = ratios.iter().zip(reference).map(|(ratio, demand)| {
            if (*demand < middle) == small {
                (ratio - 1.0).abs()
            } else {
                f64::NAN
            }
        });
        Ranked::new(&away.collect::<Vec<f64>>())
    };
    let (small, large) = (half(true), half(false));
    let kind = source.kind();
    let records = small.records() + large.records();
    Ok(Some(source.value(&exception(), records, move |draw| {
        let counts = draw.of(kind);
        small.median(counts) / large.median(counts)
    })))
}

/// Medians of Figures 6 and 7, the closed form divided out.
pub(super) fn corrected(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    Ok(Some(medians(source, &all_ratios(stripes, &[0, 1, 2], true))))
}

/// Medians of Figure 9, the closed form divided out record by record.
pub(super) fn adjusted_corrected(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let suite = source.results.suite(source.kind());
    let cells = adjusted_without_closed_form(suite, stripes);
    Ok(Some(medians(source, &cells)))
}

/// Medians of Figure 9: all records, or those of one side of the paper's
/// largest slenderness.
pub(super) fn adjusted(source: &Source<'_>, part: Option<bool>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    Ok(Some(medians(source, &adjusted_ratios(source, stripes, part))))
}

pub(super) fn again_by_size(source: &Source<'_>) -> Found {
    let large = |f: usize, _: usize| Some(f == 0);
    again_apart(source, "p = 1 minus p = 3 and 4", large)
}

pub(super) fn again_by_slenderness(source: &Source<'_>) -> Found {
    let at = "alpha = 0.20 and 0.25 minus 0.05 and 0.10";
    again_apart(source, at, |_, s| (s != 2).then_some(s > 2))
}

/// Share of the ratios of all cells that lie more than 10 % from 1.
pub(super) fn outliers(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let ratios = all_ratios(stripes, &[0, 1, 2], false);
    let kind = source.kind();
    let n = source.results.suite(kind).records.len();
    let mut far = vec![0_u32; n];
    let mut all = vec![0_u32; n];
    for (x, record) in ratios.iter().flat_map(|r| r.ranked.each()) {
        all[record] += 1;
        far[record] += u32::from((x - 1.0).abs() > 0.10);
    }
    let at = "ratios further than 10 % from 1";
    Ok(Some(source.share(at, far, all)))
}

/// By block and stripe, the share of the records that overturned at or below
/// and stand there again.
pub(super) fn probabilities(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let (mut cells, mut counts) = (Vec::new(), Vec::new());
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            let own = &stripes.stands_again[position(frequency, slenderness)];
            let name = block(frequency, slenderness);
            for (im, flags) in STRIPES.iter().zip(own) {
                let records = flags.len();
                let again = flags.iter().filter(|again| **again).count();
                counts.push(Proportion::try_new(again, records)?);
                let at = format!("{name}, intensity {im}");
                cells.push(Cell { at, records });
            }
        }
    }
    let measured = Replicated::counted(counts);
    Ok(Some(Prepared::new(cells, measured)))
}

/// By block, the intensity at which half of the records lie overturned, with
/// resurrections over without; by interpolation in the logarithm of the
/// intensity between stripes.
pub(super) fn median_again(source: &Source<'_>) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let kind = source.kind();
    let mut cells = Vec::new();
    let mut blocks = Vec::new();
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            let at = position(frequency, slenderness);
            cells.push(Cell {
                at: block(frequency, slenderness),
                records: stripes.stands_again[at].first().map_or(0, Vec::len),
            });
            blocks.push(at);
        }
    }
    let half = |counts: &[u32], lies: &dyn Fn(usize, usize) -> bool| -> f64 {
        let n = f64::from(counts.iter().sum::<u32>());
        let mut below: Option<(f64, f64)> = None;
        for (stripe, im) in STRIPES.iter().enumerate() {
            let overturned: u32 = (0..counts.len())
                .filter(|record| lies(stripe, *record))
                .map(|record| counts[record])
                .sum();
            let share = f64::from(overturned) / n;
            if share >= 0.5 {
                let (x0, y0) = below.unwrap_or((0.0, 0.0));
                let (x1, y1) = (log(*im), share);
                return x0 + (x1 - x0) * (0.5 - y0) / (y1 - y0);
            }
            below = Some((log(*im), share));
        }
        f64::NAN
    };
    let of = |draw: Draw<'_>| -> Vec<f64> {
        let counts = draw.of(kind);
        let ratio = |at: &usize| {
            let demands = &stripes.demands[*at];
            let again = &stripes.stands_again[*at];
            let used = demands.len();
            let first = |stripe: usize, record: usize| {
                stripe < used && demands[stripe][record].is_infinite()
            };
            let lies = |stripe: usize, record: usize| {
                first(stripe, record) && !again[stripe][record]
            };
            libm::exp(half(counts, &lies) - half(counts, &first))
        };
        blocks.iter().map(ratio).collect()
    };
    let measured = source.draws.smooth(source.tested, &of);
    Ok(Some(Prepared::new(cells, measured)))
}

/// Share of the overturned that stand again, of the blocks that are `first`
/// minus that of those that are not.
fn again_apart(
    source: &Source<'_>,
    at: &str,
    first: impl Fn(usize, usize) -> Option<bool>,
) -> Found {
    let Some(stripes) = stripes_of(source) else { return Ok(None) };
    let kind = source.kind();
    let n = source.results.suite(kind).records.len();
    // By part, by record: overturned, and standing again.
    let mut sums = [[(); 2]; 2].map(|part| part.map(|()| vec![0_u32; n]));
    for frequency in 0..FREQUENCIES_RAD_S.len() {
        for slenderness in 0..SLENDERNESSES_RAD.len() {
            let Some(first) = first(frequency, slenderness) else {
                continue;
            };
            let part = usize::from(first);
            let at = position(frequency, slenderness);
            for (demands, again) in
                stripes.demands[at].iter().zip(&stripes.stands_again[at])
            {
                for record in 0..n {
                    sums[part][0][record] +=
                        u32::from(demands[record].is_infinite());
                    sums[part][1][record] += u32::from(again[record]);
                }
            }
        }
    }
    Ok(Some(source.value(at, n, |draw| {
        let sum = |of: &[u32]| counted(of, draw.of(kind));
        let share = |part: usize| sum(&sums[part][1]) / sum(&sums[part][0]);
        share(1) - share(0)
    })))
}

/// What the records drawn so often count together.
fn counted(of: &[u32], counts: &[u32]) -> f64 {
    f64::from(of.iter().zip(counts).map(|(x, n)| x * n).sum::<u32>())
}
