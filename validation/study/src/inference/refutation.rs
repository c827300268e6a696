//! Which of many cells are shown to lie outside their region, all cells
//! considered at once.

use rocking_statistics::step_down::StepDown;
use rocking_statistics::{Interval, normal};

use super::draws::{Replicates, Scheme};
use super::intervals::{CellIntervals, Ends, p_value};
use rocking_common::findings::{ERROR, IntervalMethod, LEVEL, Region};
use rocking_common::paper::ClaimVerdict;

/// The cells that are shown to lie outside.
pub(super) struct Refutation {
    /// Whether each cell is.
    pub(super) out: Vec<bool>,
    /// The simultaneous limits of each cell whose value lies outside.
    pub(super) ends: Vec<Option<Ends>>,
    /// The level of each cell's own interval that gives such limits.
    pub(super) level: Vec<f64>,
    /// The smallest adjusted p-value.
    pub(super) p: f64,
}

impl Refutation {
    /// None of `count` cells.
    fn none(count: usize) -> Self {
        Self {
            out: vec![false; count],
            ends: vec![None; count],
            level: vec![LEVEL; count],
            p: 1.0,
        }
    }
}

/// Refutes cells with a family-wise error of [`ERROR`]: at most that is the
/// probability that any cell is refuted although it lies in the region.
///
/// By Holm's steps over the cells' own limits where these are exact or of
/// subsamples. By the largest studentized deviation over the cells, stepwise
/// (Romano and Wolf, Econometrica 73 (2005) 1237), where they are of a
/// bootstrap, ratios on the scale of their logarithm: the ends that Holm's
/// steps ask of a bootstrap lie among its last draws, and fall short of their
/// level (declared cases `family-on-the-edge`). Cells that are `shown` to lie
/// inside cannot be refuted and leave the maximum (Romano, Shaikh and Wolf,
/// Econometrica 82 (2014) 1979).
pub(super) fn refuted_cells(
    known: &CellIntervals<'_>,
    region: Region,
    shown: &[bool],
    caution: f64,
) -> Refutation {
    match known.measured.scheme {
        Scheme::Bootstrap => by_maximum(known, region, shown, caution),
        _ => by_holm(known, region, shown, caution),
    }
}

/// Holm's steps over the cells' own one-sided limits.
fn by_holm(
    known: &CellIntervals<'_>,
    region: Region,
    shown: &[bool],
    caution: f64,
) -> Refutation {
    let count = shown.len();
    let mut found = Refutation::none(count);
    let wanted = ClaimVerdict::NotConfirmed;
    let first = ERROR / count as f64;
    let p_of = |k: usize, caution| {
        let ends = |level| known.drawn(k, level);
        p_value(ends, region, wanted, first, caution)
    };
    let outside =
        |k: &usize| !shown[*k] && !region.holds(known.measured.points[*k]);
    let mut all: Vec<(f64, usize)> =
        (0..count).filter(outside).map(|k| (p_of(k, caution), k)).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut step = 0;
    for (rank, (_, k)) in all.iter().enumerate() {
        // Once a cell stays, so do all that follow.
        let open = step == rank;
        let level = 1.0 - 2.0 * ERROR / (count - step) as f64;
        let Some(ends) = known.drawn(*k, level) else { continue };
        let out = open && ends.verdict(region, caution) == wanted;
        let way = match ends.way {
            IntervalMethod::Exact => IntervalMethod::ExactSimultaneous,
            other => other,
        };
        step += usize::from(out);
        found.out[*k] = out;
        found.ends[*k] = Some(Ends { way, ..ends });
        found.level[*k] = level;
    }
    if let Some((p, k)) = all.first() {
        let p = if found.out[*k] { p_of(*k, 0.0) } else { *p };
        let adjusted = p * count as f64;
        found.p = if adjusted < 1.0 { adjusted } else { 1.0 };
    }
    found
}

/// The scale on which cells are compared.
#[derive(Clone, Copy)]
struct CellScale {
    ratio: bool,
    region: Region,
}

impl CellScale {
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
}

fn by_maximum(
    known: &CellIntervals<'_>,
    region: Region,
    shown: &[bool],
    caution: f64,
) -> Refutation {
    let scale = CellScale::of(region);
    let Replicates { points, replicates, .. } = known.measured;
    let count = points.len();
    let mut found = Refutation::none(count);
    let active: Vec<(usize, f64)> = (0..count)
        .filter(|k| !shown[*k])
        .filter_map(|k| Some((k, spread(known.measured, k, scale)?)))
        .collect();
    let statistics: Vec<f64> = active
        .iter()
        .map(|(k, s)| scale.beyond(scale.on(points[*k])) / s)
        .collect();
    if !statistics.iter().any(|x| *x > 0.0) {
        return found;
    }
    // Deviations to both sides: those to one side alone are too small where
    // a measure is skewed or ends there. Student's t and the bias of the
    // variance of few earthquakes.
    let wider = known.clusters.half_width(1.0 - ERROR)
        / normal::quantile(1.0 - 0.5 * ERROR);
    let deviation = |row: usize, place: usize| {
        let (k, s) = active[place];
        let by = scale.on(replicates[row][k]) - scale.on(points[k]);
        wider * by.abs() / s
    };
    let of = |caution: f64| {
        let rows = replicates.len();
        StepDown::new(&statistics, rows, deviation, ERROR, caution)
    };
    let steps = of(caution);
    found.p = match steps.rejected.contains(&true) {
        true => of(0.0).p,
        false => steps.p,
    };
    for (place, (k, s)) in active.iter().enumerate() {
        if statistics[place] > 0.0 {
            let (y, by) = (scale.on(points[*k]), steps.critical[place] * s);
            found.out[*k] = steps.rejected[place];
            let interval = Interval::try_new(y - by, y + by).ok();
            found.ends[*k] = interval.map(|interval| Ends {
                interval: interval.map(|y| scale.back(y)),
                errors: (0.0, 0.0),
                range: known.range,
                way: IntervalMethod::Simultaneous,
            });
        }
    }
    found
}

/// Standard deviation of a cell over the replicates; none where no replicate
/// moves it, which shows no certainty, or one in ten has no value.
fn spread(measured: &Replicates, k: usize, scale: CellScale) -> Option<f64> {
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
