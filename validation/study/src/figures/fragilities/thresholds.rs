//! Figures 15 to 17: the fragilities with their bands.

use rocking_statistics::{Lognormal, Range, normal};

use super::curves::{
    KEYS, NUMBERS, along, empirical, exceedance, fitted, keys, most_of,
};
use crate::fits::{Fits, THRESHOLDS};
use crate::inference::{Resample, Resamples};
use crate::measures::{Scope, Thresholds, by_demand};
use crate::results::StudyResults;
use crate::words::paper_heading;
use anyhow::Context as _;
use rocking_common::findings::{LEVEL, SuiteSet};
use rocking_common::paper::{Arm, Intensity};
use rocking_draw::axis::Axis;
use rocking_draw::colour::{Dash, Fill, Ink, Pen};
use rocking_draw::figures::common::span;
use rocking_draw::figures::{
    Chart, ChartPanel, Figure, Layout, Look, Mark, Series,
};
use rocking_draw::grid::Grid;
use rocking_statistics::Estimate;

const USFL: (&str, Pen) = ("USFL", Pen::new(Ink::Series(0), 1.4));

/// The benchmark of the distances of USFL7.
const SSFL: (&str, Pen) = ("SSFL", Pen::new(Ink::Text, 0.9));

/// Intensities at which the ends of a band are computed.
const POINTS: u32 = 80;

/// Level of the bands.
const BAND: f64 = 0.95;

/// The two fits that a figure compares.
#[derive(Clone, Copy, PartialEq, Eq)]
enum FitPair {
    /// Figure 15: USFL and SSFL.
    Shifted,
    /// Figure 16: the trimmed USFL and its USFL7.
    Trimmed,
    /// Figure 17: the untrimmed USFL and its USFL7.
    Untrimmed,
}

impl FitPair {
    fn first(self, at: &Fits) -> Option<Lognormal> {
        match self {
            Self::Trimmed => at.trimmed,
            _ => at.usfl,
        }
    }

    fn second(self, at: &Fits) -> Option<Lognormal> {
        match self {
            Self::Shifted => at.ssfl,
            _ => at.usfl7(self.first(at), 1.0),
        }
    }

    /// Name and pen of the second fit.
    fn other(self) -> (&'static str, Pen) {
        let (name, series) = match self {
            Self::Shifted => ("SSFL", 2),
            Self::Trimmed | Self::Untrimmed => ("USFL7", 1),
        };
        (name, Pen::new(Ink::Series(series), 1.4).dash(Dash::Dashed))
    }
}

/// Figures 15, 16 and 17.
pub(in super::super) fn thresholds(
    results: &StudyResults,
    draws: &Resamples,
    arm: Arm,
    number: u32,
) -> anyhow::Result<Figure> {
    let pair = match number {
        15 => FitPair::Shifted,
        16 => FitPair::Trimmed,
        _ => FitPair::Untrimmed,
    };
    let mut panels = Vec::new();
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        let scope = Scope {
            results,
            draws,
            distances: &[],
            tested: SuiteSet::from(results.ordinary.kind),
            arm,
            intensity,
        };
        let apart = by_demand(&scope, |at| at.to_ssfl(pair.first(at), 1.0))?;
        let limits = (Range::Share, LEVEL);
        let apart = draws.estimates(scope.tested, limits, &apart);
        for (place, apart) in apart.iter().enumerate() {
            panels.push(panel(&scope, pair, (place, apart))?);
        }
    }
    let heading = paper_heading(number, Some(arm));
    let columns = THRESHOLDS.len();
    let grid = Grid::new(panels.len(), columns);
    let grid = grid.plot(grid.width, 170.0);
    let layout = Layout { grid: Some(grid), ..Layout::of(&KEYS, &NUMBERS) };
    let chart = Chart { heading, panels, columns };
    let chart = chart.thinned((grid.width, grid.height));
    let benchmark = match pair {
        FitPair::Shifted => "",
        _ => " The thin line is the SSFL, from which distances are measured.",
    };
    let words = format!(
        "Bands are 95 % intervals of the fitted probability by earthquake; \
         brackets are 90 % intervals.{benchmark}"
    );
    Ok(chart.laid_out(&layout, words))
}

fn panel(
    scope: &Scope<'_>,
    pair: FitPair,
    (place, apart): (usize, &Estimate),
) -> anyhow::Result<ChartPanel> {
    let kind = scope.kind();
    let (read, whole) = (Thresholds::new(scope)?, scope.draws.whole());
    let at = read.at(whole.of(kind), place).context("no capacities")?;
    let (first, second) = (pair.first(&at), pair.second(&at));
    let sample = at.sample.sorted();
    let axis = range(sample);
    let grid = along(axis, POINTS);
    let over = |draw: Resample<'_>| {
        let Some(at) = read.at(draw.of(kind), place) else {
            return vec![f64::NAN; 2 * grid.len()];
        };
        // On the scale of the normal score, like the bands of `fragility fit`.
        let of = |fit: Option<Lognormal>| {
            let score =
                |p: f64| if p > 0.0 { normal::quantile(p) } else { f64::NAN };
            let p = move |x: &f64| fit.map_or(f64::NAN, |f| score(f.cdf(*x)));
            grid.iter().map(p)
        };
        of(pair.first(&at)).chain(of(pair.second(&at))).collect()
    };
    let bands = scope.draws.smooth(scope.tested, &over);
    let limits = (Range::Real, BAND);
    let bands = scope.draws.estimates(scope.tested, limits, &bands);
    let bands: Vec<Estimate> =
        bands.into_iter().map(|score| score.map(normal::cdf)).collect();
    let (of_first, of_second) = bands.split_at(grid.len());
    let at_place = (scope.intensity, THRESHOLDS[place]);
    let band = |(name, pen): (&str, Pen), of: &[Estimate]| {
        let found = grid.iter().zip(of);
        let found =
            found.filter_map(|(x, p)| Some((*x, p.interval()?.ends())));
        let (x, ends): (Vec<f64>, Vec<(f64, f64)>) = found.unzip();
        let y = vec![f64::NAN; x.len()];
        let name = format!("95 % band of {name}");
        let look = Look::band(Fill::tint(pen.ink, 26));
        let keys = keys(at_place, &name, None);
        Series::of(look, x, y).labelled(&name).with(ends).keyed(keys)
    };
    let other = pair.other();
    let fine = along(axis, 300);
    let mut series = vec![
        band(USFL, of_first),
        band(other, of_second),
        empirical(at_place, sample),
        fitted(at_place, USFL, first.as_ref(), &fine),
        fitted(at_place, other, second.as_ref(), &fine),
    ];
    let mut notes = Vec::new();
    if pair == FitPair::Shifted {
        notes.extend([
            "largest distance to the ECDF:".into(),
            format!(
                "USFL {:.3}, SSFL {:.3}",
                at.to_sample(first),
                at.to_sample(second)
            ),
        ]);
    } else {
        series.push(fitted(at_place, SSFL, at.ssfl.as_ref(), &fine));
        if second.is_some() {
            notes.push("largest distance to SSFL:".into());
            notes.push(apart.text("", |x| format!("{x:.3}")));
        }
    }
    for (name, fit) in [(USFL.0, first), (other.0, second)] {
        if fit.is_none() {
            notes.push(format!("{name} is not defined"));
        }
    }
    let note = |words| Series::note(Mark::Corner, words, (0.0, 0.0));
    series.extend(notes.into_iter().map(note));
    let name = scope.intensity.name().to_uppercase();
    Ok(ChartPanel::new(
        format!("{name}, *θ̃* = {:.2}", THRESHOLDS[place]),
        Axis::linear(axis.0, axis.1, 5).label(scope.intensity.row().label),
        exceedance(),
        series,
    ))
}

/// Ends of a panel's intensity axis: from below the least datum to the 97 %
/// quantile of the data.
fn range(sample: &[f64]) -> (f64, f64) {
    let data = sample.iter().copied();
    let (least, _) = span(data, true).unwrap_or((1.0, 2.0));
    let most = most_of(sample).filter(|x| *x > least);
    (0.6 * least, 1.05 * most.unwrap_or(2.0 * least))
}
