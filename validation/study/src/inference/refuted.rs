//! Which of many cells are shown to lie outside their region, all of them at
//! once.

use rayon::prelude::*;
use rocking::statistics::normal;

use super::draws::REPLICATES;
use super::draws::{Replicated, Scheme};
use super::known::Ends;
use super::known::{Caution, Known, p_value};
use super::rule::{FAMILY, LEVEL};
use rocking_common::findings::{Interval, Region};
use rocking_common::paper::Verdict;

/// Replicates beyond a limit that resolve it.
const LEAST_BEYOND: f64 = 5.0;

/// The cells that are shown to lie outside, with their simultaneous limits,
/// and the smallest adjusted p-value.
pub(super) struct Refuted {
    pub(super) ends: Vec<Option<Ends>>,
    pub(super) p: f64,
}

/// Refutes cells with a family-wise error of [`FAMILY`]: at most that is the
/// probability that any cell is refuted although it lies in the region.
///
/// By Holm's steps over the cells' own limits where draws resolve these: exact
/// ones, and those of a bootstrap of 20 cells or fewer. Of more cells by the
/// largest studentized deviation over them, stepwise (Romano and Wolf,
/// Econometrica 73 (2005) 1237), ratios on the scale of their logarithm.
/// Cells that are `shown` to lie inside cannot be refuted and leave the
/// maximum (Romano, Shaikh and Wolf, Econometrica 82 (2014) 1979).
pub(super) fn refuted(
    known: &Known<'_>,
    region: Region,
    shown: &[bool],
    caution: Caution,
) -> Refuted {
    // Draws beyond the limit of the first step.
    let beyond = FAMILY / shown.len() as f64 * REPLICATES as f64;
    match known.measured.scheme {
        Scheme::Bootstrap if beyond < LEAST_BEYOND => {
            by_maximum(known, region, shown, caution)
        }
        _ => by_holm(known, region, shown, caution),
    }
}

/// Holm's steps over the cells' own one-sided limits.
fn by_holm(
    known: &Known<'_>,
    region: Region,
    shown: &[bool],
    caution: Caution,
) -> Refuted {
    let count = shown.len();
    let outside =
        |k: &usize| !shown[*k] && !region.holds(known.measured.points[*k]);
    let p_of = |k: usize| {
        p_value(|level| known.drawn(k, level), region, Verdict::NotConfirmed)
    };
    let mut all: Vec<(f64, usize)> =
        (0..count).filter(outside).map(|k| (p_of(k), k)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut ends = vec![None; count];
    for (rank, (_, k)) in all.iter().enumerate() {
        let level = 1.0 - 2.0 * FAMILY / (count - rank) as f64;
        let found = known
            .drawn(*k, level)
            .filter(|e| e.verdict(region, caution) == Verdict::NotConfirmed);
        let Some(found) = found else { break };
        let way = match found.way {
            Interval::Exact => Interval::ExactSimultaneous,
            Interval::Subsampling => Interval::Subsampling,
            _ => Interval::Simultaneous,
        };
        ends[*k] = Some(Ends { way, ..found });
    }
    let p = all.first().map_or(1.0, |(p, _)| p * count as f64);
    Refuted { ends, p: if p < 1.0 { p } else { 1.0 } }
}

/// The scale on which cells are compared.
#[derive(Clone, Copy)]
struct Scale {
    ratio: bool,
    region: Region,
}

impl Scale {
    fn of(region: Region) -> Self {
        // A region between positive ends is one of ratios.
        let ratio = matches!(region, Region::Within(a, _) if a > 0.0);
        Self { ratio, region }
    }

    fn on(self, x: f64) -> f64 {
        if self.ratio { libm::log(x) } else { x }
    }

    fn back(self, y: f64) -> f64 {
        if self.ratio { libm::exp(y) } else { y }
    }

    /// How far beyond the region's nearest end.
    fn beyond(self, y: f64) -> f64 {
        match self.region {
            Region::Within(a, b) => {
                let (over, under) = (y - self.on(b), self.on(a) - y);
                if over > under { over } else { under }
            }
            Region::Below(limit) => y - limit,
            Region::Above(limit) => limit - y,
        }
    }

    /// A deviation towards the outside.
    fn outwards(self, by: f64) -> f64 {
        match self.region {
            Region::Within(..) => by.abs(),
            Region::Below(_) => by,
            Region::Above(_) => -by,
        }
    }
}

fn by_maximum(
    known: &Known<'_>,
    region: Region,
    shown: &[bool],
    caution: Caution,
) -> Refuted {
    let scale = Scale::of(region);
    let points = &known.measured.points;
    let mut ends = vec![None; points.len()];
    let none = |ends| Refuted { ends, p: 1.0 };
    let mut active: Vec<(usize, f64)> = (0..points.len())
        .filter(|k| !shown[*k])
        .filter_map(|k| Some((k, spread(known.measured, k, scale)?)))
        .collect();
    let studentized =
        |(k, s): &(usize, f64)| scale.beyond(scale.on(points[*k])) / s;
    if !active.iter().any(|cell| studentized(cell) > 0.0) {
        return none(ends);
    }
    // Student's t and the bias of the variance of few earthquakes.
    let wider =
        known.clusters.half_width(LEVEL) / normal::quantile(0.5 + 0.5 * LEVEL);
    let mut p = 1.0;
    loop {
        let mut largest = known
            .measured
            .replicates
            .par_iter()
            .map(|row| {
                let of = |(k, s): &(usize, f64)| {
                    let by = scale.on(row[*k]) - scale.on(points[*k]);
                    wider * scale.outwards(by) / s
                };
                active
                    .iter()
                    .map(of)
                    .filter(|x| x.is_finite())
                    .fold(0.0, |most, x| if x > most { x } else { most })
            })
            .collect::<Vec<f64>>();
        largest.sort_by(f64::total_cmp);
        let count = largest.len() as f64;
        let error = (FAMILY * (1.0 - FAMILY) / count).sqrt();
        let at = 1.0 - FAMILY + caution.errors() * error;
        let place = (at * count).ceil() as usize;
        let critical = largest[place.clamp(1, largest.len()) - 1];
        if p == 1.0 {
            let top = active.iter().map(studentized).fold(0.0, f64::max);
            let beyond = largest.partition_point(|x| *x < top);
            p = (1.0 + count - beyond as f64) / (1.0 + count);
        }
        let (out, left): (Vec<_>, Vec<_>) =
            active.iter().partition(|cell| studentized(cell) > critical);
        for (k, s) in &out {
            let y = scale.on(points[*k]);
            ends[*k] = Some(Ends {
                low: scale.back(y - critical * s),
                high: scale.back(y + critical * s),
                errors: (0.0, 0.0),
                range: (f64::NEG_INFINITY, f64::INFINITY),
                way: Interval::Simultaneous,
            });
        }
        if out.is_empty() || left.is_empty() {
            return Refuted { ends, p };
        }
        active = left;
    }
}

/// Standard deviation of a cell over the replicates; none where no replicate
/// moves it, which shows no certainty, or one in ten has no value.
fn spread(measured: &Replicated, k: usize, scale: Scale) -> Option<f64> {
    let rows = &measured.replicates;
    let values: Vec<f64> = rows
        .iter()
        .map(|row| scale.on(row[k]))
        .filter(|x| x.is_finite())
        .collect();
    let count = values.len() as f64;
    let enough = 10 * values.len() > 9 * rows.len();
    let mean = values.iter().fold(0.0, |sum, x| sum + x) / count;
    let square =
        values.iter().fold(0.0, |sum, x| sum + (x - mean) * (x - mean));
    let s = (square / (count - 1.0)).sqrt();
    (enough && scale.on(measured.points[k]).is_finite() && s > 0.0)
        .then_some(s)
}
