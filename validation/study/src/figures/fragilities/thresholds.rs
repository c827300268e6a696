//! Figures 15 to 17: the fragilities with the bands that decide the claims.

use rocking_statistics::Lognormal;

use super::curves::{
    KEYS, NUMBERS, along, empirical, exceedance, fitted, keys, most_of,
};
use crate::claims::limit_of;
use crate::fits::{THRESHOLDS, distance, usfl7};
use crate::inference::{Replicates, Resample, Resamples, by_cell};
use crate::measures::{
    ClaimMeasure, DemandFits, Scope, Thresholds, by_demand, to_ssfl,
};
use crate::results::StudyResults;
use crate::words::paper_heading;
use anyhow::Context as _;
use rocking_common::findings::SuiteSet;
use rocking_common::paper::{Arm, Intensity};
use rocking_draw::axis::Axis;
use rocking_draw::colour::{Dash, Fill, Ink, Pen};
use rocking_draw::figures::common::span;
use rocking_draw::figures::{
    Chart, ChartPanel, Figure, Layout, Look, Mark, Series,
};
use rocking_draw::grid::Grid;
use rocking_statistics::{Estimate, Interval};

const LIMIT: Fill = Fill::tint(Ink::Muted, 30);
const USFL: (&str, Pen) = ("USFL", Pen::new(Ink::Series(0), 1.4));

/// Intensities at which the ends of a band are computed.
const POINTS: u32 = 80;

/// Which fits a figure compares.
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
    fn of(number: u32) -> Self {
        match number {
            15 => Self::Shifted,
            16 => Self::Trimmed,
            _ => Self::Untrimmed,
        }
    }

    fn first(self, at: &DemandFits) -> Option<Lognormal> {
        match self {
            Self::Trimmed => at.fits.trimmed,
            _ => at.fits.usfl,
        }
    }

    fn second(self, at: &DemandFits) -> Option<Lognormal> {
        match self {
            Self::Shifted => at.fits.ssfl,
            _ => usfl7(self.first(at), at.shift, 1.0),
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

    /// Name of the second fit's band: of USFL7 it is that of the difference
    /// to the SSFL, laid on the SSFL, so that the curve need not lie in it.
    fn band_words(self) -> &'static str {
        match self {
            Self::Shifted => "95 % band of SSFL",
            _ => "SSFL + 95 % band of USFL7 \u{2212} SSFL",
        }
    }

    /// The measure of the claims on it.
    fn measure(self) -> ClaimMeasure {
        match self {
            Self::Shifted => ClaimMeasure::ShiftGain,
            Self::Trimmed => ClaimMeasure::TrimmedToSsfl,
            Self::Untrimmed => ClaimMeasure::UntrimmedToSsfl,
        }
    }
}

/// Figures 15, 16 and 17.
pub(in super::super) fn thresholds(
    results: &StudyResults,
    draws: &Resamples,
    arm: Arm,
    number: u32,
) -> anyhow::Result<Figure> {
    let pair = FitPair::of(number);
    let mut panels = Vec::new();
    let mut words = Vec::new();
    for intensity in [Intensity::Pga, Intensity::Pgv] {
        let scope = Scope {
            results,
            draws,
            distances: &[],
            tested: SuiteSet::from(results.ordinary.kind),
            arm,
            intensity,
        };
        let measure = pair.measure();
        let limit = limit_of(measure, intensity);
        let read = Thresholds::new(&scope)?;
        let (_, range) = measure.unit();
        let judged = |measured: &Replicates| {
            by_cell(draws, scope.tested, range, measured)
        };
        let decide = if pair == FitPair::Shifted {
            judged(&measure.prepare(&scope)?.measured)
        } else {
            let apart = |at: &DemandFits| to_ssfl(pair.first(at), at, 1.0);
            judged(&by_demand(&scope, &read, apart))
        };
        let name = intensity.name().to_uppercase();
        words.push(if pair == FitPair::Shifted {
            gain_in_words(&name, decide.first(), limit)
        } else {
            distances_in_words(&name, &decide, limit)
        });
        for (place, edp) in THRESHOLDS.into_iter().enumerate() {
            let cell = decide.get(place).filter(|_| pair != FitPair::Shifted);
            let of = ThresholdPanel { edp, place, limit, cell };
            panels.push(panel(&scope, &read, pair, &of)?);
        }
    }
    words.push(
        match pair {
            FitPair::Shifted => {
                "Bands hold 95 % of the fits to resampled suites; brackets \
                 are 90 % intervals."
            }
            _ => {
                "The band is SSFL plus 95 % of the differences of USFL7 to \
                 it over resampled suites, so that USFL7 need not lie in it; \
                 brackets are 90 % intervals."
            }
        }
        .into(),
    );
    let heading = paper_heading(number, Some(arm));
    let columns = THRESHOLDS.len();
    let grid = Grid::new(panels.len(), columns);
    let grid = grid.plot(grid.width, 170.0);
    let layout = Layout { grid: Some(grid), ..Layout::of(&KEYS, &NUMBERS) };
    let chart = Chart { heading, panels, columns };
    let chart = chart.thinned((grid.width, grid.height));
    Ok(chart.laid_out(&layout, words.join(" ")))
}

fn band(pen: Pen) -> Fill {
    Fill::tint(pen.ink, 26)
}

/// Contents of a panel.
struct ThresholdPanel<'a> {
    edp: f64,
    place: usize,
    limit: f64,
    /// Largest distance of USFL7 to SSFL, as the claim judges it.
    cell: Option<&'a Estimate>,
}

fn panel(
    scope: &Scope<'_>,
    read: &Thresholds,
    pair: FitPair,
    of: &ThresholdPanel<'_>,
) -> anyhow::Result<ChartPanel> {
    let kind = scope.results.ordinary.kind;
    let whole = scope.draws.whole();
    let at = read.at(whole.of(kind), of.place).context("no capacities")?;
    let (first, second) = (pair.first(&at), pair.second(&at));
    let sample = at.sample.sorted();
    let axis = range(sample);
    let grid = along(axis, POINTS);
    // Of USFL7 the difference to SSFL, which moves with the records less
    // than either.
    let over = |draw: Resample<'_>| {
        let Some(at) = read.at(draw.of(kind), of.place) else {
            return vec![f64::NAN; 2 * grid.len()];
        };
        let (a, b) = (pair.first(&at), pair.second(&at));
        let less = at.fits.ssfl.filter(|_| pair != FitPair::Shifted);
        let all = |fit: Option<Lognormal>, less: Option<Lognormal>| {
            grid.iter().map(move |x| {
                let p = fit.map_or(f64::NAN, |f| f.cdf(*x));
                p - less.map_or(0.0, |f| f.cdf(*x))
            })
        };
        all(a, None).chain(all(b, less)).collect()
    };
    let bands = scope.draws.smooth(scope.tested, &over);
    let bands = bands.percentiles(scope.draws, scope.tested);
    let (of_first, of_second) = bands.split_at(grid.len());
    let place = (scope.intensity, of.edp);
    // Ends of a band on a curve, or of the curve itself.
    let laid = |name: &str, fill, on: Option<Lognormal>, ends: &[_]| {
        let found = grid.iter().zip(ends).filter_map(|(x, ends)| {
            let p = on.map_or(0.0, |f| f.cdf(*x));
            let (a, b): (f64, f64) = (*ends)?;
            Some((*x, (p + a, p + b)))
        });
        let (x, ends): (Vec<f64>, Vec<(f64, f64)>) = found.unzip();
        let y = vec![f64::NAN; x.len()];
        let keys = keys(place, name, on.as_ref());
        let band = Series::of(Look::band(fill), x, y).labelled(name);
        band.with(ends).keyed(keys)
    };
    let on = at.fits.ssfl.filter(|_| pair != FitPair::Shifted);
    let (name, pen) = pair.other();
    let mut series = Vec::new();
    if on.is_some() {
        let around = vec![Some((-of.limit, of.limit)); grid.len()];
        let words = format!("limit: SSFL ± {}", of.limit);
        series.push(laid(&words, LIMIT, on, &around));
    }
    if pair == FitPair::Shifted {
        let fill = band(USFL.1);
        series.push(laid("95 % band of USFL", fill, None, of_first));
    }
    series.push(laid(pair.band_words(), band(pen), on, of_second));
    series.push(empirical(place, sample));
    let fine = along(axis, 300);
    series.push(fitted(place, USFL, first.as_ref(), &fine));
    series.push(fitted(place, (name, pen), second.as_ref(), &fine));
    let mut notes = match (second, of.cell) {
        (None, _) => Vec::new(),
        (Some(_), None) => vec![
            "largest distance to the ECDF:".into(),
            format!(
                "USFL {:.3}, SSFL {:.3}",
                distance(first, &at.sample),
                distance(second, &at.sample)
            ),
        ],
        (Some(_), Some(cell)) => {
            vec!["largest distance to SSFL:".into(), cell.text("", three)]
        }
    };
    for (name, fit) in [(USFL.0, first), (name, second)] {
        if fit.is_none() {
            notes.push(format!("{name} is not defined"));
        }
    }
    let note = |words| Series::note(Mark::Corner, words, (0.0, 0.0));
    series.extend(notes.into_iter().map(note));
    let name = scope.intensity.name().to_uppercase();
    Ok(ChartPanel::new(
        format!("{name}, *θ̃* = {:.2}", of.edp),
        Axis::linear(axis.0, axis.1, 5).label(scope.intensity.row().label),
        exceedance(),
        series,
    ))
}

/// Ends of a panel's intensity axis: from below the least datum to what 97 %
/// of the data do not exceed.
fn range(sample: &[f64]) -> (f64, f64) {
    let data = sample.iter().copied();
    let (least, _) = span(data, true).unwrap_or((1.0, 2.0));
    let most = most_of(sample).filter(|x| *x > least);
    (0.6 * least, 1.05 * most.unwrap_or(2.0 * least))
}

/// Three decimals.
fn three(x: f64) -> String {
    format!("{x:.3}").replace('-', "−")
}

/// The gain by shifting, in a sentence.
fn gain_in_words(name: &str, gain: Option<&Estimate>, limit: f64) -> String {
    let Some(gain) = gain else { return String::new() };
    let Some((low, high)) = gain.interval().map(Interval::ends) else {
        return format!("For {name} no interval tells what shifting gains.");
    };
    let finding = if low > limit {
        format!("SSFL fits better than USFL by more than {limit}")
    } else if high < -limit {
        format!("SSFL fits worse than USFL by more than {limit}")
    } else if low > -limit && high < limit {
        format!("SSFL fits as USFL does, within {limit}")
    } else if high < limit {
        format!("SSFL does not fit better than USFL by {limit}")
    } else {
        format!("it is open whether SSFL fits better than USFL by {limit}")
    };
    format!(
        "For {name} {finding}; the mean gain over three demands is {}.",
        gain.text("", three)
    )
}

/// At which demands USFL7 is near enough, in a sentence.
fn distances_in_words(name: &str, cells: &[Estimate], limit: f64) -> String {
    let ends =
        |cell: &Estimate| cell.interval().map_or((0.0, 1.0), Interval::ends);
    let listed = |is: &dyn Fn((f64, f64)) -> bool| {
        let demands: Vec<String> = THRESHOLDS
            .iter()
            .zip(cells)
            .filter(|(_, cell)| is(ends(cell)))
            .map(|(edp, _)| format!("{edp:.2}"))
            .collect();
        match demands.as_slice() {
            [] => None,
            [one] => Some(format!("demand {one}")),
            [most @ .., last] => {
                Some(format!("demands {} and {last}", most.join(", ")))
            }
        }
    };
    let inside = listed(&|(_, high)| high < limit)
        .map(|at| format!("USFL7 lies within {limit} of SSFL at {at}"));
    let outside = listed(&|(low, _)| low > limit)
        .map(|at| format!("USFL7 leaves SSFL by more than {limit} at {at}"));
    let open = listed(&|(low, high)| !(high < limit || low > limit))
        .map(|at| format!("USFL7 may lie within {limit} of SSFL at {at}"));
    let all: Vec<String> =
        [inside, outside, open].into_iter().flatten().collect();
    format!("For {name} {}.", all.join("; "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_band_that_is_laid_on_another_curve_is_named_so() {
        assert_eq!(FitPair::Shifted.band_words(), "95 % band of SSFL");
        for pair in [FitPair::Trimmed, FitPair::Untrimmed] {
            let words = pair.band_words();
            assert!(words.starts_with("SSFL + ") && words.ends_with("SSFL"));
        }
    }
}
